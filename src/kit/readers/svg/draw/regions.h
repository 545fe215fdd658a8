/* The region of a mask or a filter: x, y, width and height of its element, in the user units of the
 * element that refers to it, or as shares of that element's box. */
#pragma once

#include "readers/svg/document/reading.h"

typedef struct cs_svg_region {
  bool is_sized;         /* false: the region is empty, or a share of a box without a size */
  celspan_box box;       /* in the units of the region */
  celspan_matrix own;    /* from these units to the drawing's */
  bool has_box;          /* the box of the element that refers to the region has a size */
  celspan_box element;   /* the element's box, in user units; may be empty */
  celspan_matrix shares; /* from shares of that box to the drawing's units */
} cs_svg_region;

/* node: the mask or filter. units: the attribute that says whether it is given in user units.
 * place: of `element`, which refers to it. Errors: NO_MEMORY, LIMIT, INPUT. */
CELSPAN_CHECKED celspan_status cs_svg_region_find(cs_svg_reading *reading, const cs_svg_node *node,
                                                  cs_svg_name units, const cs_svg_node *element,
                                                  const cs_svg_place *place, cs_svg_region *out);
