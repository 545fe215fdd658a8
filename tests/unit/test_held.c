/* frames/render/held.h: a frame of which bands are given out is the frame that would be made, by
 * any number of workers and with any memory, and bands are held where nothing has changed.
 */
#include "frames/render/held.h"

#include "base/thread_pool.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

enum { WIDTH = 96, HEIGHT = 160, CELS = 6, SHAPES = 70, PIXELS = WIDTH * HEIGHT };

static celspan_context *context_of(memory_watch *watch, size_t bytes) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = watch;
  desc.defocus_bytes = bytes;
  celspan_context *context = NULL;
  CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK);
  return context;
}

/* ---------------------------------------------------------------- frames */

/* What one frame is made of. A change acts on it by number. */
typedef struct shot {
  celspan_rostrum_desc rostrum;
  celspan_cel_desc cels[CELS];
  celspan_object *objects[CELS][SHAPES];
  size_t shapes[CELS];
  celspan_frame_desc frame;
  celspan_filter_desc filter;
  celspan_exposure exposures[2];
  celspan_depth depth;
} shot;

static celspan_rostrum *rostrum_of(studio *s, const shot *from) {
  celspan_cel *cels[CELS];
  for (size_t i = 0; i < CELS; i++)
    cels[i] = studio_cel(s, from->cels[i], from->objects[i], from->shapes[i]);
  return studio_rostrum(s, from->rostrum, cels, CELS);
}

/* The pixels of a frame, and how many of its rows were held. */
static uint64_t draw(studio *s, shot *from, int workers, float *pixels) {
  celspan_statistics statistics = CELSPAN_STATISTICS;
  celspan_coding coding = CELSPAN_CODING;
  coding.depth = from->depth;
  celspan_frame_desc *desc = &from->frame;
  int32_t width = desc->crop_width ? desc->crop_width : desc->width;
  from->exposures[0].rostrum = rostrum_of(s, from);
  desc->exposures = from->exposures;
  desc->filter = &from->filter;
  desc->workers = workers;
  desc->repeats = true;
  size_t stride = (size_t)width * (from->depth == CELSPAN_DEPTH_8 ? 4 : 16);
  studio_check(s, celspan_frame_pixels(s->context, desc, &coding, pixels, stride, &statistics));
  return statistics.rows_held;
}

/* The same frame with memory and without. */
static uint64_t compare(studio *s, studio *bare, shot *from, int workers) {
  static float held[8 * PIXELS], made[8 * PIXELS];
  memset(held, 0, sizeof held);
  memset(made, 0, sizeof made);
  uint64_t rows = draw(s, from, workers, held);
  CHECK(draw(bare, from, 1, made) == 0);
  CHECK(memcmp(held, made, sizeof held) == 0);
  return rows;
}

static shot begin_shot(void) {
  shot made = {.rostrum = CELSPAN_ROSTRUM_DESC,
               .frame = CELSPAN_FRAME_DESC,
               .filter = CELSPAN_FILTER_DESC,
               .exposures[0].weight = 1,
               .depth = CELSPAN_DEPTH_FLOAT};
  made.frame.film_width = made.frame.width = WIDTH;
  made.frame.film_height = made.frame.height = HEIGHT;
  made.frame.exposure_count = 1;
  for (int i = 0; i < CELS; i++)
    made.cels[i] = CELSPAN_CEL_DESC;
  return made;
}

/* ---------------------------------------------------------------- random shapes */

static celspan_paint random_paint(test_random *random) {
  static const float alphas[] = {1, 1, 1, 0.6f};
  float r = random_unit(random), g = random_unit(random), b = random_unit(random);
  return celspan_paint_rgb(r, g, b, alphas[random_below(random, 4)]);
}

/* In the rows from `top`. */
static celspan_object *random_object(studio *s, test_random *random, double top, double height) {
  celspan_point a = random_point(random, 0, WIDTH, top, top + height);
  celspan_point b = random_point(random, 0, WIDTH, top, top + height);
  celspan_stop stops[2] = {{.at = 0}, {.at = 1}};
  stops[0].paint = random_paint(random);
  stops[1].paint = random_paint(random);
  celspan_texture *texture =
      random_below(random, 2) ? studio_paint(s, stops[0].paint) : studio_linear(s, a, b, stops, 2);
  double size = random_between(random, 2, height / 2);
  int kind = random_below(random, 3);
  if (kind == 0)
    return studio_circle(s, a.x, a.y, size, texture);
  if (kind == 1)
    return studio_rect(s, a.x - 30, a.y, 60, size, texture);
  celspan_object *whole = studio_circle(s, a.x, a.y, size, texture);
  return studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, whole,
                     studio_circle(s, b.x, b.y, size, texture));
}

static void fill(studio *s, test_random *random, shot *made, int cel, size_t shapes, double top,
                 double height) {
  made->shapes[cel] = shapes;
  for (size_t i = 0; i < shapes; i++)
    made->objects[cel][i] = random_object(s, random, top, height);
}

/* Plain, blurred, faded, with a mode, before a back light, under a front light. */
static void choose_kind(test_random *random, celspan_cel_desc *cel) {
  int which = random_below(random, 10);
  double share = random_between(random, 0, 1);
  if (which == 0)
    cel->defocus_radius = 6 * share;
  else if (which == 1)
    cel->opacity = share;
  else if (which == 2)
    cel->blend = CELSPAN_BLEND_MULTIPLY;
  else if (which == 3)
    cel->back = (celspan_light){0.2f, (float)share, 0, 0.5f};
  cel->has_front = which == 4;
  cel->front = (celspan_light){1, (float)share, 0.5f, 0};
}

/* ---------------------------------------------------------------- random films */

/* Cels that stay, and others that move in some rows. */
static void check_film(studio *s, studio *bare, uint64_t seed, uint64_t *rows) {
  enum { FRAMES = 6 };
  test_random random = {seed};
  shot film = begin_shot();
  const bool is_rich = seed % 3 == 0;
  celspan_matrix moves[CELS];
  celspan_object *still[CELS][SHAPES];
  for (int i = 0; i < CELS; i++) {
    double top = random_between(&random, 0, HEIGHT - 20);
    size_t count = is_rich && i < 2 ? SHAPES : 1 + (size_t)random_below(&random, 6);
    fill(s, &random, &film, i, count, i == 0 ? 0 : top, i == 0 ? HEIGHT : 20);
    choose_kind(&random, &film.cels[i]);
    double dx = random_between(&random, -3, 3), dy = random_between(&random, -1, 1);
    moves[i] = celspan_matrix_translation(dx, dy);
  }
  memcpy(still, film.objects, sizeof still);
  film.frame.has_antialias = seed % 5 == 1;
  film.frame.antialias = CELSPAN_ANTIALIAS_FILTER;
  film.frame.strip_rows = seed % 7 == 2 ? 13 : 0;
  film.depth = seed % 2 ? CELSPAN_DEPTH_8 : CELSPAN_DEPTH_FLOAT;
  for (int k = 0; k < FRAMES; k++) {
    if (k > 2 && film.shapes[CELS - 1] > 0) /* the first frames do not differ */
      film.objects[CELS - 1][0] = studio_transform(s, film.objects[CELS - 1][0], moves[CELS - 1]);
    *rows += compare(s, bare, &film, 1 + (int)(seed + (uint64_t)k) % 3);
  }
  studio_finish(bare);
  studio_finish(s);
}

static void check_films(void) {
  enum { FILMS = 60 };
  memory_watch watch = {0};
  static studio s, bare;
  uint64_t rows = 0, drawn = 0;
  s.context = context_of(&watch, 64 << 20);
  bare.context = context_of(&watch, 0);
  for (uint64_t seed = 1; seed <= FILMS; seed++)
    if (check_is_drawn((int)seed)) {
      drawn++;
      check_film(&s, &bare, seed, &rows);
    }
  CHECK(rows >= drawn * HEIGHT); /* at least the third frame of each film */
  CHECK(cs_held_count(s.context).bytes <= (64 << 20) / 8);
  celspan_context_destroy(s.context);
  celspan_context_destroy(bare.context);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
}

/* ---------------------------------------------------------------- the parts of a key */

static celspan_grade *bright(studio *s) {
  celspan_grade_desc desc = CELSPAN_GRADE_DESC;
  celspan_grade *grade = NULL;
  desc.exposure = 1;
  studio_check(s, celspan_grade_create(s->context, &desc, &grade));
  return grade;
}

static void swap_cels(shot *made) {
  celspan_object *object = made->objects[1][0];
  made->objects[1][0] = made->objects[2][0];
  made->objects[2][0] = object;
}

/* Changes one thing; false: there is no change of this number. */
static bool change_scene(studio *s, shot *made, celspan_grade *grade, int number) {
  celspan_rostrum_desc *rostrum = &made->rostrum;
  const celspan_light dim = {0.5f, 0.4f, 0.3f, 0.2f};
  const celspan_stop stops[2] = {{0, celspan_paint_rgb(1, 0, 0, 1)},
                                 {1, celspan_paint_rgb(0, 1, 0, 1)}};
  switch (number) {
  case 0:
    return rostrum->has_camera_centre = true;
  case 1:
    rostrum->camera_rotation = 0.01;
    return true;
  case 2:
    rostrum->has_front = true;
    rostrum->front = dim;
    return true;
  case 3:
    rostrum->back = dim;
    return true;
  case 4:
    rostrum->brightness = 0.5;
    return true;
  case 5:
    rostrum->grade = grade;
    return true;
  case 6:
    rostrum->space = CELSPAN_SPACE_SRGB;
    return true;
  case 7:
    rostrum->antialias = CELSPAN_ANTIALIAS_NONE;
    return true;
  case 8: /* the cel is in the last rows, and its light in all */
    made->cels[CELS - 1].back = dim;
    return true;
  case 9:
    made->cels[CELS - 1].back_texture = (celspan_light_texture){
        .texture = studio_linear(s, (celspan_point){0, 0}, (celspan_point){WIDTH, 0}, stops, 2),
        .gain = 0.5,
        .matte = 0.5};
    return true;
  case 10:
    made->cels[2].blend = CELSPAN_BLEND_SCREEN;
    return true;
  case 11:
    made->cels[2].defocus_radius = 5;
    return true;
  case 12:
    swap_cels(made);
    return true;
  case 13:
    made->objects[2][0] =
        studio_transform(s, made->objects[2][0], celspan_matrix_translation(0, 9));
    return true;
  case 14:
    made->cels[2].grade = grade;
    return true;
  case 15:
    made->cels[1].has_viewport = true;
    made->cels[1].viewport = (celspan_box){0, 0, WIDTH / 2.0, HEIGHT};
    return true;
  }
  return false;
}

/* The same for the description of the frame. */
static bool change_frame(shot *made, int number) {
  celspan_frame_desc *desc = &made->frame;
  switch (number) {
  case 0:
    desc->crop_width = WIDTH - 32;
    desc->crop_height = HEIGHT;
    return true;
  case 1:
    desc->crop_x = 32;
    desc->crop_width = WIDTH - 32;
    desc->crop_height = HEIGHT;
    return true;
  case 2: /* bands of other rows */
    desc->crop_y = 8;
    desc->crop_width = WIDTH;
    desc->crop_height = HEIGHT - 16;
    return true;
  case 3:
    desc->width = 2 * WIDTH;
    return true;
  case 4:
    desc->height = HEIGHT - 16;
    return true;
  case 5:
    desc->film_width = WIDTH / 2.0;
    return true;
  case 6:
    desc->film_height = HEIGHT / 2.0;
    return true;
  case 7:
    desc->has_tolerance = true;
    desc->tolerance = 0.5;
    return true;
  case 8:
    desc->space = CELSPAN_SPACE_SRGB;
    return true;
  case 9:
    desc->has_antialias = true;
    desc->antialias = CELSPAN_ANTIALIAS_NONE;
    return true;
  case 10:
    desc->has_antialias = true;
    desc->antialias = CELSPAN_ANTIALIAS_FILTER;
    return true;
  case 11:
    desc->has_antialias = true;
    desc->antialias = CELSPAN_ANTIALIAS_FILTER;
    made->filter.has_radius = true;
    made->filter.radius = 3;
    return true;
  case 12:
    made->exposures[0].weight = 0.5;
    return true;
  case 13:
    made->depth = CELSPAN_DEPTH_8;
    return true;
  }
  return false;
}

/* Two frames in turn, of which both are held in the end: were the change not in the keys, one frame
 * would be given out as the other. */
static void check_change(studio *s, studio *bare, const shot *before, const shot *after) {
  uint64_t held[2] = {0, 0};
  for (int k = 0; k < 6; k++) {
    shot now = k % 2 ? *after : *before;
    held[k % 2] = compare(s, bare, &now, 1 + k % 3);
  }
  CHECK(held[0] > 0 && held[1] > 0);
}

/* A rectangle behind all, and a shape in each part of the height. */
static shot plain_shot(studio *s, bool is_rich) {
  test_random random = {77};
  shot made = begin_shot();
  for (int i = 0; i < CELS; i++)
    fill(s, &random, &made, i, is_rich && i < 2 ? SHAPES : 1, i == 0 ? 0 : 24.0 * i,
         i == 0 ? HEIGHT : 20);
  made.rostrum.back = (celspan_light){0.1f, 0.2f, 0.3f, 1};
  made.cels[CELS - 1].back = (celspan_light){0.1f, 0.1f, 0, 0.1f};
  return made;
}

static void check_keys(bool is_rich) {
  memory_watch watch = {0};
  static studio s, bare;
  s.context = context_of(&watch, 64 << 20);
  bare.context = context_of(&watch, 0);
  celspan_grade *grade = bright(&s);
  shot before = plain_shot(&s, is_rich), after = before;
  for (int i = 0; change_scene(&s, &after, grade, i); i++) {
    check_change(&s, &bare, &before, &after);
    studio_finish(&bare);
    studio_finish(&s);
    after = before = plain_shot(&s, is_rich);
  }
  for (int i = 0; change_frame(&after, i); i++) {
    check_change(&s, &bare, &before, &after);
    studio_finish(&bare);
    studio_finish(&s);
    after = before = plain_shot(&s, is_rich);
  }
  studio_finish(&s);
  celspan_grade_unref(grade);
  celspan_context_destroy(s.context);
  celspan_context_destroy(bare.context);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
}

/* ---------------------------------------------------------------- how much is held */

/* Frames in which a bar of 8 rows moves: its band is made, and the others are held from the third
 * frame on, where there is room for them. */
static uint64_t held_rows(size_t bytes, int32_t frames) {
  memory_watch watch = {0};
  static studio s;
  uint64_t rows = 0;
  static float pixels[4 * PIXELS];
  s.context = context_of(&watch, bytes);
  for (int32_t k = 0; k < frames; k++) {
    shot now = plain_shot(&s, false);
    celspan_texture *red = studio_paint(&s, celspan_paint_rgb(1, 0, 0, 1));
    now.objects[1][0] = studio_rect(&s, (double)(k % WIDTH), 20, 10, 8, red);
    rows += draw(&s, &now, 1 + k % 2, pixels);
    CHECK(cs_held_count(s.context).bytes <= bytes / 8);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  return rows;
}

static void check_rows(void) {
  CHECK(held_rows(64 << 20, 2) == 0);
  CHECK(held_rows(64 << 20, 12) == 10 * (HEIGHT - CS_FRAME_BAND));
  CHECK(held_rows(1 << 20, 12) == 10 * (HEIGHT - CS_FRAME_BAND));
  CHECK(held_rows(0, 12) == 0);
  uint64_t few = held_rows(1 << 18, 12);
  CHECK(few > 0 && few < 10 * (HEIGHT - CS_FRAME_BAND));
}

/* Where a blur is in all rows, and its radius grows, nothing is copied: only keys are noted. */
static void check_copies(void) {
  memory_watch watch = {0};
  static studio s;
  static float pixels[4 * PIXELS];
  s.context = context_of(&watch, 64 << 20);
  for (int k = 0; k < 6; k++) {
    shot now = plain_shot(&s, false);
    now.objects[0][0] = studio_rect(&s, 10, -10, 50, HEIGHT + 20, NULL);
    now.cels[0].defocus_radius = 1 + 0.01 * k;
    CHECK(draw(&s, &now, 1, pixels) == 0);
    studio_finish(&s);
  }
  const cs_cache_counts counts = cs_held_count(s.context);
  CHECK(counts.bytes < 6 * HEIGHT / CS_FRAME_BAND * 1024);
  CHECK(counts.found == 0 && counts.made == 6 * HEIGHT / CS_FRAME_BAND);
  celspan_context_destroy(s.context);
}

/* Very many cels, of which one moves. */
static void check_crowd(void) {
  enum { CROWD = 10000 };
  memory_watch watch = {0};
  static studio s, bare;
  static celspan_cel *cels[CROWD];
  static float held[4 * PIXELS], made[4 * PIXELS];
  s.context = context_of(&watch, 64 << 20);
  bare.context = context_of(&watch, 0);
  for (int i = 0; i < CROWD; i++) {
    celspan_rect_desc desc = {sizeof desc, i % 90, 10 + i / 80, 3, 2, 0, NULL};
    celspan_cel_desc cel = CELSPAN_CEL_DESC;
    celspan_object *object = NULL;
    studio_check(&s, celspan_object_create_rect(s.context, &desc, &object));
    cel.objects = &object;
    cel.object_count = 1;
    studio_check(&s, celspan_cel_create(s.context, &cel, &cels[i]));
    celspan_object_unref(object);
  }
  for (int k = 0; k < 4; k++) {
    celspan_matrix right = celspan_matrix_translation(1, 0);
    celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
    celspan_statistics statistics = CELSPAN_STATISTICS;
    celspan_cel *moved = NULL;
    studio_check(&s, celspan_cel_transform(s.context, cels[CROWD / 2], &right, &moved));
    celspan_cel_unref(cels[CROWD / 2]);
    cels[CROWD / 2] = moved;
    celspan_exposure exposure = {studio_rostrum(&s, desc, cels, CROWD), 1};
    celspan_frame_desc frame = studio_frame(&exposure, 1, WIDTH, HEIGHT, NULL);
    celspan_coding coding = CELSPAN_CODING;
    coding.depth = CELSPAN_DEPTH_FLOAT;
    frame.repeats = true;
    studio_check(&s,
                 celspan_frame_pixels(s.context, &frame, &coding, held, 16 * WIDTH, &statistics));
    studio_check(&s, celspan_frame_pixels(bare.context, &frame, &coding, made, 16 * WIDTH, NULL));
    CHECK(memcmp(held, made, sizeof held) == 0);
    CHECK(k < 2 ? statistics.rows_held == 0 : statistics.rows_held >= HEIGHT / 2);
  }
  studio_finish(&s);
  for (int i = 0; i < CROWD; i++)
    celspan_cel_unref(cels[i]);
  celspan_context_destroy(s.context);
  celspan_context_destroy(bare.context);
  CHECK(watch.blocks == 0);
}

/* ---------------------------------------------------------------- failures and threads */

static bool gives_up(void *user, int32_t rows_done, int32_t rows_total) {
  (void)user;
  return rows_done < rows_total;
}

/* A frame that is given up in its last row leaves nothing behind. */
static void check_given_up(void) {
  memory_watch watch = {0};
  static studio s;
  static float pixels[4 * PIXELS];
  s.context = context_of(&watch, 64 << 20);
  for (int k = 0; k < 6; k++) {
    shot now = plain_shot(&s, false);
    celspan_exposure exposure = {rostrum_of(&s, &now), 1};
    now.frame.exposures = &exposure;
    now.frame.repeats = true;
    now.frame.workers = 1 + k % 2;
    now.frame.progress = k < 4 ? gives_up : NULL;
    celspan_statistics statistics = CELSPAN_STATISTICS;
    celspan_status status =
        celspan_frame_pixels(s.context, &now.frame, NULL, pixels, 4 * WIDTH, &statistics);
    CHECK(status == (k < 4 ? CELSPAN_CANCELLED : CELSPAN_OK));
    CHECK(k < 4 || statistics.rows_held == (k == 4 ? 0 : HEIGHT));
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0);
}

/* Every allocation of a frame that is met again fails once; copies of its rows are given up. */
static void check_memory(void) {
  int failures = 0, given_up = 0;
  static float pixels[4 * PIXELS];
  for (size_t n = 1, last = 1; last; n += 3) {
    memory_watch watch = {0};
    static studio s;
    last = 0;
    s.context = context_of(&watch, 1 << 20);
    shot now = plain_shot(&s, false);
    celspan_exposure exposure = {rostrum_of(&s, &now), 1};
    now.frame.exposures = &exposure;
    now.frame.repeats = true;
    now.frame.workers = 1;
    for (int k = 0; k < 3; k++) {
      watch.fail_at = k == 1 ? watch.allocations + n : 0;
      celspan_status status =
          celspan_frame_pixels(s.context, &now.frame, NULL, pixels, 4 * WIDTH, NULL);
      CHECK(status == CELSPAN_OK || (k == 1 && status == CELSPAN_NO_MEMORY));
      if (k != 1)
        continue;
      last = watch.allocations >= watch.fail_at;
      failures += status == CELSPAN_NO_MEMORY;
      given_up += last && status == CELSPAN_OK;
    }
    studio_finish(&s);
    celspan_context_destroy(s.context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(failures > 10 && given_up > 0);
}

enum { THREADS = 4 };

typedef struct job {
  celspan_context *contexts[2];
  celspan_rostrum *rostrums[2];
  float made[2][4 * PIXELS], pixels[THREADS][4 * PIXELS];
  atomic_int wrong;
} job;

static celspan_status draw_one(celspan_context *context, celspan_rostrum *rostrum, float *pixels) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc frame = studio_frame(&exposure, 1, WIDTH, HEIGHT, NULL);
  celspan_coding coding = CELSPAN_CODING;
  coding.depth = CELSPAN_DEPTH_FLOAT;
  frame.repeats = true;
  frame.workers = 2;
  return celspan_frame_pixels(context, &frame, &coding, pixels, 16 * WIDTH, NULL);
}

static void work(void *user, int thread, int32_t index) {
  job *j = user;
  celspan_context branch;
  (void)thread;
  cs_context_branch(&branch, j->contexts[index % 2]);
  for (int k = 0; k < 12; k++) {
    if (draw_one(&branch, j->rostrums[k % 2], j->pixels[index]) != CELSPAN_OK)
      j->wrong++;
    j->wrong += memcmp(j->pixels[index], j->made[k % 2], sizeof j->made[0]) != 0;
  }
}

/* Frames of two contexts, which share their cels, in four threads. */
static void check_threads(void) {
  memory_watch watch = {0};
  static studio s;
  static job j;
  s.context = context_of(&watch, 1 << 22);
  j.contexts[0] = s.context;
  j.contexts[1] = context_of(&watch, 1 << 18);
  celspan_context *bare = context_of(&watch, 0);
  for (int i = 0; i < 2; i++) {
    shot now = plain_shot(&s, false);
    now.cels[3].opacity = i ? 0.5 : 1;
    j.rostrums[i] = rostrum_of(&s, &now);
    studio_check(&s, draw_one(bare, j.rostrums[i], j.made[i]));
  }
  cs_thread_pool_run(THREADS, THREADS, work, &j);
  CHECK(j.wrong == 0);
  CHECK(cs_held_count(j.contexts[0]).found > 0 && cs_held_count(j.contexts[1]).found > 0);
  studio_finish(&s);
  celspan_context_destroy(bare);
  celspan_context_destroy(j.contexts[0]);
  celspan_context_destroy(j.contexts[1]);
  CHECK(watch.blocks == 0);
}

/* A rostrum of which one light shines alone has the hashes of the rostrum that it was made of, and
 * other lights. */
static void check_lit_alone(void) {
  memory_watch watch = {0};
  static studio s;
  static float held[4 * PIXELS], made[4 * PIXELS];
  s.context = context_of(&watch, 64 << 20);
  celspan_context *bare = context_of(&watch, 0);
  celspan_texture *white = studio_paint(&s, celspan_paint_rgb(1, 1, 1, 1));
  celspan_object *disc = studio_circle(&s, WIDTH / 2.0, HEIGHT / 2.0, 40, white);
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.has_front = true;
  cel.front = (celspan_light){0.5f, 0.2f, 0.1f, 0};
  celspan_cel *lit = studio_cel(&s, cel, &disc, 1);
  celspan_rostrum *rostrum = studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &lit, 1);
  cs_lit_alone alone;
  for (int k = 0; k < 2; k++)
    studio_check(&s, draw_one(s.context, rostrum, held));
  studio_check(&s, cs_lit_alone_make(s.context, rostrum, 0, false, &alone));
  celspan_rostrum_ref(&alone.rostrum);
  studio_check(&s, draw_one(s.context, &alone.rostrum, held));
  studio_check(&s, draw_one(bare, &alone.rostrum, made));
  CHECK(memcmp(held, made, sizeof held) == 0);
  cs_lit_alone_finish(s.context, &alone);
  studio_finish(&s);
  celspan_context_destroy(bare);
  celspan_context_destroy(s.context);
}

int main(void) {
  check_films();
  check_keys(false);
  check_keys(true);
  check_rows();
  check_copies();
  check_crowd();
  check_given_up();
  check_memory();
  check_threads();
  check_lit_alone();
  return check_done();
}
