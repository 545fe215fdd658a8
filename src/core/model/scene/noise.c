#include "model/scene/noise.h"

#include "base/splitmix.h"

cs_noise_octave cs_noise_octave_of(const cs_noise *noise, int index) {
  uint64_t state = (uint64_t)(uint32_t)noise->seed << 8 | (uint64_t)index;
  uint64_t word = cs_splitmix_next(&state);
  double moved = noise->kind == CELSPAN_NOISE_WHITE ? 0 : 0x1p-16;
  return (cs_noise_octave){.scale = (double)(1 << index),
                           .shift_x = (double)(word >> 32 & 0xffff) * moved,
                           .shift_y = (double)(word >> 48) * moved,
                           .seed = (uint32_t)word};
}
