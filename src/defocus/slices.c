#include "defocus/slices.h"

#include "base/number.h"

#include <math.h>

#define SAMPLES 16 /* in the lesser radius, where the factor allows it */
#define FACTOR 9   /* at most; odd, so that a node lies in the middle of a sample */
#define TILE 32    /* nodes of a row that are summed together */
#define SHORT 1e-6 /* slices that are shorter are left out */

/* ---------------------------------------------------------------- slices */

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
  CS_TRY(cs_mem_reserve(context, (void **)&slices->slices, &slices->capacity, slices->count + 1,
                        sizeof *slices->slices));
  double low = floor(centre_x + from), high = floor(centre_x + to);
  slices->slices[slices->count++] = (cs_defocus_slice){
      row,
      (int32_t)low,
      (int32_t)high,
      (float)(centre_x + from - low),
      (float)(centre_x + to - high),
      (float)(weight / (to - from)),
  };
  return CELSPAN_OK;
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
  celspan_status status = CELSPAN_OK;
  for (int32_t row = 0; row < out->factor + 2 * out->extent_y && status == CELSPAN_OK; row++)
    status = add_slice(context, out, kernel, row);
  cs_kernel_free(kernel, context->memory);
  return status;
}

void cs_defocus_slices_finish(cs_defocus_slices *slices, cs_memory *memory) {
  cs_mem_free(memory, slices->slices, slices->capacity * sizeof *slices->slices);
  *slices = (cs_defocus_slices){0};
}

/* ---------------------------------------------------------------- sums */

typedef struct summing {
  const cs_defocus_slices *slices;
  cs_row *rows; /* of samples: those under all nodes */
  size_t *from; /* by row: the first span that may meet the tile */
  int32_t row_count;
  int32_t x0, x1; /* nodes of the tile */
  size_t stride;  /* of a row of sums */
  cs_v4 *sums;    /* by row: of the samples from the tile's left edge up to each */
} summing;

/* The prefix sums of a row's samples from the tile's left edge on. */
static void sum_samples(summing *s, int32_t k) {
  const cs_row *row = &s->rows[k];
  const cs_defocus_slices *slices = s->slices;
  int32_t left = s->x0 * slices->factor, end = s->x1 * slices->factor + 2 * slices->extent_x;
  cs_v4 *sums = s->sums + (size_t)k * s->stride, sum = cs_v4_all(0);
  while (row->spans[s->from[k]].x1 <= left)
    s->from[k]++;
  *sums++ = sum;
  for (size_t i = s->from[k]; i < row->count && row->spans[i].x0 < end; i++) {
    const celspan_span *span = &row->spans[i];
    int32_t x = span->x0 > left ? span->x0 : left, stop = span->x1 < end ? span->x1 : end;
    for (; x < stop; x++) {
      float rgba[4];
      celspan_span_colour(span, x, rgba);
      *sums++ = sum += cs_v4_load(rgba);
    }
  }
}

static inline cs_v4 sum_up_to(const cs_v4 *sums, float share) {
  return sums[0] + share * (sums[1] - sums[0]);
}

/* The node whose kernel begins at the sample that `sums` points to. */
static cs_v4 sum_node(const summing *s, const cs_v4 *sums) {
  cs_v4 value = cs_v4_all(0);
  for (size_t i = 0; i < s->slices->count; i++) {
    const cs_defocus_slice *slice = &s->slices->slices[i];
    const cs_v4 *row = sums + (size_t)slice->row * s->stride;
    value += slice->weight * (sum_up_to(row + slice->to, slice->to_share) -
                              sum_up_to(row + slice->from, slice->from_share));
  }
  return value;
}

static void sum_tile(summing *s, int32_t columns, int32_t band_rows, float (*nodes)[4]) {
  for (int32_t k = 0; k < s->row_count; k++)
    sum_samples(s, k);
  for (int32_t y = 0; y < band_rows; y++)
    for (int32_t x = s->x0; x < s->x1; x++) {
      const cs_v4 *sums =
          s->sums + (size_t)(y * s->slices->factor) * s->stride + (x - s->x0) * s->slices->factor;
      cs_v4_store(nodes[(size_t)y * (size_t)columns + (size_t)x], sum_node(s, sums));
    }
}

static celspan_status sum_rows(summing *s, cs_row_maker *maker, int32_t columns, int32_t first,
                               int32_t end, float (*nodes)[4]) {
  for (int32_t k = 0; k < s->row_count; k++)
    CS_TRY(cs_row_make(maker, first * s->slices->factor + k, &s->rows[k]));
  for (s->x0 = 0; s->x0 < columns; s->x0 = s->x1) {
    s->x1 = columns - s->x0 < TILE ? columns : s->x0 + TILE;
    sum_tile(s, columns, end - first, nodes);
  }
  return CELSPAN_OK;
}

celspan_status cs_defocus_slices_fill(const cs_defocus_slices *slices, cs_row_maker *maker,
                                      int32_t columns, int32_t first, int32_t end,
                                      float (*nodes)[4]) {
  cs_memory *memory = maker->context->memory;
  summing s = {.slices = slices};
  s.row_count = (end - first) * slices->factor + 2 * slices->extent_y;
  s.stride = (size_t)(TILE * slices->factor + 2 * slices->extent_x + 1);
  size_t rows = (size_t)s.row_count;
  s.rows = cs_mem_array(memory, rows, sizeof *s.rows);
  s.from = cs_mem_array(memory, rows, sizeof *s.from);
  s.sums = cs_mem_array(memory, rows * s.stride, sizeof *s.sums);
  celspan_status status = s.rows && s.from && s.sums
                              ? sum_rows(&s, maker, columns, first, end, nodes)
                              : cs_fail_memory(maker->context);
  for (size_t k = 0; s.rows && k < rows; k++)
    cs_row_finish(&s.rows[k], memory);
  cs_mem_free(memory, s.rows, rows * sizeof *s.rows);
  cs_mem_free(memory, s.from, rows * sizeof *s.from);
  cs_mem_free(memory, s.sums, rows * s.stride * sizeof *s.sums);
  return status;
}
