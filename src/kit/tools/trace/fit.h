/* Points of an edge as few lines and cubics.
 *
 *      corner      joint           joint     corner
 *        o-----------o---------------o---------o
 *          as many points as one      the tangent at a joint is that of the points about it, and
 *          cubic can go along         both its cubics have it
 *
 * Each cubic goes from joint to joint by least squares: at a joint, which lies on the arc of the
 * points about it, its control point lies on the tangent; at a corner it is free. It is made as
 * long as points are not farther from it than the tolerance, each of them and on the average; what
 * the last one then leaves over is shared out among all. Between two corners a line takes
 * precedence. Points of whole pixels have gates, and each piece passes those of its points:
 * tolerances do not count then.
 *
 * INVARIANT: the result is a function of the points and rules. Coordinates are whole multiples of
 * 1 / CS_FIT_GRID, so that they are the same when written as decimals and read again.
 */
#pragma once

#include "tools/trace/corners.h"
#include "tools/trace/path_text.h"

#define CS_FIT_GRID 1000

typedef struct cs_piece {
  bool is_line;
  celspan_point control[2]; /* inner points of a cubic */
  celspan_point to;
} cs_piece;

typedef struct cs_fit_pieces {
  cs_piece *items;
  size_t count, capacity;
} cs_fit_pieces;

CELSPAN_CHECKED celspan_status cs_pieces_add(celspan_context *context, cs_fit_pieces *pieces,
                                             const cs_piece *piece);

/* Writes a piece as path data: forwards, or backwards so that it ends at `to`. */
CELSPAN_CHECKED celspan_status cs_pieces_draw(celspan_context *context, cs_writing *path,
                                              const cs_piece *piece, celspan_point to,
                                              bool is_back);
void cs_pieces_finish(celspan_context *context, cs_fit_pieces *pieces);

/* Points with both ends; the first and the last point are not moved. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_fit_open(celspan_context *context, const cs_points *points,
                                           const cs_fit_rules *rules, cs_fit_pieces *out);
/* Closed points, without repeating the first one at the end. *start: where the pieces begin and
 * end. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_fit_closed(celspan_context *context, const cs_points *points,
                                             const cs_fit_rules *rules, celspan_point *start,
                                             cs_fit_pieces *out);
/* Lines from point to point. */
CELSPAN_CHECKED celspan_status cs_fit_lines(celspan_context *context, const cs_points *points,
                                            cs_fit_pieces *out);
celspan_point cs_fit_snap(celspan_point point);
