/* Single rational Bezier pieces: splitting, roots, extrema, the horizon.
 *
 *          o-------m-------o           split at t: every side of the control polygon is divided at
 *         /     .     .     \          t, then the sides of the new polygon, until one point is
 *        /   l-----j-----h   \         left; that is the joint j of both halves
 *       m .                 . m
 *      /                       \       halves: * m l j   and   j h m *
 *     *                         *
 *
 * Invariants: points are homogeneous. Everything is a pure function of the control points in their
 * given order; cs_bezier_canonise gives a piece and its reversed copy the same order. Where all
 * weights are equal bitwise, splitting keeps them so.
 */
#pragma once

#include "model/geometry/outline.h"

#define CS_BEZIER_DEGREE 15
/* The most roots of any polynomial here: a rational piece has that many extrema. */
#define CS_BEZIER_ROOTS (2 * CS_BEZIER_DEGREE)
/* The highest degree of a polynomial whose roots can be found. */
#define CS_BEZIER_POLYNOMIAL 100

typedef struct cs_bezier {
  int degree;
  cs_hpoint points[CS_BEZIER_DEGREE + 1];
} cs_bezier;

typedef enum cs_bezier_axis { CS_BEZIER_X, CS_BEZIER_Y } cs_bezier_axis;

/* The linear form x*X + y*Y + w*W + constant of a homogeneous point. */
typedef struct cs_bezier_form {
  double x, y, w, constant;
} cs_bezier_form;

/* A piece of an outline under a matrix. */
void cs_bezier_load(const cs_outline *outline, size_t piece, const celspan_matrix *matrix,
                    cs_bezier *out);
/* Copies only the points in use: most pieces have few. */
void cs_bezier_copy(const cs_bezier *piece, cs_bezier *copy);
cs_bezier cs_bezier_line(cs_hpoint from, cs_hpoint to);
void cs_bezier_reverse(cs_bezier *piece);
/* Chooses one of the two directions of the piece, always the same one for the same curve. Returns
 * whether the piece was reversed. */
bool cs_bezier_canonise(cs_bezier *piece);
bool cs_bezier_is_polynomial(const cs_bezier *piece); /* all weights equal */
/* Projected coordinate of a point with w > 0. */
static inline double cs_bezier_coordinate(cs_hpoint point, cs_bezier_axis axis) {
  return (axis == CS_BEZIER_X ? point.x : point.y) / point.w;
}

/* low and high have the same joint to the bit; either may be the piece itself. */
void cs_bezier_split(const cs_bezier *piece, double t, cs_bezier *low, cs_bezier *high);
/* Cuts *rest at the parameter t of the whole piece: *front becomes its beginning, and *rest the
 * remaining part. *from: the parameter at which *rest begins; becomes t. For ascending lists of
 * roots. */
void cs_bezier_cut_front(cs_bezier *rest, double *from, double t, cs_bezier *front);

/* The parameters inside (0, 1) at which a form changes its sign, ascending. Returns their
 * number. */
int cs_bezier_crossings(const cs_bezier *piece, cs_bezier_form form, double roots[CS_BEZIER_ROOTS]);
/* The parameters inside (0, 1) at which the polynomial with these Bernstein coefficients changes
 * its sign, ascending; at most as many as its degree. size: of the terms of which the coefficients
 * are sums. Returns their number. */
int cs_bezier_roots(const double *coefficients, int degree, double size, double *roots);
/* The parameters inside (0, 1) at which the polynomial with these Bernstein coefficients has an
 * extremum, ascending. Returns their number. */
int cs_bezier_turns(const double *coefficients, int degree, double *roots);
/* The parameters inside (0, 1) at which a projected coordinate has an extremum; weights must be >
 * 0. Returns their number. */
int cs_bezier_extrema(const cs_bezier *piece, cs_bezier_axis axis, double roots[CS_BEZIER_ROOTS]);

/* The least w, > 0, that counts as in front of the horizon for an outline under a matrix; false
 * when no point can be seen (w is 0 everywhere, or a number is not finite). */
bool cs_bezier_horizon(const cs_outline *outline, const celspan_matrix *matrix, double *least);

/* Calls visit for every part of the piece in front of the horizon, in order of parameter; all
 * weights of a part are > 0. Stops at the first status that is not OK and returns it. */
typedef celspan_status (*cs_bezier_visit)(void *user, const cs_bezier *part);
CELSPAN_CHECKED celspan_status cs_bezier_clip(const cs_bezier *piece, double least,
                                              cs_bezier_visit visit, void *user);
