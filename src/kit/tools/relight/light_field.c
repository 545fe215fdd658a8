#include "tools/relight/light_field.h"

#include <math.h>

#include "inside/elementary.h"
#include "inside/scene.h"
#include "tools/relight/original.h"

/* Lights are limited to this range, and fields to this range times exp(EXPONENT), so that quotients
 * remain finite. */
#define DIMMEST 1e-6
#define BRIGHTEST 1e6
#define EXPONENT 20

const char *cs_light_field_channel(int c) {
  static const char *const names[3] = {"red", "green", "blue"};
  return names[c];
}

celspan_light_field celspan_light_field_flat(double r, double g, double b) {
  return (celspan_light_field){.colour = {r, g, b}};
}

bool cs_light_field_is_flat(const celspan_light_field *field) {
  for (int c = 0; c < 3; c++)
    for (int k = 0; k < CELSPAN_LIGHT_FIELD_TERMS; k++)
      if (field->terms[c][k] != 0)
        return false;
  return true;
}

void cs_light_field_basis(double x, double y, double basis[CELSPAN_LIGHT_FIELD_TERMS]) {
  const double values[CELSPAN_LIGHT_FIELD_TERMS] = {
      x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y};
  for (int k = 0; k < CELSPAN_LIGHT_FIELD_TERMS; k++)
    basis[k] = values[k];
}

celspan_status cs_light_field_check(celspan_context *context, const char *noun,
                                    const celspan_light_field *field) {
  CS_TRY(cs_check_given(context, noun, "the light", field));
  for (int c = 0; c < 3; c++) {
    double sum = 0;
    if (field->colour[c] == 0)
      return cs_fail(
          context, CELSPAN_BAD_ARGUMENT,
          "%s: there is no %s in the light, so what the picture would be in %s cannot be "
          "known; every channel of a light that is taken off must be above 0",
          noun, cs_light_field_channel(c), cs_light_field_channel(c));
    if (!(field->colour[c] >= DIMMEST && field->colour[c] <= BRIGHTEST))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "%s: the %s of the light must be from %g to %g, got %s", noun,
                     cs_light_field_channel(c), DIMMEST, BRIGHTEST,
                     cs_check_number_text(field->colour[c]).text);
    for (int k = 0; k < CELSPAN_LIGHT_FIELD_TERMS; k++)
      sum += fabs(field->terms[c][k]);
    if (!(sum <= EXPONENT))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "%s: the terms of the light's %s must not sum to more than %d", noun,
                     cs_light_field_channel(c), EXPONENT);
  }
  return CELSPAN_OK;
}

void celspan_light_field_at(const celspan_light_field *field, double u, double v, double rgb[3]) {
  double basis[CELSPAN_LIGHT_FIELD_TERMS];
  cs_light_field_basis(2 * u - 1, 2 * v - 1, basis);
  for (int c = 0; c < 3; c++) {
    double sum = 0;
    for (int k = 0; k < CELSPAN_LIGHT_FIELD_TERMS; k++)
      sum += field->terms[c][k] * basis[k];
    rgb[c] = field->colour[c] * (sum == 0 ? 1 : cs_elementary_exp(sum));
  }
}

cs_light_row cs_light_row_make(const celspan_light_field *field, int32_t width, int32_t height,
                               int32_t y) {
  return (cs_light_row){field, width, height, y, cs_light_field_is_flat(field)};
}

void cs_light_row_at(const cs_light_row *row, int32_t x, double rgb[3]) {
  if (!row->is_flat) {
    celspan_light_field_at(row->field, (x + 0.5) / row->width, (row->y + 0.5) / row->height, rgb);
    return;
  }
  for (int c = 0; c < 3; c++)
    rgb[c] = row->field->colour[c];
}

/* ---------------------------------------------------------------- as a texture */

celspan_status celspan_light_field_texture(celspan_context *context,
                                           const celspan_light_field *field, int32_t width,
                                           int32_t height, celspan_texture **out) {
  CS_TRY(cs_light_field_check(context, "light", field));
  cs_unlit unlit;
  CS_TRY(cs_unlit_create(context, width, height, false, &unlit));
  for (int32_t y = 0; y < height; y++) {
    cs_light_row row = cs_light_row_make(field, width, height, y);
    for (int32_t x = 0; x < width; x++) {
      double rgb[3];
      float *pixel = cs_unlit_paint(&unlit, x, y);
      cs_light_row_at(&row, x, rgb);
      for (int c = 0; c < 3; c++)
        pixel[c] = (float)rgb[c];
      pixel[3] = 1;
    }
  }
  return cs_unlit_finish(context, &unlit, NULL, out);
}
