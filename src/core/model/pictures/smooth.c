#include "model/pictures/smooth.h"

#include <string.h>

#include "base/number.h"

#define STEPS 255

static int32_t least(int32_t a, int32_t b) { return a < b ? a : b; }
static int32_t greatest(int32_t a, int32_t b) { return a > b ? a : b; }

cs_smooth_alphas cs_smooth_around(const celspan_rectangle *rectangle, int32_t width,
                                  int32_t height) {
  int32_t x0 = greatest(rectangle->x - CS_SMOOTH_RADIUS, 0);
  int32_t y0 = greatest(rectangle->y - CS_SMOOTH_RADIUS, 0);
  int32_t x1 = least(rectangle->x + rectangle->width + CS_SMOOTH_RADIUS, width);
  int32_t y1 = least(rectangle->y + rectangle->height + CS_SMOOTH_RADIUS, height);
  return (cs_smooth_alphas){.width = width, .height = height, .area = {x0, y0, x1 - x0, y1 - y0}};
}

/* The steps of 16 bits are 1/257 of the steps of 8 bits. */
static uint32_t step_of(float alpha) {
  float scaled = cs_number_clampf(alpha, 0, 1) * STEPS;
  uint32_t step = (uint32_t)(scaled + 0.5f);
  float away = scaled - (float)step;
  return away > -0.001f && away < 0.001f ? step : CS_SMOOTH_BETWEEN;
}

static uint32_t *row_of(const cs_smooth_alphas *alphas, int32_t y) {
  return alphas->steps + (size_t)(y - alphas->area.y) * (size_t)alphas->area.width;
}

void cs_smooth_set(const cs_smooth_alphas *alphas, int32_t x, int32_t y, const float *rgba,
                   int32_t count) {
  uint32_t *steps = row_of(alphas, y) + (x - alphas->area.x);
  for (int32_t i = 0; i < count; i++)
    steps[i] = step_of(rgba[4 * (size_t)i + 3]);
}

/* Adds rows [from, to) to the sums of their columns, or subtracts them: sign is 1 or -1. */
static void add_rows(const cs_smooth_alphas *alphas, int32_t from, int32_t to, int sign) {
  for (int32_t y = from; y < to; y++) {
    const uint32_t *steps = row_of(alphas, y);
    for (int32_t i = 0; i < alphas->area.width; i++)
      alphas->sums[i] += (uint32_t)sign * steps[i];
  }
}

static void smooth_pixel(uint32_t step, double mean, float rgba[4]) {
  double held = cs_number_clamp(mean, step - 0.5, step + 0.5);
  float factor = (float)(held / step);
  for (int c = 0; c < 3; c++)
    rgba[c] *= factor;
  rgba[3] = (float)(held / STEPS);
}

/* How far a mean at `place` reaches to either side. Both sides are equal, also near the edges, so
 * that a slope keeps its height. */
static int32_t radius_at(int32_t place, int32_t size) {
  return least(CS_SMOOTH_RADIUS, least(place, size - 1 - place));
}

/* A row of the rectangle; the sums include `rows` rows. */
static void smooth_row(const cs_smooth_alphas *alphas, const celspan_rectangle *rectangle,
                       int32_t y, int32_t rows, float *rgba) {
  int32_t left = alphas->area.x, begin = rectangle->x - radius_at(rectangle->x, alphas->width);
  const uint32_t *steps = row_of(alphas, y) + (rectangle->x - left);
  uint64_t sum = 0;
  int32_t end = begin;
  for (int32_t i = 0; i < rectangle->width; i++) {
    int32_t x = rectangle->x + i, radius = radius_at(x, alphas->width);
    for (; end <= x + radius; end++)
      sum += alphas->sums[end - left];
    for (; begin < x - radius; begin++)
      sum -= alphas->sums[begin - left];
    if (steps[i] > 0 && steps[i] < STEPS && sum < CS_SMOOTH_BETWEEN)
      smooth_pixel(steps[i], (double)sum / ((double)(end - begin) * rows), rgba + 4 * (size_t)i);
  }
}

void cs_smooth_rectangle(const cs_smooth_alphas *alphas, const celspan_rectangle *rectangle,
                         float *rgba) {
  int32_t begin = rectangle->y - radius_at(rectangle->y, alphas->height), end = begin;
  memset(alphas->sums, 0, (size_t)alphas->area.width * sizeof *alphas->sums);
  for (int32_t i = 0; i < rectangle->height; i++) {
    int32_t y = rectangle->y + i, radius = radius_at(y, alphas->height);
    add_rows(alphas, end, y + radius + 1, 1);
    add_rows(alphas, begin, y - radius, -1);
    begin = y - radius;
    end = y + radius + 1;
    smooth_row(alphas, rectangle, y, end - begin, rgba + 4 * (size_t)i * (size_t)rectangle->width);
  }
}
