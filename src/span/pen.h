/* A pen writes the end of a row, from left to right: what cs_row_single and cs_row_gradient append,
 * with the row's end kept at hand between calls.
 *
 * Invariant: between cs_pen_take and cs_pen_put nothing else appends to the row, and the row has
 * room for all that is written.
 */
#ifndef CS_SPAN_PEN_H
#define CS_SPAN_PEN_H

#include "span/row.h"

typedef struct cs_pen {
  cs_row *row;
  celspan_span *next;
  cs_v4 colour; /* of the last span, where it is a single; else no colour at all */
  int32_t from; /* where it ends */
} cs_pen;

/* Equal to no colour, not even to itself as a number; compared as bits, no colour has these. */
static inline cs_v4 cs_pen_no_colour(void) { return cs_v4_all(__builtin_nanf("0x1")); }

/* A pen at the end of a row, which is at column `from`. */
static inline cs_pen cs_pen_take(cs_row *row, int32_t from) {
  cs_pen pen = {row, row->spans + row->count, cs_pen_no_colour(), from};
  if (row->count > 0 && pen.next[-1].kind == CELSPAN_SPAN_SINGLE)
    pen.colour = cs_v4_load(pen.next[-1].colour);
  return pen;
}

static inline void cs_pen_put(const cs_pen *pen) {
  pen->row->count = (size_t)(pen->next - pen->row->spans);
}

/* Makes a span a single. */
static inline void cs_pen_span(celspan_span *span, int32_t from, int32_t to, cs_v4 colour) {
  span->x0 = span->origin = from;
  span->x1 = to;
  span->kind = CELSPAN_SPAN_SINGLE;
  cs_v4_store(span->colour, colour);
}

/* One colour up to column `to`; nothing where the pen is there already. */
static inline void cs_pen_to(cs_pen *pen, int32_t to, cs_v4 colour) {
  if (to <= pen->from)
    return;
  if (cs_v4_same(pen->colour, colour)) {
    pen->next[-1].x1 = to;
  } else {
    cs_pen_span(pen->next++, pen->from, to, colour);
    pen->colour = colour;
  }
  pen->from = to;
}

/* A ramp of at least two columns up to `to`. */
static inline void cs_pen_ramp(cs_pen *pen, int32_t to, cs_v4 colour, cs_v4 slope) {
  celspan_span *span = pen->next++;
  span->x0 = span->origin = pen->from;
  span->x1 = to;
  span->kind = CELSPAN_SPAN_GRADIENT;
  cs_v4_store(span->colour, colour);
  cs_v4_store(span->slope, slope);
  pen->row->varied.gradients++;
  pen->colour = cs_pen_no_colour();
  pen->from = to;
}

#endif
