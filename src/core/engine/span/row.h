/* A row of spans under construction.
 *
 *   column   0       3           7               12
 *            |single | gradient  | array         |
 *   colour   |  c    | c + k * s | a0 a1 a2 a3 a4|       k: columns from the span's origin
 *
 *   single    one colour
 *   gradient  a colour at `origin` and a slope: cutting a span does not change its origin, so the
 *             colours that remain keep their bits
 *   array     a colour for every column: four floats, or an 8-bit code in a row that allows codes
 *
 * Invariant: spans are sorted, disjoint and not empty; two neighbouring singles never have the same
 * colour; array colours lie in the row's arena, or at their final place, and are not moved until
 * the next clear.
 */
#pragma once

#include "base/arena.h"
#include "base/arrays.h"
#include "base/vector.h"

/* How many spans of a row are not singles. */
typedef struct cs_varied {
  size_t gradients, arrays;
} cs_varied;

static inline void cs_varied_count(cs_varied *varied, celspan_span_kind kind) {
  varied->gradients += kind == CELSPAN_SPAN_GRADIENT;
  varied->arrays += kind == CELSPAN_SPAN_ARRAY;
}

/* The maker that filled a row, and the number of changes that the maker had counted by then. A
 * maker that gets its own row back fills only the spans that have changed since. Clearing a row or
 * appending to it removes the mark, and only makers read it (engine/row/centre.h). */
typedef struct cs_row_mark {
  const void *maker; /* NULL: unknown */
  uint64_t changes;
} cs_row_mark;

typedef struct cs_row {
  CS_ARRAY(celspan_span, spans);
  size_t count;
  cs_varied varied;
  bool takes_codes; /* arrays may be codes: celspan_sink.takes_codes */
  /* The final place of the codes, from column 0 on; NULL: not known. */
  unsigned char *pixels;
  cs_arena colours;
  cs_row_mark made_by;
} cs_row;

void cs_row_init(cs_row *row);
void cs_row_finish(cs_row *row, cs_memory *memory);
void cs_row_clear(cs_row *row);

/* Appends [x0, x1), or nothing if that is empty. x0 is at or right of the end of the last span. */
CELSPAN_CHECKED celspan_status cs_row_gradient(celspan_context *context, cs_row *row, int32_t x0,
                                               int32_t x1, cs_v4 colour, cs_v4 slope);
/* *colours: room for x1 - x0 colours, to be filled by the caller. */
CELSPAN_CHECKED celspan_status cs_row_array(celspan_context *context, cs_row *row, int32_t x0,
                                            int32_t x1, float **colours);
/* The same with codes, 4 bytes a pixel, in a row that takes codes. If the final places of the codes
 * are known and there are only arrays on their left, the codes lie in these places. Codes to the
 * right of other spans do not lie there, because those spans may be written beyond their ends
 * before the spans right of them are written (output/sinks/pixels8_wide.c). */
CELSPAN_CHECKED celspan_status cs_row_codes(celspan_context *context, cs_row *row, int32_t x0,
                                            int32_t x1, unsigned char **codes);
CELSPAN_CHECKED celspan_status cs_row_grow(celspan_context *context, cs_row *row);
/* Makes room for `count` spans in all. */
static inline CELSPAN_CHECKED celspan_status cs_row_room(celspan_context *context, cs_row *row,
                                                         size_t count) {
  return CS_ARRAY_RESERVE(context, row->spans, count);
}
/* Makes room for `more` spans after those that the row has. */
static inline CELSPAN_CHECKED celspan_status cs_row_reserve(celspan_context *context, cs_row *row,
                                                            size_t more) {
  return cs_row_room(context, row, row->count + more);
}

static inline celspan_status cs_row_single(celspan_context *context, cs_row *row, int32_t x0,
                                           int32_t x1, cs_v4 colour) {
  if (x1 <= x0)
    return CELSPAN_OK;
  if (row->count > 0) {
    celspan_span *last = &row->spans[row->count - 1];
    if (last->kind == CELSPAN_SPAN_SINGLE && last->x1 == x0 &&
        cs_v4_same(cs_v4_load(last->colour), colour)) {
      last->x1 = x1;
      return CELSPAN_OK;
    }
  }
  if (row->count == row->spans_room.capacity)
    CS_TRY(cs_row_grow(context, row));
  celspan_span *span = &row->spans[row->count++];
  span->x0 = x0;
  span->x1 = x1;
  span->kind = CELSPAN_SPAN_SINGLE;
  span->origin = x0;
  cs_v4_store(span->colour, colour);
  return CELSPAN_OK;
}

/* The columns [x, stop) of a span, colour by colour. */
void cs_row_spread_span(const celspan_span *span, int32_t x, int32_t stop, cs_v4 *out);

/* Cuts a row to the columns [x0, x1) and moves it left by x0. The colours do not change. */
void cs_row_crop(cs_row *row, int32_t x0, int32_t x1);

/* Adds clear columns from column 0 to the first span, and from the last span to `width`. The row
 * has a span. */
CELSPAN_CHECKED celspan_status cs_row_fill(celspan_context *context, cs_row *row, int32_t width);

/* Appends the part of another row in the columns [x0, x1), which are to the right of all columns of
 * `out`. */
CELSPAN_CHECKED celspan_status cs_row_append(celspan_context *context, cs_row *out,
                                             const cs_row *row, int32_t x0, int32_t x1);

/* out = sum of weights[i] * rows[i], alpha at most 1: the exposures of one frame. All rows cover
 * the same columns without gaps. space: the space of all colours; in every space, it is light that
 * is added. */
CELSPAN_CHECKED celspan_status cs_row_expose(celspan_context *context, cs_row *out,
                                             celspan_space space, const cs_row *rows,
                                             const float *weights, size_t count);

/* Self-check: whether the spans cover the columns [0, width) without gap or overlap, none empty, no
 * two neighbouring singles have the same colour, and `varied` counts the other spans. */
bool cs_row_is_whole(const cs_row *row, int32_t width);
