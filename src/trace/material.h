/* What is traced, together: the picture, its colours, and which of them each pixel has.
 *
 * Where four pixels meet in a point and only those across from each other are alike, one of the two
 * pairs is joined there, or none:
 *
 *      a | b         a | b          a | b        joins NW_SE: both a are one area, and the border
 *      --+--   -->     \      or     /           between a and b turns about each b
 *      b | a         b | a          b | a        joins NE_SW: both b are
 *
 * INVARIANT: what is joined in a point is a function of the pixels about it; regions.c and borders.c
 * both ask here, so that borders go around regions.
 */
#ifndef CS_TRACE_MATERIAL_H
#define CS_TRACE_MATERIAL_H

#include "trace/labels.h"

typedef struct cs_material {
  const cs_scan *scan;
  const cs_colours *colours;
  cs_labels *labels;
  bool is_whole; /* hardly any pixel of a border is a mixture (edge.h tells) */
} cs_material;

typedef enum cs_join { CS_JOIN_NONE, CS_JOIN_NW_SE, CS_JOIN_NE_SW } cs_join;

/* Of the four pixels about the corner (x, y), 0 <= x <= width, of which no two side by side are
 * alike. */
cs_join cs_material_join(const cs_material *material, int32_t x, int32_t y);

#endif
