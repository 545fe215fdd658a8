#include "output/png/bytes.h"

enum { REGISTER = 4 * CS_WIDE_LANES };
typedef uint8_t bytes __attribute__((vector_size(REGISTER)));
typedef uint16_t words __attribute__((vector_size(REGISTER)));

static inline bytes load_bytes(const unsigned char *at) {
  bytes loaded;
  memcpy(&loaded, at, sizeof loaded);
  return loaded;
}

static inline bytes choose(bytes condition, bytes yes, bytes no) {
  return (yes & condition) | (no & ~condition);
}

/* The nearest of a, b and c to p = a + b - c; the first of several that are equally near. p - a is
 * b - c and p - b is a - c. If c lies between a and b, p - a and p - b have different signs, and |p
 * - c|, the magnitude of their sum, is the difference of their magnitudes. Otherwise |p - c| is the
 * sum of the magnitudes, so c cannot be the only nearest, and a distance of 255 can replace it. */
static inline bytes paeth(bytes a, bytes b, bytes c) {
  bytes a_is_less = (bytes)(a <= c), b_is_less = (bytes)(b <= c);
  bytes from_b = choose(a_is_less, c - a, a - c), from_a = choose(b_is_less, c - b, b - c);
  bytes a_is_nearer = (bytes)(from_a <= from_b);
  bytes between = choose(a_is_nearer, from_b - from_a, from_a - from_b);
  bytes from_c = between | (bytes)(a_is_less == b_is_less);
  bytes b_or_c = choose((bytes)(from_b <= from_c), b, c);
  return choose(a_is_nearer & (bytes)(from_a <= from_c), a, b_or_c);
}

static inline bytes average(bytes a, bytes b) { return (a & b) + ((a ^ b) >> 1); }

/* ---------------------------------------------------------------- filters */

static inline bytes difference(cs_png_filter kind, const unsigned char *row,
                               const unsigned char *above, size_t pixel_size) {
  bytes x = load_bytes(row), a = load_bytes(row - pixel_size), b = load_bytes(above);
  switch (kind) {
  case CS_PNG_SUB:
    return x - a;
  case CS_PNG_UP:
    return x - b;
  case CS_PNG_AVERAGE:
    return x - average(a, b);
  case CS_PNG_PAETH:
    return x - paeth(a, b, load_bytes(above - pixel_size));
  default:
    return x;
  }
}

/* kind: a constant for the compiler. */
static inline void filter_as(cs_png_filter kind, const unsigned char *row,
                             const unsigned char *above, size_t pixel_size, size_t size,
                             unsigned char *out) {
  for (size_t i = 0; i < size; i += REGISTER) {
    bytes loaded = difference(kind, row + i, above + i, pixel_size);
    memcpy(out + i, &loaded, sizeof loaded);
  }
}

void CS_WIDE(cs_png_bytes_filter)(cs_png_filter kind, const unsigned char *row,
                                  const unsigned char *above, size_t pixel_size, size_t size,
                                  unsigned char *out) {
  switch (kind) {
  case CS_PNG_SUB:
    filter_as(CS_PNG_SUB, row, above, pixel_size, size, out);
    break;
  case CS_PNG_UP:
    filter_as(CS_PNG_UP, row, above, pixel_size, size, out);
    break;
  case CS_PNG_AVERAGE:
    filter_as(CS_PNG_AVERAGE, row, above, pixel_size, size, out);
    break;
  case CS_PNG_PAETH:
    filter_as(CS_PNG_PAETH, row, above, pixel_size, size, out);
    break;
  default:
    filter_as(CS_PNG_NONE, row, above, pixel_size, size, out);
  }
}

/* ---------------------------------------------------------------- costs */

/* Each word is the sum for two bytes, at most 2 (128 + CS_PNG_NOT_ZERO). */
static inline words cost_of(bytes difference) {
  bytes negated = -difference;
  bytes size = choose((bytes)(difference <= negated), difference, negated);
  words cost = (words)(size + ((bytes)(difference != 0) & CS_PNG_NOT_ZERO));
  return (cost & 255) + (cost >> 8);
}

typedef struct cost_sums {
  words none, sub, up, average, paeth;
} cost_sums;

/* size: a multiple of REGISTER. left, corner: row and above, a pixel earlier. */
static inline void add_costs(cost_sums *sums, const unsigned char *row, const unsigned char *left,
                             const unsigned char *above, const unsigned char *corner, size_t size) {
  for (size_t i = 0; i < size; i += REGISTER) {
    bytes x = load_bytes(row + i), a = load_bytes(left + i);
    bytes b = load_bytes(above + i), c = load_bytes(corner + i);
    sums->none += cost_of(x);
    sums->sub += cost_of(x - a);
    sums->up += cost_of(x - b);
    sums->average += cost_of(x - average(a, b));
    sums->paeth += cost_of(x - paeth(a, b, c));
  }
}

static inline uint64_t sum_of(words sums) {
  uint64_t sum = 0;
  for (int i = 0; i < REGISTER / 2; i++)
    sum += sums[i];
  return sum;
}

void CS_WIDE(cs_png_bytes_add_costs)(const unsigned char *row, const unsigned char *above,
                                     size_t pixel_size, size_t size,
                                     uint64_t costs[CS_PNG_FILTERS]) {
  cost_sums sums = {0};
  size_t rest = size % CS_PNG_BATCH, whole = size - rest;
  add_costs(&sums, row, row - pixel_size, above, above - pixel_size, whole);
  if (rest > 0) { /* the rest is padded with zeros, so that the sums do not depend on REGISTER */
    unsigned char ends[4][CS_PNG_BATCH] = {0};
    memcpy(ends[0], row + whole, rest);
    memcpy(ends[1], row + whole - pixel_size, rest);
    memcpy(ends[2], above + whole, rest);
    memcpy(ends[3], above + whole - pixel_size, rest);
    add_costs(&sums, ends[0], ends[1], ends[2], ends[3], CS_PNG_BATCH);
  }
  costs[CS_PNG_NONE] += sum_of(sums.none);
  costs[CS_PNG_SUB] += sum_of(sums.sub);
  costs[CS_PNG_UP] += sum_of(sums.up);
  costs[CS_PNG_AVERAGE] += sum_of(sums.average);
  costs[CS_PNG_PAETH] += sum_of(sums.paeth);
}

/* ---------------------------------------------------------------- pixels */

/* Converts four pixels at a time. It can work in place, because it writes less than it has read. */
uint32_t CS_WIDE(cs_png_bytes_drop_alpha)(unsigned char *from, size_t pixel_count) {
  typedef uint8_t four __attribute__((vector_size(16)));
  four common = ~(four){0};
  uint32_t lanes[4], all = UINT32_MAX;
  unsigned char *to = from;
  for (; pixel_count >= 4; pixel_count -= 4, from += 16, to += 12) {
    four pixels;
    memcpy(&pixels, from, sizeof pixels);
    common &= pixels;
    pixels = __builtin_shufflevector(pixels, pixels, 0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 15, 15,
                                     15, 15);
    memcpy(to, &pixels, sizeof pixels);
  }
  for (; pixel_count > 0; pixel_count--, from += 4, to += 3) {
    uint32_t pixel;
    memcpy(&pixel, from, sizeof pixel);
    memcpy(to, &pixel, 3);
    all &= pixel;
  }
  memcpy(lanes, &common, sizeof lanes);
  return all & lanes[0] & lanes[1] & lanes[2] & lanes[3];
}
