#include "filter/strokes.h"

#include <stddef.h>

/* ---------------------------------------------------------------- alone */

/* The head of a single: where it begins, where it ends, its kind, and where it begins. */
typedef int32_t head __attribute__((vector_size(16)));

_Static_assert(offsetof(celspan_span, x0) == 0 && offsetof(celspan_span, x1) == 4 &&
                   offsetof(celspan_span, kind) == 8 && offsetof(celspan_span, origin) == 12 &&
                   sizeof(celspan_span_kind) == 4 && CELSPAN_SPAN_SINGLE == 0,
               "a span begins as a head does");

static inline head head_at(int32_t x) { return (head){x, x, x, x} & (head){-1, -1, 0, -1}; }

static inline void put_single(celspan_span *span, head at, cs_v4 colour) {
  memcpy(span, &at, sizeof at);
  cs_v4_store(span->colour, colour);
}

/* Over at most two columns, where no neighbouring spans look the same and the cell on the left
 * shows: without a branch on how many columns there are. Returns whether that was so. */
static inline bool draw_plain(cs_pen *pen, int32_t first, int32_t end, cs_v4 base, cs_v4 one,
                              cs_v4 two) {
  bool has_two = end - first > 1;
  if (first <= pen->from || end == first || cs_v4_same(pen->colour, base) ||
      cs_v4_same(base, one) || (cs_v4_same(one, two) & has_two))
    return false;
  head from = head_at(pen->from), at = head_at(first);
  put_single(pen->next, (from & (head){-1, 0, 0, -1}) | (at & (head){0, -1, 0, 0}), base);
  put_single(pen->next + 1, at + (head){0, 1, 0, 0}, one);
  put_single(pen->next + 2, at + (head){1, 2, 0, 1}, two);
  pen->next += 2 + has_two;
  pen->colour = two;
  pen->from = end;
  return true;
}

static inline void draw_short(cs_pen *pen, const cs_edges *edges, size_t i, const cs_cell *left) {
  int32_t first = edges->first[i], end = edges->end[i];
  cs_v4 base = left->colour, step = left[1].colour - base;
  cs_v4 one = cs_strokes_hold(base + step * (float)edges->area[i]);
  cs_v4 two = cs_strokes_hold(base + step * (float)edges->rest[i]);
  if (draw_plain(pen, first, end, base, one, two))
    return;
  cs_pen_to(pen, first, base);
  if (end > first)
    cs_pen_to(pen, first + 1, one);
  if (end > first + 1)
    cs_pen_to(pen, end, two);
}

/* Straight and over more columns: its ends, and a ramp between them. */
static inline void draw_long(cs_pen *pen, const cs_edges *edges, size_t i, const cs_cell *left) {
  int32_t first = edges->first[i], last = edges->end[i] - 1;
  double low = edges->low[i], by_twice = 0.5 / (edges->high[i] - low), split = first + 1;
  cs_v4 base = left->colour, step = left[1].colour - base;
  cs_pen_to(pen, first, base);
  cs_pen_to(pen, first + 1, cs_strokes_hold(base + step * (float)edges->area[i]));
  double second = cs_edges_round((2 * (split - low) + 1) * by_twice);
  cs_v4 ramp = base + step * (float)second;
  cs_v4 slope = step * (float)(2 * by_twice);
  if (last - first > 2 && !cs_v4_same(slope, cs_v4_all(0)))
    cs_pen_ramp(pen, last, ramp, slope);
  else
    cs_pen_to(pen, last, cs_strokes_hold(ramp));
  cs_pen_to(pen, last + 1, cs_strokes_hold(base + step * (float)edges->rest[i]));
}

/* ---------------------------------------------------------------- together
 *
 * change[k] is what the sum of colour steps changes by from the column before to column k. */

/* A straight piece of an edge. */
static void add_piece(cs_sum4 *change, int32_t from, celspan_point above, celspan_point below,
                      double height, int32_t width, const cs_sum4 *step) {
  double low = above.x < below.x ? above.x : below.x, high = above.x < below.x ? below.x : above.x;
  int32_t first = cs_edges_floor(low, width), end = cs_edges_ceil(high, width);
  double before = 0;
  for (int32_t p = first; p < end; p++) {
    double area = cs_edges_cover(above.x, below.x, height, p);
    change[p - from] += *step * (area - before);
    before = area;
  }
  change[end - from] += *step * (height - before);
}

static void add_pieces(cs_sum4 *change, int32_t from, const cs_strokes *s, size_t i,
                       const cs_sum4 *step) {
  const cs_active *active = s->active;
  celspan_point above = {active->x[i], active->y}, foot = {active->x_next[i], active->y_next};
  double passed = 0;
  if (s->edges->is_bent[i]) {
    const cs_bend *bend = &active->bends[s->edges->bend[i]];
    for (uint32_t k = 0; k < bend->vertex_count; k++) {
      celspan_point below = active->vertices[bend->vertex + k];
      double reached = cs_edges_round(below.y - active->y);
      add_piece(change, from, above, below, reached - passed, s->width, step);
      above = below;
      passed = reached;
    }
  }
  add_piece(change, from, above, foot, 1 - passed, s->width, step);
}

static inline void add_edge(cs_sum4 *change, int32_t from, const cs_strokes *s, size_t i) {
  const cs_edges *edges = s->edges;
  int32_t first = edges->first[i], end = edges->end[i];
  const cs_cell *left = &s->cells[i];
  cs_sum4 step = CS_SUM4(left[1].colour) - CS_SUM4(left->colour);
  if (end - first > 2) {
    add_pieces(change, from, s, i, &step);
    return;
  }
  double area = end > first ? edges->area[i] : 1, rest = end > first + 1 ? edges->rest[i] : 1;
  change += first - from;
  change[0] += step * area;
  change[1] += step * (rest - area);
  change[2] += step * (1 - rest);
}

/* How many boundaries from `done` on share pixels with each other and with nothing else; 0: more
 * must be known. end: of their columns. */
static inline size_t find_group(const cs_strokes *s, size_t done, int32_t *end) {
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
  if ((n == s->count && *end > s->next) || *end - from > CS_STROKES_TOGETHER || *end > s->width)
    return 0;
  return n - done;
}

/* Out of line: the loop along the row needs the registers. */
static __attribute__((noinline)) size_t draw_group(cs_pen *pen, const cs_strokes *s, size_t done) {
  int32_t end;
  size_t count = find_group(s, done, &end);
  if (count == 0)
    return 0;
  const uint32_t *boundaries = s->boundaries + done;
  int32_t from = s->edges->first[boundaries[0]];
  size_t spans = (size_t)(end - from) + 1 + CS_STROKES_EACH * (s->count - done - count);
  if ((size_t)(pen->row->spans + pen->row->capacity - pen->next) < spans)
    return 0;
  cs_sum4 change[CS_STROKES_TOGETHER + 3];
  for (int32_t k = 0; k < end - from + 3; k++)
    change[k] = (cs_sum4){0};
  for (size_t k = 0; k < count; k++)
    add_edge(change, from, s, boundaries[k]);
  cs_v4 base = s->cells[boundaries[0]].colour;
  cs_sum4 sum = CS_SUM4(base);
  cs_pen_to(pen, from, base);
  for (int32_t k = 0; k < end - from; k++) {
    sum += change[k];
    cs_pen_to(pen, from + k + 1, cs_strokes_hold(__builtin_convertvector(sum, cs_v4)));
  }
  return count;
}

/* ---------------------------------------------------------------- along the row */

/* As draw_group, with the pen at hand. */
static inline size_t try_group(cs_pen *pen, const cs_strokes *s, size_t done) {
  cs_pen lent = *pen;
  size_t drawn = draw_group(&lent, s, done);
  *pen = lent;
  return drawn;
}

size_t CS_WIDE(cs_strokes_draw)(const cs_strokes *strokes, cs_pen *out) {
  const cs_edges edges = *strokes->edges; /* at hand, whatever is written */
  const cs_cell *cells = strokes->cells;
  const uint32_t *boundaries = strokes->boundaries;
  size_t done = 0, count = strokes->count;
  cs_pen pen = *out;
  while (done < count) {
    size_t i = boundaries[done];
    int32_t first = edges.first[i], end = edges.end[i];
    int32_t next = done + 1 < count ? edges.first[boundaries[done + 1]] : strokes->next;
    const cs_cell *left = &cells[i];
    if (first < pen.from || (left->length | left[1].length) != 0)
      break;
    size_t drawn = 1;
    if (end <= next && end - first <= 2)
      draw_short(&pen, &edges, i, left);
    else if (end <= next && !edges.is_bent[i] && cs_edges_is_inside(&edges, i, strokes->width))
      draw_long(&pen, &edges, i, left);
    else
      drawn = try_group(&pen, strokes, done);
    if (drawn == 0)
      break;
    done += drawn;
  }
  *out = pen;
  return done;
}
