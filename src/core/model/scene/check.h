/* Checks of arguments: every argument of a scene value is checked here, once. A wrong argument is
 * refused with a sentence that names the noun, the field, the value given and the values allowed.
 *
 *   circle: radius is -3; it must be 0 or more
 *   polygon: points[4].x must be a finite number, got nan
 *
 * Lists are counted from 1, as scripts count them. All functions: BAD_ARGUMENT, or OK.
 */
#pragma once

#include "base/context.h"

/* A number for a message: short, and with a decimal point in every locale. */
typedef struct cs_check_text {
  char text[32];
} cs_check_text;
cs_check_text cs_check_number_text(double value);

/* low <= value <= high */
CELSPAN_CHECKED celspan_status cs_check_range(celspan_context *context, const char *noun,
                                              const char *field, double value, double low,
                                              double high);
/* Finite, |value| <= 1e12. */
CELSPAN_CHECKED celspan_status cs_check_number(celspan_context *context, const char *noun,
                                               const char *field, double value);
/* 0 <= value <= 1e12 */
CELSPAN_CHECKED celspan_status cs_check_size(celspan_context *context, const char *noun,
                                             const char *field, double value);
/* 0 < value <= 1e12 */
CELSPAN_CHECKED celspan_status cs_check_positive(celspan_context *context, const char *noun,
                                                 const char *field, double value);
/* Clamps a finite value to 0..1, because the curves that give shares overshoot. */
CELSPAN_CHECKED celspan_status cs_check_share(celspan_context *context, const char *noun,
                                              const char *field, double value, double *out);
/* The name of a field such as stops[2].at: `member` ("": none) of item `index`, counted from 1;
 * index 0: the field is not a list. */
typedef struct cs_check_field {
  const char *noun, *field;
  size_t index;
  const char *member;
} cs_check_field;

/* As cs_check_range. */
CELSPAN_CHECKED celspan_status cs_check_item(celspan_context *context, cs_check_field at,
                                             double value, double low, double high);
/* Both coordinates are numbers. index as above. */
CELSPAN_CHECKED celspan_status cs_check_point(celspan_context *context, const char *noun,
                                              const char *field, size_t index, celspan_point point);
/* The corner is a number, the sides are sizes. */
CELSPAN_CHECKED celspan_status cs_check_box(celspan_context *context, const char *noun,
                                            const char *field, const celspan_box *box);
/* All seven values in 0..1. field "": the values are called by their own names; index as above. */
CELSPAN_CHECKED celspan_status cs_check_paint(celspan_context *context, const char *noun,
                                              const char *field, size_t index,
                                              const celspan_paint *paint);
/* r, g, b are sizes; a is in 0..1. */
CELSPAN_CHECKED celspan_status cs_check_light(celspan_context *context, const char *noun,
                                              const char *field, const celspan_light *light);
/* *whole: the map that applies `there` and then `matrix`. */
CELSPAN_CHECKED celspan_status cs_check_transform(celspan_context *context,
                                                  const celspan_matrix *there,
                                                  const celspan_matrix *matrix,
                                                  celspan_matrix *whole);
/* An enumeration whose values are 0 .. count - 1. */
CELSPAN_CHECKED celspan_status cs_check_choice(celspan_context *context, const char *noun,
                                               const char *field, unsigned value, unsigned count);
/* A pointer that may not be NULL. */
CELSPAN_CHECKED celspan_status cs_check_given(celspan_context *context, const char *noun,
                                              const char *field, const void *pointer);
/* Items of a list where there is no lower limit: scripts cannot have more either. */
#define CS_CHECK_ITEMS ((size_t)10000000)
/* A list of `count` items, before the first of them is read: it may be NULL where the count is 0.
 * Errors: also LIMIT, beyond `most`. */
CELSPAN_CHECKED celspan_status cs_check_list(celspan_context *context, const char *noun,
                                             const char *field, const void *items, size_t count,
                                             size_t most);
/* Contours have the right numbers of points, all of which are numbers. A message counts the numbers
 * as scripts do: contours[2][9] is the x of the fifth point. Errors: also LIMIT. */
CELSPAN_CHECKED celspan_status cs_check_contours(celspan_context *context, const char *noun,
                                                 const celspan_contour *contours, size_t count);
/* A line or an outline that can be given in several ways: one of them is. given: how many are.
 * ways: for the message, "points, d and outline". */
CELSPAN_CHECKED celspan_status cs_check_one(celspan_context *context, const char *noun,
                                            const char *ways, int given);
