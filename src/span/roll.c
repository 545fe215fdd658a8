#include "span/roll.h"

void cs_roll_finish(cs_roll *roll, cs_memory *memory) {
  cs_arena_finish(&roll->arrays, memory);
  cs_mem_free(memory, roll->spans, roll->span_capacity * sizeof *roll->spans);
  cs_mem_free(memory, roll->ends, roll->end_capacity * sizeof *roll->ends);
  *roll = (cs_roll){0};
}

void cs_roll_clear(cs_roll *roll) {
  roll->count = 0;
  cs_arena_reset(&roll->arrays);
}

static size_t spans_so_far(const cs_roll *roll) {
  return roll->count > 0 ? roll->ends[roll->count - 1].spans : 0;
}

static celspan_status copy_array(celspan_context *context, cs_roll *roll, celspan_span *span) {
  bool is_coded = span->codes;
  size_t size = (size_t)(span->x1 - span->x0) * (is_coded ? 4 : 4 * sizeof(float));
  void *copy = cs_arena_take(context, &roll->arrays, size);
  if (!copy)
    return CELSPAN_NO_MEMORY;
  memcpy(copy, is_coded ? (const void *)span->codes : span->array, size);
  if (is_coded)
    span->codes = copy;
  else
    span->array = copy;
  return CELSPAN_OK;
}

celspan_status cs_roll_add(celspan_context *context, cs_roll *roll, const celspan_span *spans,
                           size_t count) {
  size_t first = spans_so_far(roll);
  cs_varied varied = {0};
  CS_TRY(cs_mem_reserve(context, (void **)&roll->spans, &roll->span_capacity, first + count,
                        sizeof *roll->spans));
  CS_TRY(cs_mem_reserve(context, (void **)&roll->ends, &roll->end_capacity, roll->count + 1,
                        sizeof *roll->ends));
  celspan_span *kept = roll->spans + first;
  if (count > 0)
    memcpy(kept, spans, count * sizeof *spans);
  for (size_t i = 0; i < count; i++) {
    cs_varied_count(&varied, kept[i].kind);
    if (kept[i].kind == CELSPAN_SPAN_ARRAY)
      CS_TRY(copy_array(context, roll, &kept[i]));
  }
  roll->ends[roll->count++] = (cs_roll_end){first + count, varied};
  return CELSPAN_OK;
}

cs_roll_row cs_roll_get(const cs_roll *roll, size_t row) {
  size_t first = row > 0 ? roll->ends[row - 1].spans : 0;
  return (cs_roll_row){roll->spans + first, roll->ends[row].spans - first, roll->ends[row].varied};
}
