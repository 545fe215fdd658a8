/* Counts and sizes of the shapes of a cel, found before it is compiled, from their boxes and
 * paints.
 *
 *     +---- frame ----+
 *     |  +--+         |      height: rows of the frame that a shape's box covers
 *     |  |##|  +------|---   area:   pixels of it, to weigh what varies against what is flat
 *     |  +--+  |      |
 *
 * It depends on the cel, its place and the size of the whole frame alone. Of a cel of more than
 * CS_CENSUS_MOST shapes the first ones stand for all.
 */
#pragma once

#include "model/scene/scene.h"

#define CS_CENSUS_MOST 65536

typedef struct cs_census {
  size_t shapes;       /* that were counted */
  size_t inside;       /* those whose boxes meet the frame */
  size_t hiding;       /* those that let no light through, wherever they are */
  double heights;      /* of those inside: rows that each covers, summed */
  double varied, flat; /* areas of those that vary (gradients, pictures), and of the others */
  bool may_have_dashes;
  size_t pieces, points; /* of the outlines of all shapes; unknown for strokes */
} cs_census;

/* matrix: from the units of the objects to pixels of the frame. */
cs_census cs_census_take(celspan_object *const *objects, size_t count, const celspan_matrix *matrix,
                         int32_t width, int32_t height);
