/* The mixer: the colour of a pixel in which several units lie.
 *
 *       0  +--\---------/-+      A unit divides the pixel: right of it, at its heights, its layer has
 *          |   \ a     /  |      one winding more (or less) than left of it. Between the heights
 *          |    \     / b |      where units begin and end, every unit goes through: a slab.
 *     top  +-----\-./-----+      In a slab units are put in order by the area right of them. Where
 *          |  S   \/  T   |      each is left of the next, the areas between neighbours follow by
 *          |      /\      |      subtraction. Units that cross are a tangle: each set of them, here
 *          |     / U\     |      {}, {a}, {b}, {a, b}, has an area to the right of all its units,
 *    foot  +----/----\----+      and what lies right of just these follows by subtraction, too:
 *          |   /    __.c  |        T = right(a, b)        U = right(a) - T
 *          |  /   c|   `--|        S = all - right(a) - right(b) + T    ...
 *       1  +-/-----+------+      Each of these parts has the cell that the composer makes of it.
 *
 * A unit that does not go through the whole row leaves events behind, once the walk along the row
 * has passed it: to its right its layer changes at the height where it begins, and changes back
 * where it ends. Where an outline turns back up, its two units leave the same event with opposite
 * signs, and it vanishes.
 *
 *          |        c       event at the top of c: everywhere to the right ...
 *          |       /|
 *          |      / |d      ... until d has been passed, too
 *
 * Invariants: all areas are multiples of 2^-28, so that those of the parts of a pixel sum to it
 * exactly; a pixel is a function of its units, the events and the state of the composer, not of
 * their order; the composer is left in the state in which it was found.
 */
#ifndef CS_BUSY_MIXER_H
#define CS_BUSY_MIXER_H

#include "area/row_tools.h"
#include "busy/columns.h"
#include "busy/side.h"

/* At this height of the row, and everywhere below it, the winding of a layer is another one. */
typedef struct cs_event {
  double y;
  uint32_t layer;
  int32_t change;
} cs_event;

typedef struct cs_mixer {
  cs_composer *composer;     /* borrowed; at the state left of the pixel, at the top of the row */
  cs_painter *painter;       /* borrowed */
  const cs_units *units;     /* borrowed: of the row */
  const cs_columns *columns; /* borrowed: their lists */
  double centre;             /* height of the row's centre */
  cs_event *events;          /* in force at the place of the walk, in no order */
  size_t event_count, event_capacity;
  /* the pixel */
  int32_t column;
  cs_set_hash hash; /* of the state of the composer */
  cs_v4 base;       /* the colour that it has if nothing happens in it */
  cs_v4d sum;       /* what its parts add to that */
  bool varies;      /* the colour of a part depends on the column */
  uint32_t cover;   /* a layer all over the pixel that hides all behind it, or CS_STACK_NONE */
  cs_side *sides;   /* of units and events that are not hidden */
  size_t count, capacity;
  double *heights; /* where units begin or end, in order; 0 first, 1 last */
  size_t height_count, height_capacity;
  cs_present *present; /* of the slab, from left to right */
  size_t present_capacity;
} cs_mixer;

void cs_mixer_init(cs_mixer *mixer, const cs_row_tools *tools, const cs_units *units,
                   const cs_columns *columns);
void cs_mixer_finish(cs_mixer *mixer, cs_memory *memory);

/* A unit has been passed that does not begin at the top of the row or does not end at its foot.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_mixer_pass(cs_mixer *mixer, const cs_unit *unit);
/* Whether any event is seen where a cell is. */
bool cs_mixer_has_events(const cs_mixer *mixer, const cs_cell *cell);

/* The colour of a pixel, premultiplied. cell: the one at the state of the composer; head: the list
 * of the units in the pixel, or 0.
 * Errors: NO_MEMORY, those of painting; what composing meets is in composer->failure. */
CELSPAN_CHECKED celspan_status cs_mixer_colour(cs_mixer *mixer, int32_t column, const cs_cell *cell,
                                               uint32_t head, cs_v4 *colour);

#endif
