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
    if (k > 2 && film.shapes[CELS - 1] > 0) /* the first frames are all the same */
      film.objects[CELS - 1][0] =
          studio_transform(s, film.objects[CELS - 1][0], moves[CELS - 1]);
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

int main(void) {
  check_films();
  return check_done();
}
