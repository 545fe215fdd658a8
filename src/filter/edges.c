#include "filter/edges.h"

#include <string.h>

/* Bytes of one boundary over all arrays. */
#define ITEM_SIZE (4 * sizeof(double) + 2 * sizeof(int32_t) + sizeof(bool))

void cs_edges_finish(cs_edges *edges, cs_memory *memory) {
  cs_mem_free(memory, edges->block, edges->capacity * ITEM_SIZE);
  *edges = (cs_edges){0};
}

/* The wider items first, so that each is aligned. */
static celspan_status make_room(celspan_context *context, cs_edges *edges, size_t count) {
  if (count <= edges->capacity)
    return CELSPAN_OK;
  size_t wanted = 2 * count;
  double *block = cs_mem_array(context->memory, wanted, ITEM_SIZE);
  if (!block)
    return cs_fail_memory(context);
  cs_mem_free(context->memory, edges->block, edges->capacity * ITEM_SIZE);
  *edges = (cs_edges){.isa = cs_isa_best(),
                      .low = block,
                      .high = block + wanted,
                      .area = block + 2 * wanted,
                      .rest = block + 3 * wanted,
                      .first = (int32_t *)(block + 4 * wanted),
                      .block = block,
                      .capacity = wanted};
  edges->end = edges->first + wanted;
  edges->is_bent = (bool *)(edges->end + wanted);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- bent */

/* Adds to two pixels, of which the first begins at `column`, the area right of a straight piece
 * that crosses no others. */
static inline void add_areas(celspan_point above, celspan_point below, int32_t column,
                             double areas[2]) {
  double split = column + 1.0, height = below.y - above.y;
  double low = above.x < below.x ? above.x : below.x, high = above.x < below.x ? below.x : above.x;
  if (high <= split) {
    areas[0] += height * (split - 0.5 * (low + high));
    areas[1] += height;
  } else if (low >= split) {
    areas[1] += height * (split + 1 - 0.5 * (low + high));
  } else {
    double share = height / (2 * (high - low));
    areas[0] += (split - low) * (split - low) * share;
    areas[1] += height - (high - split) * (high - split) * share;
  }
}

/* As measure_straight for a boundary with vertices in the row. */
static void measure_bent(cs_edges *edges, const cs_active *active, const cs_bend *bend,
                         int32_t width) {
  size_t i = bend->boundary;
  edges->low[i] = bend->low;
  edges->high[i] = bend->high;
  edges->is_bent[i] = true;
  edges->first[i] = cs_edges_floor(bend->low, width);
  edges->end[i] = cs_edges_ceil(bend->high, width);
  bool leaves = (bend->low < 0 && bend->high > 0) || (bend->high > width && bend->low < width);
  if (leaves && edges->end[i] < edges->first[i] + 3)
    edges->end[i] = edges->first[i] + 3;
  if (edges->end[i] > edges->first[i] + 2)
    return;
  celspan_point above = {active->x[i], active->y}, foot = {active->x_next[i], active->y_next};
  double areas[2] = {0, 0};
  for (uint32_t k = 0; k < bend->vertex_count; k++) {
    celspan_point below = active->vertices[bend->vertex + k];
    add_areas(above, below, edges->first[i], areas);
    above = below;
  }
  add_areas(above, foot, edges->first[i], areas);
  edges->area[i] = cs_edges_round(areas[0]);
  edges->rest[i] = cs_edges_round(areas[1]);
}

celspan_status cs_edges_measure(celspan_context *context, cs_edges *edges, const cs_active *active,
                                int32_t width) {
  CS_TRY(make_room(context, edges, active->count));
  CS_WIDE_CHOOSE(edges->isa, cs_edges_straight)
  (edges, active->x, active->x_next, active->count, width);
  if (active->count > 0) /* else there is no room yet */
    memset(edges->is_bent, 0, active->count * sizeof *edges->is_bent);
  for (size_t k = 0; k < active->bend_count; k++)
    if (active->bends[k].vertex_count > 0)
      measure_bent(edges, active, &active->bends[k], width);
  return CELSPAN_OK;
}
