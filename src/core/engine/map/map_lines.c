/* Lists of borders: measured, freed, and brought into the order in which rows need them. */
#include "base/keys.h"
#include "engine/map/map.h"

void cs_map_lines_finish(cs_map_lines *lines, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, lines, borders, points);
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

celspan_status cs_map_lines_order(celspan_context *context, const cs_map_point *tops, size_t count,
                                  uint64_t *keys) {
  for (size_t i = 0; i < count; i++)
    keys[i] = cs_key(tops[i].x, i);
  CS_TRY(cs_keys_sort(context, keys, count));
  for (size_t i = 0; i < count; i++) {
    uint32_t number = cs_key_number(keys[i]);
    keys[i] = cs_key(tops[number].y, number);
  }
  return cs_keys_sort(context, keys, count);
}

celspan_status cs_map_lines_make(celspan_context *context, size_t borders, size_t points,
                                 cs_map_lines *out) {
  CS_TRY(CS_ARRAY_FIT(context, out->borders, borders));
  return CS_ARRAY_FIT(context, out->points, points);
}

/* Copies the borders in their order, each with its points. keys: room for one each. */
static celspan_status copy(celspan_context *context, const cs_map_lines *from, cs_map_point *tops,
                           uint64_t *keys, cs_map_lines *out) {
  for (size_t i = 0; i < from->border_count; i++)
    tops[i] = from->points[from->borders[i].first];
  CS_TRY(cs_map_lines_order(context, tops, from->border_count, keys));
  CS_TRY(cs_map_lines_make(context, from->border_count, from->point_count, out));
  for (; out->border_count < from->border_count; out->border_count++) {
    cs_map_border *border = &out->borders[out->border_count];
    *border = from->borders[cs_key_number(keys[out->border_count])];
    const cs_map_point *points = from->points + border->first;
    border->first = (uint32_t)out->point_count;
    for (uint32_t i = 0; i < border->count; i++)
      out->points[out->point_count++] = points[i];
  }
  return CELSPAN_OK;
}

celspan_status cs_map_lines_sort(celspan_context *context, cs_map_lines *lines) {
  size_t count = lines->border_count;
  cs_map_lines sorted = {0};
  cs_map_point *tops = NULL;
  uint64_t *keys;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, keys, count));
  celspan_status status = CS_MAKE(context, tops, count);
  if (status == CELSPAN_OK)
    status = copy(context, lines, tops, keys, &sorted);
  cs_mem_free(context->memory, tops, count * sizeof *tops);
  cs_mem_free(context->memory, keys, count * sizeof *keys);
  cs_map_lines_finish(status == CELSPAN_OK ? lines : &sorted, context->memory);
  if (status == CELSPAN_OK)
    *lines = sorted;
  return status;
}
