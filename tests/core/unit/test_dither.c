/* Dithering: means are preserved, exact numbers are not changed, and a pixel depends only on its
 * colour and place.
 */
#include "output/sinks/coder.h"
#include "output/sinks/dither.h"

#include <math.h>

#include "celspan/celspan.h"
#include "model/colour/transfer.h"
#include "output/sinks/pixels.h"
#include "output/sinks/shares.h"
#include "output/sinks/sink.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

static celspan_span single(int32_t x0, int32_t x1, const float rgba[4]) {
  celspan_span span = {.x0 = x0, .x1 = x1, .kind = CELSPAN_SPAN_SINGLE};
  memcpy(span.colour, rgba, sizeof span.colour);
  return span;
}

/* The mean of 16 x 16 pixels anywhere is the number before rounding, in every coding. */
static void test_mean(void) {
  test_random random = {1};
  for (int round = 0; round < 400; round++) {
    celspan_coding coding = {.struct_size = sizeof coding,
                             .depth = CELSPAN_DEPTH_8_DITHER,
                             .transfer = (celspan_transfer)(1 + round % 4),
                             .alpha = (celspan_alpha)(1 + round / 4 % 2)};
    celspan_coding plain = cs_pixels_resolve(&coding, CELSPAN_DEPTH_8);
    float alpha = (float)random_between(&random, 0.05, 1), rgba[4], coded[4];
    for (int c = 0; c < 3; c++)
      rgba[c] = alpha * (float)random_between(&random, 0, 1);
    rgba[3] = alpha;
    cs_pixels_encode(&plain, rgba, coded);
    celspan_span span = single(0, 16, rgba);
    double sums[4] = {0};
    int32_t x = (int32_t)random_between(&random, 0, 1e6),
            y = (int32_t)random_between(&random, 0, 1e6);
    for (int32_t row = 0; row < 16; row++) {
      unsigned char pixels[16][4];
      celspan_spans_code_at(&coding, x, y + row, &span, 1, pixels);
      for (int i = 0; i < 16; i++)
        for (int c = 0; c < 4; c++)
          sums[c] += pixels[i][c];
    }
    for (int c = 0; c < 4; c++)
      CHECK_NEAR(sums[c] / 256 / 255, coded[c] < 0 ? 0 : coded[c] > 1 ? 1 : coded[c], 1.0 / 65535);
  }
}

/* Colours that 8 bits represent exactly are not changed: black, white, clear, and every code of a
 * picture. */
static void test_exact(void) {
  celspan_coding dither = {.struct_size = sizeof dither, .depth = CELSPAN_DEPTH_8_DITHER},
                 plain = {.struct_size = sizeof plain, .depth = CELSPAN_DEPTH_8};
  for (int code = 0; code < 256; code++) {
    char text[10];
    celspan_paint paint;
    snprintf(text, sizeof text, "#%02x%02x%02x", (unsigned)code, 255u - (unsigned)code,
             (unsigned)code);
    CHECK(celspan_paint_parse(text, &paint));
    const float rgba[4] = {paint.pigment[0], paint.pigment[1], paint.pigment[2], 1};
    celspan_span span = single(0, 16, rgba);
    for (int32_t y = 0; y < 16; y++) {
      unsigned char found[16][4], wanted[16][4];
      celspan_spans_code_at(&dither, 3, y, &span, 1, found);
      celspan_spans_code(&plain, &span, 1, wanted);
      CHECK(memcmp(found, wanted, sizeof found) == 0);
    }
  }
}

/* Singles, gradients and arrays of the same colours give the same bytes, wherever rows are cut. */
static void test_place(void) {
  celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_8_DITHER};
  const float grey[4] = {0.2003f, 0.2003f, 0.2003f, 1};
  float array[64][4];
  unsigned char whole[64][4], part[64][4];
  for (int i = 0; i < 64; i++)
    memcpy(array[i], grey, sizeof grey);
  celspan_span span = single(0, 64, grey);
  celspan_spans_code_at(&coding, 100, 7, &span, 1, whole);
  celspan_span spans[3] = {single(0, 11, grey), single(11, 30, grey), single(30, 64, grey)};
  spans[1].kind = CELSPAN_SPAN_GRADIENT;
  spans[2].kind = CELSPAN_SPAN_ARRAY;
  spans[2].array = array[0];
  celspan_spans_code_at(&coding, 100, 7, spans, 3, part);
  CHECK(memcmp(whole, part, sizeof whole) == 0);
  span = single(0, 20, grey);
  celspan_spans_code_at(&coding, 113, 7, &span, 1, part);
  CHECK(memcmp(whole[13], part, 20 * 4) == 0);
  CHECK(memcmp(whole[0], whole[1], 4) != 0);
}

/* A frame made in parts equals the frame as a whole, with any number of workers. */
static void test_frames(void) {
  celspan_context *context = NULL;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  studio s = {.context = context};
  const celspan_stop stops[2] = {{0, celspan_paint_rgb(0.1f, 0.1f, 0.1f, 1)},
                                 {1, celspan_paint_rgb(0.12f, 0.14f, 0.1f, 0.9f)}};
  celspan_texture *texture =
      studio_linear(&s, (celspan_point){0, 0}, (celspan_point){48, 40}, stops, 2);
  celspan_object *object = studio_rect(&s, 0, 0, 48, 40, texture);
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  cel_desc.objects = &object;
  cel_desc.object_count = 1;
  celspan_cel *cel = NULL;
  studio_check(&s, celspan_cel_create(context, &cel_desc, &cel));
  celspan_rostrum_desc rostrum_desc = CELSPAN_ROSTRUM_DESC;
  rostrum_desc.cels = &cel;
  rostrum_desc.cel_count = 1;
  celspan_exposure exposure = {.weight = 1};
  studio_check(&s, celspan_rostrum_create(context, &rostrum_desc, &exposure.rostrum));
  const celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_8_DITHER};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.width = 48;
  frame.height = 40;
  static unsigned char whole[40][48][4], other[40][48][4], part[9][17][4];
  frame.workers = 1;
  studio_check(&s, celspan_frame_pixels(context, &frame, &coding, whole, sizeof whole[0], NULL));
  frame.workers = 4;
  frame.strip_rows = 3;
  studio_check(&s, celspan_frame_pixels(context, &frame, &coding, other, sizeof other[0], NULL));
  CHECK(memcmp(whole, other, sizeof whole) == 0);
  frame.crop_x = 21;
  frame.crop_y = 6;
  frame.crop_width = 17;
  frame.crop_height = 9;
  studio_check(&s, celspan_frame_pixels(context, &frame, &coding, part, sizeof part[0], NULL));
  for (int y = 0; y < 9; y++)
    CHECK(memcmp(whole[6 + y][21], part[y], sizeof part[y]) == 0);
  celspan_rostrum_unref(exposure.rostrum);
  celspan_cel_unref(cel);
  studio_finish(&s);
  celspan_context_destroy(context);
}

/* ---------------------------------------------------------------- every set of instructions */

enum { NEIGHBOURS = 3, ROW = 255 * CS_DITHER_PERIOD };

static const float alphas[] = {1, 0.5f, 0.3f, 0}; /* 0: alpha is at borders too */

/* Each border between two codes of each place of a row of lifts, `step` floats beside it. */
static void fill_borders(const celspan_coding *coding, const cs_dither_lifts *lifts, int step,
                         float alpha, float (*row)[4]) {
  for (int i = 0; i < ROW; i++) {
    float border = ((float)(i / CS_DITHER_PERIOD) + 1 - lifts->of[i % CS_DITHER_PERIOD]) / 255;
    bool is_light = coding->space != CELSPAN_SPACE_SRGB;
    float opacity = alpha > 0 ? alpha : nextafterf(border, step < 0 ? -1 : 2);
    float number = is_light ? cs_transfer_decode(CELSPAN_TRANSFER_SRGB, border) : border;
    for (int c = 0; c < 3; c++) {
      float near = number;
      for (int k = 0; k < abs(step) + c; k++)
        near = nextafterf(near, step < 0 ? -1 : 2);
      row[i][c] = coding->alpha == CELSPAN_ALPHA_STRAIGHT ? near * opacity : near;
    }
    row[i][3] = opacity;
  }
}

static int count_wrong(const celspan_coding *coding, const cs_dither_lifts *lifts,
                       const float (*row)[4], int32_t count, const unsigned char (*pixels)[4]) {
  int wrong = 0;
  for (int32_t i = 0; i < count; i++) {
    float coded[4];
    cs_pixels_encode(coding, row[i], coded);
    for (int c = 0; c < 4; c++) {
      double number = !(coded[c] > 0) ? 0 : coded[c] > 1 ? 255 : 255 * (double)coded[c];
      double sum = number + (double)lifts->of[i % CS_DITHER_PERIOD];
      wrong += pixels[i][c] != (unsigned char)floor(sum);
    }
  }
  return wrong;
}

/* 16 of the 256 thresholds, in the order in which they are counted. */
static cs_dither_lifts lifts_from(int first) {
  cs_dither_lifts lifts;
  for (int i = 0; i < 2 * CS_DITHER_PERIOD; i++)
    lifts.of[i] = 1 - (float)(2 * (first + i % CS_DITHER_PERIOD) + 1) / 512;
  return lifts;
}

/* Cuts the row into spans of every kind. Where one has a single colour, it is that of one of its
 * pixels. */
static size_t cut_borders(test_random *random, float (*row)[4], celspan_span *spans) {
  size_t count = 0;
  for (int32_t at = 0, end; at < ROW; at = end) {
    end = at + 1 + random_below(random, 2 * CS_DITHER_PERIOD);
    end = end < ROW ? end : ROW;
    celspan_span *span = &spans[count++];
    *span = (celspan_span){.x0 = at, .x1 = end, .origin = at, .kind = random_below(random, 3)};
    span->array = row[at];
    if (span->kind == CELSPAN_SPAN_ARRAY)
      continue;
    memcpy(span->colour, row[at + random_below(random, end - at)], sizeof span->colour);
    for (int32_t x = at; x < end; x++)
      memcpy(row[x], span->colour, sizeof span->colour);
  }
  return count;
}

static int test_borders_of(const celspan_coding *coding, cs_isa isa, bool is_cut) {
  static float row[ROW][4];
  static unsigned char pixels[ROW][4];
  static celspan_span spans[ROW];
  test_random random = {9};
  int wrong = 0;
  for (int first = 0; first < 256; first += CS_DITHER_PERIOD) {
    cs_dither_lifts lifts = lifts_from(first);
    for (int step = -NEIGHBOURS; step <= NEIGHBOURS; step += NEIGHBOURS)
      for (size_t a = 0; a < sizeof alphas / sizeof *alphas; a++) {
        spans[0] = (celspan_span){.x1 = ROW, .kind = CELSPAN_SPAN_ARRAY, .array = row[0]};
        fill_borders(coding, &lifts, step, alphas[a], row);
        size_t count = is_cut ? cut_borders(&random, row, spans) : 1;
        CS_WIDE_CHOOSE(isa, cs_dither_spans)(coding, &lifts, 0, spans, count, pixels[0]);
        wrong += count_wrong(coding, &lifts, (const float(*)[4])row, ROW,
                             (const unsigned char(*)[4])pixels);
      }
  }
  return wrong;
}

/* Around every border between two codes, at every threshold. */
static void test_borders(cs_isa isa) {
  for (int k = 0; k < 4; k++) {
    const celspan_coding coding = {.struct_size = sizeof coding,
                                   .depth = CELSPAN_DEPTH_8,
                                   .transfer = CELSPAN_TRANSFER_SRGB,
                                   .alpha =
                                       k % 2 ? CELSPAN_ALPHA_STRAIGHT : CELSPAN_ALPHA_PREMULTIPLIED,
                                   .space = k / 2 ? CELSPAN_SPACE_SRGB : CELSPAN_SPACE_LINEAR};
    CHECK(test_borders_of(&coding, isa, false) == 0);
    CHECK(test_borders_of(&coding, isa, true) == 0);
  }
}

static void make_strange(test_random *random, float rgba[4]) {
  static const float values[] = {0, -0.0f, 1, -1, 2, 1e-30f, INFINITY, -INFINITY, NAN, 0.5f};
  for (int c = 0; c < 4; c++)
    rgba[c] = random_below(random, 3)
                  ? random_unit(random)
                  : values[random_below(random, sizeof values / sizeof *values)];
}

/* Random rows of short and long spans are what their pixels are one by one, and nothing is written
 * beyond their ends. */
static void test_rows(cs_isa isa) {
  enum { MOST = 90 };
  test_random random = {5};
  const cs_dither_lifts lifts = lifts_from(64);
  celspan_coding coding = cs_pixels_resolve(NULL, CELSPAN_DEPTH_8);
  for (int round = 0; round < 3000; round++) {
    float colours[MOST][4];
    unsigned char pixels[MOST + 16][4];
    celspan_span spans[MOST];
    int32_t count = 0, width = 1 + random_below(&random, MOST), x = random_below(&random, 100);
    coding.alpha = round % 2 ? CELSPAN_ALPHA_STRAIGHT : CELSPAN_ALPHA_PREMULTIPLIED;
    for (int32_t at = 0, end; at < width; at = end) {
      end = at + 1 + random_below(&random, random_below(&random, 4) ? 4 : 60);
      end = end < width ? end : width;
      celspan_span *span = &spans[count++];
      *span = (celspan_span){.x0 = at, .x1 = end, .origin = at, .kind = random_below(&random, 3)};
      make_strange(&random, span->colour);
      for (int c = 0; span->kind == CELSPAN_SPAN_GRADIENT && c < 4; c++)
        span->slope[c] = 0.01f * random_unit(&random);
      if (span->kind == CELSPAN_SPAN_ARRAY)
        span->array = colours[at];
      for (int32_t k = at; k < end; k++)
        if (span->kind == CELSPAN_SPAN_ARRAY)
          make_strange(&random, colours[k]);
        else
          celspan_span_colour(span, k, colours[k]);
    }
    cs_dither_lifts turned = lifts;
    for (int i = 0; i < CS_DITHER_PERIOD; i++)
      turned.of[i] = lifts.of[(x + i) % CS_DITHER_PERIOD];
    memset(pixels, 0xa5, sizeof pixels);
    CS_WIDE_CHOOSE(isa, cs_dither_spans)(&coding, &lifts, x, spans, (size_t)count, pixels[0]);
    CHECK(count_wrong(&coding, &turned, (const float(*)[4])colours, width,
                      (const unsigned char(*)[4])pixels) == 0);
    for (int i = 0; i < 64; i++)
      CHECK(((unsigned char *)pixels)[4 * width + i] == 0xa5);
  }
}

static void test_failing_allocations(void) {
  for (size_t n = 1; n < 4; n++) {
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    const celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_8_DITHER};
    celspan_coding plain = cs_pixels_resolve(&coding, CELSPAN_DEPTH_8);
    uint64_t digest[2];
    celspan_sink sink;
    CHECK(cs_sink_digest(context, &plain, digest, &sink) == CELSPAN_OK);
    watch.fail_at = watch.allocations + n;
    celspan_status status = cs_coder_dither(context, &coding, &plain, 0, 0, &sink);
    CHECK((status == CELSPAN_OK) == (n > 1));
    if (status == CELSPAN_OK) {
      CHECK(sink.begin(sink.user, context, 10, 10) == CELSPAN_NO_MEMORY);
      (void)sink.end(sink.user, context, CELSPAN_NO_MEMORY);
    }
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0);
  }
}

/* ---------------------------------------------------------------- several threads */

/* Workers that dither by themselves, straight and premultiplied: the same bytes as through the
 * sink, and no memory stays if some is missing. */
static void test_shares(celspan_alpha alpha) {
  const celspan_coding coding = {
      .struct_size = sizeof coding, .depth = CELSPAN_DEPTH_8_DITHER, .alpha = alpha};
  celspan_coding plain = cs_pixels_resolve(&coding, CELSPAN_DEPTH_8);
  for (size_t n = 1; n < 5; n++) {
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    unsigned char pixels[2][9][4] = {0};
    celspan_sink sink;
    cs_shares shares;
    void *worker = NULL;
    CHECK(cs_sink_memory(context, &plain, pixels, sizeof pixels[0], &sink) == CELSPAN_OK);
    CHECK(cs_coder_dither(context, &coding, &plain, 5, 7, &sink) == CELSPAN_OK);
    CHECK(sink.begin(sink.user, context, 9, 2) == CELSPAN_OK);
    CHECK(cs_sink_shares(&sink, &shares));
    watch.fail_at = watch.allocations + n;
    celspan_status status = shares.open_worker(shares.user, context, &worker);
    CHECK((status == CELSPAN_OK) == (n > 2));
    if (status == CELSPAN_OK) {
      celspan_span span = single(0, 9, (const float[4]){0.2003f, 0.4007f, 0.1f, 0.7f});
      unsigned char wanted[9][4];
      CHECK(shares.row(shares.user, worker, context, 1, &span, 1) == CELSPAN_OK);
      celspan_spans_code_at(&coding, 5, 8, &span, 1, wanted);
      CHECK(memcmp(wanted, pixels[1], sizeof wanted) == 0 && pixels[0][0][0] == 0);
    }
    shares.close_worker(shares.user, context, worker);
    CHECK(sink.end(sink.user, context, status) == status);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0);
  }
}

int main(void) {
  test_mean();
  test_exact();
  test_place();
  test_frames();
  for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best() && !check_is_for_threads(); isa++) {
    test_borders(isa);
    test_rows(isa);
  }
  test_failing_allocations();
  test_shares(CELSPAN_ALPHA_STRAIGHT);
  test_shares(CELSPAN_ALPHA_PREMULTIPLIED);
  return check_done();
}
