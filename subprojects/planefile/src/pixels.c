/* Colours in linear light to 8-bit sRGB codes. */
#include <wchar.h>

#include "plane.h"

void pf_pixels_make(const pf_codes *codes, unsigned char out[PLANEFILE_WHITE + 1]) {
  for (int code = 0; code < 256; code++) {
    int32_t at = codes->least[code],
            end = code < 255 ? codes->least[code + 1] : PLANEFILE_WHITE + 1;
    memset(out + at, code, (size_t)(end - at));
  }
}

/* Four bytes, the first one lowest. They are handled together: to load a pixel whose bytes were
 * just stored one by one takes long. */
typedef uint32_t pixel;

/* The same with the first byte where the machine has it. */
static inline pixel in_memory(pixel colour) {
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  return colour;
#else
  unsigned char bytes[4];
  pf_store_32(bytes, colour);
  memcpy(&colour, bytes, sizeof colour);
  return colour;
#endif
}

static inline pixel code_of(const planefile_plane *plane, int32_t light) {
  light = light < 0 ? 0 : light;
  return plane->codes[light > PLANEFILE_WHITE ? PLANEFILE_WHITE : light];
}

/* Of alpha 1, and of more. */
static inline pixel opaque_of(const planefile_plane *plane, const int32_t colour[4]) {
  return code_of(plane, colour[0]) | code_of(plane, colour[1]) << 8 |
         code_of(plane, colour[2]) << 16 | UINT32_C(255) << 24;
}

static pixel clear_of(const planefile_plane *plane, const int32_t colour[4]) {
  int64_t alpha = colour[3];
  pixel out = (pixel)((alpha * 255 + PLANEFILE_WHITE / 2) / PLANEFILE_WHITE) << 24;
  for (int c = 0; c < 3; c++) {
    int64_t straight = (colour[c] * INT64_C(65535) + alpha / 2) / alpha;
    straight = straight < 0 ? 0 : straight > PLANEFILE_WHITE ? PLANEFILE_WHITE : straight;
    out |= (pixel)plane->codes[straight] << 8 * c;
  }
  return out;
}

static inline pixel pixel_of(const planefile_plane *plane, const planefile_cell *colour) {
  if (colour->colour[3] >= PLANEFILE_WHITE)
    return opaque_of(plane, colour->colour);
  return colour->colour[3] > 0 ? clear_of(plane, colour->colour) : 0;
}

void planefile_srgb8(const planefile_plane *plane, planefile_cell colour, unsigned char out[4]) {
  pf_store_32(out, pixel_of(plane, &colour));
}

enum { BLOCK_PIXELS = 16, PIXEL = sizeof(pixel), BLOCK = BLOCK_PIXELS * PIXEL /* bytes */ };
enum { LONG = 8 * BLOCK };

/* Blocks of a pixel, of which the last one may reach beyond a size. */
static inline void fill_blocks(unsigned char *out, size_t size, pixel colour) {
  pixel block[BLOCK_PIXELS];
  for (int i = 0; i < BLOCK_PIXELS; i++)
    block[i] = colour;
  size_t at = 0;
  do
    memcpy(out + at, block, BLOCK);
  while ((at += BLOCK) < size);
}

/* Whether a span is filled by the C library, which has the widest registers of the machine: where
 * it has letters of this size. A module of WebAssembly has no C library. */
static inline bool is_word(const unsigned char *out, size_t size) {
#ifdef __wasm__
  return (void)out, (void)size, false;
#else
  return size >= LONG && sizeof(wchar_t) == PIXEL && (uintptr_t)out % _Alignof(wchar_t) == 0;
#endif
}

/* Single pixels and short spans are filled like long ones, with what the next spans replace: where
 * spans end cannot be predicted. */
void planefile_span_pixels(const planefile_plane *plane, const planefile_span *spans, size_t count,
                           unsigned char *out) {
  size_t all = count > 0 ? (size_t)PIXEL * spans[count - 1].end : 0, start = 0, end;
  for (size_t i = 0; i < count; i++, start = end) {
    end = (size_t)PIXEL * spans[i].end;
    size_t size = end - start;
    pixel colour = in_memory(pixel_of(plane, &spans[i].colour));
    if (is_word(out + start, size))
      wmemset((wchar_t *)(void *)(out + start), (wchar_t)colour, size / PIXEL);
    else if (size + BLOCK <= all - start)
      fill_blocks(out + start, size, colour);
    else
      for (size_t at = start; at < end; at += PIXEL)
        memcpy(out + at, &colour, PIXEL);
  }
}
