/* SVG path data: what is accepted, how arcs are converted, what is refused and where.
 */
#include <stdlib.h>

#include "model/geometry/bezier.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

static celspan_context *context;

static cs_outline read_path(const char *data) {
  cs_outline outline;
  cs_outline_init(&outline);
  if (!CHECK(cs_outline_path(context, &outline, data) == CELSPAN_OK))
    fprintf(stderr, "  %s: %s\n", data, celspan_context_error(context));
  return outline;
}

/* Pieces as text, "L 1 2", "Q ...", "C ...", weights left out; contours begin with "M". */
static void describe(const cs_outline *outline, char *text, size_t size) {
  size_t used = 0, contour = 0;
  text[0] = 0;
  for (size_t i = 0; i < outline->piece_count && used + 100 < size; i++) {
    const cs_hpoint *p = outline->points + outline->starts[i];
    if (contour < outline->contour_count && outline->contours[contour] == i) {
      used += (size_t)snprintf(text + used, size - used, "M %g %g ", p->x, p->y);
      contour++;
    }
    used += (size_t)snprintf(text + used, size - used, "%c ", " LQC"[outline->degrees[i]]);
    for (int k = 1; k <= outline->degrees[i]; k++)
      used += (size_t)snprintf(text + used, size - used, "%g %g ", p[k].x, p[k].y);
  }
}

static void check_same(const char *data, const char *expected) {
  char text[4000];
  cs_outline outline = read_path(data);
  describe(&outline, text, sizeof text);
  if (!CHECK_TEXT(text, expected))
    fprintf(stderr, "  %s\n", data);
  cs_outline_finish(&outline, context->memory);
}

static void commands_draw(void) {
  check_same("", "");
  check_same(" \n", "");
  check_same("M 1 2", "");
  check_same("M1 2Z", "");
  check_same("M0 0L10 0L10 10Z", "M 0 0 L 10 0 L 10 10 L 0 0 ");
  check_same("M0 0L10 0L10 10", "M 0 0 L 10 0 L 10 10 L 0 0 ");
  check_same("M0 0 10 0 10 10", "M 0 0 L 10 0 L 10 10 L 0 0 ");
  check_same("m5 5 10 0 0 10z", "M 5 5 L 15 5 L 15 15 L 5 5 ");
  check_same("M1,1H5V6h-4", "M 1 1 L 5 1 L 5 6 L 1 6 L 1 1 ");
  check_same("M1,1H5 7v1 2", "M 1 1 L 5 1 L 7 1 L 7 2 L 7 4 L 1 1 ");
  check_same("M0 0C1 2 3 4 5 6", "M 0 0 C 1 2 3 4 5 6 L 0 0 ");
  check_same("M1 1c1 2 3 4 5 6", "M 1 1 C 2 3 4 5 6 7 L 1 1 ");
  check_same("M0 0C1 2 3 4 5 6S7 8 9 9", "M 0 0 C 1 2 3 4 5 6 C 7 8 7 8 9 9 L 0 0 ");
  check_same("M1 1S7 8 9 9", "M 1 1 C 1 1 7 8 9 9 L 1 1 ");
  check_same("M0 0Q1 2 3 3T7 8", "M 0 0 Q 1 2 3 3 Q 5 4 7 8 L 0 0 ");
  check_same("M0 0Q1 2 3 3t1 0 1 0", "M 0 0 Q 1 2 3 3 Q 5 4 4 3 Q 3 2 5 3 L 0 0 ");
  check_same("M2 2T7 8", "M 2 2 Q 2 2 7 8 L 2 2 ");
  check_same("M0 0Q1 2 3 3S5 5 6 6", "M 0 0 Q 1 2 3 3 C 3 3 5 5 6 6 L 0 0 ");
}

static void subpaths_begin_where_the_last_did(void) {
  check_same("M1 1L5 1L5 5ZL9 9", "M 1 1 L 5 1 L 5 5 L 1 1 M 1 1 L 9 9 L 1 1 ");
  check_same("M1 1l4 0 0 4zm1 1l1 0 0 1z", "M 1 1 L 5 1 L 5 5 L 1 1 M 2 2 L 3 2 L 3 3 L 2 2 ");
  check_same("M1 1L2 1M5 5L6 5", "M 1 1 L 2 1 L 1 1 M 5 5 L 6 5 L 5 5 ");
}

static void numbers_may_be_compact(void) {
  check_same("M1.5.5-3e2-.25L+1-1", "M 1.5 0.5 L -300 -0.25 L 1 -1 L 1.5 0.5 ");
  check_same("M1E1,1.e1L.1e-1 0", "M 10 10 L 0.01 0 L 10 10 ");
  check_same("M0 0\tL\n1\r1 , 2\f2", "M 0 0 L 1 1 L 2 2 L 0 0 ");
  cs_outline arcs = read_path("M0 0a5 5 0 1110 0a5 5 0 01-10 0"); /* flags need no separator */
  CHECK(arcs.piece_count == 4 && arcs.points[4].x == 10 && arcs.points[4].y == 0);
  CHECK_NEAR(arcs.points[2].x, 5, 1e-12);
  CHECK_NEAR(arcs.points[2].y, -5, 1e-12);
  cs_outline_finish(&arcs, context->memory);
}

static void numbers_are_right_to_an_ulp(void) {
  for (int seed = 1; seed <= 3000; seed++) {
    test_random random = {(uint64_t)seed};
    char data[100], number[64];
    double digits = random_between(&random, -1, 1);
    double value = digits * pow(10, random_between(&random, -20, 11));
    snprintf(number, sizeof number, "%.*g", 1 + random_below(&random, 20), value);
    snprintf(data, sizeof data, "M0 0L%s 1", number);
    cs_outline outline = read_path(data);
    double expected = strtod(number, NULL), got = outline.points[1].x;
    CHECK_NEAR(got, expected, 2.3e-16 * fabs(expected));
    cs_outline_finish(&outline, context->memory);
  }
  cs_outline tiny = read_path("M0 0L1e-400 0.000000000000000000000000000001e30");
  CHECK(tiny.points[1].x == 0);
  CHECK_NEAR(tiny.points[1].y, 1, 3e-16);
  cs_outline_finish(&tiny, context->memory);
}

static celspan_point on_piece(const cs_outline *outline, size_t piece, double t) {
  cs_bezier curve = {.degree = outline->degrees[piece]}, low, high;
  memcpy(curve.points, outline->points + outline->starts[piece],
         ((size_t)curve.degree + 1) * sizeof *curve.points);
  cs_bezier_split(&curve, t, &low, &high);
  return (celspan_point){high.points[0].x / high.points[0].w, high.points[0].y / high.points[0].w};
}

/* The centre of the arc by the two points and the flags, in the circle's own space, then every
 * point of the pieces compared with it; the direction must agree with the flags too. */
static void arcs_keep_their_ellipse(void) {
  for (int seed = 1; seed <= 500; seed++) {
    test_random random = {(uint64_t)seed};
    double rx = random_between(&random, 20, 60), ry = random_between(&random, 20, 60);
    double turn = random_between(&random, -400, 400), a = turn * 3.14159265358979323846 / 180;
    double cx = random_between(&random, -50, 50), cy = random_between(&random, -50, 50);
    double begin = random_between(&random, -3, 3), sweep = random_between(&random, -6.1, 6.1);
    double x[2], y[2];
    for (int i = 0; i < 2; i++) {
      double u = rx * cos(begin + i * sweep), v = ry * sin(begin + i * sweep);
      x[i] = cx + cos(a) * u - sin(a) * v;
      y[i] = cy + sin(a) * u + cos(a) * v;
    }
    char data[300];
    snprintf(data, sizeof data, "M%.17g,%.17gA%.17g,%.17g %.17g %d%d%.17g,%.17g", x[0], y[0], rx,
             ry, turn, fabs(sweep) > 3.14159265358979, sweep > 0, x[1], y[1]);
    cs_outline outline = read_path(data);
    double worst = 0, turned = 0, last = begin;
    for (size_t i = 0; i < outline.piece_count && outline.degrees[i] == 2; i++)
      for (int k = 0; k <= 8; k++) {
        celspan_point p = on_piece(&outline, i, k / 8.0);
        double dx = p.x - cx, dy = p.y - cy;
        double u = (cos(a) * dx + sin(a) * dy) / rx, v = (cos(a) * dy - sin(a) * dx) / ry;
        worst = fmax(worst, fabs(hypot(u, v) - 1));
        double step = remainder(atan2(v, u) - last, 2 * 3.14159265358979323846);
        turned += step;
        last += step;
      }
    int passed = CHECK(worst < 1e-6) & CHECK_NEAR(turned, sweep, 1e-5);
    if (!passed)
      fprintf(stderr, "  case %d: %s\n", seed, data);
    cs_outline_finish(&outline, context->memory);
  }
}

static void arcs_that_are_none_are_lines(void) {
  check_same("M0 0A0 5 0 0 0 10 10", "M 0 0 L 10 10 L 0 0 ");
  check_same("M0 0A5 5 0 0 0 0 0L3 3", "M 0 0 L 0 0 L 3 3 L 0 0 ");
  /* Radii too small are enlarged until the arc reaches. */
  cs_outline outline = read_path("M0 0A1 1 0 0 1 10 0");
  celspan_point top = on_piece(&outline, 0, 1);
  CHECK_NEAR(top.x, 5, 1e-12);
  CHECK_NEAR(top.y, -5, 1e-12);
  cs_outline_finish(&outline, context->memory);
}

static void check_refused(const char *data, const char *sentence) {
  cs_outline outline;
  cs_outline_init(&outline);
  CHECK(cs_outline_path(context, &outline, data) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(context), sentence);
  cs_outline_finish(&outline, context->memory);
}

static void mistakes_are_named_with_their_place(void) {
  check_refused("L1 2",
                "path data has 'L' at byte 1 where M, which every path begins with, is expected");
  check_refused("M1 2X", "path data has 'X' at byte 5 where one of the commands MLHVCSQTAZ is "
                         "expected");
  check_refused("M1", "path data ends at byte 3 where a number is expected");
  check_refused("M1 2L3", "path data ends at byte 7 where a number is expected");
  check_refused("M1 2,", "path data ends at byte 6 where a number is expected");
  check_refused("M1,,2", "path data has ',' at byte 4 where a number is expected");
  check_refused("M1 2L3 -", "path data has '-' at byte 8 where a number is expected");
  check_refused("M1 2L3 .e5", "path data has '.' at byte 8 where a number is expected");
  check_refused("M1 2\xc3\xa4", "path data has the byte 195 at byte 5 where one of the commands "
                                "MLHVCSQTAZ is expected");
  check_refused("M0 0A1 1 0 2 0 3 3",
                "path data has '2' at byte 12 where an arc flag, 0 or 1, is expected");
  check_refused("M1 1e13", "path data has a number beyond 1e12 at byte 4");
  check_refused("M1 -1e999999999999999999999", "path data has a number beyond 1e12 at byte 4");
  check_refused("M9e11 0l9e11 0", "path data goes beyond 1e12 with the numbers at byte 9");
  check_refused("M0 0nan 1", "path data has 'n' at byte 5 where one of the commands MLHVCSQTAZ is "
                             "expected");
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  commands_draw();
  subpaths_begin_where_the_last_did();
  numbers_may_be_compact();
  numbers_are_right_to_an_ulp();
  arcs_keep_their_ellipse();
  arcs_that_are_none_are_lines();
  mistakes_are_named_with_their_place();
  celspan_context_destroy(context);
  return check_done();
}
