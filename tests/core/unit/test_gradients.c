/* Gradients on rows: every pixel is within 1/1023 of the colour that the stops give at its centre,
 * whatever the gradient and its matrix.
 */
#include <stdlib.h>

#include "tests/support/frame_rows.h"
#include "tests/support/gradient.h"
#include "tests/support/random.h"

#define WIDTH 300
#define HEIGHT 12

/* A gradient placed by a matrix; its stops are opaque. */
typedef struct put_gradient {
  gradient gradient;
  celspan_matrix matrix;
} put_gradient;

/* ---------------------------------------------------------------- what is meant */

/* The colour of an opaque stop is its pigment. */
static double mix_stops(const gradient *g, double place, int channel) {
  const celspan_stop *stops = g->stops;
  int next = 1;
  if (place <= stops[0].at)
    return (double)stops[0].paint.pigment[channel];
  while (next < STOPS && place > stops[next].at)
    next++;
  double before = (double)stops[next - 1].paint.pigment[channel];
  if (next == STOPS)
    return before;
  double share = (place - stops[next - 1].at) / (stops[next].at - stops[next - 1].at);
  return before + share * ((double)stops[next].paint.pigment[channel] - before);
}

/* Premultiplied values are linear over the plane, and clamped to their range. */
static void mix_corners(const gradient *g, celspan_point at, double rgba[4]) {
  double weights[3];
  gradient_weights(g, at, weights);
  for (int c = 0; c < 4; c++)
    rgba[c] = 0;
  for (int i = 0; i < 3; i++) {
    double beta = (double)g->paints[i].beta;
    for (int c = 0; c < 3; c++)
      rgba[c] += weights[i] * beta * (double)g->paints[i].pigment[c];
    rgba[3] += weights[i] * beta;
  }
  rgba[3] = fmin(fmax(rgba[3], 0), 1);
  for (int c = 0; c < 3; c++)
    rgba[c] = fmin(fmax(rgba[c], 0), rgba[3]);
}

static void colour_at(const gradient *g, celspan_point at, double rgba[4]) {
  if (g->shape == TRIANGLE) {
    mix_corners(g, at, rgba);
    return;
  }
  for (int c = 0; c < 3; c++)
    rgba[c] = mix_stops(g, gradient_place(g, at), c);
  rgba[3] = 1;
}

/* ---------------------------------------------------------------- random ones */

static celspan_matrix random_matrix(test_random *random) {
  double across = random_between(random, 0.5, 2), down = random_between(random, 0.5, 2);
  double angle = random_between(random, -3, 3), x = random_between(random, -40, 40);
  return celspan_matrix_then(
      celspan_matrix_then(celspan_matrix_scaling(across, down),
                          celspan_matrix_rotation(angle, (celspan_point){100, 5})),
      celspan_matrix_translation(x, 3));
}

static celspan_paint random_paint(test_random *random, float alpha) {
  float r = random_unit(random), g = random_unit(random), b = random_unit(random);
  return celspan_paint_rgb(r, g, b, alpha);
}

static put_gradient random_gradient(test_random *random, shape kind) {
  put_gradient put = {.gradient = {.shape = kind}, .matrix = random_matrix(random)};
  gradient *out = &put.gradient;
  double size = exp2(random_between(random, -6, 1)); /* most are narrow compared with the row */
  out->points[0] = random_point(random, 20, 200, -10, 20);
  celspan_point way = random_point(random, 30, 160, -80, 80);
  double along = random_between(random, -0.5, 0.5), across = kind == FOCAL ? 0.3 : 0.8;
  out->points[1] =
      (celspan_point){out->points[0].x + size * way.x, out->points[0].y + size * way.y};
  out->points[2] = (celspan_point){out->points[0].x + size * (along * way.x - across * way.y),
                                   out->points[0].y + size * (along * way.y + across * way.x)};
  for (int i = 0; i < STOPS; i++) {
    out->stops[i].at = 0.1 + 0.25 * i + random_between(random, 0, 0.1);
    out->stops[i].paint = random_paint(random, 1);
  }
  for (int i = 0; i < 3; i++)
    out->paints[i] = random_paint(random, 0.2f + 0.3f * (float)i);
  return put;
}

/* ---------------------------------------------------------------- rows */

static celspan_point move(const celspan_matrix *matrix, double x, double y) {
  const double *m = matrix->m; /* affine: m[8] is 1 */
  return (celspan_point){m[0] * x + m[1] * y + m[2], m[3] * x + m[4] * y + m[5]};
}

/* The largest difference between a row and the gradient. */
static double error_of(const put_gradient *p, const cs_row *row, int32_t y) {
  celspan_matrix inverse;
  double worst = 0;
  CHECK(celspan_matrix_inverse(p->matrix, &inverse));
  for (size_t i = 0; i < row->count; i++)
    for (int32_t x = row->spans[i].x0; x < row->spans[i].x1; x++) {
      celspan_point at = move(&inverse, x + 0.5, y + 0.5);
      double want[4];
      float rgba[4];
      colour_at(&p->gradient, at, want);
      celspan_span_colour(&row->spans[i], x, rgba);
      for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs((double)rgba[c] - want[c]));
    }
  return worst;
}

static celspan_texture *texture_of(studio *s, const gradient *g) {
  celspan_texture *out = NULL;
  switch (g->shape) {
  case LINEAR:
    return studio_linear(s, g->points[0], g->points[1], g->stops, STOPS);
  case RADIAL:
    return studio_radial(s, g->points[0], gradient_radius(g), g->stops, STOPS);
  case TRIANGLE:
    return studio_gradient(s, g->points, g->paints);
  default:
    studio_check(s, celspan_texture_create_focal(s->context, g->points[0], gradient_radius(g),
                                                 g->points[2], g->stops, STOPS, &out));
    s->textures[s->texture_count++] = out;
    return out;
  }
}

static celspan_rostrum *show(studio *s, const put_gradient *p) {
  celspan_object *sheet = studio_rect(s, -2000, -2000, 4000, 4000, texture_of(s, &p->gradient));
  return studio_show(s, studio_transform(s, sheet, p->matrix));
}

static void check_gradient(studio *s, const put_gradient *p, celspan_antialias_mode mode,
                           int number) {
  celspan_exposure exposure = {show(s, p), 1};
  celspan_frame_desc desc = studio_frame(&exposure, 1, WIDTH, HEIGHT, &mode);
  frame_rows rows;
  double worst = 0;
  frame_rows_open(&rows, s, &desc);
  for (int32_t y = 0; y < HEIGHT; y++)
    worst = fmax(worst, error_of(p, worker_row(&rows.worker, y), y));
  if (!CHECK_NEAR(worst, 0, 1.0 / 1023))
    fprintf(stderr, "  gradient %d, shape %d, mode %d\n", number, (int)p->gradient.shape,
            (int)mode);
  frame_rows_close(&rows);
}

int main(void) {
  static studio s;
  test_random random = {12};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  for (int k = 0; k < 400; k++) {
    put_gradient p = random_gradient(&random, (shape)(k % SHAPES));
    check_gradient(&s, &p, CELSPAN_ANTIALIAS_NONE, k);
    check_gradient(&s, &p, CELSPAN_ANTIALIAS_AREA, k);
    studio_finish(&s);
  }
  celspan_context_destroy(s.context);
  return check_done();
}
