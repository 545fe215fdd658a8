/* Spans to pixels. */
#include "pixels.h"

#include "layout.h"

size_t spanfile_pixel_size(spanfile_format format) { return format == SPANFILE_HALF ? 8 : 4; }

/* ---------------------------------------------------------------- binary16 */

static double bits_to_double(uint64_t bits) {
  double number;
  memcpy(&number, &bits, sizeof number);
  return number;
}

static uint64_t double_to_bits(double number) {
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  return bits;
}

static double from_half(uint16_t half) {
  uint64_t sign = (uint64_t)(half & 0x8000) << 48, size = half & 0x7fff;
  if (size < 0x0400) /* a multiple of 2^-24 */
    return bits_to_double(sign | double_to_bits((double)size * 0x1p-24));
  return bits_to_double(sign | ((size << 42) + ((uint64_t)(1023 - 15) << 52)));
}

/* Rounded to nearest, ties to even. number: -65504..65504. */
static uint16_t to_half(double number) {
  uint64_t bits = double_to_bits(number), size = bits & ~((uint64_t)1 << 63);
  uint16_t sign = (uint16_t)(bits >> 48 & 0x8000);
  if (size < (uint64_t)(1023 - 14) << 52) { /* a double above 2^28 is a multiple of 2^-24 */
    double above = bits_to_double(size) + 0x1p28;
    return (uint16_t)(sign | (double_to_bits(above) - double_to_bits(0x1p28)));
  }
  uint64_t even = size >> 42 & 1;
  uint64_t rounded = (size + (((uint64_t)1 << 41) - 1) + even) >> 42;
  return (uint16_t)(sign | (rounded - ((uint64_t)(1023 - 15) << 10)));
}

/* ---------------------------------------------------------------- gradients */

bool sf_pixels_are_finite(spanfile_format format, const unsigned char *ends) {
  for (int i = 1; i < 16 && format == SPANFILE_HALF; i += 2)
    if ((ends[i] & 0x7c) == 0x7c)
      return false;
  return true;
}

static void gradient_8(const unsigned char *ends, uint32_t length, uint32_t first, uint32_t count,
                       unsigned char *out) {
  uint32_t last = length - 1;
  for (uint32_t i = first; i < first + count; i++)
    for (int c = 0; c < 4; c++)
      *out++ = (unsigned char)((ends[c] * (last - i) + ends[4 + c] * i + last / 2) / last);
}

static void gradient_half(const unsigned char *ends, uint32_t length, uint32_t first,
                          uint32_t count, unsigned char *out) {
  double a[4], b[4], last = (double)(length - 1);
  for (int c = 0; c < 4; c++) {
    a[c] = from_half((uint16_t)(ends[2 * c] | ends[2 * c + 1] << 8));
    b[c] = from_half((uint16_t)(ends[8 + 2 * c] | ends[9 + 2 * c] << 8));
  }
  for (uint32_t i = first; i < first + count; i++)
    for (int c = 0; c < 4; c++) {
      uint16_t half = to_half((a[c] * (last - (double)i) + b[c] * (double)i) / last);
      *out++ = (unsigned char)half;
      *out++ = (unsigned char)(half >> 8);
    }
}

void spanfile_gradient_pixels(spanfile_format format, const void *ends, uint32_t length,
                              uint32_t first, uint32_t count, void *pixels) {
  if (format == SPANFILE_HALF)
    gradient_half(ends, length, first, count, pixels);
  else
    gradient_8(ends, length, first, count, pixels);
}

/* ---------------------------------------------------------------- rows */

static void fill(unsigned char *out, size_t pixel_size, uint64_t pixel, size_t count) {
  sf_store_pixel(out, pixel_size, pixel);
  size_t size = count * pixel_size, done = pixel_size;
  while (done <
         size) { /* what is filled is copied again, in blocks that stay in the nearest cache */
    size_t block = done < 4096 ? done : 4096;
    block = block < size - done ? block : size - done;
    memcpy(out + done, out, block);
    done += block;
  }
}

void spanfile_row_pixels(spanfile_format format, const spanfile_row *row, uint32_t x0, uint32_t x1,
                         void *pixels) {
  size_t pixel_size = spanfile_pixel_size(format);
  const unsigned char *values = row->values;
  unsigned char *out = pixels;
  uint32_t start = 0;
  for (size_t i = 0; i < row->count && start < x1; i++) {
    const spanfile_span *span = &row->spans[i];
    uint32_t from = start > x0 ? start : x0, to = span->end < x1 ? span->end : x1;
    uint32_t length = span->end - start, count = to > from ? to - from : 0;
    if (count > 0 && span->kind == SPANFILE_RUN)
      fill(out, pixel_size, span->pixel, count);
    else if (count > 0 && span->kind == SPANFILE_RAW)
      memcpy(out, values + (size_t)(from - start) * pixel_size, (size_t)count * pixel_size);
    else if (count > 0)
      spanfile_gradient_pixels(format, values, length, from - start, count, out);
    out += (size_t)count * pixel_size;
    values += span->kind == SPANFILE_RAW        ? (size_t)length * pixel_size
              : span->kind == SPANFILE_GRADIENT ? 2 * pixel_size
                                                : 0;
    start = span->end;
  }
}
