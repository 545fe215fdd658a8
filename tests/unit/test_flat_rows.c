/* Rows of flat cells, one after another: what is kept of the row above is what the row has. Bars begin
 * and end on their way down, so that in most rows a few of many cells change; every pixel has the colour
 * that the probe finds at its centre. A row that is asked for again is the same.
 */
#include "render/row_worker.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

#define WIDTH 90
#define HEIGHT 40
#define BARS 14

static celspan_object *random_bar(studio *s, test_random *random, bool is_aligned) {
  float r = random_unit(random), g = random_unit(random), b = random_unit(random);
  float alpha = random_below(random, 2) ? 1 : 0.5f;
  celspan_texture *texture = studio_paint(s, celspan_paint_rgb(r, g, b, alpha));
  double x = random_between(random, -5, WIDTH), y = random_between(random, -10, HEIGHT);
  double width = random_between(random, 1, 30), height = random_between(random, 2, 30);
  return is_aligned ? studio_rect(s, floor(x), floor(y), ceil(width), ceil(height), texture)
                    : studio_rect(s, x, y, width, height, texture);
}

static double error_of(studio *s, const celspan_exposure *exposure, const cs_row *row, int32_t y) {
  double worst = 0;
  for (size_t i = 0; i < row->count; i++)
    for (int32_t x = row->spans[i].x0; x < row->spans[i].x1; x++) {
      celspan_point at = {x + 0.5, y + 0.5};
      double probed[4];
      float rgba[4];
      celspan_span_colour(&row->spans[i], x, rgba);
      studio_check(s, celspan_probe(s->context, exposure, 1, WIDTH, HEIGHT, at, probed));
      for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs(probed[c] - (double)rgba[c]));
    }
  return worst;
}

static void check_scene(studio *s, celspan_rostrum *rostrum, int number) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_antialias_mode mode = CELSPAN_ANTIALIAS_NONE;
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  desc.exposures = &exposure;
  desc.exposure_count = 1;
  desc.film_width = desc.width = WIDTH;
  desc.film_height = desc.height = HEIGHT;
  desc.antialias = &mode;
  cs_frame frame = {0};
  cs_row_worker worker = {0};
  double worst = 0;
  studio_check(s, cs_frame_create(s->context, &desc, &frame));
  studio_check(s, cs_row_worker_init(&worker, s->context, &frame));
  for (int32_t y = 0; y < HEIGHT; y++) {
    const cs_row *row = NULL;
    if (CHECK(cs_row_worker_row(&worker, y, &row) == CELSPAN_OK))
      worst = fmax(worst, error_of(s, &exposure, row, y));
  }
  if (!CHECK_NEAR(worst, 0, 1e-6))
    fprintf(stderr, "  scene %d\n", number);
  cs_row_worker_finish(&worker);
  cs_frame_free(&frame, s->context->memory);
}

static void take_row(cs_row_worker *worker, int32_t y, float (*out)[4]) {
  const cs_row *row = NULL;
  memset(out, 0, WIDTH * sizeof *out);
  CHECK(cs_row_worker_row(worker, y, &row) == CELSPAN_OK);
  for (size_t i = 0; row && i < row->count; i++)
    for (int32_t x = row->spans[i].x0; x < row->spans[i].x1; x++)
      celspan_span_colour(&row->spans[i], x, out[x]);
}

static void check_again(studio *s, celspan_rostrum *rostrum) {
  static float first[WIDTH][4], again[WIDTH][4];
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  desc.exposures = &exposure;
  desc.exposure_count = 1;
  desc.film_width = desc.width = WIDTH;
  desc.film_height = desc.height = HEIGHT;
  cs_frame frame = {0};
  cs_row_worker worker = {0};
  studio_check(s, cs_frame_create(s->context, &desc, &frame));
  studio_check(s, cs_row_worker_init(&worker, s->context, &frame));
  for (int32_t y = 0; y < HEIGHT; y += 3) {
    take_row(&worker, y, first);
    take_row(&worker, y, again);
    CHECK(memcmp(first, again, sizeof first) == 0);
  }
  cs_row_worker_finish(&worker);
  cs_frame_free(&frame, s->context->memory);
}

int main(void) {
  static studio s;
  test_random random = {8};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 30; k++) {
    celspan_object *objects[BARS];
    for (int i = 0; i < BARS; i++)
      objects[i] = random_bar(&s, &random, k % 2 == 1);
    celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, objects, BARS);
    celspan_rostrum *rostrum = studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1);
    check_scene(&s, rostrum, k);
    check_again(&s, rostrum);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
  return check_done();
}
