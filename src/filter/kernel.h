/* A filter kernel as rows use it: its antiderivatives, tabulated.
 *
 * In units of its radius, u in -1..1, a kernel is a step function over equal parts; its integral H
 * is then piecewise linear and the integral of that piecewise quadratic, both exact, so a filtered
 * edge has neither gap nor overlap: the weights that H gives to parts of a whole sum to 1.
 */
#ifndef CS_FILTER_KERNEL_H
#define CS_FILTER_KERNEL_H

#include "scene/antialias.h"

typedef struct cs_kernel {
  double radius_x, radius_y; /* pixels */
  int rows;                  /* pieces a slanted boundary is cut into, a row */
  bool is_signed;            /* negative somewhere */
  double first[CS_ANTIALIAS_SAMPLES + 1];  /* H at -1 + 2 i / SAMPLES: 0 .. 1 */
  double second[CS_ANTIALIAS_SAMPLES + 1]; /* the integral of H from -1, in units of the radius */
} cs_kernel;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_kernel_create(celspan_context *context,
                                                const cs_antialias *antialias, cs_kernel **out);
void cs_kernel_free(cs_kernel *kernel, cs_memory *memory);
/* Rows and columns a pixel's kernel may reach beyond it. */
int32_t cs_kernel_reach(const cs_kernel *kernel);

/* The share of the kernel below u, u in units of the radius. */
static inline double cs_kernel_below(const cs_kernel *kernel, double u) {
  double at = (u + 1) * (CS_ANTIALIAS_SAMPLES / 2);
  if (!(at > 0))
    return 0;
  if (at >= CS_ANTIALIAS_SAMPLES)
    return 1;
  int i = (int)at;
  return kernel->first[i] + (at - i) * (kernel->first[i + 1] - kernel->first[i]);
}

/* The integral of cs_kernel_below up to u. */
static inline double cs_kernel_sum(const cs_kernel *kernel, double u) {
  double at = (u + 1) * (CS_ANTIALIAS_SAMPLES / 2);
  if (!(at > 0))
    return 0;
  if (at >= CS_ANTIALIAS_SAMPLES)
    return kernel->second[CS_ANTIALIAS_SAMPLES] + (u - 1);
  int i = (int)at;
  double t = at - i, low = kernel->first[i], high = kernel->first[i + 1];
  return kernel->second[i] +
         (2.0 / CS_ANTIALIAS_SAMPLES) * t * (low + 0.5 * t * (high - low));
}

#endif
