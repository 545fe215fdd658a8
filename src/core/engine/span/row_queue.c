#include "engine/span/row_queue.h"

void cs_row_queue_finish(cs_row_queue *queue, cs_memory *memory) {
  cs_arena_finish(&queue->arrays, memory);
  CS_ARRAYS_FREE(memory, queue, spans, ends);
  *queue = (cs_row_queue){0};
}

void cs_row_queue_clear(cs_row_queue *queue) {
  queue->count = 0;
  cs_arena_reset(&queue->arrays);
}

static size_t spans_so_far(const cs_row_queue *queue) {
  return queue->count > 0 ? queue->ends[queue->count - 1].spans : 0;
}

static celspan_status copy_array(celspan_context *context, cs_row_queue *queue,
                                 celspan_span *span) {
  bool is_coded = span->codes;
  size_t size = (size_t)(span->x1 - span->x0) * (is_coded ? 4 : 4 * sizeof(float));
  void *copy = cs_arena_take(context, &queue->arrays, size);
  if (!copy)
    return CELSPAN_NO_MEMORY;
  memcpy(copy, is_coded ? (const void *)span->codes : span->array, size);
  if (is_coded)
    span->codes = copy;
  else
    span->array = copy;
  return CELSPAN_OK;
}

static celspan_status reserve(celspan_context *context, cs_row_queue *queue, size_t spans) {
  CS_TRY(CS_ARRAY_RESERVE(context, queue->spans, spans));
  return CS_ARRAY_RESERVE(context, queue->ends, queue->count + 1);
}

celspan_status cs_row_queue_add(celspan_context *context, cs_row_queue *queue,
                                const celspan_span *spans, size_t count) {
  size_t first = spans_so_far(queue);
  cs_varied varied = {0};
  CS_TRY(reserve(context, queue, first + count));
  celspan_span *kept = queue->spans + first;
  if (count > 0)
    memcpy(kept, spans, count * sizeof *spans);
  for (size_t i = 0; i < count; i++) {
    cs_varied_count(&varied, kept[i].kind);
    if (kept[i].kind == CELSPAN_SPAN_ARRAY)
      CS_TRY(copy_array(context, queue, &kept[i]));
  }
  queue->ends[queue->count++] = (cs_row_queue_end){first + count, varied};
  return CELSPAN_OK;
}

static size_t colours_size(const celspan_span *spans, size_t count) {
  return (size_t)spans[count - 1].x1 * 4 * sizeof(float);
}

/* Adds a row of one array. *bytes: its room. */
static celspan_status add_array(celspan_context *context, cs_row_queue *queue, int32_t width,
                                size_t size, celspan_span **span, void **bytes) {
  size_t first = spans_so_far(queue);
  CS_TRY(reserve(context, queue, first + 1));
  *bytes = cs_arena_take(context, &queue->arrays, size);
  if (!*bytes)
    return CELSPAN_NO_MEMORY;
  *span = &queue->spans[first];
  **span = (celspan_span){.x1 = width, .kind = CELSPAN_SPAN_ARRAY};
  queue->ends[queue->count++] = (cs_row_queue_end){first + 1, {.arrays = 1}};
  return CELSPAN_OK;
}

celspan_status cs_row_queue_codes(celspan_context *context, cs_row_queue *queue, int32_t width,
                                  size_t size, unsigned char **codes) {
  celspan_span *span;
  void *bytes;
  CS_TRY(add_array(context, queue, width, size, &span, &bytes));
  span->codes = *codes = bytes;
  return CELSPAN_OK;
}

static celspan_status add_colours(celspan_context *context, cs_row_queue *queue,
                                  const celspan_span *spans, size_t count) {
  celspan_span *span;
  void *bytes;
  CS_TRY(add_array(context, queue, spans[count - 1].x1, colours_size(spans, count), &span, &bytes));
  float *colours = bytes;
  for (size_t i = 0; i < count; i++)
    for (int32_t x = spans[i].x0; x < spans[i].x1; x++)
      celspan_span_colour(&spans[i], x, colours + 4 * (size_t)x);
  span->array = colours;
  return CELSPAN_OK;
}

/* A span of two or three pixels is larger than the colours of its pixels. */
celspan_status cs_row_queue_add_small(celspan_context *context, cs_row_queue *queue,
                                      const celspan_span *spans, size_t count) {
  bool is_dense = count > 0 && count * sizeof *spans > colours_size(spans, count);
  return is_dense ? add_colours(context, queue, spans, count)
                  : cs_row_queue_add(context, queue, spans, count);
}

size_t cs_row_queue_bytes(const cs_row_queue *queue) {
  return CS_ARRAYS_BYTES(queue, spans, ends) + cs_arena_bytes(&queue->arrays);
}

cs_row_queue_row cs_row_queue_get(const cs_row_queue *queue, size_t row) {
  size_t first = row > 0 ? queue->ends[row - 1].spans : 0;
  return (cs_row_queue_row){queue->spans + first, queue->ends[row].spans - first,
                            queue->ends[row].varied};
}
