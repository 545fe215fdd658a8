/* Boundaries against the half-open rule, reversed copies, their own walks, the true curve, exact
 * conics and exact insides. Random cases are numbered by their seed. One file, because all tests
 * use the same boundaries.
 */
#include <stdlib.h>

#include "model/geometry/boundary_build.h"
#include "model/geometry/boundary_walk.h"
#include "model/geometry/matrix.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"

static celspan_context *context;

#define MUST(call)                                                                                 \
  do {                                                                                             \
    if ((call) != CELSPAN_OK) {                                                                    \
      CHECK(!"the call " #call " succeeds");                                                       \
      fprintf(stderr, "%s\n", celspan_context_error(context));                                     \
    }                                                                                              \
  } while (0)

static const cs_boundary_frame wide = {-1e7, 1e7, -1e7, 1e7};
static const cs_boundary_frame small = {0, 300, 0, 200};

/* ---------------------------------------------------------------- random outlines */

static void random_nurbs(test_random *random, cs_outline *outline) {
  celspan_point points[24];
  double weights[24], knots[64];
  int degree = 1 + random_below(random, 6), count = degree + 1 + random_below(random, 16 - degree);
  bool is_periodic = random_below(random, 2);
  int grid = random_below(random, 3) == 0;
  for (int i = 0; i < count; i++) {
    points[i] = random_point(random, -100, 400, -80, 300);
    if (grid)
      points[i] = (celspan_point){20 * floor(points[i].x / 20), 20 * floor(points[i].y / 20)};
    weights[i] = random_below(random, 4) == 0 ? random_between(random, 0.01, 20) : 1;
  }
  size_t knot_count = (size_t)(is_periodic ? count + 1 : count + degree + 1);
  int row = 1;
  knots[0] = 0;
  for (size_t i = 1; i < knot_count; i++) {
    bool again = random_below(random, 4) == 0 && row < (degree + 1) / 2 &&
                 i != (size_t)degree + 1; /* the first span of a clamped curve has a length */
    row = again ? row + 1 : 1;
    knots[i] = knots[i - 1] + (again ? 0 : random_between(random, 0.1, 2));
  }
  bool has_weights = random_below(random, 2), has_knots = random_below(random, 2);
  celspan_nurbs_desc desc = {.struct_size = sizeof desc,
                             .points = points,
                             .weights = has_weights ? weights : NULL,
                             .point_count = (size_t)count,
                             .degree = degree,
                             .knots = has_knots ? knots : NULL,
                             .knot_count = knot_count,
                             .closure =
                                 is_periodic ? CELSPAN_NURBS_PERIODIC : CELSPAN_NURBS_CLAMPED};
  MUST(cs_outline_nurbs(context, outline, &desc));
}

static void random_outline(test_random *random, cs_outline *outline) {
  cs_outline_init(outline);
  switch (random_below(random, 8)) {
  case 0: {
    celspan_point points[12];
    int count = 3 + random_below(random, 9);
    for (int i = 0; i < count; i++) {
      celspan_point point = random_point(random, -50, 350, -50, 250);
      points[i] = (celspan_point){floor(point.x), floor(point.y)};
    }
    MUST(cs_outline_polygon(context, outline, points, (size_t)count));
    break;
  }
  case 1: {
    double rx = random_between(random, 0, 200), ry = random_between(random, 0, 200);
    MUST(cs_outline_ellipse(context, outline, (celspan_point){150, 100}, rx, ry));
    break;
  }
  case 2:
    MUST(cs_outline_rect(context, outline, 20, 30, 200, 100, random_between(random, 0, 80)));
    break;
  default:
    random_nurbs(random, outline);
  }
}

static celspan_matrix random_matrix(test_random *random) {
  celspan_matrix matrix = celspan_matrix_identity();
  int kind = random_below(random, 3);
  if (kind >= 1) {
    double angle = random_between(random, -3, 3);
    celspan_point scale = random_point(random, -2, 2, 0.1, 2);
    matrix = celspan_matrix_then(celspan_matrix_rotation(angle, (celspan_point){150, 100}),
                                 celspan_matrix_scaling(scale.x, scale.y));
  }
  if (kind == 2) {
    matrix.m[6] = random_between(random, -0.004, 0.004);
    matrix.m[7] = random_between(random, -0.004, 0.004);
  }
  return matrix;
}

static cs_outline reversed_outline(const cs_outline *outline) {
  cs_outline out;
  cs_outline_init(&out);
  for (size_t c = 0; c < outline->contour_count; c++) {
    size_t begin = outline->contours[c];
    size_t end = c + 1 < outline->contour_count ? outline->contours[c + 1] : outline->piece_count;
    MUST(cs_outline_move(context, &out, outline->points[outline->starts[begin]]));
    for (size_t i = end; i-- > begin;) {
      cs_hpoint points[16];
      for (int k = 0; k < outline->degrees[i]; k++)
        points[k] = outline->points[outline->starts[i] + outline->degrees[i] - 1u - (unsigned)k];
      MUST(cs_outline_piece(context, &out, outline->degrees[i], points));
    }
    MUST(cs_outline_close(context, &out));
  }
  return out;
}

/* ---------------------------------------------------------------- helpers */

static cs_boundary_set build(const cs_outline *outline, const celspan_matrix *matrix,
                             const cs_boundary_frame *frame) {
  cs_boundary_set set;
  cs_boundary_builder builder;
  cs_boundary_init(&set);
  cs_boundary_builder_init(&builder, context, &set, frame);
  MUST(cs_boundary_add(&builder, outline, matrix, 7));
  cs_boundary_builder_finish(&builder);
  MUST(cs_boundary_sort(context, &set));
  return set;
}

/* Winding and number of chains at a height, left of x. */
static int winding_at(const cs_boundary_set *set, double x, double y, int *hits) {
  int winding = 0;
  *hits = 0;
  for (uint32_t i = 0; i < set->chain_count; i++) {
    const cs_boundary_chain *chain = &set->chains[i];
    if (!(chain->y0 <= y && y < chain->y1))
      continue;
    cs_boundary_walk walk;
    cs_boundary_start(set, i, y, &walk);
    if (cs_boundary_x(&walk, y) <= x) {
      winding += chain->direction;
      ++*hits;
    }
  }
  return winding;
}

static bool is_closed_at(const cs_boundary_set *set, double y) {
  int hits, winding = winding_at(set, HUGE_VAL, y, &hits);
  return winding == 0 && hits % 2 == 0;
}

static bool same_bits(const void *a, const void *b, size_t size) { return memcmp(a, b, size) == 0; }

static bool same_segment(const cs_boundary_walk *a, const cs_boundary_walk *b) {
  return same_bits(&a->x0, &b->x0, 6 * sizeof(double));
}

/* ---------------------------------------------------------------- the half-open rule */

static bool is_well_formed(const cs_boundary_set *set, const cs_boundary_frame *frame) {
  for (size_t i = 0; i < set->chain_count; i++) {
    const cs_boundary_chain *chain = &set->chains[i];
    const cs_boundary_piece *piece = &set->pieces[chain->piece];
    if (!(chain->y0 < chain->y1) || piece->y0 != chain->y0 || piece->x0 != chain->x0 ||
        piece[chain->piece_count - 1].y1 != chain->y1 || chain->layer != 7)
      return false;
    for (uint32_t k = 0; k < chain->piece_count; k++) {
      if (!(piece[k].y0 < piece[k].y1) || piece[k].x0 < frame->left || piece[k].x1 > frame->right)
        return false;
      if (k > 0 && (piece[k].x0 != piece[k - 1].x1 || piece[k].y0 != piece[k - 1].y1))
        return false;
    }
  }
  return true;
}

static bool keeps_vertices_inside(const cs_boundary_set *set, const cs_boundary_frame *frame) {
  for (uint32_t i = 0; i < set->chain_count; i++) {
    cs_boundary_walk walk;
    cs_boundary_start(set, i, set->chains[i].y0, &walk);
    for (int step = 0; step < 2000; step++) {
      const cs_boundary_piece *piece = &set->pieces[walk.piece];
      if (walk.y1 < piece->y0 || walk.y1 > piece->y1 || walk.x1 < frame->left ||
          walk.x1 > frame->right)
        return false;
      if (!cs_boundary_next(set, &walk))
        break;
    }
  }
  return true;
}

/* Within a segment x lies between its ends, up to 1: an arc deviates less than that from its
 * chord. */
static bool is_place(const cs_boundary_walk *walk, double y) {
  double x = cs_boundary_x(walk, y), room = 1 + 1e-9 * (fabs(walk->x0) + fabs(walk->x1));
  return x >= fmin(walk->x0, walk->x1) - room && x <= fmax(walk->x0, walk->x1) + room;
}

static bool has_a_place_at_every_height(const cs_boundary_set *set) {
  for (uint32_t i = 0; i < set->chain_count; i++) {
    cs_boundary_walk walk;
    cs_boundary_start(set, i, set->chains[i].y0, &walk);
    for (int step = 0; step < 2000; step++) {
      if (!is_place(&walk, walk.y0) || !is_place(&walk, walk.y0 + (walk.y1 - walk.y0) / 2))
        return false;
      if (!cs_boundary_next(set, &walk))
        break;
    }
  }
  return true;
}

static bool keeps_half_open_rule(const cs_boundary_set *set, const cs_boundary_frame *frame,
                                 test_random *random) {
  bool passed = true;
  for (size_t i = 0; i < set->piece_count && passed; i++) {
    double y0 = set->pieces[i].y0, y1 = set->pieces[i].y1;
    double heights[6] = {y0,
                         y1,
                         nextafter(y0, -HUGE_VAL),
                         nextafter(y1, HUGE_VAL),
                         random_between(random, y0, y1),
                         floor(y0)};
    for (int k = 0; k < 6; k++)
      if (heights[k] >= frame->top && heights[k] < frame->bottom)
        passed = passed && is_closed_at(set, heights[k]);
  }
  return passed;
}

static bool starts_anywhere(const cs_boundary_set *set, test_random *random) {
  for (uint32_t i = 0; i < set->chain_count; i++) {
    cs_boundary_walk walk, fresh;
    cs_boundary_start(set, i, set->chains[i].y0, &walk);
    double y = set->chains[i].y0, y1 = set->chains[i].y1;
    for (int step = 0; step < 40 && y < y1; step++) {
      while (walk.y1 <= y)
        if (!cs_boundary_next(set, &walk))
          return false;
      cs_boundary_start(set, i, y, &fresh);
      if (!same_segment(&walk, &fresh) || walk.group != fresh.group ||
          walk.segment != fresh.segment || walk.y0 > y)
        return false;
      y += random_below(random, 3) ? random_between(random, 0, (y1 - y) / 8)
                                   : walk.y1 - y; /* the very end of a segment */
    }
  }
  return true;
}

/* The copy has the same vertices in every chain, with the direction reversed. */
static bool is_turned_copy(const cs_boundary_set *a, uint32_t i, const cs_boundary_set *b,
                           uint32_t j) {
  if (a->chains[i].direction != -b->chains[j].direction || a->chains[i].y0 != b->chains[j].y0 ||
      a->chains[i].y1 != b->chains[j].y1)
    return false;
  cs_boundary_walk one, other;
  cs_boundary_start(a, i, a->chains[i].y0, &one);
  cs_boundary_start(b, j, b->chains[j].y0, &other);
  while (same_segment(&one, &other)) {
    bool goes_on = cs_boundary_next(a, &one);
    if (goes_on != cs_boundary_next(b, &other))
      return false;
    if (!goes_on)
      return true;
  }
  return false;
}

static bool are_turned_copies(const cs_boundary_set *a, const cs_boundary_set *b) {
  bool used[4096] = {false};
  if (a->chain_count != b->chain_count || a->chain_count > 4096)
    return false;
  for (uint32_t i = 0; i < a->chain_count; i++) {
    uint32_t j = 0;
    while (j < b->chain_count && (used[j] || !is_turned_copy(a, i, b, j)))
      j++;
    if (j == b->chain_count)
      return false;
    used[j] = true;
  }
  return true;
}

static void check_case(const cs_outline *outline, const celspan_matrix *matrix,
                       const cs_boundary_frame *frame, test_random *random, int seed) {
  cs_boundary_set set = build(outline, matrix, frame);
  cs_outline turned = reversed_outline(outline);
  cs_boundary_set turned_set = build(&turned, matrix, frame);
  int passed = CHECK(is_well_formed(&set, frame));
  passed &= CHECK(keeps_vertices_inside(&set, frame));
  passed &= CHECK(has_a_place_at_every_height(&set));
  passed &= CHECK(keeps_half_open_rule(&set, frame, random));
  passed &= CHECK(starts_anywhere(&set, random));
  passed &= CHECK(are_turned_copies(&set, &turned_set));
  if (!passed)
    fprintf(stderr, "  case %d, frame %g\n", seed, frame->right);
  cs_boundary_finish(&set, context->memory);
  cs_boundary_finish(&turned_set, context->memory);
  cs_outline_finish(&turned, context->memory);
}

static void random_curves_obey_the_rules(void) {
  for (int seed = 1; seed <= 1500; seed++) {
    if (!check_is_drawn(seed))
      continue;
    test_random random = {(uint64_t)seed};
    cs_outline outline;
    random_outline(&random, &outline);
    celspan_matrix matrix = random_matrix(&random);
    check_case(&outline, &matrix, &wide, &random, seed);
    check_case(&outline, &matrix, &small, &random, seed);
    cs_outline_finish(&outline, context->memory);
  }
}

/* Entries over many orders of magnitude: nothing hangs, overflows or loses its partner. */
/* Of any size, up to 1e12. */
static double random_wild(test_random *random) {
  double digits = random_between(random, -1, 1), power = random_between(random, -12, 12);
  return digits * pow(10, power);
}

static void wild_matrices_obey_the_rules(void) {
  for (int seed = 1; seed <= 1500; seed++) {
    if (!check_is_drawn(seed))
      continue;
    test_random random = {(uint64_t)seed + 100000};
    cs_outline outline;
    random_outline(&random, &outline);
    celspan_matrix matrix = random_matrix(&random);
    for (int i = 0; i < 9; i++)
      if (random_below(&random, 3) == 0)
        matrix.m[i] = random_wild(&random);
    if (random_below(&random, 4) == 0)
      matrix.m[random_below(&random, 9)] = 0;
    check_case(&outline, &matrix, &small, &random, seed + 100000);
    cs_outline_finish(&outline, context->memory);
  }
}

/* Outlines flatter than any pixel, down to subnormal heights, where slopes overflow. */
static void the_flattest_curves_obey_the_rules(void) {
  for (int seed = 1; seed <= 500; seed++) {
    if (!check_is_drawn(seed))
      continue;
    test_random random = {(uint64_t)seed + 200000};
    cs_outline outline;
    random_outline(&random, &outline);
    celspan_matrix matrix = random_matrix(&random);
    double flat = pow(10, random_between(&random, -326, -20));
    for (int i = 3; i < 6; i++)
      matrix.m[i] *= flat;
    check_case(&outline, &matrix, &wide, &random, seed + 200000);
    cs_outline_finish(&outline, context->memory);
  }
}

/* ---------------------------------------------------------------- the true curve */

static cs_hpoint on_curve(const cs_bezier *curve, double t) {
  cs_bezier low, high;
  cs_bezier_split(curve, t, &low, &high);
  return high.points[0];
}

static double line_distance(celspan_point a, celspan_point b, double x, double y) {
  double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  double t = length > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / length : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return hypot(a.x + t * dx - x, a.y + t * dy - y);
}

/* An arc is divided into enough lines for their error not to matter. */
static double segment_distance(const cs_boundary_walk *s, double x, double y) {
  int lines = s->curve != 0 ? 64 : 1;
  double least = HUGE_VAL;
  celspan_point a = {s->x0, s->y0};
  for (int k = 1; k <= lines; k++) {
    double height = s->y0 + (s->y1 - s->y0) * k / lines;
    celspan_point b = k == lines ? (celspan_point){s->x1, s->y1}
                                 : (celspan_point){cs_boundary_x(s, height), height};
    least = fmin(least, line_distance(a, b, x, y));
    a = b;
  }
  return least;
}

/* Left of a segment, up to the height's axis. */
static double segment_area(const cs_boundary_walk *s) {
  double height = s->y1 - s->y0;
  return 0.5 * (s->x0 + s->x1) * height - s->curve * height * height * height / 6;
}

static double polyline_distance(const cs_boundary_set *set, double x, double y) {
  double least = HUGE_VAL;
  for (uint32_t i = 0; i < set->chain_count; i++) {
    if (y < set->chains[i].y0 - 1 || y > set->chains[i].y1 + 1)
      continue;
    cs_boundary_walk walk;
    cs_boundary_start(set, i, set->chains[i].y0, &walk);
    do
      least = fmin(least, segment_distance(&walk, x, y));
    while (cs_boundary_next(set, &walk));
  }
  return least;
}

static double polyline_area(const cs_boundary_set *set) {
  double area = 0;
  for (uint32_t i = 0; i < set->chain_count; i++) {
    cs_boundary_walk walk;
    cs_boundary_start(set, i, set->chains[i].y0, &walk);
    do
      area += set->chains[i].direction * segment_area(&walk);
    while (cs_boundary_next(set, &walk));
  }
  return area;
}

static celspan_point flat_point(const cs_bezier *curve, int k, int count) {
  cs_hpoint p = k < count ? on_curve(curve, (double)k / count) : curve->points[curve->degree];
  return (celspan_point){p.x / p.w, p.y / p.w};
}

/* Left of a chord, up to the height's axis. */
static double chord_area(celspan_point a, celspan_point b) {
  return 0.5 * (a.x + b.x) * (b.y - a.y);
}

/* The true area and length, by many chords, and by half as many: the error of both is proportional
 * to the square of the chords' length, so the error that remains is of the fourth power. */
static double true_area(const cs_outline *outline, const celspan_matrix *matrix, double *length) {
  enum { CHORDS = 4000 };
  double fine = 0, coarse = 0;
  *length = 0;
  for (size_t i = 0; i < outline->piece_count; i++) {
    cs_bezier curve;
    cs_bezier_load(outline, i, matrix, &curve);
    celspan_point before, last = flat_point(&curve, 0, CHORDS);
    before = last;
    for (int k = 1; k <= CHORDS; k++) {
      celspan_point next = flat_point(&curve, k, CHORDS);
      fine += chord_area(last, next);
      *length += hypot(next.x - last.x, next.y - last.y);
      last = next;
      if (k % 2 == 1)
        continue;
      coarse += chord_area(before, next);
      before = next;
    }
  }
  return (4 * fine - coarse) / 3;
}

typedef struct nearness {
  double farthest, area; /* pixels; and of it, a pixel of length */
} nearness;

/* The distance between the walked segments and an outline; samples: of each piece. */
static nearness measure_nearness(const cs_outline *outline, const celspan_matrix *matrix,
                                 const cs_boundary_set *set, int samples) {
  double farthest = 0, length;
  for (size_t i = 0; i < outline->piece_count; i++) {
    cs_bezier curve;
    cs_bezier_load(outline, i, matrix, &curve);
    for (int k = 0; k <= samples; k++) {
      cs_hpoint p = on_curve(&curve, (double)k / samples);
      /* Horizontal lines are not part of any chain; their ends are. */
      if (curve.degree > 1 && p.w > 0)
        farthest = fmax(farthest, polyline_distance(set, p.x / p.w, p.y / p.w));
    }
  }
  double area = true_area(outline, matrix, &length);
  return (nearness){farthest, fabs(polyline_area(set) - area) / (1 + length)};
}

static void check_nearness(int seed, double scale, int samples, nearness *worst) {
  static const cs_boundary_frame huge = {-1e7, 1e7, -1e7, 1e7};
  test_random random = {(uint64_t)seed};
  cs_outline outline;
  random_outline(&random, &outline);
  celspan_matrix matrix = random_matrix(&random);
  for (int i = 0; i < 6; i++)
    matrix.m[i] *= scale;
  matrix.m[6] *= 0.3;
  matrix.m[7] *= 0.3;
  cs_boundary_set set = build(&outline, &matrix, scale > 1 ? &huge : &wide);
  nearness near = measure_nearness(&outline, &matrix, &set, samples);
  int passed = CHECK(near.farthest <= 1.3 * CS_BOUNDARY_TOLERANCE) & CHECK(near.area < 2e-5) &
               CHECK(starts_anywhere(&set, &random));
  if (!passed)
    fprintf(stderr, "  case %d, scale %g: %g %g\n", seed, scale, near.farthest, near.area);
  worst->farthest = fmax(worst->farthest, near.farthest);
  worst->area = fmax(worst->area, near.area);
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&outline, context->memory);
}

/* Scaled up, pieces are long enough for arcs over several groups. */
static void polylines_stay_near_their_curves(void) {
  nearness worst = {0, 0};
  for (int seed = 1; seed <= 60; seed++)
    check_nearness(seed, 1, 50, &worst);
  for (int seed = 1; seed <= 12; seed++)
    check_nearness(seed, 2000, 7, &worst);
  if (getenv("CELSPAN_VERBOSE"))
    printf("deviation %g, area/length %g\n", worst.farthest, worst.area);
}

static void a_circle_keeps_its_area(void) {
  double radius = 100;
  cs_outline outline;
  cs_outline_init(&outline);
  MUST(cs_outline_ellipse(context, &outline, (celspan_point){150, 150}, radius, radius));
  celspan_matrix matrix = celspan_matrix_identity();
  cs_boundary_set set = build(&outline, &matrix, &wide);
  double exact = 3.14159265358979 * radius * radius;
  CHECK_NEAR(fabs(polyline_area(&set)), exact, 1e-5 * 2 * 3.1416 * radius);
  CHECK(set.chain_count == 2);
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&outline, context->memory);
}

/* ---------------------------------------------------------------- exact insides */

/* 1 inside, 0 outside, -1 too near the edge to tell, by the shape in its own units. */
typedef int (*inside_test)(double x, double y);

static int in_circle(double x, double y) {
  double r = hypot(x - 50, y - 50);
  return fabs(r - 40) < 1e-3 ? -1 : r < 40;
}

static int in_square(double x, double y) {
  double d = fmax(fabs(x - 50), fabs(y - 50));
  return fabs(d - 40) < 1e-3 ? -1 : d < 40;
}

/* Every point of the frame, mapped back, must be in front of the horizon and inside. Points whose
 * neighbours 0.05 pixels away disagree lie on the flattened edge and are left out. */
static int inside_back(const celspan_matrix *inverse, inside_test test, double x, double y) {
  int first = -1;
  for (int i = 0; i < 5; i++) {
    cs_hpoint p = {x + (i == 1) * 0.05 - (i == 2) * 0.05, y + (i == 3) * 0.05 - (i == 4) * 0.05, 1};
    p = cs_matrix_apply(inverse, p);
    int inside = p.w > 0 ? test(p.x / p.w, p.y / p.w) : 0;
    if (inside < 0 || (i > 0 && inside != first))
      return -1;
    first = inside;
  }
  return first;
}

static void check_insides(const cs_outline *outline, inside_test test, const celspan_matrix *matrix,
                          test_random *random, int seed) {
  celspan_matrix inverse;
  if (!celspan_matrix_inverse(*matrix, &inverse))
    return;
  cs_boundary_set set = build(outline, matrix, &small);
  int wrong = 0;
  for (int i = 0; i < 100; i++) {
    double x = random_between(random, 0, 300), y = random_between(random, 0, 200);
    int hits, expected = inside_back(&inverse, test, x, y);
    if (expected >= 0 && (winding_at(&set, x, y, &hits) != 0) != expected)
      wrong++;
  }
  if (!CHECK(wrong == 0))
    fprintf(stderr, "  case %d: %d points\n", seed, wrong);
  cs_boundary_finish(&set, context->memory);
}

static void the_horizon_cuts_exactly(void) {
  cs_outline circle, square;
  cs_outline_init(&circle);
  cs_outline_init(&square);
  MUST(cs_outline_ellipse(context, &circle, (celspan_point){50, 50}, 40, 40));
  MUST(cs_outline_rect(context, &square, 10, 10, 80, 80, 0));
  for (int seed = 1; seed <= 600; seed++) {
    test_random random = {(uint64_t)seed};
    double angle = random_between(&random, -3.2, 3.2), steep = random_between(&random, 0, 0.03);
    double shift = random_between(&random, -30, 30);
    celspan_point right = random_point(&random, -3, 3, -3, 3);
    double x = random_between(&random, -100, 300);
    celspan_point down = random_point(&random, -3, 3, -3, 3);
    double y = random_between(&random, -100, 200);
    celspan_matrix matrix = {{right.x, right.y, x, down.x, down.y, y, steep * cos(angle),
                              steep * sin(angle),
                              1 - steep * ((50 + shift) * cos(angle) + 50 * sin(angle))}};
    check_insides(&circle, in_circle, &matrix, &random, seed);
    check_insides(&square, in_square, &matrix, &random, seed);
  }
  cs_outline_finish(&circle, context->memory);
  cs_outline_finish(&square, context->memory);
}

static void nothing_behind_the_horizon_is_seen(void) {
  cs_outline square;
  cs_outline_init(&square);
  MUST(cs_outline_rect(context, &square, 10, 10, 80, 80, 0));
  celspan_matrix behind = {{1, 0, 0, 0, 1, 0, 0.01, 0, -5}};
  cs_boundary_set set = build(&square, &behind, &wide);
  CHECK(set.chain_count == 0);
  celspan_box box;
  CHECK(!cs_outline_bounds(&square, &behind, &box));
  /* An affine matrix of negative scale is the same map as its opposite. */
  celspan_matrix opposite = {{-1, 0, 0, 0, -1, 0, 0, 0, -1}};
  cs_boundary_set same = build(&square, &opposite, &wide);
  CHECK(same.chain_count == 2 && same.chains[0].y0 == 10 && same.chains[0].x0 == 10);
  cs_boundary_finish(&set, context->memory);
  cs_boundary_finish(&same, context->memory);
  cs_outline_finish(&square, context->memory);
}

static void a_circle_in_perspective_is_its_conic(void) {
  cs_outline circle;
  cs_outline_init(&circle);
  MUST(cs_outline_ellipse(context, &circle, (celspan_point){50, 50}, 40, 40));
  celspan_matrix matrix = {{3, 0.4, 10, -0.3, 4, 20, 0.004, 0.006, 1}}, inverse;
  CHECK(celspan_matrix_inverse(matrix, &inverse));
  cs_boundary_set set = build(&circle, &matrix, &wide);
  double worst = 0;
  for (uint32_t i = 0; i < set.chain_count; i++) {
    cs_boundary_walk walk;
    cs_boundary_start(&set, i, set.chains[i].y0, &walk);
    do {
      cs_hpoint p = cs_matrix_apply(&inverse, (cs_hpoint){walk.x1, walk.y1, 1});
      worst = fmax(worst, fabs(hypot(p.x / p.w - 50, p.y / p.w - 50) - 40));
    } while (cs_boundary_next(&set, &walk));
  }
  CHECK(set.chain_count == 2);
  CHECK(worst < 1.1 * CS_BOUNDARY_TOLERANCE); /* the scale is near 1 or above everywhere */
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&circle, context->memory);
}

/* ---------------------------------------------------------------- zoom, edges, order */

static void a_huge_zoom_is_cheap(void) {
  cs_outline circle;
  cs_outline_init(&circle);
  MUST(cs_outline_ellipse(context, &circle, (celspan_point){0, 0}, 1, 1));
  for (double zoom = 1e3; zoom <= 1e12; zoom *= 1e3) {
    double slope = sqrt(0.5);
    celspan_matrix matrix =
        celspan_matrix_then(celspan_matrix_translation(-slope, -slope),
                            celspan_matrix_then(celspan_matrix_scaling(zoom, zoom),
                                                celspan_matrix_translation(100, 100)));
    cs_boundary_set set = build(&circle, &matrix, &small);
    uint64_t chords = 0;
    for (size_t i = 0; i < set.piece_count; i++)
      chords += set.pieces[i].chords;
    CHECK(chords < 300);
    int hits;
    /* The edge passes (100, 100) at 45 degrees. */
    CHECK(winding_at(&set, 95, 95, &hits) != 0);
    CHECK(winding_at(&set, 105, 105, &hits) == 0);
    CHECK(winding_at(&set, 30, 160, &hits) != 0 && winding_at(&set, 45, 165, &hits) == 0);
    cs_boundary_finish(&set, context->memory);
  }
  cs_outline_finish(&circle, context->memory);
}

static void a_tall_curve_is_cheap(void) {
  cs_outline circle;
  cs_outline_init(&circle);
  MUST(cs_outline_ellipse(context, &circle, (celspan_point){150, 0}, 100, 1e9));
  celspan_matrix matrix = celspan_matrix_identity();
  cs_boundary_set set = build(&circle, &matrix, &small);
  uint64_t chords = 0;
  for (size_t i = 0; i < set.piece_count; i++)
    chords += set.pieces[i].chords;
  CHECK(set.chain_count == 2 && chords < 10);
  CHECK(set.chains[0].y0 <= 0 && set.chains[0].y1 >= 200);
  CHECK_NEAR(set.chains[0].x0, 50, 1e-6);
  CHECK_NEAR(set.chains[1].x0, 250, 1e-6);
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&circle, context->memory);
}

static void a_chain_goes_on_along_the_side_of_the_frame(void) {
  cs_outline circle;
  cs_outline_init(&circle);
  MUST(cs_outline_ellipse(context, &circle, (celspan_point){20, 100}, 80, 80));
  celspan_matrix matrix = celspan_matrix_identity();
  cs_boundary_set set = build(&circle, &matrix, &small);
  CHECK(set.chain_count == 2);
  const cs_boundary_chain *left = &set.chains[set.chains[0].piece_count == 3 ? 0 : 1];
  const cs_boundary_piece *side = &set.pieces[left->piece + 1];
  CHECK(left->piece_count == 3); /* curve, side, curve */
  CHECK(side->x0 == 0 && side->x1 == 0 && side->chords == 1);
  CHECK_NEAR(side->y0, 100 - sqrt(80 * 80 - 20 * 20), 1e-9);
  CHECK_NEAR(side->y1, 100 + sqrt(80 * 80 - 20 * 20), 1e-9);
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&circle, context->memory);
}

static void shared_edges_are_one(void) {
  for (int seed = 1; seed <= 300; seed++) {
    test_random random = {(uint64_t)seed};
    celspan_point p[4];
    for (int i = 0; i < 4; i++)
      p[i] = random_point(&random, -500, 800, -500, 700);
    const celspan_point one[3] = {p[0], p[1], p[2]}, two[3] = {p[1], p[0], p[3]};
    celspan_matrix matrix = random_matrix(&random);
    matrix.m[6] *= 0.1;
    matrix.m[7] *= 0.1;
    cs_outline outlines[2];
    cs_boundary_set sets[2];
    for (int k = 0; k < 2; k++) {
      cs_outline_init(&outlines[k]);
      MUST(cs_outline_polygon(context, &outlines[k], k ? two : one, 3));
      sets[k] = build(&outlines[k], &matrix, &small);
    }
    cs_hpoint a = cs_matrix_apply(&matrix, (cs_hpoint){p[0].x, p[0].y, 1});
    cs_hpoint b = cs_matrix_apply(&matrix, (cs_hpoint){p[1].x, p[1].y, 1});
    double y0 = fmax(0, fmin(a.y / a.w, b.y / b.w)), y1 = fmin(200, fmax(a.y / a.w, b.y / b.w));
    int missing = 0;
    for (int k = 0; k < 50 && y0 < y1 && a.w > 0 && b.w > 0; k++) {
      double y = random_between(&random, y0, y1), xs[2][16];
      int counts[2] = {0, 0}, shared = 0;
      for (int s = 0; s < 2; s++)
        for (uint32_t i = 0; i < sets[s].chain_count; i++)
          if (sets[s].chains[i].y0 <= y && y < sets[s].chains[i].y1 && counts[s] < 16) {
            cs_boundary_walk walk;
            cs_boundary_start(&sets[s], i, y, &walk);
            xs[s][counts[s]++] = cs_boundary_x(&walk, y);
          }
      for (int i = 0; i < counts[0]; i++)
        for (int j = 0; j < counts[1]; j++)
          shared += same_bits(&xs[0][i], &xs[1][j], sizeof(double));
      missing += shared == 0;
    }
    if (!CHECK(missing == 0))
      fprintf(stderr, "  case %d: %d heights\n", seed, missing);
    for (int k = 0; k < 2; k++) {
      cs_boundary_finish(&sets[k], context->memory);
      cs_outline_finish(&outlines[k], context->memory);
    }
  }
}

static void parts_beside_the_frame_still_count(void) {
  cs_outline square;
  cs_outline_init(&square);
  MUST(cs_outline_rect(context, &square, -500, 50, 1500, 60, 0));
  celspan_matrix matrix = celspan_matrix_identity();
  cs_boundary_set set = build(&square, &matrix, &small);
  CHECK(set.chain_count == 2);
  CHECK(set.chains[0].x0 == 0 && set.chains[1].x0 == 300);
  CHECK(set.chains[0].y0 == 50 && set.chains[0].y1 == 110);
  CHECK(set.chains[0].direction == -1 && set.chains[1].direction == 1);
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&square, context->memory);
}

/* Two bows that touch a side of the frame in their middle are curves, and not that side. */
static void what_touches_a_side_is_inside(void) {
  const char *const data = "M 2 10 Q -2 20 2 30 H 298 Q 302 20 298 10 Z";
  celspan_matrix matrix = celspan_matrix_identity();
  cs_outline shape;
  cs_outline_init(&shape);
  MUST(cs_outline_path(context, &shape, data));
  cs_boundary_set set = build(&shape, &matrix, &small);
  CHECK(set.chain_count == 2);
  for (size_t i = 0; i < set.piece_count; i++)
    CHECK(set.pieces[i].x0 != set.pieces[i].x1 || set.pieces[i].chords > 1);
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&shape, context->memory);
}

static void chains_run_over_the_start_of_a_contour(void) {
  const celspan_point points[6] = {{10, 50}, {0, 100}, {50, 200}, {60, 120}, {50, 0}, {30, 20}};
  cs_outline outline;
  cs_outline_init(&outline);
  MUST(cs_outline_polygon(context, &outline, points, 6));
  celspan_matrix matrix = celspan_matrix_identity();
  cs_boundary_set set = build(&outline, &matrix, &wide);
  CHECK(set.chain_count == 2);
  CHECK(set.chains[0].y0 == 0 && set.chains[0].y1 == 200);
  CHECK(set.chains[0].piece_count + set.chains[1].piece_count == 6);
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&outline, context->memory);
}

static void chains_are_sorted_by_top_then_left(void) {
  test_random random = {5};
  cs_boundary_set set;
  cs_boundary_builder builder;
  cs_boundary_init(&set);
  cs_boundary_builder_init(&builder, context, &set, &wide);
  celspan_matrix matrix = celspan_matrix_identity();
  for (uint32_t layer = 0; layer < 40; layer++) {
    cs_outline outline;
    random_outline(&random, &outline);
    MUST(cs_boundary_add(&builder, &outline, &matrix, layer / 2));
    cs_outline_finish(&outline, context->memory);
  }
  cs_boundary_builder_finish(&builder);
  for (size_t i = 0; i < set.chain_count; i++) { /* many differ by less than a float does */
    const double tops[] = {set.chains[i].y0, -1e-12, 0, -0.0, 70 - 1e-12 * (double)(i % 7), 70};
    set.chains[i].y0 = tops[i % 6];
  }
  MUST(cs_boundary_sort(context, &set));
  bool is_sorted = true;
  for (size_t i = 1; i < set.chain_count; i++) {
    const cs_boundary_chain *a = &set.chains[i - 1], *b = &set.chains[i];
    is_sorted =
        is_sorted &&
        (a->y0 < b->y0 ||
         (a->y0 == b->y0 &&
          (a->x0 < b->x0 || (a->x0 == b->x0 && (a->layer < b->layer ||
                                                (a->layer == b->layer && a->piece < b->piece))))));
  }
  CHECK(is_sorted && set.chain_count > 40);
  cs_boundary_finish(&set, context->memory);
}

/* Arrays that are as large as was said do not grow. */
static void outlines_are_expected(void) {
  const celspan_matrix matrix = celspan_matrix_identity();
  cs_outline outline;
  cs_boundary_set set;
  cs_boundary_builder builder;
  cs_outline_init(&outline);
  MUST(cs_outline_path(context, &outline, "M0 0L9 9C8 40 90 60 9 99Q0 9 5 5z"));
  cs_boundary_init(&set);
  cs_boundary_builder_init(&builder, context, &set, &small);
  MUST(cs_boundary_expect(context, &set, 100 * outline.piece_count, 100 * outline.point_count));
  const void *begins[] = {set.points, set.pieces};
  for (uint32_t layer = 0; layer < 100; layer++)
    MUST(cs_boundary_add(&builder, &outline, &matrix, layer));
  CHECK(set.chain_count > 100 && begins[0] == set.points && begins[1] == set.pieces);
  cs_boundary_builder_finish(&builder);
  cs_boundary_finish(&set, context->memory);
  cs_outline_finish(&outline, context->memory);
}

/* Every allocation fails in turn: the status says so, and nothing leaks. */
static void failing_memory_is_reported(void) {
  bool is_done = false;
  celspan_context *old = context;
  for (size_t n = 2; n < 200 && !is_done; n++) {
    memory_watch watch = {.fail_at = 0};
    cs_outline outline, plain;
    cs_boundary_set set;
    cs_boundary_builder builder;
    context = memory_watch_context(&watch);
    watch.fail_at = watch.allocations + n - 1;
    cs_outline_init(&outline);
    cs_outline_init(&plain);
    cs_boundary_init(&set);
    cs_boundary_builder_init(&builder, context, &set, &small);
    celspan_matrix steep = {{1, 0, 0, 0, 1, 0, 0.01, 0, -0.5}}, level = celspan_matrix_identity();
    celspan_status status = cs_outline_path(
        context, &outline, "M0 0L90 9 80 80A50 20 0 0 1 4 4C100 3 7 80 3 90zM5 5h90v90h-90z");
    if (status == CELSPAN_OK)
      status = cs_outline_path(context, &plain, "M9 9L90 9Q200 80 80 80C60 8 40 150 4 90z");
    if (status == CELSPAN_OK)
      status = cs_boundary_add(&builder, &outline, &steep, 0);
    if (status == CELSPAN_OK)
      status = cs_boundary_add(&builder, &plain, &level, 1);
    if (status == CELSPAN_OK)
      status = cs_boundary_sort(context, &set);
    cs_boundary_builder_finish(&builder);
    is_done = status == CELSPAN_OK;
    CHECK(is_done || status == CELSPAN_NO_MEMORY);
    cs_boundary_finish(&set, context->memory);
    cs_outline_finish(&outline, context->memory);
    cs_outline_finish(&plain, context->memory);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(is_done);
  context = old;
}

int main(void) {
  MUST(celspan_context_create(NULL, &context));
  random_curves_obey_the_rules();
  wild_matrices_obey_the_rules();
  the_flattest_curves_obey_the_rules();
  polylines_stay_near_their_curves();
  a_circle_keeps_its_area();
  the_horizon_cuts_exactly();
  nothing_behind_the_horizon_is_seen();
  a_circle_in_perspective_is_its_conic();
  a_huge_zoom_is_cheap();
  a_tall_curve_is_cheap();
  a_chain_goes_on_along_the_side_of_the_frame();
  shared_edges_are_one();
  parts_beside_the_frame_still_count();
  what_touches_a_side_is_inside();
  chains_run_over_the_start_of_a_contour();
  outlines_are_expected();
  chains_are_sorted_by_top_then_left();
  failing_memory_is_reported();
  size_t bytes, peak;
  uint64_t allocations;
  celspan_context_memory(context, &bytes, &peak, &allocations);
  CHECK(bytes == sizeof *context);
  celspan_context_destroy(context);
  return check_done();
}
