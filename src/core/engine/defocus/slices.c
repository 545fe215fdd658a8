#include "engine/defocus/slices.h"

#include "base/number.h"
#include "engine/defocus/samples.h"

#include <math.h>

#define SAMPLES 16 /* in the smaller radius, if the factor allows it */
#define FACTOR 9   /* at most; odd, so that a node lies in the middle of a sample */
#define TILE 64    /* nodes of a row that are summed together */
#define SHORT 1e-6 /* slices that are shorter are left out */

/* ---------------------------------------------------------------- slices */

/* Where a sum is kept, in floats from the first one of the rows under a node. */
static size_t place_of(const cs_defocus_slices *slices, int32_t row, int32_t sample) {
  size_t factor = (size_t)slices->factor, k = (size_t)sample;
  return 4 * ((size_t)row * slices->stride + k % factor * slices->places + k / factor);
}

/* One end of a slice, at a place among the samples: between two sums. */
static void find_end(const cs_defocus_slices *slices, int32_t row, double place, double weight,
                     size_t at[2], float weights[2]) {
  int32_t sample = (int32_t)floor(place);
  double share = place - sample;
  at[0] = place_of(slices, row, sample);
  at[1] = place_of(slices, row, sample + 1);
  weights[0] = (float)((1 - share) * weight);
  weights[1] = (float)(share * weight);
}

static cs_defocus_slice slice_at(const cs_defocus_slices *slices, int32_t row, double from,
                                 double to, double weight) {
  cs_defocus_slice out;
  find_end(slices, row, to, weight, out.add, out.add_weights);
  find_end(slices, row, from, weight, out.subtract, out.subtract_weights);
  return out;
}

static celspan_status add_slice(celspan_context *context, cs_defocus_slices *slices,
                                const cs_kernel *kernel, int32_t row) {
  double centre_x = slices->extent_x + 0.5 * slices->factor;
  double centre_y = slices->extent_y + 0.5 * slices->factor, from, to;
  double top = cs_number_clamp(row - centre_y, -kernel->radius_y, kernel->radius_y);
  double foot = cs_number_clamp(row + 1 - centre_y, -kernel->radius_y, kernel->radius_y);
  double weight = cs_kernel_above(kernel, foot) - cs_kernel_above(kernel, top);
  if (!(weight > 0) || !cs_kernel_chord(kernel, 0.5 * (top + foot), &from, &to) ||
      to - from < SHORT)
    return CELSPAN_OK;
  return CS_ARRAY_APPEND(
      context, slices->slices, slices->count,
      slice_at(slices, row, centre_x + from, centre_x + to, weight / (to - from)));
}

celspan_status cs_defocus_slices_init(celspan_context *context, const cs_blur *blur,
                                      cs_defocus_slices *out) {
  cs_blur fine = *blur;
  *out = (cs_defocus_slices){0};
  double least = fmin(blur->radius_x, blur->radius_y);
  double factor = cs_number_clamp(ceil(SAMPLES / least), 1, FACTOR);
  fine.blur = 0;
  fine.radius_x *= factor;
  fine.radius_y *= factor;
  for (int k = 0; k < 4; k++)
    fine.edges[k / 2][k % 2] *= factor;
  cs_kernel *kernel;
  CS_TRY(cs_kernel_create_defocus(context, &fine, &kernel));
  out->factor = (int32_t)factor;
  out->extent_x = cs_number_ceil(kernel->radius_x) + 1;
  out->extent_y = cs_number_ceil(kernel->radius_y) + 1;
  out->places = (size_t)(TILE + (2 * out->extent_x + 1) / out->factor + 1);
  out->stride = (size_t)out->factor * out->places;
  celspan_status status = CELSPAN_OK;
  for (int32_t row = 0; row < out->factor + 2 * out->extent_y && status == CELSPAN_OK; row++)
    status = add_slice(context, out, kernel, row);
  cs_kernel_free(kernel, context->memory);
  return status;
}

void cs_defocus_slices_finish(cs_defocus_slices *slices, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, slices, slices, slices);
  *slices = (cs_defocus_slices){0};
}

/* ---------------------------------------------------------------- sums */

typedef struct summing {
  const cs_defocus_slices *slices;
  cs_isa isa;
  cs_defocus_samples samples; /* the samples under all nodes */
  cs_v4 *row;                 /* samples of one row under the tile */
  cs_v4 *sums; /* by row: the sum of the samples from the tile's left edge up to each sample */
  cs_v4 *out;  /* TILE nodes */
} summing;

/* The prefix sums of a row's samples from the tile's left edge on. */
static void sum_samples(void *user, int32_t k) {
  summing *s = user;
  size_t factor = (size_t)s->slices->factor, places = s->slices->places;
  size_t count = (size_t)(s->samples.high - s->samples.low);
  cs_v4 *first = s->sums + (size_t)k * s->slices->stride, sum = cs_v4_all(0), *row = s->row;
  cs_defocus_samples_spread(&s->samples, k, row);
  for (size_t at = 0; at <= count; first++)
    for (size_t place = 0; place < factor && at <= count; place++, at++) {
      first[place * places] = sum;
      sum += row[at];
    }
}

static void sum_nodes(void *user, int32_t y, int32_t count, float (*nodes)[4]) {
  summing *s = user;
  const cs_v4 *sums = s->sums + (size_t)(y * s->slices->factor) * s->slices->stride;
  CS_WIDE_CHOOSE(s->isa, cs_defocus_slices_sum)
  (s->slices->slices, s->slices->count, (const float *)sums, TILE, (float *)s->out);
  memcpy(nodes, s->out, (size_t)count * sizeof *nodes);
}

celspan_status cs_defocus_slices_fill(const cs_defocus_slices *slices, cs_row_maker *maker,
                                      int32_t columns, int32_t first, int32_t end,
                                      float (*nodes)[4]) {
  summing s = {.slices = slices, .isa = maker->painter.isa};
  const cs_defocus_tiles tiles = {.columns = columns,
                                  .rows = end - first,
                                  .width = TILE,
                                  .factor = slices->factor,
                                  .extent = slices->extent_x,
                                  .take_row = sum_samples,
                                  .sum_nodes = sum_nodes,
                                  .user = &s};
  int32_t rows = (end - first) * slices->factor + 2 * slices->extent_y;
  size_t samples = (size_t)(TILE * slices->factor + 2 * slices->extent_x + 1);
  size_t sums = (size_t)rows * slices->stride;
  celspan_status status = cs_defocus_samples_begin(maker, first * slices->factor, rows,
                                                   samples + TILE + sums, &s.samples);
  if (status == CELSPAN_OK) {
    s.row = s.samples.room;
    s.out = s.row + samples;
    s.sums = s.out + TILE;
    cs_defocus_samples_sum(&s.samples, &tiles, nodes);
  }
  cs_defocus_samples_finish(&s.samples, maker->context->memory);
  return status;
}
