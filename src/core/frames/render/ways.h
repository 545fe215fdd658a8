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
 * The rule. A cel is artwork, and its map pays in the first frame, if it suits and
 *
 *   has at least CS_WAYS_PIECES pieces of     else there is nothing to save
 *   outline, and CS_WAYS_SHAPES shapes
 *   half of them let nothing through          translucent shapes show as often as they cross
 *   what varies is no larger than the rest    gradients and pictures are painted either way
 *   a quarter of the shapes is in the frame   a map is made of all
 *   those in the frame are, on average, at    a sweep finds crossings in every row, a map once; but
 *   most CS_WAYS_ROWS rows high               rows of an edge alone cost a map more
 *
 * The last may be half as much again for a drawing that occurs twice in the frame. Where artwork
 * has at least as many pieces as the other cels, it is drawn from maps, and so are cels of fewer
 * pieces that suit, unless most of their area varies; the others are swept. Otherwise the whole
 * exposure is swept.
 *
 * docs/how-rows.md has the measurements behind these numbers.
 *
 * An exposure may have maps where its antialiasing is "area", no side of the frame is above
 * CS_WAYS_SIDE pixels, and it has at most CS_MAP_DRAWINGS cels, no procedures, no grade of the
 * whole and the space of the film. A cel suits that
 *   - is in front of all cels that have pictures of one thread, compositions, modes that act on
 *     other cels, or a back light with a shape, and of those that have paints that do not dim all
 *     channels alike and are swept,
 *   - has no such paint over a gradient or a picture that lets something through,
 *   - is not defocused, has no front light with a shape, and no modes under a coloured light,
 *   - lies before the horizon, as a whole,
 *   - is small enough to be a map (engine/map/map.h) and, if it is turned, to be turned (turn.h
 *     there), and does not have too many dashes.
 *
 * Where a cel has parts (parts.h), all this is about its parts.
 *
 * Invariant: the ways depend on the frame's scene and the size of the whole frame alone; not on
 * the crop, on the workers, on whether the frame is one of a film, or on which maps are kept.
 */
#pragma once

#include "engine/map/sheets.h"
#include "frames/render/compile.h"
#include "model/scene/scene.h"

/* Counts and sizes of the shapes of a cel, found before it is compiled, from their boxes and
 * paints.
 *
 *     +---- frame ----+
 *     |  +--+         |      height: rows of the frame that a shape's box covers
 *     |  |##|  +------|---   area:   pixels of it, to weigh what varies against what is flat
 *     |  +--+  |      |
 *
 * It depends on the cel, its place and the size of the whole frame alone. Of a cel of more than
 * CS_CENSUS_MOST shapes the first ones stand for all.
 */
#define CS_CENSUS_MOST 65536

typedef struct cs_census {
  size_t shapes;       /* shapes that were counted */
  size_t inside;       /* shapes whose boxes meet the frame */
  size_t hiding;       /* shapes that let no light through, wherever they are */
  double heights;      /* the rows that each shape inside covers, summed */
  double varied, flat; /* areas of those that vary (gradients, pictures), and of the others */
  bool may_have_dashes;
  size_t pieces, points; /* in the outlines of all shapes; unknown for strokes */
} cs_census;

/* matrix: from the units of the objects to pixels of the frame. */
cs_census cs_census_take(celspan_object *const *objects, size_t count, const celspan_matrix *matrix,
                         int32_t width, int32_t height);

#define CS_WAYS_SIDE 8192
#define CS_WAYS_PIECES 256 /* 64 boxes have as many, and a traced character of 20 shapes more */
#define CS_WAYS_SHAPES 12
#define CS_WAYS_ROWS 210

/* For tests and measurements, in forced_way of the context: all that suits goes one way. */
typedef enum cs_ways_forced { CS_WAYS_BY_RULE, CS_WAYS_SWEPT, CS_WAYS_MAPPED } cs_ways_forced;

typedef struct cs_ways {
  cs_ways_forced forced;
  bool suits[CS_MAP_DRAWINGS]; /* by the index of the cel, from the rear */
  bool is_artwork[CS_MAP_DRAWINGS];
  bool is_small[CS_MAP_DRAWINGS]; /* the cel has fewer pieces, and is a map among artwork */
  bool mapped[CS_MAP_DRAWINGS];   /* the cel is drawn from its map */
  size_t rear; /* as many cels at the rear are swept with the light behind them */
} cs_ways;

/* Whether an exposure may have maps, whatever the places of its cels are. */
bool cs_ways_exist(const celspan_rostrum *rostrum, const cs_view *view,
                   const cs_antialias *antialias);
/* Judges a cel. pieces: of the cel; occurs_again: the same drawing, and so its map, occurs
 * again. */
void cs_ways_judge(cs_ways *ways, size_t cel, size_t pieces, const cs_census *census,
                   bool occurs_again);
/* Finds which cels suit, whatever their places and sizes are. All of them have been judged. */
void cs_ways_find(const celspan_rostrum *rostrum, const cs_view *view, cs_ways *ways);
/* Chooses the cels that are drawn from maps among the cels that suit; false: the exposure is
 * swept. */
bool cs_ways_choose(const celspan_rostrum *rostrum, cs_ways *ways);
/* For a cel that turns out not to suit: marks it as swept, and also the cels that must be swept
 * because of it. */
void cs_ways_sweep(const celspan_rostrum *rostrum, cs_ways *ways, size_t cel);
/* Whether a cel has paints that do not dim all channels alike. */
bool cs_ways_is_uneven(const celspan_cel *cel);
/* The end of the sheet that begins with a cel. */
size_t cs_ways_end(const celspan_rostrum *rostrum, const cs_ways *ways, size_t first);
