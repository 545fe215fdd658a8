#include "model/scene/antialias.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/description.h"
#include "base/elementary.h"
#include "base/number.h"
#include "model/scene/check.h"

#define RADIUS_LIMIT 256
#define ROWS_LIMIT 256
#define ROWS 16
#define PI 3.14159265358979323846
/* A kernel counts as having no sum if the sum of its values is less than this share of the sum of
 * their magnitudes: dividing by such a sum would enlarge rounding errors. */
#define NOTHING 1e-6

static double sinc(double x) {
  double sine, cosine;
  if (x == 0)
    return 1;
  cs_elementary_sincos(PI * x, &sine, &cosine);
  return sine / (PI * x);
}

/* Mitchell and Netravali's piecewise cubic with B = C = 1/3 (1988), for |x| <= 2. */
static double mitchell(double x) {
  double a = fabs(x);
  return a < 1 ? ((7 * a - 12) * a * a + 16.0 / 3) / 6
               : (((-7.0 / 3 * a + 12) * a - 20) * a + 32.0 / 3) / 6;
}

/* The kernel at x pixels from its centre, |x| < radius, up to a factor. */
static celspan_status kernel_value(celspan_context *context, const celspan_filter_desc *desc,
                                   double radius, double x, double *out) {
  double u = x / radius;
  switch (desc->kernel) {
  case CELSPAN_KERNEL_BOX:
    *out = 1;
    break;
  case CELSPAN_KERNEL_GAUSSIAN:
    *out = cs_elementary_exp(-4.5 * u * u);
    break;
  case CELSPAN_KERNEL_MITCHELL:
    *out = mitchell(2 * u);
    break;
  case CELSPAN_KERNEL_LANCZOS:
    *out = sinc(x) * sinc(u);
    break;
  case CELSPAN_KERNEL_FUNCTION:
    return desc->function(desc->function_user, context, x, out);
  }
  return CELSPAN_OK;
}

static celspan_status refuse_value(celspan_context *context, const char *noun, double x,
                                   double value) {
  char field[64];
  snprintf(field, sizeof field, "the kernel's value at %s", cs_check_number_text(x).text);
  return cs_check_number(context, noun, field, value);
}

static celspan_status sample(celspan_context *context, const char *noun,
                             const celspan_filter_desc *desc, const cs_antialias *antialias) {
  double sum = 0, size = 0;
  for (int i = 0; i < CS_ANTIALIAS_SAMPLES; i++) {
    double x = ((2 * i + 1.0) / CS_ANTIALIAS_SAMPLES - 1) * antialias->radius, value = 0;
    CS_TRY(kernel_value(context, desc, antialias->radius, x, &value));
    if (!cs_number_is_sane(value))
      return refuse_value(context, noun, x, value);
    antialias->samples[i] = value;
    sum += value;
    size += fabs(value);
  }
  if (!(fabs(sum) > NOTHING * size))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: the kernel sums to nothing within its radius of %s", noun,
                   cs_check_number_text(antialias->radius).text);
  return CELSPAN_OK;
}

static celspan_status check(celspan_context *context, const char *noun,
                            const celspan_filter_desc *desc) {
  bool is_function = desc->kernel == CELSPAN_KERNEL_FUNCTION;
  CS_TRY(cs_check_choice(context, noun, "kernel", (unsigned)desc->kernel,
                         CELSPAN_KERNEL_FUNCTION + 1));
  if (is_function && !desc->function)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: kernel has no function", noun);
  if (is_function && !desc->has_radius)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: radius is missing; a kernel given as a function needs one", noun);
  if (desc->has_radius)
    CS_TRY(cs_check_range(context, noun, "radius", desc->radius, 0, RADIUS_LIMIT));
  return cs_check_range(context, noun, "rows", desc->rows, 1, ROWS_LIMIT);
}

celspan_status cs_antialias_make(celspan_context *context, const char *noun,
                                 celspan_antialias_mode mode, const celspan_filter_desc *desc,
                                 cs_antialias *out) {
  static const double radii[] = {0.5, 1.5, 2, 3, 0};
  CS_TRY(cs_check_choice(context, noun, "mode", (unsigned)mode, CELSPAN_ANTIALIAS_FILTER + 1));
  *out = (cs_antialias){.mode = mode};
  if (mode != CELSPAN_ANTIALIAS_FILTER)
    return CELSPAN_OK;
  if (!desc)
    desc = cs_celspan_filter_desc_description.defaults;
  CS_READ(context, noun, celspan_filter_desc, desc);
  CS_TRY(check(context, noun, desc));
  out->radius = desc->has_radius ? desc->radius : radii[desc->kernel];
  out->rows = desc->rows;
  if (out->radius == 0) {
    *out = (cs_antialias){.mode = CELSPAN_ANTIALIAS_NONE};
    return CELSPAN_OK;
  }
  CS_TRY(CS_MAKE(context, out->samples, CS_ANTIALIAS_SAMPLES));
  celspan_status status = sample(context, noun, desc, out);
  if (status != CELSPAN_OK)
    cs_antialias_free(out, context->memory);
  return status;
}

celspan_status cs_antialias_copy(celspan_context *context, const cs_antialias *from,
                                 cs_antialias *out) {
  *out = *from;
  if (!from->samples)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, out->samples, CS_ANTIALIAS_SAMPLES));
  memcpy(out->samples, from->samples, CS_ANTIALIAS_SAMPLES * sizeof *out->samples);
  return CELSPAN_OK;
}

void cs_antialias_free(cs_antialias *antialias, cs_memory *memory) {
  cs_mem_free(memory, antialias->samples, CS_ANTIALIAS_SAMPLES * sizeof *antialias->samples);
  *antialias = (cs_antialias){0};
}

void cs_antialias_hash(cs_hash *hash, const cs_antialias *antialias) {
  cs_hash_word(hash, antialias->mode);
  if (antialias->mode != CELSPAN_ANTIALIAS_FILTER)
    return;
  cs_hash_number(hash, antialias->radius);
  cs_hash_word(hash, (uint64_t)antialias->rows);
  cs_hash_bytes(hash, antialias->samples, CS_ANTIALIAS_SAMPLES * sizeof *antialias->samples);
}
