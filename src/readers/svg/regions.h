/* The region that a mask or a filter acts in: x, y, width and height of its element, in the user
 * units of the element that refers to it, or as shares of that element's box.
 */
#pragma once

#include "readers/svg/reading.h"

typedef struct cs_svg_region {
  bool is_sized;         /* false: it is empty, or a share of a box without a size */
  celspan_box box;       /* in its own units */
  celspan_matrix own;    /* these to the drawing's */
  bool has_box;          /* the element that refers to it has a box with a size: */
  celspan_box element;   /* in its user units; may be empty */
  celspan_matrix shares; /* shares of it to the drawing's units */
} cs_svg_region;

/* node: the mask or filter. units: the attribute that says whether it counts in user units. place:
 * of `element`, which refers to it. Errors: NO_MEMORY, LIMIT, INPUT. */
CELSPAN_CHECKED celspan_status cs_svg_region_find(cs_svg_reading *reading, const cs_svg_node *node,
                                                  cs_svg_name units, const cs_svg_node *element,
                                                  const cs_svg_place *place, cs_svg_region *out);
