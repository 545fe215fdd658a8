#include "model/colour/srgb8.h"

#include <string.h>

void cs_srgb8_make_curve(cs_srgb8_curve *out) {
  for (int code = 0; code < 256; code++) {
    float light = cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)(code / 255.0));
    uint32_t bits;
    memcpy(&bits, &light, sizeof bits);
    out->light[code] = light;
    for (int k = 0; k < 4; k++)
      out->bytes[k][code] = (unsigned char)(bits >> 8 * k);
  }
}
