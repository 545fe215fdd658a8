/* Weighted sums about many values at a time, in the lanes of registers:
 *
 *     values    b b b b . . . m m m m . . . a a a a
 *               before        middle        after
 *     out                     = = = =                 every lane sums up for itself, pair by pair
 *
 * Differences from the middle value are summed, so that equal values keep their bits.
 */
#include "engine/defocus/sample_sums.h"

/* Of sums in a pass: so many that they stay in registers, and that CS_DEFOCUS_SUMS_TOGETHER nodes
 * fill whole passes. */
#define REGISTERS (CS_WIDE_LANES == 8 ? 8 : 4)
#define FLOATS (REGISTERS * CS_WIDE_LANES)

_Static_assert(4 * CS_DEFOCUS_SUMS_TOGETHER % FLOATS == 0, "nodes fill whole passes");

void CS_WIDE(cs_defocus_sums_about)(const cs_defocus_pair *pairs, int32_t pair_count,
                                    const float *values, size_t middle, int32_t count, float *out) {
  for (const float *end = values + 4 * count; values < end; values += FLOATS, out += FLOATS) {
    cs_wide centre[REGISTERS], sum[REGISTERS] = {{0}};
    for (int j = 0; j < REGISTERS; j++)
      centre[j] = cs_wide_load(values + middle + j * CS_WIDE_LANES);
    for (int32_t i = 0; i < pair_count; i++) {
      const float *before = values + pairs[i].before, *after = values + pairs[i].after;
      for (int j = 0; j < REGISTERS; j++)
        sum[j] += pairs[i].weight * (cs_wide_load(before + j * CS_WIDE_LANES) +
                                     cs_wide_load(after + j * CS_WIDE_LANES) - 2 * centre[j]);
    }
    for (int j = 0; j < REGISTERS; j++)
      cs_wide_store(out + j * CS_WIDE_LANES, centre[j] + sum[j]);
  }
}
