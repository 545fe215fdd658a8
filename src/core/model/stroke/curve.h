/* A piece of a line with its radius, or a part of one. Strokes are measured and outlined piece by
   piece.
 */
#pragma once

#include "model/geometry/bezier.h"
#include "model/stroke/stroke.h"

typedef struct cs_curve {
  cs_bezier line;
  int radius_degree;
  double radius[CS_STROKE_RADIUS_DEGREE + 1];
} cs_curve;

/* A place of a curve. By the parameter, velocity and growth are the first derivatives of point and
 * radius, acceleration and growth_change the second. */
typedef struct cs_curve_place {
  celspan_point point, velocity, acceleration;
  double radius, growth, growth_change;
} cs_curve_place;

/* The part of piece `piece` between two parameters, begin <= end. */
void cs_curve_load(const cs_stroke *stroke, size_t piece, double begin, double end, cs_curve *out);
void cs_curve_load_line(const cs_outline *line, size_t piece, double begin, double end,
                        cs_bezier *out);
void cs_curve_reverse(cs_curve *curve);
/* At 1/2 the halves are the same, to the bit, for the curve and for its reversed copy. */
void cs_curve_split(const cs_curve *curve, double t, cs_curve *low, cs_curve *high);
/* The part of a Bernstein polynomial between two parameters, in place. */
void cs_curve_cut_polynomial(double *coefficients, int degree, double begin, double end);
/* The product of two polynomials; its degree is the sum of their degrees. */
void cs_curve_multiply(const double *a, int a_degree, const double *b, int b_degree, double *out);
cs_curve_place cs_curve_at(const cs_curve *curve, double t);
/* A place on the line alone, without the radius. */
void cs_curve_line_at(const cs_bezier *line, double t, celspan_point *point,
                      celspan_point *velocity);
/* The direction, of length 1, in which the line leaves its first point; it always exists. */
celspan_point cs_curve_departure(const cs_bezier *line);
/* The box that contains the line and everything nearer to it than `extent` times the largest
 * radius; with extent 0, the line alone. */
celspan_box cs_curve_box(const cs_curve *curve, double extent);
/* How far its control points are from the first, along either axis. */
double cs_curve_extent(const cs_bezier *line);
/* Whether the line is straight with constant speed, up to rounding. */
bool cs_curve_is_straight(const cs_bezier *line);
/* Whether all of the line is one point, up to rounding. */
bool cs_curve_is_point(const cs_bezier *line);

/* The length of a line between two parameters, with an error of at most 1e-10 of the length of its
 * polygon. */
double cs_curve_length(const cs_bezier *line, double begin, double end);
/* The parameter at which the length from 0 is `length`; whole: the length up to parameter 1. */
double cs_curve_parameter(const cs_bezier *line, double whole, double length);

/* The lengths up to evenly spaced parameters from 0 to 1. With these lengths, very many parameters
 * of one line are found without measuring the line from its beginning for each of them. */
#define CS_CURVE_MARKS 256
void cs_curve_mark(const cs_bezier *line, double marks[CS_CURVE_MARKS + 1]);
double cs_curve_marked_parameter(const cs_bezier *line, const double marks[CS_CURVE_MARKS + 1],
                                 double length);

/* Where discs of a curve begin or cease to be inside their neighbours.
 *
 *     .---------.        A disc that grows faster than its centre moves is swallowed by the next
 *   .'  .----.   '.      one: |r'| >= |c'|. With c = p / w that is where the polynomial
 *   |  ( *--* )   |         (r' w^2)^2 - |p' w - p w'|^2
 *   '.  '----'   .'      is not below 0. All of its changes of sign are found, whatever the size at
 *     '---------'        which the curve is drawn, for its degree is the largest number of them.
 */

#define CS_CURVE_SWALLOW_CHANGES (2 * (CS_STROKE_RADIUS_DEGREE - 1 + 2 * CS_BEZIER_DEGREE))

/* Parameters inside (0, 1) at which a disc begins or ceases to be inside its neighbours, ascending;
 * returns how many. */
int cs_curve_swallow_changes(const cs_curve *curve, double changes[CS_CURVE_SWALLOW_CHANGES]);
bool cs_curve_is_swallowed(const cs_curve *curve, double t);
