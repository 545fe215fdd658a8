/* Whether a shape covers a point, by winding numbers. Shares no code with the sweep.
 *
 *             .---->----.             The winding at a point is the sum of the signed crossings of
 *            /           \            the contour with the ray from the point to the left: +1 where
 *   <-------|------x      |           the contour goes down, -1 where it goes up. Here it is -1:
 *           ^             v           inside by the nonzero rule, and by the even-odd rule.
 *            \           /
 *             '----<----'             Half open: a piece counts from its top, which is included,
 *                                     to its foot, which is not.
 *
 * A point is taken to a primitive's own units by the inverse of the matrix of all levels together.
 * A point behind the horizon is in no shape.
 */
#pragma once

#include "model/geometry/outline.h"
#include "model/scene/scene.h"

/* The point that a matrix maps to `point`; false when the matrix is singular or the point is behind
 * the horizon. */
bool cs_inside_own_point(const celspan_matrix *matrix, celspan_point point, celspan_point *out);

/* Halves a polynomial of a degree up to CS_STROKE_RADIUS_DEGREE, given by its Bernstein
 * coefficients. */
void cs_inside_halve(const double *whole, int degree, double *low, double *high);

/* Whether a point is inside an outline. Half-open, as pixels are: left and top edges are in, right
 * and bottom ones are out. */
bool cs_inside_outline(const cs_outline *outline, celspan_rule rule, celspan_point point);

/* Whether a point is inside a stroke: on a spoke, in a cap or in a join. Edges are in. */
bool cs_inside_stroke(const cs_stroke *stroke, celspan_point point);

/* Whether a point of its own units is inside a primitive, a rostrum's frame or a procedure's
 * bounds. */
static inline bool cs_inside_primitive(const cs_primitive_data *data, celspan_point point) {
  cs_outline_box room;
  if (data->stroke)
    return cs_inside_stroke(data->stroke, point);
  return cs_inside_outline(cs_primitive_data_outline(data, &room), data->rule, point);
}

/* Whether a boolean object is present at a point where `present` of its operands are present.
 * first: whether the first operand is among the present ones. */
static inline bool cs_inside_is_present(celspan_operator op, size_t present, size_t operand_count,
                                        bool first) {
  switch (op) {
  case CELSPAN_OPERATOR_UNION:
    return present > 0;
  case CELSPAN_OPERATOR_INTERSECTION:
    return present > 0 && present == operand_count;
  case CELSPAN_OPERATOR_DIFFERENCE:
    return first && present == 1;
  case CELSPAN_OPERATOR_XOR:
    return present % 2 == 1;
  case CELSPAN_OPERATOR_CLIP:
    return first && present == 2;
  }
  return first; /* a matte */
}

/* Whether a boolean object is painted with its operand of this index where that operand is
 * present. */
static inline bool cs_inside_shows(celspan_operator op, size_t index) {
  return index == 0 || (op != CELSPAN_OPERATOR_DIFFERENCE && op < CELSPAN_OPERATOR_CLIP);
}
