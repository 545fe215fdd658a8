/* Strokes: the curves that are passed to the sweep, compared with the probe's own arithmetic.
 *
 * CELSPAN_STROKES=n tries n strokes instead of 400; CASE=n tries that one alone. Each is seen at
 * 1,024 and at 1,048,576 pixels a side, at POINTS points each: half of them anywhere, half near an
 * edge. One file, because lines, joins, caps, dashes and tapers share their random cases and one
 * check.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "celspan/celspan.h"
#include "model/scene/inside.h"
#include "model/stroke/dashes.h"
#include "model/stroke/outliner.h"
#include "model/stroke/spoke.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define SIDE 100.0 /* film units */
#define POINTS 250
#define EDGE 0.01 /* pixels */

/* ---------------------------------------------------------------- random strokes */

typedef struct sketch {
  celspan_stroke_desc desc;
  celspan_point points[12];
  double widths[12], dashes[4];
  char data[1024];
} sketch;

static double random_coordinate(test_random *random) {
  double any = random_between(random, -10, 110);
  return random_below(random, 4) == 0 ? floor(any / 10) * 10 : any;
}

static void random_path(test_random *random, sketch *s) {
  static const char letters[] = "LLCCSQTAHV";
  size_t at =
      (size_t)snprintf(s->data, sizeof s->data, "M%.4f %.4f", random_coordinate(random), 50.0);
  for (int i = 1 + random_below(random, 4); i > 0; i--) {
    char letter = letters[random_below(random, 10)];
    int pairs = letter == 'C' ? 3 : letter == 'S' || letter == 'Q' ? 2 : 1;
    double rx = random_between(random, 1, 40), ry = random_between(random, 1, 40);
    at += (size_t)snprintf(s->data + at, sizeof s->data - at, "%c", letter);
    if (letter == 'A')
      at += (size_t)snprintf(s->data + at, sizeof s->data - at, "%.4f %.4f 30 1 0 ", rx, ry);
    for (int k = 0; k < pairs; k++) {
      double x = random_coordinate(random), y = random_coordinate(random);
      bool is_single = letter == 'H' || letter == 'V';
      at += is_single ? (size_t)snprintf(s->data + at, sizeof s->data - at, "%.4f ", x)
                      : (size_t)snprintf(s->data + at, sizeof s->data - at, "%.4f %.4f ", x, y);
    }
    if (random_below(random, 5) == 0)
      at += (size_t)snprintf(s->data + at, sizeof s->data - at, "Z");
  }
  s->desc.data = s->data;
}

static void random_points(test_random *random, sketch *s) {
  int count = 1 + random_below(random, 8);
  double widest = random_between(random, 0, 40);
  for (int i = 0; i < count; i++) {
    double x = random_coordinate(random), y = random_coordinate(random);
    s->points[i] = (celspan_point){x, y};
    if (i > 0 && random_below(random, 12) == 0)
      s->points[i] = s->points[i - 1];
    s->widths[i] = random_below(random, 6) == 0 ? 0 : random_between(random, 0, widest);
  }
  s->desc.points = s->points;
  s->desc.point_count = (size_t)count;
  s->desc.widths = random_below(random, 3) > 0 ? s->widths : NULL;
  s->desc.degree = 1 + random_below(random, 4);
  s->desc.closed = random_below(random, 3) == 0;
}

static void random_sketch(test_random *random, sketch *s) {
  *s = (sketch){.desc = CELSPAN_STROKE_DESC};
  if (random_below(random, 2) == 0)
    random_path(random, s);
  else
    random_points(random, s);
  bool is_wide = random_below(random, 3) == 0;
  s->desc.width = random_between(random, 0, is_wide ? 60 : 8);
  s->desc.cap = (celspan_stroke_cap)random_below(random, 3);
  s->desc.join = (celspan_stroke_join)random_below(random, 3);
  s->desc.miter = random_between(random, 1, 6);
  if (random_below(random, 3) == 0) {
    s->desc.dashes = s->dashes;
    s->desc.dash_count = 1 + (size_t)random_below(random, 4);
    for (size_t i = 0; i < s->desc.dash_count; i++)
      s->dashes[i] = random_below(random, 5) == 0 && i > 0 ? 0 : random_between(random, 2, 30);
    s->desc.dash_offset = random_between(random, -40, 40);
  }
  if (random_below(random, 3) == 0) {
    s->desc.taper[0] = random_between(random, 0, 60);
    s->desc.taper[1] = random_below(random, 2) == 0 ? 0 : random_between(random, 0, 60);
    s->desc.profile =
        s->desc.taper[0] < 30 ? CELSPAN_STROKE_PROFILE_STRAIGHT : CELSPAN_STROKE_PROFILE_ROUND;
  }
  if (random_below(random, 3) == 0) {
    s->desc.from = random_between(random, -0.2, 0.6);
    s->desc.to = random_between(random, 0.4, 1.2);
  }
}

/* ---------------------------------------------------------------- the oracle */

typedef struct trial {
  const cs_stroke *stroke;
  cs_outline outline;
  celspan_matrix matrix, inverse;
  double side;
} trial;

static bool sees(const trial *t, double x, double y, bool *is_inside) {
  celspan_point own;
  if (!cs_inside_own_point(&t->matrix, (celspan_point){x, y}, &own))
    return false;
  *is_inside = cs_inside_stroke(t->stroke, own);
  return true;
}

/* Whether the outline agrees about some point nearer than EDGE. */
static bool is_near_edge(const trial *t, double x, double y, bool drawn) {
  static const double shares[] = {1, 0.6, 0.25};
  for (int i = 0; i < 16; i++)
    for (int k = 0; k < 3; k++) {
      double angle = i * 0.39269908169872414, radius = shares[k] * EDGE;
      bool is_inside;
      if (sees(t, x + radius * cos(angle), y + radius * sin(angle), &is_inside) &&
          is_inside == drawn)
        return true;
    }
  return false;
}

static celspan_point random_place(const trial *t, test_random *random) {
  if (random_below(random, 2) == 0 || t->outline.piece_count == 0)
    return random_point(random, 0, t->side, 0, t->side);
  size_t piece = random_bits(random) % t->outline.piece_count;
  const cs_hpoint *p = t->outline.points + t->outline.starts[piece];
  double share = random_between(random, 0, 1), angle = random_between(random, 0, 6.2831853);
  double away = pow(10, random_between(random, -2, 1));
  int degree = t->outline.degrees[piece];
  celspan_point at = {p[0].x + share * (p[degree].x - p[0].x),
                      p[0].y + share * (p[degree].y - p[0].y)};
  if (degree == 3) {
    double s = 1 - share, a = s * s * s, b = 3 * s * s * share, c = 3 * s * share * share,
           d = share * share * share;
    at = (celspan_point){a * p[0].x + b * p[1].x + c * p[2].x + d * p[3].x,
                         a * p[0].y + b * p[1].y + c * p[2].y + d * p[3].y};
  }
  const double *m = t->matrix.m;
  double w = m[6] * at.x + m[7] * at.y + m[8];
  return (celspan_point){(m[0] * at.x + m[1] * at.y + m[2]) / w + away * cos(angle),
                         (m[3] * at.x + m[4] * at.y + m[5]) / w + away * sin(angle)};
}

static int try_points(const trial *t, test_random *random, int points) {
  int wrong = 0;
  for (int i = 0; i < points; i++) {
    celspan_point at = random_place(t, random), own;
    bool inside;
    if (at.x < 0 || at.y < 0 || at.x > t->side || at.y > t->side || !sees(t, at.x, at.y, &inside) ||
        !cs_inside_own_point(&t->matrix, at, &own))
      continue;
    bool drawn = cs_inside_outline(&t->outline, CELSPAN_RULE_NONZERO, own);
    if (drawn != inside && !is_near_edge(t, at.x, at.y, drawn)) {
      if (wrong++ == 0)
        fprintf(stderr, "  at %.4f, %.4f of %.0f (own %.6f, %.6f): drawn %d\n", at.x, at.y, t->side,
                own.x, own.y, drawn);
    }
  }
  return wrong;
}

static void print_sketch(const sketch *s) {
  const celspan_stroke_desc *d = &s->desc;
  fprintf(
      stderr,
      "  cap %d join %d miter %g width %g degree %d closed %d from %g to %g taper %g %g profile %d",
      d->cap, d->join, d->miter, d->width, d->degree, d->closed, d->from, d->to, d->taper[0],
      d->taper[1], d->profile);
  for (size_t i = 0; i < d->dash_count; i++)
    fprintf(stderr, " dash %g", d->dashes[i]);
  fprintf(stderr, " offset %g\n  %s\n", d->dash_offset, d->data ? d->data : "");
  for (size_t i = 0; i < d->point_count; i++)
    fprintf(stderr, "  {%.4f, %.4f, %.4f}", d->points[i].x, d->points[i].y,
            d->widths ? d->widths[i] : d->width);
  fprintf(stderr, "\n");
}

/* The placement of a stroke: unchanged, rotated, or in perspective. */
static celspan_matrix random_placement(test_random *random, double side) {
  celspan_matrix scale = celspan_matrix_scaling(side / SIDE, side / SIDE);
  int kind = random_below(random, 4);
  if (kind == 1)
    return celspan_matrix_then((celspan_matrix){{0.8, -0.5, 20, 0.3, 1.4, -10, 0, 0, 1}}, scale);
  if (kind == 2)
    return celspan_matrix_then((celspan_matrix){{1, 0.2, -5, 0.1, 1.1, 0,
                                                 random_between(random, -0.008, 0.012), 0.004, 1}},
                               scale);
  return scale;
}

static cs_stroke_view whole_view(celspan_matrix matrix, double side) {
  return (cs_stroke_view){.matrix = matrix,
                          .frame = {0, side, 0, side},
                          .tolerance = CS_STROKE_TOLERANCE,
                          .bottom = side,
                          .right = side};
}

static bool try_stroke(celspan_context *context, int number, double side, size_t *pieces) {
  test_random random = {(uint64_t)number};
  sketch s;
  random_sketch(&random, &s);
  celspan_object *object = NULL;
  if (celspan_object_create_stroke(context, &s.desc, &object) != CELSPAN_OK) {
    fprintf(stderr, "case %d: %s\n", number, celspan_context_error(context));
    return false;
  }
  trial t = {.stroke = object->data->stroke, .side = side};
  t.matrix = random_placement(&random, side);
  const cs_stroke_view view = whole_view(t.matrix, side);
  cs_outline_init(&t.outline);
  celspan_status status = cs_stroke_outline(context, t.stroke, &view, &t.outline);
  int wrong = status == CELSPAN_OK ? try_points(&t, &random, POINTS) : 1;
  *pieces += t.outline.piece_count;
  if (wrong > 0) {
    fprintf(stderr, "CASE=%d: %d points are wrong at %.0f pixels a side, %zu pieces\n", number,
            wrong, side, t.outline.piece_count);
    print_sketch(&s);
  }
  cs_outline_finish(&t.outline, object->memory);
  celspan_object_unref(object);
  return wrong == 0;
}

static void test_outlines(celspan_context *context) {
  const char *only = getenv("CASE"), *asked = getenv("CELSPAN_STROKES");
  int first = only ? atoi(only) : 1, count = asked ? atoi(asked) : 400;
  int last = only ? first : count, bad = 0;
  size_t small = 0, large = 0;
  for (int i = first; i <= last; i++) {
    if (!only && !check_is_drawn(i))
      continue;
    bad += !try_stroke(context, i, 1024, &small);
    bad += !try_stroke(context, i, 1048576, &large);
  }
  CHECK(bad == 0);
  printf("%d strokes: %zu curves at 1,024 pixels a side, %zu at 1,048,576\n", last - first + 1,
         small, large);
}

/* ---------------------------------------------------------------- what a frame can show */

typedef struct counted {
  celspan_context *context;
  celspan_object *object;
} counted;

static counted make_stroke(celspan_context *context, const celspan_stroke_desc *desc) {
  counted c = {context, NULL};
  CHECK(celspan_object_create_stroke(context, desc, &c.object) == CELSPAN_OK);
  return c;
}

static void make_outline(const counted *c, const cs_stroke_view *view, cs_outline *outline) {
  cs_outline_init(outline);
  CHECK(cs_stroke_outline(c->context, c->object->data->stroke, view, outline) == CELSPAN_OK);
}

/* The number of curves that are passed to the sweep. */
static size_t count_curves(const counted *c, const cs_stroke_view *view) {
  cs_outline outline;
  make_outline(c, view, &outline);
  size_t count = outline.piece_count;
  cs_outline_finish(&outline, c->object->memory);
  return count;
}

/* The outline made for some rows equals the whole one there. */
static void test_rows(celspan_context *context) {
  for (int number = 1; number <= 200; number++) {
    test_random random = {(uint64_t)number};
    sketch s;
    random_sketch(&random, &s);
    counted c = make_stroke(context, &s.desc);
    cs_stroke_view view = whole_view(random_placement(&random, 4096), 4096);
    celspan_matrix inverse;
    cs_outline whole, rows;
    make_outline(&c, &view, &whole);
    view.top = 64 * random_below(&random, 64);
    view.bottom = view.top + 64;
    make_outline(&c, &view, &rows);
    CHECK(rows.piece_count <= whole.piece_count + 8 * whole.contour_count);
    int wrong = celspan_matrix_inverse(view.matrix, &inverse) ? 0 : 1;
    for (int i = 0; i < 100; i++) {
      celspan_point own, at = random_point(&random, 0, 4096, view.top, view.bottom);
      if (cs_inside_own_point(&view.matrix, at, &own))
        wrong += cs_inside_outline(&whole, CELSPAN_RULE_NONZERO, own) !=
                 cs_inside_outline(&rows, CELSPAN_RULE_NONZERO, own);
    }
    if (!CHECK(wrong == 0))
      fprintf(stderr, "  rows of case %d\n", number);
    cs_outline_finish(&whole, c.object->memory);
    cs_outline_finish(&rows, c.object->memory);
    celspan_object_unref(c.object);
  }
}

/* For a wave from side to side of a frame of 1,048,576 pixels, the cost of a strip is that of
 * its visible part: all strips together have the whole outline's curves, and a few more for
 * every cut. */
static void test_strip(celspan_context *context) {
  enum { STRIPS = 64 };
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.data = "M0 50C30 -60 60 160 100 50C70 -60 40 160 0 50";
  desc.width = 3;
  counted c = make_stroke(context, &desc);
  const double side = 1048576;
  cs_stroke_view view = whole_view(celspan_matrix_scaling(side / SIDE, side / SIDE), side);
  size_t whole = count_curves(&c, &view), sum = 0, most = 0;
  CHECK(whole > 160 && whole < 400);
  for (int i = 0; i < STRIPS; i++) {
    view.top = i * side / STRIPS;
    view.bottom = view.top + 64;
    size_t strip = count_curves(&c, &view);
    sum += strip;
    most = strip > most ? strip : most;
  }
  CHECK(most <= whole / 2);
  CHECK(sum / STRIPS <= whole / 5);
  printf("a wave: %zu curves, %.1f in a strip, %zu at most\n", whole, (double)sum / STRIPS, most);
  view.top = 1e6; /* below the wave, above the foot of its control points */
  view.bottom = view.top + 64;
  CHECK(count_curves(&c, &view) <= 24);
  celspan_object_unref(c.object);
}

/* Of a line of 1,048,576 pixels with dashes of 3 a frame of 1,024 shows 171. */
static void test_dashes(celspan_context *context) {
  const double dash = 3;
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.data = "M0 500H1048576";
  desc.dashes = &dash;
  desc.dash_count = 1;
  counted c = make_stroke(context, &desc);
  CHECK(c.object->data->stroke->part_count == 174763);
  cs_stroke_view view = whole_view(celspan_matrix_translation(-500000, 0), 1024);
  size_t shown = count_curves(&c, &view);
  CHECK(shown >= 170 * 3 && shown <= 173 * 4);
  view.matrix = celspan_matrix_translation(-500000, -2000);
  CHECK(count_curves(&c, &view) == 0);
  view = whole_view(celspan_matrix_scaling(1, 1), 1048576);
  view.top = 512;
  CHECK(count_curves(&c, &view) == 0);
  celspan_object_unref(c.object);
}

/* Very many dashes are placed along a curve like a few of the same lengths, past its cusp too: the
 * dash after 500 repeats of a pattern begins where one 500 times as long ends. */
static void test_many_dashes(celspan_context *context) {
  const double fine[] = {0.04, 0.04}, coarse[] = {40, 1000};
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.data = "M0 0C100 80 0 80 100 0";
  desc.dashes = fine;
  desc.dash_count = 2;
  counted many = make_stroke(context, &desc);
  desc.dashes = coarse;
  counted few = make_stroke(context, &desc);
  const cs_stroke *a = many.object->data->stroke, *b = few.object->data->stroke;
  CHECK(a->part_count > 1000 && b->part_count == 1);
  cs_parts fine_parts, coarse_parts;
  cs_parts_init(&fine_parts, a);
  cs_parts_init(&coarse_parts, b);
  CHECK_NEAR(cs_parts_get(&fine_parts, 500).begin, cs_parts_get(&coarse_parts, 0).end, 1e-9);
  double end = -1;
  for (size_t i = 0; i < a->part_count; i++) {
    cs_stroke_part part = cs_parts_get(&fine_parts, i);
    CHECK(part.begin > end && part.end > part.begin);
    end = part.end;
  }
  celspan_object_unref(many.object);
  celspan_object_unref(few.object);
}

/* Hard cases: where the sides turn round, and where they would need a line for every step. The
 * number of curves grows with the fourth root of the size or less, 5.7 from one size to the other;
 * where a line stops it grows with its logarithm. */
static void test_folds(celspan_context *context) {
  static celspan_point spiral[120];
  static double brush[120];
  for (int i = 0; i < 120; i++) {
    spiral[i] =
        (celspan_point){50 + (2 + 0.3 * i) * cos(0.3 * i), 50 + (2 + 0.3 * i) * sin(0.3 * i)};
    brush[i] = 12 + 10 * sin(0.7 * i);
  }
  static const struct {
    const char *name, *data; /* NULL: the spiral */
    double width;
    size_t most[2]; /* at 1,024 and at 1,048,576 pixels a side */
  } lines[] = {{"hairpin", "M20 80C48 10 52 10 80 80", 60, {90, 380}},
               {"tight hairpin", "M48 80C49.9 -20 50.1 -20 52 80", 40, {100, 380}},
               {"cusp", "M20 20C80 80 20 80 80 20", 30, {85, 250}},
               {"rest", "M50 50S66 48 53 80", 10, {28, 90}},
               {"loop", "M10 50C130 20 -30 20 90 50", 50, {190, 1060}},
               {"brush", NULL, 0, {1900, 2300}}};
  for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
    celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
    desc.data = lines[i].data;
    desc.width = lines[i].width;
    if (!desc.data) {
      desc.points = spiral;
      desc.widths = brush;
      desc.point_count = 120;
    }
    counted c = make_stroke(context, &desc);
    const double sides[2] = {1024, 1048576};
    for (int k = 0; k < 2; k++) {
      trial t = {.stroke = c.object->data->stroke, .side = sides[k]};
      t.matrix = celspan_matrix_scaling(sides[k] / SIDE, sides[k] / SIDE);
      const cs_stroke_view view = whole_view(t.matrix, sides[k]);
      test_random random = {i};
      make_outline(&c, &view, &t.outline);
      printf("%-14s %7.0f pixels a side: %6zu curves\n", lines[i].name, sides[k],
             t.outline.piece_count);
      CHECK(t.outline.piece_count <= lines[i].most[k]);
      CHECK(try_points(&t, &random, lines[i].data ? 300 : 20) == 0);
      cs_outline_finish(&t.outline, c.object->memory);
    }
    celspan_object_unref(c.object);
  }
}

/* Where a line turns back on itself the whole disc of that place is visible, whichever way rounding
 * turns it: half of it lies beyond both sides. */
static void test_cusps(celspan_context *context) {
  static const celspan_point shapes[][4] = {{{-20, -10}, {20, 10}, {-20, 10}, {20, -10}},
                                            {{-20, 0}, {20, 0}, {20, 0}, {-20, 0}},
                                            {{-20, 0}, {30, 0}, {0, 0}, {-10, 0}}};
  int wrong = 0;
  for (int k = 0; k < 3 * 72; k++) {
    char data[400];
    double c = cos(0.0872664626 * (k / 3)), d = sin(0.0872664626 * (k / 3)), p[8];
    for (int i = 0; i < 4; i++) {
      p[2 * i] = 50 + c * shapes[k % 3][i].x - d * shapes[k % 3][i].y;
      p[2 * i + 1] = 50 + d * shapes[k % 3][i].x + c * shapes[k % 3][i].y;
    }
    snprintf(data, sizeof data, "M%.17g %.17gC%.17g %.17g %.17g %.17g %.17g %.17g", p[0], p[1],
             p[2], p[3], p[4], p[5], p[6], p[7]);
    celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
    desc.data = data;
    desc.width = 6;
    counted stroke = make_stroke(context, &desc);
    const cs_stroke_view view = whole_view(celspan_matrix_scaling(10, 10), 1000);
    cs_outline outline;
    make_outline(&stroke, &view, &outline);
    for (double x = 20; x < 80; x += 0.7)
      for (double y = 45; y < 55; y += 0.7) {
        celspan_point at = {50 + c * (x - 50) - d * (y - 50), 50 + d * (x - 50) + c * (y - 50)};
        bool is_inside = cs_inside_stroke(stroke.object->data->stroke, at);
        wrong += is_inside != cs_inside_outline(&outline, CELSPAN_RULE_NONZERO, at);
      }
    cs_outline_finish(&outline, stroke.object->memory);
    celspan_object_unref(stroke.object);
  }
  printf("cusps: %d of the places are wrong\n", wrong);
  CHECK(wrong == 0);
}

/* A single nonzero width among many zeros makes a bump, whose flanks are so steep that discs are
 * inside their neighbours for a short distance, anywhere along the piece. */
static void test_swallowed(celspan_context *context) {
  celspan_point line[16];
  double bump[16];
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.points = line;
  desc.widths = bump;
  desc.point_count = 16;
  desc.degree = 15;
  desc.cap = CELSPAN_STROKE_CAP_ROUND;
  for (int number = 1; number <= 40; number++) {
    test_random random = {(uint64_t)number};
    int place = random_below(&random, 16);
    for (int i = 0; i < 16; i++) {
      line[i] = (celspan_point){6.0 * i + 5, 50 + random_between(&random, -6, 6)};
      bump[i] = i == place ? random_between(&random, 30, 90) : 0;
    }
    counted c = make_stroke(context, &desc);
    const double side = number % 2 ? 1024 : 1048576;
    trial t = {.stroke = c.object->data->stroke, .side = side};
    t.matrix = celspan_matrix_scaling(side / SIDE, side / SIDE);
    cs_stroke_view view = whole_view(t.matrix, side);
    make_outline(&c, &view, &t.outline);
    if (!CHECK(try_points(&t, &random, 80) == 0))
      fprintf(stderr, "  bump %d\n", number);
    cs_outline_finish(&t.outline, c.object->memory);
    celspan_object_unref(c.object);
  }
}

/* Corners of pieces that are shorter than they are wide: only the shapes of the corner itself cover
 * the area between their spokes. */
static void test_short_corners(celspan_context *context) {
  celspan_point line[6];
  double widths[6];
  for (int number = 1; number <= 150; number++) {
    test_random random = {(uint64_t)number};
    celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
    desc.points = line;
    desc.point_count = 3 + (size_t)random_below(&random, 4);
    desc.widths = random_below(&random, 2) == 0 ? widths : NULL;
    desc.width = random_between(&random, 20, 60);
    desc.join = (celspan_stroke_join)random_below(&random, 3);
    desc.cap = (celspan_stroke_cap)random_below(&random, 3);
    desc.closed = random_below(&random, 4) == 0;
    for (size_t i = 0; i < desc.point_count; i++) {
      line[i] = random_point(&random, 44, 56, 44, 56);
      widths[i] = random_between(&random, 25, 32);
    }
    counted c = make_stroke(context, &desc);
    trial t = {.stroke = c.object->data->stroke, .side = 1024};
    t.matrix = celspan_matrix_scaling(1024 / SIDE, 1024 / SIDE);
    const cs_stroke_view view = whole_view(t.matrix, 1024);
    make_outline(&c, &view, &t.outline);
    if (!CHECK(try_points(&t, &random, 300) == 0))
      fprintf(stderr, "  short corners %d\n", number);
    cs_outline_finish(&t.outline, c.object->memory);
    celspan_object_unref(c.object);
  }
}

/* A window of 1,024 pixels somewhere on a random stroke that is up to a million times as large:
 * lines leave it and come back, closed ones too. */
static void test_windows(celspan_context *context) {
  size_t most = 0;
  for (int number = 1; number <= 250; number++) {
    test_random random = {(uint64_t)number};
    sketch s;
    random_sketch(&random, &s);
    s.desc.dashes = NULL;
    s.desc.dash_count = 0;
    if (s.desc.point_count > 2 && random_below(&random, 2) == 0)
      s.desc.closed = true;
    counted c = make_stroke(context, &s.desc);
    const cs_stroke *stroke = c.object->data->stroke;
    double scale = pow(10, random_between(&random, 0.5, 5));
    if (stroke->line.point_count > 0) {
      cs_hpoint on = stroke->line.points[random_bits(&random) % stroke->line.point_count];
      trial t = {.stroke = stroke, .side = 1024};
      t.matrix = celspan_matrix_then(celspan_matrix_translation(-on.x / on.w, -on.y / on.w),
                                     celspan_matrix_scaling(scale, scale));
      double x = random_between(&random, 0, 1024), y = random_between(&random, 0, 1024);
      t.matrix = celspan_matrix_then(t.matrix, celspan_matrix_translation(x, y));
      const cs_stroke_view view = whole_view(t.matrix, 1024);
      make_outline(&c, &view, &t.outline);
      if (!CHECK(try_points(&t, &random, 100) == 0))
        fprintf(stderr, "  window %d\n", number);
      most = t.outline.piece_count > most ? t.outline.piece_count : most;
      cs_outline_finish(&t.outline, c.object->memory);
    }
    celspan_object_unref(c.object);
  }
  CHECK(most <= 400);
}

/* ---------------------------------------------------------------- spokes and views */

/* Where a line stops, its slope is that of its neighbouring points, in both directions. */
static void test_rest(void) {
  cs_curve curve = {.line = {.degree = 2, .points = {{0, 0, 1}, {10, 0, 1}, {10, 0, 1}}},
                    .radius_degree = 1,
                    .radius = {1, 3}};
  cs_spoke end = cs_spoke_at(&curve, 1);
  CHECK(end.slope == 1 && end.tangent.x == 1);
  cs_curve_reverse(&curve);
  cs_spoke begin = cs_spoke_at(&curve, 0);
  CHECK(begin.slope == -1 && begin.tangent.x == -1);
  curve.radius[0] = 1;
  CHECK(cs_spoke_at(&curve, 0).slope == 0);
}

/* A circle of radius 10: a spoke of 8 moves forwards, one of 10 rests, one of 12 moves backwards
 * around its centre; on the outside all move forwards. */
static void test_motion(void) {
  const double k = 0.70710678118654752;
  cs_curve curve = {
      .line = {.degree = 2, .points = {{10, 0, 1}, {10 * k, -10 * k, k}, {0, -10, 1}}}};
  static const int paces[3] = {1, 0, -1};
  for (int i = 0; i < 3; i++) {
    curve.radius[0] = 8 + 2 * i;
    cs_spoke inside = cs_spoke_at(&curve, 0.3), outside = cs_spoke_turned(&inside);
    if (!CHECK(inside.tip.x * inside.tip.x + inside.tip.y * inside.tip.y < 5))
      continue;
    cs_spoke_motion motion = cs_spoke_move(&curve, 0.3, &inside);
    CHECK(motion.pace == paces[i]);
    if (motion.pace < 0)
      CHECK_NEAR(motion.pivot, 10, 1e-9);
    cs_curve back = curve;
    cs_curve_reverse(&back);
    CHECK(cs_spoke_move(&back, 0.7, &outside).pace == 1);
  }
}

/* Outside the frame a quarter of the distance is allowed, inside it the tolerance. */
static void test_allowance(void) {
  const cs_stroke_view view = whole_view(celspan_matrix_scaling(2, 2), 1024);
  const celspan_box boxes[] = {
      {100, 100, 10, 10}, {532, 100, 10, 10}, {100, -30, 10, 10}, {-60, 552, 20, 20}};
  const double allowed[] = {CS_STROKE_TOLERANCE, 10, 10, 20};
  for (int i = 0; i < 4; i++)
    CHECK_NEAR(cs_stroke_view_allowance(&view, &boxes[i]), allowed[i], 1e-12);
}

/* Dashes along a curve that extends far beyond the frame, at any scale: the cost depends on the
 * visible part only; and that is right, however small a part it is. */
static void test_far(celspan_context *context) {
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.data = "M0 50C30 -60 60 160 100 50";
  desc.width = 1;
  counted c = make_stroke(context, &desc);
  size_t most = 0;
  for (double scale = 1; scale <= 1e7; scale *= 10) {
    celspan_matrix to = celspan_matrix_then(celspan_matrix_translation(-50, -50),
                                            celspan_matrix_scaling(scale, scale));
    trial t = {.stroke = c.object->data->stroke, .side = 1024};
    t.matrix = celspan_matrix_then(to, celspan_matrix_translation(512, 512 - 0.5 * scale));
    cs_stroke_view view = whole_view(t.matrix, 1024);
    make_outline(&c, &view, &t.outline);
    test_random random = {(uint64_t)scale};
    CHECK(try_points(&t, &random, 200) == 0);
    most = t.outline.piece_count > most ? t.outline.piece_count : most;
    cs_outline_finish(&t.outline, c.object->memory);
    view.matrix = celspan_matrix_then(view.matrix, celspan_matrix_translation(0, 1e9));
    CHECK(count_curves(&c, &view) == 0);
  }
  CHECK(most <= 64);
  celspan_object_unref(c.object);
}

/* The number of curves passed on for lines of a drawing, 1,024 pixels a side: tests/bench/stroke.c
 * compares the time with that of filling the same curves. */
static void test_cost(celspan_context *context) {
  static const struct {
    const char *data;
    size_t most;
  } lines[] = {
      {"M10 10L90 20L30 60L80 90", 16}, /* sides, caps, joins */
      {"M10 90C10 40 30 10 50 10S90 40 90 90", 14},
      {"M50 10A40 40 0 1 1 49.9 10", 34},
      {"M10 50Q20 10 30 50T50 50T70 50T90 50", 66},
      {"M20 20C40 0 90 10 80 40S20 50 20 70S60 100 85 80", 30},
  };
  const cs_stroke_view view = whole_view(celspan_matrix_scaling(1024 / SIDE, 1024 / SIDE), 1024);
  for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
    celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
    desc.data = lines[i].data;
    desc.width = 2;
    counted c = make_stroke(context, &desc);
    CHECK(count_curves(&c, &view) <= lines[i].most);
    celspan_object_unref(c.object);
  }
}

/* ---------------------------------------------------------------- strokes of objects */

static void test_object_stroke(celspan_context *context) {
  const celspan_path_desc path = {.struct_size = sizeof path, .data = "M0 0H10V10H0Z"};
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  celspan_object *square = NULL, *large = NULL, *pale = NULL, *ring = NULL, *none = NULL;
  desc.width = 2;
  CHECK(celspan_object_create_path(context, &path, &square) == CELSPAN_OK);
  const celspan_matrix matrix =
      celspan_matrix_then(celspan_matrix_scaling(3, 3), celspan_matrix_translation(100, 0));
  CHECK(celspan_object_transform(context, square, &matrix, &large) == CELSPAN_OK);
  CHECK(celspan_object_fade(context, large, 0.25, &pale) == CELSPAN_OK);
  CHECK(celspan_object_stroke(context, pale, &desc, &ring) == CELSPAN_OK);
  /* It lies where the object does, its width is scaled with it, its corner has a miter. */
  CHECK(celspan_object_contains(ring, (celspan_point){97.1, -2.9}));
  CHECK(!celspan_object_contains(ring, (celspan_point){96.9, 15}));
  CHECK(celspan_object_contains(ring, (celspan_point){102.9, 15}));
  CHECK(!celspan_object_contains(ring, (celspan_point){103.1, 15}));
  CHECK(ring->fade == pale->fade);
  desc.data = path.data;
  CHECK(celspan_object_stroke(context, pale, &desc, &none) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "do not go with it"));
  desc.data = NULL;
  desc.width = -1;
  CHECK(celspan_object_stroke(context, pale, &desc, &none) == CELSPAN_BAD_ARGUMENT);
  desc.width = 1;
  CHECK(celspan_object_stroke(context, NULL, &desc, &none) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_stroke(context, pale, NULL, &none) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_stroke(context, ring, &desc, &none) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "a stroke has none"));
  const celspan_point points[2] = {{0, 0}, {1, 1}};
  desc.points = points;
  CHECK(celspan_object_stroke(context, pale, &desc, &none) == CELSPAN_BAD_ARGUMENT);
  desc.data = path.data;
  CHECK(celspan_object_create_stroke(context, &desc, &none) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "only one of points, d, outline and contours"));
  desc.data = NULL;
  desc.points = NULL;
  CHECK(celspan_object_create_stroke(context, &desc, &none) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "one of points, d, outline and contours"));
  celspan_object *both[2] = {square, large}, *joined = NULL;
  CHECK(celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, both, 2, &joined) ==
        CELSPAN_OK);
  CHECK(celspan_object_stroke(context, joined, &desc, &none) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "a boolean object has none"));
  celspan_object_unref(joined);
  CHECK(none == NULL);
  celspan_object_unref(ring);
  celspan_object_unref(pale);
  celspan_object_unref(large);
  celspan_object_unref(square);
}

int main(void) {
  celspan_context *context = NULL;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  test_outlines(context);
  if (!getenv("CASE")) {
    test_rows(context);
    test_strip(context);
    test_dashes(context);
    test_many_dashes(context);
    test_far(context);
    test_folds(context);
    test_cusps(context);
    test_swallowed(context);
    test_short_corners(context);
    test_windows(context);
    test_rest();
    test_motion();
    test_allowance();
    test_cost(context);
    test_object_stroke(context);
  }
  celspan_context_destroy(context);
  return check_done();
}
