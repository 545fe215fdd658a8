/* Transforms as attributes and styles write them: lists of functions, and the properties
 * `translate`, `rotate` and `scale`.
 *
 * A function in space is read where all that it does lies in the plane of the drawing.
 */
#pragma once

#include "readers/svg/values.h"

/* An angle with deg, grad, rad or turn, or in degrees, as degrees; as the functions of values.h. */
bool cs_svg_take_angle(const char **text, double *degrees);

/* Each takes the whole value; false: it is invalid, or goes beyond 1e12. Percentages are of the
 * viewport of `measure`. */
bool cs_svg_parse_transform(const char *text, const cs_svg_measure *measure, celspan_matrix *out);
bool cs_svg_parse_translate(const char *text, const cs_svg_measure *measure, celspan_matrix *out);
bool cs_svg_parse_rotate(const char *text, celspan_matrix *out);
bool cs_svg_parse_scale(const char *text, celspan_matrix *out);
