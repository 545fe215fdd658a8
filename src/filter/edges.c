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

/* As cs_edges_straight for a boundary with vertices in the row. */
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
  celspan_point above = {active->x[i], active->y};
  edges->area[i] = edges->rest[i] = 0;
  for (uint32_t k = 0; k <= bend->vertex_count; k++) {
    celspan_point below = k < bend->vertex_count
                              ? active->vertices[bend->vertex + k]
                              : (celspan_point){active->x_next[i], active->y_next};
    double height = cs_edges_round(below.y - active->y) - cs_edges_round(above.y - active->y);
    edges->area[i] += cs_edges_cover(above.x, below.x, height, edges->first[i]);
    edges->rest[i] += cs_edges_cover(above.x, below.x, height, edges->first[i] + 1);
    above = below;
  }
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
