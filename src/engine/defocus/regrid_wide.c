/* Four rows of nodes mixed into one, in the lanes of registers; then its columns, node by node. */
#include "engine/defocus/regrid.h"

#include "base/vector.h"

void CS_WIDE(cs_regrid_mix)(const float *rows[4], const float weights[3], size_t count,
                            float *out) {
  for (size_t next = 0; next < count; next += CS_WIDE_LANES) {
    size_t at = next + CS_WIDE_LANES <= count ? next : count - CS_WIDE_LANES;
    cs_wide centre = cs_wide_load(rows[1] + at);
    cs_wide sum = weights[0] * (cs_wide_load(rows[0] + at) - centre) +
                  weights[1] * (cs_wide_load(rows[2] + at) - centre) +
                  weights[2] * (cs_wide_load(rows[3] + at) - centre);
    cs_wide_store(out + at, centre + sum);
  }
}

void CS_WIDE(cs_regrid_across)(const cs_regrid_column *columns, int32_t count,
                               const float (*mixed)[4], float (*out)[4]) {
  for (int32_t i = 0; i < count; i++) {
    const cs_regrid_column *column = &columns[i];
    const float(*four)[4] = mixed + column->first;
    cs_v4 centre = cs_v4_load(four[1]);
    cs_v4 sum = column->weights[0] * (cs_v4_load(four[0]) - centre) +
                column->weights[1] * (cs_v4_load(four[2]) - centre) +
                column->weights[2] * (cs_v4_load(four[3]) - centre);
    cs_v4_store(out[i], cs_v4_bounded(centre + sum));
  }
}
