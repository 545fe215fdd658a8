/* The ways of a frame's cels: which of them are drawn from maps, and which are swept.
 *
 *     camera                       way
 *       |   cel 5   character      map
 *       |   cel 4   defocused      \  swept together: neighbours that are swept are one sheet
 *       |   cel 3   a picture      /
 *       |   cel 2   character      map
 *       v   cel 1   mode "screen"  \  swept together: it acts on all that is behind it
 *           cel 0   many shapes    /
 *
 * The rule. A cel is rich that suits and has at least CS_WAYS_SHAPES shapes, and at least one for
 * every CS_WAYS_PIXELS pixels of the frame's longer side: the longer boundaries are, the less a map
 * saves. Where the rich cels have together at least as many shapes as there are others, each cel
 * that suits is drawn from its map, unless it is not rich and has pictures; the other cels are
 * swept, and otherwise the whole exposure is. Shapes that are cut away from others are among the
 * others, whatever cel they are in: nothing is hidden by them. The mesh of a bent picture or
 * gradient is one shape, because it is another mesh in each frame, and a defocused cel is one.
 *
 * An exposure may have maps where its frame repeats, its antialiasing is "area", no side of the
 * frame is above CS_WAYS_SIDE pixels, and it has at most CS_MAP_DRAWINGS cels, no procedures, no
 * grade of the whole and the space of the film. A cel suits that
 *   - is in front of all cels that have pictures of one thread, compositions, modes that act on
 *     other cels, or a back light with a shape, and of those that have paints that do not dim all
 *     channels alike and are swept,
 *   - has no such paint over a gradient or a picture that lets something through,
 *   - is not defocused, has no front light with a shape, and no modes under a coloured light,
 *   - lies before the horizon, as a whole,
 *   - is small enough to be a map (engine/map/map.h) and, if it is turned, to be turned (turn.h
 *     there), and does not have too many dashes.
 *
 * What is said of cels here is meant of their parts where they have some (parts.h).
 *
 * Invariant: the ways depend on the exposure and the size of the whole frame alone; not on the
 * crop, on the workers, or on which maps are kept.
 */
#pragma once

#include "engine/map/sheets.h"
#include "frames/render/compile.h"

#define CS_WAYS_SIDE 8192
#define CS_WAYS_SHAPES 64
#define CS_WAYS_PIXELS 32

typedef struct cs_ways {
  bool suits[CS_MAP_DRAWINGS];  /* by the index of the cel, from the rear */
  bool mapped[CS_MAP_DRAWINGS]; /* it is drawn from its map */
  size_t rear;                  /* as many cels at the rear are swept with the light behind them */
  size_t shapes;                /* of a rich cel, at least */
} cs_ways;

/* Whether an exposure may have maps, whatever its cels are. */
bool cs_ways_exist(const celspan_rostrum *rostrum, const cs_view *view,
                   const cs_antialias *antialias);
/* The shapes of a rich cel, at least. */
size_t cs_ways_rich(const cs_view *view);
/* Finds which cels of an exposure that may have maps suit, whatever their places and sizes are. */
void cs_ways_find(const celspan_rostrum *rostrum, const cs_view *view, cs_ways *out);
/* Chooses those that are drawn from maps among those that suit; false: the exposure is swept. */
bool cs_ways_choose(const celspan_rostrum *rostrum, cs_ways *ways);
/* A cel turns out not to suit: it is swept, and what it needs for that is. */
void cs_ways_sweep(const celspan_rostrum *rostrum, cs_ways *ways, size_t cel);
/* The end of the sheet that begins with a cel. */
size_t cs_ways_end(const celspan_rostrum *rostrum, const cs_ways *ways, size_t first);
