/* Markers: where along a line symbols are drawn, and how they are turned.
 *
 *        start        mid          end        M 0 0  L 10 0  L 20 10
 *          >-----------*
 *                       \                     mid ones lie at every vertex except the first and the
 *                        \                    last of all subpaths, along the bisector of the
 *                         >                   directions in which the line comes and goes
 */
#pragma once

#include "readers/svg/document/reading.h"

typedef struct cs_svg_mark {
  const cs_svg_node *marker;
  celspan_matrix viewport; /* the marker's viewport, 0 0 width height, to the shape's user units */
  celspan_matrix content;  /* units of the marker's contents, to the viewport */
  double width, height;    /* the width and height of the viewport */
  cs_svg_measure measure;  /* for lengths of the marker's contents */
} cs_svg_mark;

typedef struct cs_svg_marks {
  cs_svg_mark *items;
  size_t count, capacity;
} cs_svg_marks;

/* Whether the element can have markers, and has some. */
bool cs_svg_is_marked(const cs_svg_node *node, const cs_svg_style *style);
/* The marks of a shape at `place`, in the order in which they are drawn. finish frees them, also
 * after an error. Errors: NO_MEMORY, LIMIT, INPUT. */
CELSPAN_CHECKED celspan_status cs_svg_marks_find(cs_svg_reading *reading, const cs_svg_node *node,
                                                 const cs_svg_place *place, cs_svg_marks *marks);
void cs_svg_marks_finish(cs_svg_marks *marks, cs_memory *memory);
