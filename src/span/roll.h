/* A roll: copies of finished rows, one after the other, for whoever takes them later.
 *
 * Invariant: row i of a roll is the i-th that was added since it was cleared; its spans and the
 * arrays they point to stay valid until the next clear, and what a clear leaves reserved is used
 * again.
 */
#ifndef CS_SPAN_ROLL_H
#define CS_SPAN_ROLL_H

#include "span/row.h"

/* Up to the end of a row: how many spans there are, and how many of the row's are not singles. */
typedef struct cs_roll_end {
  size_t spans;
  cs_varied varied;
} cs_roll_end;

typedef struct cs_roll {
  celspan_span *spans;
  cs_roll_end *ends;
  cs_arena arrays;
  size_t count; /* rows */
  size_t span_capacity, end_capacity;
} cs_roll;

typedef struct cs_roll_row {
  const celspan_span *spans;
  size_t count;
  cs_varied varied;
} cs_roll_row;

/* A zeroed roll is empty. */
void cs_roll_finish(cs_roll *roll, cs_memory *memory);
void cs_roll_clear(cs_roll *roll);
/* spans: copied, with their arrays. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_roll_add(celspan_context *context, cs_roll *roll,
                                           const celspan_span *spans, size_t count);
cs_roll_row cs_roll_get(const cs_roll *roll, size_t row);

#endif
