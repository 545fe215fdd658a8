/* engine/paint/shade.c: textures given by a formula have the paint that they mean at every point,
 * and bend on a row only where cs_shade_breaks says so. A bend that is not reported is smoothed
 * away by the lines between: the crease of a triangle, the ring of a stop.
 */
#include "engine/paint/shade.h"

#include <stdlib.h>

#include "tests/support/check.h"
#include "tests/support/gradient.h"
#include "tests/support/random.h"

#define WIDTH 200
#define MOST 21     /* places at which any of them bends on a row */
#define SAMPLES 9   /* between two such places */
#define NARROW 0.01 /* columns: closer places count as one */

typedef struct formula {
  gradient gradient;
  celspan_texture *texture;
  cs_shade shade;
} formula;

/* ---------------------------------------------------------------- random ones */

static celspan_paint random_paint(test_random *random) {
  celspan_paint paint = {.beta = random_unit(random)};
  for (int c = 0; c < 3; c++) {
    paint.pigment[c] = random_unit(random);
    paint.medium[c] = random_unit(random);
  }
  return paint;
}

static void make_texture(celspan_context *context, formula *f) {
  const celspan_point *p = f->gradient.points;
  celspan_texture **out = &f->texture;
  switch (f->gradient.shape) {
  case LINEAR:
    CHECK(celspan_texture_create_linear(context, p[0], p[1], f->gradient.stops, STOPS, out) ==
          CELSPAN_OK);
    return;
  case TRIANGLE:
    CHECK(celspan_texture_create_gradient(context, p, f->gradient.paints, out) == CELSPAN_OK);
    return;
  default:
    CHECK(celspan_texture_create_focal(context, p[0], gradient_radius(&f->gradient), p[2],
                                       f->gradient.stops, STOPS, out) == CELSPAN_OK);
  }
}

/* perspective: how much w grows over the frame's width. */
static void make(celspan_context *context, test_random *random, shape kind, double perspective,
                 formula *f) {
  f->gradient.shape = kind;
  f->gradient.points[0] = random_point(random, 20, 150, -20, 40);
  celspan_point way = random_point(random, 20, 60, -60, 60);
  double along = random_between(random, -0.5, 0.5), across = kind == TRIANGLE ? 0.8 : 0.3;
  f->gradient.points[1] =
      (celspan_point){f->gradient.points[0].x + way.x, f->gradient.points[0].y + way.y};
  f->gradient.points[2] =
      kind == RADIAL ? f->gradient.points[0]
                     : (celspan_point){f->gradient.points[0].x + along * way.x - across * way.y,
                                       f->gradient.points[0].y + along * way.y + across * way.x};
  for (int i = 0; i < STOPS; i++) {
    f->gradient.stops[i].at = 0.1 + 0.25 * i + random_between(random, 0, 0.1);
    f->gradient.stops[i].paint = random_paint(random);
  }
  for (int i = 0; i < 3; i++)
    f->gradient.paints[i] = random_paint(random);
  make_texture(context, f);
  f->shade = (cs_shade){.texture = f->texture};
  for (int k = 0; k < 6; k++)
    f->shade.inverse.m[k] = (k % 4 == 0) + random_between(random, -0.2, 0.2);
  f->shade.inverse.m[6] = perspective / WIDTH;
  f->shade.inverse.m[7] = perspective / (3 * WIDTH);
  f->shade.inverse.m[8] = perspective == 0 ? 2 : 1;
  cs_shade_prepare(&f->shade);
}

/* ---------------------------------------------------------------- what is meant */

/* Own units of a point of the frame; false behind the horizon. */
static bool own_point(const formula *f, double x, double y, celspan_point *out) {
  const double *m = f->shade.inverse.m;
  double w = m[6] * x + m[7] * y + m[8];
  *out = (celspan_point){(m[0] * x + m[1] * y + m[2]) / w, (m[3] * x + m[4] * y + m[5]) / w};
  return w > 0;
}

static int stops_before(const formula *f, double place) {
  int count = 0;
  while (count < STOPS && f->gradient.stops[count].at <= place)
    count++;
  return count;
}

/* Values 0..2 are the pigments times beta, 3..5 the media times 1 - beta, 6 is beta. */
static double value_of(const celspan_paint *paint, int value) {
  double beta = (double)paint->beta;
  return value < 3   ? beta * (double)paint->pigment[value]
         : value < 6 ? (1 - beta) * (double)paint->medium[value - 3]
                     : beta;
}

/* The plane through the corners. */
static double plane_at(const formula *f, celspan_point at, int value) {
  double weights[3], sum = 0;
  gradient_weights(&f->gradient, at, weights);
  for (int i = 0; i < 3; i++)
    sum += weights[i] * value_of(&f->gradient.paints[i], value);
  return sum;
}

/* The formula that determines a pigment or a medium of a triangle at a point, and its value. */
typedef enum formula_part { OWN, NOTHING, ALL, BETA } formula_part;

static double triangle_value(const formula *f, celspan_point at, int value, formula_part *part) {
  double own = plane_at(f, at, value), beta = plane_at(f, at, 6);
  double share = value < 3 ? beta : 1 - beta, most = fmin(fmax(share, 0), 1);
  *part = own > 0 && own < most ? OWN : own <= 0 || share <= 0 ? NOTHING : share >= 1 ? ALL : BETA;
  return fmin(fmax(own, 0), most);
}

static double stops_value(const formula *f, double place, int value) {
  int next = stops_before(f, place);
  if (next == 0 || next == STOPS)
    return value_of(&f->gradient.stops[next == 0 ? 0 : STOPS - 1].paint, value);
  const celspan_stop *a = &f->gradient.stops[next - 1], *b = &f->gradient.stops[next];
  double share = (place - a->at) / (b->at - a->at), before = value_of(&a->paint, value);
  return before + share * (value_of(&b->paint, value) - before);
}

/* ---------------------------------------------------------------- paints */

static void check_paint(const formula *f, double x, double y) {
  celspan_point at;
  bool is_seen = own_point(f, x, y, &at);
  cs_shade_lanes got = cs_shade_paint(&f->shade, x, y);
  for (int value = 0; value < 6; value++) {
    formula_part part;
    double want = !is_seen ? value >= 3
                  : f->gradient.shape == TRIANGLE
                      ? triangle_value(f, at, value, &part)
                      : stops_value(f, gradient_place(&f->gradient, at), value);
    CHECK_NEAR((double)(value < 3 ? got.s[value] : got.t[value - 3]), want, 1e-5);
  }
}

/* A row has the same paints to the bit, in whatever order its places are. */
static void check_paints(const formula *f, test_random *random, double y) {
  double x[50];
  float paints_s[50][4], paints_t[50][4];
  for (int k = 0; k < 50; k++)
    x[k] = k < 40 ? 5 * k + 0.5 : random_between(random, -WIDTH, 2 * WIDTH);
  cs_shade_paints(&f->shade, x, 50, y, paints_s, paints_t);
  for (int k = 0; k < 50; k++) {
    cs_shade_lanes want = cs_shade_paint(&f->shade, x[k], y);
    CHECK(cs_v4_same(cs_v4_load(paints_s[k]), want.s));
    CHECK(cs_v4_same(cs_v4_load(paints_t[k]), want.t));
  }
}

/* ---------------------------------------------------------------- bends */

/* Which of its formulas applies to a texture at a point of the frame. */
static int formula_at(const formula *f, double x, double y) {
  celspan_point at;
  if (!own_point(f, x, y, &at))
    return -1;
  if (f->gradient.shape != TRIANGLE)
    return stops_before(f, gradient_place(&f->gradient, at));
  int all = 0;
  for (int value = 0; value < 6; value++) {
    formula_part part;
    triangle_value(f, at, value, &part);
    all = 4 * all + (int)part;
  }
  return all;
}

/* The distance from the focus by which an affine place bends the most where it is least: distances
 * across the line from focus to centre count more, because circles are narrower there. */
static double bent_distance(const formula *f, double x, double y) {
  celspan_point at, way = away(f->gradient.points[0], f->gradient.points[1]),
                    focus = f->gradient.points[2];
  own_point(f, x, y, &at);
  celspan_point d = away(focus, f->gradient.points[0]), q = away(focus, at);
  double square = dot(d, d), rest = 1 - square / dot(way, way);
  double along = square > 0 ? dot(q, d) * dot(q, d) / square : 0;
  return along / rest + (dot(q, q) - along);
}

static bool comes_nearer(const formula *f, double x, double y) {
  return bent_distance(f, x + 1e-4, y) < bent_distance(f, x - 1e-4, y);
}

static int ascending(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Between two places a texture has one formula, and the distance from the focus one direction. */
static void check_between(const formula *f, double from, double to, double y) {
  bool has_nearest =
      (f->gradient.shape == RADIAL || f->gradient.shape == FOCAL) && f->shade.is_affine;
  if (to - from < NARROW)
    return;
  double middle = 0.5 * (from + to);
  for (int k = 0; k < SAMPLES; k++) {
    double x = from + (to - from) * (k + 0.5) / SAMPLES;
    CHECK(formula_at(f, x, y) == formula_at(f, middle, y));
    CHECK(!has_nearest || comes_nearer(f, x, y) == comes_nearer(f, middle, y));
  }
}

static size_t check_row(const formula *f, double y) {
  double places[MOST + 2];
  CHECK(cs_shade_break_limit(&f->shade) <= MOST);
  size_t count = cs_shade_breaks(&f->shade, (cs_run){0, WIDTH, y}, places + 1);
  CHECK(count <= cs_shade_break_limit(&f->shade));
  places[0] = 0;
  places[count + 1] = WIDTH;
  for (size_t i = 1; i <= count; i++)
    CHECK(places[i] > 0 && places[i] < WIDTH);
  qsort(places, count + 2, sizeof *places, ascending);
  for (size_t i = 0; i <= count; i++)
    check_between(f, places[i], places[i + 1], y);
  return count;
}

/* perspective: a row's end is nearer than its beginning, farther, or behind the horizon. */
static void check_shape(celspan_context *context, test_random *random, shape kind,
                        double perspective) {
  size_t found = 0;
  for (int k = 0; k < 60; k++) {
    formula f;
    make(context, random, kind, perspective, &f);
    for (double y = 0.5; y < 40; y += 8) {
      found += check_row(&f, y);
      check_paints(&f, random, y);
      for (double x = 0.5; x < WIDTH; x += 13)
        check_paint(&f, x, y);
    }
    celspan_texture_unref(f.texture);
  }
  CHECK(found > 300);
}

int main(void) {
  celspan_context *context;
  test_random random = {4};
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (int kind = 0; kind < SHAPES; kind++) {
    check_shape(context, &random, (shape)kind, 0);
    check_shape(context, &random, (shape)kind, 1);
    check_shape(context, &random, (shape)kind, -0.5);
    check_shape(context, &random, (shape)kind, -2);
  }
  celspan_context_destroy(context);
  return check_done();
}
