/* Where an edge runs between the pixels of a border, finer than pixels are.
 *
 *     share of b      .0  .0  .2 | .7  1.  1.        a side of two pixels, and the pixels across it
 *                              ^ |
 *                              edge: as far left of the side as what b holds of the pixels on the
 *                              left, less what a holds of those on the right: 0.2 - 0.3
 *
 * The sum of the shares across a side is where the edge is, at the middle of the row, for a
 * straight edge in any direction, antialiased or blurred. A line thinner than a pixel has its
 * middle where the shares have theirs, and its width is their sum.
 *
 * A border runs either rather up and down, and is found along rows, or rather across, and is found
 * along columns:
 *
 *      --+              sides that are asked: | of the upper part, where the border runs upright
 *        |                                    - of the lower one
 *        +--+
 *           +-----+--
 *
 * In a picture of whole pixels only the sides themselves show where the edge is, which
 * passes between the middles of the pixels on both sides of each; so every side is asked, and its
 * middle taken:
 *
 *      --.--+                 . : points
 *           .
 *           +--.--+
 *
 * INVARIANT: a point is less than CS_EDGE_FAR from its side, and a function of the pixels near it.
 */
#pragma once

#include "tools/trace/borders.h"
#include "tools/trace/street.h"

/* The number of pixels examined on either side. */
#define CS_EDGE_EXTENT 3
#define CS_EDGE_FAR 1.0
#define CS_EDGE_TIGHTEST 0.05

/* aside: if pixels are whole, the vector from the middle of a side to that of the pixel on its
 * left; otherwise, and at ends, 0, 0. */
typedef struct cs_edge_point {
  celspan_point at, aside;
} cs_edge_point;

typedef struct cs_points {
  cs_edge_point *items;
  size_t count, capacity;
} cs_points;

/* The gate whose middle is a point of whole pixels. */
static inline cs_gate cs_edge_gate(const cs_edge_point *point) {
  celspan_point at = point->at, aside = point->aside;
  return (cs_gate){{at.x + aside.x, at.y + aside.y}, {at.x - aside.x, at.y - aside.y}};
}

/* How far from the point an edge with this direction, of length 1, may pass so that it is in the
 * point's gate; at least CS_EDGE_TIGHTEST, which is too little to see. */
double cs_edge_room(const cs_edge_point *point, celspan_point along);

CELSPAN_CHECKED celspan_status cs_points_add(celspan_context *context, cs_points *points,
                                             celspan_point point);
CELSPAN_CHECKED celspan_status cs_points_copy(celspan_context *context, cs_points *points,
                                              const cs_edge_point *point);
void cs_points_finish(celspan_context *context, cs_points *points);

/* The corners of pixels that a chain turns at, and both of its ends: the border of the pixels
 * themselves. A closed chain begins and ends at a turn. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_edge_turns(celspan_context *context, const cs_borders *borders,
                                             const cs_chain *chain, cs_points *out);
/* Some of the sides of a chain: [from, to). */
typedef struct cs_sides {
  size_t from, to;
} cs_sides;

/* Points of the edge along sides of a chain. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_edge_points(celspan_context *context, const cs_material *material,
                                              const cs_borders *borders, const cs_chain *chain,
                                              cs_sides sides, cs_points *out);
/* Whether hardly any pixel of the borders is mixed: the picture has whole pixels, and an edge may
 * be anywhere within half a pixel of a side. */
bool cs_edge_is_whole(const cs_material *material, const cs_regions *regions);
