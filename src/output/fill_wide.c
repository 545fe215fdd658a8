#include "output/fill.h"

void CS_WIDE(cs_fill_run)(unsigned char *out, size_t size, const unsigned char *pixel,
                          size_t pixel_size) {
  unsigned char bytes[sizeof(cs_wide_int)];
  cs_wide_int pattern;
  memcpy(bytes, pixel, pixel_size);
  for (size_t done = pixel_size; done < sizeof bytes; done *= 2)
    memcpy(bytes + done, bytes, done);
  memcpy(&pattern, bytes, sizeof pattern);
  cs_fill_exactly(out, out + size, pattern, (uintptr_t)out % pixel_size);
}
