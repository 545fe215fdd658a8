/* Whether a stroke covers a point, by its own arithmetic: nothing here is shared with the outliner.
 *
 *      p                     f(t) = |p - c(t)| - r(t) is below 0 where the disc of a place covers
 *      :  .                  the point. A spoke ends in the point's direction where f is at rest:
 *      :    .                so a spoke reaches over the point iff f' = 0 and f <= 0 at some t of
 * -----+------+---->         a drawn part. Where a part has no rest and f grows from its beginning,
 *     c(t)                   the point is beyond its end: it is then up to the cap.
 *
 * A piece is halved until it is certain. c - p and w are kept as Bernstein coefficients, in which
 * their products, and so the numerator of f', are bounded by their least and largest coefficient.
 */
#include <math.h>

#include "base/elementary.h"
#include "model/scene/inside.h"
#include "model/stroke/dashes.h"

#define PI 3.14159265358979323846
#define MOST_DEGREE 15
#define MOST_PRODUCT (3 * MOST_DEGREE)
#define HALVINGS 52
#define SAME 1e-12     /* distances that differ by less are the same */
#define ROUNDING 1e-12 /* a share of a radius, in its derivative */
/* sine: a spoke at the end of a piece belongs to the piece, and to its neighbour, too */
#define AT_REST 1e-9

/* A piece relative to the point: (u, v) / w is the vector from the point to the line. */
typedef struct around {
  int degree, radius_degree;
  double u[MOST_DEGREE + 1], v[MOST_DEGREE + 1], w[MOST_DEGREE + 1];
  double r[CS_STROKE_RADIUS_DEGREE + 1];
  /* Derivatives by the parameter of the whole piece. They are cut and halved by themselves, so that
   * they are right where they are small. */
  double du[MOST_DEGREE], dv[MOST_DEGREE], dw[MOST_DEGREE], dr[CS_STROKE_RADIUS_DEGREE];
} around;

/* An end of a piece, seen from the piece. away: the direction that leads out of the piece; slope:
 * how fast the radius grows in this direction, -1 .. 1; x, y: the vector from the centre of the end
 * to the point. */
typedef struct piece_end {
  double x, y, radius;
  double away_x, away_y, slope;
} piece_end;

/* ---------------------------------------------------------------- polynomials */

void cs_inside_halve(const double *whole, int degree, double *low, double *high) {
  double work[CS_STROKE_RADIUS_DEGREE + 1];
  for (int i = 0; i <= degree; i++)
    work[i] = whole[i];
  for (int level = 0; level <= degree; level++) {
    low[level] = work[0];
    high[degree - level] = work[degree - level];
    for (int i = 0; i < degree - level; i++)
      work[i] = 0.5 * (work[i] + work[i + 1]);
  }
}

static void halve_around(const around *whole, around *low, around *high) {
  low->degree = high->degree = whole->degree;
  low->radius_degree = high->radius_degree = whole->radius_degree;
  cs_inside_halve(whole->u, whole->degree, low->u, high->u);
  cs_inside_halve(whole->v, whole->degree, low->v, high->v);
  cs_inside_halve(whole->w, whole->degree, low->w, high->w);
  cs_inside_halve(whole->r, whole->radius_degree, low->r, high->r);
  cs_inside_halve(whole->du, whole->degree - 1, low->du, high->du);
  cs_inside_halve(whole->dv, whole->degree - 1, low->dv, high->dv);
  cs_inside_halve(whole->dw, whole->degree - 1, low->dw, high->dw);
  if (whole->radius_degree > 0)
    cs_inside_halve(whole->dr, whole->radius_degree - 1, low->dr, high->dr);
}

/* The part of a polynomial between two parameters, cut at both ends by de Casteljau's scheme. */
static void cut(double *c, int degree, double begin, double end) {
  for (int level = 1; level <= degree && end < 1; level++)
    for (int i = degree; i >= level; i--)
      c[i] = (1 - end) * c[i - 1] + end * c[i];
  double share = end > 0 ? begin / end : 0;
  for (int level = 1; level <= degree && share > 0; level++)
    for (int i = 0; i <= degree - level; i++)
      c[i] = (1 - share) * c[i] + share * c[i + 1];
}

/* Adds factor * a * b to a sum of degree a_degree + b_degree. */
static void add_product(double *sum, double factor, const double *a, int a_degree, const double *b,
                        int b_degree) {
  double row = 1; /* binomial coefficients: of a, of b, and of the product */
  for (int i = 0; i <= a_degree; i++) {
    double column = 1, whole = 1;
    for (int k = 0; k < i; k++)
      whole = whole * (a_degree + b_degree - k) / (k + 1);
    for (int j = 0; j <= b_degree; j++) {
      sum[i + j] += factor * a[i] * b[j] * row * column / whole;
      column = column * (b_degree - j) / (j + 1);
      whole = whole * (a_degree + b_degree - i - j) / (i + j + 1);
    }
    row = row * (a_degree - i) / (i + 1);
  }
}

typedef struct range {
  double least, most;
} range;

static range range_of(const double *c, int degree) {
  range found = {c[0], c[0]};
  for (int i = 1; i <= degree; i++) {
    found.least = fmin(found.least, c[i]);
    found.most = fmax(found.most, c[i]);
  }
  return found;
}

/* ---------------------------------------------------------------- ends */

/* The first derivative at an end that is not 0, in the direction of the piece. Of its coefficients,
 * the first one that is larger than rounding (`least`) counts, multiplied by the binomial
 * coefficient of its place; it must come before the places that follow. */
typedef struct start {
  double x, y;
  int place;
} start;

static start start_of(const double *x, const double *y, int degree, int end, double least) {
  double binomial = 1;
  for (int k = 0; k <= degree; k++) {
    int i = end ? degree - k : k;
    if (fabs(x[i]) > least || fabs(y[i]) > least)
      return (start){binomial * x[i], binomial * y[i], k};
    binomial = binomial * (degree - k) / (k + 1);
  }
  return (start){0, 0, CS_STROKE_RADIUS_DEGREE};
}

/* The end of a piece: 0 its beginning, 1 its end. */
static piece_end end_of(const around *a, int end) {
  static const double none[CS_STROKE_RADIUS_DEGREE] = {0};
  int n = a->degree, m = a->radius_degree, i = end ? n : 0;
  double x = a->u[i] / a->w[i], y = a->v[i] / a->w[i], sign = end ? 1 : -1;
  double du[MOST_DEGREE], dv[MOST_DEGREE];
  piece_end e = {.x = -x, .y = -y, .radius = a->r[end ? m : 0], .away_x = sign};
  for (int k = 0; k < n; k++) {
    du[k] = (a->du[k] - x * a->dw[k]) / a->w[i];
    dv[k] = (a->dv[k] - y * a->dw[k]) / a->w[i];
  }
  double rounding = ROUNDING * range_of(a->r, m).most;
  start way = start_of(du, dv, n - 1, end, 0);
  start growth = start_of(a->dr, none, m - 1, end, rounding);
  double speed = sqrt(way.x * way.x + way.y * way.y);
  if (!(speed > 0))
    return e;
  e.away_x = sign * way.x / speed;
  e.away_y = sign * way.y / speed;
  double slope = growth.place < way.place   ? (growth.x > 0 ? 1 : -1)
                 : growth.place > way.place ? 0
                                            : growth.x / speed;
  e.slope = sign * fmax(-1, fmin(1, slope));
  return e;
}

static double along(const piece_end *e) { return e->x * e->away_x + e->y * e->away_y; }
static double across(const piece_end *e) { return e->away_x * e->y - e->away_y * e->x; }
static double distance_to(const piece_end *e) { return sqrt(e->x * e->x + e->y * e->y); }

/* ---------------------------------------------------------------- spokes */

/* Adds the coefficients of d' d w^3, where d is the distance, to `out`. Returns their degree. */
static int approach_of(const around *a, double out[MOST_PRODUCT]) {
  int n = a->degree;
  double product[2 * MOST_DEGREE] = {0}, square[2 * MOST_DEGREE + 1] = {0};
  range weights = range_of(a->w, n);
  add_product(product, 1, a->u, n, a->du, n - 1);
  add_product(product, 1, a->v, n, a->dv, n - 1);
  if (weights.least == weights.most) {
    for (int i = 0; i < 2 * n; i++)
      out[i] = product[i] * weights.least;
    return 2 * n - 1;
  }
  add_product(square, 1, a->u, n, a->u, n);
  add_product(square, 1, a->v, n, a->v, n);
  add_product(out, 1, product, 2 * n - 1, a->w, n);
  add_product(out, -1, square, 2 * n, a->dw, n - 1);
  return 3 * n - 1;
}

/* The least distance is the distance to the box of the control points. */
static range distances(const around *a) {
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL, most = 0;
  for (int i = 0; i <= a->degree; i++) {
    double x = a->u[i] / a->w[i], y = a->v[i] / a->w[i];
    left = fmin(left, x);
    right = fmax(right, x);
    top = fmin(top, y);
    bottom = fmax(bottom, y);
    most = fmax(most, x * x + y * y);
  }
  double x = fmax(0, fmax(left, -right)), y = fmax(0, fmax(top, -bottom));
  return (range){sqrt(x * x + y * y), sqrt(most)};
}

/* Bounds of f' from the bounds of its terms. */
static range slopes(const around *a, range approach, range distance) {
  range weight = range_of(a->w, a->degree), growth = {0, 0};
  if (a->radius_degree > 0)
    growth = range_of(a->dr, a->radius_degree - 1);
  double least = distance.least * weight.least * weight.least * weight.least;
  double most = distance.most * weight.most * weight.most * weight.most;
  return (range){approach.least / (approach.least > 0 ? most : least) - growth.most,
                 approach.most / (approach.most > 0 ? least : most) - growth.least};
}

/* f at one end of a piece, and the sign of f' inside it next to that end. */
typedef struct place {
  double f, slope;
} place;

/* Where the line does not move, f' is 0 for every point. There the derivative by the distance along
 * the line is used instead. */
static double slope_by_way(const around *a, int end) {
  piece_end e = end_of(a, end);
  double distance = distance_to(&e), nearing = distance > 0 ? -along(&e) / distance : 1;
  return end ? nearing - e.slope : -nearing + e.slope;
}

static place place_at(const around *a, int end) {
  int n = a->degree, m = a->radius_degree, i = end ? n : 0, k = end ? n - 1 : 0;
  double w = a->w[i], x = a->u[i] / w, y = a->v[i] / w, distance = sqrt(x * x + y * y);
  double dx = (a->du[k] - x * a->dw[k]) / w, dy = (a->dv[k] - y * a->dw[k]) / w;
  double growth = m == 0 ? 0 : a->dr[end ? m - 1 : 0];
  double nearing = distance > 0 ? (x * dx + y * dy) / distance : end ? 1 : -1;
  bool stands = dx == 0 && dy == 0;
  return (place){distance - a->r[end ? m : 0], stands ? slope_by_way(a, end) : nearing - growth};
}

/* Whether a spoke of the piece extends over the point. */
static bool is_reached(const around *a, int halvings) {
  double coefficients[MOST_PRODUCT] = {0};
  range distance = distances(a), radius = range_of(a->r, a->radius_degree);
  if (distance.least > radius.most)
    return false;
  range approach = range_of(coefficients, approach_of(a, coefficients));
  range slope = slopes(a, approach, distance);
  if (slope.least > 0 || slope.most < 0)
    return false;
  place begin = place_at(a, 0), end = place_at(a, 1);
  if (begin.slope <= 0 && end.slope >= 0 && (begin.f <= 0 || end.f <= 0))
    return true;
  if (begin.slope >= 0 && end.slope <= 0 && distance.most <= radius.least)
    return true;
  if (halvings == HALVINGS || distance.most - distance.least <= SAME * distance.most)
    /* the piece is as short as a point; only the slopes at its ends could have decided, and did
     * not */
    return false;
  around low, high;
  halve_around(a, &low, &high);
  place before = place_at(&low, 1), after = place_at(&high, 0);
  bool is_rest = before.slope * after.slope <= 0 && before.f <= 0;
  return is_rest || is_reached(&low, halvings + 1) || is_reached(&high, halvings + 1);
}

/* ---------------------------------------------------------------- caps */

/* Whether the spoke at the end extends over the point. */
static bool is_on_spoke(const piece_end *e) {
  double distance = distance_to(e);
  return distance <= e->radius && fabs(along(e) + e->slope * distance) <= AT_REST * distance &&
         fabs(e->slope) < 1;
}

/* Up to the normal if the width decreases from the end on, up to the chord of the tips if it
 * grows. */
static bool is_in_butt(const piece_end *e) {
  double distance = distance_to(e), ahead = along(e), k = e->slope;
  if (k >= 0)
    return distance <= e->radius && ahead <= 0 && ahead >= -k * distance && k > 0;
  return ahead >= 0 && ahead <= -k * e->radius && fabs(across(e)) * -k <= ahead * sqrt(1 - k * k);
}

static bool is_in_square(const piece_end *e) {
  double ahead = along(e);
  return ahead >= 0 && ahead <= e->radius && fabs(across(e)) <= e->radius;
}

static bool is_in_cap(const cs_stroke *stroke, const piece_end *e) {
  double distance = distance_to(e);
  if (stroke->cap == CELSPAN_STROKE_CAP_ROUND)
    return distance <= e->radius && along(e) >= -e->slope * distance;
  return is_in_butt(e) || (stroke->cap == CELSPAN_STROKE_CAP_SQUARE && is_in_square(e));
}

/* ---------------------------------------------------------------- corners */

static double angle_between(double ax, double ay, double bx, double by) {
  return cs_elementary_atan2(ax * by - ay * bx, ax * bx + ay * by);
}

/* The angle between a spoke and the direction away from the piece: 0 .. pi. */
static double lean(const piece_end *e) {
  return cs_elementary_atan2(sqrt(fmax(0, 1 - e->slope * e->slope)), -e->slope);
}

static bool is_between(double angle, double from, double length) {
  double turn = angle - from;
  turn -= 2 * PI * floor(turn / (2 * PI));
  return length > 0 && turn <= length;
}

/* Whether the disc at the joint lies outside of both pieces here. turn: the angle from one to the
 * other. */
static bool is_in_round(const piece_end *in, const piece_end *out, double turn) {
  if (!(distance_to(in) <= in->radius))
    return false;
  double first = lean(in), second = PI - lean(out);
  double angle = angle_between(in->away_x, in->away_y, in->x, in->y);
  return is_between(angle, -first, turn + first - second) ||
         is_between(angle, turn + second, first - turn - second);
}

/* Two radii at one place: the larger disc, except where its own piece covers it. */
static bool is_in_jump(const piece_end *in, const piece_end *out) {
  const piece_end *larger = in->radius > out->radius ? in : out;
  double distance = distance_to(larger);
  return distance <= larger->radius && along(larger) >= -larger->slope * distance;
}

/* The kite or triangle on the outside of a join, in coordinates along both normals. turn: its sine
 * and cosine. */
static bool is_in_wedge(const cs_stroke *stroke, const piece_end *in, const piece_end *out,
                        double turn) {
  double side = turn > 0 ? 1 : -1;
  double ax = side * in->away_y, ay = -side * in->away_x;   /* normal of the piece before */
  double bx = -side * out->away_y, by = side * out->away_x; /* the normal of the piece after it */
  double cosine = ax * bx + ay * by, sine = ax * by - ay * bx;
  if (sine == 0)
    return false;
  double first = (in->x * by - in->y * bx) / sine; /* the point is first * a + second * b */
  double second = (ax * in->y - ay * in->x) / sine;
  if (first < 0 || second < 0)
    return false;
  bool is_miter = stroke->join == CELSPAN_STROKE_JOIN_MITER &&
                  2 <= stroke->miter * stroke->miter * (1 + cosine);
  return is_miter ? first + second * cosine <= in->radius && second + first * cosine <= in->radius
                  : first + second <= in->radius;
}

static bool is_in_corner(const cs_stroke *stroke, const piece_end *in, const piece_end *out) {
  double turn = angle_between(in->away_x, in->away_y, -out->away_x, -out->away_y);
  if (fabs(in->radius - out->radius) > 1e-12 * (in->radius + out->radius))
    return is_in_jump(in, out);
  if (fabs(turn) <= AT_REST || stroke->join == CELSPAN_STROKE_JOIN_ROUND)
    return is_in_round(in, out, fabs(turn) > PI - AT_REST ? fabs(turn) : turn);
  return is_in_butt(in) || is_in_butt(out) || is_in_wedge(stroke, in, out, turn);
}

/* ---------------------------------------------------------------- strokes */

static around load(const cs_stroke *stroke, const cs_stroke_part *part, size_t i,
                   celspan_point point) {
  size_t piece = cs_stroke_piece(stroke, part, i);
  const cs_hpoint *points = stroke->line.points + stroke->line.starts[piece];
  const double *radii = stroke->radii + stroke->radius_starts[piece];
  double begin = i == 0 ? part->begin : 0, end = i + 1 == part->count ? part->end : 1;
  around a = {.degree = stroke->line.degrees[piece],
              .radius_degree = stroke->radius_degrees[piece]};
  for (int k = 0; k <= a.degree; k++) {
    a.u[k] = points[k].x - point.x * points[k].w;
    a.v[k] = points[k].y - point.y * points[k].w;
    a.w[k] = points[k].w;
  }
  for (int k = 0; k <= a.radius_degree; k++)
    a.r[k] = radii[k];
  for (int k = 0; k < a.degree; k++) {
    a.dw[k] = a.degree * (points[k + 1].w - points[k].w);
    a.du[k] = a.degree * (points[k + 1].x - points[k].x) - point.x * a.dw[k];
    a.dv[k] = a.degree * (points[k + 1].y - points[k].y) - point.y * a.dw[k];
  }
  for (int k = 0; k < a.radius_degree; k++)
    a.dr[k] = a.radius_degree * (radii[k + 1] - radii[k]);
  cut(a.du, a.degree - 1, begin, end);
  cut(a.dv, a.degree - 1, begin, end);
  cut(a.dw, a.degree - 1, begin, end);
  cut(a.dr, a.radius_degree - 1, begin, end);
  cut(a.u, a.degree, begin, end);
  cut(a.v, a.degree, begin, end);
  cut(a.w, a.degree, begin, end);
  cut(a.r, a.radius_degree, begin, end);
  return a;
}

static bool is_in_dot(const cs_stroke *stroke, const cs_stroke_part *part, celspan_point point) {
  cs_stroke_part rest = *part, whole = *part;
  bool is_end = part->begin == 1;
  whole.begin = 0;
  whole.end = 1;
  rest.end = 1;
  around a = load(stroke, is_end ? &whole : &rest, 0, point);
  piece_end e = end_of(&a, is_end);
  if (stroke->cap == CELSPAN_STROKE_CAP_ROUND)
    return distance_to(&e) <= e.radius;
  return stroke->cap == CELSPAN_STROKE_CAP_SQUARE && fabs(along(&e)) <= e.radius &&
         fabs(across(&e)) <= e.radius;
}

static bool is_in_part(const cs_stroke *stroke, const cs_stroke_part *part, celspan_point point) {
  piece_end first = {0}, before = {0};
  bool is_first = true;
  for (size_t i = 0; i < part->count; i++) {
    if ((i == 0 && part->begin == 1) || (i + 1 == part->count && part->end == 0))
      continue;
    around a = load(stroke, part, i, point);
    piece_end begin = end_of(&a, 0), end = end_of(&a, 1);
    if (is_reached(&a, 0) || is_on_spoke(&begin) || is_on_spoke(&end) ||
        (!is_first && is_in_corner(stroke, &before, &begin)))
      return true;
    first = is_first ? begin : first;
    before = end;
    is_first = false;
  }
  if (is_first)
    return false;
  return part->is_closed ? is_in_corner(stroke, &before, &first)
                         : is_in_cap(stroke, &first) || is_in_cap(stroke, &before);
}

bool cs_inside_stroke(const cs_stroke *stroke, celspan_point point) {
  const celspan_box *box = &stroke->around;
  if (point.x < box->x || point.x > box->x + box->width || point.y < box->y ||
      point.y > box->y + box->height)
    return false;
  cs_parts parts;
  cs_parts_init(&parts, stroke);
  for (size_t i = 0; i < stroke->part_count; i++) {
    const cs_stroke_part part = cs_parts_get(&parts, i);
    bool is_dot = part.count == 1 && part.begin == part.end;
    if (is_dot ? is_in_dot(stroke, &part, point) : is_in_part(stroke, &part, point))
      return true;
  }
  return false;
}
