/* Boundaries: an outline cut into y-monotone chains in the pixels of a frame, and the polyline that
 * the sweep walks down each of them, made group by group as it is needed (boundary_walk.h).
 *
 *   outline --matrix, horizon--> pieces --y extrema--> monotone pieces --frame--> chains
 *
 *           *  y extremum      chain A runs downwards along the contour (+1), chain B upwards (-1)
 *         /   \
 *      A o     \ B             a row height y crosses a chain iff y0 <= y < y1: half open, so that
 *        |      o              at every height as many chains go down as up
 *         \    /
 *           *                  o: pieces of a chain join
 *
 * Invariants
 *   - A chain runs from its top y0 to its bottom y1 > y0 and is hit by row height y iff
 *     y0 <= y < y1. Pieces inside it share their ends bitwise, so the windings of a contour sum to
 *     0 at every y, whatever the rounding.
 *   - x at a height is a function of that height, the chain and the frame alone, independent of the
 *     row where the walk began and of strips and crops. Two chains over the same control points, in
 *     either direction, give the same bits.
 *   - Pieces left of `left` or right of `right` are replaced by vertical lines there; what lies
 *     wholly above `top` or below `bottom` is dropped.
 *   - Chords and arcs deviate from the curve by at most about CS_BOUNDARY_TOLERANCE pixels and keep
 *     the area left of it: in any one pixel to less than 2/255 (tests/core/unit/test_polyline.c).
 */
#pragma once

#include "model/geometry/outline.h"

#define CS_BOUNDARY_TOLERANCE 0.02
#define CS_BOUNDARY_GROUP 7 /* the most chords whose vertices are made at a time */

/* One monotone rational Bezier piece, normalised to run downwards: y0 < y1. */
typedef struct cs_boundary_piece {
  double x0, y0, x1, y1;
  double left, right; /* no vertex lies left or right of these */
  double sag;         /* the greatest distance of a chord of mean length from the curve */
  double step;        /* the change of the parameter from vertex to vertex */
  /* the index of its degree + 1 points; a piece of one chord has no points unless curves are
   * kept */
  uint32_t point;
  uint32_t chords;     /* a multiple of group */
  uint8_t group, half; /* chords of a group, and of its upper half (or of the whole group) */
  /* the number of groups that are first tried as one arc, which begins at a multiple of it; or 1 */
  uint8_t leap;
  uint8_t degree; /* 1: the piece has no points */
  bool is_power;  /* points are coefficients of the powers of t, without w; else homogeneous */
} cs_boundary_piece;

typedef struct cs_boundary_chain {
  double y0, y1; /* top and bottom, y0 < y1 */
  double x0;     /* at the top */
  uint32_t piece, piece_count;
  uint32_t layer;    /* the layer of the outline: an index of the caller's */
  int32_t direction; /* +1: the contour runs downwards here, -1: upwards */
} cs_boundary_chain;

typedef struct cs_boundary_set {
  bool keeps_curves; /* pieces have their points even where they are one chord */
  CS_ARRAY(cs_hpoint, points);
  CS_ARRAY(cs_boundary_piece, pieces);
  CS_ARRAY(cs_boundary_chain, chains);
  size_t point_count, piece_count, chain_count;
} cs_boundary_set;

typedef struct cs_boundary_frame {
  double left, right, top, bottom; /* pixels */
} cs_boundary_frame;

/* The rectangle around the four corners of a box under a matrix. Returns whether all corners are in
 * front of the horizon: if so, everything inside the box lies in the rectangle. */
bool cs_boundary_around_box(const celspan_box *box, const celspan_matrix *matrix,
                            cs_boundary_frame *out);

void cs_boundary_init(cs_boundary_set *set);
void cs_boundary_finish(cs_boundary_set *set, cs_memory *memory);
/* Makes room for the chains of outlines with about this number of pieces and points, so that the
 * arrays need not grow with them. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_boundary_expect(celspan_context *context, cs_boundary_set *set,
                                                  size_t pieces, size_t points);

/* Orders the chains by y0, then x0, then layer, then the order of adding: the order in which a
 * sweep meets them. Must be called once, after the last outline. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_boundary_sort(celspan_context *context, cs_boundary_set *set);

/* The segments of a group, from vertex to vertex, from the top. Every number is finite. */
typedef struct cs_boundary_group {
  double x[CS_BOUNDARY_GROUP + 1], y[CS_BOUNDARY_GROUP + 1];
  double slope[CS_BOUNDARY_GROUP + 1]; /* dx/dy of each segment, at its top; 0 where it is flat */
  double curve[CS_BOUNDARY_GROUP + 1]; /* half of d2x/dy2; 0 for a chord */
  uint32_t count;                      /* the number of segments; an arc is one segment */
  /* of the piece: the first group, and the number of groups; 1, or all groups of a leap */
  uint32_t first, groups;
} cs_boundary_group;
