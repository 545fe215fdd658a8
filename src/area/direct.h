/* Strokes: edges drawn as they are met, straight from what has been measured of them, without a
 * window's fragments: one that shares its pixels with no other, and a few that share pixels with
 * each other and with nothing else. So are nearly all edges of nearly all rows.
 *
 * Invariant: what is drawn is what a window would sum; the bits are the same whichever
 * instructions draw it.
 */
#ifndef CS_AREA_DIRECT_H
#define CS_AREA_DIRECT_H

#include "area/edges.h"
#include "base/wide.h"
#include "compose/composer.h"
#include "span/row_writer.h"

/* Spans that an edge takes at most, and columns that edges which share pixels take together. */
#define CS_DIRECT_EACH 4
#define CS_DIRECT_TOGETHER 32

typedef struct cs_direct_edges {
  const cs_active *active;
  const cs_edges *edges;
  const cs_cell *cells;       /* as in cs_cells */
  const uint32_t *boundaries; /* `count` of them, to be drawn from left to right */
  size_t count;
  int32_t next; /* nothing that comes after them lies left of this column */
  int32_t width;
} cs_direct_edges;

/* Draws from the first boundary on, up to one that lies between cells that vary, or that more must
 * be known of. Returns how many. Room for CS_DIRECT_EACH spans a boundary and
 * CS_DIRECT_TOGETHER more is enough for one at least. */
CS_WIDE_DECLARE(size_t, cs_direct_draw, (const cs_direct_edges *direct, cs_row_writer *writer));

/* Light is never negative and alpha at most 1: sums may miss that by a last bit. */
static inline cs_v4 cs_direct_hold(cs_v4 colour) {
  const cs_v4 most = {INFINITY, INFINITY, INFINITY, 1};
  return cs_v4_min(cs_v4_max(colour, cs_v4_all(0)), most);
}

/* What is right of a straight edge in the pixels of a row, as colours are weighted by it: in the
 * first column it crosses, in the second and the last, and what each column between has more. */
typedef struct cs_direct_edge {
  float one, second, two, fall;
} cs_direct_edge;

/* Draws one over more than two columns, [first, last]: its ends, and a ramp between them. */
static inline void cs_direct_ramp(cs_row_writer *writer, int32_t first, int32_t last, cs_v4 base,
                                  cs_v4 step, cs_direct_edge stroke) {
  cs_v4 ramp = base + step * stroke.second, slope = step * stroke.fall;
  cs_row_writer_to(writer, first, base);
  cs_row_writer_to(writer, first + 1, cs_direct_hold(base + step * stroke.one));
  if (last - first > 2 && !cs_v4_same(slope, cs_v4_all(0)))
    cs_row_writer_ramp(writer, last, ramp, slope);
  else
    cs_row_writer_to(writer, last, cs_direct_hold(ramp));
  cs_row_writer_to(writer, last + 1, cs_direct_hold(base + step * stroke.two));
}

/* Four doubles: sums of colour steps. Aligned as memory is that nobody aligned. */
typedef double cs_sum4 __attribute__((vector_size(32), aligned(16)));

/* A function would return it by the rules of AVX. */
#define CS_SUM4(v) __builtin_convertvector(v, cs_sum4)

/* Adds to change[k] what a straight piece, from xa to xb over a share of the row's height, adds to
 * the sum from column `from` + k - 1 to the next. It crosses the columns [first, end); step: of
 * colour, from its left to its right. Which columns a piece crosses cannot be foreseen: nothing
 * here is a branch but whether they are more than two. */
static inline void cs_direct_add(cs_sum4 *change, int32_t from, double xa, double xb, double height,
                                 int32_t first, int32_t end, const cs_sum4 *step) {
  const double thin = 0x1p-100; /* at least: of 0 width it is 0 from 0, all in one column */
  double low = cs_number_least(xa, xb), high = cs_number_most(xa, xb);
  double by_twice = 0.5 / cs_number_most(high - low, thin), before = 0;
  change += first - from;
  if (end - first <= 2 && low >= first && high <= end) { /* as nearly all */
    double split = first + 1, until = cs_number_least(high, split) - low;
    double beyond = cs_number_most(high - split, 0), short_of = cs_number_most(split - high, 0);
    double area = cs_edges_round(height * (until * until * by_twice + short_of));
    double rest = cs_edges_round(height * (1 - beyond * beyond * by_twice));
    change[0] += *step * area;
    change[1] += *step * (rest - area);
    change[2] += *step * (height - rest);
    return;
  }
  double passed = cs_number_most(cs_number_least(first, high) - low, 0);
  double sum = passed * passed * by_twice + cs_number_most(first - high, 0);
  for (int32_t p = first; p < end; p++) {
    double last = sum;
    passed = cs_number_most(cs_number_least(p + 1, high) - low, 0);
    sum = passed * passed * by_twice + cs_number_most(p + 1 - high, 0);
    double area = cs_edges_round(height * (sum - last));
    *change++ += *step * (area - before);
    before = area;
  }
  *change += *step * (height - before);
}

#endif
