/* Rows with procedures among other shapes: spans that touch each other, and edges of shapes at the
 * ends of spans. Every pixel has the colour that the probe finds at its centre or, antialiased,
 * over its whole width.
 */
#include "tests/support/frame_rows.h"
#include "tests/support/memory.h"
#include "tests/support/probe.h"
#include "tests/support/random.h"

#define WIDTH 40
#define HEIGHT 3
#define SPANS 6
#define PARTS 16 /* probes of a pixel: edges lie between them */

/* A procedure of upright stripes. */
typedef struct stripes {
  double x[SPANS + 1];
  bool is_there[SPANS]; /* whether there is a stripe between x[i] and x[i + 1] */
  celspan_paint paints[SPANS];
} stripes;

static celspan_status play(void *user, celspan_context *context, double y,
                           const celspan_scanline_row *row, celspan_scanline_output *output) {
  const stripes *s = user;
  celspan_status status = CELSPAN_OK;
  (void)context, (void)y, (void)row;
  for (int i = 0; i < SPANS && status == CELSPAN_OK; i++)
    if (s->is_there[i])
      status = celspan_scanline_emit(output, s->x[i], s->x[i + 1], &s->paints[i], 1);
  return status;
}

/* A multiple of an eighth of a pixel: half of them lie at the middle or the edge of one. */
static double random_place(test_random *random, double low, double high) {
  double steps = random_below(random, 2) ? 8 : 2;
  return floor(random_between(random, low, high) * steps) / steps;
}

static celspan_paint random_paint(test_random *random) {
  float r = random_unit(random), g = random_unit(random), b = random_unit(random);
  return celspan_paint_rgb(r, g, b, 0.3f + 0.7f * random_unit(random));
}

static celspan_object *random_stripes(studio *s, test_random *random, stripes *out) {
  celspan_scanline_desc desc = {.struct_size = sizeof desc,
                                .bounds = {-50, -1, 200, HEIGHT + 2},
                                .spans = play,
                                .user = out,
                                .any_thread = true};
  out->x[0] = random_place(random, -4, 8);
  for (int i = 0; i < SPANS; i++) {
    out->x[i + 1] = out->x[i] + 0.125 + random_place(random, 0, 10);
    out->is_there[i] = random_below(random, 4) > 0;
    out->paints[i] = random_paint(random);
  }
  return studio_scanline(s, &desc);
}

/* A rectangle over the whole height, of which one edge or both lie where a stripe ends. */
static celspan_object *random_rect(studio *s, test_random *random, const stripes *others) {
  double x0 = random_place(random, -2, 20), width = 0.125 + random_place(random, 0, 25);
  if (random_below(random, 3) > 0)
    x0 = others->x[random_below(random, SPANS + 1)];
  return studio_rect(s, x0, -10, width, 30, studio_paint(s, random_paint(random)));
}

static void check_rows(studio *s, celspan_rostrum *rostrum, celspan_antialias_mode mode,
                       int number) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = studio_frame(&exposure, 1, WIDTH, HEIGHT, &mode);
  frame_rows rows;
  double worst = 0;
  int parts = mode == CELSPAN_ANTIALIAS_NONE ? 1 : PARTS;
  frame_rows_open(&rows, s, &desc);
  const cs_row *row = worker_row(&rows.worker, 1);
  for (size_t i = 0; i < row->count; i++)
    for (int32_t x = row->spans[i].x0; x < row->spans[i].x1; x++) {
      double sum[4] = {0}, probed[4];
      float rgba[4];
      celspan_span_colour(&row->spans[i], x, rgba);
      for (int k = 0; k < parts; k++) {
        celspan_point at = {x + (k + 0.5) / parts, 1.5};
        studio_check(s, probe_film(s->context, &exposure, 1, WIDTH, HEIGHT, at, probed));
        for (int c = 0; c < 4; c++)
          sum[c] += probed[c] / parts;
      }
      for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs(sum[c] - (double)rgba[c]));
    }
  if (!CHECK_NEAR(worst, 0, 1e-6))
    fprintf(stderr, "  scene %d, mode %d\n", number, (int)mode);
  frame_rows_close(&rows);
}

int main(void) {
  static studio s;
  memory_watch watch = {0};
  test_random random = {3};
  s.context = memory_watch_context(&watch);
  for (int k = 0; k < 150; k++) {
    stripes some, others;
    celspan_object *objects[6];
    objects[1] = random_stripes(&s, &random, &some);
    objects[4] = random_stripes(&s, &random, &others);
    for (int i = 0; i < 6; i++)
      if (i != 1 && i != 4)
        objects[i] = random_rect(&s, &random, i % 2 ? &some : &others);
    celspan_cel *cel = studio_cel(&s, CELSPAN_CEL_DESC, objects, 6);
    celspan_rostrum *rostrum = studio_rostrum(&s, CELSPAN_ROSTRUM_DESC, &cel, 1);
    check_rows(&s, rostrum, CELSPAN_ANTIALIAS_NONE, k);
    check_rows(&s, rostrum, CELSPAN_ANTIALIAS_AREA, k);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  return check_done();
}
