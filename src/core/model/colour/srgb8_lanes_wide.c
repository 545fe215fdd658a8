#include "model/colour/srgb8_lanes.h"

static inline void code_each(const float *rgba, size_t count, bool is_coded, unsigned char *out) {
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

/* Four registers of colours, which are one of pixels. Most of a frame is flat: a group that repeats
 * one register is coded once, and so are all such groups after it. */
enum { GROUP = 4 * CS_WIDE_LANES };

static inline bool is_flat(const float *rgba, cs_wide_int first) {
  cs_wide_int differs = {0};
  for (int at = CS_WIDE_LANES; at < GROUP; at += CS_WIDE_LANES)
    differs |= first ^ (cs_wide_int)cs_wide_load(rgba + at);
  return !cs_wide_any(differs != 0);
}

static inline void code(const float *rgba, size_t count, bool is_coded, unsigned char *out) {
  cs_wide_int flat = {0},
              pixels = {0}; /* a register that was repeated, at first clear; its group */
  for (; count >= GROUP / 4; count -= GROUP / 4, rgba += GROUP, out += GROUP) {
    const cs_wide_int first = (cs_wide_int)cs_wide_load(rgba);
    if (!is_flat(rgba, first)) {
      code_each(rgba, GROUP / 4, is_coded, out);
      continue;
    }
    if (cs_wide_any(first != flat)) {
      flat = first;
      cs_srgb8_lanes((cs_wide)first, is_coded, out);
      for (int at = 0; at < GROUP; at += CS_WIDE_LANES)
        memcpy((unsigned char *)&pixels + at, out, CS_WIDE_LANES);
    }
    memcpy(out, &pixels, sizeof pixels);
  }
  code_each(rgba, count, is_coded, out);
}

void CS_WIDE(cs_srgb8_code)(const float *rgba, size_t count, unsigned char *out) {
  code(rgba, count, false, out);
}

void CS_WIDE(cs_srgb8_codes)(const float *rgba, size_t count, unsigned char *out) {
  code(rgba, count, true, out);
}
