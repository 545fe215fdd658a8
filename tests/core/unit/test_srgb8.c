/* model/colour/srgb8.c: every instruction set gives the same code for every colour.
 */
#include "model/colour/srgb8_lanes.h"

#include <math.h>

#include "tests/support/check.h"
#include "tests/support/random.h"

enum { PIXELS = 4096 };

static float colours[PIXELS][4];
static unsigned char codes[4 * PIXELS];

/* All floats from 0 to a little over 1, three a pixel. */
static void check_every_float(cs_isa isa) {
  const uint32_t last = 0x3f800010; /* above 1 */
  long wrong = 0;
  for (uint32_t bits = 0; bits < last;) {
    uint32_t begun = bits;
    for (int i = 0; i < PIXELS; i++) {
      for (int c = 0; c < 3; c++, bits++)
        memcpy(&colours[i][c], &bits, sizeof bits);
      colours[i][3] = 1;
    }
    cs_srgb8_choose(isa)(colours[0], PIXELS, codes);
    for (int i = 0; i < PIXELS; i++)
      for (int c = 0; c < 3; c++)
        wrong += codes[4 * i + c] != cs_transfer_srgb8(colours[i][c]);
    if (begun < 0x38800000) /* below 2^-14 all are 0: a few are enough */
      bits += 0x10000;
  }
  CHECK(wrong == 0);
}

static test_random numbers = {7};

static float strange(void) {
  static const float values[] = {0, -0.0f, 1, -1, 2, 1e-30f, INFINITY, -INFINITY, NAN, 0.5f};
  return values[random_below(&numbers, sizeof values / sizeof *values)];
}

static void check_translucent(cs_isa isa, int strangers) {
  int wrong = 0;
  for (int i = 0; i < PIXELS; i++) {
    colours[i][3] = i % 5 ? random_unit(&numbers) : 1;
    for (int c = 0; c < 3; c++)
      colours[i][c] = random_unit(&numbers) * colours[i][3];
    if (strangers && i % strangers == 0) {
      int channel = random_below(&numbers, 4);
      colours[i][channel] = strange();
    }
  }
  cs_srgb8_choose(isa)(colours[0], PIXELS, codes);
  for (int i = 0; i < PIXELS; i++) {
    uint32_t code, wanted = cs_srgb8_pixel(colours[i]);
    memcpy(&code, codes + 4 * i, sizeof code);
    wrong += code != wanted;
  }
  CHECK(wrong == 0);
}

/* Short arrays, and nothing written beyond their ends. */
static void check_lengths(cs_isa isa) {
  int wrong = 0;
  for (size_t count = 0; count < 200; count++) {
    memset(codes, 0xa5, 4 * 256);
    cs_srgb8_choose(isa)(colours[0], count, codes);
    for (size_t i = 0; i < count; i++) {
      uint32_t code;
      memcpy(&code, codes + 4 * i, sizeof code);
      wrong += code != cs_srgb8_pixel(colours[i]);
    }
    for (size_t i = 4 * count; i < 4 * 256; i++)
      wrong += codes[i] != 0xa5;
  }
  CHECK(wrong == 0);
}

/* Runs of one colour, of any length and at any place, which differ in one channel or in a bit. */
static void check_flat(cs_isa isa) {
  int wrong = 0;
  for (int i = 0; i < PIXELS; i++) {
    const bool is_new = i == 0 || random_below(&numbers, i < PIXELS / 2 ? 40 : 7) == 0;
    memcpy(colours[i], i > 0 ? colours[i - 1] : (float[4]){0}, sizeof colours[i]);
    if (is_new)
      colours[i][random_below(&numbers, 4)] = i % 3 ? random_unit(&numbers) : strange();
  }
  cs_srgb8_choose(isa)(colours[0], PIXELS, codes);
  for (int i = 0; i < PIXELS; i++) {
    uint32_t code;
    memcpy(&code, codes + 4 * i, sizeof code);
    wrong += code != cs_srgb8_pixel(colours[i]);
  }
  CHECK(wrong == 0);
}

/* A code that is decoded and premultiplied is restored, so pictures may be copied as codes. */
static void check_round_trip(void) {
  int wrong = 0;
  for (int alpha = 1; alpha < 256; alpha++)
    for (int code = 0; code < 256; code++) {
      float a = (float)alpha / 255,
            light = cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)code / 255);
      float rgba[4] = {light * a, light * a, light * a, a};
      wrong += cs_srgb8_pixel(rgba) != ((uint32_t)alpha << 24 | (uint32_t)code * 0x10101u);
    }
  CHECK(wrong == 0);
}

int main(void) {
  for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++) {
    if (isa != CS_ISA_ANY)
      check_every_float(isa);
    check_translucent(isa, 0);
    check_translucent(isa, 3);
    check_lengths(isa);
    check_flat(isa);
  }
  check_round_trip();
  return check_done();
}
