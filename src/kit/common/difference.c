#include "common/difference.h"

#include <string.h>

void cs_difference_pale(uint8_t *pixels, size_t count) {
  for (uint8_t *p = pixels; p < pixels + 4 * count; p += 4) {
    int luma = (54 * p[0] + 183 * p[1] + 19 * p[2]) / 256; /* Rec. 709's weights, in 256ths */
    int grey = 255 - (255 - luma) * p[3] / 255 * 2 / 5;
    p[0] = p[1] = p[2] = (uint8_t)grey;
    p[3] = 255;
  }
}

void cs_difference_mark(double distance, uint8_t *pixels, size_t count) {
  double share = distance < 1 ? distance : 1;
  int rest = (int)(150 * (1 - share));
  const uint8_t red[4] = {(uint8_t)(255 - 90 * share), (uint8_t)rest, (uint8_t)(rest / 2), 255};
  for (size_t i = 0; i < count; i++)
    memcpy(pixels + 4 * i, red, sizeof red);
}
