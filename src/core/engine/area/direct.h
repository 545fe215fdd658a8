/* Direct edges: boundaries that are drawn into the row at once, from their measurements, without
 * the borders of a window. This works for an edge that shares its pixels with no other edge, as
 * nearly all edges of nearly all rows.
 *
 *              first           end           first, end: the columns that the edge crosses
 *              |               |
 *      +---+---+---+---+---+---+---+---+
 *      | L | L |  .|-##|###|###| R | R |     L, R: the cells on its sides
 *      +---+---+---+---+---+---+---+---+
 *                one  sec +fall two          the share of a pixel right of the edge: `one` in the
 *                   \_______/                first column, `two` in the last, `second` in the
 *                     ramp                   second, then `fall` more in each column
 *
 *      pixel = L + share * (R - L)
 *
 * Invariant: the pixels are those that a window would sum, and the instructions that draw them do
 * not change their bits.
 */
#pragma once

#include "base/wide.h"
#include "engine/area/edges.h"
#include "engine/compose/composer.h"
#include "engine/span/row_writer.h"

#define CS_DIRECT_EACH 4 /* the most spans that one edge becomes */

typedef struct cs_direct_edges {
  const cs_active *active;
  const cs_edges *edges;
  const cs_cell *cells;       /* as in cs_cells */
  const uint32_t *boundaries; /* `count` of them, to be drawn from left to right */
  size_t count;
  int32_t next; /* everything that is drawn later lies at or right of this column */
} cs_direct_edges;

/* Draws boundaries from the first one on and returns how many. It ends before a boundary between
 * cells that vary along the row, and before a boundary that only a window can draw. The boundaries
 * need room for CS_DIRECT_EACH spans each. */
CS_WIDE_DECLARE(size_t, cs_direct_draw, (const cs_direct_edges *direct, cs_row_writer *writer));

/* The area right of a straight edge in the pixels of a row, as the weight of colours: in the first
 * column that the edge crosses, in the second and in the last; for the columns between them, the
 * growth of the area from column to column. */
typedef struct cs_direct_shares {
  float one, second, two, fall;
} cs_direct_shares;

/* Draws an edge over more than two columns, [first, last]: its ends, and a ramp between them. base:
 * the colour on its left; step: the difference to the colour on its right. */
static inline void cs_direct_ramp(cs_row_writer *writer, int32_t first, int32_t last, cs_v4 base,
                                  cs_v4 step, cs_direct_shares shares) {
  cs_v4 ramp = base + step * shares.second, slope = step * shares.fall;
  cs_row_writer_to(writer, first, base);
  cs_row_writer_to(writer, first + 1, cs_v4_settled(base + step * shares.one));
  if (last - first > 2 && !cs_v4_same(slope, cs_v4_all(0)))
    cs_row_writer_gradient(writer, last, ramp, slope);
  else
    cs_row_writer_to(writer, last, cs_v4_settled(ramp));
  cs_row_writer_to(writer, last + 1, cs_v4_settled(base + step * shares.two));
}

/* Four doubles: sums of colour steps. The alignment is what every allocator gives. */
typedef double cs_sum4 __attribute__((vector_size(32), aligned(16)));

/* Makes four doubles from a cs_v4. A macro, because a function that returns them would need the
 * calling rules of AVX. */
#define CS_SUM4(v) __builtin_convertvector(v, cs_sum4)

/* A straight piece of an edge, and the columns [first, end) that it crosses. */
typedef struct cs_direct_piece {
  double xa, xb; /* x at the top and at the foot of the piece */
  double height; /* share of the row's height */
  int32_t first, end;
} cs_direct_piece;

/* Adds a straight piece to sums by column: change[k] is the difference between column `from` + k
 * and the column before it. step: the difference between the colours on the right and on the left
 * of the piece. The processor can hardly predict which columns a piece crosses, so the only branch
 * here is for more than two columns. */
static inline void cs_direct_add(cs_sum4 *change, int32_t from, cs_direct_piece piece,
                                 const cs_sum4 *step) {
  const int32_t first = piece.first, end = piece.end;
  const double xa = piece.xa, xb = piece.xb, height = piece.height;
  double low = cs_number_least(xa, xb), high = cs_number_most(xa, xb);
  double by_twice = cs_cover_by_twice(low, high), before = 0;
  change += first - from;
  if (end - first <= 2 && low >= first && high <= end) { /* nearly all pieces are such */
    double split = first + 1, most = cs_number_most(high, split);
    double area = cs_cover_round(height * cs_cover_passed(low, high, by_twice, split));
    double rest = cs_cover_round(height * cs_cover_last(most, split, by_twice));
    change[0] += *step * area;
    change[1] += *step * (rest - area);
    change[2] += *step * (height - rest);
    return;
  }
  double sum = cs_cover_passed(low, high, by_twice, first);
  for (int32_t p = first; p < end; p++) {
    double last = sum;
    sum = cs_cover_passed(low, high, by_twice, p + 1);
    double area = cs_cover_round(height * (sum - last));
    *change++ += *step * (area - before);
    before = area;
  }
  *change += *step * (height - before);
}
