#include "codes.h"

static double power(double x, int exponent) {
  double out = 1;
  for (int i = 0; i < exponent; i++)
    out *= x;
  return out;
}

/* Whether linear light is at or above that of a code: of x >= b^2.4 both sides are raised to the
 * fifth power, so that products decide, which are the same everywhere. */
static bool is_reached(double linear, double code) {
  code /= 255;
  return code <= 0.04045 ? linear >= code / 12.92
                         : power(linear, 5) >= power((code + 0.055) / 1.055, 12);
}

/* The least light of a code, or of one above it, in units. */
static int32_t find_least(double code) {
  int32_t low = 0, high = PLANEFILE_WHITE;
  while (low < high) {
    int32_t middle = (low + high) / 2;
    if (is_reached((double)middle / PLANEFILE_WHITE, code))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

void pf_codes_make(pf_codes *codes) {
  for (int code = 0; code < 256; code++) {
    codes->least[code] = code > 0 ? find_least(code - 0.5) : 0;
    codes->light[code] = find_least(code);
  }
  codes->least[256] = INT32_MAX;
}

uint32_t pf_codes_find(const pf_codes *codes, int32_t light) {
  uint32_t low = 0, high = 255;
  while (low < high) {
    uint32_t middle = (low + high + 1) / 2;
    if (codes->least[middle] <= light)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

/* A share of WHITE as one of 255. */
static int32_t alpha_of(int64_t alpha) {
  alpha = alpha < 0 ? 0 : alpha > PLANEFILE_WHITE ? PLANEFILE_WHITE : alpha;
  return (int32_t)((alpha * 255 + PLANEFILE_WHITE / 2) / PLANEFILE_WHITE);
}

void pf_codes_of(const pf_codes *codes, const planefile_cell *cell, int32_t out[4]) {
  int64_t alpha = cell->colour[3] < PLANEFILE_WHITE ? cell->colour[3] : PLANEFILE_WHITE;
  out[3] = alpha_of(alpha);
  for (int c = 0; c < 3; c++) {
    int64_t light = cell->colour[c] < 0 || out[3] == 0 ? 0 : cell->colour[c];
    light = out[3] > 0 ? (light * PLANEFILE_WHITE + alpha / 2) / alpha : 0;
    out[c] =
        (int32_t)pf_codes_find(codes, light < PLANEFILE_WHITE ? (int32_t)light : PLANEFILE_WHITE);
  }
}

planefile_cell pf_codes_cell(const pf_codes *codes, const int32_t straight[4]) {
  planefile_cell out;
  for (int c = 0; c < 3; c++)
    out.colour[c] = (int32_t)(((int64_t)codes->light[straight[c]] * straight[3] + 127) / 255);
  out.colour[3] = straight[3] * (PLANEFILE_WHITE / 255);
  return out;
}

/* ---------------------------------------------------------------- for callers */

struct planefile_rounding {
  pf_memory memory;
  pf_codes codes;
};

planefile_rounding *planefile_rounding_create(planefile_resize resize, void *user) {
  pf_memory memory = pf_memory_of(resize, user);
  planefile_rounding *rounding = pf_make(&memory, sizeof *rounding, 1);
  if (!rounding)
    return NULL;
  rounding->memory = memory;
  pf_codes_make(&rounding->codes);
  return rounding;
}

void planefile_rounding_destroy(planefile_rounding *rounding) {
  if (!rounding)
    return;
  pf_memory memory = rounding->memory;
  pf_free(&memory, rounding, sizeof *rounding, 1);
}

planefile_cell planefile_round(const planefile_rounding *rounding, planefile_cell cell) {
  int32_t straight[4];
  pf_codes_of(&rounding->codes, &cell, straight);
  return pf_codes_cell(&rounding->codes, straight);
}
