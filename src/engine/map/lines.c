/* Lists of borders: freed, and brought into the order in which rows need them. */
#include "base/sort.h"
#include "engine/map/map.h"

void cs_map_lines_finish(cs_map_lines *lines, cs_memory *memory) {
  cs_mem_free(memory, lines->borders, lines->border_capacity * sizeof *lines->borders);
  cs_mem_free(memory, lines->points, lines->point_capacity * sizeof *lines->points);
  *lines = (cs_map_lines){0};
}

static inline bool is_before(const uint64_t *a, const uint64_t *b) { return *a < *b; }

CS_SORT_DEFINE(sort_keys, uint64_t, is_before)

/* The height of a border's top, which may be below 0, and its number. */
static uint64_t key_of(const cs_map_lines *lines, size_t i) {
  int64_t top = lines->points[lines->borders[i].first].y;
  return (uint64_t)(top - INT32_MIN) << 32 | i;
}

celspan_status cs_map_lines_sort(celspan_context *context, cs_map_lines *lines) {
  size_t count = lines->border_count;
  cs_map_border *sorted;
  uint64_t *keys;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, keys, count));
  celspan_status status = CS_MAKE(context, sorted, count);
  for (size_t i = 0; i < count && status == CELSPAN_OK; i++)
    keys[i] = key_of(lines, i);
  if (status == CELSPAN_OK) {
    sort_keys(keys, count);
    for (size_t i = 0; i < count; i++)
      sorted[i] = lines->borders[keys[i] & UINT32_MAX];
    cs_mem_free(context->memory, lines->borders, lines->border_capacity * sizeof *lines->borders);
    lines->borders = sorted;
    lines->border_capacity = count;
  }
  cs_mem_free(context->memory, keys, count * sizeof *keys);
  return status;
}
