/* Four rows of nodes mixed into one, in the lanes of registers. */
#include "engine/defocus/regrid.h"

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
