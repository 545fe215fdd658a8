#include "engine/kernel/kernel.h"

#include "base/elementary.h"
#include "base/number.h"

#include <math.h>
#include <string.h>

#define SAMPLES CS_ANTIALIAS_SAMPLES
/* Even shapes that are smaller than this and are averaged over a pixel count as separable: no edge
 * shows the difference. */
#define SMALL 0.4
#define OFFSETS 4
#define PLACES 256       /* in a pixel, at which light is measured */
#define UNNOTICED 0.0015 /* the change of an edge that is allowed in order to keep the light */
#define SHARP 0.8        /* a pixel: the peak of a Gaussian of radius 1.5 */
#define SHARPEST 8
#define PHASES 64 /* places of an edge in a pixel, for radii from 1 on */
#define PHASES_MOST 1024

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
    first[i + 1] = running / sum; /* ends with exactly 1: the same sum, added in the same order */
  }
}

/* The sum of the shares at the columns around an edge at -x, minus x. It is the same for every x if
 * the kernel's values at whole distances always sum to 1. */
static double light_at(const double *first, double radius, double x) {
  int32_t columns = cs_number_ceil(radius) + 1;
  double sum = 0;
  for (int32_t k = -columns; k <= columns; k++)
    sum += cs_kernel_interpolate(first, (x + k) / radius);
  return sum - x;
}

/* How missing light is spread: a trapezoid over `width` columns, whose values at whole distances
 * sum to 1. */
static double window(double width, double x) {
  return width > 1 ? cs_number_clamp(0.5 * width - fabs(x), 0, 1) / (width - 1)
                   : fabs(x) <= 0.5 * width;
}

/* Pixels are samples of the filtered picture, and the sum of a shape's light may depend on where it
 * lies between them. This reduces the differences as far as possible without changing any edge by
 * more than `most`. */
static void balance(double *first, double radius, double most) {
  double missing[PLACES], mean = 0, worst = 0, width = floor(2 * radius);
  if (width < 1)
    return;
  for (int j = 0; j < PLACES; j++) {
    missing[j] = -light_at(first, radius, (double)j / PLACES);
    mean += missing[j] / PLACES;
  }
  for (int j = 0; j < PLACES; j++) {
    missing[j] -= mean;
    worst = fmax(worst, fabs(missing[j]) * window(width, 0));
  }
  double share = worst > most ? most / worst : 1;
  for (int i = 1; i < SAMPLES; i++) {
    double x = (2.0 * i / SAMPLES - 1) * radius, at = (x - floor(x)) * PLACES;
    int j = (int)at;
    double here =
        missing[j % PLACES] + (at - j) * (missing[(j + 1) % PLACES] - missing[j % PLACES]);
    first[i] += share * here * window(width, x);
  }
}

/* The kernel's greatest value, a pixel. */
static double peak(const double *first, double radius) {
  double most = 0;
  for (int i = 0; i < SAMPLES; i++)
    most = fmax(most, fabs(first[i + 1] - first[i]));
  return most * (SAMPLES / 2) / radius;
}

/* Tabulates the shares along x of a kernel whose table along y is complete. */
static celspan_status finish(celspan_context *context, const double *first, cs_kernel *kernel) {
  kernel->per_radius_y = 1 / kernel->radius_y;
  double fineness = sqrt(peak(first, kernel->radius_x) * peak(kernel->above, kernel->radius_y));
  kernel->sharpness = fmin(fineness / SHARP, SHARPEST);
  kernel->phases = PHASES;
  while (kernel->phases < PHASES_MOST && kernel->phases * kernel->radius_x < PHASES)
    kernel->phases *= 2;
  kernel->columns = cs_number_ceil(kernel->radius_x);
  kernel->stride = (2 * kernel->columns + 2 + 3) / 4 * 4;
  CS_TRY(CS_ARRAY_MAKE(context, kernel->shares,
                       (size_t)(kernel->phases + 1) * (size_t)kernel->stride));
  for (int phase = 0; phase <= kernel->phases; phase++)
    for (int32_t k = 0; k < kernel->stride; k++) {
      double x = k - kernel->columns - (double)phase / kernel->phases;
      kernel->shares[phase * kernel->stride + k] =
          (float)cs_kernel_interpolate(first, x / kernel->radius_x);
    }
  return CELSPAN_OK;
}

celspan_status cs_kernel_create(celspan_context *context, const cs_antialias *antialias,
                                cs_kernel **out) {
  cs_kernel *kernel;
  CS_TRY(CS_MAKE(context, kernel, 1));
  kernel->radius_x = kernel->radius_y = antialias->radius;
  kernel->rows = antialias->rows;
  integrate(antialias->samples, kernel->above);
  for (int i = 0; i < SAMPLES; i++)
    kernel->is_signed |= kernel->above[i + 1] < kernel->above[i];
  balance(kernel->above, kernel->radius_y, UNNOTICED);
  celspan_status status = finish(context, kernel->above, kernel);
  if (status == CELSPAN_OK)
    *out = kernel;
  else
    cs_kernel_free(kernel, context->memory);
  return status;
}

void cs_kernel_free(cs_kernel *kernel, cs_memory *memory) {
  if (kernel)
    CS_ARRAYS_FREE(memory, kernel, shares, shares);
  cs_mem_free(memory, kernel, sizeof *kernel);
}

int32_t cs_kernel_extent(const cs_kernel *kernel) {
  double radius = kernel->radius_x > kernel->radius_y ? kernel->radius_x : kernel->radius_y;
  return cs_number_ceil(radius + 0.5 * kernel->spread + 0.5);
}

/* ---------------------------------------------------------------- defocused cels */

typedef struct axis { /* room for making a table */
  double samples[SAMPLES];
  double narrow[SAMPLES + 1], twice[SAMPLES + 1]; /* shares before the blur, and their integral */
  double first[SAMPLES + 1];
} axis;

/* The integral of the narrow shares up to u. */
static double integral(const axis *work, double u) {
  double at = (u + 1) * (SAMPLES / 2);
  if (!(at > 0))
    return 0;
  if (at >= SAMPLES)
    return work->twice[SAMPLES] + (u - 1);
  int i = (int)at;
  double t = at - i, low = work->narrow[i], high = work->narrow[i + 1];
  return work->twice[i] + (2.0 / SAMPLES) * t * (low + 0.5 * t * (high - low));
}

/* One axis of a defocus kernel: the shares left of the table's places. *radius: the radius of the
 * shape; after the call, the radius of the shape together with the blur. */
static void fill_axis(celspan_defocus_kernel kind, double blur, axis *work, double *radius,
                      double *first) {
  double narrow = *radius;
  for (int i = 0; i < SAMPLES; i++) {
    double u = middle(i);
    work->samples[i] = kind == CELSPAN_DEFOCUS_GAUSSIAN ? cs_elementary_exp(-8 * u * u)
                       : kind == CELSPAN_DEFOCUS_BOX    ? 1
                                                        : sqrt(1 - u * u);
  }
  integrate(work->samples, work->narrow);
  work->twice[0] = 0;
  for (int i = 0; i < SAMPLES; i++)
    work->twice[i + 1] = work->twice[i] + (work->narrow[i] + work->narrow[i + 1]) / SAMPLES;
  *radius = narrow + 0.5 * blur;
  if (blur == 0)
    memcpy(first, work->narrow, sizeof work->narrow);
  for (int i = 0; blur > 0 && i <= SAMPLES; i++) {
    double x = (2.0 * i / SAMPLES - 1) * *radius;
    double share =
        (integral(work, (x + 0.5 * blur) / narrow) - integral(work, (x - 0.5 * blur) / narrow)) *
        narrow / blur;
    first[i] = i == 0 ? 0 : i == SAMPLES ? 1 : cs_number_clamp(share, first[i - 1], 1);
  }
  balance(first, *radius, blur > 0 ? 1 : UNNOTICED);
}

static celspan_status fill_separable(celspan_context *context, const cs_blur *blur,
                                     cs_kernel *kernel) {
  axis *work;
  CS_TRY(CS_MAKE(context, work, 1));
  double scale = blur->kind == CELSPAN_DEFOCUS_GAUSSIAN ? 2 : 1;
  kernel->radius_x = scale * blur->radius_x;
  kernel->radius_y = scale * blur->radius_y;
  fill_axis(blur->kind, blur->blur, work, &kernel->radius_y, kernel->above);
  fill_axis(blur->kind, blur->blur, work, &kernel->radius_x, work->first);
  celspan_status status = finish(context, work->first, kernel);
  cs_mem_free(context->memory, work, sizeof *work);
  return status;
}

static bool chord_of_parallelogram(const cs_kernel *kernel, double d, double *from, double *to) {
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

bool cs_kernel_chord(const cs_kernel *kernel, double d, double *from, double *to) {
  if (kernel->shape == CS_KERNEL_PARALLELOGRAM)
    return chord_of_parallelogram(kernel, d, from, to);
  double v = d / kernel->radius_y, rest = 1 - v * v;
  if (!(rest > 0))
    return false;
  *to = kernel->radius_x * sqrt(rest);
  *from = -*to;
  return true;
}

static void fill_even(const cs_blur *blur, cs_kernel *kernel) {
  const double(*e)[2] = blur->edges;
  bool is_box = blur->kind == CELSPAN_DEFOCUS_BOX;
  kernel->shape = is_box ? CS_KERNEL_PARALLELOGRAM : CS_KERNEL_ELLIPSE;
  /* segments are weighted exactly; only the chord is approximate: it is the chord at the middle
   * height */
  kernel->rows = 8;
  kernel->radius_x = is_box ? fabs(e[0][0]) + fabs(e[1][0]) : blur->radius_x;
  kernel->radius_y = is_box ? fabs(e[0][1]) + fabs(e[1][1]) : blur->radius_y;
  kernel->per_radius_y = 1 / kernel->radius_y;
  bool turned = fabs(e[0][1]) > fabs(e[1][1]);
  memcpy(kernel->edges[0], e[turned ? 1 : 0], sizeof kernel->edges[0]);
  memcpy(kernel->edges[1], e[turned ? 0 : 1], sizeof kernel->edges[1]);
  kernel->offsets = blur->blur > 0 ? OFFSETS : 1;
  kernel->spread = blur->blur;
  double lengths[SAMPLES];
  for (int i = 0; i < SAMPLES; i++) {
    double from = 0, to = 0;
    cs_kernel_chord(kernel, middle(i) * kernel->radius_y, &from, &to);
    lengths[i] = to - from;
  }
  integrate(lengths, kernel->above);
}

bool cs_blur_is_upright(const cs_blur *blur) {
  const double(*e)[2] = blur->edges;
  return (e[0][1] == 0 && e[1][0] == 0) || (e[0][0] == 0 && e[1][1] == 0);
}

/* The upright box that spreads light equally far along each axis. */
static cs_blur as_upright(const cs_blur *blur) {
  cs_blur box = *blur;
  const double(*e)[2] = blur->edges;
  if (box.kind == CELSPAN_DEFOCUS_BOX) {
    box.radius_x = sqrt(e[0][0] * e[0][0] + e[1][0] * e[1][0]);
    box.radius_y = sqrt(e[0][1] * e[0][1] + e[1][1] * e[1][1]);
  }
  return box;
}

celspan_status cs_kernel_create_defocus(celspan_context *context, const cs_blur *blur,
                                        cs_kernel **out) {
  cs_kernel *kernel;
  CS_TRY(CS_MAKE(context, kernel, 1));
  cs_blur upright = as_upright(blur);
  double least = fmin(upright.radius_x, upright.radius_y);
  bool is_separable =
      blur->kind == CELSPAN_DEFOCUS_GAUSSIAN ||
      (blur->blur > 0 &&
       (least < SMALL || (blur->kind == CELSPAN_DEFOCUS_BOX && cs_blur_is_upright(blur))));
  kernel->rows = 16;
  celspan_status status = CELSPAN_OK;
  if (is_separable)
    status = fill_separable(context, &upright, kernel);
  else
    fill_even(blur, kernel);
  if (status == CELSPAN_OK)
    *out = kernel;
  else
    cs_kernel_free(kernel, context->memory);
  return status;
}
