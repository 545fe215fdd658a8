/* Windows: the pixels of a row that boundaries cross, summed from fragments.
 *
 * Composite first, integrate after: each visible piece of boundary (a fragment: straight, between
 * two cells whose looks do not change beside it) adds its colour step times the area right of it in
 * every pixel. Between windows a row is whole cells. So coverage is never used as alpha, and
 * abutting shapes cannot leak.
 *
 * Areas are rounded to multiples of 2^-28 such that the pieces of a whole pixel sum to it exactly:
 * a pixel that abutting black shapes cover together is black, not nearly so.
 *
 * Invariants: a window's pixels are summed from its own fragments only, starting from the exact
 * colour of the cell on its left; windows and cells tile [0, width). Items (lone boundaries or
 * clusters) come from left to right. Between windows `change` is all 0.
 */
#ifndef CS_AREA_WINDOW_H
#define CS_AREA_WINDOW_H

#include "area/direct.h"
#include "kernel/retained.h"
#include "paint/painter.h"

#define CS_WINDOW_NARROW CS_DIRECT_TOGETHER /* columns of nearly all windows */

typedef struct cs_segment {
  double xa, xb; /* at its top and at its bottom */
  double height; /* of the row: 0..1, a multiple of 2^-28 */
  const cs_cell *left, *right;
  int32_t first, end; /* the columns it crosses; empty when it stands on a pixel's edge */
} cs_segment;

typedef struct cs_window {
  const cs_composer *composer;
  cs_painter *painter;
  cs_arena *arena;
  cs_row *out;
  double centre;       /* height of the row's centre */
  int32_t width;       /* of the row */
  int32_t from;        /* nothing is written from here on */
  int32_t end;         /* of the open window; from when it is empty */
  const cs_cell *base; /* left of the window */
  const cs_cell *cell; /* right of all items so far */
  cs_segment *segments;
  size_t segment_count, segment_capacity;
  bool is_open, varies;
  /* what flat fragments that end so near its left end add to the sum from column to column */
  cs_sum4 change[CS_WINDOW_NARROW + 3];
  bool is_held;              /* the whole row is one window: items may come in any order */
  cs_arena tiles;            /* of one tile's weights; the window's own */
  cs_retained_row *retained; /* not NULL: fragments are kept there, and no pixels made */
} cs_window;

/* Begins a row at `leftmost`; the fragments' room is kept from row to row. */
void cs_window_begin(cs_window *window, cs_painter *painter, cs_arena *arena, int32_t width,
                     int32_t y, const cs_cell *leftmost, cs_row *out);
void cs_window_free(cs_window *window, cs_memory *memory);

/* Makes one window of the whole row. */
void cs_window_hold(cs_window *window);
/* An item begins whose least x is `x`: closes the window when it ends before. */
CELSPAN_CHECKED celspan_status cs_window_reach(cs_window *window, double x);
/* A fragment of the current item, from (xa, ya) to (xb, yb). */
CELSPAN_CHECKED celspan_status cs_window_add(cs_window *window, double xa, double ya, double xb,
                                             double yb, const cs_cell *left, const cs_cell *right);
/* Whole items: boundaries through the whole row, straight or bent, to which nothing else happens.
 * boundaries: `count` of them, from left to right; cells: as in cs_cells.
 * next: nothing that comes after them lies left of this column. */
CELSPAN_CHECKED celspan_status cs_window_edges(cs_window *window, const cs_active *active,
                                               const cs_edges *edges, const cs_cell *cells,
                                               const uint32_t *boundaries, size_t count,
                                               int32_t next);
/* Boundary i through what is left of the row or through a slice of it: a part of an item. */
CELSPAN_CHECKED celspan_status cs_window_slice(cs_window *window, const cs_active *active,
                                               const cs_edges *edges, size_t i,
                                               const cs_cell *left);
/* The current item is done; right of it lies `cell`. */
static inline void cs_window_pass(cs_window *window, const cs_cell *cell) { window->cell = cell; }
/* Closes the last window and writes the rest of the row. */
CELSPAN_CHECKED celspan_status cs_window_finish(cs_window *window);

#endif
