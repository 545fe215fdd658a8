/* Building boundaries: the outlines of a frame become chains, one outline after the other.
 *
 *   horizon: a curve is cut       y extrema: a curve is cut      sides of the frame: beyond them
 *   off behind it                 into monotone stretches        vertical lines replace a curve
 *
 *        .---.                             .*.  extremum                  left
 *      .'     '.                         .'   '.                             |   .
 *   --o---------o--- horizon            /       \                            | .
 *     :         :                     one       another                      |'  the curve leaves
 *     (cut off)                       stretch   stretch                    . |   along the side
 *                                                                         .  |
 *
 * A curve is inside if all its weights are 1 and it is away from the sides of the frame: of it
 * there is nothing to project and nothing to cut but its extrema. That is the short way, which most
 * curves of most frames go.
 *
 * Invariant: the short way gives the bits of the long one.
 */
#pragma once

#include "model/geometry/boundary.h"
#include "model/geometry/plain.h"

/* Stretches: the falling and rising parts of one contour, in the order of the contour, until they
 * are joined to chains.
 *
 *        .0.            the contour begins at 0 and goes down the left side
 *      1'   '5
 *      |     |          stretches 1 2 3: direction +1, one chain from top to bottom
 *      2     4                    4 5 0: direction -1, another; it runs over the beginning of the
 *       '.3.'                            contour, and its pieces are put in the reverse order
 *
 * Invariant: the piece of a stretch runs downwards, whatever its direction is.
 */

typedef struct cs_boundary_stretch {
  cs_boundary_piece piece;
  int32_t direction; /* along the contour: +1 down, -1 up */
} cs_boundary_stretch;

typedef struct cs_boundary_stretches {
  cs_boundary_stretch *items;
  size_t count, capacity;
} cs_boundary_stretches;

/* Reverses the order of the stretches from `begin` on. turns_direction: their directions are
 * reversed, too. */
void cs_stretches_reverse(cs_boundary_stretches *stretches, size_t begin, bool turns_direction);

/* Appends the chains of a closed contour to the set. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stretches_join(celspan_context *context,
                                                 const cs_boundary_stretches *stretches,
                                                 uint32_t layer, cs_boundary_set *set);

/* The memory that it uses is kept from outline to outline. */
typedef struct cs_boundary_builder {
  celspan_context *context;
  cs_boundary_set *set;
  cs_boundary_frame frame;
  cs_boundary_frame inside;        /* plain curves in this rectangle count as inside */
  cs_boundary_stretches stretches; /* the stretches of the current contour */
  cs_boundary_stretch straight;    /* the initial value of the stretches of the current curve */
  cs_bezier *fronts; /* the parts of the current piece that are in front of the horizon */
  size_t front_count, front_capacity;
  bool has_pen;
  cs_hpoint first, pen; /* the beginning of the contour, and its current point */
} cs_boundary_builder;

/* The context and the set must outlive the builder. */
void cs_boundary_builder_init(cs_boundary_builder *builder, celspan_context *context,
                              cs_boundary_set *set, const cs_boundary_frame *frame);
void cs_boundary_builder_finish(cs_boundary_builder *builder);

/* Appends the chains of an outline under a matrix (own units to pixels). If a part of a contour is
 * behind the horizon, the contour is cut there. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_boundary_add(cs_boundary_builder *builder,
                                               const cs_outline *outline,
                                               const celspan_matrix *matrix, uint32_t layer);
