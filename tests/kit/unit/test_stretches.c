/* Fitting lines and arcs to points, and splitting points into them: the expected ones are found,
 * with the given error of the points. */
#include <math.h>
#include <stdlib.h>

#include "tests/support/check.h"
#include "tests/support/random.h"
#include "tools/trace/cubic.h"
#include "tools/trace/stretches.h"

enum { CASES = 500, POINTS = 24 };
#define NOISE 0.05

/* Points a pixel apart on a circle, from its top on, with an error of at most `off`. They are
 * summed relative to a place near the circle. */
static cs_arc_sums sum_circle(test_random *random, celspan_point centre, double radius,
                              double off) {
  cs_arc_sums sums = cs_arc_begin((celspan_point){centre.x + 3, centre.y - radius - 7});
  for (int i = 0; i < POINTS; i++) {
    double angle = i / radius, far = radius + random_between(random, -off, off);
    cs_arc_add(&sums, (celspan_point){centre.x + far * sin(angle), centre.y - far * cos(angle)});
  }
  return sums;
}

/* However short the arc is compared with its circle, the distance of a place from it is right. */
static void arcs_are_those_of_their_points(void) {
  for (int i = 0; i < CASES; i++) {
    test_random random = {(uint64_t)i + 1};
    celspan_point centre = random_point(&random, -100, 100, -100, 100), across;
    double radius = exp(random_between(&random, 0.7, 6)), off = random_between(&random, -0.1, 0.1);
    cs_arc_sums sums = sum_circle(&random, centre, radius, 0);
    CHECK(cs_arc_error(&sums) < 1e-9);
    cs_arc arc = cs_arc_of(&sums, false);
    celspan_point beside = {centre.x, centre.y - radius - off}, on = {centre.x, centre.y - radius};
    CHECK_NEAR(fabs(cs_arc_off(&arc, beside, &across)), fabs(off), 0.003);
    celspan_point nearest = cs_arc_nearest(&arc, beside);
    CHECK_NEAR(nearest.x, on.x, 1e-3);
    CHECK_NEAR(nearest.y, on.y, 1e-3);
  }
}

/* For any direction of a line, and for the arc fitted to it, which has no curvature. */
static void lines_are_those_of_their_points(void) {
  for (int i = 0; i < CASES; i++) {
    test_random random = {(uint64_t)i + 1};
    celspan_point on = random_point(&random, -9, 9, -9, 9), across;
    double angle = 6.2831853 * i / CASES, off = random_between(&random, -2, 2);
    cs_arc_sums sums = cs_arc_begin((celspan_point){0, 0});
    for (int k = 0; k < POINTS; k++)
      cs_arc_add(&sums, (celspan_point){on.x + k * cos(angle), on.y + k * sin(angle)});
    CHECK(cs_arc_line_error(&sums) < 1e-9);
    celspan_point beside = {on.x - off * sin(angle), on.y + off * cos(angle)};
    for (int is_line = 0; is_line < 2; is_line++) {
      cs_arc line = cs_arc_of(&sums, is_line);
      CHECK_NEAR(fabs(cs_arc_off(&line, beside, &across)), fabs(off), 1e-3);
    }
  }
}

/* The mean of the squares is that of the noise, except for the part that the arc absorbs. */
static void noise_is_measured(void) {
  double sum = 0;
  for (int i = 0; i < CASES; i++) {
    test_random random = {(uint64_t)i + 1};
    cs_arc_sums sums = sum_circle(&random, (celspan_point){5, 5}, 12, NOISE);
    CHECK(cs_arc_error(&sums) <= cs_arc_line_error(&sums));
    sum += cs_arc_error(&sums);
  }
  CHECK_NEAR(sum / CASES * POINTS / (POINTS - 3), NOISE * NOISE / 3, 0.1 * NOISE * NOISE / 3);
}

/* What Taubin's fit makes least: the squared value of the circle's function at the points, over the
 * squared length of its gradient. */
static double ratio_of(const celspan_point *points, celspan_point centre, double radius) {
  double squares = 0, slopes = 0;
  for (int i = 0; i < POINTS; i++) {
    double x = points[i].x - centre.x, y = points[i].y - centre.y, far = x * x + y * y;
    squares += (far - radius * radius) * (far - radius * radius);
    slopes += 4 * far;
  }
  return squares / slopes;
}

/* However far the points are from lying on a circle, the error is that of the circle which fits
 * them best: no other one has less. */
static void errors_are_those_of_the_best_circle(void) {
  for (int i = 0; i < CASES; i++) {
    test_random random = {(uint64_t)i + 1};
    celspan_point points[POINTS], centre = {0, 0};
    cs_arc_sums sums = cs_arc_begin((celspan_point){1, 2});
    for (int k = 0; k < POINTS; k++) {
      double angle = 6.2831853 * k / POINTS, far = random_between(&random, 2, 10);
      points[k] = (celspan_point){far * cos(angle), far * sin(angle)};
      cs_arc_add(&sums, points[k]);
    }
    double radius = 6, step = 1, least = ratio_of(points, centre, radius);
    while (step > 1e-6) {
      double before = least;
      for (int k = 0; k < 6; k++) {
        double by = k % 2 ? step : -step, wide = radius + (k / 2 == 2 ? by : 0);
        celspan_point at = {centre.x + (k / 2 == 0 ? by : 0), centre.y + (k / 2 == 1 ? by : 0)};
        double ratio = ratio_of(points, at, wide);
        if (ratio < least)
          least = ratio, centre = at, radius = wide;
      }
      step = least < before ? step : step / 2;
    }
    CHECK_NEAR(cs_arc_error(&sums) / least, 1, 1e-4);
  }
}

static void add(celspan_context *context, cs_points *points, test_random *random,
                celspan_point at) {
  double x = random_between(random, -NOISE, NOISE), y = random_between(random, -NOISE, NOISE);
  CHECK(cs_points_add(context, points, (celspan_point){at.x + x, at.y + y}) == CELSPAN_OK);
}

static size_t count_stretches(celspan_context *context, const cs_points *points) {
  cs_stretches stretches = {.items = NULL};
  ptrdiff_t count = (ptrdiff_t)points->count, end = 0;
  CHECK(cs_stretches_find(context, points, 0, count, NOISE, &stretches) == CELSPAN_OK);
  for (size_t i = 0; i < stretches.count; i++) {
    const cs_stretch *s = &stretches.items[i];
    CHECK(s->from >= end && s->to - s->from >= CS_STRETCH_FEWEST && s->to <= count &&
          s->to - s->from <= CS_STRETCH_MOST);
    end = s->to;
  }
  size_t found = stretches.count;
  cs_stretches_finish(context, &stretches);
  return found;
}

/* Two lines that meet at some angle are two stretches, with a point between them that is rounded
 * off; as many points around a circle are one. */
static void corners_are_distinguished_from_bends(celspan_context *context) {
  for (int i = 0; i < CASES; i++) {
    test_random random = {(uint64_t)i + 1};
    cs_points angle = {.items = NULL}, bend = {.items = NULL};
    double turn = random_between(&random, 0.7, 2), radius = random_between(&random, 2.5, 30);
    for (int k = -8; k <= 8; k++) {
      celspan_point in = {k, 0}, out = {k * cos(turn), k * sin(turn)}, rounded = {-0.1, 0.2};
      add(context, &angle, &random, k < 0 ? in : k > 0 ? out : rounded);
      celspan_point around = {radius * sin(k / radius), radius * cos(k / radius)};
      add(context, &bend, &random, around);
    }
    CHECK(count_stretches(context, &angle) == 2);
    CHECK(count_stretches(context, &bend) == 1);
    cs_points_finish(context, &angle);
    cs_points_finish(context, &bend);
  }
}

/* The curve through gates is the same from either end. */
static void gates_are_passed_alike_both_ways(void) {
  int passed = 0;
  for (int i = 0; i < CASES; i++) {
    test_random random = {(uint64_t)i + 1};
    cs_edge_point there[POINTS], back[POINTS];
    cs_cubic_station stations[POINTS];
    celspan_point control[2], again[2];
    const cs_cubic_end ends[2] = {{.point = {0, 0}}, {.point = {POINTS + 1, 0}}};
    const cs_cubic_end turned[2] = {ends[1], ends[0]};
    double height = random_between(&random, 2, 9), room = random_between(&random, 0.1, 0.4);
    for (int k = 0; k < POINTS; k++) {
      double x = k + 1,
             y = height * sin(3.14159265 * x / (POINTS + 1)) + random_between(&random, -0.2, 0.2);
      there[k] = back[POINTS - 1 - k] = (cs_edge_point){{x, y}, {0, room}};
    }
    bool is_passed = cs_cubic_thread(there, POINTS, ends, stations, control);
    CHECK(cs_cubic_thread(back, POINTS, turned, stations, again) == is_passed);
    for (int k = 0; k < 2; k++) {
      CHECK_NEAR(control[k].x, again[1 - k].x, 1e-6);
      CHECK_NEAR(control[k].y, again[1 - k].y, 1e-6);
    }
    passed += is_passed;
  }
  CHECK(passed > CASES / 4 && passed < CASES);
}

int main(void) {
  celspan_context *context;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  arcs_are_those_of_their_points();
  lines_are_those_of_their_points();
  noise_is_measured();
  errors_are_those_of_the_best_circle();
  corners_are_distinguished_from_bends(context);
  gates_are_passed_alike_both_ways();
  celspan_context_destroy(context);
  return check_done();
}
