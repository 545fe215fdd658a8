/* A row writer appends to a row, from left to right, what cs_row_single and cs_row_gradient append.
 * It keeps the end of the row in registers between calls.
 *
 *   row   | span | span | . . .
 *                       ^
 *                       next: the span that is written next; from: its first column
 *
 * Invariant: between cs_row_writer_begin and cs_row_writer_end nothing else appends to the row, and
 * the row has room for all spans that are written.
 */
#pragma once

#include "engine/span/row.h"

typedef struct cs_row_writer {
  cs_row *row;
  celspan_span *next;
  cs_v4 colour; /* the colour of the last span, if that is a single; else no colour */
  int32_t from; /* the column where the last span ends */
} cs_row_writer;

/* A NaN: equal to no colour as numbers; no colour has these bits either. */
static inline cs_v4 cs_row_writer_no_colour(void) { return cs_v4_all(__builtin_nanf("0x1")); }

/* A writer at the end of a row, which is at column `from`. */
static inline cs_row_writer cs_row_writer_begin(cs_row *row, int32_t from) {
  cs_row_writer writer = {row, row->spans + row->count, cs_row_writer_no_colour(), from};
  if (row->count > 0 && writer.next[-1].kind == CELSPAN_SPAN_SINGLE)
    writer.colour = cs_v4_load(writer.next[-1].colour);
  return writer;
}

static inline void cs_row_writer_end(const cs_row_writer *writer) {
  writer->row->count = (size_t)(writer->next - writer->row->spans);
}

/* Makes a span a single. */
static inline void cs_row_writer_span(celspan_span *span, int32_t from, int32_t to, cs_v4 colour) {
  span->x0 = span->origin = from;
  span->x1 = to;
  span->kind = CELSPAN_SPAN_SINGLE;
  cs_v4_store(span->colour, colour);
}

/* One colour up to column `to`; nothing if the writer is there already. */
static inline void cs_row_writer_to(cs_row_writer *writer, int32_t to, cs_v4 colour) {
  if (to <= writer->from)
    return;
  if (cs_v4_same(writer->colour, colour)) {
    writer->next[-1].x1 = to;
  } else {
    cs_row_writer_span(writer->next++, writer->from, to, colour);
    writer->colour = colour;
  }
  writer->from = to;
}

/* A gradient of at least two columns up to `to`. */
static inline void cs_row_writer_gradient(cs_row_writer *writer, int32_t to, cs_v4 colour,
                                          cs_v4 slope) {
  celspan_span *span = writer->next++;
  span->x0 = span->origin = writer->from;
  span->x1 = to;
  span->kind = CELSPAN_SPAN_GRADIENT;
  cs_v4_store(span->colour, colour);
  cs_v4_store(span->slope, slope);
  writer->row->varied.gradients++;
  writer->colour = cs_row_writer_no_colour();
  writer->from = to;
}
