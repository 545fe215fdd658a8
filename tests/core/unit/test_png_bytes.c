/* output/png/bytes_wide.c: every instruction set gives the result of PNG's definitions, byte by
 * byte.
 */
#include "output/png/bytes.h"

#include <stdbool.h>
#include <stdlib.h>

#include "tests/support/check.h"
#include "tests/support/random.h"

enum { SIZE_MOST = CS_PNG_COST_MOST, BEFORE = 8 };

typedef struct rows {
  unsigned char row[BEFORE + SIZE_MOST + CS_PNG_BATCH], above[BEFORE + SIZE_MOST + CS_PNG_BATCH];
} rows;

/* Noise, runs, or rows that are nearly equal; zeros around them. */
static void fill_rows(test_random *random, rows *r, size_t size) {
  int style = (int)random_below(random, 3);
  *r = (rows){0};
  for (size_t i = 0; i < size; i++) {
    unsigned char noise = (unsigned char)random_below(random, 256);
    bool goes_on = i > 0 && random_below(random, 10) > 0;
    r->above[BEFORE + i] = style > 0 && goes_on ? r->above[BEFORE + i - 1] : noise;
    r->row[BEFORE + i] = style == 2   ? (unsigned char)(r->above[BEFORE + i] + noise % 3 - 1)
                         : style == 1 ? r->above[BEFORE + i]
                                      : (unsigned char)random_below(random, 256);
  }
}

/* PNG 3rd edition, 9.2. */
static unsigned char expected_byte(cs_png_filter kind, const unsigned char *row,
                                   const unsigned char *above, size_t pixel_size) {
  int x = *row, a = *(row - pixel_size), b = *above, c = *(above - pixel_size), p = a + b - c;
  switch (kind) {
  case CS_PNG_SUB:
    return (unsigned char)(x - a);
  case CS_PNG_UP:
    return (unsigned char)(x - b);
  case CS_PNG_AVERAGE:
    return (unsigned char)(x - (a + b) / 2);
  case CS_PNG_PAETH:
    return (unsigned char)(x - (abs(p - a) <= abs(p - b) && abs(p - a) <= abs(p - c) ? a
                                : abs(p - b) <= abs(p - c)                           ? b
                                                                                     : c));
  default:
    return (unsigned char)x;
  }
}

static void check_rows(cs_isa isa, const rows *r, size_t pixel_size, size_t size) {
  const unsigned char *row = r->row + BEFORE, *above = r->above + BEFORE;
  unsigned char found[SIZE_MOST + CS_PNG_BATCH];
  uint64_t costs[CS_PNG_FILTERS] = {0}, expected[CS_PNG_FILTERS] = {0};
  bool is_same = true;
  for (cs_png_filter kind = CS_PNG_NONE; kind < CS_PNG_FILTERS; kind++) {
    CS_WIDE_CHOOSE(isa, cs_png_bytes_filter)(kind, row, above, pixel_size, size, found);
    for (size_t i = 0; i < size; i++) {
      unsigned char byte = expected_byte(kind, row + i, above + i, pixel_size);
      is_same = is_same && found[i] == byte;
      expected[kind] += (uint64_t)(byte < 128 ? byte : 256 - byte);
      expected[kind] += byte ? CS_PNG_NOT_ZERO : 0;
    }
  }
  CHECK(is_same);
  CS_WIDE_CHOOSE(isa, cs_png_bytes_add_costs)(row, above, pixel_size, size, costs);
  CHECK(memcmp(costs, expected, sizeof costs) == 0);
}

/* The accumulators hold the largest possible sum of every byte's cost. */
static void check_dearest(cs_isa isa) {
  rows r = {0};
  uint64_t costs[CS_PNG_FILTERS] = {1, 1, 1, 1, 1};
  memset(r.row + BEFORE, 128, SIZE_MOST);
  CS_WIDE_CHOOSE(isa, cs_png_bytes_add_costs)
  (r.row + BEFORE, r.above + BEFORE, 4, SIZE_MOST, costs);
  CHECK(costs[CS_PNG_NONE] == 1 + (128 + CS_PNG_NOT_ZERO) * (uint64_t)SIZE_MOST);
  CHECK(costs[CS_PNG_UP] == costs[CS_PNG_NONE]);
  CHECK(costs[CS_PNG_SUB] == 1 + (128 + CS_PNG_NOT_ZERO) * (uint64_t)4);
}

static void check_pixels(cs_isa isa, test_random *random, size_t count) {
  unsigned char pixels[4 * 64 + 16], expected[3 * 64];
  uint32_t common = UINT32_MAX;
  for (size_t i = 0; i < sizeof pixels; i++)
    pixels[i] = (unsigned char)(i % 4 == 3 ? 255 : random_below(random, 256));
  pixels[3] = random_below(random, 2) ? 254 : 255;
  for (size_t i = 0; i < count; i++) {
    uint32_t pixel;
    memcpy(&pixel, pixels + 4 * i, sizeof pixel);
    memcpy(expected + 3 * i, pixels + 4 * i, 3);
    common &= pixel;
  }
  CHECK(CS_WIDE_CHOOSE(isa, cs_png_bytes_drop_alpha)(pixels, count) == common);
  CHECK(memcmp(pixels, expected, 3 * count) == 0);
}

int main(void) {
  static const size_t pixel_sizes[4] = {3, 4, 6, 8};
  test_random random = {1};
  for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++) {
    for (int round = 0; round < 300; round++) {
      rows r;
      size_t pixel_size = pixel_sizes[round % 4];
      size_t size = 1 + (size_t)random_below(&random, round % 3 ? 200 : SIZE_MOST);
      fill_rows(&random, &r, size);
      check_rows(isa, &r, pixel_size, size);
      check_pixels(isa, &random, 1 + (size_t)random_below(&random, 64));
    }
    check_dearest(isa);
  }
  return check_done();
}
