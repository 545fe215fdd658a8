/* Very many dashes: they are not stored, and a frame that shows too many to be made at once is made
 * of panes, whose pixels are those of a frame made as a whole.
 */
#include <math.h>
#include <string.h>

#include "frames/render/row_worker.h"
#include "tests/support/frame_rows.h"
#include "tests/support/memory.h"

#define WIDTH 800
#define HEIGHT 6

static celspan_object *dashed(studio *s, const char *data, double width, celspan_stroke_cap cap,
                              double drawn, double left_out) {
  const double dashes[] = {drawn, left_out};
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.data = data;
  desc.width = width;
  desc.cap = cap;
  desc.dashes = dashes;
  desc.dash_count = 2;
  celspan_object *made = NULL;
  studio_check(s, celspan_object_create_stroke(s->context, &desc, &made));
  return s->objects[s->object_count++] = made;
}

static celspan_frame_desc frame_of(const celspan_exposure *exposures, size_t count) {
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  desc.exposures = exposures;
  desc.exposure_count = count;
  desc.film_width = desc.width = WIDTH;
  desc.film_height = desc.height = HEIGHT;
  desc.workers = 1;
  return desc;
}

/* ---------------------------------------------------------------- memory */

static size_t held(celspan_context *context) {
  size_t bytes, peak;
  uint64_t allocations;
  celspan_context_memory(context, &bytes, &peak, &allocations);
  return bytes;
}

static void test_stored(studio *s) {
  size_t before = held(s->context);
  celspan_object *line = dashed(s, "M0 5H1000000", 1, CELSPAN_STROKE_CAP_BUTT, 0.6, 0.4);
  CHECK(line && line->data->stroke->part_count == 1000000);
  CHECK(held(s->context) - before < 4096);
}

typedef float sheet[HEIGHT][WIDTH][4];

static celspan_statistics render(studio *s, const celspan_frame_desc *desc, void *out,
                                 size_t stride) {
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_FLOAT,
                                 .transfer = CELSPAN_TRANSFER_LINEAR,
                                 .alpha = CELSPAN_ALPHA_PREMULTIPLIED};
  celspan_statistics statistics = CELSPAN_STATISTICS;
  studio_check(s, celspan_frame_pixels(s->context, desc, &coding, out, stride, &statistics));
  return statistics;
}

/* Of a million dashes few are in the frame, and they alone take memory. */
static void test_out_of_sight(studio *s) {
  celspan_exposure exposure = {
      studio_show(s, dashed(s, "M-499990 5L500000 6", 1, CELSPAN_STROKE_CAP_BUTT, 0.6, 0.4)), 1};
  celspan_frame_desc desc = frame_of(&exposure, 1);
  sheet made;
  size_t peak = render(s, &desc, made, sizeof made[0]).peak_bytes;
  if (!CHECK(peak < 4 << 20))
    fprintf(stderr, "  %zu bytes\n", peak);
  CHECK(made[5][12][3] > 0.1f);
}

/* 110,000 dashes on a row, and the same down a column: at most 100 bytes for each. Each pixel that
 * they are in is covered by their share of the line. */
static void test_in_sight(studio *s) {
  for (int k = 0; k < 2; k++) {
    celspan_object *line = dashed(s, k == 0 ? "M0 .5H100" : "M.5 0V100", 1, CELSPAN_STROKE_CAP_BUTT,
                                  100 / 165000.0, 100 / 330000.0);
    size_t count = line->data->stroke->part_count;
    celspan_exposure exposure = {studio_show(s, line), 1};
    celspan_frame_desc desc = frame_of(&exposure, 1);
    desc.film_width = desc.width = k == 0 ? 100 : 1;
    desc.film_height = desc.height = k == 0 ? 1 : 100;
    float made[100][4];
    size_t peak = render(s, &desc, made, (size_t)desc.width * sizeof made[0]).peak_bytes;
    if (!CHECK(count >= 110000 && peak < 100 * count))
      fprintf(stderr, "  %zu bytes for %zu dashes\n", peak, count);
    for (int i = 0; i < 100; i++)
      CHECK_NEAR(made[i][3], 2.0 / 3, 1e-3);
  }
}

/* ---------------------------------------------------------------- pixels */

/* On a row there are more dashes than a pane may have, but nowhere so many that their mean is not
 * exact. */
static celspan_rostrum *crowd(studio *s) {
  celspan_object *objects[] = {
      studio_circle(s, 300, 2, 5, studio_paint(s, celspan_paint_rgb(1, 0.5f, 0, 0.5f))),
      dashed(s, "M-3 2.3H810", 0.8, CELSPAN_STROKE_CAP_BUTT, 0.1, 0.06),
      dashed(s, "M1 4.2H790", 0.5, CELSPAN_STROKE_CAP_SQUARE, 0.1, 0.7),
      dashed(s, "M620 1V9", 2, CELSPAN_STROKE_CAP_BUTT, 0.04, 0.03),
      dashed(s, "M2 2C900 1 -100 6 799 5Z", 0.3, CELSPAN_STROKE_CAP_ROUND, 2, 1),
      dashed(s, "M400 3 l1 1 l1 -1 l1 1 l1 -1 l1 1 l1 -1z", 0.3, CELSPAN_STROKE_CAP_BUTT, 0.9,
             0.1)};
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, objects, 6);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

/* Makes the rows of a frame: as it is, or as a whole although it is crowded. */
static void make(studio *s, const celspan_frame_desc *desc, bool as_whole, sheet out) {
  frame_rows rows = {.context = s->context};
  studio_check(s, cs_frame_create(s->context, desc, &rows.frame));
  CHECK(rows.frame.is_crowded);
  if (as_whole) {
    cs_view view = rows.frame.view;
    view.most_dashes = SIZE_MAX;
    studio_check(s, cs_frame_compile(s->context, &rows.frame, &view, 1, rows.frame.plans,
                                     &rows.frame.is_crowded));
  }
  studio_check(s, cs_row_worker_init(&rows.worker, s->context, &rows.frame));
  memset(out, 0, sizeof(sheet));
  for (int32_t y = 0; y < rows.frame.crop_height; y++) {
    const cs_row *row = worker_row(&rows.worker, y);
#ifdef CELSPAN_CHECKS
    CHECK(cs_row_is_whole(row, rows.frame.crop_width));
#endif
    row_colours(row, out[y]);
  }
  CHECK(cs_row_worker_evaluations(&rows.worker) > 0);
  frame_rows_close(&rows);
}

static double difference(sheet a, sheet b) {
  double most = 0;
  for (int i = 0; i < HEIGHT * WIDTH * 4; i++) {
    int y = i / (WIDTH * 4), x = i / 4 % WIDTH;
    most = fmax(most, fabs((double)a[y][x][i % 4] - (double)b[y][x][i % 4]));
  }
  return most;
}

/* Means are sums along a row, which begin elsewhere in a pane, so their last bits differ. */
static void test_panes(studio *s) {
  celspan_rostrum *rostrum = crowd(s);
  celspan_rostrum *moved =
      studio_show(s, dashed(s, "M0 4H800", 3, CELSPAN_STROKE_CAP_BUTT, 0.07, 0.1));
  const celspan_exposure exposures[] = {{rostrum, 1}, {rostrum, 0.5}, {moved, 0.5}};
  static sheet whole, panes;
  for (int k = 0; k < 8; k++) {
    if (!check_is_drawn(k))
      continue;
    celspan_antialias_mode mode = (celspan_antialias_mode)(k % 3);
    celspan_frame_desc desc = k < 6 ? frame_of(exposures, 1) : frame_of(exposures + 1, 2);
    desc.has_antialias = true;
    desc.antialias = mode;
    if (k >= 3) {
      desc.crop_x = 3;
      desc.crop_y = 1;
      desc.crop_width = 650;
      desc.crop_height = 4;
    }
    make(s, &desc, true, whole);
    make(s, &desc, false, panes);
    double most = difference(whole, panes);
    if (!CHECK(mode == CELSPAN_ANTIALIAS_NONE && k < 6 ? most == 0 : most < 1e-6))
      fprintf(stderr, "  case %d: %g\n", k, most);
  }
}

/* Two lines of so many dashes that hundreds of their edges cross in a pixel: the means are not
 * exact, and every row is divided into columns. */
static celspan_rostrum *dense(studio *s) {
  celspan_object *objects[] = {
      dashed(s, "M99.3 2.5L113.1 3.5", 14, CELSPAN_STROKE_CAP_BUTT, 0.0013, 0.0018),
      dashed(s, "M99.3 3.5L113.1 2.5", 14, CELSPAN_STROKE_CAP_BUTT, 0.0011, 0.002)};
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, objects, 2);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

/* How much a crop differs from that part of a frame. */
static double difference_of_crop(sheet whole, sheet part, const celspan_frame_desc *desc) {
  double most = 0;
  for (int i = 0; i < desc->crop_width * desc->crop_height * 4; i++) {
    int y = i / (desc->crop_width * 4), x = i / 4 % desc->crop_width;
    const float *wanted = whole[desc->crop_y + y][desc->crop_x + x];
    most = fmax(most, fabs((double)part[y][x][i % 4] - (double)wanted[i % 4]));
  }
  return most;
}

/* A crop equals that part of the frame also where the mean of a pixel depends on the edges beside
 * it: a row is divided into columns in the same way by every crop. */
static void test_crops(studio *s) {
  const celspan_exposure exposure = {dense(s), 1};
  static const int32_t crops[][4] = {{0, 1, 800, 1}, {103, 2, 600, 2}};
  static sheet whole, part;
  for (int k = 0; k < 3; k++) {
    if (!check_is_drawn(k))
      continue;
    celspan_antialias_mode mode = (celspan_antialias_mode)k;
    celspan_frame_desc desc = frame_of(&exposure, 1);
    desc.has_antialias = true;
    desc.antialias = mode;
    (void)render(s, &desc, whole, sizeof whole[0]);
    for (size_t i = 0; i < sizeof crops / sizeof crops[0]; i++) {
      desc.crop_x = crops[i][0];
      desc.crop_y = crops[i][1];
      desc.crop_width = crops[i][2];
      desc.crop_height = crops[i][3];
      (void)render(s, &desc, part, sizeof part[0]);
      double most = difference_of_crop(whole, part, &desc);
      if (!CHECK(mode == CELSPAN_ANTIALIAS_NONE ? most == 0 : most <= 1.0 / 65535))
        fprintf(stderr, "  mode %d, crop %zu: %g\n", k, i, most);
    }
  }
}

/* ---------------------------------------------------------------- without memory */

/* Where an allocation fails the row fails, and the next call makes it. */
static void test_memory(studio *s, memory_watch *watch) {
  const celspan_exposure exposure = {crowd(s), 1};
  celspan_frame_desc desc = frame_of(&exposure, 1);
  static sheet wanted, made;
  make(s, &desc, false, wanted);
  frame_rows rows;
  frame_rows_open(&rows, s, &desc);
  int failures = 0;
  memset(made, 0, sizeof made);
  for (int32_t y = 0; y < HEIGHT; y++) {
    const cs_row *row;
    watch->fail_at = watch->allocations + 1 + (size_t)(37 * y);
    if (cs_row_worker_row(&rows.worker, y, &row) == CELSPAN_NO_MEMORY)
      failures++;
    watch->fail_at = 0;
    row_colours(worker_row(&rows.worker, y), made[y]);
  }
  frame_rows_close(&rows);
  CHECK(failures > 3 && memcmp(wanted, made, sizeof made) == 0);
}

int main(void) {
  static studio s;
  memory_watch watch = {0};
  s.context = memory_watch_context(&watch);
  if (!CHECK(s.context != NULL))
    return check_done();
  test_stored(&s);
  test_out_of_sight(&s);
  test_in_sight(&s);
  test_panes(&s);
  test_crops(&s);
  test_memory(&s, &watch);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
