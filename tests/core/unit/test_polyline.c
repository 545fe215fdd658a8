/* Polylines compared with their curves in every pixel: the area right of the polyline that the
 * sweep walks, and the area right of the curve. The curve is the same outline walked FINE times as
 * large, whose polyline has an error FINE times smaller.
 *
 *      +--------+        ###: between the curve and the polyline, in this pixel
 *      |  `.    |
 *      |   #`.  |        within a row the polyline goes straight from one vertex, or whole height,
 *      |    ##`.|        to the next
 *      +--------+
 *
 * And outlines pressed flat, whose vertices must stay between the ends of their chains. Random
 * cases are numbered by their seed.
 */
#include <stdlib.h>

#include "model/geometry/boundary_build.h"
#include "model/geometry/boundary_walk.h"
#include "model/geometry/matrix.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

enum { SIDE = 64, FINE = 16, CASES = 400 };

#define CODES 255.0
/* The allowed error of a pixel, with one opaque shape: less than the 2 of antialiasing by area,
 * because several shapes may meet in a pixel. */
#define MOST 1.9
#define RMS 0.45 /* of all pixels that an edge crosses */

static celspan_context *context;

#define MUST(call)                                                                                 \
  do {                                                                                             \
    if ((call) != CELSPAN_OK) {                                                                    \
      CHECK(!"the call " #call " succeeds");                                                       \
      fprintf(stderr, "%s\n", celspan_context_error(context));                                     \
    }                                                                                              \
  } while (0)

/* ---------------------------------------------------------------- random outlines */

/* Closed cubic splines through 4 to 7 points, ellipses, and both kinds of path. */
static void random_outline(test_random *random, double size, cs_outline *outline) {
  celspan_point centre = random_point(random, 0, SIDE, 0, SIDE), points[7];
  double rx = random_between(random, 0.05, 1) * size, ry = random_between(random, 0.05, 1) * size;
  int count = 4 + random_below(random, 4);
  celspan_nurbs_desc spline = {.struct_size = sizeof spline,
                               .points = points,
                               .point_count = (size_t)count,
                               .degree = 2 + random_below(random, 2),
                               .closure = CELSPAN_NURBS_PERIODIC};
  cs_outline_init(outline);
  for (int i = 0; i < count; i++) {
    celspan_point away = random_point(random, -size, size, -size, size);
    points[i] = (celspan_point){centre.x + away.x, centre.y + away.y};
  }
  if (random_below(random, 3) == 0)
    MUST(cs_outline_ellipse(context, outline, centre, rx, ry));
  else
    MUST(cs_outline_nurbs(context, outline, &spline));
}

/* A third of the matrices have a little perspective. */
static celspan_matrix random_matrix(test_random *random) {
  celspan_point middle = {0.5 * SIDE, 0.5 * SIDE};
  celspan_matrix matrix = celspan_matrix_rotation(random_between(random, -180, 180), middle);
  if (random_below(random, 3) == 0) {
    matrix.m[6] = random_between(random, -0.003, 0.003);
    matrix.m[7] = random_between(random, -0.003, 0.003);
  }
  return matrix;
}

/* ---------------------------------------------------------------- areas */

/* The sums for an outline: the signed area of each pixel right of its chains. */
typedef struct areas {
  double pixels[SIDE][SIDE];
  bool is_crossed[SIDE][SIDE];
} areas;

static double passed(double low, double high, double x) {
  return x <= low    ? 0
         : x >= high ? (x - high) + 0.5 * (high - low)
                     : (x - low) * (x - low) / (2 * (high - low));
}

/* A line inside a row. */
static void add_line(areas *sum, celspan_point top, celspan_point foot, double sign) {
  double low = fmin(top.x, foot.x), high = fmax(top.x, foot.x), height = foot.y - top.y;
  double middle = 0.5 * (top.y + foot.y);
  int row = middle >= 0 && middle < SIDE ? (int)middle : -1;
  for (int p = 0; p < SIDE && height > 0 && row >= 0; p++) {
    double share = high - low > 1e-9 ? passed(low, high, p + 1) - passed(low, high, p)
                                     : fmin(fmax(p + 1 - low, 0), 1);
    sum->pixels[row][p] += sign * height * share;
    sum->is_crossed[row][p] |= low < p + 1 && high > p;
  }
}

/* A line, cut at whole heights; the parts outside the rows do not matter. */
static void add_lines(areas *sum, celspan_point top, celspan_point foot, double sign) {
  celspan_point above = top;
  for (double y = floor(fmax(top.y, -1)) + 1; y < fmin(foot.y, SIDE + 1); y++) {
    celspan_point at = {top.x + (foot.x - top.x) * (y - top.y) / (foot.y - top.y), y};
    add_line(sum, above, at, sign);
    above = at;
  }
  add_line(sum, above, foot, sign);
}

/* A segment of a walk, straight from one of its rows to the next; scale: of the walk. */
static celspan_point add_segment(areas *sum, const cs_boundary_walk *walk, celspan_point from,
                                 double scale, double sign) {
  double first = floor(fmax(from.y, -1) * scale) + 1, last = fmin(walk->y1, (SIDE + 1) * scale);
  for (double y = first; y < last; y++) {
    celspan_point at = {cs_boundary_x(walk, y) / scale, y / scale};
    add_lines(sum, from, at, sign);
    from = at;
  }
  celspan_point foot = {walk->x1 / scale, walk->y1 / scale};
  if (foot.y <= from.y)
    return from;
  add_lines(sum, from, foot, sign);
  return foot;
}

static void add_outline(areas *sum, const cs_outline *outline, const celspan_matrix *matrix,
                        double scale, double sign) {
  cs_boundary_set set;
  cs_boundary_builder builder;
  cs_boundary_frame frame = {0, SIDE * scale, 0, SIDE * scale};
  celspan_matrix scaled = celspan_matrix_then(*matrix, celspan_matrix_scaling(scale, scale));
  cs_boundary_init(&set);
  cs_boundary_builder_init(&builder, context, &set, &frame);
  MUST(cs_boundary_add(&builder, outline, &scaled, 0));
  for (uint32_t i = 0; i < set.chain_count; i++) {
    const cs_boundary_chain *chain = &set.chains[i];
    celspan_point at = {chain->x0 / scale, chain->y0 / scale};
    cs_boundary_walk walk;
    cs_boundary_start(&set, i, chain->y0, &walk);
    do
      at = add_segment(sum, &walk, at, scale, sign * chain->direction);
    while (cs_boundary_next(&set, &walk));
  }
  cs_boundary_builder_finish(&builder);
  cs_boundary_finish(&set, context->memory);
}

/* ---------------------------------------------------------------- the judgement */

typedef struct judgement {
  double worst, square;
  size_t pixels;
} judgement;

static void judge(int seed, judgement *all) {
  static areas sum;
  test_random random = {(uint64_t)seed};
  cs_outline outline;
  double worst = 0;
  random_outline(&random, exp(random_between(&random, log(3), log(3000))), &outline);
  celspan_matrix matrix = random_matrix(&random);
  memset(&sum, 0, sizeof sum);
  add_outline(&sum, &outline, &matrix, 1, 1);
  add_outline(&sum, &outline, &matrix, FINE, -1);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (sum.is_crossed[y][x]) {
        double off = CODES * fabs(sum.pixels[y][x]);
        worst = fmax(worst, off);
        all->square += off * off;
        all->pixels++;
      }
  if (!CHECK(worst <= MOST))
    fprintf(stderr, "  case %d: a pixel is off by %g of 255\n", seed, worst);
  all->worst = fmax(all->worst, worst);
  cs_outline_finish(&outline, context->memory);
}

/* ---------------------------------------------------------------- flat ones */

/* Where every segment of a chain ends must lie between the ends of the chain. */
static void check_heights(const cs_boundary_set *set, uint32_t chain, int seed) {
  double y0 = set->chains[chain].y0, y1 = set->chains[chain].y1;
  cs_boundary_walk walk;
  cs_boundary_start(set, chain, y0, &walk);
  do {
    if (!CHECK(walk.y1 >= y0 && walk.y1 <= y1))
      fprintf(stderr, "  case %d: a chain from %.17g to %.17g has a vertex at %.17g\n", seed, y0,
              y1, walk.y1);
  } while (cs_boundary_next(set, &walk));
}

/* An outline pressed to a line, so that rounding alone gives it a height. */
static void press(int seed) {
  test_random random = {(uint64_t)seed};
  cs_outline outline;
  cs_boundary_set set;
  cs_boundary_builder builder;
  const cs_boundary_frame frame = {0, SIDE, 0, SIDE};
  double shear = random_between(&random, -1, 1), y = random_between(&random, 0, SIDE);
  const celspan_matrix pressed = {{1, shear, 0, 0x1p-54 * shear, 0x1p-53, y, 0, 0, 1}};
  random_outline(&random, SIDE, &outline);
  cs_boundary_init(&set);
  cs_boundary_builder_init(&builder, context, &set, &frame);
  MUST(cs_boundary_add(&builder, &outline, &pressed, 0));
  for (uint32_t i = 0; i < set.chain_count; i++)
    check_heights(&set, i, seed);
  cs_boundary_builder_finish(&builder);
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&outline, context->memory);
}

int main(void) {
  judgement all = {0};
  MUST(celspan_context_create(NULL, &context));
  const char *only = getenv("CASE");
  for (int seed = only ? atoi(only) : 1; seed <= (only ? atoi(only) : CASES); seed++) {
    judge(seed, &all);
    press(seed);
  }
  double rms = sqrt(all.square / (double)all.pixels);
  CHECK(rms <= RMS);
  if (getenv("CELSPAN_VERBOSE"))
    printf("%zu pixels, worst %g, rms %g of 255\n", all.pixels, all.worst, rms);
  celspan_context_destroy(context);
  return check_done();
}
