#include "defocus/sums.h"

#include "base/elementary.h"
#include "base/number.h"

#include <math.h>

#define SAMPLES 4 /* in the lesser radius, where the factor allows it */
#define FACTOR 9  /* at most */
#define STEPS 64  /* of the integral over one sample */
#define TILE 128  /* nodes of a row that are summed together */

/* ---------------------------------------------------------------- weights */

/* The variance of the weights, in samples, for a blur of the given variance. Interpolating linearly
 * between samples spreads by 1/6. Boundaries are averaged by tents, which spread them by another
 * 1/6; half of that is subtracted too, so that neither pictures nor boundaries are off by more than
 * 1/12. */
static double left_over(double variance) {
  return variance > 1 ? variance - 0.25 : 0.75 * variance;
}

/* A Gaussian of two standard deviations in `radius` samples, integrated over the linear pieces from
 * sample to sample. */
static celspan_status fill_weights(celspan_context *context, double radius, int32_t *extent,
                                   float **out) {
  double variance = left_over(0.25 * radius * radius), sum = 0, last = 2 * radius;
  *extent = cs_number_ceil(last);
  size_t count = (size_t)*extent + 1;
  float *weights = cs_mem_array(context->memory, count, sizeof *weights);
  if (!weights)
    return cs_fail_memory(context);
  *out = weights;
  for (int32_t k = *extent; k >= 0; k--) {
    double weight = 0;
    for (int j = -STEPS; j < STEPS; j++) {
      double away = (j + 0.5) / STEPS, x = k + away;
      if (fabs(x) < last)
        weight += (1 - fabs(away)) * cs_elementary_exp(-0.5 * x * x / variance);
    }
    weights[k] = (float)weight;
    sum += (k > 0 ? 2 : 1) * weight;
  }
  for (size_t k = 0; k < count; k++)
    weights[k] = (float)((double)weights[k] / sum);
  return CELSPAN_OK;
}

/* The least odd factor that gives the radius enough samples. */
static int32_t choose_factor(double radius) {
  int32_t factor = 1;
  while (factor < FACTOR && factor * radius < SAMPLES)
    factor += 2;
  return factor;
}

celspan_status cs_defocus_sums_init(celspan_context *context, double radius_x, double radius_y,
                                    cs_defocus_sums *out) {
  *out = (cs_defocus_sums){.factor = choose_factor(fmin(radius_x, radius_y))};
  CS_TRY(fill_weights(context, out->factor * radius_x, &out->extent_x, &out->weights[0]));
  return fill_weights(context, out->factor * radius_y, &out->extent_y, &out->weights[1]);
}

void cs_defocus_sums_finish(cs_defocus_sums *sums, cs_memory *memory) {
  for (int axis = 0; axis < 2; axis++) {
    size_t extent = (size_t)(axis == 0 ? sums->extent_x : sums->extent_y);
    if (sums->weights[axis])
      cs_mem_free(memory, sums->weights[axis], (extent + 1) * sizeof(float));
  }
  *sums = (cs_defocus_sums){0};
}

/* ---------------------------------------------------------------- sums */

/* The rows of samples under the rows of nodes being filled, and one tile of these. */
typedef struct summing {
  const cs_defocus_sums *sums;
  cs_row *rows; /* of samples: those under all nodes */
  size_t *from; /* by row: the first span that may meet the tile */
  int32_t row_count, band_rows, columns;
  int32_t x0, x1;    /* nodes of the tile, */
  int32_t low, high; /* and the samples under them */
  cs_v4 *samples;    /* of one row */
  cs_v4 *across;     /* summed along the rows: TILE nodes a row */
} summing;

/* The one colour of a row's samples under the tile; false when there are several. */
static bool one_colour(summing *s, int32_t k, cs_v4 *out) {
  const cs_row *row = &s->rows[k];
  size_t i = s->from[k];
  while (row->spans[i].x1 <= s->low)
    i++;
  s->from[k] = i;
  *out = cs_v4_load(row->spans[i].colour);
  return row->spans[i].kind == CELSPAN_SPAN_SINGLE && row->spans[i].x1 >= s->high;
}

static void spread_samples(summing *s, int32_t k) {
  const cs_row *row = &s->rows[k];
  for (size_t i = s->from[k]; i < row->count && row->spans[i].x0 < s->high; i++) {
    const celspan_span *span = &row->spans[i];
    int32_t x = span->x0 > s->low ? span->x0 : s->low;
    int32_t stop = span->x1 < s->high ? span->x1 : s->high;
    for (; x < stop; x++) {
      float rgba[4];
      celspan_span_colour(span, x, rgba);
      s->samples[x - s->low] = cs_v4_load(rgba);
    }
  }
}

/* The weighted sum of the values around *value, which are `stride` apart. Differences from the
 * middle value are summed, so that equal values keep their bits. */
static inline cs_v4 sum_about(const cs_v4 *value, size_t stride, const float *weights,
                              int32_t extent) {
  cs_v4 centre = *value, sum = cs_v4_all(0);
  for (int32_t k = extent; k >= 1; k--) {
    size_t away = (size_t)k * stride;
    sum += weights[k] * ((value[away] - centre) + (*(value - away) - centre));
  }
  return centre + sum;
}

static void sum_across(summing *s, int32_t k) {
  const cs_defocus_sums *sums = s->sums;
  cs_v4 colour, *out = s->across + (size_t)k * TILE;
  int32_t width = s->x1 - s->x0;
  if (one_colour(s, k, &colour)) {
    for (int32_t x = 0; x < width; x++)
      out[x] = colour;
    return;
  }
  spread_samples(s, k);
  const cs_v4 *centre = s->samples + sums->extent_x + sums->factor / 2;
  for (int32_t x = 0; x < width; x++)
    out[x] = sum_about(centre + x * sums->factor, 1, sums->weights[0], sums->extent_x);
}

/* Whether all rows are one colour under the tile. */
static bool is_plain(summing *s, cs_v4 *colour) {
  bool plain = one_colour(s, 0, colour);
  for (int32_t k = 1; k < s->row_count; k++) {
    cs_v4 other;
    plain = one_colour(s, k, &other) && plain && cs_v4_same(other, *colour);
  }
  return plain;
}

static void sum_tile(summing *s, float (*nodes)[4]) {
  const cs_defocus_sums *sums = s->sums;
  size_t columns = (size_t)s->columns;
  cs_v4 colour;
  bool plain = is_plain(s, &colour);
  for (int32_t k = 0; k < s->row_count && !plain; k++)
    sum_across(s, k);
  for (int32_t y = 0; y < s->band_rows; y++) {
    int32_t row = y * sums->factor + sums->extent_y + sums->factor / 2;
    const cs_v4 *centre = s->across + (size_t)row * TILE;
    for (int32_t x = s->x0; x < s->x1; x++) {
      cs_v4 value =
          plain ? colour : sum_about(centre + (x - s->x0), TILE, sums->weights[1], sums->extent_y);
      cs_v4_store(nodes[(size_t)y * columns + (size_t)x], value);
    }
  }
}

static celspan_status sum_rows(summing *s, cs_row_maker *maker, int32_t first, float (*nodes)[4]) {
  int32_t factor = s->sums->factor;
  for (int32_t k = 0; k < s->row_count; k++)
    CS_TRY(cs_row_make(maker, first * factor + k, &s->rows[k]));
  for (s->x0 = 0; s->x0 < s->columns; s->x0 = s->x1) {
    s->x1 = s->columns - s->x0 < TILE ? s->columns : s->x0 + TILE;
    s->low = s->x0 * factor;
    s->high = s->x1 * factor + 2 * s->sums->extent_x;
    sum_tile(s, nodes);
  }
  return CELSPAN_OK;
}

celspan_status cs_defocus_sums_fill(const cs_defocus_sums *sums, cs_row_maker *maker,
                                    int32_t columns, int32_t first, int32_t end,
                                    float (*nodes)[4]) {
  cs_memory *memory = maker->context->memory;
  summing s = {.sums = sums, .band_rows = end - first, .columns = columns};
  s.row_count = s.band_rows * sums->factor + 2 * sums->extent_y;
  size_t rows = (size_t)s.row_count;
  size_t samples = TILE * (size_t)sums->factor + 2 * (size_t)sums->extent_x;
  s.rows = cs_mem_array(memory, rows, sizeof *s.rows);
  s.from = cs_mem_array(memory, rows, sizeof *s.from);
  s.samples = cs_mem_array(memory, samples, sizeof *s.samples);
  s.across = cs_mem_array(memory, rows * TILE, sizeof *s.across);
  celspan_status status = s.rows && s.from && s.samples && s.across
                              ? sum_rows(&s, maker, first, nodes)
                              : cs_fail_memory(maker->context);
  for (size_t k = 0; s.rows && k < rows; k++)
    cs_row_finish(&s.rows[k], memory);
  cs_mem_free(memory, s.rows, rows * sizeof *s.rows);
  cs_mem_free(memory, s.from, rows * sizeof *s.from);
  cs_mem_free(memory, s.samples, samples * sizeof *s.samples);
  cs_mem_free(memory, s.across, rows * TILE * sizeof *s.across);
  return status;
}
