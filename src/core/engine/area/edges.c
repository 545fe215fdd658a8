#include "engine/area/edges.h"

#include "engine/sweep/pieces.h"

#include <string.h>

/* Bytes of one boundary over all arrays; a gap before them aligns the arrays. */
#define ITEM_SIZE (2 * sizeof(double) + 4 * sizeof(float) + 2 * sizeof(int32_t) + sizeof(bool))

void cs_edges_finish(cs_edges *edges, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, edges, storage, storage);
  *edges = (cs_edges){0};
}

/* The wider items come first, so that each array is aligned. Vector code works beyond the count:
 * there zeros are quick, while leftover memory may hold denormal numbers, which are slow. */
static celspan_status make_room(celspan_context *context, cs_edges *edges, size_t count) {
  if (count <= edges->capacity)
    return CELSPAN_OK;
  size_t wanted = 2 * count;
  edges->capacity = 0;
  CS_TRY(CS_ARRAY_MAKE(context, edges->storage, wanted * ITEM_SIZE + CS_WIDE_LINE));
  edges->capacity = wanted;
  edges->isa = cs_isa_best();
  edges->low = cs_wide_align(edges->storage);
  edges->high = edges->low + wanted;
  edges->one = (float *)(edges->high + wanted);
  edges->two = edges->one + wanted;
  edges->second = edges->two + wanted;
  edges->fall = edges->second + wanted;
  edges->first = (int32_t *)(edges->fall + wanted);
  edges->end = edges->first + wanted;
  edges->is_bent = (bool *)(edges->end + wanted);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- bent */

/* Adds the areas right of a straight piece: the area in the column that ends at `split` to *area,
 * and the area in the next column to *rest. */
static void add_piece(double *area, double *rest, celspan_point above, celspan_point below,
                      double height, double split) {
  double low = above.x < below.x ? above.x : below.x, high = above.x < below.x ? below.x : above.x;
  if (high <= split) {
    *area += cs_cover_round(height * cs_cover_within(low, high, split));
    *rest += height;
  } else if (low >= split) {
    *rest += cs_cover_round(height * cs_cover_within(low, high, split + 1));
  } else {
    double by_twice = 0.5 / (high - low);
    *area += cs_cover_round(height * cs_cover_first(low, split, by_twice));
    *rest += cs_cover_round(height * cs_cover_last(high, split, by_twice));
  }
}

/* The areas of a bent boundary over at most two columns. */
static void measure_pieces(cs_edges *edges, const cs_active *active, const cs_bend *bend) {
  size_t i = bend->boundary;
  double area = 0, rest = 0, split = edges->first[i] + 1, passed = 0;
  for (cs_pieces p = cs_pieces_of(active, i, bend); cs_pieces_next(&p);) {
    double reached = cs_cover_round(p.below.y - active->y);
    add_piece(&area, &rest, p.above, p.below, reached - passed, split);
    passed = reached;
  }
  edges->one[i] = (float)area;
  edges->two[i] = edges->end[i] - edges->first[i] > 1 ? (float)rest : 1;
}

/* As cs_edges_straight for a boundary with vertices in the row. */
static void measure_bent(cs_edges *edges, const cs_active *active, const cs_bend *bend,
                         int32_t width) {
  size_t i = bend->boundary;
  edges->low[i] = bend->low;
  edges->high[i] = bend->high;
  edges->is_bent[i] = true;
  edges->fall[i] = 0;
  edges->first[i] = cs_edges_floor(bend->low, width);
  edges->end[i] = cs_edges_ceil(bend->high, width);
  bool leaves = (bend->low < 0 && bend->high > 0) || (bend->high > width && bend->low < width);
  if (leaves && edges->end[i] < edges->first[i] + 3)
    edges->end[i] = edges->first[i] + 3;
  if (edges->end[i] <= edges->first[i] + 2)
    measure_pieces(edges, active, bend);
}

celspan_status cs_edges_measure(celspan_context *context, cs_edges *edges, const cs_active *active,
                                int32_t width) {
  size_t count = cs_advance_whole(active->count);
  CS_TRY(make_room(context, edges, count));
  CS_WIDE_CHOOSE(edges->isa, cs_edges_straight)
  (edges, active->x, active->x_next, count, width);
  if (count > 0) /* otherwise the room does not exist yet */
    memset(edges->is_bent, 0, count * sizeof *edges->is_bent);
  for (size_t k = 0; k < active->bend_count; k++)
    if (active->bends[k].vertex_count > 0)
      measure_bent(edges, active, &active->bends[k], width);
  return CELSPAN_OK;
}
