#include "model/colour/srgb8_lanes.h"

static inline void code(const float *rgba, size_t count, bool is_coded, unsigned char *out) {
  for (; count >= CS_SRGB8_PIXELS; count -= CS_SRGB8_PIXELS) {
    cs_srgb8_lanes(cs_wide_load(rgba), is_coded, out);
    rgba += CS_WIDE_LANES;
    out += CS_WIDE_LANES;
  }
  for (; count > 0; count--, rgba += 4, out += 4) {
    uint32_t pixel = cs_srgb8_pixel_of(rgba, is_coded);
    memcpy(out, &pixel, sizeof pixel);
  }
}

void CS_WIDE(cs_srgb8_code)(const float *rgba, size_t count, unsigned char *out) {
  code(rgba, count, false, out);
}

void CS_WIDE(cs_srgb8_codes)(const float *rgba, size_t count, unsigned char *out) {
  code(rgba, count, true, out);
}
