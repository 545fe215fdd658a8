/* Transforms as attributes and styles write them: lists of functions, and the properties
 * `translate`, `rotate` and `scale`.
 *
 * A three-dimensional function is read if its result lies in the plane of the drawing.
 */
#pragma once

#include "readers/svg/words/values.h"

/* An angle with deg, grad, rad or turn, or without a unit, in degrees; similar to the functions of
 * values.h. */
bool cs_svg_take_angle(const char **text, double *degrees);

/* Each function reads the whole value; false: the value is invalid, or exceeds 1e12. Percentages
 * refer to the viewport of `measure`. */
bool cs_svg_parse_transform(const char *text, const cs_svg_measure *measure, celspan_matrix *out);
bool cs_svg_parse_translate(const char *text, const cs_svg_measure *measure, celspan_matrix *out);
bool cs_svg_parse_rotate(const char *text, celspan_matrix *out);
bool cs_svg_parse_scale(const char *text, celspan_matrix *out);
