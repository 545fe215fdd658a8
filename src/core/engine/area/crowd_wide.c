/* Plain loops over the samples of a pixel, which the compiler turns into vector code. */
#include "engine/area/crowd.h"

/* Adds the direction of a line to the windings of all samples right of the line. */
static inline void cross_whole(const cs_crowd_lattice *lattice, cs_crowd_line line,
                               int32_t *restrict windings) {
  const float *restrict x = lattice->x, *restrict y = lattice->y;
#pragma omp simd
  for (int32_t k = 0; k < lattice->count; k++)
    windings[k] += line.x + line.slope * y[k] <= x[k] ? line.direction : 0;
}

/* The same for a line that is shorter than the row. */
static inline void cross_part(const cs_crowd_lattice *lattice, cs_crowd_line line,
                              int32_t *restrict windings) {
  const float *restrict x = lattice->x, *restrict y = lattice->y;
#pragma omp simd
  for (int32_t k = 0; k < lattice->count; k++) {
    int32_t at = line.x + line.slope * (y[k] - line.top) <= x[k] ? line.direction : 0;
    at = y[k] >= line.top ? at : 0;
    windings[k] += y[k] < line.foot ? at : 0;
  }
}

cs_crowd_cover CS_WIDE(cs_crowd_find)(const cs_crowd_lattice *lattice, const cs_crowd_line *lines,
                                      size_t line_count, int32_t base, int32_t mask,
                                      int32_t *restrict inside) {
  int32_t count = 0, low = INT32_MAX, high = INT32_MIN, samples = lattice->count;
  for (int32_t k = 0; k < samples; k++)
    inside[k] = base;
  for (size_t i = 0; i < line_count; i++) {
    if (lines[i].top > 0 || lines[i].foot < 1)
      cross_part(lattice, lines[i], inside);
    else
      cross_whole(lattice, lines[i], inside);
  }
#pragma omp simd reduction(+ : count) reduction(min : low) reduction(max : high)
  for (int32_t k = 0; k < samples; k++) {
    int32_t winding = inside[k];
    low = winding < low ? winding : low;
    high = winding > high ? winding : high;
    inside[k] = (winding & mask) != 0 ? -1 : 0;
    count -= inside[k];
  }
  return (cs_crowd_cover){count, low, high};
}

#define REGISTERS (CS_CROWD_SUMS / CS_WIDE_LANES) /* registers that hold the partial sums */

/* The sum of the partial sums, in an order that does not depend on the registers. */
static inline float total_of(const cs_wide *sums) {
  float parts[CS_CROWD_SUMS];
  for (int r = 0; r < REGISTERS; r++)
    cs_wide_store(parts + r * CS_WIDE_LANES, sums[r]);
  for (int half = CS_CROWD_SUMS / 2; half > 0; half /= 2)
    for (int k = 0; k < half; k++)
      parts[k] += parts[k + half];
  return parts[0];
}

float CS_WIDE(cs_crowd_dim)(float *restrict through, const int32_t *restrict inside, int32_t count,
                            float share) {
  cs_wide sums[REGISTERS] = {{0}};
  for (int32_t k = 0; k < count; k += CS_CROWD_SUMS)
    for (int r = 0; r < REGISTERS; r++) {
      float *at = through + k + r * CS_WIDE_LANES;
      cs_wide_int mask;
      memcpy(&mask, inside + k + r * CS_WIDE_LANES, sizeof mask);
      cs_wide all = cs_wide_load(at), visible = (cs_wide)((cs_wide_int)all & mask);
      sums[r] += visible;
      cs_wide_store(at, all - visible * share);
    }
  return total_of(sums);
}
