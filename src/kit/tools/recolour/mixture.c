#include "tools/recolour/mixture.h"

#include <math.h>
#include <stdlib.h>

#include "inside/colour.h"
#include "inside/sort.h"

/* ---------------------------------------------------------------- tables */

static int compare(const void *a, const void *b) {
  const double x = ((const cs_swatch *)a)->code[0], y = ((const cs_swatch *)b)->code[0];
  return CS_SORT_ORDER(x, y);
}

static double mixed(const cs_swatches *swatches, double code) {
  return swatches->is_linear ? cs_transfer_light(code) : code;
}

cs_swatch cs_swatches_stay(const cs_swatches *swatches, const double code[3]) {
  cs_swatch swatch;
  for (int c = 0; c < 3; c++) {
    swatch.code[c] = code[c];
    swatch.at[c] = swatch.to[c] = mixed(swatches, code[c]);
  }
  return swatch;
}

celspan_status cs_swatches_init(celspan_context *context, const double *from, const double *to,
                                size_t count, bool is_linear, cs_swatches *out) {
  *out = (cs_swatches){.count = count, .is_linear = is_linear};
  CS_TRY(CS_MAKE(context, out->list, count));
  for (size_t i = 0; i < count; i++) {
    out->list[i] = cs_swatches_stay(out, from + 3 * i);
    for (int c = 0; c < 3; c++)
      out->list[i].to[c] = mixed(out, to[3 * i + (size_t)c]);
  }
  qsort(out->list, count, sizeof *out->list, compare);
  return CELSPAN_OK;
}

void cs_swatches_finish(celspan_context *context, cs_swatches *swatches) {
  cs_mem_free(context->memory, swatches->list, swatches->count * sizeof *swatches->list);
  swatches->list = NULL;
}

const cs_swatch *cs_swatches_find(const cs_swatches *swatches, const double code[3],
                                  double within) {
  size_t low = 0, high = swatches->count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (swatches->list[middle].code[0] < code[0] - within)
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < swatches->count; low++) {
    const double *own = swatches->list[low].code;
    if (own[0] > code[0] + within)
      return NULL;
    if (fabs(own[1] - code[1]) <= within && fabs(own[2] - code[2]) <= within)
      return &swatches->list[low];
  }
  return NULL;
}

void cs_swatches_light(const cs_swatches *swatches, const double to[3], double light[3]) {
  for (int c = 0; c < 3; c++)
    light[c] = swatches->is_linear ? to[c] : cs_transfer_light(to[c]);
}

/* ---------------------------------------------------------------- mixtures */

cs_mixture cs_mixture_begin(const cs_swatches *swatches, const double code[3]) {
  return (cs_mixture){swatches, cs_swatches_stay(swatches, code), HUGE_VAL};
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The shares of b and c in the mixture that is nearest to the colour; c is NULL for two. */
static bool solve(const double p[3], const double b[3], const double c[3], double *u, double *v) {
  double bb = dot(b, b), pb = dot(p, b);
  *v = 0;
  *u = bb > 0 ? fmin(fmax(pb / bb, 0), 1) : 0;
  if (!c)
    return true;
  double cc = dot(c, c), bc = dot(b, c), pc = dot(p, c), area = bb * cc - bc * bc;
  if (!(area > 1e-4 * bb * cc)) /* they lie on one line */
    return false;
  *u = (pb * cc - pc * bc) / area;
  *v = (pc * bb - pb * bc) / area;
  return *u >= 0 && *v >= 0 && *u + *v <= 1;
}

static double distance(const cs_mixture *mixture, const double at[3]) {
  double off[3];
  for (int c = 0; c < 3; c++)
    off[c] =
        (mixture->swatches->is_linear ? cs_transfer_code(at[c]) : at[c]) - mixture->colour.code[c];
  return sqrt(dot(off, off));
}

void cs_mixture_try(cs_mixture *mixture, const cs_swatch *a, const cs_swatch *b,
                    const cs_swatch *c) {
  double p[3], ab[3], ac[3], at[3], u, v;
  for (int i = 0; i < 3; i++) {
    p[i] = mixture->colour.at[i] - a->at[i];
    ab[i] = b->at[i] - a->at[i];
    ac[i] = c ? c->at[i] - a->at[i] : 0;
  }
  if (!solve(p, ab, c ? ac : NULL, &u, &v))
    return;
  for (int i = 0; i < 3; i++)
    at[i] = fmax(a->at[i] + u * ab[i] + v * ac[i], 0);
  double off = distance(mixture, at);
  if (off >= mixture->off)
    return;
  mixture->off = off;
  for (int i = 0; i < 3; i++)
    mixture->colour.to[i] =
        a->to[i] + u * (b->to[i] - a->to[i]) + (c ? v * (c->to[i] - a->to[i]) : 0);
}
