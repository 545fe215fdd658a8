/* Slices summed up for many nodes at a time, in the lanes of registers:
 *
 *     sums of a row   . . . s s s s . . . . . . . t t t t . . .
 *                           subtracted            added
 *     nodes                       = = = =                          every lane sums up for itself,
 *                                                                  slice after slice
 */
#include "engine/defocus/slices.h"

#define REGISTERS 4 /* in a pass */
#define FLOATS (REGISTERS * CS_WIDE_LANES)

_Static_assert(4 * CS_DEFOCUS_SLICES_TOGETHER % FLOATS == 0, "nodes fill whole passes");

static inline cs_wide end_of(const float *sums, const size_t at[2], const float weights[2], int j) {
  size_t lane = (size_t)j * CS_WIDE_LANES;
  return weights[0] * cs_wide_load(sums + at[0] + lane) +
         weights[1] * cs_wide_load(sums + at[1] + lane);
}

void CS_WIDE(cs_defocus_slices_sum)(const cs_defocus_slice *slices, size_t slice_count,
                                    const float *sums, int32_t count, float *nodes) {
  for (int32_t at = 0; at < 4 * count; at += FLOATS) {
    cs_wide value[REGISTERS] = {{0}};
    for (size_t i = 0; i < slice_count; i++) {
      const cs_defocus_slice *s = &slices[i];
      for (int j = 0; j < REGISTERS; j++)
        value[j] += end_of(sums + at, s->add, s->add_weights, j) -
                    end_of(sums + at, s->subtract, s->subtract_weights, j);
    }
    for (int j = 0; j < REGISTERS; j++)
      cs_wide_store(nodes + at + j * CS_WIDE_LANES, value[j]);
  }
}
