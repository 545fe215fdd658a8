/* Frames through the public interface: the same bits whatever the number of workers, the height of
 * strips, the order of rows, and the sink; failures of sinks and callbacks are passed on.
 */
#include <stdlib.h>

#include "tests/support/random.h"
#include "tests/support/scene.h"

#define WIDTH 97
#define HEIGHT 71
#define PIXEL_COUNT (WIDTH * HEIGHT)

static const celspan_coding float_coding = {.struct_size = sizeof float_coding,
                                            .depth = CELSPAN_DEPTH_FLOAT,
                                            .transfer = CELSPAN_TRANSFER_LINEAR,
                                            .alpha = CELSPAN_ALPHA_PREMULTIPLIED};

/* ---------------------------------------------------------------- a scene */

static celspan_texture *random_texture(studio *s, test_random *random) {
  float rgb[3];
  for (int c = 0; c < 3; c++)
    rgb[c] = (float)random_between(random, 0, 1);
  celspan_paint paint =
      celspan_paint_rgb(rgb[0], rgb[1], rgb[2], (float)random_between(random, 0.2, 1));
  if (random_below(random, 2))
    return studio_paint(s, paint);
  celspan_stop stops[2] = {{0, paint}, {1, celspan_paint_gel(0.5f, 1, 0.25f)}};
  return studio_linear(s, (celspan_point){10, 5}, (celspan_point){80, 60}, stops, 2);
}

static celspan_object *random_shape(studio *s, test_random *random) {
  celspan_texture *texture = random_texture(s, random);
  if (random_below(random, 3) == 0) {
    celspan_point centre = random_point(random, 0, WIDTH, 0, HEIGHT);
    return studio_circle(s, centre.x, centre.y, random_between(random, 1, 40), texture);
  }
  celspan_point points[7];
  for (int i = 0; i < 7; i++)
    points[i] = random_point(random, -20, WIDTH + 20, -20, HEIGHT + 20);
  return studio_polygon(s, points, 7, CELSPAN_RULE_EVENODD, texture);
}

/* Two cels of polygons, circles and booleans of them, one of them in perspective. */
static celspan_rostrum *random_rostrum(studio *s, uint64_t seed) {
  test_random random = {seed};
  celspan_cel *cels[2];
  for (int c = 0; c < 2; c++) {
    celspan_object *objects[12];
    for (int i = 0; i < 12; i++)
      objects[i] = random_shape(s, &random);
    for (int i = 0; i < 12; i += 3) {
      celspan_operator kind = (celspan_operator)random_below(&random, 5);
      objects[i] = studio_pair(s, kind, objects[i], random_shape(s, &random));
    }
    celspan_matrix tilt = {{1, 0.1, 0, 0, 1, 0, 0.002, 0.003, 1}};
    objects[11] = studio_transform(s, objects[11], tilt);
    celspan_cel_desc desc = CELSPAN_CEL_DESC;
    desc.back = (celspan_light){0.25f, 0, 0.125f, 0.5f};
    cels[c] = studio_cel(s, desc, objects, 12);
  }
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, cels, 2);
}

static celspan_frame_desc frame_of(const celspan_exposure *exposure,
                                   const celspan_antialias_mode *antialias) {
  celspan_frame_desc desc = studio_frame(exposure, 1, WIDTH, HEIGHT, antialias);
  desc.workers = 1;
  return desc;
}

/* ---------------------------------------------------------------- workers and strips */

static void pixels_of(studio *s, const celspan_frame_desc *desc, float *pixels) {
  studio_check(s, celspan_frame_pixels(s->context, desc, &float_coding, pixels,
                                       WIDTH * 4 * sizeof(float), NULL));
}

static void check_strips(studio *s, celspan_frame_desc desc) {
  static const int workers[] = {1, 2, 3, 7}, strips[] = {1, 5, 64};
  size_t size = PIXEL_COUNT * 4 * sizeof(float);
  float *expected = malloc(size), *pixels = malloc(size);
  pixels_of(s, &desc, expected);
  uint64_t digest[2], other[2];
  studio_check(s, celspan_frame_digest(s->context, &desc, NULL, digest));
  for (size_t w = 0; w < 4; w++)
    for (size_t h = 0; h < 3; h++) {
      desc.workers = workers[w];
      desc.strip_rows = strips[h];
      memset(pixels, 0, size);
      pixels_of(s, &desc, pixels);
      CHECK(memcmp(expected, pixels, size) == 0);
      studio_check(s, celspan_frame_digest(s->context, &desc, NULL, other));
      CHECK(digest[0] == other[0] && digest[1] == other[1]);
    }
  free(expected);
  free(pixels);
}

/* ---------------------------------------------------------------- rows on demand */

static bool row_matches(celspan_rows *rows, int32_t y, const float *expected) {
  const celspan_span *spans;
  size_t count;
  if (celspan_rows_get(rows, y, &spans, &count) != CELSPAN_OK)
    return false;
  int32_t x = 0;
  for (size_t i = 0; i < count; i++)
    for (; x < spans[i].x1; x++) {
      float rgba[4];
      celspan_span_colour(&spans[i], x, rgba);
      for (int c = 0; c < 4; c++)
        if (fabsf(rgba[c] - expected[4 * x + c]) > 1e-6f)
          return false;
    }
  return x == WIDTH;
}

static void check_row_order(studio *s, const celspan_frame_desc *desc, test_random *random) {
  float *expected = malloc(PIXEL_COUNT * 4 * sizeof(float));
  pixels_of(s, desc, expected);
  celspan_rows *rows = NULL;
  studio_check(s, celspan_rows_create(s->context, desc, &rows));
  int wrong = 0;
  for (int i = 0; rows && i < 3 * HEIGHT; i++) {
    int32_t y = random_below(random, HEIGHT);
    wrong += !row_matches(rows, y, expected + (size_t)y * WIDTH * 4);
  }
  for (int32_t y = HEIGHT; rows && y-- > 0;)
    wrong += !row_matches(rows, y, expected + (size_t)y * WIDTH * 4);
  CHECK(wrong == 0);
  const celspan_span *spans;
  size_t count;
  CHECK(rows && celspan_rows_get(rows, HEIGHT, &spans, &count) == CELSPAN_BAD_ARGUMENT);
  CHECK(rows && celspan_rows_get(rows, -1, &spans, &count) == CELSPAN_BAD_ARGUMENT);
  celspan_rows_destroy(rows);
  free(expected);
}

static void check_scenes(studio *s) {
  static const celspan_antialias_mode modes[] = {CELSPAN_ANTIALIAS_AREA, CELSPAN_ANTIALIAS_NONE};
  test_random random = {99};
  for (uint64_t seed = 1; seed <= 6; seed++) {
    if (!check_is_drawn((int)seed))
      continue;
    celspan_exposure exposure = {random_rostrum(s, seed), 1};
    for (int m = 0; m < 2; m++) {
      celspan_frame_desc desc = frame_of(&exposure, &modes[m]);
      check_strips(s, desc);
      check_row_order(s, &desc, &random);
    }
  }
}

/* ---------------------------------------------------------------- sinks */

typedef struct tally {
  int32_t next, begins, ends, rows;
  int32_t fail_at; /* the row that fails, -1: none */
  bool is_tiled;
  celspan_status outcome;
} tally;

static celspan_status tally_begin(void *user, celspan_context *context, int32_t width,
                                  int32_t height) {
  tally *t = user;
  (void)context;
  t->begins++;
  t->is_tiled = width == WIDTH && height == HEIGHT;
  return CELSPAN_OK;
}

static celspan_status tally_row(void *user, celspan_context *context, int32_t y,
                                const celspan_span *spans, size_t span_count) {
  tally *t = user;
  int32_t at = 0;
  t->is_tiled &= y == t->next++;
  for (size_t i = 0; i < span_count; i++) {
    t->is_tiled &= spans[i].x0 == at && spans[i].x1 > at;
    at = spans[i].x1;
  }
  t->is_tiled &= at == WIDTH;
  t->rows++;
  if (y == t->fail_at)
    return celspan_context_fail(context, CELSPAN_OUTPUT, "row %d is too heavy", (int)y);
  return CELSPAN_OK;
}

static celspan_status tally_end(void *user, celspan_context *context, celspan_status outcome) {
  tally *t = user;
  (void)context;
  t->ends++;
  t->outcome = outcome;
  return outcome;
}

static void check_sinks(studio *s) {
  celspan_exposure exposure = {random_rostrum(s, 17), 1};
  celspan_frame_desc desc = frame_of(&exposure, NULL);
  for (desc.workers = 1; desc.workers <= 4; desc.workers++) {
    tally whole = {.fail_at = -1, .outcome = CELSPAN_INTERNAL}, failed = {.fail_at = 30};
    celspan_sink sink = {sizeof sink, &whole, tally_begin, tally_row, tally_end, false};
    celspan_statistics statistics = CELSPAN_STATISTICS;
    studio_check(s, celspan_frame_render(s->context, &desc, &sink, &statistics));
    CHECK(whole.begins == 1 && whole.ends == 1 && whole.rows == HEIGHT && whole.is_tiled);
    CHECK(whole.outcome == CELSPAN_OK && statistics.rows == HEIGHT);
    CHECK(statistics.spans == statistics.single + statistics.gradient + statistics.array);
    sink.user = &failed;
    CHECK(celspan_frame_render(s->context, &desc, &sink, NULL) == CELSPAN_OUTPUT);
    CHECK_TEXT(celspan_context_error(s->context), "row 30 is too heavy");
    CHECK(failed.rows == 31 && failed.ends == 1 && failed.outcome == CELSPAN_OUTPUT);
  }
}

/* A hidden corner comes down to the foot of its row on a visible vertical side that lies on a
 * pixel's edge: at `x` it crosses no column, in particular not the one right of the frame. */
static void check_touching_corner(studio *s, double x) {
  celspan_texture *ground = studio_paint(s, celspan_paint_rgb(1, 1, 1, 1));
  celspan_texture *shape = studio_paint(s, celspan_paint_rgb(0.3f, 0.7f, 0.1f, 1));
  const celspan_point corner[3] = {{x - 1, 5.5}, {x, 6}, {x - 1, 8}};
  celspan_object *objects[3] = {studio_rect(s, -5, 0, WIDTH + 10, HEIGHT, ground),
                                studio_rect(s, 5, 0, x - 5, HEIGHT, shape),
                                studio_polygon(s, corner, 3, CELSPAN_RULE_EVENODD, shape)};
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, objects, 3);
  celspan_exposure exposure = {studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1), 1};
  celspan_frame_desc desc = frame_of(&exposure, NULL);
  tally t = {.fail_at = -1};
  const celspan_sink sink = {sizeof sink, &t, tally_begin, tally_row, tally_end, false};
  studio_check(s, celspan_frame_render(s->context, &desc, &sink, NULL));
  CHECK(t.is_tiled);
}

static bool stop_soon(void *user, int32_t rows_done, int32_t rows_total) {
  *(int32_t *)user = rows_done;
  return rows_done < rows_total / 2;
}

static void check_cancel(studio *s) {
  celspan_exposure exposure = {random_rostrum(s, 18), 1};
  celspan_frame_desc desc = frame_of(&exposure, NULL);
  int32_t reached = 0;
  desc.progress = stop_soon;
  desc.progress_user = &reached;
  desc.strip_rows = 4;
  for (desc.workers = 1; desc.workers <= 3; desc.workers++) {
    tally t = {.fail_at = -1};
    celspan_sink sink = {sizeof sink, &t, tally_begin, tally_row, tally_end, false};
    CHECK(celspan_frame_render(s->context, &desc, &sink, NULL) == CELSPAN_CANCELLED);
    CHECK(reached >= HEIGHT / 2 && reached < HEIGHT && t.rows < HEIGHT);
    CHECK(t.ends == 1 && t.outcome == CELSPAN_CANCELLED);
  }
}

static bool stop_third(void *user, int32_t rows_done, int32_t rows_total) {
  (void)rows_done, (void)rows_total;
  return ++*(int *)user < 3;
}

/* Workers that fill shares of the sink stop in the middle of them. */
static void check_cancel_shares(studio *s) {
  celspan_exposure exposure = {random_rostrum(s, 18), 1};
  celspan_frame_desc desc = frame_of(&exposure, NULL);
  const celspan_sink nowhere = {.struct_size = sizeof nowhere, .row = NULL};
  desc.height = 5000;
  desc.progress = stop_third;
  for (desc.workers = 2; desc.workers <= 4; desc.workers++) {
    int calls = 0;
    desc.progress_user = &calls;
    CHECK(celspan_frame_pixels(s->context, &desc, NULL, NULL, 0, NULL) == CELSPAN_CANCELLED);
    CHECK(calls == 3 && strncmp(celspan_context_error(s->context), "stopped after ", 14) == 0);
    calls = 0;
    CHECK(celspan_frame_render(s->context, &desc, &nowhere, NULL) == CELSPAN_CANCELLED);
    calls = -1000000;
    celspan_statistics statistics = CELSPAN_STATISTICS;
    studio_check(s, celspan_frame_render(s->context, &desc, &nowhere, &statistics));
    CHECK(statistics.rows == 5000 && statistics.spans > 5000);
  }
}

/* ---------------------------------------------------------------- refusals */

static void check_refusals(studio *s) {
  celspan_exposure exposure = {random_rostrum(s, 19), 1};
  celspan_frame_desc desc = frame_of(&exposure, NULL);
  uint64_t digest[2];
  celspan_frame_desc bad = desc;
  bad.width = 0;
  CHECK(celspan_frame_digest(s->context, &bad, NULL, digest) == CELSPAN_LIMIT);
  bad.width = 1048577;
  CHECK(celspan_frame_digest(s->context, &bad, NULL, digest) == CELSPAN_LIMIT);
  bad = desc;
  bad.crop_x = bad.width, bad.crop_width = 8, bad.crop_height = 1;
  CHECK(celspan_frame_digest(s->context, &bad, NULL, digest) == CELSPAN_BAD_ARGUMENT);
  bad = desc;
  bad.struct_size = 8;
  CHECK(celspan_frame_digest(s->context, &bad, NULL, digest) == CELSPAN_BAD_ARGUMENT);
  exposure.weight = -1;
  CHECK(celspan_frame_digest(s->context, &desc, NULL, digest) == CELSPAN_BAD_ARGUMENT);
  exposure.weight = 1;
  studio_check(s, celspan_frame_digest(s->context, &desc, NULL, digest));
}

/* A frame without exposures is clear. */
static void check_nothing(studio *s) {
  celspan_frame_desc desc = frame_of(NULL, NULL);
  float *pixels = malloc(PIXEL_COUNT * 4 * sizeof(float));
  desc.exposure_count = 0;
  pixels[0] = 1;
  pixels_of(s, &desc, pixels);
  bool is_clear = true;
  for (size_t i = 0; i < (size_t)PIXEL_COUNT * 4; i++)
    is_clear &= pixels[i] == 0;
  CHECK(is_clear);
  free(pixels);
}

int main(void) {
  studio s = {0};
  if (celspan_context_create(NULL, &s.context) != CELSPAN_OK)
    return 1;
  size_t before, after, peak;
  uint64_t allocations;
  celspan_context_memory(s.context, &before, &peak, &allocations);
  check_scenes(&s);
  check_sinks(&s);
  check_touching_corner(&s, 60);
  check_touching_corner(&s, WIDTH);
  check_cancel(&s);
  check_cancel_shares(&s);
  check_refusals(&s);
  check_nothing(&s);
  studio_finish(&s);
  celspan_context_memory(s.context, &after, &peak, &allocations);
  CHECK(after == before && peak > before);
  celspan_context_destroy(s.context);
  return check_done();
}
