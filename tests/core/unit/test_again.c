/* A row that failed for lack of memory, made again, is the same as if it had not failed: the worker
 * keeps no state of the failed attempt.
 */
#include "frames/render/row_worker.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

#define WIDTH 96
#define HEIGHT 6
#define SHAPES 40

typedef float sheet[HEIGHT][WIDTH][4];

static void take(const cs_row *row, float (*out)[4]) {
  for (size_t i = 0; i < row->count; i++)
    for (int32_t x = row->spans[i].x0; x < row->spans[i].x1; x++)
      celspan_span_colour(&row->spans[i], x, out[x]);
}

/* Triangles that cross in every row, half of them with a gradient. */
static celspan_rostrum *make_scene(studio *s) {
  celspan_object *objects[SHAPES];
  test_random random = {8};
  for (int i = 0; i < SHAPES; i++) {
    celspan_point corners[3];
    float red = random_unit(&random), blue = random_unit(&random);
    const celspan_stop stops[2] = {{0, celspan_paint_rgb(red, 0.5f, blue, 0.8f)},
                                   {1, celspan_paint_rgb(blue, 1, red, 0.6f)}};
    for (int k = 0; k < 3; k++)
      corners[k] = random_point(&random, -10, WIDTH + 10, -HEIGHT, 2 * HEIGHT);
    celspan_texture *texture = i % 2 ? studio_paint(s, stops[0].paint)
                                     : studio_linear(s, corners[0], corners[1], stops, 2);
    objects[i] = studio_polygon(s, corners, 3, CELSPAN_RULE_NONZERO, texture);
  }
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, objects, SHAPES);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

static void begin(studio *s, celspan_rostrum *rostrum, celspan_antialias_mode mode, cs_frame *frame,
                  cs_row_worker *worker) {
  celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  desc.exposures = &exposure;
  desc.exposure_count = 1;
  desc.film_width = desc.width = WIDTH;
  desc.film_height = desc.height = HEIGHT;
  desc.has_antialias = true;
  desc.antialias = mode;
  studio_check(s, cs_frame_create(s->context, &desc, frame));
  studio_check(s, cs_row_worker_init(worker, s->context, frame));
}

/* Makes all rows, each as often as it fails; returns the number of failures. */
static int make_rows(cs_row_worker *worker, sheet out) {
  int failures = 0;
  for (int32_t y = 0; y < HEIGHT; y++) {
    const cs_row *row = NULL;
    celspan_status status = cs_row_worker_row(worker, y, &row);
    if (status == CELSPAN_NO_MEMORY) {
      failures++;
      status = cs_row_worker_row(worker, y, &row);
    }
    if (CHECK(status == CELSPAN_OK))
      take(row, out[y]);
  }
  return failures;
}

/* Every allocation of the rows fails once. */
static void check_mode(studio *s, memory_watch *watch, celspan_rostrum *rostrum,
                       celspan_antialias_mode mode) {
  static sheet wanted, made;
  int failures = 1, wrong = 0, tried = 0;
  for (size_t n = 0; failures > 0; n++) {
    cs_frame frame = {0};
    cs_row_worker worker = {0};
    begin(s, rostrum, mode, &frame, &worker);
    watch->fail_at = n > 0 ? watch->allocations + n : 0;
    memset(made, 0, sizeof made);
    int failed = make_rows(&worker, n > 0 ? made : wanted);
    watch->fail_at = 0;
    failures = n > 0 ? failed : 1;
    wrong += n > 0 && memcmp(made, wanted, sizeof made) != 0;
    tried += failed;
    cs_row_worker_finish(&worker);
    cs_frame_free(&frame, s->context->memory);
  }
  if (!CHECK(wrong == 0 && tried > 10))
    fprintf(stderr, "  mode %d: %d of %d rows\n", (int)mode, wrong, tried);
}

int main(void) {
  static studio s;
  memory_watch watch = {0};
  s.context = memory_watch_context(&watch);
  if (!CHECK(s.context != NULL))
    return check_done();
  celspan_rostrum *rostrum = make_scene(&s);
  check_mode(&s, &watch, rostrum, CELSPAN_ANTIALIAS_NONE);
  check_mode(&s, &watch, rostrum, CELSPAN_ANTIALIAS_AREA);
  check_mode(&s, &watch, rostrum, CELSPAN_ANTIALIAS_FILTER);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
