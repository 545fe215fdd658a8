/* Windows: the pixels of a row that edges cross, summed from their borders.
 *
 *      from            end
 *       |   window      |
 *   +---+---+---+---+---+---+---+---+
 *   |   |  /|###|###|\  |   |   |   |      two items, an edge of a disc and an edge of a bar, whose
 *   |   | / |###|##/|#\ |   |   |   |      columns touch: one window
 *   |   |/  |###|#/ |##\|   |   |   |
 *   +---+---+---+---+---+---+---+---+
 *   base     pixels: base + sum of      cell: right of all items so far
 *            share * colour step
 *
 * Composite first, integrate after: each border (straight, between two cells that do not change
 * along it) adds its colour step times the area right of it to every pixel.
 * Between windows a row is whole cells. So coverage is never used as alpha, and abutting shapes
 * cannot leak.
 *
 * Invariants: a window's pixels are summed from its own borders only, starting from the exact
 * colour of the cell on its left; windows and cells tile [0, width). Items (lone boundaries or
 * local sweeps) come from left to right. Between windows `change` is all 0.
 */
#pragma once

#include "engine/area/direct.h"
#include "engine/compose/border.h"
#include "engine/paint/painter.h"

#define CS_WINDOW_NARROW 32 /* nearly all windows have at most this many columns */

/* A border of the open window, and its part inside the window. */
typedef struct cs_window_border {
  cs_border border;
  cs_direct_piece piece;
} cs_window_border;

typedef struct cs_window {
  cs_painter *painter;         /* borrowed */
  const cs_composer *composer; /* the painter's */
  cs_arena *arena;             /* borrowed: of the row */
  int32_t width;               /* the width of the row */
  cs_row *out;                 /* the row that is written */
  double centre;               /* height of the row's centre */
  /* everything left of this column has been written; the open window begins at this column */
  int32_t from;
  int32_t end;         /* the end of the open window; equal to `from` if it is empty */
  const cs_cell *base; /* the cell left of the window */
  const cs_cell *cell; /* the cell right of all items so far */
  CS_ARRAY(cs_window_border, borders);
  size_t border_count;
  bool is_open, varies;
  /* what borders between flat cells that end near the window's left end add to the sum of colours
   * from column to column */
  cs_sum4 change[CS_WINDOW_NARROW + 3];
  bool has_change;      /* the change is not 0 everywhere */
  bool is_whole_row;    /* the whole row is one window: items may come in any order */
  cs_arena tiles;       /* memory for the weights of one tile; owned by the window */
  const cs_cell *ahead; /* the cell whose pixels up to ahead_end are folded */
  int32_t ahead_end;
} cs_window;

void cs_window_init(cs_window *window, cs_painter *painter, cs_arena *arena, int32_t width);
void cs_window_finish(cs_window *window, cs_memory *memory);

/* Begins row y at the cell `leftmost`. out: is empty, gets [0, width). */
void cs_window_begin_row(cs_window *window, int32_t y, const cs_cell *leftmost, cs_row *out);
/* Makes one window of the whole row. */
void cs_window_open_row(cs_window *window);
/* Begins an item whose least x is `x`. Closes the open window if the window ends before that x. */
CELSPAN_CHECKED celspan_status cs_window_begin_item(cs_window *window, double x);
/* A border of the current item. */
CELSPAN_CHECKED celspan_status cs_window_add(cs_window *window, const cs_border *border);
/* Whole items: boundaries that go through the whole row, straight or bent, and have no other
 * events. `rest` is empty when all have been drawn. */
CELSPAN_CHECKED celspan_status cs_window_edges(cs_window *window, cs_direct_edges *rest);
/* Ends the current item; `cell` lies right of it. */
static inline void cs_window_end_item(cs_window *window, const cs_cell *cell) {
  window->cell = cell;
}
/* Lets the window that has been begun at a column begin with another cell, if nothing is in it yet.
 * Returns whether it does. */
static inline bool cs_window_begin_with(cs_window *window, int32_t column, const cs_cell *cell) {
  bool is_new = window->from == column && window->end == column && window->border_count == 0;
  window->base = is_new ? cell : window->base;
  return is_new;
}
/* Closes the last window and writes the rest of the row. */
CELSPAN_CHECKED celspan_status cs_window_end_row(cs_window *window);
