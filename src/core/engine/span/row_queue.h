/* A row queue: copies of finished rows, one after the other, to be read later.
 *
 *   spans   [ row 0 | row 1        | row 2   |            ends[i]: where row i ends
 *
 * Invariant: row i of a queue is the i-th that was added since it was cleared. Its spans and the
 * arrays they point to are valid until the next clear, which keeps the memory for the next rows.
 */
#pragma once

#include "engine/span/row.h"

/* Where a row ends: the number of spans up to there; and how many of its spans are not singles. */
typedef struct cs_row_queue_end {
  size_t spans;
  cs_varied varied;
} cs_row_queue_end;

typedef struct cs_row_queue {
  CS_ARRAY(celspan_span, spans);
  CS_ARRAY(cs_row_queue_end, ends);
  cs_arena arrays;
  size_t count; /* rows */
} cs_row_queue;

typedef struct cs_row_queue_row {
  const celspan_span *spans;
  size_t count;
  cs_varied varied;
} cs_row_queue_row;

/* A zeroed queue is empty. */
void cs_row_queue_finish(cs_row_queue *queue, cs_memory *memory);
void cs_row_queue_clear(cs_row_queue *queue);
/* spans: copied, with their arrays, where codes have 4 bytes a pixel. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_row_queue_add(celspan_context *context, cs_row_queue *queue,
                                                const celspan_span *spans, size_t count);
/* The same for a row without gaps from column 0 on. It is stored as one array of colours where that
 * is smaller than its spans. */
CELSPAN_CHECKED celspan_status cs_row_queue_add_small(celspan_context *context, cs_row_queue *queue,
                                                      const celspan_span *spans, size_t count);
/* Adds a row that is one array of codes. *codes: room for `size` bytes, to be filled by the
 * caller. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_row_queue_codes(celspan_context *context, cs_row_queue *queue,
                                                  int32_t width, size_t size,
                                                  unsigned char **codes);
/* All bytes that it has allocated. */
size_t cs_row_queue_bytes(const cs_row_queue *queue);
cs_row_queue_row cs_row_queue_get(const cs_row_queue *queue, size_t row);
