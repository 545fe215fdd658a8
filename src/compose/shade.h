/* Textures given by a formula: the three-paint triangle, linear and radial gradients.
 *
 * Invariant: between the columns that cs_shade_breaks names, the paint is a smooth function of x on
 * a row, so the composer may cut it into straight pieces by looking at a few points.
 */
#ifndef CS_COMPOSE_SHADE_H
#define CS_COMPOSE_SHADE_H

#include "compose/stack.h"

/* Fills the planes of a triangle texture. */
void cs_shade_prepare(cs_shade *shade);
/* The paint at a point of the frame, pixels; clear behind the horizon. */
cs_paint cs_shade_paint(const cs_shade *shade, double x, double y);
/* Where on the row at height y the formula bends, x0 < x < x1: at most CS_SHADE_BREAKS(shade)
 * values, in no order. Returns how many. */
size_t cs_shade_breaks(const cs_shade *shade, double y, double x0, double x1, double *breaks);
/* Room that cs_shade_breaks needs at most. */
size_t cs_shade_break_limit(const cs_shade *shade);

#endif
