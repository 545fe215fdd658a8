/* Rows of flat cells, one after another: the parts reused from the row above are right. Bars begin
 * and end on the way down, so that in most rows a few of many cells change; every pixel has the
 * colour that the probe finds at its centre. A row that is requested again is the same.
 */
#include "tests/support/frame_rows.h"
#include "tests/support/probe.h"
#include "tests/support/random.h"

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
      studio_check(s, probe_film(s->context, exposure, 1, WIDTH, HEIGHT, at, probed));
      for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs(probed[c] - (double)rgba[c]));
    }
  return worst;
}

static void check_scene(studio *s, celspan_rostrum *rostrum, int number) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_antialias_mode mode = CELSPAN_ANTIALIAS_NONE;
  celspan_frame_desc desc = studio_frame(&exposure, 1, WIDTH, HEIGHT, &mode);
  frame_rows rows;
  double worst = 0;
  frame_rows_open(&rows, s, &desc);
  for (int32_t y = 0; y < HEIGHT; y++)
    worst = fmax(worst, error_of(s, &exposure, worker_row(&rows.worker, y), y));
  if (!CHECK_NEAR(worst, 0, 1e-6))
    fprintf(stderr, "  scene %d\n", number);
  frame_rows_close(&rows);
}

static void check_again(studio *s, celspan_rostrum *rostrum) {
  static float first[WIDTH][4], again[WIDTH][4];
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = studio_frame(&exposure, 1, WIDTH, HEIGHT, NULL);
  frame_rows rows;
  frame_rows_open(&rows, s, &desc);
  for (int32_t y = 0; y < HEIGHT; y += 3) {
    memset(first, 0, sizeof first);
    memset(again, 0, sizeof again);
    row_colours(worker_row(&rows.worker, y), first);
    row_colours(worker_row(&rows.worker, y), again);
    CHECK(memcmp(first, again, sizeof first) == 0);
  }
  frame_rows_close(&rows);
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
