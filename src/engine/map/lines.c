/* Lists of borders: measured, freed, and brought into the order in which rows need them. */
#include "base/keys.h"
#include "engine/map/map.h"

void cs_map_lines_finish(cs_map_lines *lines, cs_memory *memory) {
  cs_mem_free(memory, lines->borders, lines->border_capacity * sizeof *lines->borders);
  cs_mem_free(memory, lines->points, lines->point_capacity * sizeof *lines->points);
  *lines = (cs_map_lines){0};
}

cs_map_border cs_map_lines_border(const cs_map_lines *lines, size_t first, uint32_t left,
                                  uint32_t right) {
  cs_map_border border = {.left = left,
                          .right = right,
                          .first = (uint32_t)first,
                          .count = (uint32_t)(lines->point_count - first),
                          .low = INT32_MAX,
                          .high = INT32_MIN,
                          .foot = lines->points[lines->point_count - 1].y};
  for (size_t k = first; k < lines->point_count; k++) {
    int32_t x = lines->points[k].x;
    border.low = x < border.low ? x : border.low;
    border.high = x > border.high ? x : border.high;
  }
  return border;
}

static celspan_status sort(celspan_context *context, cs_map_lines *lines, uint64_t *keys) {
  size_t count = lines->border_count;
  cs_map_border *sorted;
  for (size_t i = 0; i < count; i++)
    keys[i] = cs_key(lines->points[lines->borders[i].first].x, i);
  CS_TRY(cs_keys_sort(context, keys, count));
  for (size_t i = 0; i < count; i++) {
    uint32_t border = cs_key_number(keys[i]);
    keys[i] = cs_key(lines->points[lines->borders[border].first].y, border);
  }
  CS_TRY(cs_keys_sort(context, keys, count));
  CS_TRY(CS_MAKE(context, sorted, count));
  for (size_t i = 0; i < count; i++)
    sorted[i] = lines->borders[cs_key_number(keys[i])];
  cs_mem_free(context->memory, lines->borders, lines->border_capacity * sizeof *lines->borders);
  lines->borders = sorted;
  lines->border_capacity = count;
  return CELSPAN_OK;
}

celspan_status cs_map_lines_sort(celspan_context *context, cs_map_lines *lines) {
  size_t count = lines->border_count;
  uint64_t *keys;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, keys, count));
  celspan_status status = sort(context, lines, keys);
  cs_mem_free(context->memory, keys, count * sizeof *keys);
  return status;
}
