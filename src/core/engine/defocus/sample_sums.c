#include "engine/defocus/sample_sums.h"

#include "base/elementary.h"
#include "base/number.h"
#include "engine/defocus/samples.h"

#include <math.h>

#define FACTOR 9 /* at most */
#define STEPS 64 /* steps of the integral over one sample */
#define TILE 64  /* nodes of a row that are summed together */

/* ---------------------------------------------------------------- weights */

/* The variance of the weights, in samples, for a blur of the given variance. Interpolating linearly
 * between samples spreads by 1/6. Boundaries are averaged over samples, which spreads them by
 * another 1/12, or by tents (sample_kernel in defocus.c), which spread by 1/6; 1/12 is subtracted,
 * too, so that neither pictures nor boundaries are off by more than 1/12. */
static double left_over(double variance) {
  return variance > 1 ? variance - 0.25 : 0.75 * variance;
}

/* A Gaussian of two standard deviations in `radius` samples, integrated over the linear pieces from
 * sample to sample. */
static void fill_weights(double radius, int32_t extent, float *weights) {
  double variance = left_over(0.25 * radius * radius), sum = 0, last = 2 * radius;
  for (int32_t k = extent; k >= 0; k--) {
    double weight = 0;
    for (int j = -STEPS; j < STEPS; j++) {
      double away = (j + 0.5) / STEPS, x = k + away;
      if (fabs(x) < last)
        weight += (1 - fabs(away)) * cs_elementary_exp(-0.5 * x * x / variance);
    }
    weights[k] = (float)weight;
    sum += (k > 0 ? 2 : 1) * weight;
  }
  for (int32_t k = 0; k <= extent; k++)
    weights[k] = (float)((double)weights[k] / sum);
}

/* The least odd factor that gives the radius enough samples. */
static int32_t choose_factor(double radius, double samples) {
  int32_t factor = 1;
  while (factor < FACTOR && factor * radius < samples)
    factor += 2;
  return factor;
}

/* Where a sample of a row is kept. */
static size_t place_of(const cs_defocus_sums *sums, int32_t sample) {
  size_t factor = (size_t)sums->factor, k = (size_t)sample;
  return k % factor * sums->places + k / factor;
}

static void find_pairs(cs_defocus_sums *sums) {
  int32_t x = sums->extent_x, y = sums->extent_y, half = sums->factor / 2;
  sums->places = (size_t)(TILE + 2 * x / sums->factor + 1);
  for (int32_t k = x; k >= 1; k--)
    sums->across[x - k] = (cs_defocus_pair){4 * place_of(sums, x + half - k),
                                            4 * place_of(sums, x + half + k), sums->weights_x[k]};
  for (int32_t k = y; k >= 1; k--)
    sums->down[y - k] = (cs_defocus_pair){4 * TILE * (size_t)(y + half - k),
                                          4 * TILE * (size_t)(y + half + k), sums->weights_y[k]};
}

celspan_status cs_defocus_sums_init(celspan_context *context, double radius_x, double radius_y,
                                    double samples, cs_defocus_sums *out) {
  *out = (cs_defocus_sums){.factor = choose_factor(fmin(radius_x, radius_y), samples)};
  const double x = out->factor * radius_x, y = out->factor * radius_y;
  out->extent_x = cs_number_ceil(2 * x);
  out->extent_y = cs_number_ceil(2 * y);
  CS_TRY(CS_ARRAY_MAKE(context, out->weights_x, (size_t)out->extent_x + 1));
  CS_TRY(CS_ARRAY_MAKE(context, out->weights_y, (size_t)out->extent_y + 1));
  CS_TRY(CS_ARRAY_MAKE(context, out->across, (size_t)out->extent_x));
  CS_TRY(CS_ARRAY_MAKE(context, out->down, (size_t)out->extent_y));
  fill_weights(x, out->extent_x, out->weights_x);
  fill_weights(y, out->extent_y, out->weights_y);
  find_pairs(out);
  return CELSPAN_OK;
}

void cs_defocus_sums_finish(cs_defocus_sums *sums, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, sums, weights_x, down);
  *sums = (cs_defocus_sums){0};
}

/* ---------------------------------------------------------------- sums */

/* The rows of samples under the rows of nodes that are being filled, and one tile of these rows. */
typedef struct summing {
  const cs_defocus_sums *sums;
  cs_isa isa;
  float amount;
  cs_defocus_samples samples; /* the samples under all nodes */
  cs_v4 *row;                 /* samples of one row under the tile, */
  cs_v4 *placed;              /* and by their place within a node's width */
  cs_v4 *middle;              /* the samples at the nodes, to sharpen them: TILE a row, or NULL */
  cs_v4 *across;              /* summed along the rows: TILE nodes a row */
  cs_v4 *out;                 /* TILE nodes */
} summing;

/* The nodes of a tile, rounded up to what is summed at once. */
static int32_t node_count(const summing *s) {
  const cs_defocus_sums *sums = s->sums;
  int32_t count = (s->samples.high - s->samples.low - 2 * sums->extent_x) / sums->factor;
  return (count + CS_DEFOCUS_SUMS_TOGETHER - 1) / CS_DEFOCUS_SUMS_TOGETHER *
         CS_DEFOCUS_SUMS_TOGETHER;
}

/* Returns the samples of row k by their place, which are in order where a node is one sample. */
static const cs_v4 *place_samples(summing *s, int32_t k) {
  size_t factor = (size_t)s->sums->factor, places = s->sums->places;
  size_t count = (size_t)(s->samples.high - s->samples.low);
  cs_v4 *first = s->placed;
  cs_defocus_samples_spread(&s->samples, k, s->row);
  if (factor == 1)
    return s->row;
  for (size_t at = 0; at < count; first++)
    for (size_t place = 0; place < factor && at < count; place++, at++)
      first[place * places] = s->row[at];
  return s->placed;
}

static void sum_across(void *user, int32_t k) {
  summing *s = user;
  const cs_defocus_sums *sums = s->sums;
  cs_v4 colour, *out = s->across + (size_t)k * TILE;
  cs_v4 *middle = s->middle ? s->middle + (size_t)k * TILE : NULL;
  if (cs_defocus_samples_are_one(&s->samples, k, &colour)) {
    for (int32_t x = 0; x < TILE; x++)
      out[x] = colour;
    for (int32_t x = 0; middle && x < TILE; x++)
      middle[x] = colour;
    return;
  }
  const cs_v4 *placed = place_samples(s, k);
  if (middle)
    memcpy(middle, s->row + sums->extent_x,
           (size_t)(s->samples.high - s->samples.low - 2 * sums->extent_x) * sizeof *middle);
  CS_WIDE_CHOOSE(s->isa, cs_defocus_sums_about)
  (sums->across, sums->extent_x, (const float *)placed,
   4 * place_of(sums, sums->extent_x + sums->factor / 2), node_count(s), (float *)out);
}

/* A sample, sharpened by the Gaussian around it. */
static cs_v4 sharpened(cs_v4 sample, cs_v4 soft, float amount) {
  if (!(amount > 0) || !(soft[3] > 0))
    return sample;
  cs_v4 sharp = sample + amount * (sample - sample[3] / soft[3] * soft);
  sharp[3] = sample[3];
  return cs_v4_max(sharp, cs_v4_all(0));
}

static void sum_down(void *user, int32_t y, int32_t count, float (*nodes)[4]) {
  summing *s = user;
  const cs_defocus_sums *sums = s->sums;
  size_t first = (size_t)(y * sums->factor), middle = (size_t)(sums->extent_y + sums->factor / 2);
  CS_WIDE_CHOOSE(s->isa, cs_defocus_sums_about)
  (sums->down, sums->extent_y, (const float *)(s->across + first * TILE), 4 * TILE * middle,
   node_count(s), (float *)s->out);
  const cs_v4 *samples = s->middle ? s->middle + (size_t)(y + sums->extent_y) * TILE : NULL;
  for (int32_t x = 0; samples && x < count; x++)
    s->out[x] = sharpened(samples[x], s->out[x], s->amount);
  memcpy(nodes, s->out, (size_t)count * sizeof *nodes);
}

celspan_status cs_defocus_sums_fill(const cs_defocus_sums *sums, cs_row_maker *maker, int plane,
                                    int32_t columns, int32_t first, int32_t end,
                                    float (*nodes)[4]) {
  /* what the cel lets through does not change */
  summing s = {.sums = sums, .isa = maker->painter.isa, .amount = plane == 0 ? sums->amount : 0};
  const cs_defocus_tiles tiles = {.columns = columns,
                                  .rows = end - first,
                                  .width = TILE,
                                  .factor = sums->factor,
                                  .extent = sums->extent_x,
                                  .take_row = sum_across,
                                  .sum_nodes = sum_down,
                                  .user = &s};
  int32_t rows = (end - first) * sums->factor + 2 * sums->extent_y;
  /* at least as many as the samples under a tile */
  size_t placed = sums->places * (size_t)sums->factor, across = (size_t)rows * TILE;
  size_t room = 2 * placed + TILE + (sums->sharpens ? 2 : 1) * across;
  celspan_status status =
      cs_defocus_samples_begin(maker, first * sums->factor, rows, room, &s.samples);
  if (status == CELSPAN_OK) {
    s.row = s.samples.room;
    s.placed = s.row + placed;
    s.out = s.placed + placed;
    s.across = s.out + TILE;
    s.middle = sums->sharpens ? s.across + across : NULL;
    cs_defocus_samples_sum(&s.samples, &tiles, nodes);
  }
  cs_defocus_samples_finish(&s.samples, maker->context->memory);
  return status;
}
