#include "model/scene/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"

#define NAME_SIZE 96

/* Seven digits are enough to show paints and lights, which are floats, as they were given;
 * coordinates need more digits. */
cs_check_text cs_check_number_text(double value) {
  cs_check_text number = {"nan"}; /* the sign of NaN has no meaning */
  if (value != value)
    return number;
  snprintf(number.text, sizeof number.text, value == (float)value ? "%.7g" : "%.9g", value);
  char *comma = strchr(number.text, ',');
  if (comma)
    *comma = '.';
  char *plus = strchr(number.text, '+');
  if (plus) /* 1e+12 is 1e12, as scripts write it */
    memmove(plus, plus + 1, strlen(plus));
  return number;
}

celspan_status cs_check_range(celspan_context *context, const char *noun, const char *field,
                              double value, double low, double high) {
  if (value >= low && value <= high)
    return CELSPAN_OK;
  cs_check_text given = cs_check_number_text(value), least = cs_check_number_text(low),
                most = cs_check_number_text(high);
  if (!isfinite(value))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s must be a finite number, got %s", noun,
                   field, given.text);
  if (low == -CS_NUMBER_LIMIT || high != CS_NUMBER_LIMIT)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s is %s; it must be between %s and %s",
                   noun, field, given.text, least.text, most.text);
  if (value < low)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s is %s; it must be %s or more", noun,
                   field, given.text, least.text);
  return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s is %s; it must be at most %s", noun, field,
                 given.text, most.text);
}

celspan_status cs_check_number(celspan_context *context, const char *noun, const char *field,
                               double value) {
  return cs_check_range(context, noun, field, value, -CS_NUMBER_LIMIT, CS_NUMBER_LIMIT);
}

celspan_status cs_check_size(celspan_context *context, const char *noun, const char *field,
                             double value) {
  return cs_check_range(context, noun, field, value, 0, CS_NUMBER_LIMIT);
}

celspan_status cs_check_positive(celspan_context *context, const char *noun, const char *field,
                                 double value) {
  if (value <= 0 && isfinite(value))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s is %s; it must be more than 0", noun,
                   field, cs_check_number_text(value).text);
  return cs_check_size(context, noun, field, value);
}

celspan_status cs_check_share(celspan_context *context, const char *noun, const char *field,
                              double value, double *out) {
  CS_TRY(cs_check_number(context, noun, field, value));
  *out = value < 0 ? 0 : value > 1 ? 1 : value;
  return CELSPAN_OK;
}

celspan_status cs_check_item(celspan_context *context, cs_check_field at, double value, double low,
                             double high) {
  if (value >= low && value <= high)
    return CELSPAN_OK;
  char name[NAME_SIZE];
  const char *dot = *at.field && *at.member ? "." : "";
  if (at.index > 0)
    snprintf(name, sizeof name, "%s[%zu]%s%s", at.field, at.index, dot, at.member);
  else
    snprintf(name, sizeof name, "%s%s%s", at.field, dot, at.member);
  return cs_check_range(context, at.noun, name, value, low, high);
}

celspan_status cs_check_point(celspan_context *context, const char *noun, const char *field,
                              size_t index, celspan_point point) {
  CS_TRY(cs_check_item(context, (cs_check_field){noun, field, index, "x"}, point.x,
                       -CS_NUMBER_LIMIT, CS_NUMBER_LIMIT));
  return cs_check_item(context, (cs_check_field){noun, field, index, "y"}, point.y,
                       -CS_NUMBER_LIMIT, CS_NUMBER_LIMIT);
}

celspan_status cs_check_box(celspan_context *context, const char *noun, const char *field,
                            const celspan_box *box) {
  CS_TRY(cs_check_point(context, noun, field, 0, (celspan_point){box->x, box->y}));
  CS_TRY(cs_check_item(context, (cs_check_field){noun, field, 0, "width"}, box->width, 0,
                       CS_NUMBER_LIMIT));
  return cs_check_item(context, (cs_check_field){noun, field, 0, "height"}, box->height, 0,
                       CS_NUMBER_LIMIT);
}

celspan_status cs_check_paint(celspan_context *context, const char *noun, const char *field,
                              size_t index, const celspan_paint *paint) {
  static const char *const pigments[] = {"pigment[1]", "pigment[2]", "pigment[3]"};
  static const char *const mediums[] = {"medium[1]", "medium[2]", "medium[3]"};
  for (int c = 0; c < 3; c++) {
    CS_TRY(cs_check_item(context, (cs_check_field){noun, field, index, pigments[c]},
                         (double)paint->pigment[c], 0, 1));
    CS_TRY(cs_check_item(context, (cs_check_field){noun, field, index, mediums[c]},
                         (double)paint->medium[c], 0, 1));
  }
  return cs_check_item(context, (cs_check_field){noun, field, index, "beta"}, (double)paint->beta,
                       0, 1);
}

celspan_status cs_check_light(celspan_context *context, const char *noun, const char *field,
                              const celspan_light *light) {
  const float values[] = {light->r, light->g, light->b};
  static const char *const parts[] = {"r", "g", "b"};
  for (int c = 0; c < 3; c++)
    CS_TRY(cs_check_item(context, (cs_check_field){noun, field, 0, parts[c]}, (double)values[c], 0,
                         CS_NUMBER_LIMIT));
  return cs_check_item(context, (cs_check_field){noun, field, 0, "a"}, (double)light->a, 0, 1);
}

static celspan_status check_matrix(celspan_context *context, const char *noun,
                                   const celspan_matrix *matrix) {
  for (size_t i = 0; i < 9; i++)
    CS_TRY(cs_check_item(context, (cs_check_field){noun, "matrix", i + 1, ""}, matrix->m[i],
                         -CS_NUMBER_LIMIT, CS_NUMBER_LIMIT));
  return CELSPAN_OK;
}

celspan_status cs_check_transform(celspan_context *context, const celspan_matrix *there,
                                  const celspan_matrix *matrix, celspan_matrix *whole) {
  CS_TRY(cs_check_given(context, "transform", "the matrix", matrix));
  CS_TRY(check_matrix(context, "transform", matrix));
  *whole = celspan_matrix_then(*there, *matrix);
  return check_matrix(context, "transform, after those that are there", whole);
}

celspan_status cs_check_choice(celspan_context *context, const char *noun, const char *field,
                               unsigned value, unsigned count) {
  if (value < count)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s is %u; it must be between 0 and %u", noun,
                 field, value, count - 1);
}

celspan_status cs_check_given(celspan_context *context, const char *noun, const char *field,
                              const void *pointer) {
  if (pointer)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s is missing", noun, field);
}

celspan_status cs_check_list(celspan_context *context, const char *noun, const char *field,
                             const void *items, size_t count, size_t most) {
  if (count > most)
    return cs_fail(context, CELSPAN_LIMIT, "%s: %zu %s; at most %zu are allowed", noun, count,
                   field, most);
  return count > 0 ? cs_check_given(context, noun, field, items) : CELSPAN_OK;
}

celspan_status cs_check_one(celspan_context *context, const char *noun, const char *ways,
                            int given) {
  if (given == 1)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s of %s must be given", noun,
                 given == 0 ? "one" : "only one", ways);
}

/* ---------------------------------------------------------------- contours */

/* number: of the contour; place: of the coordinate in it, from 0. */
static celspan_status check_coordinate(celspan_context *context, const char *noun, size_t number,
                                       size_t place, double value) {
  char name[NAME_SIZE];
  if (cs_number_is_sane(value))
    return CELSPAN_OK;
  snprintf(name, sizeof name, "contours[%zu][%zu]", number, place + 1);
  return cs_check_number(context, noun, name, value);
}

static celspan_status check_contour(celspan_context *context, const char *noun, size_t number,
                                    const celspan_contour *contour) {
  size_t count = contour->point_count;
  if (!contour->points || count > CS_CHECK_ITEMS || count % 3 != 1)
    return cs_fail(context,
                   contour->points && count % 3 == 1 ? CELSPAN_LIMIT : CELSPAN_BAD_ARGUMENT,
                   "%s: contours[%zu] has %zu numbers; it must have 2, and 6 more for each piece, "
                   "at most %zu in all",
                   noun, number, contour->points ? 2 * count : 0, 2 * CS_CHECK_ITEMS);
  for (size_t i = 0; i < count; i++) {
    CS_TRY(check_coordinate(context, noun, number, 2 * i, contour->points[i].x));
    CS_TRY(check_coordinate(context, noun, number, 2 * i + 1, contour->points[i].y));
  }
  return CELSPAN_OK;
}

celspan_status cs_check_contours(celspan_context *context, const char *noun,
                                 const celspan_contour *contours, size_t count) {
  CS_TRY(cs_check_list(context, noun, "contours", contours, count, CS_CHECK_ITEMS));
  for (size_t i = 0; i < count; i++)
    CS_TRY(check_contour(context, noun, i + 1, &contours[i]));
  return CELSPAN_OK;
}
