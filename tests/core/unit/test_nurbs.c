/* NURBS against the Cox-de Boor definition, and the descriptions that are refused.
 */
#include "model/geometry/bezier.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define MOST 64

static celspan_context *context;

/* Basis function `i` of a degree by its definition; 0/0 is 0. */
static double basis(const double *u, int i, int degree, double t) {
  if (degree == 0)
    return u[i] <= t && t < u[i + 1];
  double left = u[i + degree] - u[i], right = u[i + degree + 1] - u[i + 1];
  return (left > 0 ? (t - u[i]) / left * basis(u, i, degree - 1, t) : 0) +
         (right > 0 ? (u[i + degree + 1] - t) / right * basis(u, i + 1, degree - 1, t) : 0);
}

/* The plain open curve that a description means: periods unrolled. */
typedef struct plain_curve {
  int degree, count;
  double x[MOST], y[MOST], w[MOST], knots[2 * MOST];
} plain_curve;

static void unroll(const celspan_nurbs_desc *desc, plain_curve *c) {
  int n = (int)desc->point_count, p = desc->degree;
  bool is_periodic = desc->closure == CELSPAN_NURBS_PERIODIC;
  c->degree = p;
  c->count = is_periodic ? n + p : n;
  for (int i = 0; i < c->count; i++) {
    c->x[i] = desc->points[i % n].x;
    c->y[i] = desc->points[i % n].y;
    c->w[i] = desc->weights ? desc->weights[i % n] : 1;
  }
  for (int i = 0; i < c->count + p + 1; i++) {
    if (!is_periodic) {
      c->knots[i] = desc->knots ? desc->knots[i] : fmin(fmax(i - p, 0), n - p);
      continue;
    }
    int k = i - p, turns = (k + 4 * n) / n - 4; /* knot p of the plain curve begins the period */
    c->knots[i] =
        desc->knots ? desc->knots[k - turns * n] + turns * (desc->knots[n] - desc->knots[0]) : k;
  }
}

static celspan_point evaluate(const plain_curve *c, double t) {
  double x = 0, y = 0, w = 0;
  for (int i = 0; i < c->count; i++) {
    double share = c->w[i] * basis(c->knots, i, c->degree, t);
    x += share * c->x[i];
    y += share * c->y[i];
    w += share;
  }
  return (celspan_point){x / w, y / w};
}

static celspan_point on_piece(const cs_outline *outline, size_t piece, double t) {
  cs_bezier curve = {.degree = outline->degrees[piece]}, low, high;
  memcpy(curve.points, outline->points + outline->starts[piece],
         ((size_t)curve.degree + 1) * sizeof *curve.points);
  cs_bezier_split(&curve, t, &low, &high);
  return (celspan_point){high.points[0].x / high.points[0].w, high.points[0].y / high.points[0].w};
}

static double worst_difference(const cs_outline *outline, const plain_curve *c) {
  double worst = 0;
  size_t piece = 0;
  for (int k = c->degree; k < c->count; k++) {
    double a = c->knots[k], b = c->knots[k + 1];
    if (!(a < b))
      continue;
    for (int i = 0; i < 8; i++) {
      celspan_point one = on_piece(outline, piece, i / 8.0), two = evaluate(c, a + (b - a) * i / 8);
      worst = fmax(worst, hypot(one.x - two.x, one.y - two.y));
    }
    piece++;
  }
  return worst;
}

static void pieces_equal_the_definition(void) {
  for (int seed = 1; seed <= 400; seed++) {
    test_random random = {(uint64_t)seed};
    int degree = 1 + random_below(&random, seed % 20 == 0 ? 10 : 5);
    int count = degree + 1 + random_below(&random, 10);
    bool is_periodic = random_below(&random, 2), has_ends = random_below(&random, 2);
    celspan_point points[MOST];
    double weights[MOST], knots[MOST];
    for (int i = 0; i < count; i++) {
      points[i] = random_point(&random, 0, 100, 0, 100);
      weights[i] = random_between(&random, 0.1, 3);
    }
    int knot_count = is_periodic ? count + 1 : count + degree + 1, row = 1;
    knots[0] = random_between(&random, -5, 5);
    for (int i = 1; i < knot_count; i++) {
      bool is_end = !is_periodic && has_ends && (i <= degree || i > count);
      bool is_inner = i > 1 && i < knot_count - 1 && i != degree + 1 && i != count;
      bool again = is_end || (is_inner && row < degree - 1 && random_below(&random, 3) == 0);
      row = again ? row + 1 : 1;
      knots[i] = knots[i - 1] + (again ? 0 : random_between(&random, 0.2, 2));
    }
    bool has_weights = random_below(&random, 2), has_knots = random_below(&random, 3);
    celspan_nurbs_desc desc = {.struct_size = sizeof desc,
                               .points = points,
                               .weights = has_weights ? weights : NULL,
                               .point_count = (size_t)count,
                               .degree = degree,
                               .knots = has_knots ? knots : NULL,
                               .knot_count = (size_t)knot_count,
                               .closure =
                                   is_periodic ? CELSPAN_NURBS_PERIODIC : CELSPAN_NURBS_CLAMPED};
    cs_outline outline;
    plain_curve plain;
    cs_outline_init(&outline);
    unroll(&desc, &plain);
    int passed = CHECK(cs_outline_nurbs(context, &outline, &desc) == CELSPAN_OK);
    if (!passed || !CHECK(worst_difference(&outline, &plain) < 1e-9))
      fprintf(stderr, "  case %d: degree %d, %s %s\n", seed, degree, is_periodic ? "periodic" : "",
              passed ? "" : celspan_context_error(context));
    else
      CHECK(memcmp(&outline.points[0], &outline.points[outline.point_count - 1],
                   sizeof *outline.points) == 0);
    cs_outline_finish(&outline, context->memory);
  }
}

static void a_clamped_curve_runs_from_end_to_end(void) {
  const celspan_point points[5] = {{0, 0}, {10, 30}, {30, 40}, {50, 20}, {60, 5}};
  celspan_nurbs_desc desc = {.struct_size = sizeof desc,
                             .degree = 3,
                             .points = points,
                             .point_count = 5,
                             .closure = CELSPAN_NURBS_CLAMPED}; /* degree 0 means 3 */
  cs_outline outline;
  cs_outline_init(&outline);
  CHECK(cs_outline_nurbs(context, &outline, &desc) == CELSPAN_OK);
  CHECK(outline.piece_count == 3 && outline.degrees[0] == 3 && outline.degrees[2] == 1);
  celspan_point first = on_piece(&outline, 0, 0), last = on_piece(&outline, 1, 1);
  CHECK(first.x == 0 && first.y == 0 && last.x == 60 && last.y == 5);
  cs_outline_finish(&outline, context->memory);
}

static void four_points_make_four_pieces(void) {
  const celspan_point points[4] = {{0, 0}, {30, 0}, {30, 30}, {0, 30}};
  celspan_nurbs_desc desc = {
      .struct_size = sizeof desc, .points = points, .point_count = 4, .degree = 3};
  cs_outline outline;
  cs_outline_init(&outline);
  CHECK(cs_outline_nurbs(context, &outline, &desc) == CELSPAN_OK);
  CHECK(outline.piece_count == 4 && outline.contour_count == 1);
  /* The first span is acted on by points 1 to 4: it begins at (p1 + 4 p2 + p3)/6. */
  celspan_point first = on_piece(&outline, 0, 0);
  CHECK_NEAR(first.x, 25, 1e-12);
  CHECK_NEAR(first.y, 5, 1e-12);
  cs_outline_finish(&outline, context->memory);
}

static void equal_weights_are_no_weights(void) {
  const celspan_point points[4] = {{0, 0}, {30, 0}, {31, 33}, {0, 30}};
  const double weights[4] = {0.3, 0.3, 0.3, 0.3};
  celspan_nurbs_desc desc = {
      .struct_size = sizeof desc, .points = points, .point_count = 4, .degree = 3};
  cs_outline one, two;
  cs_outline_init(&one);
  cs_outline_init(&two);
  CHECK(cs_outline_nurbs(context, &one, &desc) == CELSPAN_OK);
  desc.weights = weights;
  CHECK(cs_outline_nurbs(context, &two, &desc) == CELSPAN_OK);
  CHECK(memcmp(one.points, two.points, one.point_count * sizeof *one.points) == 0);
  cs_outline_finish(&one, context->memory);
  cs_outline_finish(&two, context->memory);
}

static void check_refused(const celspan_nurbs_desc *desc, const char *sentence) {
  cs_outline outline;
  cs_outline_init(&outline);
  CHECK(cs_outline_nurbs(context, &outline, desc) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(context), sentence);
  cs_outline_finish(&outline, context->memory);
}

static void mistakes_are_named(void) {
  const celspan_point points[5] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 2}};
  celspan_nurbs_desc desc = {
      .struct_size = sizeof desc, .points = points, .point_count = 5, .degree = 2};
  desc.degree = 16;
  check_refused(&desc, "the degree is 16; it must be from 1 to 15");
  desc.degree = -1;
  check_refused(&desc, "the degree is -1; it must be from 1 to 15");
  desc.degree = 5;
  check_refused(&desc, "there are 5 points; degree 5 needs from 6 to 100000");
  desc.point_count = 100001;
  check_refused(&desc, "there are 100001 points; degree 5 needs from 6 to 100000");
  desc.point_count = 5;
  desc.degree = 2;
  desc.knot_count = 6;
  desc.knots = (const double[6]){0, 1, 2, 1.5, 4, 5};
  check_refused(&desc, "knot 4 is 1.5, less than knot 3, which is 2; knots must not decrease");
  desc.knots = (const double[6]){0, 1, HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
  check_refused(&desc, "knots[3] must be a finite number, got inf");
  desc.knots = (const double[6]){-HUGE_VAL, 1, 2, 3, 4, 5};
  check_refused(&desc, "knots[1] must be a finite number, got -inf");
  desc.knots = (const double[6]){0, NAN, 2, 3, 4, 5};
  check_refused(&desc, "knots[2] must be a finite number, got nan");
  desc.knots = (const double[6]){0, 1, 2, 3, 4, 2e12};
  check_refused(&desc, "knot 6 is 2e+12; it must be between -1e12 and 1e12");
  desc.knots = (const double[6]){3, 3, 3, 3, 3, 3};
  check_refused(&desc, "knots 1 to 6 are all 3; the curve has no length between them");
  desc.knots = (const double[6]){0, 1, 1, 1, 2, 3};
  check_refused(&desc, "knot 2, 1, appears 3 times; degree 2 allows 2 there");
  desc.knots = (const double[6]){0, 0, 1, 2, 3, 3}; /* three times where the period meets itself */
  check_refused(&desc, "knot 5, 3, appears 3 times; degree 2 allows 2 there");
  desc.knot_count = 8;
  check_refused(&desc, "there are 8 knots; a periodic curve of degree 2 with 5 points needs 6");
  desc.closure = CELSPAN_NURBS_CLAMPED;
  desc.knots = (const double[8]){0, 0, 0, 0, 1, 2, 2, 2};
  check_refused(&desc, "knot 1, 0, appears 4 times; degree 2 allows 3 there");
  desc.knots = (const double[8]){0, 0, 0, 1, 1, 1, 2, 2};
  check_refused(&desc, "knot 4, 1, appears 3 times; degree 2 allows 2 there");
  desc.knots = NULL;
  desc.weights = (const double[5]){1, 1, 0, 1, 1};
  check_refused(&desc, "weight 3 is 0; weights must be above 0 and at most 1e12");
  desc.weights = (const double[5]){1, 1, 1, -1, 1};
  check_refused(&desc, "weight 4 is -1; weights must be above 0 and at most 1e12");
  desc.weights = (const double[5]){1, 2e12, 1, 1, 1};
  check_refused(&desc, "weight 2 is 2e+12; weights must be above 0 and at most 1e12");
  desc.weights = (const double[5]){NAN, 1, 1, 1, 1};
  check_refused(&desc, "weights[1] must be a finite number, got nan");
  desc.weights = (const double[5]){1, 1, 1, 1, HUGE_VAL};
  check_refused(&desc, "weights[5] must be a finite number, got inf");
  desc.weights = (const double[5]){1, 1, 1e7, 1, 1};
  check_refused(&desc, "the weights go from 1 to 1e+07; the largest may be 1e6 times the smallest");
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  pieces_equal_the_definition();
  a_clamped_curve_runs_from_end_to_end();
  four_points_make_four_pieces();
  equal_weights_are_no_weights();
  mistakes_are_named();
  celspan_context_destroy(context);
  return check_done();
}
