/* output/sinks/pixels.c and the sinks that use it alone: memory and digest. */
#include "output/sinks/pixels.h"

#include <stdlib.h>

#include "model/colour/space.h"
#include "model/colour/srgb8.h"
#include "model/colour/transfer.h"
#include "output/sinks/pixels8.h"
#include "output/sinks/sink.h"
#include "output/sinks/straight.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

static float half_value(uint16_t half) {
  int exponent = half >> 10 & 31, mantissa = half & 1023;
  float size = exponent == 0 ? ldexpf((float)mantissa, -24)
                             : ldexpf((float)(mantissa + 1024), exponent - 25);
  return half & 0x8000 ? -size : size;
}

static uint16_t code_half(float x) {
  celspan_coding coding = {.struct_size = sizeof coding,
                           .depth = CELSPAN_DEPTH_HALF,
                           .transfer = CELSPAN_TRANSFER_LINEAR,
                           .alpha = CELSPAN_ALPHA_PREMULTIPLIED};
  float rgba[4] = {x, 0, 0, 1};
  uint16_t pixel[4];
  cs_pixels_code(&coding, rgba, pixel);
  return pixel[0];
}

static void check_half(void) {
  int wrong = 0;
  for (unsigned half = 0; half < 0x7bff; half++) {
    float low = half_value((uint16_t)half), high = half_value((uint16_t)(half + 1));
    float middle = low + (high - low) / 2;
    wrong += code_half(low) != half || code_half(-low) != (half | 0x8000);
    wrong += code_half(middle) != (half & 1 ? half + 1 : half);
    wrong += code_half(nextafterf(middle, 0)) != half;
    wrong += code_half(nextafterf(middle, HUGE_VALF)) != half + 1;
  }
  CHECK(wrong == 0);
  /* From the middle between the greatest half and the next power of two, rounding would
   * overflow. */
  static const float large[] = {65504, 65519, 65520, 65535, 65536, 1e30f, 3.4e38f};
  for (size_t i = 0; i < sizeof large / sizeof *large; i++)
    CHECK(code_half(large[i]) == 0x7bff && code_half(-large[i]) == 0xfbff);
  CHECK(code_half(nextafterf(65520, 0)) == 0x7bff && code_half(nextafterf(65520, 1e9f)) == 0x7bff);
  CHECK(code_half(HUGE_VALF) == 0x7bff && code_half(-HUGE_VALF) == 0xfbff);
  CHECK((code_half(NAN) & 0x7fff) > 0x7c00);
}

static void check_defaults(void) {
  celspan_coding made = cs_pixels_resolve(NULL, CELSPAN_DEPTH_DEFAULT);
  CHECK(made.depth == CELSPAN_DEPTH_8 && made.transfer == CELSPAN_TRANSFER_SRGB &&
        made.alpha == CELSPAN_ALPHA_STRAIGHT);
  made = cs_pixels_resolve(&(celspan_coding){.struct_size = sizeof(celspan_coding)},
                           CELSPAN_DEPTH_HALF);
  CHECK(made.depth == CELSPAN_DEPTH_HALF && made.transfer == CELSPAN_TRANSFER_LINEAR &&
        made.alpha == CELSPAN_ALPHA_PREMULTIPLIED);
  made = cs_pixels_resolve(&(celspan_coding){.struct_size = sizeof(celspan_coding),
                                             .depth = CELSPAN_DEPTH_16,
                                             .transfer = CELSPAN_TRANSFER_CINEON,
                                             .alpha = CELSPAN_ALPHA_PREMULTIPLIED},
                           CELSPAN_DEPTH_8);
  CHECK(made.depth == CELSPAN_DEPTH_16 && made.transfer == CELSPAN_TRANSFER_CINEON &&
        made.alpha == CELSPAN_ALPHA_PREMULTIPLIED);
  static const size_t sizes[] = {4, 4, 8, 8, 16};
  for (int depth = 0; depth < 5; depth++)
    CHECK(celspan_coding_pixel_size(&(celspan_coding){.struct_size = sizeof(celspan_coding),
                                                      .depth = (celspan_depth)depth}) ==
          sizes[depth]);
}

static void check_straight(void) {
  celspan_coding coding = cs_pixels_resolve(NULL, CELSPAN_DEPTH_8);
  unsigned char pixel[4];
  float half_covered[4] = {0.25f, 0.5f, 0.0f, 0.5f};
  cs_pixels_code(&coding, half_covered, pixel);
  CHECK(pixel[0] == 188 && pixel[1] == 255 && pixel[2] == 0 && pixel[3] == 128);
  float glow[4] = {0.25f, 0.5f, 0.0f, 0.0f}, bad[4] = {NAN, 2, -1, 1};
  cs_pixels_code(&coding, glow, pixel);
  CHECK(pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0 && pixel[3] == 0);
  cs_pixels_code(&coding, bad, pixel);
  CHECK(pixel[0] == 0 && pixel[1] == 255 && pixel[2] == 0 && pixel[3] == 255);
  coding.alpha = CELSPAN_ALPHA_PREMULTIPLIED;
  cs_pixels_code(&coding, half_covered, pixel);
  CHECK(pixel[0] == 137 && pixel[1] == 188 && pixel[2] == 0 && pixel[3] == 128);
  coding = (celspan_coding){.struct_size = sizeof(celspan_coding),
                            .depth = CELSPAN_DEPTH_FLOAT,
                            .transfer = CELSPAN_TRANSFER_LINEAR,
                            .alpha = CELSPAN_ALPHA_STRAIGHT};
  float floats[4];
  cs_pixels_code(&coding, half_covered, floats);
  CHECK(floats[0] == 0.5f && floats[1] == 1 && floats[2] == 0 && floats[3] == 0.5f);
}

/* Premultiplied, the light of a colour is coded as if it were opaque, and its alpha as it is. */
static void check_premultiplied(void) {
  enum { COUNT = 1000 };
  static float light[4 * COUNT], opaque[4 * COUNT];
  static unsigned char found[4 * COUNT], wanted[4 * COUNT];
  celspan_coding coding = cs_pixels_resolve(NULL, CELSPAN_DEPTH_8);
  for (int i = 0; i < 4 * COUNT; i++) {
    light[i] = i % 4 == 3 ? (float)(i / 4 % 256) / 255 : (float)(i * 37 % 1009) / 1000;
    opaque[i] = i % 4 == 3 ? 1 : light[i];
  }
  const celspan_span spans[2] = {
      {.x1 = COUNT, .kind = CELSPAN_SPAN_ARRAY, .array = light},
      {.x1 = COUNT, .kind = CELSPAN_SPAN_ARRAY, .array = opaque},
  };
  cs_pixels_row(&coding, &spans[1], 1, wanted);
  coding.alpha = CELSPAN_ALPHA_PREMULTIPLIED;
  cs_pixels_row(&coding, &spans[0], 1, found);
  int wrong = 0;
  for (int i = 0; i < 4 * COUNT; i++)
    wrong += found[i] != (i % 4 == 3 ? i / 4 % 256 : wanted[i]);
  CHECK(wrong == 0);
}

static void check_16(void) {
  celspan_coding coding = {.struct_size = sizeof coding,
                           .depth = CELSPAN_DEPTH_16,
                           .transfer = CELSPAN_TRANSFER_LINEAR,
                           .alpha = CELSPAN_ALPHA_STRAIGHT};
  int wrong = 0;
  for (int code = 0; code < 65536; code++) {
    float x = (float)((code + 0.49) / 65535), rgba[4] = {x, (float)(code / 65535.0), 0, 1};
    uint16_t pixel[4];
    cs_pixels_code(&coding, rgba, pixel);
    wrong += pixel[0] != code || pixel[1] != code || pixel[3] != 65535;
  }
  CHECK(wrong == 0);
}

/* ---------------------------------------------------------------- every set of instructions */

static bool is_same(float a, float b) {
  return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static unsigned word_of(float x) {
  return !(x > 0) ? 0 : x >= 1 ? 65535 : (unsigned)((double)x * 65535 + 0.5);
}

/* The light at the border below a code of 16 bits, and the floats beside it. */
static float near_border(int code, int step) {
  float light = cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)((code - 0.5) / 65535));
  for (int k = 0; k < abs(step); k++)
    light = nextafterf(light, step < 0 ? -2.0f : 2.0f);
  return light;
}

/* All borders of codes, and among them colours that no code has. */
static void check_borders_16(cs_isa isa) {
  enum { NEIGHBOURS = 3, BATCH = 67, AROUND = 2 * NEIGHBOURS + 1 };
  static const float strange[] = {NAN, INFINITY, -INFINITY, -0.0f, 1, 1.5f, -0.3f, 1e-30f, 3e7f};
  enum { STRANGERS = sizeof strange / sizeof *strange };
  int wrong = 0;
  for (int code = 0; code <= 65536; code += BATCH) {
    float light[BATCH * AROUND + 1], coded[BATCH * AROUND + 1];
    uint16_t words[BATCH * AROUND + 1];
    for (int i = 0; i < BATCH * AROUND; i++)
      light[i] = near_border(code + i / AROUND, i % AROUND - NEIGHBOURS);
    if (code / BATCH % 4 == 0)
      light[code % (BATCH * AROUND)] = strange[code / BATCH / 4 % STRANGERS];
    light[BATCH * AROUND] = 77;
    words[BATCH * AROUND] = 77;
    memcpy(coded, light, sizeof coded);
    CS_WIDE_CHOOSE(isa, cs_space_codes)(BATCH * AROUND, coded);
    CS_WIDE_CHOOSE(isa, cs_straight_words)(coded, BATCH * AROUND, words);
    for (int i = 0; i < BATCH * AROUND; i++) {
      float wanted = cs_transfer_encode(CELSPAN_TRANSFER_SRGB, light[i]);
      wrong += !is_same(coded[i], wanted) || words[i] != word_of(wanted);
    }
    wrong += coded[BATCH * AROUND] != 77 || words[BATCH * AROUND] != 77;
  }
  CHECK(wrong == 0);
}

static void check_divided(cs_isa isa) {
  enum { PIXELS = 37 };
  static const float alphas[] = {1, 0, 0.5f, -0.25f, NAN, INFINITY, 1e-20f, 0.3f, -0.0f, 2};
  test_random random = {11};
  int wrong = 0;
  for (int round = 0; round < 2000; round++) {
    float given[4 * PIXELS + 4], divided[4 * PIXELS + 4];
    int32_t count = 1 + round % PIXELS;
    bool keeps_clear = round % 3 == 0;
    for (int i = 0; i < 4 * PIXELS + 4; i++)
      given[i] = i % 4 == 3 && round % 2 ? alphas[random_below(&random, 10)]
                                         : (float)random_between(&random, -0.2, 1.2);
    memcpy(divided, given, sizeof divided);
    CS_WIDE_CHOOSE(isa, cs_straight_divide)(divided, count, keeps_clear);
    for (int i = 0; i < 4 * PIXELS + 4; i++) {
      float alpha = given[i | 3], kept = keeps_clear ? given[i] : 0;
      bool is_colour = i < 4 * count && i % 4 < 3;
      float wanted = !is_colour ? given[i] : alpha > 0 ? given[i] / alpha : kept;
      wrong += !is_same(divided[i], wanted);
    }
  }
  CHECK(wrong == 0);
}

/* ---------------------------------------------------------------- rows */

enum { WIDTH = 5000 };
static float colours[4 * WIDTH];

static size_t make_row(celspan_span *spans) {
  size_t count = 0;
  for (int32_t x = 0; x < WIDTH; count++) {
    int32_t length = 1 + (int32_t)(count * count * 7 % 997);
    celspan_span *span = &spans[count];
    *span = (celspan_span){.x0 = x, .x1 = x + length < WIDTH ? x + length : WIDTH};
    span->kind = (celspan_span_kind)(count % 3);
    span->origin = x - 5;
    span->array = colours + 4 * x;
    for (int c = 0; c < 4; c++) {
      span->colour[c] = (float)(count * (unsigned)(c + 3) % 11) / 10;
      span->slope[c] = (float)(c - 2) / 3000;
    }
    x = span->x1;
  }
  return count;
}

static void check_row(celspan_coding coding, const celspan_span *spans, size_t count) {
  size_t size = celspan_coding_pixel_size(&coding);
  unsigned char *row = malloc(WIDTH * size + 1), expected[16];
  int wrong = 0;
  row[WIDTH * size] = 77;
  cs_pixels_row(&coding, spans, count, row);
  for (size_t i = 0; i < count; i++)
    for (int32_t x = spans[i].x0; x < spans[i].x1; x++) {
      float rgba[4];
      celspan_span_colour(&spans[i], x, rgba);
      cs_pixels_code(&coding, rgba, expected);
      wrong += memcmp(expected, row + (size_t)x * size, size) != 0;
    }
  CHECK(wrong == 0 && row[WIDTH * size] == 77);
  free(row);
}

/* Flat spans of every length at every position in a cache line, between bytes that do not belong to
 * the row. */
static void check_lengths(celspan_coding coding) {
  enum { MOST = 150, AROUND = 80 };
  size_t size = celspan_coding_pixel_size(&coding);
  static _Alignas(64) unsigned char room[(MOST + 2) * 16 + 2 * AROUND];
  unsigned char left[16], right[16];
  int wrong = 0;
  for (size_t at = 0; at < 64; at++)
    for (int32_t length = 1; length <= MOST; length++) {
      celspan_span spans[2] = {{.x0 = 0, .x1 = length, .colour = {1, 0.5f, 0.25f, 1}},
                               {.x0 = length, .x1 = length + 1, .colour = {0, 0.1f, 0.2f, 0.5f}}};
      size_t end = at + (size_t)(length + 1) * size;
      memset(room, 77, sizeof room);
      cs_pixels_row(&coding, spans, 2, room + at);
      cs_pixels_code(&coding, spans[0].colour, left);
      cs_pixels_code(&coding, spans[1].colour, right);
      for (int32_t x = 0; x < length; x++)
        wrong += memcmp(room + at + (size_t)x * size, left, size) != 0;
      wrong += memcmp(room + end - size, right, size) != 0;
      for (size_t i = 0; i < AROUND; i++)
        wrong += room[end + i] != 77 || (i < at && room[i] != 77);
    }
  CHECK(wrong == 0);
}

static void check_rows(void) {
  static celspan_span spans[WIDTH];
  for (int i = 0; i < 4 * WIDTH; i++)
    colours[i] = i % 4 == 3 ? (float)(i % 7) / 6 : (float)(i % 101) / 100;
  size_t count = make_row(spans);
  for (int depth = CELSPAN_DEPTH_8; depth <= CELSPAN_DEPTH_FLOAT; depth++)
    for (int transfer = CELSPAN_TRANSFER_LINEAR; transfer <= CELSPAN_TRANSFER_CINEON; transfer++)
      for (int alpha = CELSPAN_ALPHA_STRAIGHT; alpha <= CELSPAN_ALPHA_PREMULTIPLIED; alpha++)
        for (int space = CELSPAN_SPACE_LINEAR; space <= CELSPAN_SPACE_SRGB; space++)
          check_row((celspan_coding){.struct_size = sizeof(celspan_coding),
                                     .depth = (celspan_depth)depth,
                                     .transfer = (celspan_transfer)transfer,
                                     .alpha = (celspan_alpha)alpha,
                                     .space = (celspan_space)space},
                    spans, count);
}

/* ---------------------------------------------------------------- conversions */

/* Mixes channels and adds to black, so that premultiplied colours would give other numbers. */
static void swap_and_add(void *user, float *rgba, size_t count) {
  const float *added = user;
  for (; count > 0; count--, rgba += 4) {
    float red = rgba[0];
    rgba[0] = rgba[2] + *added;
    rgba[1] = rgba[1] * rgba[1] + *added;
    rgba[2] = red + *added;
  }
}

static void check_converted(celspan_depth depth, celspan_alpha alpha, const float rgba[4],
                            const float expected[4]) {
  static float added = 0.25f;
  const celspan_coding given = {.struct_size = sizeof given,
                                .depth = depth,
                                .alpha = alpha,
                                .convert = swap_and_add,
                                .user = &added,
                                .colour = "swapped"};
  celspan_coding coding = cs_pixels_resolve(&given, CELSPAN_DEPTH_8);
  float coded[4];
  cs_pixels_encode(&coding, rgba, coded);
  CHECK(memcmp(coded, expected, sizeof coded) == 0);
  CHECK(!cs_pixels_takes_codes(&coding));
  CHECK(strcmp(cs_pixels_colour(&coding), "swapped") == 0);
}

static void check_conversions(void) {
  const float half[4] = {0.25f, 0.125f, 0.0625f, 0.5f}, glow[4] = {0.25f, 0.5f, 0.5f, 0};
  const float clear[4] = {0, 0, 0, 0};
  for (int depth = CELSPAN_DEPTH_8; depth <= CELSPAN_DEPTH_FLOAT; depth++) {
    check_converted((celspan_depth)depth, CELSPAN_ALPHA_STRAIGHT, half,
                    (float[4]){0.375f, 0.3125f, 0.75f, 0.5f});
    check_converted((celspan_depth)depth, CELSPAN_ALPHA_PREMULTIPLIED, half,
                    (float[4]){0.1875f, 0.15625f, 0.375f, 0.5f});
    check_converted((celspan_depth)depth, CELSPAN_ALPHA_PREMULTIPLIED, glow,
                    (float[4]){0.75f, 0.5f, 0.5f, 0});
    check_converted((celspan_depth)depth, CELSPAN_ALPHA_PREMULTIPLIED, clear, clear);
  }
}

/* ---------------------------------------------------------------- the usual coding */

/* Runs as in real frames: most a pixel long, some long, a few very long. */
static int32_t random_length(test_random *random, int32_t most) {
  static const int32_t lengths[] = {1, 1, 1, 2, 16, 16, 40, 1100};
  int32_t length = 1 + random_below(random, lengths[random_below(random, 8)]);
  length *= random_below(random, 500) ? 1 : 40;
  return length < most ? length : most;
}

static size_t random_row(test_random *random, celspan_span *spans, int32_t width) {
  size_t count = 0;
  for (int32_t x = 0; x < width; count++) {
    celspan_span *span = &spans[count];
    *span = (celspan_span){.x0 = x, .x1 = x + random_length(random, width - x), .origin = x - 3};
    span->array = colours;
    if (random_below(random, 8) == 0 && span->x1 - x <= WIDTH)
      span->kind = (celspan_span_kind)(1 + random_below(random, 2));
    for (int c = 0; c < 4; c++) {
      span->colour[c] = (float)random_between(random, 0, 1.1);
      span->slope[c] = (float)random_between(random, -0.01, 0.01);
    }
    x = span->x1;
  }
  return count;
}

static int count_wrong(const celspan_span *spans, size_t count, bool is_coded,
                       const unsigned char *row) {
  int wrong = 0;
  for (size_t i = 0; i < count; i++)
    for (int32_t x = spans[i].x0; x < spans[i].x1; x++) {
      float rgba[4];
      celspan_span_colour(&spans[i], x, rgba);
      uint32_t wanted = cs_srgb8_pixel_of(rgba, is_coded);
      wrong += memcmp(&wanted, row + 4 * (size_t)x, sizeof wanted) != 0;
    }
  return wrong;
}

/* With every instruction set a row is right at any position, and ends where it should. */
static void check_usual_rows(cs_isa isa) {
  enum { MOST = 60000, AROUND = 128 };
  static celspan_span spans[MOST];
  static unsigned char room[4 * MOST + 2 * AROUND];
  test_random random = {31};
  int wrong = 0;
  for (int k = 0; k < 300; k++) {
    int32_t width = 1 + random_below(&random, k % 2 ? 300 : MOST);
    size_t count = random_row(&random, spans, width), at = AROUND - (size_t)(k % 64);
    unsigned char *row = room + at, *end = row + 4 * (size_t)width;
    memset(room, 77, at);
    memset(end, 77, AROUND);
    if (k % 3 == 0)
      CS_WIDE_CHOOSE(isa, cs_pixels8_codes)(spans, count, row);
    else
      CS_WIDE_CHOOSE(isa, cs_pixels8_row)(spans, count, row);
    wrong += count_wrong(spans, count, k % 3 == 0, row);
    for (size_t i = 0; i < AROUND; i++)
      wrong += end[i] != 77 || (i < at && room[i] != 77);
  }
  CHECK(wrong == 0);
}

/* ---------------------------------------------------------------- sinks */

static celspan_status feed(celspan_context *context, celspan_sink *sink, const celspan_span *spans,
                           int32_t height) {
  celspan_status status = sink->begin(sink->user, context, 3, height);
  if (status != CELSPAN_OK) {
    cs_sink_discard(context, sink);
    return status;
  }
  for (int32_t y = 0; y < height && status == CELSPAN_OK; y++)
    status = sink->row(sink->user, context, y, spans, 2);
  return sink->end(sink->user, context, status);
}

static void check_memory_sink(celspan_context *context, const celspan_span *spans) {
  unsigned char pixels[2][20];
  celspan_sink sink;
  memset(pixels, 9, sizeof pixels);
  CHECK(cs_sink_memory(context, NULL, pixels, 20, &sink) == CELSPAN_OK);
  CHECK(feed(context, &sink, spans, 2) == CELSPAN_OK);
  CHECK(pixels[1][0] == 255 && pixels[1][11] == 255 && pixels[0][12] == 9);
  CHECK(memcmp(pixels[0], pixels[1], 20) == 0);
  CHECK(cs_sink_memory(context, NULL, pixels, 11, &sink) == CELSPAN_OK);
  CHECK(feed(context, &sink, spans, 2) == CELSPAN_BAD_ARGUMENT);
}

static void digest_of(celspan_context *context, const celspan_span *spans, int32_t height,
                      const celspan_coding *coding, uint64_t digest[2]) {
  celspan_sink sink;
  CHECK(cs_sink_digest(context, coding, digest, &sink) == CELSPAN_OK);
  CHECK(feed(context, &sink, spans, height) == CELSPAN_OK);
}

static void check_digest_sink(celspan_context *context, const celspan_span *spans) {
  uint64_t first[2], cut[2], taller[2], other[2];
  celspan_span moved[2] = {spans[0], spans[1]};
  moved[0].x1 = moved[1].x0 = 1;
  digest_of(context, spans, 4, NULL, first);
  digest_of(context, moved, 4, NULL, cut);
  CHECK((first[0] == cut[0]) == (memcmp(spans[0].colour, spans[1].colour, 16) == 0));
  digest_of(context, spans, 5, NULL, taller);
  CHECK(first[0] != taller[0] && first[1] != taller[1]);
  digest_of(context, spans, 4,
            &(celspan_coding){.struct_size = sizeof(celspan_coding), .depth = CELSPAN_DEPTH_16},
            other);
  CHECK(first[0] != other[0]);
}

int main(void) {
  celspan_context *context;
  celspan_span same[2] = {{.x0 = 0, .x1 = 2, .colour = {1, 1, 1, 1}},
                          {.x0 = 2, .x1 = 3, .colour = {1, 1, 1, 1}}};
  celspan_span different[2] = {same[0], {.x0 = 2, .x1 = 3, .colour = {1, 0, 1, 1}}};
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  size_t before, after, peak;
  uint64_t allocations;
  celspan_context_memory(context, &before, &peak, &allocations);
  check_defaults();
  check_half();
  check_straight();
  check_premultiplied();
  check_16();
  check_rows();
  check_conversions();
  check_lengths((celspan_coding){.struct_size = sizeof(celspan_coding),
                                 .depth = CELSPAN_DEPTH_8,
                                 .transfer = CELSPAN_TRANSFER_SRGB,
                                 .alpha = CELSPAN_ALPHA_STRAIGHT});
  check_lengths((celspan_coding){.struct_size = sizeof(celspan_coding),
                                 .depth = CELSPAN_DEPTH_16,
                                 .transfer = CELSPAN_TRANSFER_LINEAR,
                                 .alpha = CELSPAN_ALPHA_STRAIGHT});
  check_lengths((celspan_coding){.struct_size = sizeof(celspan_coding),
                                 .depth = CELSPAN_DEPTH_FLOAT,
                                 .transfer = CELSPAN_TRANSFER_LINEAR,
                                 .alpha = CELSPAN_ALPHA_PREMULTIPLIED});
  for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++) {
    check_usual_rows(isa);
    check_borders_16(isa);
    check_divided(isa);
  }
  check_memory_sink(context, same);
  check_digest_sink(context, same);
  check_digest_sink(context, different);
  celspan_sink sink;
  CHECK(cs_sink_digest(context, NULL, (uint64_t[2]){0}, &sink) == CELSPAN_OK);
  cs_sink_discard(context, &sink);
  celspan_context_memory(context, &after, &peak, &allocations);
  CHECK(after == before);
  celspan_context_destroy(context);
  return check_done();
}
