/* Colours in linear light to 8-bit sRGB codes. */
#include <math.h>

#include "plane.h"

/* Code k begins with the linear light of k - 1/2. */
void pf_codes_make(unsigned char codes[PLANEFILE_WHITE + 1]) {
  uint32_t at = 0;
  for (int k = 1; k <= 256; k++) {
    double code = (k - 0.5) / 255;
    double linear = code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
    uint32_t end = k == 256 ? PLANEFILE_WHITE + 1 : (uint32_t)ceil(linear * PLANEFILE_WHITE);
    while (at < end)
      codes[at++] = (unsigned char)(k - 1);
  }
}

void planefile_srgb8(const planefile_plane *plane, planefile_cell colour, unsigned char out[4]) {
  int64_t alpha = colour.colour[3] < PLANEFILE_WHITE ? colour.colour[3] : PLANEFILE_WHITE;
  memset(out, 0, 4);
  if (alpha <= 0)
    return;
  for (int c = 0; c < 3; c++) {
    int64_t straight = (colour.colour[c] * INT64_C(65535) + alpha / 2) / alpha;
    straight = straight < 0 ? 0 : straight > PLANEFILE_WHITE ? PLANEFILE_WHITE : straight;
    out[c] = plane->codes[straight];
  }
  out[3] = (unsigned char)((alpha * 255 + PLANEFILE_WHITE / 2) / PLANEFILE_WHITE);
}

void planefile_span_pixels(const planefile_plane *plane, const planefile_span *spans, size_t count,
                           unsigned char *out) {
  uint32_t start = 0;
  for (size_t i = 0; i < count; start = spans[i++].end) {
    unsigned char pixel[4];
    planefile_srgb8(plane, spans[i].colour, pixel);
    for (uint32_t x = start; x < spans[i].end; x++, out += 4)
      memcpy(out, pixel, sizeof pixel);
  }
}
