/* Strokes: a line and a radius along it, and the parts of it that are drawn.
 *
 *        spoke                    c(t): the line; r(t): half the width there
 *      \   |  r                   two spokes leave every place, to the points where the disc of
 *    ---o--+------- side          that radius touches its neighbours' envelope. They are at a
 *          |                      right angle to the line where the width is constant, and lean
 *    ------*------> line          towards where it is less.
 *          |
 *    ---o--+------- side          A point is in a stroke iff a spoke of a drawn part reaches over
 *      /   |                      it, or it is in the shape of a cap or of a join (outliner.h).
 *
 * Invariants: the line's pieces have a length, except in a contour that is a single point. Piece i
 * has the radius sum of radii[radius_starts[i] + j] * Bernstein polynomial j of degree
 * radius_degrees[i] at the piece's own parameter; radii are 0 or more. Contours are left open
 * unless a part says that it is closed. Parts begin and end inside one contour, count at least one
 * piece, and go over the contour's end only where it is closed. A part that begins where it ends,
 * of one piece, is a dot. cs_parts_get reads the parts, whether they are stored or dashes.
 */
#pragma once

#include "base/hash.h"
#include "model/geometry/boundary.h"
#include "model/geometry/outline.h"

/* of a width, and of twice the distance along a piece (taper.c) */
#define CS_STROKE_RADIUS_DEGREE 25
#define CS_STROKE_DASHES 1000000 /* the most in one stroke */

typedef struct cs_stroke_part {
  uint32_t contour;  /* the contour that the pieces belong to */
  uint32_t first;    /* the piece in which the part begins */
  uint32_t count;    /* the count of pieces */
  double begin, end; /* parameters, in the first and in the last piece */
  bool is_closed;    /* the part ends where it begins, and has no caps */
} cs_stroke_part;

/* The dashes of a contour (dashes.h). */
typedef struct cs_dashes_run {
  uint32_t contour;
  bool is_whole;  /* the run has no length to divide: it is one part */
  bool is_dot;    /* is_whole: it is a point */
  bool is_closed; /* its only part has no caps */
  bool is_joined; /* the last dash continues in the first one, and is no part by itself */
  /* the length of the line at which the pattern begins: at the beginning of the contour, or
   * before */
  double start;
  double from, to; /* the lengths of the line between which the run is drawn */
  size_t first;    /* the first dash of the run, counted from `start` */
  size_t begin;    /* the number of its first part */
} cs_dashes_run;

typedef struct cs_dashes {
  /* Lengths from the beginning of the pattern: where dashes begin and end in turn. */
  CS_ARRAY(double, places);
  CS_ARRAY(double, ends);        /* for each piece of the line: the length up to its end */
  CS_ARRAY(cs_dashes_run, runs); /* in order, at most one for each contour */
  size_t place_count, run_count;
  /* the length of the pattern, and the place in it at which contours begin */
  double pattern, offset;
} cs_dashes;

typedef struct cs_stroke {
  cs_outline line;
  CS_ARRAY(double, radii);
  CS_ARRAY(uint32_t, radius_starts);
  CS_ARRAY(uint8_t, radius_degrees);
  CS_ARRAY(cs_stroke_part, parts); /* the parts of a line without dashes */
  cs_dashes dashes;                /* place_count 0: the stroke has no dashes */
  size_t radius_count;
  size_t part_count; /* includes dashes */
  celspan_stroke_cap cap;
  celspan_stroke_join join;
  double miter;       /* as SVG's miter limit */
  double largest;     /* radius */
  celspan_box around; /* nothing of the stroke is outside it; not tight */
  cs_hash hash;       /* the hash of the line, the radii and the parts, and of how they are drawn */
} cs_stroke;

/* Makes a stroke from a description whose numbers have been checked. outline: the line from which
 * desc->outline is made, or another line; NULL for one of the description. closed: which of its
 * contours are closed; NULL: all. Errors: NO_MEMORY; BAD_ARGUMENT for path data, degree and counts;
 * LIMIT for more dashes than CS_STROKE_DASHES. finish frees it, also after an error. */
CELSPAN_CHECKED celspan_status cs_stroke_init(celspan_context *context, cs_stroke *stroke,
                                              const celspan_stroke_desc *desc,
                                              const cs_outline *outline,
                                              const cs_outline_closed *closed);
void cs_stroke_finish(cs_stroke *stroke, cs_memory *memory);

/* Whether it is drawn along its whole line with one width, without dashes: one part a contour. */
bool cs_stroke_is_plain(const cs_stroke *stroke);
/* How far beyond the line a stroke may extend, in radii: spokes, caps and joins. */
double cs_stroke_extent(const cs_stroke *stroke);
/* The same without joins. */
double cs_stroke_extent_of_caps(const cs_stroke *stroke);
/* The pieces of a contour: [*begin, *end). */
void cs_stroke_contour(const cs_outline *line, size_t contour, size_t *begin, size_t *end);
/* Piece `i` of a part, which may go over the end of its contour. */
size_t cs_stroke_piece(const cs_stroke *stroke, const cs_stroke_part *part, size_t i);

/* The view of a stroke: where its own units are seen, and how exactly.
 *
 *        frame            In the frame an outline may be wrong by `tolerance` pixels. What is d
 *     +---------+         pixels outside of it may be wrong by d / 4: it cannot come in.
 *     |         |   d
 *     |         |<------> *
 *     +---------+
 *
 * Of a frame some rows and columns may be asked for: what lies wholly beside them is left out, and
 * what does not is the same, to the bit, as without that.
 */

typedef struct cs_stroke_view {
  celspan_matrix matrix; /* own units to pixels; faces the viewer (model/geometry/matrix.h) */
  cs_boundary_frame frame;
  double tolerance;   /* pixels */
  double top, bottom; /* the top and bottom of the rows that are asked for, pixels */
  double left, right; /* columns that are asked for, in pixels */
} cs_stroke_view;

/* How far from their place, in pixels, the contents of a box may be drawn. */
double cs_stroke_view_allowance(const cs_stroke_view *view, const celspan_box *box);
/* The distance in pixels between two points that should be one. 0 behind the horizon. */
double cs_stroke_view_error(const cs_stroke_view *view, celspan_point is, celspan_point ought);
/* Whether nothing in the box is visible in the rows and columns that are asked for. */
bool cs_stroke_view_hides(const cs_stroke_view *view, const celspan_box *box);
/* Whether everything in the box is in the frame, and in the rows and columns that are asked for. */
bool cs_stroke_view_holds(const cs_stroke_view *view, const celspan_box *box);
/* Whether the box is much larger than the frame, so that it is worthwhile to examine parts of
 * it. */
bool cs_stroke_view_is_exceeded(const cs_stroke_view *view, const celspan_box *box);
