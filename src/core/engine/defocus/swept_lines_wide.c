/* Edges spread over the columns around them, columns summed up to lines, and lines weighed along y,
 * floats beside each other in one register:
 *
 *   lines[2]   . . . . . . . .   weights[1]
 *   lines[0]   . . . . . . . .   weights[0]
 *   node       = = = = = = = =               every column sums up for itself, from the outermost
 *   lines[1]   . . . . . . . .   weights[0]  pair to the middle
 *   lines[3]   . . . . . . . .   weights[1]
 */
#include "engine/defocus/swept_lines.h"

#define TOGETHER 4 /* registers that are summed in one pass */
#define SAME 1e-6f /* a relative difference that is rounding */

/* ---------------------------------------------------------------- edges to lines */

typedef float both __attribute__((vector_size(32))); /* the halves of a column */
typedef double sums __attribute__((vector_size(32)));
typedef float narrow __attribute__((vector_size(16)));

void CS_WIDE(cs_defocus_lines_spread)(const float *low, const float *high, float t, int32_t count,
                                      float *shares, const cs_defocus_halves *step,
                                      cs_defocus_halves *near) {
  both change, sum;
  memcpy(&change, step, sizeof change);
  for (int32_t k = 0; k < count; k++)
    shares[k] = low[k] + t * (high[k] - low[k]);
#pragma GCC unroll 4
  for (int32_t k = 0; k < count; k++) {
    memcpy(&sum, &near[k], sizeof sum);
    sum += shares[k] * change;
    memcpy(&near[k], &sum, sizeof sum);
  }
}

void CS_WIDE(cs_defocus_lines_sum)(const cs_defocus_columns *columns, int32_t first, int32_t end,
                                   cs_defocus_passed *sum, cs_v4 *line) {
  const both nothing = {0};
  const sums none = {0};
  sums upper, lower, step;
  memcpy(&upper, &sum->upper, sizeof upper);
  memcpy(&lower, &sum->lower, sizeof lower);
  for (int32_t p = first; p < end; p++) {
    cs_defocus_passed *passed = &columns->steps[p];
    cs_defocus_halves *near = &columns->near[p];
    memcpy(&step, &passed->upper, sizeof step);
    upper += step;
    memcpy(&step, &passed->lower, sizeof step);
    lower += step;
    line[p] = columns->below[p] + (__builtin_convertvector(upper, narrow) + near->upper);
    columns->below[p] = __builtin_convertvector(lower, narrow) + near->lower;
    memcpy(near, &nothing, sizeof nothing);
    memcpy(&passed->upper, &none, sizeof none);
    memcpy(&passed->lower, &none, sizeof none);
  }
  memcpy(&sum->upper, &upper, sizeof upper);
  memcpy(&sum->lower, &lower, sizeof lower);
}

/* ---------------------------------------------------------------- lines to nodes */

/* The weighed mean of equal values misses them by the last bits: a sum so near to the middle line
 * is replaced by it. */
static inline cs_wide settle(cs_wide sum, cs_wide centre) {
  cs_wide away = sum - centre;
  cs_wide slack = SAME * cs_wide_choose(centre < 0, -centre, centre);
  return cs_wide_choose((away <= slack) & (away >= -slack), centre, sum);
}

static inline void weigh(const float *const *lines, const float *weights, int32_t pairs, int32_t at,
                         int32_t count, float *nodes) {
  cs_wide sum[TOGETHER] = {{0}};
  for (int32_t k = pairs - 1; k >= 0; k--) {
    const float *above = lines[2 * k] + at, *below = lines[2 * k + 1] + at;
    cs_wide weight = cs_wide_all(weights[k]);
    for (int j = 0; j < count; j++)
      sum[j] += weight *
                (cs_wide_load(above + j * CS_WIDE_LANES) + cs_wide_load(below + j * CS_WIDE_LANES));
  }
  for (int j = 0; j < count; j++)
    cs_wide_store(nodes + at + j * CS_WIDE_LANES,
                  settle(sum[j], cs_wide_load(lines[0] + at + j * CS_WIDE_LANES)));
}

/* The same operations on one float. */
static float weigh_one(const float *const *lines, const float *weights, int32_t pairs, int32_t at) {
  float sum = 0, centre = lines[0][at];
  for (int32_t k = pairs - 1; k >= 0; k--)
    sum += weights[k] * (lines[2 * k][at] + lines[2 * k + 1][at]);
  float away = sum - centre, slack = SAME * (centre < 0 ? -centre : centre);
  return away <= slack && away >= -slack ? centre : sum;
}

void CS_WIDE(cs_defocus_lines_weigh)(const float *const *lines, const float *weights, int32_t pairs,
                                     int32_t first, int32_t end, float *nodes) {
  int32_t at = first, step = TOGETHER * CS_WIDE_LANES;
  for (; at + step <= end; at += step)
    weigh(lines, weights, pairs, at, TOGETHER, nodes);
  for (; at + CS_WIDE_LANES <= end; at += CS_WIDE_LANES)
    weigh(lines, weights, pairs, at, 1, nodes);
  for (; at < end; at++)
    nodes[at] = weigh_one(lines, weights, pairs, at);
}
