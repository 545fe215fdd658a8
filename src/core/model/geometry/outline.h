/* Outlines: closed contours of rational Bezier pieces, the one form of every primitive.
 *
 *            p1 o - - - o p2             piece 0: cubic, points p0 p1 p2 p3
 *              .         .               piece 1: a line,   points p3 p4
 *          p0 *           * p3           piece 2: a line,   points p4 p5, where p5 equals p0
 *              \         /
 *               \       /               *  a joint: stored once, shared by two pieces
 *                * p4                    o  a control point
 *
 * Invariants: points are homogeneous (w*x, w*y, w) with w > 0; piece i has degrees[i] + 1 points
 * from starts[i] on; consecutive pieces of a contour share their joint (the last point of one is
 * the first of the next: starts[i + 1] == starts[i] + degrees[i] inside a contour), and the last
 * point of a contour equals its first bitwise. contours[c] is the first piece of contour c.
 */
#pragma once

#include "base/arrays.h"
#include "base/hash.h"

#define CS_OUTLINE_PLAIN_DEGREE 3

typedef struct cs_hpoint {
  double x, y, w;
} cs_hpoint;

static inline celspan_point cs_hpoint_place(cs_hpoint p) {
  return (celspan_point){p.x / p.w, p.y / p.w};
}
static inline cs_hpoint cs_hpoint_of(celspan_point p) { return (cs_hpoint){p.x, p.y, 1}; }

typedef struct cs_outline {
  CS_ARRAY(cs_hpoint, points);
  CS_ARRAY(uint32_t, starts);
  CS_ARRAY(uint8_t, degrees);
  CS_ARRAY(uint32_t, contours);
  size_t point_count, piece_count, contour_count;
  /* Every weight is 1, every coordinate passes cs_number_is_sane, and no piece has a degree over
   * CS_OUTLINE_PLAIN_DEGREE. */
  bool is_plain;
} cs_outline;

/* An empty outline; finish frees its arrays. */
void cs_outline_init(cs_outline *outline);
void cs_outline_finish(cs_outline *outline, cs_memory *memory);
void cs_outline_hash(cs_hash *hash, const cs_outline *outline);

/* Building: move begins a contour, close ends it with a line when it is open, and the other
 * functions append a piece from the current point. A contour without pieces is removed. Errors:
 * NO_MEMORY; LIMIT past 2^31 points. */
CELSPAN_CHECKED celspan_status cs_outline_move(celspan_context *context, cs_outline *outline,
                                               cs_hpoint to);
CELSPAN_CHECKED celspan_status cs_outline_line(celspan_context *context, cs_outline *outline,
                                               cs_hpoint to);
/* As move, but the previous contour remains open: for lines, which need not return to their
 * beginning. */
CELSPAN_CHECKED celspan_status cs_outline_begin(celspan_context *context, cs_outline *outline,
                                                cs_hpoint to);
/* points: degree homogeneous points after the current one. */
CELSPAN_CHECKED celspan_status cs_outline_piece(celspan_context *context, cs_outline *outline,
                                                int degree, const cs_hpoint *points);
CELSPAN_CHECKED celspan_status cs_outline_close(celspan_context *context, cs_outline *outline);

/* The whole outlines of the primitives. Arguments have been checked (model/scene/check.h). */
CELSPAN_CHECKED celspan_status cs_outline_rect(celspan_context *context, cs_outline *outline,
                                               double x, double y, double width, double height,
                                               double radius);
/* A rectangle whose corners are quarters of an ellipse. The radii are above 0 and at most half the
 * sides. */
CELSPAN_CHECKED celspan_status cs_outline_rounded(celspan_context *context, cs_outline *outline,
                                                  const celspan_box *box, double radius_x,
                                                  double radius_y);
/* A rectangle whose corners are quarters of circles, clockwise from the top left. The radii are 0
 * or more, and the two along a side are together at most as long as it. */
CELSPAN_CHECKED celspan_status cs_outline_cornered(celspan_context *context, cs_outline *outline,
                                                   const celspan_box *box, const double radii[4]);
CELSPAN_CHECKED celspan_status cs_outline_ellipse(celspan_context *context, cs_outline *outline,
                                                  celspan_point centre, double radius_x,
                                                  double radius_y);
CELSPAN_CHECKED celspan_status cs_outline_polygon(celspan_context *context, cs_outline *outline,
                                                  const celspan_point *points, size_t count);
/* Errors: BAD_ARGUMENT for knots, weights, degree and counts (it checks them, naming the knot). */
CELSPAN_CHECKED celspan_status cs_outline_nurbs(celspan_context *context, cs_outline *outline,
                                                const celspan_nurbs_desc *desc);
/* Errors: BAD_ARGUMENT naming the offset and the expected input. */
CELSPAN_CHECKED celspan_status cs_outline_path(celspan_context *context, cs_outline *outline,
                                               const char *data);
/* The contours of a line that are closed, and the pieces that continue the arc of the previous
 * piece; both ascending; finish frees them. */
typedef struct cs_outline_closed {
  uint32_t *contours, *inner;
  size_t count, capacity, inner_count, inner_capacity;
} cs_outline_closed;
/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_outline_closed_add(celspan_context *context,
                                                     cs_outline_closed *closed, size_t contour);
void cs_outline_closed_finish(cs_outline_closed *closed, cs_memory *memory);
/* Path data as lines: a subpath that Z does not close remains open, and a Z without commands before
 * it makes a line of no length. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_outline_path_open(celspan_context *context, cs_outline *outline,
                                                    cs_outline_closed *closed, const char *data);
/* closed: of a line, gets the contours that are flagged; NULL: all are closed. A contour of one
 * point makes a line of no length if it is closed, and else nothing. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_outline_contours(celspan_context *context, cs_outline *outline,
                                                   cs_outline_closed *closed,
                                                   const celspan_contour *contours, size_t count);

/* An outline that will not change, in one block with its arrays: it has no room to grow. The
 * original does not change. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_outline_pack(celspan_context *context, const cs_outline *outline,
                                               cs_outline **out);
void cs_outline_free_packed(cs_outline *packed, cs_memory *memory);

/* The outline of a box that has an area, as cs_outline_rect makes it, in memory of the caller. */
typedef struct cs_outline_box {
  cs_outline outline;
  cs_hpoint points[5];
  uint32_t starts[4], contour;
  uint8_t degrees[4];
} cs_outline_box;
const cs_outline *cs_outline_of_box(const celspan_box *box, cs_outline_box *room);

/* The box around two boxes. */
celspan_box cs_outline_box_around(celspan_box a, celspan_box b);
/* The tight box of the outline under a matrix, cut at the horizon; false if nothing is in front of
 * the horizon. */
bool cs_outline_bounds(const cs_outline *outline, const celspan_matrix *matrix, celspan_box *out);
