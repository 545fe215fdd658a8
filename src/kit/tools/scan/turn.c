#include "tools/scan/turn.h"

#include <math.h>
#include <string.h>

#include "inside/elementary.h"
#include "inside/number.h"

/* The weights of four pixels, for a place `u` behind the second one. */
static void weigh(float u, float weights[4]) {
  weights[0] = u * (u * (1 - 0.5f * u) - 0.5f);
  weights[1] = u * u * (1.5f * u - 2.5f) + 1;
  weights[2] = u * (u * (2 - 1.5f * u) + 0.5f);
  weights[3] = u * u * (0.5f * u - 0.5f);
}

/* The mean of the 4 x 4 pixels around a place, whose column and row are those of the second. */
static uint8_t mean_at(const uint8_t *first, size_t width, float u, float v) {
  uint32_t rows[4], any = 0;
  float across[4], down[4], sum = 0.5f;
  for (size_t j = 0; j < 4; j++) {
    memcpy(&rows[j], first + j * width, sizeof rows[j]);
    any |= rows[j];
  }
  if (any == 0)
    return 0;
  weigh(u, across);
  weigh(v, down);
  for (size_t j = 0; j < 4; j++) {
    const uint8_t *row = first + j * width;
    float part = 0;
    for (int i = 0; i < 4; i++)
      part += across[i] * (float)row[i];
    sum += down[j] * part;
  }
  return (uint8_t)cs_number_clampf(sum, 0, 255);
}

void cs_turn_row(const cs_turn *turn, const uint8_t *plane, int32_t y, int32_t width,
                 uint8_t *row) {
  double sine, cosine, down = y + 0.5 - turn->to_y;
  cs_elementary_sincos(-turn->turn, &sine, &cosine);
  for (int32_t x = 0; x < width; x++) {
    double along = x + 0.5 - turn->to_x;
    double u = turn->x + cosine * along - sine * down - 0.5;
    double v = turn->y + sine * along + cosine * down - 0.5;
    bool is_inside = u >= 1 && v >= 1 && u < turn->width - 2 && v < turn->height - 2;
    int32_t column = is_inside ? (int32_t)u : 1, line = is_inside ? (int32_t)v : 1;
    size_t first = (size_t)(line - 1) * (size_t)turn->width + (size_t)(column - 1);
    row[x] = is_inside ? mean_at(plane + first, (size_t)turn->width, (float)(u - column),
                                 (float)(v - line))
                       : 0;
  }
}
