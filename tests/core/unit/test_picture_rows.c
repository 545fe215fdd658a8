/* Pictures in frames: the same pixels with codes and without, with any number of workers, from
 * blocks that are clear, opaque or mixed.
 */
#include "output/sinks/pixels.h"
#include "tests/support/picture.h"
#include "tests/support/scene.h"

enum { WIDTH = 300, HEIGHT = 130 };

static uint32_t mix(uint32_t x, uint32_t y) {
  uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u;
  h = (h ^ h >> 15) * 0x2c1b3c6du;
  return h ^ h >> 13;
}

static void paint_ground(int x, int y, float rgba[4]) {
  for (uint32_t c = 0; c < 3; c++)
    rgba[c] = (float)(mix((uint32_t)x + c * 977, (uint32_t)y) & 255) / 255;
  rgba[3] = 1;
}

/* Tiles of 70 by 70: clear, opaque, translucent. */
static void paint_tiles(int x, int y, float rgba[4]) {
  int tile = (x / 70 + 2 * (y / 70)) % 3;
  paint_ground(x + 5, y + 9, rgba);
  rgba[3] = tile == 0 ? 0 : tile == 1 ? 1 : 0.25f + (float)(mix((uint32_t)x, 7) & 127) / 255;
  for (int c = 0; c < 3; c++)
    rgba[c] *= rgba[3];
}

static celspan_cel *picture_cel(studio *s, const char *file, celspan_matrix placement,
                                double opacity) {
  const celspan_picture_desc picture = {.struct_size = sizeof picture, .file = file};
  celspan_image_desc desc = {.struct_size = sizeof desc, .picture = &picture};
  celspan_object *plain = NULL, *placed = NULL;
  studio_check(s, celspan_object_create_image(s->context, &desc, &plain));
  studio_check(s, celspan_object_transform(s->context, plain, &placement, &placed));
  s->objects[s->object_count++] = plain;
  s->objects[s->object_count++] = placed;
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.objects = &placed;
  cel.object_count = 1;
  cel.opacity = opacity;
  celspan_cel *made = NULL;
  studio_check(s, celspan_cel_create(s->context, &cel, &made));
  s->cels[s->cel_count++] = made;
  return made;
}

typedef struct sheet {
  unsigned char rows[HEIGHT][4 * WIDTH];
  size_t coded, uncoded; /* pixels of arrays that are codes, and others */
  uint64_t evaluations;
} sheet;

static celspan_status take_row(void *user, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  sheet *to = user;
  (void)context;
  celspan_spans_code(NULL, spans, span_count, to->rows[y]);
  for (size_t i = 0; i < span_count; i++)
    if (spans[i].kind == CELSPAN_SPAN_ARRAY)
      *(spans[i].codes ? &to->coded : &to->uncoded) += (size_t)(spans[i].x1 - spans[i].x0);
  return CELSPAN_OK;
}

static void render(studio *s, celspan_rostrum *rostrum, int workers, bool takes_codes, sheet *to) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = studio_frame(&exposure, 1, WIDTH, HEIGHT, NULL);
  celspan_statistics statistics = CELSPAN_STATISTICS;
  celspan_sink sink = {
      .struct_size = sizeof sink, .user = to, .row = take_row, .takes_codes = takes_codes};
  desc.workers = workers;
  desc.strip_rows = 7;
  memset(to, 0, sizeof *to);
  studio_check(s, celspan_frame_render(s->context, &desc, &sink, &statistics));
  to->evaluations = statistics.colour_evaluations;
}

/* The pixels in memory, where codes may be made in their places. */
static void render_pixels(studio *s, celspan_rostrum *rostrum, int workers, sheet *to) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = studio_frame(&exposure, 1, WIDTH, HEIGHT, NULL);
  desc.workers = workers;
  memset(to->rows, 0xa5, sizeof to->rows);
  studio_check(s, celspan_frame_pixels(s->context, &desc, NULL, to->rows, sizeof *to->rows, NULL));
}

/* is_copied: the codes of pixels without any colour effect are those of the picture. */
static void check_frame(studio *s, celspan_cel **cels, size_t count, bool is_copied) {
  static sheet plain, coded;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_rostrum *rostrum = NULL;
  desc.cels = cels;
  desc.cel_count = count;
  studio_check(s, celspan_rostrum_create(s->context, &desc, &rostrum));
  s->rostrums[s->rostrum_count++] = rostrum;
  render(s, rostrum, 1, false, &plain);
  CHECK(plain.coded == 0 && plain.uncoded > 0);
  for (int workers = 1; workers <= 3; workers++) {
    render(s, rostrum, workers, true, &coded);
    CHECK(coded.coded > 50 * coded.uncoded); /* pixels of edges may be colours */
    CHECK((coded.evaluations < WIDTH * HEIGHT) == is_copied);
    CHECK(memcmp(plain.rows, coded.rows, sizeof plain.rows) == 0);
    render_pixels(s, rostrum, workers, &coded);
    CHECK(memcmp(plain.rows, coded.rows, sizeof plain.rows) == 0);
  }
}

/* Copied pictures over each other: one alone, one over an opaque one, three, and one over paper. */
static void check_copies(studio *s, const char *ground, const char *tiles) {
  celspan_cel *tile = picture_cel(s, tiles, celspan_matrix_translation(31, -14), 1);
  celspan_cel *other = picture_cel(s, tiles, celspan_matrix_translation(-57, 23), 1);
  celspan_cel *opaque = picture_cel(s, ground, celspan_matrix_translation(3, 1), 1);
  celspan_cel *const orders[][3] = {{tile, opaque, NULL},  {opaque, tile, NULL},
                                    {tile, other, opaque}, {opaque, other, tile},
                                    {other, opaque, tile}, {tile, other, NULL}};
  for (size_t i = 0; i < sizeof orders / sizeof *orders; i++) {
    celspan_cel *cels[3] = {orders[i][0], orders[i][1], orders[i][2]};
    check_frame(s, cels, cels[2] ? 3 : 2, true);
  }
}

/* A sheet of flat shapes left of a copied picture: their spans are written first. */
static void check_beside(studio *s, const char *ground) {
  celspan_paint ink = celspan_paint_rgb(0.2f, 0.5f, 0.1f, 1);
  celspan_texture *texture = NULL;
  studio_check(s, celspan_texture_create_paint(s->context, &ink, &texture));
  celspan_object *bar = studio_rect(s, 0, 0, 20.5, HEIGHT, texture);
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.objects = &bar;
  desc.object_count = 1;
  studio_check(s, celspan_cel_create(s->context, &desc, &s->cels[s->cel_count++]));
  celspan_texture_unref(texture);
  celspan_cel *beside = s->cels[s->cel_count - 1];
  celspan_cel *picture = picture_cel(s, ground, celspan_matrix_translation(21, 0), 1);
  celspan_cel *orders[2][2] = {{beside, picture}, {picture, beside}};
  for (int i = 0; i < 2; i++)
    check_frame(s, orders[i], 2, true);
}

static void check_frames(studio *s, const char *ground, const char *tiles) {
  celspan_matrix still = celspan_matrix_identity();
  celspan_cel *cels[3] = {picture_cel(s, ground, still, 1)};
  check_frame(s, cels, 1, true);
  cels[1] = picture_cel(s, tiles, celspan_matrix_translation(31, -14), 1);
  check_frame(s, cels, 2, true);
  cels[2] = picture_cel(s, tiles, celspan_matrix_scaling(1.7, 1.3), 1);
  check_frame(s, cels, 3, true);
  cels[2] = picture_cel(s, ground, celspan_matrix_rotation(0.4, (celspan_point){150, 60}), 0.5);
  check_frame(s, cels, 3, true);
  cels[0] = picture_cel(s, ground, still, 0.5); /* faded: no copy */
  check_frame(s, cels, 1, false);
  celspan_cel_desc lit = CELSPAN_CEL_DESC;
  lit.objects = &s->objects[1];
  lit.object_count = 1;
  lit.has_front = true;
  lit.front = (celspan_light){1, 0.5f, 1, 0};
  studio_check(s, celspan_cel_create(s->context, &lit, &s->cels[s->cel_count++]));
  check_frame(s, &s->cels[s->cel_count - 1], 1, false);
  lit.has_front = false;
  lit.back = (celspan_light){1, 1, 1, 1}; /* behind an opaque picture nothing shines */
  studio_check(s, celspan_cel_create(s->context, &lit, &s->cels[s->cel_count++]));
  check_frame(s, &s->cels[s->cel_count - 1], 1, true);
}

int main(void) {
  studio s = {0};
  char ground[512], tiles[512];
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  if (picture_module_or_skip(s.context)) {
    snprintf(ground, sizeof ground, "%s", picture_path("ground.png"));
    snprintf(tiles, sizeof tiles, "%s", picture_path("tiles.png"));
    studio_check(&s, picture_write(s.context, ground, NULL, WIDTH, HEIGHT, paint_ground));
    studio_check(&s, picture_write(s.context, tiles, NULL, WIDTH, HEIGHT, paint_tiles));
    check_frames(&s, ground, tiles);
    check_copies(&s, ground, tiles);
    check_beside(&s, ground);
    unlink(ground);
    unlink(tiles);
  }
  studio_finish(&s);
  celspan_context_destroy(s.context);
  return check_done();
}
