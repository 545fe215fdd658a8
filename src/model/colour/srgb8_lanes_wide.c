#include "model/colour/srgb8_lanes.h"

void CS_WIDE(cs_srgb8_code)(const float *rgba, size_t count, unsigned char *out) {
  for (; count >= CS_SRGB8_PIXELS; count -= CS_SRGB8_PIXELS) {
    cs_srgb8_lanes(cs_wide_load(rgba), out);
    rgba += CS_WIDE_LANES;
    out += CS_WIDE_LANES;
  }
  for (; count > 0; count--, rgba += 4, out += 4) {
    uint32_t pixel = cs_srgb8_pixel(rgba);
    memcpy(out, &pixel, sizeof pixel);
  }
}
