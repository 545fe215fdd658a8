#include "engine/defocus/edges.h"

#include "base/elementary.h"
#include "base/number.h"

#include <math.h>

#define PHASES CS_DEFOCUS_EDGES_PHASES
#define FINE 4   /* steps of the integral in a phase */
#define SIGMAS 4 /* where a Gaussian is cut off */

/* ---------------------------------------------------------------- tables */

static int32_t stride_of(const cs_defocus_edges *edges) { return 2 * edges->extent_x + 2; }

/* The integral of a Gaussian by the midpoint rule, up to every phase of every column from the left
 * end of the kernel on. */
static void integrate(double sigma, int32_t extent, int32_t count, double *sums) {
  const double step = 1.0 / (PHASES * FINE);
  double at = -extent - 1, sum = 0;
  for (int32_t i = 0; i <= count; i++) {
    for (double x = (double)i / PHASES - extent - 1; at + 0.5 * step < x; at += step) {
      double u = (at + 0.5 * step) / sigma;
      sum += fabs(u) < SIGMAS ? cs_elementary_exp(-0.5 * u * u) : 0;
    }
    sums[i] = sum;
  }
}

/* The share of the kernel to the left of each such place. */
static void find_shares(const cs_blur *blur, int32_t extent, int32_t count, double *shares) {
  const double(*e)[2] = blur->edges;
  double radius = fabs(e[0][0]) + fabs(e[1][0]);
  if (blur->kind != CELSPAN_DEFOCUS_BOX)
    integrate(0.5 * blur->radius_x, extent, count, shares);
  for (int32_t i = 0; i <= count; i++)
    shares[i] = blur->kind != CELSPAN_DEFOCUS_BOX
                    ? shares[i] / shares[count]
                    : cs_number_clamp(0.5 + 0.5 * ((double)i / PHASES - extent - 1) / radius, 0, 1);
}

/* shares[phase][k]: of the kernel around column k - extent_x, the share right of an edge that lies
 * phase/PHASES right of the centre of column 0. The kernel is even, so this is the share left of
 * the mirrored edge. */
static void order_shares(cs_defocus_edges *edges, int32_t count, const double *shares) {
  int32_t stride = stride_of(edges);
  for (int32_t i = 0; i <= count; i++) {
    int32_t phase = (PHASES - i % PHASES) % PHASES, k = (i + PHASES - 1) / PHASES - 1;
    float share = (float)shares[i];
    if (k >= 0 && k < stride)
      edges->shares[phase * stride + k] = share;
    if (phase == 0 && k + 1 < stride)
      edges->shares[PHASES * stride + k + 1] = share;
  }
}

static celspan_status fill_shares(celspan_context *context, const cs_blur *blur,
                                  cs_defocus_edges *edges) {
  int32_t count = PHASES * stride_of(edges);
  double *shares;
  CS_TRY(CS_MAKE(context, shares, (size_t)count + 1));
  find_shares(blur, edges->extent_x, count, shares);
  order_shares(edges, count, shares);
  cs_mem_free(context->memory, shares, ((size_t)count + 1) * sizeof *shares);
  return CELSPAN_OK;
}

/* The weight of a line k + 1/2 rows away. The tents already spread edges by a variance of 1/6,
 * which is subtracted from the variance of the Gaussian. */
static double weight_at(const cs_blur *blur, int32_t k) {
  const double(*e)[2] = blur->edges;
  double variance = 0.25 * blur->radius_y * blur->radius_y - 1.0 / 6, away = k + 0.5;
  return blur->kind == CELSPAN_DEFOCUS_BOX
             ? cs_number_clamp(fabs(e[0][1]) + fabs(e[1][1]) - k, 0, 1)
             : cs_elementary_exp(-0.5 * away * away / variance);
}

static void fill_weights(cs_defocus_edges *edges, const cs_blur *blur) {
  double sum = 0;
  for (int32_t k = edges->extent_y - 1; k >= 0; k--)
    sum += 2 * weight_at(blur, k);
  for (int32_t k = 0; k < edges->extent_y; k++)
    edges->weights[k] = (float)(weight_at(blur, k) / sum);
}

celspan_status cs_defocus_edges_init(celspan_context *context, const cs_blur *blur,
                                     cs_defocus_edges *out) {
  const double(*e)[2] = blur->edges;
  bool is_box = blur->kind == CELSPAN_DEFOCUS_BOX;
  double extent_x = is_box ? fabs(e[0][0]) + fabs(e[1][0]) : 0.5 * SIGMAS * blur->radius_x;
  double extent_y = is_box ? fabs(e[0][1]) + fabs(e[1][1]) : 0.5 * SIGMAS * blur->radius_y;
  *out = (cs_defocus_edges){.extent_x = cs_number_ceil(extent_x),
                            .extent_y = cs_number_ceil(extent_y)};
  CS_TRY(CS_ARRAY_MAKE(context, out->shares, (size_t)(PHASES + 1) * (size_t)stride_of(out)));
  CS_TRY(CS_ARRAY_MAKE(context, out->weights, (size_t)out->extent_y));
  CS_TRY(fill_shares(context, blur, out));
  fill_weights(out, blur);
  return CELSPAN_OK;
}

void cs_defocus_edges_finish(cs_defocus_edges *edges, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, edges, shares, weights);
  *edges = (cs_defocus_edges){0};
}
