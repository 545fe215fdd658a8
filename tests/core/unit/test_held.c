/* frames/render/held.h: a frame of which bands are given out is the frame that would be made, by
 * any number of workers and with any memory, and bands are held where nothing has changed.
 */
#include "frames/render/held.h"

#include <fcntl.h>
#include <sys/stat.h>

#include "base/thread_pool.h"
#include "frames/render/ways.h"
#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"
#include "output/sinks/ycc_sink.h"
#include "tests/support/memory.h"
#include "tests/support/picture.h"
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

/* Where pixels go. A sink of the test gets codes and nothing else. */
typedef enum into { INTO_MEMORY, INTO_PLANES, INTO_OWN, INTO_DIGEST } into;

/* What one frame is made of. A change acts on it by number. */
typedef struct shot {
  celspan_rostrum_desc rostrum;
  celspan_cel_desc cels[CELS];
  celspan_object *objects[CELS][SHAPES];
  size_t shapes[CELS];
  celspan_frame_desc frame;
  celspan_filter_desc filter;
  celspan_exposure exposures[2];
  celspan_coding coding;
  int32_t x, y; /* the place of the crop, beyond that in the frame: thresholds of dithering */
  into into;
  bool is_alone; /* not one frame of several */
} shot;

static celspan_rostrum *rostrum_of(studio *s, const shot *from) {
  celspan_cel *cels[CELS];
  for (size_t i = 0; i < CELS; i++)
    cels[i] = studio_cel(s, from->cels[i], from->objects[i], from->shapes[i]);
  return studio_rostrum(s, from->rostrum, cels, CELS);
}

/* Coded rows, one after the other. */
typedef struct own_rows {
  unsigned char *bytes;
  size_t stride;
} own_rows;

static celspan_status begin_own(void *user, celspan_context *context, int32_t width,
                                int32_t height) {
  (void)user, (void)context, (void)width, (void)height;
  return CELSPAN_OK;
}

static celspan_status put_own(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t count) {
  const own_rows *rows = user;
  (void)context;
  if (CHECK(count == 1 && spans->kind == CELSPAN_SPAN_ARRAY && spans->codes))
    memcpy(rows->bytes + (size_t)y * rows->stride, spans->codes, rows->stride);
  return CELSPAN_OK;
}

static celspan_status end_own(void *user, celspan_context *context, celspan_status outcome) {
  (void)user, (void)context;
  return outcome;
}

/* planes, rows: live as long as the sink, and have the place of the pixels. */
static celspan_sink sink_of(studio *s, const shot *from, cs_ycc *planes, own_rows *rows) {
  const cs_coder coder = planes->coder;
  celspan_sink sink = {sizeof sink, rows, begin_own, put_own, end_own, false};
  if (from->into == INTO_PLANES)
    return cs_ycc_sink(planes);
  if (from->into == INTO_OWN) {
    studio_check(s, cs_coder_sink(s->context, &coder, &sink));
    return sink;
  }
  if (from->into == INTO_MEMORY)
    studio_check(s, cs_sink_memory(s->context, &coder.coding, rows->bytes, rows->stride, &sink));
  else
    studio_check(s, cs_sink_digest(s->context, &coder.coding, (uint64_t *)rows->bytes, &sink));
  studio_check(s,
               cs_coder_dither(s->context, &from->coding, &coder.coding, coder.x, coder.y, &sink));
  return sink;
}

/* The pixels of a frame, and how many of its rows were held. */
static uint64_t draw(studio *s, shot *from, int workers, float *pixels) {
  celspan_statistics statistics = CELSPAN_STATISTICS;
  celspan_frame_desc *desc = &from->frame;
  int32_t width = desc->crop_width ? desc->crop_width : desc->width;
  cs_ycc planes = {.coder =
                       cs_coder_of(&from->coding, desc->crop_x + from->x, desc->crop_y + from->y),
                   .is_halved = true,
                   .bytes = (unsigned char *)pixels};
  planes.coder.coding.space = desc->space;
  own_rows rows = {planes.bytes, (size_t)width * cs_pixels_size(&planes.coder.coding)};
  from->exposures[0].rostrum = rostrum_of(s, from);
  desc->exposures = from->exposures;
  desc->filter = &from->filter;
  desc->workers = workers;
  desc->repeats = !from->is_alone;
  celspan_sink sink = sink_of(s, from, &planes, &rows);
  studio_check(s, cs_frame_render_own(s->context, desc, &sink, &statistics));
  return statistics.rows_held;
}

/* Whether the frame is the same with memory and without. *rows: of it, how many were held. */
static bool compare(studio *s, studio *bare, shot *from, int workers, uint64_t *rows) {
  static float held[8 * PIXELS], made[8 * PIXELS];
  memset(held, 0, sizeof held);
  memset(made, 0, sizeof made);
  *rows = draw(s, from, workers, held);
  return draw(bare, from, 1, made) == 0 && memcmp(held, made, sizeof held) == 0;
}

static shot begin_shot(void) {
  shot made = {.rostrum = CELSPAN_ROSTRUM_DESC,
               .frame = CELSPAN_FRAME_DESC,
               .filter = CELSPAN_FILTER_DESC,
               .exposures[0].weight = 1,
               .coding = CELSPAN_CODING};
  made.coding.depth = CELSPAN_DEPTH_FLOAT;
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

static celspan_texture *ramp(studio *s, double top) {
  const celspan_stop stops[3] = {{0, celspan_paint_rgb(1, 0, 0, 1)},
                                 {0.3, celspan_paint_rgb(0, 0, 1, 1)},
                                 {1, celspan_paint_rgb(0, 1, 0, 1)}};
  return studio_radial(s, (celspan_point){20, top}, 90, stops, 3);
}

/* High triangles, so that boundaries that are hidden are left out. */
static void fill_high(studio *s, test_random *random, shot *made, int cel) {
  made->shapes[cel] = 20;
  for (int k = 0; k < 20; k++) {
    celspan_point p[3];
    for (int j = 0; j < 3; j++)
      p[j] = random_point(random, -40, WIDTH + 40, -60, HEIGHT + 60);
    celspan_texture *texture =
        k % 2 ? ramp(s, p[0].y) : studio_paint(s, celspan_paint_rgb(0, (float)k / 20, 1, 1));
    made->objects[cel][k] = studio_polygon(s, p, 3, CELSPAN_RULE_NONZERO, texture);
  }
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

static void choose_coding(test_random *random, shot *film) {
  static const celspan_depth depths[] = {CELSPAN_DEPTH_8, CELSPAN_DEPTH_8_DITHER, CELSPAN_DEPTH_16,
                                         CELSPAN_DEPTH_FLOAT};
  film->coding.depth = depths[random_below(random, 4)];
  film->coding.alpha =
      random_below(random, 2) ? CELSPAN_ALPHA_STRAIGHT : CELSPAN_ALPHA_PREMULTIPLIED;
  film->into = film->coding.depth == CELSPAN_DEPTH_16 || random_below(random, 2) ? INTO_OWN
               : film->coding.depth == CELSPAN_DEPTH_FLOAT                       ? INTO_MEMORY
                                                                                 : INTO_PLANES;
}

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
    if (seed % 4 == 1 && i < 3)
      fill_high(s, &random, &film, i);
    choose_kind(&random, &film.cels[i]);
    double dx = random_between(&random, -3, 3), dy = random_between(&random, -1, 1);
    moves[i] = celspan_matrix_translation(dx, dy);
  }
  memcpy(still, film.objects, sizeof still);
  film.frame.has_antialias = seed % 5 == 1;
  film.frame.antialias = CELSPAN_ANTIALIAS_FILTER;
  film.frame.strip_rows = seed % 7 == 2 ? 13 : 0;
  choose_coding(&random, &film);
  for (int k = 0; k < FRAMES; k++) {
    uint64_t held;
    if (k > 2 && film.shapes[CELS - 1] > 0) /* the first frames do not differ */
      film.objects[CELS - 1][0] = studio_transform(s, film.objects[CELS - 1][0], moves[CELS - 1]);
    CHECK(compare(s, bare, &film, 1 + (int)(seed + (uint64_t)k) % 3, &held));
    *rows += held;
  }
  studio_finish(bare);
  studio_finish(s);
}

static void check_films(void) {
  const uint64_t films = check_is_for_threads() ? 8 : 60;
  memory_watch watch = {0};
  static studio s, bare;
  uint64_t rows = 0, drawn = 0;
  s.context = context_of(&watch, 64 << 20);
  bare.context = context_of(&watch, 0);
  for (uint64_t seed = 1; seed <= films; seed++)
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

/* ---------------------------------------------------------------- scenes */

static const celspan_light dim = {0.5f, 0.4f, 0.3f, 0.2f};

/* A rectangle behind all, and a shape in each part of the height. */
static void plain(studio *s, shot *made) {
  test_random random = {77};
  for (int i = 0; i < CELS; i++)
    fill(s, &random, made, i, 1, i == 0 ? 0 : 24.0 * i, i == 0 ? HEIGHT : 20);
  made->rostrum.back = (celspan_light){0.1f, 0.2f, 0.3f, 0.4f};
  made->cels[CELS - 1].back = (celspan_light){0.1f, 0.1f, 0, 0.1f};
}

/* The same with two cels of so many shapes that maps are made of them. */
static void rich(studio *s, shot *made) {
  plain(s, made);
  for (int i = 0; i < CELS; i++) {
    celspan_texture *texture = studio_paint(s, celspan_paint_rgb(0.8f, (float)i / CELS, 0.3f, 1));
    made->objects[i][0] = studio_rect(s, 20, 24.0 * i, 50, 19, texture);
    if (i >= 2)
      continue;
    made->shapes[i] = SHAPES;
    for (int k = 0; k < SHAPES; k++)
      made->objects[i][k] = studio_circle(s, 5 + k % 7 * 13, 7 + k / 7 * (i == 0 ? 16 : 3),
                                          i == 0 ? 6 : 1.3, texture);
  }
}

/* The same discs in the upper rows, turned as one object. */
static celspan_object *turned_discs(studio *s, const shot *made, double angle) {
  celspan_object *all = studio_boolean(s, CELSPAN_OPERATOR_UNION, made->objects[1], SHAPES);
  return studio_transform(s, all, celspan_matrix_rotation(angle, (celspan_point){40, 20}));
}

static void turned(studio *s, shot *made) {
  rich(s, made);
  made->objects[0][0] = turned_discs(s, made, 0.3);
  made->shapes[0] = 1;
}

/* Maps of drawings that have too many windings in a place. */
static void gaps(studio *s, shot *made) {
  test_random random = {78};
  plain(s, made);
  fill(s, &random, made, 0, SHAPES, 0, HEIGHT);
}

static void cropped(studio *s, shot *made) {
  plain(s, made);
  made->frame.crop_width = WIDTH / 2;
  made->frame.crop_height = HEIGHT / 2;
}

/* One cel with gradients, in all rows. */
static void gradients(studio *s, shot *made) {
  plain(s, made);
  made->objects[0][0] = studio_rect(s, 0, 0, WIDTH, HEIGHT, ramp(s, 50));
}

/* Under a filter that reaches three rows, and a bar between two bands, two rows from each. */
static void filtered(studio *s, shot *made) {
  plain(s, made);
  made->objects[1][0] =
      studio_rect(s, 8, 18, 60, 12, studio_paint(s, celspan_paint_rgb(1, 0, 0, 1)));
  made->frame.has_antialias = true;
  made->frame.antialias = CELSPAN_ANTIALIAS_FILTER;
  made->filter.has_radius = true;
  made->filter.radius = 3;
}

static void hidden(studio *s, shot *made) {
  test_random random = {5};
  plain(s, made);
  for (int i = 0; i < 2; i++)
    fill_high(s, &random, made, i);
}

/* So many faint shapes that their light is folded by a table. */
static void faint(studio *s, shot *made) {
  celspan_texture *texture = studio_paint(s, celspan_paint_rgb(0.9f, 0.7f, 0.3f, 0.013f));
  for (int i = 0; i < CELS; i++) {
    made->shapes[i] = i < 5 ? SHAPES - 1 : 1;
    for (int k = 0; k < SHAPES; k++)
      made->objects[i][k] =
          studio_rect(s, (k * 7 + i) % 60, i == 0 ? 130 : 4, 1 + k % 31, i < 5 ? 20 : 2, texture);
  }
}

/* Thin lines that cross each other: a crowd. */
static void crowd(studio *s, shot *made) {
  test_random random = {9};
  plain(s, made);
  celspan_texture *texture = studio_paint(s, celspan_paint_rgb(0.9f, 0.7f, 0.3f, 0.1f));
  for (int i = 0; i < CELS; i++) {
    made->cels[i].back = (celspan_light){0, 0, 0, 0};
    made->shapes[i] = i < 3 ? 50 : 1; /* too few for a table */
    for (int k = 0; k < 50; k++) {
      celspan_point p[3];
      for (int j = 0; j < 3; j++)
        p[j] = random_point(&random, 20, 60, 10, 50);
      p[1] = (celspan_point){p[0].x + 0.2, p[0].y};
      made->objects[i][k] = i < 3 ? studio_polygon(s, p, 3, CELSPAN_RULE_NONZERO, texture)
                                  : studio_rect(s, 5, 120 + 6 * i, 40, 4, texture);
    }
  }
}

/* Pixels that a sink may take as they are. */
static void pixels(studio *s, shot *made) {
  static unsigned char codes[PIXELS][4];
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  celspan_picture_desc picture = CELSPAN_PICTURE_DESC;
  plain(s, made);
  for (int i = 0; i < PIXELS; i++)
    memcpy(codes[i], (unsigned char[4]){(unsigned char)i, (unsigned char)(i / 7), 30, 255}, 4);
  desc.width = WIDTH;
  desc.height = HEIGHT;
  desc.format = CELSPAN_SURFACE_RGBA8;
  desc.pixels = codes;
  studio_check(s, celspan_surface_create(s->context, &desc, &picture.surface));
  celspan_texture **texture = &s->textures[s->texture_count++];
  studio_check(s, celspan_texture_create_picture(s->context, &picture, texture));
  celspan_surface_unref(picture.surface);
  made->objects[0][0] = studio_rect(s, 0, 0, WIDTH, HEIGHT, *texture);
}

/* Blurred cels over each other: one of few drawings in which a mode elsewhere moves last bits. */
static void blurred(studio *s, shot *made) {
  test_random random = {17};
  plain(s, made);
  for (int i = 0; i < CELS - 1; i++) {
    fill(s, &random, made, i, 4, 0, 110);
    made->cels[i].defocus_radius = i > 0 ? 2 + i : 0;
  }
}

/* Into codes that are kept: of 8 bits, such as pictures may have and others, of 16 bits, dithered,
 * and dithered from above the frame. */
static void coded(studio *s, shot *made) {
  plain(s, made);
  made->coding.depth = CELSPAN_DEPTH_8;
}
static void premultiplied(studio *s, shot *made) {
  coded(s, made);
  made->coding.alpha = CELSPAN_ALPHA_PREMULTIPLIED;
}
static void deep(studio *s, shot *made) {
  plain(s, made);
  made->coding.depth = CELSPAN_DEPTH_16;
  made->coding.transfer = CELSPAN_TRANSFER_SRGB;
  made->coding.alpha = CELSPAN_ALPHA_STRAIGHT;
}
static void dithered(studio *s, shot *made) {
  gradients(s, made);
  made->coding.depth = CELSPAN_DEPTH_8_DITHER;
}
static void above(studio *s, shot *made) {
  dithered(s, made);
  made->frame.crop_y = -8;
  made->frame.crop_width = WIDTH;
  made->frame.crop_height = HEIGHT + 8;
}

/* ---------------------------------------------------------------- the parts of a key */

static void camera(studio *s, shot *made) {
  (void)s;
  made->rostrum.has_camera_centre = true;
}
static void rotation(studio *s, shot *made) {
  (void)s;
  made->rostrum.camera_radians = 0.01;
}
static void front(studio *s, shot *made) {
  (void)s;
  made->rostrum.has_front = true;
  made->rostrum.front = dim;
}
static void back(studio *s, shot *made) {
  (void)s;
  made->rostrum.back = dim;
}
static void brightness(studio *s, shot *made) {
  (void)s;
  made->rostrum.brightness = 0.5;
}
static celspan_grade *bright; /* of the context in which scenes are made */
static void grade(studio *s, shot *made) {
  (void)s;
  made->rostrum.grade = bright;
}
static void rostrum_space(studio *s, shot *made) {
  (void)s;
  made->rostrum.space = CELSPAN_SPACE_SRGB;
}
static void rostrum_antialias(studio *s, shot *made) {
  (void)s;
  made->rostrum.antialias = CELSPAN_ANTIALIAS_NONE;
}
/* The cel is in the last rows, and its light in all. */
static void cel_back(studio *s, shot *made) {
  (void)s;
  made->cels[CELS - 1].back.r = 0.5f;
}
static void cel_matte(studio *s, shot *made) {
  (void)s;
  made->cels[CELS - 1].back.a = 0.2f;
}
/* The same light, behind another cel. */
static void cel_back_order(studio *s, shot *made) {
  (void)s;
  made->cels[1].back = made->cels[CELS - 1].back;
  made->cels[CELS - 1].back = (celspan_light){0, 0, 0, 0};
}
static void shaped_back(studio *s, shot *made) {
  made->cels[CELS - 1].back_texture =
      (celspan_light_texture){.texture = ramp(s, 0), .gain = 0.5, .matte = 0.5};
}
static void cel_blend(studio *s, shot *made) {
  (void)s;
  made->cels[2].blend = CELSPAN_BLEND_SCREEN;
}
static void last_blend(studio *s, shot *made) {
  (void)s;
  made->cels[CELS - 1].blend = CELSPAN_BLEND_MULTIPLY;
}
static void cel_blur(studio *s, shot *made) {
  (void)s;
  made->cels[2].defocus_radius = 5;
}
static void cel_front(studio *s, shot *made) {
  (void)s;
  made->cels[0].has_front = true;
  made->cels[0].front = dim;
}
static void order(studio *s, shot *made) {
  (void)s;
  celspan_object *object = made->objects[1][0];
  made->objects[1][0] = made->objects[2][0];
  made->objects[2][0] = object;
}
static void moved(studio *s, shot *made) {
  made->objects[2][0] = studio_transform(s, made->objects[2][0], celspan_matrix_translation(0, 9));
}
static void first_moved(studio *s, shot *made) {
  for (size_t k = 0; k < made->shapes[0]; k++)
    made->objects[0][k] =
        studio_transform(s, made->objects[0][k], celspan_matrix_translation(0.3, 0));
}
static void first_turned(studio *s, shot *made) {
  made->objects[0][0] = turned_discs(s, made, 0.4);
}
static void recoloured(studio *s, shot *made) {
  made->objects[1][0] =
      studio_rect(s, 8, 18, 60, 12, studio_paint(s, celspan_paint_rgb(0, 0, 1, 1)));
}
static void cel_grade(studio *s, shot *made) {
  (void)s;
  made->cels[0].grade = bright;
}
static void viewport(studio *s, shot *made) {
  (void)s;
  made->cels[1].has_viewport = true;
  made->cels[1].viewport = (celspan_box){0, 0, WIDTH / 2.0, HEIGHT};
}
/* Opaque in the upper rows, so that the background is hidden there. */
static void hiding(studio *s, shot *made) {
  made->objects[1][19] = studio_rect(s, -40, -60, WIDTH + 80, 101, ramp(s, 3));
}
/* So many layers that the tiles of the cull are lower. */
static void tiles(studio *s, shot *made) {
  for (size_t k = made->shapes[CELS - 1]; k < SHAPES; k++)
    made->objects[CELS - 1][k] = studio_rect(s, (double)k, 150, 3, 9, ramp(s, 140));
  made->shapes[CELS - 1] = SHAPES;
}
/* A layer more, in the last rows. */
static void one_more(studio *s, shot *made) {
  (void)s;
  made->shapes[0]++;
}
/* A boolean in the last rows. */
static void boolean(studio *s, shot *made) {
  celspan_texture *texture = studio_paint(s, celspan_paint_rgb(0.9f, 0.7f, 0.3f, 0.1f));
  made->objects[CELS - 1][0] =
      studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, studio_rect(s, 5, 140, 40, 9, texture),
                  studio_rect(s, 9, 143, 4, 3, texture));
}
static void last_ramp(studio *s, shot *made) {
  made->objects[CELS - 1][0] = studio_rect(s, 5, 140, 40, 9, ramp(s, 140));
}
static void last_blur(studio *s, shot *made) {
  (void)s;
  made->cels[CELS - 1].defocus_radius = 1;
}
static void crop(studio *s, shot *made) {
  (void)s;
  made->frame.crop_width = WIDTH - 32;
  made->frame.crop_height = HEIGHT;
}
static void crop_x(studio *s, shot *made) {
  (void)s;
  made->frame.crop_x = 32;
  made->frame.crop_width = WIDTH / 2;
}
/* The first band has other rows. */
static void crop_y(studio *s, shot *made) {
  (void)s;
  made->frame.crop_y = 8;
  made->frame.crop_width = WIDTH;
  made->frame.crop_height = HEIGHT - 8;
}
/* The same for the last band. */
static void crop_end(studio *s, shot *made) {
  (void)s;
  made->frame.crop_width = WIDTH;
  made->frame.crop_height = HEIGHT - 8;
}
static void width(studio *s, shot *made) {
  (void)s;
  made->frame.width = 2 * WIDTH;
}
static void height(studio *s, shot *made) {
  (void)s;
  made->frame.height = HEIGHT - 16;
}
static void film_width(studio *s, shot *made) {
  (void)s;
  made->frame.film_width = WIDTH / 2.0;
}
static void film_height(studio *s, shot *made) {
  (void)s;
  made->frame.film_height = HEIGHT / 2.0;
}
static void tolerance(studio *s, shot *made) {
  (void)s;
  made->frame.has_tolerance = true;
  made->frame.tolerance = 0.5;
}
static void frame_space(studio *s, shot *made) {
  (void)s;
  made->frame.space = CELSPAN_SPACE_SRGB;
}
static void frame_antialias(studio *s, shot *made) {
  (void)s;
  made->frame.has_antialias = true;
  made->frame.antialias = CELSPAN_ANTIALIAS_FILTER;
}
static void radius(studio *s, shot *made) {
  (void)s;
  made->filter.radius = 2;
}
static void weight(studio *s, shot *made) {
  (void)s;
  made->exposures[0].weight = 0.5;
}
static void depth(studio *s, shot *made) {
  (void)s;
  made->coding.depth = CELSPAN_DEPTH_8;
}
/* A sink that takes codes, and has no coder. */
static void digest(studio *s, shot *made) {
  depth(s, made);
  made->into = INTO_DIGEST;
}
static void halves(studio *s, shot *made) {
  (void)s;
  made->coding.depth = CELSPAN_DEPTH_HALF;
}
static void transfer(studio *s, shot *made) {
  (void)s;
  made->coding.transfer = CELSPAN_TRANSFER_REC709;
}
static void alpha(studio *s, shot *made) {
  (void)s;
  made->coding.alpha = CELSPAN_ALPHA_PREMULTIPLIED;
}
static void dither(studio *s, shot *made) {
  (void)s;
  made->coding.depth = CELSPAN_DEPTH_8_DITHER;
}
static void planes(studio *s, shot *made) {
  (void)s;
  made->into = INTO_PLANES;
}
static void place_x(studio *s, shot *made) {
  (void)s;
  made->x = 5;
}
static void place_y(studio *s, shot *made) {
  (void)s;
  made->y = 5;
}
/* The first row is coded as the row above the frame was. */
static void below(studio *s, shot *made) {
  (void)s;
  made->frame.crop_y = 0;
  made->frame.crop_height = HEIGHT;
  made->y = -8;
}
static void brighten(void *user, float *rgba, size_t count) {
  for (size_t i = 0; i < 4 * count; i++)
    rgba[i] *= i % 4 < 3 ? *(const float *)user : 1;
}
static float more = 1.5f, less = 0.5f;
/* Into codes of a conversion, which are not kept. */
static void converted(studio *s, shot *made) {
  coded(s, made);
  made->coding.convert = brighten;
  made->coding.user = &more;
}
static void conversion(studio *s, shot *made) {
  (void)s;
  made->coding.user = &less;
}

/* Two frames that differ in one thing. */
typedef struct difference {
  const char *name;
  void (*scene)(studio *s, shot *made);
  void (*change)(studio *s, shot *made);
} difference;

#define DIFFERENCE(scene, change)                                                                  \
  { #scene " " #change, scene, change }

static const difference differences[] = {
    DIFFERENCE(plain, camera),         DIFFERENCE(plain, rotation),
    DIFFERENCE(plain, front),          DIFFERENCE(plain, back),
    DIFFERENCE(plain, brightness),     DIFFERENCE(plain, grade),
    DIFFERENCE(plain, rostrum_space),  DIFFERENCE(plain, rostrum_antialias),
    DIFFERENCE(plain, cel_back),       DIFFERENCE(plain, cel_matte),
    DIFFERENCE(plain, cel_back_order), DIFFERENCE(plain, shaped_back),
    DIFFERENCE(plain, cel_blend),      DIFFERENCE(plain, cel_blur),
    DIFFERENCE(plain, cel_front),      DIFFERENCE(plain, order),
    DIFFERENCE(plain, moved),          DIFFERENCE(plain, cel_grade),
    DIFFERENCE(plain, viewport),       DIFFERENCE(plain, crop),
    DIFFERENCE(plain, crop_y),         DIFFERENCE(plain, crop_end),
    DIFFERENCE(plain, width),          DIFFERENCE(plain, height),
    DIFFERENCE(gradients, film_width), DIFFERENCE(gradients, film_height),
    DIFFERENCE(plain, frame_space),    DIFFERENCE(plain, frame_antialias),
    DIFFERENCE(plain, weight),         DIFFERENCE(plain, depth),
    DIFFERENCE(pixels, digest),        DIFFERENCE(cropped, crop_x),
    DIFFERENCE(cropped, width),        DIFFERENCE(cropped, height),
    DIFFERENCE(gradients, tolerance),  DIFFERENCE(filtered, recoloured),
    DIFFERENCE(filtered, radius),      DIFFERENCE(hidden, hiding),
    DIFFERENCE(hidden, tiles),         DIFFERENCE(faint, one_more),
    DIFFERENCE(faint, last_ramp),      DIFFERENCE(crowd, last_ramp),
    DIFFERENCE(crowd, boolean),        DIFFERENCE(hidden, crop_y),
    DIFFERENCE(hidden, crop_end),      DIFFERENCE(rich, last_ramp),
    DIFFERENCE(rich, last_blur),       DIFFERENCE(blurred, last_blend),
    DIFFERENCE(rich, cel_back),        DIFFERENCE(rich, cel_matte),
    DIFFERENCE(rich, cel_front),       DIFFERENCE(rich, cel_grade),
    DIFFERENCE(rich, moved),           DIFFERENCE(rich, first_moved),
    DIFFERENCE(turned, first_turned),  DIFFERENCE(turned, cel_front),
    DIFFERENCE(rich, cel_blur),        DIFFERENCE(rich, order),
    DIFFERENCE(rich, viewport),        DIFFERENCE(deep, transfer),
    DIFFERENCE(deep, alpha),           DIFFERENCE(premultiplied, dither),
    DIFFERENCE(coded, planes),         DIFFERENCE(deep, halves),
    DIFFERENCE(dithered, planes),      DIFFERENCE(dithered, place_x),
    DIFFERENCE(dithered, place_y),     DIFFERENCE(dithered, crop_y),
    DIFFERENCE(above, below),          DIFFERENCE(converted, conversion),
};

/* Two frames in turn, of which both are held in the end: were the change not in the keys, one frame
 * would be given out as the other. */
static bool check_difference(const difference *d) {
  memory_watch watch = {0};
  static studio s, bare;
  celspan_grade_desc desc = CELSPAN_GRADE_DESC;
  uint64_t held[2] = {0, 0};
  bool are_equal = true;
  shot made[2] = {begin_shot()};
  s.context = context_of(&watch, 64 << 20);
  bare.context = context_of(&watch, 0);
  s.context->forced_way = bare.context->forced_way =
      d->scene == rich || d->scene == turned ? CS_WAYS_MAPPED : 0;
  desc.exposure = 1;
  studio_check(&s, celspan_grade_create(s.context, &desc, &bright));
  d->scene(&s, &made[0]);
  made[1] = made[0];
  d->change(&s, &made[1]);
  for (int k = 0; k < 6; k++)
    are_equal &= compare(&s, &bare, &made[k % 2], 1 + k % 3, &held[k % 2]);
  studio_finish(&bare);
  studio_finish(&s);
  celspan_grade_unref(bright);
  celspan_context_destroy(s.context);
  celspan_context_destroy(bare.context);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  return CHECK(are_equal && held[0] > 0 && held[1] > 0);
}

/* Frames of which nothing may be held: their keys would not have all that decides them. */
static celspan_status bar(void *user, celspan_context *context, double y,
                          const celspan_scanline_row *row, celspan_scanline_output *output) {
  const celspan_paint *paint = user;
  (void)context, (void)y;
  return celspan_scanline_emit(output, row->x0, row->x1, paint, 1);
}

/* A procedure with another paint in each frame, although it should be a pure function. */
static celspan_paint bar_paint;
static void procedure(studio *s, shot *made) {
  celspan_scanline_desc desc = CELSPAN_SCANLINE_DESC;
  plain(s, made);
  desc.bounds = (celspan_box){10, 10, 50, 60};
  desc.spans = bar;
  desc.user = &bar_paint;
  made->objects[0][0] = studio_scanline(s, &desc);
}

/* More dashes than are compiled together. */
static void dashes(studio *s, shot *made) {
  const double lengths[2] = {0.1, 0.06};
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  plain(s, made);
  desc.dashes = lengths;
  desc.dash_count = 2;
  desc.data = "M1 4.2H90M1 14.2H90M1 24.2H90M1 34.2H90M1 44.2H90M1 54.2H90M1 64.2H90M1 74.2H90";
  desc.texture = studio_paint(s, celspan_paint_rgb(1, 0, 0, 1));
  studio_check(s, celspan_object_create_stroke(s->context, &desc, &made->objects[0][0]));
  s->objects[s->object_count++] = made->objects[0][0];
}

static void paint_dark(int x, int y, float rgba[4]) {
  memcpy(rgba, (float[4]){(float)x / WIDTH, (float)y / HEIGHT, 0, 1}, 4 * sizeof(float));
}

static void paint_light(int x, int y, float rgba[4]) {
  memcpy(rgba, (float[4]){1, (float)y / HEIGHT, (float)x / WIDTH, 1}, 4 * sizeof(float));
}

/* A file of a picture that is written again is another picture. */
static void check_file(void) {
  memory_watch watch = {0};
  static studio s, bare;
  uint64_t rows;
  const char *path = picture_path("held.png");
  celspan_picture_desc picture = CELSPAN_PICTURE_DESC;
  s.context = context_of(&watch, 64 << 20);
  bare.context = context_of(&watch, 0);
  picture.file = path;
  if (picture_module_or_skip(s.context)) {
    shot made = begin_shot();
    plain(&s, &made);
    celspan_texture **texture = &s.textures[s.texture_count++];
    studio_check(&s, celspan_texture_create_picture(s.context, &picture, texture));
    made.objects[0][0] = studio_rect(&s, 0, 0, WIDTH, HEIGHT, *texture);
    for (int k = 0; k < 6; k++) {
      const struct timespec times[2] = {{1000 + k / 3, 0}, {1000 + k / 3, 0}};
      if (k % 3 == 0) {
        studio_check(&s, picture_write(s.context, path, NULL, WIDTH, HEIGHT,
                                       k == 0 ? paint_dark : paint_light));
        CHECK(utimensat(AT_FDCWD, path, times, 0) == 0);
      }
      CHECK(compare(&s, &bare, &made, 1, &rows));
      CHECK(rows == (k % 3 < 2 ? 0 : HEIGHT));
    }
    unlink(path);
  }
  studio_finish(&bare);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  celspan_context_destroy(bare.context);
}

static void check_not_held(void (*scene)(studio *s, shot *made), bool repeats) {
  memory_watch watch = {0};
  static studio s, bare;
  s.context = context_of(&watch, 64 << 20);
  bare.context = context_of(&watch, 0);
  s.context->forced_way = bare.context->forced_way = scene == gaps ? CS_WAYS_MAPPED : 0;
  shot made = begin_shot();
  made.is_alone = !repeats;
  scene(&s, &made);
  for (int k = 0; k < 4; k++) {
    uint64_t rows;
    bar_paint = celspan_paint_rgb(1, (float)k / 4, 0, 1);
    CHECK(compare(&s, &bare, &made, 1, &rows) && rows == 0);
  }
  CHECK(cs_held_count(s.context).made == 0);
  studio_finish(&bare);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  celspan_context_destroy(bare.context);
}

static void check_keys(void) {
  for (size_t i = 0; i < sizeof differences / sizeof *differences; i++)
    if (!check_difference(&differences[i]))
      fprintf(stderr, "  %s\n", differences[i].name);
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
    shot now = begin_shot();
    plain(&s, &now);
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

/* Codes are kept instead of the spans that they were made of, where they are no floats and a whole
 * frame of them has room, and are given out from the copy on. Where it has not, most spans have. */
static void check_codes(size_t bytes, celspan_depth depth, bool are_kept) {
  memory_watch watch = {0};
  static studio s;
  static float pixels[4 * PIXELS];
  s.context = context_of(&watch, bytes);
  shot now = begin_shot();
  plain(&s, &now);
  now.coding.depth = depth;
  celspan_exposure exposure = {rostrum_of(&s, &now), 1};
  celspan_frame_desc frame = studio_frame(&exposure, 1, WIDTH, HEIGHT, NULL);
  celspan_statistics statistics = CELSPAN_STATISTICS;
  frame.repeats = true;
  for (int k = 0; k < 3; k++) {
    studio_check(
        &s, celspan_frame_pixels(s.context, &frame, &now.coding, pixels, 16 * WIDTH, &statistics));
    CHECK((statistics.spans == HEIGHT) == (k > 0 && are_kept));
  }
  CHECK(statistics.rows_held >= HEIGHT / 4 * 3);
  studio_finish(&s);
  celspan_context_destroy(s.context);
}

static celspan_status pass_over(void *user, celspan_context *context, int32_t y,
                                const celspan_span *spans, size_t count) {
  (void)user, (void)context, (void)y, (void)spans, (void)count;
  return CELSPAN_OK;
}

/* Rows that wait in strips are spans, where codes have no room. */
static void check_wide(void) {
  enum { WIDE = 200000 };
  memory_watch watch = {0};
  static studio s;
  s.context = context_of(&watch, 8 << 20);
  shot now = begin_shot();
  plain(&s, &now);
  celspan_exposure exposure = {rostrum_of(&s, &now), 1};
  celspan_frame_desc frame = studio_frame(&exposure, 1, WIDE, HEIGHT, NULL);
  celspan_statistics statistics = CELSPAN_STATISTICS;
  celspan_sink sink = {sizeof sink, NULL, begin_own, pass_over, end_own, false};
  now.coding.depth = CELSPAN_DEPTH_8_DITHER;
  cs_coder coder = cs_coder_of(&now.coding, 0, 0);
  coder.coding.space = frame.space;
  frame.workers = 2;
  studio_check(&s, cs_coder_sink(s.context, &coder, &sink));
  studio_check(&s, cs_frame_render_own(s.context, &frame, &sink, &statistics));
  CHECK(statistics.peak_bytes < (size_t)WIDE * HEIGHT);
  studio_finish(&s);
  celspan_context_destroy(s.context);
}

/* Where everything is freed after each frame, nothing is copied. */
static void check_trimmed(void) {
  memory_watch watch = {0};
  static studio s;
  static float pixels[4 * PIXELS];
  s.context = context_of(&watch, 64 << 20);
  for (int k = 0; k < 4; k++) {
    shot now = begin_shot();
    plain(&s, &now);
    CHECK(draw(&s, &now, 1, pixels) == 0);
    studio_finish(&s);
    cs_context_trim(s.context);
  }
  CHECK(cs_held_count(s.context).made == 0);
  celspan_context_destroy(s.context);
}

/* A copy that is given up in the first rows of a band is not taken up again in its last ones. */
static void check_given_up_copies(void) {
  memory_watch watch = {0};
  static studio s, bare;
  uint64_t rows = 0;
  s.context = context_of(&watch, 1 << 17);
  bare.context = context_of(&watch, 0);
  shot made = begin_shot();
  plain(&s, &made);
  made.shapes[1] = SHAPES;
  for (int k = 0; k < SHAPES; k++)
    made.objects[1][k] = studio_circle(&s, k * 1.5, 38 + k % 3, 2, ramp(&s, k));
  for (int k = 0; k < 5; k++)
    CHECK(compare(&s, &bare, &made, 1, &rows));
  CHECK(rows > 0 && rows < HEIGHT);
  studio_finish(&bare);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  celspan_context_destroy(bare.context);
}

/* A map that turns reaches its own rows. */
static void check_turning(void) {
  memory_watch watch = {0};
  static studio s;
  static float pixels[4 * PIXELS];
  s.context = context_of(&watch, 64 << 20);
  s.context->forced_way = CS_WAYS_MAPPED;
  for (int k = 0; k < 4; k++) {
    shot now = begin_shot();
    turned(&s, &now);
    now.objects[0][0] = turned_discs(&s, &now, 0.1 * k);
    uint64_t rows = draw(&s, &now, 1, pixels);
    CHECK(k < 2 ? rows == 0 : rows >= HEIGHT / 2);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
}

/* Where a blur is in all rows, and its radius grows, nothing is copied: only keys are
 * noted. */
static void check_copies(void) {
  memory_watch watch = {0};
  static studio s;
  static float pixels[4 * PIXELS];
  s.context = context_of(&watch, 64 << 20);
  for (int k = 0; k < 6; k++) {
    shot now = begin_shot();
    plain(&s, &now);
    now.objects[0][0] = studio_rect(&s, 10, -10, 50, HEIGHT + 20, NULL);
    now.cels[0].defocus_radius = 1 + 0.01 * k;
    CHECK(draw(&s, &now, 1, pixels) == 0);
    studio_finish(&s);
  }
  const cs_cache_counts counts = cs_held_count(s.context);
  CHECK(counts.bytes == 0 && counts.found == 0 && counts.made == 0);
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

/* Bands of one frame do not make each other forgotten, however many there are. */
static void check_tall(void) {
  enum { SCENES = 12, WIDE = 16, TALL = 2160 };
  memory_watch watch = {0};
  static studio s;
  static unsigned char pixels[4 * WIDE * TALL];
  s.context = context_of(&watch, 64 << 20);
  for (int k = 0; k < 3 * SCENES; k++) {
    shot now = begin_shot();
    plain(&s, &now);
    now.cels[0].opacity = 1 - k / 3 * 0.05;
    celspan_exposure exposure = {rostrum_of(&s, &now), 1};
    celspan_frame_desc frame = studio_frame(&exposure, 1, WIDE, TALL, NULL);
    celspan_statistics statistics = CELSPAN_STATISTICS;
    frame.repeats = true;
    frame.workers = 1; /* a band that two workers share is not copied */
    studio_check(&s, celspan_frame_pixels(s.context, &frame, NULL, pixels, 4 * WIDE, &statistics));
    CHECK(k % 3 < 2 || statistics.rows_held == TALL);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
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
    shot now = begin_shot();
    plain(&s, &now);
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
    shot now = begin_shot();
    plain(&s, &now);
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
    shot now = begin_shot();
    plain(&s, &now);
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
static void check_lit_alone(celspan_cel_desc cel, celspan_light back, bool is_back,
                            bool is_shaped) {
  memory_watch watch = {0};
  static studio s;
  static float held[4 * PIXELS], made[4 * PIXELS];
  s.context = context_of(&watch, 64 << 20);
  celspan_context *bare = context_of(&watch, 0);
  celspan_texture *white = studio_paint(&s, celspan_paint_rgb(1, 1, 1, 0.5f));
  celspan_object *disc = studio_circle(&s, WIDTH / 2.0, HEIGHT / 2.0, 40, white);
  if (is_shaped)
    cel.back_texture.texture = ramp(&s, 20);
  celspan_cel *lit = studio_cel(&s, cel, &disc, 1);
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.back = back;
  celspan_rostrum *rostrum = studio_rostrum(&s, desc, &lit, 1);
  cs_lit_alone alone;
  for (int k = 0; k < 2; k++)
    studio_check(&s, draw_one(s.context, rostrum, held));
  studio_check(&s, cs_lit_alone_make(s.context, rostrum, 0, is_back, &alone));
  celspan_rostrum_ref(&alone.rostrum);
  studio_check(&s, draw_one(s.context, &alone.rostrum, held));
  studio_check(&s, draw_one(bare, &alone.rostrum, made));
  CHECK(memcmp(held, made, sizeof held) == 0);
  cs_lit_alone_finish(s.context, &alone);
  studio_finish(&s);
  celspan_context_destroy(bare);
  celspan_context_destroy(s.context);
}

/* With a front light, without one, and with a back light that has a shape. */
static void check_lights_alone(void) {
  celspan_cel_desc front = CELSPAN_CEL_DESC, none = front, shaped = front;
  front.has_front = shaped.has_front = true;
  front.front = (celspan_light){0.5f, 0.2f, 0.1f, 0};
  shaped.front = (celspan_light){1, 1, 1, 0};
  shaped.back_texture = (celspan_light_texture){.gain = 0.5, .matte = 0.5};
  check_lit_alone(front, (celspan_light){0, 0, 0, 0}, false, false);
  check_lit_alone(none, (celspan_light){1, 1, 1, 0}, true, false);
  check_lit_alone(shaped, (celspan_light){0, 0, 0, 0}, false, true);
}

int main(void) {
  check_films();
  check_threads();
  if (check_is_for_threads())
    return check_done();
  check_keys();
  check_file();
  check_not_held(procedure, true);
  check_not_held(gaps, true);
  check_not_held(dashes, true);
  check_not_held(plain, false);
  check_rows();
  check_codes(64 << 20, CELSPAN_DEPTH_8_DITHER, true);
  check_codes(64 << 20, CELSPAN_DEPTH_FLOAT, false);
  check_codes(PIXELS * 4 * 10, CELSPAN_DEPTH_8_DITHER, false);
  check_wide();
  check_trimmed();
  check_given_up_copies();
  check_turning();
  check_copies();
  check_crowd();
  check_tall();
  check_given_up();
  check_memory();
  check_lights_alone();
  return check_done();
}
