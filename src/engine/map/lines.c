/* Lists of borders: freed, and brought into the order in which rows need them. */
#include "base/sort.h"
#include "engine/map/map.h"

void cs_map_lines_finish(cs_map_lines *lines, cs_memory *memory) {
  cs_mem_free(memory, lines->borders, lines->border_capacity * sizeof *lines->borders);
  cs_mem_free(memory, lines->points, lines->point_capacity * sizeof *lines->points);
  *lines = (cs_map_lines){0};
}

/* Ties are broken by the points, of which no two borders share the first one. */
typedef struct placed {
  cs_map_border border;
  int32_t top;
} placed;

static inline bool is_before(const placed *a, const placed *b) {
  return a->top != b->top ? a->top < b->top : a->border.first < b->border.first;
}

CS_SORT_DEFINE(sort_placed, placed, is_before)

celspan_status cs_map_lines_sort(celspan_context *context, cs_map_lines *lines) {
  placed *order;
  size_t count = lines->border_count;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, order, count));
  for (size_t i = 0; i < count; i++) {
    const cs_map_border border = lines->borders[i];
    order[i] = (placed){border, lines->points[border.first].y};
  }
  sort_placed(order, count);
  for (size_t i = 0; i < count; i++)
    lines->borders[i] = order[i].border;
  cs_mem_free(context->memory, order, count * sizeof *order);
  return CELSPAN_OK;
}
