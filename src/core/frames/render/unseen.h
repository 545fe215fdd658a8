/* Objects of which nothing can be seen, because upright opaque rectangles lie in front of them:
 * they are left out before anything is compiled for them.
 *
 *   +-----+-----+-----+-----+   The frame is divided into tiles of whole pixels. From the camera
 *   |  ...|.....|..   |     |   backwards, an opaque rectangle (.) covers the tiles that lie wholly
 *   |  ...|#####|..   |     |   inside it (#). An object is left out when all the tiles that its
 *   +-----+#####+-----+-----+   bounds touch have been covered before.
 *   |  ...|.....|..   |     |
 *   +-----+-----+-----+-----+
 *
 * So a list of very many small rectangles costs as much as those of them that are seen, whatever
 * lies behind. Invariant: which objects are left out depends on the scene and the frame's size
 * alone; the objects of one list hide each other wholly, however their cel is faded or lit.
 */
#pragma once

#include "frames/render/compiler.h"

/* A bit for each object of a list: whether it is left out. No bits: none is left out. */
typedef struct cs_unseen {
  uint64_t *bits;
  size_t count;
} cs_unseen;

/* matrix: from the units of the list to pixels. Short lists are not searched. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_unseen_find(const cs_compiler *c, celspan_object *const *objects,
                                              size_t count, const celspan_matrix *matrix,
                                              cs_unseen *out);
void cs_unseen_finish(cs_unseen *list, cs_memory *memory);

static inline bool cs_unseen_has(const cs_unseen *list, size_t i) {
  return list->bits && list->bits[i / 64] >> (i % 64) & 1;
}
