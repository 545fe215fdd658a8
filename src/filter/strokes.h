/* Strokes: edges drawn as they are met, straight from what has been measured of them, without a
 * window's fragments: one that shares its pixels with no other, and a few that share pixels with
 * each other and with nothing else. So are nearly all edges of nearly all rows.
 *
 * Invariant: what is drawn is what a window would sum; the bits are the same whichever
 * instructions draw it.
 */
#ifndef CS_FILTER_STROKES_H
#define CS_FILTER_STROKES_H

#include "base/wide.h"
#include "compose/composer.h"
#include "filter/edges.h"
#include "span/pen.h"

/* Spans that an edge takes at most, and columns that edges which share pixels take together. */
#define CS_STROKES_EACH 4
#define CS_STROKES_TOGETHER 32

typedef struct cs_strokes {
  const cs_active *active;
  const cs_edges *edges;
  const cs_cell *cells;       /* as in cs_cells */
  const uint32_t *boundaries; /* `count` of them, to be drawn from left to right */
  size_t count;
  int32_t next; /* nothing that comes after them lies left of this column */
  int32_t width;
} cs_strokes;

/* Draws from the first boundary on, up to one that lies between cells that vary, or that more must
 * be known of. Returns how many. Room for CS_STROKES_EACH spans a boundary and
 * CS_STROKES_TOGETHER more is enough for one at least. */
CS_WIDE_DECLARE(size_t, cs_strokes_draw, (const cs_strokes *strokes, cs_pen *pen));

/* Light is never negative and alpha at most 1: sums may miss that by a last bit. */
static inline cs_v4 cs_strokes_hold(cs_v4 colour) {
  const cs_v4 most = {INFINITY, INFINITY, INFINITY, 1};
  return cs_v4_min(cs_v4_max(colour, cs_v4_all(0)), most);
}

/* Four doubles: sums of colour steps. */
typedef double cs_sum4 __attribute__((vector_size(32)));

/* A function would return it by the rules of AVX. */
#define CS_SUM4(v) __builtin_convertvector(v, cs_sum4)

#endif
