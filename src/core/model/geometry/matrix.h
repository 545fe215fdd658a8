/* 3x3 homogeneous matrices, row-major, column vectors.
 *
 *        x' = X / W      ( X )   ( m0 m1 m2 ) ( x )
 *        y' = Y / W      ( Y ) = ( m3 m4 m5 ) ( y )
 *                        ( W )   ( m6 m7 m8 ) ( w )
 *
 *   W > 0: in front of the horizon     - - - - - - - -  W = 0: the horizon
 *   W <= 0: behind it, not visible       \         /
 *                                         \       /      lines that are parallel in the plane meet
 *                                          \     /       at the horizon of a perspective map
 *
 * An affine matrix (m6 = m7 = 0) has no horizon.
 */
#pragma once

#include "celspan/celspan.h"
#include "model/geometry/outline.h"

static inline cs_hpoint cs_matrix_apply(const celspan_matrix *matrix, cs_hpoint point) {
  const double *m = matrix->m;
  return (cs_hpoint){m[0] * point.x + m[1] * point.y + m[2] * point.w,
                     m[3] * point.x + m[4] * point.y + m[5] * point.w,
                     m[6] * point.x + m[7] * point.y + m[8] * point.w};
}
bool cs_matrix_is_sane(const celspan_matrix *matrix); /* every entry passes cs_number_is_sane */
static inline bool cs_matrix_is_affine(const celspan_matrix *matrix) {
  return matrix->m[6] == 0 && matrix->m[7] == 0;
}
/* Whether the matrix is affine and keeps a weight of 1. */
static inline bool cs_matrix_keeps_weights(const celspan_matrix *matrix) {
  return cs_matrix_is_affine(matrix) && matrix->m[8] == 1;
}
/* Affine without rotation or skew: rows stay rows and columns columns. */
bool cs_matrix_is_upright(const celspan_matrix *matrix);
/* Whether a clockwise curve in front of the horizon becomes counter-clockwise. */
bool cs_matrix_mirrors(const celspan_matrix *matrix);
/* The greatest factor by which lengths at a point are stretched, of all directions: the greater
 * singular value of the derivative. INFINITY at the horizon and behind it. */
double cs_matrix_stretch(const celspan_matrix *matrix, double x, double y);
/* The same map. For an affine matrix with m8 < 0 all signs are changed, so that W > 0. */
celspan_matrix cs_matrix_facing(const celspan_matrix *matrix);
/* A rotation by degrees, clockwise on the screen, about a centre. Quarter turns are exact, because
 * they use no rounded sine. */
celspan_matrix cs_matrix_turn(double degrees, celspan_point centre);
