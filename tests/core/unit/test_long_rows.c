/* Rows longer than the part processed at a time are the same as seen through narrow frames.
 *
 *     +--------------------------------------------+
 *     |            ____....----^^^^^^-----....____ |    one row, which nearly flat edges cross over
 *     +--------------------------------------------+    hundreds of columns
 *     |   0    |   1    |   2    |   3    |   4         the same columns of several frames
 */
#include <stdlib.h>

#include "tests/support/frame_rows.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"

#define WIDTH 720
#define HEIGHT 5
#define PART 60 /* columns of a narrow frame: a divisor of WIDTH */
#define OBJECTS 8

/* ---------------------------------------------------------------- scenes */

typedef enum fill { FLAT, RAMPS, BOTH } fill;

static celspan_texture *random_texture(studio *s, test_random *random, bool is_ramp) {
  celspan_stop stops[2];
  for (int i = 0; i < 2; i++) {
    float r = random_unit(random), g = random_unit(random), b = random_unit(random);
    float a = 0.4f + 0.6f * random_unit(random);
    stops[i] = (celspan_stop){i, celspan_paint_rgb(r, g, b, a)};
  }
  return is_ramp ? studio_linear(s, (celspan_point){0, 0}, (celspan_point){WIDTH, 2}, stops, 2)
                 : studio_paint(s, stops[0].paint);
}

/* Slivers, some of them longer than the row; a vertical post and a horizontal bar. */
static void random_slivers(studio *s, uint64_t seed, fill kind, celspan_object *objects[OBJECTS]) {
  test_random random = {seed};
  for (int k = 0; k < OBJECTS; k++) {
    celspan_texture *texture =
        random_texture(s, &random, kind == RAMPS || (kind == BOTH && k % 2 == 0));
    double x = random_between(&random, -100, 400), length = random_between(&random, 250, 800);
    double y = random_between(&random, 0, HEIGHT);
    celspan_point points[3];
    for (int i = 0; i < 3; i++)
      points[i] = (celspan_point){x + 0.5 * i * length, y + random_between(&random, -0.7, 0.7)};
    objects[k] = k < 6    ? studio_polygon(s, points, 3, CELSPAN_RULE_NONZERO, texture)
                 : k == 6 ? studio_rect(s, x + 150, -10, 30 + 0.1 * length, 30, texture)
                          : studio_rect(s, -300, y, 2 * WIDTH, 1.6, texture);
  }
}

/* How the slivers are seen. */
typedef struct setting {
  uint64_t seed;
  fill kind;
  celspan_antialias_mode mode;
  celspan_filter_desc filter;
  double defocus;
  celspan_defocus_kernel defocus_kernel;
} setting;

/* The slivers, `shift` columns farther left. */
static celspan_rostrum *show(studio *s, const setting *seen, int32_t shift) {
  celspan_object *objects[OBJECTS];
  random_slivers(s, seen->seed, seen->kind, objects);
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.defocus_radius = seen->defocus;
  desc.defocus_kernel = seen->defocus_kernel;
  celspan_matrix matrix = celspan_matrix_translation(-shift, 0);
  for (int k = 0; k < OBJECTS; k++)
    objects[k] = studio_transform(s, objects[k], matrix);
  celspan_cel *cel = studio_cel(s, desc, objects, OBJECTS);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

/* ---------------------------------------------------------------- pictures */

typedef float pixels[HEIGHT][WIDTH][4];

/* The colours of a row that has them in every column, once. */
static void read_row(const cs_row *row, int32_t width, float (*out)[4]) {
  int32_t x = 0;
  for (size_t i = 0; i < row->count; i++) {
    CHECK(row->spans[i].x0 == x && row->spans[i].x1 > x);
    x = row->spans[i].x1;
  }
  CHECK(x == width);
  row_colours(row, out);
}

/* Makes the columns from x on by a frame that is `width` wide. */
static void make(studio *s, const setting *seen, int32_t x, int32_t width, pixels out) {
  celspan_exposure exposure = {show(s, seen, x), 1};
  celspan_frame_desc desc = studio_frame(&exposure, 1, width, HEIGHT, &seen->mode);
  desc.filter = &seen->filter;
  frame_rows rows;
  frame_rows_open(&rows, s, &desc);
  for (int32_t y = 0; y < HEIGHT; y++)
    read_row(worker_row(&rows.worker, y), width, out[y] + x);
  frame_rows_close(&rows);
  studio_finish(s);
}

/* The allowed difference. The chords of defocus kernels, and the straight gradients into which
 * spans are divided, begin elsewhere in a narrow frame; everything else differs by rounding
 * only. */
static double bound_of(const setting *seen) {
  if (seen->defocus > 0)
    return 0.004;
  return seen->mode == CELSPAN_ANTIALIAS_NONE && seen->kind != FLAT ? 1.0 / 1023 : 1e-5;
}

static void compare(studio *s, setting seen) {
  static pixels whole, parts;
  double worst = 0;
  make(s, &seen, 0, WIDTH, whole);
  for (int32_t x = 0; x < WIDTH; x += PART)
    make(s, &seen, x, PART, parts);
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++)
      for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs((double)whole[y][x][c] - (double)parts[y][x][c]));
  if (!CHECK_NEAR(worst, 0, bound_of(&seen)))
    fprintf(stderr, "  seed %d, fill %d, mode %d, kernel %d, defocus %g, %d\n", (int)seen.seed,
            (int)seen.kind, (int)seen.mode, (int)seen.filter.kernel, seen.defocus,
            (int)seen.defocus_kernel);
}

/* ---------------------------------------------------------------- what is seen through */

static void check_modes(studio *s) {
  for (uint64_t seed = 1; seed <= 3; seed++)
    for (int kind = FLAT; kind <= BOTH; kind++) {
      compare(s, (setting){.seed = seed, .kind = (fill)kind, .mode = CELSPAN_ANTIALIAS_NONE});
      compare(s, (setting){.seed = seed, .kind = (fill)kind, .mode = CELSPAN_ANTIALIAS_AREA});
    }
}

static void check_filters(studio *s) {
  for (int kind = FLAT; kind <= BOTH; kind++)
    for (int kernel = 0; kernel < 4; kernel++)
      compare(s, (setting){.seed = 4,
                           .kind = (fill)kind,
                           .mode = CELSPAN_ANTIALIAS_FILTER,
                           .filter = {.struct_size = sizeof(celspan_filter_desc),
                                      .kernel = (celspan_kernel)kernel,
                                      .rows = 16}});
}

static void check_defocus(studio *s) {
  static const double radii[] = {0.7, 2.3, 11};
  for (int k = 0; k < 9; k++)
    for (int kind = FLAT; kind <= BOTH; kind++)
      compare(s, (setting){.seed = 5 + (uint64_t)k,
                           .kind = (fill)kind,
                           .mode = CELSPAN_ANTIALIAS_AREA,
                           .defocus = radii[k % 3],
                           .defocus_kernel = (celspan_defocus_kernel)(k / 3)});
}

int main(void) {
  static studio s;
  memory_watch watch = {0};
  s.context = memory_watch_context(&watch);
  check_modes(&s);
  check_filters(&s);
  check_defocus(&s);
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  return check_done();
}
