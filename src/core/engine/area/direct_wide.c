/* Drawing direct edges along the row.
 *
 *       from     first   end         first_next
 *       |        |       |           |
 *       +--------+---+---+-----------+---
 *       |  base  |one|two|  base of the next boundary
 *       +--------+---+---+-----------+---
 *         span   span span               a plain edge: three spans, or two over one column
 *
 *       +--------+--------+--------+
 *       |    /###|########|##\     |     edges that share a pixel: their colour steps are summed
 *       |  /#####|#\  /###|####\   |     column by column (draw_group)
 *       +--------+--------+--------+
 *
 * Plain edges come first because nearly all are plain: their code does not depend on a branch that
 * the processor cannot predict.
 */
#include "engine/area/direct.h"

#include "engine/sweep/pieces.h"

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

/* ---------------------------------------------------------------- together */

static void add_piece(cs_sum4 *change, int32_t from, celspan_point above, celspan_point below,
                      double height, int32_t width, const cs_sum4 *step) {
  double low = cs_number_least(above.x, below.x), high = cs_number_most(above.x, below.x);
  cs_direct_add(change, from,
                (cs_direct_piece){above.x, below.x, height, cs_edges_floor(low, width),
                                  cs_edges_ceil(high, width)},
                step);
}

static void add_pieces(cs_sum4 *change, int32_t from, const cs_direct_edges *s, size_t i,
                       const cs_sum4 *step) {
  const cs_active *active = s->active;
  const cs_bend *bend = s->edges->is_bent[i] ? cs_active_bend(active, i) : NULL;
  double passed = 0; /* as a share of the row's height */
  for (cs_pieces p = cs_pieces_of(active, i, bend); cs_pieces_next(&p);) {
    double reached = p.rest > 0 ? cs_cover_round(p.below.y - active->y) : 1;
    add_piece(change, from, p.above, p.below, reached - passed, s->width, step);
    passed = reached;
  }
}

static inline void add_edge(cs_sum4 *change, int32_t from, const cs_direct_edges *s, size_t i) {
  const cs_edges *edges = s->edges;
  int32_t first = edges->first[i], end = edges->end[i];
  const cs_cell *left = &s->cells[i];
  cs_sum4 step = CS_SUM4(left[1].colour) - CS_SUM4(left->colour);
  if (end - first > 2) {
    add_pieces(change, from, s, i, &step);
    return;
  }
  double area = end > first ? edges->area[i] : 1, rest = edges->rest[i];
  change += first - from;
  change[0] += step * area;
  change[1] += step * (rest - area);
  change[2] += step * (1 - rest);
}

/* The number of boundaries from `done` on that share pixels only with each other; 0 if the number
 * is not known, or if the boundaries are too wide. *end: the end of their columns. */
static inline size_t find_group(const cs_direct_edges *s, size_t done, int32_t *end) {
  const cs_edges *edges = s->edges;
  const uint32_t *boundaries = s->boundaries;
  size_t n = done;
  int32_t from = edges->first[boundaries[done]];
  *end = from;
  do {
    size_t i = boundaries[n++];
    if (edges->first[i] < from || (s->cells[i].length | s->cells[i + 1].length) != 0)
      return 0;
    *end = edges->end[i] > *end ? edges->end[i] : *end;
  } while (n < s->count && edges->first[boundaries[n]] < *end);
  if ((n == s->count && *end > s->next) || *end - from > CS_DIRECT_TOGETHER || *end > s->width)
    return 0;
  return n - done;
}

/* Draws a group of boundaries. It is not inlined, because the loop along the row needs the
 * registers. */
static __attribute__((noinline)) size_t draw_group(cs_row_writer *writer, const cs_direct_edges *s,
                                                   size_t done) {
  int32_t end;
  size_t count = find_group(s, done, &end);
  if (count == 0)
    return 0;
  const uint32_t *boundaries = s->boundaries + done;
  int32_t from = s->edges->first[boundaries[0]];
  size_t spans = (size_t)(end - from) + 1 + CS_DIRECT_EACH * (s->count - done - count);
  if ((size_t)(writer->row->spans + writer->row->capacity - writer->next) < spans)
    return 0;
  cs_sum4 change[CS_DIRECT_TOGETHER + 3];
  for (int32_t k = 0; k < end - from + 3; k++)
    change[k] = (cs_sum4){0};
  for (size_t k = 0; k < count; k++)
    add_edge(change, from, s, boundaries[k]);
  cs_v4 base = s->cells[boundaries[0]].colour;
  cs_sum4 sum = CS_SUM4(base);
  cs_row_writer_to(writer, from, base);
  for (int32_t k = 0; k < end - from; k++) {
    sum += change[k];
    cs_row_writer_to(writer, from + k + 1, cs_v4_settled(__builtin_convertvector(sum, cs_v4)));
  }
  return count;
}

/* ---------------------------------------------------------------- along the row */

/* As draw_group, which gets a copy of the writer, so that the writer itself can stay in
 * registers. */
static inline size_t try_group(cs_row_writer *writer, const cs_direct_edges *s, size_t done) {
  cs_row_writer lent = *writer;
  size_t drawn = draw_group(&lent, s, done);
  *writer = lent;
  return drawn;
}

/* Draws the first boundary, and the boundaries that share its pixels. Returns their number, or
 * 0. */
static inline size_t draw_next(cs_row_writer *writer, const cs_direct_edges *s,
                               const cs_edges *edges, size_t done) {
  size_t i = s->boundaries[done];
  int32_t first = edges->first[i], end = edges->end[i];
  int32_t next = done + 1 < s->count ? edges->first[s->boundaries[done + 1]] : s->next;
  const cs_cell *left = &s->cells[i];
  if (first < writer->from || (left->length | left[1].length) != 0)
    return 0;
  if (end > next || (end - first > 2 && !(edges->fall[i] > 0)))
    return try_group(writer, s, done);
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
