/* Trackers on sequences whose motion is known: a patterned card in front of a patterned background,
 * rotated, scaled and bent, under changing light, in fog, with noise, and partly or wholly covered.
 */
#include <stdlib.h>

#include "celspan/celspan.h"
#include "celspan/track.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"
#include "tools/track/grey.h"

enum { WIDTH = 320, HEIGHT = 240, COUNT = WIDTH * HEIGHT };

static const celspan_box card = {-70, -50, 140, 100}; /* in its own coordinates */

/* ---------------------------------------------------------------- what is seen */

static double hashed(int x, int y, uint32_t seed) {
  uint32_t h = (uint32_t)x * 0x8da6b343u ^ (uint32_t)y * 0xd8163841u ^ seed * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return (double)((h ^ (h >> 15)) >> 8) * 0x1p-24;
}

/* Random numbers at whole coordinates, interpolated smoothly: 0..1. */
static double smooth(double x, double y, uint32_t seed) {
  int i = (int)floor(x), k = (int)floor(y);
  double u = x - i, v = y - k;
  u = u * u * u * (u * (6 * u - 15) + 10);
  v = v * v * v * (v * (6 * v - 15) + 10);
  double above = hashed(i, k, seed) * (1 - u) + hashed(i + 1, k, seed) * u;
  double below = hashed(i, k + 1, seed) * (1 - u) + hashed(i + 1, k + 1, seed) * u;
  return above * (1 - v) + below * v;
}

static double pattern(double x, double y, uint32_t seed) {
  return 0.15 + 0.4 * smooth(x / 7, y / 7, seed) + 0.35 * smooth(x / 17, y / 17, seed + 1);
}

typedef struct sequence {
  celspan_motion model;
  double noise; /* the greatest error of a pixel */
  double light; /* how much the card's light changes */
  int covered_from, covered_to;
  double covered_share; /* of the card, from its left */
  double fog;           /* the greatest share of white over the frame */
} sequence;

/* The position of the card in frame i. */
static celspan_matrix pose(const sequence *s, int i) {
  double t = i / 10.0, x = 160 + 30 * sin(t), y = 120 + 18 * sin(1.3 * t);
  celspan_matrix placed = celspan_matrix_translation(x, y);
  if (s->model == CELSPAN_MOTION_TRANSLATION)
    return placed;
  double scale = 1 + 0.15 * sin(0.7 * t);
  celspan_matrix turned =
      celspan_matrix_then(celspan_matrix_rotation(0.4 * sin(0.8 * t), (celspan_point){0, 0}),
                          celspan_matrix_scaling(scale, scale));
  if (s->model == CELSPAN_MOTION_SIMILARITY)
    return celspan_matrix_then(turned, placed);
  celspan_matrix bent = {
      {1, 0.1 * sin(t), 0, 0, 1, 0, 6e-4 * sin(0.9 * t), 8e-4 * sin(0.6 * t), 1}};
  return celspan_matrix_then(celspan_matrix_then(bent, turned), placed);
}

static celspan_point moved(celspan_matrix matrix, double x, double y) {
  const double *m = matrix.m;
  double w = m[6] * x + m[7] * y + m[8];
  return (celspan_point){(m[0] * x + m[1] * y + m[2]) / w, (m[3] * x + m[4] * y + m[5]) / w};
}

static double value_at(const sequence *s, int i, celspan_point at, double x, double y) {
  bool is_card =
      at.x >= card.x && at.x < card.x + card.width && at.y >= card.y && at.y < card.y + card.height;
  bool is_covered = i >= s->covered_from && i < s->covered_to &&
                    at.x < card.x + s->covered_share * card.width && is_card;
  if (is_covered)
    return pattern(x + 5 * i, y - 3 * i, 77);
  double light = 1 + s->light * sin(i / 6.0);
  return is_card ? light * pattern(at.x, at.y, 5) : pattern(x, y, 40);
}

static void draw_frame(const sequence *s, int i, float *out) {
  celspan_matrix back;
  test_random random = {(uint64_t)i + 1};
  CHECK(celspan_matrix_inverse(pose(s, i), &back));
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++) {
      double value = value_at(s, i, moved(back, x, y), x, y), fog = s->fog * fabs(sin(i / 4.0));
      value += fog * (0.95 - value);
      out[y * WIDTH + x] = (float)(value + random_between(&random, -s->noise, s->noise));
    }
}

/* ---------------------------------------------------------------- following it */

static celspan_tracker *start(celspan_context *context, const sequence *s, float *values) {
  celspan_matrix first = pose(s, 0);
  celspan_tracker_desc desc = {.struct_size = sizeof desc,
                               .model = s->model,
                               .region = {first.m[2] - 68, first.m[5] - 48, 136, 96}};
  celspan_tracker *tracker = NULL;
  draw_frame(s, 0, values);
  CHECK(celspan_tracker_create(context, &(celspan_luma){WIDTH, HEIGHT, values}, &desc, &tracker) ==
        CELSPAN_OK);
  return tracker;
}

/* The squared errors of five places of the card. */
static double squares_of(const sequence *s, int i, celspan_matrix found) {
  static const double places[5][2] = {{-60, -40}, {60, -40}, {60, 40}, {-60, 40}, {0, 0}};
  double sum = 0;
  for (int k = 0; k < 5; k++) {
    celspan_point first = moved(pose(s, 0), places[k][0], places[k][1]);
    celspan_point is = moved(pose(s, i), places[k][0], places[k][1]);
    celspan_point said = moved(found, first.x, first.y);
    sum += (said.x - is.x) * (said.x - is.x) + (said.y - is.y) * (said.y - is.y);
  }
  return sum;
}

/* Follows `frames` frames: within 0.1 pixel, and lost only where all is covered. */
static void follow_sequence(celspan_context *context, const char *name, sequence s, int frames) {
  float *values = malloc(COUNT * sizeof *values);
  celspan_tracker *tracker = start(context, &s, values);
  double squares = 0;
  int found = 0, lost = 0, wrong = 0;
  for (int i = 1; tracker && i < frames; i++) {
    celspan_sighting sighting = CELSPAN_SIGHTING;
    draw_frame(&s, i, values);
    CHECK(celspan_tracker_follow(tracker, &(celspan_luma){WIDTH, HEIGHT, values}, &sighting) ==
          CELSPAN_OK);
    bool is_hidden = i >= s.covered_from && i < s.covered_to && s.covered_share == 1;
    lost += !sighting.is_found;
    wrong += sighting.is_found == is_hidden;
    if (!sighting.is_found)
      continue;
    found++;
    squares += squares_of(&s, i, sighting.matrix);
  }
  double rms = sqrt(squares / (5.0 * (found ? found : 1)));
  printf("track: %s: %.4f pixels rms over %d frames, %d lost\n", name, rms, found, lost);
  CHECK(rms < 0.1);
  CHECK(wrong == 0);
  celspan_tracker_destroy(tracker);
  free(values);
}

static void known_motion_is_found(celspan_context *context) {
  static const struct {
    const char *name;
    int frames;
    sequence sequence;
  } known[] = {
      {"translation", 20, {.model = CELSPAN_MOTION_TRANSLATION}},
      {"turned and scaled", 20, {.model = CELSPAN_MOTION_SIMILARITY}},
      {"in perspective", 20, {.model = CELSPAN_MOTION_PERSPECTIVE}},
      {"in perspective, noise and light", 100, {CELSPAN_MOTION_PERSPECTIVE, 0.03, 0.3, 0, 0, 0, 0}},
      {"turned and scaled, noise and light, half covered",
       100,
       {CELSPAN_MOTION_SIMILARITY, 0.04, 0.3, 20, 60, 0.5, 0}},
      {"in perspective, a third covered",
       20,
       {CELSPAN_MOTION_PERSPECTIVE, 0.01, 0.1, 5, 15, 0.33, 0}},
      {"in perspective, wholly covered",
       100,
       {CELSPAN_MOTION_PERSPECTIVE, 0.02, 0.2, 40, 50, 1, 0}},
      {"in fog", 20, {.model = CELSPAN_MOTION_SIMILARITY, .fog = 0.7}},
  };
  for (int i = 0; i < (int)(sizeof known / sizeof *known); i++)
    if (check_is_drawn(i))
      follow_sequence(context, known[i].name, known[i].sequence, known[i].frames);
}

/* A card that leaps twice as far as pixels are searched is found on smaller levels. */
static void a_leap_is_followed(celspan_context *context) {
  float *values = malloc(COUNT * sizeof *values);
  sequence s = {.model = CELSPAN_MOTION_TRANSLATION};
  celspan_tracker *tracker = start(context, &s, values);
  celspan_sighting sighting = CELSPAN_SIGHTING;
  draw_frame(&s, 15, values); /* 30 pixels to the right, and 17 down */
  CHECK(celspan_tracker_follow(tracker, &(celspan_luma){WIDTH, HEIGHT, values}, &sighting) ==
            CELSPAN_OK &&
        sighting.is_found);
  CHECK(squares_of(&s, 15, sighting.matrix) < 5 * 0.1 * 0.1);
  celspan_tracker_destroy(tracker);
  free(values);
}

/* A ramp is the same ramp on every level, or what is found on one would be off on the next. */
static void levels_lie_over_each_other(celspan_context *context) {
  enum { SIDE = 64, COUNT_OF_LEVELS = 3 };
  float values[SIDE * SIDE];
  cs_grey_levels made;
  for (int i = 0; i < SIDE * SIDE; i++)
    values[i] = (float)(i % SIDE + 3 * (i / SIDE));
  if (!CHECK(cs_grey_levels_make(context, values, SIDE, SIDE, CS_GREY_LEVELS, &made) == CELSPAN_OK))
    return;
  CHECK(made.count == COUNT_OF_LEVELS); /* the last is of 16 pixels */
  for (int level = 0; level < made.count; level++) {
    const cs_grey *plane = &made.levels[level];
    CHECK(plane->width == SIDE >> level && plane->height == SIDE >> level);
    for (int y = 1; y + 1 < plane->height; y++)
      for (int x = 1; x + 1 < plane->width; x++)
        CHECK_NEAR((double)plane->values[y * plane->width + x],
                   cs_grey_up(x, level) + 3 * cs_grey_up(y, level), level == 2 ? 1e-3 : 1e-5);
  }
  cs_grey_levels_finish(&made);
}

/* The lesser eigenvalue of the slopes around a pixel. */
static double strength_at(const cs_grey *plane, int x, int y) {
  double xx = 0, xy = 0, yy = 0;
  for (int i = 0; i < 49; i++) {
    const float *at = plane->values + (y + i / 7 - 3) * WIDTH + x + i % 7 - 3;
    double slope_x = (double)(at[1] - at[-1]) / 2, slope_y = (double)(at[WIDTH] - at[-WIDTH]) / 2;
    xx += slope_x * slope_x;
    xy += slope_x * slope_y;
    yy += slope_y * slope_y;
  }
  return (xx + yy) / 2 - sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
}

/* A corner is where its neighbours in the region hold on no better, at the rim of it too. */
static void corners_are_the_strongest_around(celspan_context *context) {
  float *values = malloc(COUNT * sizeof *values);
  const cs_grey plane = {WIDTH, 80, values};
  celspan_point corners[CS_FEATURES_MOST];
  for (int i = 0; i < 40; i++) {
    const cs_features_region region = {10, 10, 50 + 3 * i, 60, NULL};
    size_t count;
    for (int k = 0; k < WIDTH * 80; k++)
      values[k] = (float)pattern(k % WIDTH, k / WIDTH, 200 + (uint32_t)i);
    CHECK(cs_features_find(context, &plane, &region, corners, &count) == CELSPAN_OK && count > 5);
    for (size_t k = 0; k < count * 9; k++) {
      int x = (int)corners[k / 9].x, y = (int)corners[k / 9].y;
      int u = x + (int)(k % 3) - 1, v = y + (int)(k / 3 % 3) - 1;
      if (u >= region.x0 && u < region.x1 && v >= region.y0 && v < region.y1)
        CHECK(strength_at(&plane, u, v) <= strength_at(&plane, x, y) * 1.0001);
    }
  }
  free(values);
}

static void another_scene_is_no_sighting(celspan_context *context) {
  float *values = malloc(COUNT * sizeof *values);
  sequence s = {.model = CELSPAN_MOTION_PERSPECTIVE};
  celspan_tracker *tracker = start(context, &s, values);
  for (uint32_t seed = 100; seed < 110; seed++) {
    celspan_sighting sighting = CELSPAN_SIGHTING;
    for (int i = 0; i < COUNT; i++)
      values[i] = (float)pattern(i % WIDTH, i / WIDTH, seed);
    CHECK(celspan_tracker_follow(tracker, &(celspan_luma){WIDTH, HEIGHT, values}, &sighting) ==
              CELSPAN_OK &&
          !sighting.is_found && sighting.corner_count > 50);
  }
  celspan_tracker_destroy(tracker);
  free(values);
}

static void a_mask_leaves_out_what_it_does_not_cover(celspan_context *context) {
  float *values = malloc(COUNT * sizeof *values);
  uint8_t *mask = calloc(COUNT, 1);
  sequence s = {.model = CELSPAN_MOTION_SIMILARITY};
  celspan_tracker_desc desc = {sizeof desc, s.model, {0, 0, WIDTH, HEIGHT}, mask};
  celspan_matrix back;
  draw_frame(&s, 0, values);
  CHECK(celspan_matrix_inverse(pose(&s, 0), &back));
  for (int i = 0; i < COUNT; i++) {
    celspan_point at = moved(back, i % WIDTH, i / WIDTH);
    mask[i] = fabs(at.x) < 55 && fabs(at.y) < 35;
  }
  celspan_luma luma = {WIDTH, HEIGHT, values};
  celspan_tracker *tracker = NULL;
  celspan_sighting sighting = CELSPAN_SIGHTING;
  CHECK(celspan_tracker_create(context, &luma, &desc, &tracker) == CELSPAN_OK);
  draw_frame(&s, 3, values); /* most of the whole frame does not move */
  CHECK(celspan_tracker_follow(tracker, &luma, &sighting) == CELSPAN_OK && sighting.is_found);
  CHECK(squares_of(&s, 3, sighting.matrix) < 5 * 0.1 * 0.1);
  celspan_tracker_destroy(tracker);
  free(mask);
  free(values);
}

static void a_rewound_tracker_goes_the_other_way(celspan_context *context) {
  float *values = malloc(COUNT * sizeof *values);
  sequence s = {.model = CELSPAN_MOTION_SIMILARITY};
  celspan_tracker *tracker = start(context, &s, values);
  for (int way = 1; way >= -1; way -= 2) {
    for (int i = 1; i < 12; i++) {
      celspan_sighting sighting = CELSPAN_SIGHTING;
      draw_frame(&s, way * i, values);
      CHECK(celspan_tracker_follow(tracker, &(celspan_luma){WIDTH, HEIGHT, values}, &sighting) ==
                CELSPAN_OK &&
            sighting.is_found);
      CHECK(squares_of(&s, way * i, sighting.matrix) < 5 * 0.1 * 0.1);
    }
    celspan_tracker_rewind(tracker);
  }
  celspan_tracker_destroy(tracker);
  free(values);
}

/* ---------------------------------------------------------------- wrong arguments, no memory */

static void check_refused(celspan_context *context, celspan_luma luma, celspan_tracker_desc desc,
                          const char *message) {
  celspan_tracker *tracker = NULL;
  CHECK(celspan_tracker_create(context, &luma, &desc, &tracker) == CELSPAN_BAD_ARGUMENT);
  CHECK(!tracker);
  if (!CHECK(strstr(celspan_context_error(context), message)))
    fprintf(stderr, "it says: %s\n", celspan_context_error(context));
}

static void wrong_arguments_are_refused(celspan_context *context) {
  float *values = malloc(COUNT * sizeof *values);
  sequence s = {.model = CELSPAN_MOTION_SIMILARITY};
  celspan_tracker *tracker = start(context, &s, values);
  celspan_luma luma = {WIDTH, HEIGHT, values};
  celspan_tracker_desc desc = {sizeof desc, s.model, {80, 60, 160, 120}, NULL};
  celspan_sighting sighting = CELSPAN_SIGHTING;
  check_refused(context, luma,
                (celspan_tracker_desc){sizeof(celspan_tracker_desc), s.model, {5, 5, 10, 30}, NULL},
                "10 x 30");
  check_refused(
      context, luma,
      (celspan_tracker_desc){sizeof(celspan_tracker_desc), s.model, {900, 5, 30, 30}, NULL},
      "of the region 0 x 30 pixels");
  check_refused(
      context, luma,
      (celspan_tracker_desc){sizeof(celspan_tracker_desc), s.model, {5, 5, NAN, 30}, NULL},
      "nan x 30");
  check_refused(
      context, luma,
      (celspan_tracker_desc){sizeof(celspan_tracker_desc), s.model, {NAN, 5, 30, 30}, NULL},
      "finite");
  check_refused(
      context, luma,
      (celspan_tracker_desc){sizeof(celspan_tracker_desc), (celspan_motion)7, {5, 5, 50, 50}, NULL},
      "model 7");
  check_refused(context, (celspan_luma){0, HEIGHT, values}, desc, "1 to 65536");
  check_refused(context, (celspan_luma){WIDTH, HEIGHT, NULL}, desc, "values");
  values[1000] = NAN;
  check_refused(context, luma, desc, "pixel 1000");
  CHECK(celspan_tracker_follow(tracker, &luma, &sighting) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_tracker_follow(tracker, &(celspan_luma){WIDTH, 100, values + WIDTH * 10},
                               &sighting) == CELSPAN_BAD_ARGUMENT &&
        strstr(celspan_context_error(context), "320 x 100"));
  values[1000] = 0;
  sighting.struct_size = 0;
  CHECK(celspan_tracker_follow(tracker, &luma, &sighting) == CELSPAN_BAD_ARGUMENT &&
        strstr(celspan_context_error(context), "track: struct_size of the result is 0"));
  for (int i = 0; i < COUNT; i++)
    values[i] = 0.5F;
  check_refused(context, luma, desc, "0 corners were found, and 4 are needed");
  celspan_tracker_destroy(tracker);
  celspan_tracker_destroy(NULL);
  free(values);
}

static celspan_status create_and_follow(celspan_context *context, const float *values) {
  celspan_luma luma = {WIDTH, HEIGHT, values};
  celspan_tracker_desc desc = {sizeof desc, CELSPAN_MOTION_SIMILARITY, {92, 72, 136, 96}, NULL};
  celspan_tracker *tracker;
  celspan_sighting sighting = CELSPAN_SIGHTING;
  celspan_status status = celspan_tracker_create(context, &luma, &desc, &tracker);
  if (status == CELSPAN_OK)
    status = celspan_tracker_follow(tracker, &luma, &sighting);
  celspan_tracker_destroy(tracker);
  return status;
}

static void every_allocation_may_fail(void) {
  float *values = malloc(COUNT * sizeof *values);
  sequence s = {.model = CELSPAN_MOTION_SIMILARITY};
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  celspan_status status = CELSPAN_NO_MEMORY;
  size_t blocks = watch.blocks, fail_at = 0;
  draw_frame(&s, 0, values);
  while (status == CELSPAN_NO_MEMORY && fail_at < 1000) {
    if (!check_is_drawn((int)++fail_at))
      continue;
    watch.fail_at = watch.allocations + fail_at;
    status = create_and_follow(context, values);
    CHECK(watch.blocks == blocks);
  }
  CHECK(status == CELSPAN_OK && fail_at > 8);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  free(values);
}

int main(void) {
  celspan_context *context;
  if (!CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK))
    return check_done();
  known_motion_is_found(context);
  a_leap_is_followed(context);
  levels_lie_over_each_other(context);
  corners_are_the_strongest_around(context);
  another_scene_is_no_sighting(context);
  a_mask_leaves_out_what_it_does_not_cover(context);
  a_rewound_tracker_goes_the_other_way(context);
  wrong_arguments_are_refused(context);
  celspan_context_destroy(context);
  every_allocation_may_fail();
  return check_done();
}
