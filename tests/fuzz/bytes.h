/* The bytes of a fuzzer as choices, read one after the other. When none are left all further ones
 * are 0, so that every input is complete. */
#pragma once

#include <math.h>
#include <stddef.h>
#include <stdint.h>

typedef struct bytes_reader {
  const uint8_t *bytes;
  size_t size;
} bytes_reader;

static inline int bytes_take(bytes_reader *r) {
  if (r->size == 0)
    return 0;
  r->size--;
  return *r->bytes++;
}

/* From tiny to huge, of either sign, and values that are not finite. */
static inline double bytes_number(bytes_reader *r) {
  static const double scales[4] = {1, 10, 1e-7, 1e7};
  int high = bytes_take(r), low = bytes_take(r);
  double number = (high & 31) + low / 256.0;
  if (high == 255 && low >= 254)
    return low == 254 ? (double)NAN : HUGE_VAL;
  return (high & 128 ? -number : number) * scales[high >> 5 & 3];
}
