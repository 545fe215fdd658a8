/* Pixels as Y'CbCr: every colour of a dense sample is the exact number rounded, and the colour of
 * four pixels is that of their mean.
 */
#include "output/sinks/ycbcr.h"

#include <math.h>

#include "tests/support/check.h"
#include "tests/support/random.h"

enum { COUNT = 61 }; /* not a multiple of any register's width */

static uint32_t pixel_of(const unsigned char rgb[3]) {
  uint32_t pixel;
  const unsigned char bytes[4] = {rgb[0], rgb[1], rgb[2], 77};
  memcpy(&pixel, bytes, sizeof pixel);
  return pixel;
}

/* The numbers of BT.709 before rounding: luma, cb, cr. */
static void exactly(const double rgb[3], double out[3]) {
  double y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  out[0] = 16 + 219 * y / 255;
  out[1] = 128 + 224 * (rgb[2] - y) / 1.8556 / 255;
  out[2] = 128 + 224 * (rgb[0] - y) / 1.5748 / 255;
}

static bool is_near(unsigned char found, double exact) {
  return fabs(found - exact) <= 0.5 + ldexp(1, -14);
}

static void test_colours(cs_isa isa) {
  test_random random = {3};
  long wrong = 0;
  for (int round = 0; round < 20000; round++) {
    uint32_t pixels[COUNT];
    unsigned char rgb[COUNT][3], luma[COUNT + 1], cb[COUNT + 1], cr[COUNT + 1];
    luma[COUNT] = cb[COUNT] = cr[COUNT] = 99;
    for (int i = 0; i < COUNT; i++) {
      for (int c = 0; c < 3; c++)
        rgb[i][c] = round < 8 ? (round >> c & 1) * 255 : (unsigned char)random_below(&random, 256);
      pixels[i] = pixel_of(rgb[i]);
    }
    CS_WIDE_CHOOSE(isa, cs_ycbcr_luma)(pixels, COUNT, luma);
    CS_WIDE_CHOOSE(isa, cs_ycbcr_chroma)(pixels, COUNT, cb, cr);
    for (int i = 0; i < COUNT; i++) {
      double exact[3];
      exactly((const double[3]){rgb[i][0], rgb[i][1], rgb[i][2]}, exact);
      wrong +=
          !is_near(luma[i], exact[0]) || !is_near(cb[i], exact[1]) || !is_near(cr[i], exact[2]);
    }
    wrong += luma[COUNT] != 99 || cb[COUNT] != 99 || cr[COUNT] != 99;
  }
  CHECK(wrong == 0);
}

/* The ends of the range: black, white, and the strongest colours. */
static void test_ends(cs_isa isa) {
  const unsigned char rgb[4][3] = {{0, 0, 0}, {255, 255, 255}, {0, 0, 255}, {255, 0, 0}};
  uint32_t pixels[4];
  unsigned char luma[4], cb[4], cr[4];
  for (int i = 0; i < 4; i++)
    pixels[i] = pixel_of(rgb[i]);
  CS_WIDE_CHOOSE(isa, cs_ycbcr_luma)(pixels, 4, luma);
  CS_WIDE_CHOOSE(isa, cs_ycbcr_chroma)(pixels, 4, cb, cr);
  CHECK(luma[0] == 16 && cb[0] == 128 && cr[0] == 128);
  CHECK(luma[1] == 235 && cb[1] == 128 && cr[1] == 128);
  CHECK(cb[2] == 240 && cr[3] == 240);
}

static void test_halved(cs_isa isa) {
  test_random random = {4};
  long wrong = 0;
  for (int round = 0; round < 5000; round++) {
    uint32_t rows[2][2 * COUNT];
    double sums[COUNT][3] = {{0}};
    unsigned char cb[COUNT + 1], cr[COUNT + 1];
    cb[COUNT] = cr[COUNT] = 99;
    for (int i = 0; i < 4 * COUNT; i++) {
      unsigned char rgb[3];
      for (int c = 0; c < 3; c++) {
        rgb[c] = (unsigned char)random_below(&random, 256);
        sums[i % (2 * COUNT) / 2][c] += rgb[c] / 4.0;
      }
      rows[i / (2 * COUNT)][i % (2 * COUNT)] = pixel_of(rgb);
    }
    CS_WIDE_CHOOSE(isa, cs_ycbcr_halved)(rows[0], rows[1], COUNT, cb, cr);
    for (int i = 0; i < COUNT; i++) {
      double exact[3];
      exactly(sums[i], exact);
      wrong += !is_near(cb[i], exact[1]) || !is_near(cr[i], exact[2]);
    }
    wrong += cb[COUNT] != 99 || cr[COUNT] != 99;
  }
  CHECK(wrong == 0);
}

int main(void) {
  for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++) {
    test_colours(isa);
    test_ends(isa);
    test_halved(isa);
  }
  return check_done();
}
