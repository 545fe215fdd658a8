/* Drawing direct edges along the row.
 *
 *       from     first   end         first_next
 *       |        |       |           |
 *       +--------+---+---+-----------+---
 *       |  base  |one|two|  base of the next boundary
 *       +--------+---+---+-----------+---
 *         span   span span               a plain edge: three spans, or two over one column
 *
 * Plain edges come first because nearly all are plain: their code does not depend on a branch that
 * the processor cannot predict.
 */
#include "engine/area/direct.h"

#include <stddef.h>

/* ---------------------------------------------------------------- alone */

/* The head of a span: x0, x1, its kind, and its origin, which is the same as x0. */
typedef int32_t head __attribute__((vector_size(16)));

_Static_assert(offsetof(celspan_span, x0) == 0 && offsetof(celspan_span, x1) == 4 &&
                   offsetof(celspan_span, kind) == 8 && offsetof(celspan_span, origin) == 12 &&
                   sizeof(celspan_span_kind) == 4 && CELSPAN_SPAN_SINGLE == 0 &&
                   CELSPAN_SPAN_GRADIENT == 1,
               "a span begins as a head does");

static inline head head_at(int32_t x) { return (head){x, x, x, x} & (head){-1, -1, 0, -1}; }

static inline void put_span(celspan_span *span, head at, cs_v4 colour) {
  memcpy(span, &at, sizeof at);
  cs_v4_store(span->colour, colour);
}

/* Writes the span between the ends of a straight edge over more than two columns: a ramp, or one
 * pixel of this ramp. Returns false if the span might have the colour of a neighbour, or if the
 * ramp has no slope. */
static inline bool put_middle(celspan_span *span, head at, int32_t columns, cs_v4 ramp, cs_v4 slope,
                              cs_v4 one, cs_v4 two) {
  bool is_ramp = columns > 3;
  cs_v4 middle = cs_v4_choose(is_ramp, ramp, cs_v4_settled(ramp));
  if (cs_v4_same(slope, cs_v4_all(0)) || cs_v4_same(one, middle) || cs_v4_same(middle, two))
    return false;
  put_span(span, at + (head){1, columns - 1, is_ramp, 1}, middle);
  cs_v4_store(span->slope, slope); /* the slope of a single span is never read */
  return true;
}

/* Writes the spans of boundary i: its left cell from `start` on, and its columns from `first` on.
 * For an edge over one or two columns, two spans are always written, so that no branch is needed.
 * Returns the end of the spans. NULL: two neighbours would have the same colour, or the edge needs
 * another function. */
static inline celspan_span *put_plain(celspan_span *span, head start, int32_t first,
                                      const cs_edges *edges, size_t i, const cs_cell *left) {
  int32_t columns = edges->end[i] - first;
  cs_v4 base = left->colour, step = left[1].colour - base;
  cs_v4 one = cs_v4_settled(base + step * edges->one[i]);
  cs_v4 two = cs_v4_settled(base + step * edges->two[i]);
  if (cs_v4_same(cs_v4_load(span[-1].colour), base) || cs_v4_same(base, one) ||
      cs_v4_same(one, two))
    return NULL;
  head at = head_at(first);
  put_span(span, (start & (head){-1, 0, 0, -1}) | (at & (head){0, -1, 0, 0}), base);
  put_span(span + 1, at + (head){0, 1, 0, 0}, one);
  if (columns <= 2) {
    put_span(span + 2, at + (head){1, 2, 0, 1}, two);
    return span + columns + 1;
  }
  float fall = edges->fall[i];
  if (!(fall > 0) ||
      !put_middle(span + 2, at, columns, base + step * edges->second[i], step * fall, one, two))
    return NULL;
  put_span(span + 3, at + (head){columns - 1, columns, 0, columns - 1}, two);
  return span + 4;
}

/* Draws the plain boundaries from the first one on. A plain boundary is straight or crosses one or
 * two columns, share no pixel, lie between flat cells and give spans of different colours. Returns
 * their number. The last boundary is never among them. */
static inline size_t draw_plain(cs_row_writer *writer, const cs_direct_edges *s,
                                const cs_edges *edges, size_t done) {
  const uint32_t *boundaries = s->boundaries + done;
  size_t n = 0, last = s->count - done - 1, i = boundaries[0], ramps = 0;
  int32_t first = edges->first[i], from = writer->from;
  celspan_span *span = writer->next, *next;
  if (span == writer->row->spans)
    return 0;
  head start = head_at(from);
  while (n < last) {
    size_t i_next = boundaries[n + 1];
    int32_t end = edges->end[i], first_next = edges->first[i_next];
    const cs_cell *left = &s->cells[i];
    if (end > first_next || end == first || first <= from || (left->length | left[1].length) != 0 ||
        !(next = put_plain(span, start, first, edges, i, left)))
      break;
    ramps += end - first > 3;
    span = next;
    start = head_at(from = end);
    i = i_next;
    first = first_next;
    n++;
  }
  if (n > 0)
    writer->colour = cs_v4_load(span[-1].colour);
  writer->row->varied.gradients += ramps;
  writer->next = span;
  writer->from = from;
  return n;
}

/* Draws an edge over at most two columns. */
static inline void draw_short(cs_row_writer *writer, const cs_edges *edges, size_t i,
                              const cs_cell *left) {
  int32_t first = edges->first[i], end = edges->end[i];
  cs_v4 base = left->colour, step = left[1].colour - base;
  cs_row_writer_to(writer, first, base);
  if (end > first)
    cs_row_writer_to(writer, first + 1, cs_v4_settled(base + step * edges->one[i]));
  if (end > first + 1)
    cs_row_writer_to(writer, end, cs_v4_settled(base + step * edges->two[i]));
}

/* ---------------------------------------------------------------- along the row */

/* Draws the first boundary if no other shares its pixels. Returns how many it has drawn. */
static inline size_t draw_next(cs_row_writer *writer, const cs_direct_edges *s,
                               const cs_edges *edges, size_t done) {
  size_t i = s->boundaries[done];
  int32_t first = edges->first[i], end = edges->end[i];
  int32_t next = done + 1 < s->count ? edges->first[s->boundaries[done + 1]] : s->next;
  const cs_cell *left = &s->cells[i];
  if (first < writer->from || (left->length | left[1].length) != 0 || end > next ||
      (end - first > 2 && !(edges->fall[i] > 0)))
    return 0;
  if (end - first > 2)
    cs_direct_ramp(
        writer, first, end - 1, left->colour, left[1].colour - left->colour,
        (cs_direct_shares){edges->one[i], edges->second[i], edges->two[i], edges->fall[i]});
  else
    draw_short(writer, edges, i, left);
  return 1;
}

size_t CS_WIDE(cs_direct_draw)(const cs_direct_edges *direct, cs_row_writer *out) {
  /* A copy, which can stay in registers since no store changes it. */
  const cs_direct_edges s = *direct;
  const cs_edges edges = *direct->edges;
  cs_row_writer writer = *out;
  size_t done = 0, drawn = 1;
  while (done < s.count && drawn > 0) {
    done += draw_plain(&writer, &s, &edges, done);
    drawn = draw_next(&writer, direct, &edges, done);
    done += drawn;
  }
  *out = writer;
  return done;
}
