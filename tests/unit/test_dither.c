/* Dithering: means are preserved, exact numbers are not changed, and a pixel depends only on its
 * colour and place.
 */
#include "output/sinks/dither.h"

#include "celspan/celspan.h"
#include "output/sinks/pixels.h"
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
    celspan_status status = cs_dither_sink(context, &coding, &plain, 0, 0, &sink);
    CHECK((status == CELSPAN_OK) == (n > 1));
    if (status == CELSPAN_OK) {
      CHECK(sink.begin(sink.user, context, 10, 10) == CELSPAN_NO_MEMORY);
      (void)sink.end(sink.user, context, CELSPAN_NO_MEMORY);
    }
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0);
  }
}

int main(void) {
  test_mean();
  test_exact();
  test_place();
  test_frames();
  test_failing_allocations();
  return check_done();
}
