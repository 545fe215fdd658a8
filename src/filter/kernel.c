#include "filter/kernel.h"

#include "base/elementary.h"
#include "base/number.h"

#include <math.h>
#include <string.h>

#define SAMPLES CS_ANTIALIAS_SAMPLES
/* Even shapes smaller than this, averaged over a pixel, are taken to be separable: no edge tells.
 */
#define SMALL 0.4
#define OFFSETS 4

/* ---------------------------------------------------------------- tables */

/* Where sample i of the middles lies, in units of the radius. */
static double middle(int i) { return (2 * i + 1.0) / SAMPLES - 1; }

static void integrate(const double *samples, double *first) {
  double sum = 0, running = 0;
  for (int i = 0; i < SAMPLES; i++)
    sum += samples[i];
  first[0] = 0;
  for (int i = 0; i < SAMPLES; i++) {
    running += samples[i];
    first[i + 1] = running / sum; /* ends on 1: the same sum, in the same order */
  }
}

static void integrate_again(cs_kernel *kernel) {
  kernel->second[0] = 0;
  for (int i = 0; i < SAMPLES; i++)
    kernel->second[i + 1] = kernel->second[i] + (kernel->first[i] + kernel->first[i + 1]) / SAMPLES;
}

static celspan_status make(celspan_context *context, cs_kernel **out) {
  *out = cs_mem_array(context->memory, 1, sizeof **out);
  return *out ? CELSPAN_OK : cs_fail_memory(context);
}

celspan_status cs_kernel_create(celspan_context *context, const cs_antialias *antialias,
                                cs_kernel **out) {
  cs_kernel *kernel;
  CS_TRY(make(context, &kernel));
  kernel->radius_x = kernel->radius_y = antialias->radius;
  kernel->rows = antialias->rows;
  integrate(antialias->samples, kernel->first);
  integrate_again(kernel);
  memcpy(kernel->above, kernel->first, sizeof kernel->above);
  for (int i = 0; i < SAMPLES; i++)
    kernel->is_signed |= kernel->first[i + 1] < kernel->first[i];
  *out = kernel;
  return CELSPAN_OK;
}

void cs_kernel_free(cs_kernel *kernel, cs_memory *memory) {
  cs_mem_free(memory, kernel, sizeof *kernel);
}

int32_t cs_kernel_reach(const cs_kernel *kernel) {
  double radius = kernel->radius_x > kernel->radius_y ? kernel->radius_x : kernel->radius_y;
  return cs_number_ceil(radius + 0.5 * kernel->spread + 0.5);
}

/* ---------------------------------------------------------------- soft layers */

/* One axis of a soft kernel: the shares left of the table's places. *radius: how far it reaches;
 * made wider by the blur. work: for the kernel before the blur. */
static void fill_axis(celspan_defocus_kernel kind, double blur, double *radius, double *first,
                      cs_kernel *work) {
  double samples[SAMPLES], narrow = *radius;
  for (int i = 0; i < SAMPLES; i++) {
    double u = middle(i);
    samples[i] = kind == CELSPAN_DEFOCUS_GAUSSIAN ? cs_elementary_exp(-8 * u * u) /* 4 sigmas */
                 : kind == CELSPAN_DEFOCUS_BOX    ? 1
                                                  : sqrt(1 - u * u);
  }
  integrate(samples, work->first);
  integrate_again(work);
  *radius = narrow + 0.5 * blur;
  if (blur == 0)
    memcpy(first, work->first, sizeof work->first);
  for (int i = 0; blur > 0 && i <= SAMPLES; i++) {
    double x = (2.0 * i / SAMPLES - 1) * *radius;
    double share = (cs_kernel_sum(work, (x + 0.5 * blur) / narrow) -
                    cs_kernel_sum(work, (x - 0.5 * blur) / narrow)) *
                   narrow / blur;
    first[i] = i == 0 ? 0 : i == SAMPLES ? 1 : cs_number_clamp(share, first[i - 1], 1);
  }
}

static celspan_status fill_separable(celspan_context *context, const cs_softness *softness,
                                     cs_kernel *kernel) {
  cs_kernel *work;
  CS_TRY(make(context, &work));
  double scale = softness->kind == CELSPAN_DEFOCUS_GAUSSIAN ? 2 : 1;
  kernel->radius_x = scale * softness->radius_x;
  kernel->radius_y = scale * softness->radius_y;
  fill_axis(softness->kind, softness->blur, &kernel->radius_y, kernel->above, work);
  fill_axis(softness->kind, softness->blur, &kernel->radius_x, kernel->first, work);
  integrate_again(kernel);
  cs_kernel_free(work, context->memory);
  return CELSPAN_OK;
}

static bool slice_parallelogram(const cs_kernel *kernel, double d, double *from, double *to) {
  const double(*e)[2] = kernel->edges;
  double low = -1, high = 1, steep = e[1][1];
  if (e[0][1] != 0) { /* d = s e0.y + t e1.y, |t| <= 1 */
    double a = (d - steep) / e[0][1], b = (d + steep) / e[0][1];
    low = cs_number_clamp(a < b ? a : b, -1, 1);
    high = cs_number_clamp(a < b ? b : a, -1, 1);
  }
  if (!(low <= high) || !(fabs(d) <= fabs(e[0][1]) + fabs(steep)))
    return false;
  double a = low * e[0][0] + (d - low * e[0][1]) / steep * e[1][0];
  double b = high * e[0][0] + (d - high * e[0][1]) / steep * e[1][0];
  *from = a < b ? a : b;
  *to = a < b ? b : a;
  return true;
}

bool cs_kernel_slice(const cs_kernel *kernel, double d, double *from, double *to) {
  if (kernel->shape == CS_KERNEL_PARALLELOGRAM)
    return slice_parallelogram(kernel, d, from, to);
  double v = d / kernel->radius_y, rest = 1 - v * v;
  if (!(rest > 0))
    return false;
  *to = kernel->radius_x * sqrt(rest);
  *from = -*to;
  return true;
}

static void fill_even(const cs_softness *softness, cs_kernel *kernel) {
  const double(*e)[2] = softness->edges;
  bool is_box = softness->kind == CELSPAN_DEFOCUS_BOX;
  kernel->shape = is_box ? CS_KERNEL_PARALLELOGRAM : CS_KERNEL_ELLIPSE;
  kernel->radius_x = is_box ? fabs(e[0][0]) + fabs(e[1][0]) : softness->radius_x;
  kernel->radius_y = is_box ? fabs(e[0][1]) + fabs(e[1][1]) : softness->radius_y;
  bool turned = fabs(e[0][1]) > fabs(e[1][1]);
  memcpy(kernel->edges[0], e[turned ? 1 : 0], sizeof kernel->edges[0]);
  memcpy(kernel->edges[1], e[turned ? 0 : 1], sizeof kernel->edges[1]);
  kernel->offsets = softness->blur > 0 ? OFFSETS : 1;
  kernel->spread = softness->blur;
  double lengths[SAMPLES];
  for (int i = 0; i < SAMPLES; i++) {
    double from = 0, to = 0;
    cs_kernel_slice(kernel, middle(i) * kernel->radius_y, &from, &to);
    lengths[i] = to - from;
  }
  integrate(lengths, kernel->above);
}

static bool is_upright(const cs_softness *softness) {
  const double(*e)[2] = softness->edges;
  return (e[0][1] == 0 && e[1][0] == 0) || (e[0][0] == 0 && e[1][1] == 0);
}

/* The upright box that spreads light as far along each axis. */
static cs_softness as_upright(const cs_softness *softness) {
  cs_softness box = *softness;
  const double(*e)[2] = softness->edges;
  if (box.kind == CELSPAN_DEFOCUS_BOX) {
    box.radius_x = sqrt(e[0][0] * e[0][0] + e[1][0] * e[1][0]);
    box.radius_y = sqrt(e[0][1] * e[0][1] + e[1][1] * e[1][1]);
  }
  return box;
}

celspan_status cs_kernel_create_soft(celspan_context *context, const cs_softness *softness,
                                     cs_kernel **out) {
  cs_kernel *kernel;
  CS_TRY(make(context, &kernel));
  cs_softness upright = as_upright(softness);
  double least = fmin(upright.radius_x, upright.radius_y);
  bool is_separable =
      softness->kind == CELSPAN_DEFOCUS_GAUSSIAN ||
      (softness->blur > 0 &&
       (least < SMALL || (softness->kind == CELSPAN_DEFOCUS_BOX && is_upright(softness))));
  kernel->rows = 16;
  celspan_status status = CELSPAN_OK;
  if (is_separable)
    status = fill_separable(context, &upright, kernel);
  else
    fill_even(softness, kernel);
  if (status == CELSPAN_OK)
    *out = kernel;
  else
    cs_kernel_free(kernel, context->memory);
  return status;
}
