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
#ifndef CS_GEOMETRY_BOUNDARY_BUILD_H
#define CS_GEOMETRY_BOUNDARY_BUILD_H

#include "geometry/boundary.h"
#include "geometry/plain.h"
#include "geometry/stretches.h"

/* The memory that it works in is kept from outline to outline. */
typedef struct cs_boundary_builder {
  celspan_context *context;
  cs_boundary_set *set;
  cs_boundary_frame frame;
  cs_boundary_frame inside; /* plain curves within it are inside */
  cs_stretches stretches;   /* of the current contour */
  cs_stretch straight;      /* what the stretches of the current curve begin as */
  cs_bezier *fronts;        /* the current piece, cut to what is in front of the horizon */
  size_t front_count, front_capacity;
  bool has_pen;
  cs_hpoint first, pen; /* the beginning of the contour, and its current point */
} cs_boundary_builder;

/* The context and the set must outlive the builder. */
void cs_boundary_builder_init(cs_boundary_builder *builder, celspan_context *context,
                              cs_boundary_set *set, const cs_boundary_frame *frame);
void cs_boundary_builder_finish(cs_boundary_builder *builder);

/* Appends the chains of an outline under a matrix (own units to pixels). A contour in part behind
 * the horizon is cut there. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_boundary_add(cs_boundary_builder *builder,
                                               const cs_outline *outline,
                                               const celspan_matrix *matrix, uint32_t layer);

#endif
