#include "model/geometry/matrix.h"

#include <math.h>

#include "base/elementary.h"
#include "base/number.h"

#define PI 3.14159265358979323846

bool cs_matrix_is_sane(const celspan_matrix *matrix) {
  for (int i = 0; i < 9; i++)
    if (!cs_number_is_sane(matrix->m[i]))
      return false;
  return true;
}

bool cs_matrix_is_upright(const celspan_matrix *matrix) {
  return cs_matrix_is_affine(matrix) && matrix->m[1] == 0 && matrix->m[3] == 0;
}

static celspan_matrix scaled(const celspan_matrix *matrix, double factor) {
  celspan_matrix out;
  for (int i = 0; i < 9; i++)
    out.m[i] = matrix->m[i] * factor;
  return out;
}

bool cs_matrix_mirrors(const celspan_matrix *matrix) {
  const double *m = matrix->m;
  return m[0] * (m[4] * m[8] - m[5] * m[7]) + m[1] * (m[5] * m[6] - m[3] * m[8]) +
             m[2] * (m[3] * m[7] - m[4] * m[6]) <
         0;
}

double cs_matrix_stretch(const celspan_matrix *matrix, double x, double y) {
  const double *m = matrix->m;
  cs_hpoint at = cs_matrix_apply(matrix, (cs_hpoint){x, y, 1});
  if (!(at.w > 0))
    return INFINITY;
  double u = at.x / at.w, v = at.y / at.w;
  double a = m[0] - u * m[6], b = m[1] - u * m[7], c = m[3] - v * m[6], d = m[4] - v * m[7];
  double squares = a * a + b * b + c * c + d * d, area = a * d - b * c;
  return sqrt(0.5 * (squares + sqrt(fmax(squares * squares - 4 * area * area, 0)))) / at.w;
}

celspan_matrix cs_matrix_facing(const celspan_matrix *matrix) {
  bool is_behind = cs_matrix_is_affine(matrix) && matrix->m[8] < 0;
  return is_behind ? scaled(matrix, -1) : *matrix;
}

/* ---------------------------------------------------------------- public */

celspan_matrix celspan_matrix_identity(void) { return celspan_matrix_scaling(1, 1); }

celspan_matrix celspan_matrix_translation(double dx, double dy) {
  return (celspan_matrix){{1, 0, dx, 0, 1, dy, 0, 0, 1}};
}

celspan_matrix celspan_matrix_scaling(double sx, double sy) {
  return (celspan_matrix){{sx, 0, 0, 0, sy, 0, 0, 0, 1}};
}

celspan_matrix celspan_matrix_rotation(double radians, celspan_point centre) {
  double s, c;
  cs_elementary_sincos(radians, &s, &c);
  return (celspan_matrix){{c, -s, centre.x - c * centre.x + s * centre.y, /* */
                           s, c, centre.y - s * centre.x - c * centre.y,  /* */
                           0, 0, 1}};
}

celspan_matrix cs_matrix_turn(double degrees, celspan_point centre) {
  double turn = fmod(degrees, 360);
  if (fmod(turn, 90) != 0)
    return celspan_matrix_rotation(turn * (PI / 180), centre);
  static const double cosines[] = {1, 0, -1, 0};
  int quarter = ((int)(turn / 90) + 4) % 4;
  double c = cosines[quarter], s = cosines[(quarter + 3) % 4];
  return (celspan_matrix){{c, -s, centre.x - c * centre.x + s * centre.y, s, c,
                           centre.y - s * centre.x - c * centre.y, 0, 0, 1}};
}

celspan_matrix celspan_matrix_skewing(double radians_x, double radians_y) {
  return (celspan_matrix){
      {1, cs_elementary_tan(radians_x), 0, cs_elementary_tan(radians_y), 1, 0, 0, 0, 1}};
}

celspan_matrix celspan_matrix_scaling_about(double sx, double sy, celspan_point centre) {
  return (celspan_matrix){
      {sx, 0, centre.x - sx * centre.x, 0, sy, centre.y - sy * centre.y, 0, 0, 1}};
}

celspan_matrix celspan_matrix_skewing_about(double radians_x, double radians_y,
                                            celspan_point centre) {
  celspan_matrix matrix = celspan_matrix_skewing(radians_x, radians_y);
  matrix.m[2] = 0 - matrix.m[1] * centre.y; /* never -0 */
  matrix.m[5] = 0 - matrix.m[3] * centre.x;
  return matrix;
}

celspan_matrix celspan_matrix_then(celspan_matrix first, celspan_matrix second) {
  celspan_matrix out;
  for (int row = 0; row < 3; row++)
    for (int column = 0; column < 3; column++)
      out.m[3 * row + column] = second.m[3 * row] * first.m[column] +
                                second.m[3 * row + 1] * first.m[3 + column] +
                                second.m[3 * row + 2] * first.m[6 + column];
  return out;
}

/* The transposed matrix of cofactors: the inverse times the determinant. */
static celspan_matrix adjugate(const celspan_matrix *matrix) {
  const double *m = matrix->m;
  return (celspan_matrix){
      {m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
       m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
       m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]}};
}

static bool is_finite(const celspan_matrix *matrix) {
  for (int i = 0; i < 9; i++)
    if (matrix->m[i] - matrix->m[i] != 0)
      return false;
  return true;
}

bool celspan_matrix_inverse(celspan_matrix matrix, celspan_matrix *out) {
  celspan_matrix cofactors = adjugate(&matrix);
  const double *m = matrix.m, *c = cofactors.m;
  double terms[3] = {m[0] * c[0], m[1] * c[3], m[2] * c[6]};
  double determinant = terms[0] + terms[1] + terms[2];
  double size = fabs(terms[0]) + fabs(terms[1]) + fabs(terms[2]);
  /* A determinant below this limit is only rounding. */
  if (!(fabs(determinant) > 1e-15 * size))
    return false;
  celspan_matrix inverse = scaled(&cofactors, 1 / determinant);
  if (!is_finite(&inverse))
    return false;
  *out = inverse;
  return true;
}

static double cross(celspan_point a, celspan_point b, celspan_point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* The map that takes (1,0,0), (0,1,0), (0,0,1) and (1,1,1) to the four points; false if three of
 * the points are on a line. Source: Heckbert, Fundamentals of texture mapping, 1989, section
 * 2.2.3. */
static bool from_frame(const celspan_point p[4], celspan_matrix *out) {
  double factor[3] = {cross(p[1], p[2], p[3]), cross(p[2], p[0], p[3]), cross(p[0], p[1], p[3])};
  double whole = cross(p[0], p[1], p[2]), size = 0;
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < i; j++) {
      double dx = p[i].x - p[j].x, dy = p[i].y - p[j].y;
      size = fmax(size, dx * dx + dy * dy);
    }
  double least = 1e-14 * size;
  if (!(fabs(whole) > least))
    return false;
  for (int i = 0; i < 3; i++) {
    if (!(fabs(factor[i]) > least))
      return false;
    double weight = factor[i] / whole;
    out->m[i] = p[i].x * weight;
    out->m[3 + i] = p[i].y * weight;
    out->m[6 + i] = weight;
  }
  return true;
}

/* Scales the matrix so that w is 1 at the point, which is then in front of the horizon. */
static bool face(celspan_matrix *matrix, celspan_point point) {
  double w = cs_matrix_apply(matrix, (cs_hpoint){point.x, point.y, 1}).w;
  if (w == 0)
    return false;
  *matrix = scaled(matrix, 1 / w);
  return is_finite(matrix);
}

bool celspan_matrix_quad(const celspan_point from[4], const celspan_point to[4],
                         celspan_matrix *out) {
  celspan_matrix frame_from, frame_to, back;
  if (!from_frame(from, &frame_from) || !from_frame(to, &frame_to))
    return false;
  back = adjugate(&frame_from);
  celspan_matrix quad = celspan_matrix_then(back, frame_to);
  if (!face(&quad, from[0]))
    return false;
  *out = quad;
  return true;
}
