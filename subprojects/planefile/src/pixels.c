/* Colours in linear light to 8-bit sRGB codes. */
#include "plane.h"

static double power(double x, int exponent) {
  double out = 1;
  for (int i = 0; i < exponent; i++)
    out *= x;
  return out;
}

/* Whether linear light is at or above that of code k - 1/2: of x >= b^2.4 both sides are raised to
 * the fifth power, so that products decide, which are the same everywhere. */
static bool is_reached(double linear, int k) {
  double code = (k - 0.5) / 255;
  return code <= 0.04045 ? linear >= code / 12.92
                         : power(linear, 5) >= power((code + 0.055) / 1.055, 12);
}

/* The least light that has a code, or a greater one, in units. */
static int find_least(int code) {
  int low = 0, high = PLANEFILE_WHITE;
  while (low < high) {
    int middle = (low + high) / 2;
    if (is_reached((double)middle / PLANEFILE_WHITE, code))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

void pf_codes_make(unsigned char codes[PLANEFILE_WHITE + 1]) {
  for (int code = 0, at = 0; code < 256; code++) {
    int end = code < 255 ? find_least(code + 1) : PLANEFILE_WHITE + 1;
    memset(codes + at, code, (size_t)(end - at));
    at = end;
  }
}

/* A colour of alpha 1, and of more. */
static void put_opaque(const planefile_plane *plane, const int32_t colour[4],
                       unsigned char out[4]) {
  for (int c = 0; c < 3; c++) {
    int32_t light = colour[c] < 0 ? 0 : colour[c];
    out[c] = plane->codes[light > PLANEFILE_WHITE ? PLANEFILE_WHITE : light];
  }
  out[3] = 255;
}

static void put_clear(const planefile_plane *plane, const int32_t colour[4], unsigned char out[4]) {
  int64_t alpha = colour[3];
  for (int c = 0; c < 3; c++) {
    int64_t straight = (colour[c] * INT64_C(65535) + alpha / 2) / alpha;
    straight = straight < 0 ? 0 : straight > PLANEFILE_WHITE ? PLANEFILE_WHITE : straight;
    out[c] = plane->codes[straight];
  }
  out[3] = (unsigned char)((alpha * 255 + PLANEFILE_WHITE / 2) / PLANEFILE_WHITE);
}

static inline void put_pixel(const planefile_plane *plane, const planefile_cell *colour,
                             unsigned char out[4]) {
  if (colour->colour[3] >= PLANEFILE_WHITE)
    put_opaque(plane, colour->colour, out);
  else if (colour->colour[3] > 0)
    put_clear(plane, colour->colour, out);
  else
    memset(out, 0, 4);
}

void planefile_srgb8(const planefile_plane *plane, planefile_cell colour, unsigned char out[4]) {
  put_pixel(plane, &colour, out);
}

enum { PIXEL = 4, BLOCK = 64 /* bytes */ };

/* Copies of a pixel that is there already, as many bytes as they are; at least a block. */
static void fill_blocks(unsigned char *out, size_t size) {
  unsigned char block[BLOCK];
  for (size_t at = 0; at < BLOCK; at += PIXEL)
    memcpy(block + at, out, PIXEL);
  for (size_t at = 0; at + BLOCK <= size; at += BLOCK)
    memcpy(out + at, block, BLOCK);
  memcpy(out + size - BLOCK, block, BLOCK);
}

void planefile_span_pixels(const planefile_plane *plane, const planefile_span *spans, size_t count,
                           unsigned char *out) {
  uint32_t start = 0;
  for (size_t i = 0; i < count; start = spans[i++].end) {
    size_t size = (size_t)PIXEL * (spans[i].end - start);
    put_pixel(plane, &spans[i].colour, out); /* in its place: most are alone where colours vary */
    if (size >= BLOCK)
      fill_blocks(out, size);
    for (size_t at = PIXEL; size < BLOCK && at < size; at += PIXEL)
      memcpy(out + at, out, PIXEL);
    out += size;
  }
}
