#include "model/stroke/curve.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define POINT 1e-13 /* share of the coordinates: a line of at most this length is a point */

/* ---------------------------------------------------------------- parts */

void cs_curve_load_line(const cs_outline *line, size_t piece, double begin, double end,
                        cs_bezier *out) {
  const celspan_matrix identity = celspan_matrix_identity();
  cs_bezier rest;
  cs_bezier_load(line, piece, &identity, out);
  if (end < 1)
    cs_bezier_split(out, end, out, &rest);
  if (begin > 0)
    cs_bezier_split(out, end > 0 ? begin / end : 0, &rest, out);
}

void cs_curve_cut_polynomial(double *c, int degree, double begin, double end) {
  if (end < 1)
    for (int level = 1; level <= degree; level++)
      for (int i = degree; i >= level; i--)
        c[i] = c[i - 1] + end * (c[i] - c[i - 1]);
  double share = end > 0 ? begin / end : 0;
  if (begin > 0)
    for (int level = 1; level <= degree; level++)
      for (int i = 0; i <= degree - level; i++)
        c[i] += share * (c[i + 1] - c[i]);
}

void cs_curve_multiply(const double *a, int a_degree, const double *b, int b_degree, double *out) {
  int degree = a_degree + b_degree;
  double whole = 1, first = 1;
  for (int k = 0; k <= degree; k++)
    out[k] = 0;
  for (int i = 0; i <= a_degree; i++) {
    double second = 1;
    for (int j = 0; j <= b_degree; j++) {
      out[i + j] += first * second * a[i] * b[j];
      second = second * (b_degree - j) / (j + 1);
    }
    first = first * (a_degree - i) / (i + 1);
  }
  for (int k = 0; k <= degree; k++) {
    out[k] /= whole;
    whole = whole * (degree - k) / (k + 1);
  }
}

void cs_curve_load(const cs_stroke *stroke, size_t piece, double begin, double end, cs_curve *out) {
  cs_curve_load_line(&stroke->line, piece, begin, end, &out->line);
  out->radius_degree = stroke->radius_degrees[piece];
  memcpy(out->radius, stroke->radii + stroke->radius_starts[piece],
         ((size_t)out->radius_degree + 1) * sizeof *out->radius);
  cs_curve_cut_polynomial(out->radius, out->radius_degree, begin, end);
}

void cs_curve_reverse(cs_curve *curve) {
  cs_bezier_reverse(&curve->line);
  for (int i = 0, j = curve->radius_degree; i < j; i++, j--) {
    double swapped = curve->radius[i];
    curve->radius[i] = curve->radius[j];
    curve->radius[j] = swapped;
  }
}

/* Not a + t (b - a): a sum of two products is the same in either order, so this is symmetric at
 * 1/2, in contrast to cs_bezier_split. */
static cs_hpoint mix(cs_hpoint a, cs_hpoint b, double t) {
  double s = 1 - t;
  return (cs_hpoint){s * a.x + t * b.x, s * a.y + t * b.y, s * a.w + t * b.w};
}

static void split_line(const cs_bezier *line, double t, cs_bezier *low, cs_bezier *high) {
  int degree = line->degree;
  cs_bezier_copy(line, high);
  low->degree = degree;
  low->points[0] = high->points[0];
  for (int level = 1; level <= degree; level++) {
    for (int i = 0; i <= degree - level; i++)
      high->points[i] = mix(high->points[i], high->points[i + 1], t);
    low->points[level] = high->points[0];
  }
}

void cs_curve_split(const cs_curve *curve, double t, cs_curve *low, cs_curve *high) {
  int degree = curve->radius_degree;
  split_line(&curve->line, t, &low->line, &high->line);
  low->radius_degree = high->radius_degree = degree;
  memcpy(high->radius, curve->radius, ((size_t)degree + 1) * sizeof *high->radius);
  low->radius[0] = high->radius[0];
  for (int level = 1; level <= degree; level++) {
    for (int i = 0; i <= degree - level; i++)
      high->radius[i] = (1 - t) * high->radius[i] + t * high->radius[i + 1];
    low->radius[level] = high->radius[0];
  }
}

/* ---------------------------------------------------------------- places */

static cs_hpoint between(cs_hpoint a, cs_hpoint b, double t) {
  return (cs_hpoint){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.w + t * (b.w - a.w)};
}

/* By de Casteljau's scheme, whose last three rows give the derivatives. */
static void line_at(const cs_bezier *line, double t, celspan_point *point, celspan_point *velocity,
                    celspan_point *acceleration) {
  cs_hpoint work[CS_BEZIER_DEGREE + 1] = {line->points[0], line->points[1]};
  int degree = line->degree;
  for (int i = 2; i <= degree; i++)
    work[i] = line->points[i];
  for (int level = degree; level > 2; level--)
    for (int i = 0; i < level; i++)
      work[i] = between(work[i], work[i + 1], t);
  cs_hpoint a = work[0], b = work[1], bend = {0, 0, 0};
  if (degree > 1) {
    double scale = degree * (degree - 1);
    bend = (cs_hpoint){scale * ((work[2].x - b.x) - (b.x - a.x)),
                       scale * ((work[2].y - b.y) - (b.y - a.y)),
                       scale * ((work[2].w - b.w) - (b.w - a.w))};
    a = between(a, b, t);
    b = between(b, work[2], t);
  }
  cs_hpoint at = between(a, b, t);
  double rise = degree * (b.w - a.w);
  if (at.w == 1 && rise == 0 && bend.w == 0) { /* the same as below, without six divisions by 1 */
    *point = (celspan_point){at.x, at.y};
    *velocity = (celspan_point){degree * (b.x - a.x), degree * (b.y - a.y)};
    *acceleration = (celspan_point){bend.x, bend.y};
    return;
  }
  point->x = at.x / at.w;
  point->y = at.y / at.w;
  velocity->x = degree * ((b.x - a.x) - point->x * (b.w - a.w)) / at.w;
  velocity->y = degree * ((b.y - a.y) - point->y * (b.w - a.w)) / at.w;
  acceleration->x = (bend.x - 2 * rise * velocity->x - bend.w * point->x) / at.w;
  acceleration->y = (bend.y - 2 * rise * velocity->y - bend.w * point->y) / at.w;
}

void cs_curve_line_at(const cs_bezier *line, double t, celspan_point *point,
                      celspan_point *velocity) {
  celspan_point acceleration;
  line_at(line, t, point, velocity, &acceleration);
}

cs_curve_place cs_curve_at(const cs_curve *curve, double t) {
  cs_curve_place place;
  double work[CS_STROKE_RADIUS_DEGREE + 1];
  int degree = curve->radius_degree;
  line_at(&curve->line, t, &place.point, &place.velocity, &place.acceleration);
  place.radius = curve->radius[0];
  place.growth = place.growth_change = 0;
  if (degree < 1)
    return place;
  for (int i = 0; i <= degree; i++)
    work[i] = curve->radius[i];
  for (int level = degree; level > 1; level--) {
    if (level == 2)
      place.growth_change = degree * (degree - 1) * ((work[2] - work[1]) - (work[1] - work[0]));
    for (int i = 0; i < level; i++)
      work[i] += t * (work[i + 1] - work[i]);
  }
  place.growth = degree * (work[1] - work[0]);
  place.radius = fmax(0, work[0] + t * (work[1] - work[0]));
  return place;
}

double cs_curve_extent(const cs_bezier *line) {
  celspan_point first = cs_hpoint_place(line->points[0]);
  double extent = 0;
  for (int i = 1; i <= line->degree; i++) {
    celspan_point p = cs_hpoint_place(line->points[i]);
    extent = fmax(extent, fmax(fabs(p.x - first.x), fabs(p.y - first.y)));
  }
  return extent;
}

bool cs_curve_is_point(const cs_bezier *line) {
  celspan_point first = cs_hpoint_place(line->points[0]);
  return !(cs_curve_extent(line) > POINT * (fabs(first.x) + fabs(first.y)));
}

celspan_point cs_curve_departure(const cs_bezier *line) {
  double extent = cs_curve_extent(line);
  celspan_point first = cs_hpoint_place(line->points[0]);
  for (int k = 1; k <= line->degree; k++) {
    celspan_point p = cs_hpoint_place(line->points[k]);
    double x = p.x - first.x, y = p.y - first.y, length = sqrt(x * x + y * y);
    if (length > 1e-9 * extent)
      return (celspan_point){x / length, y / length};
  }
  return (celspan_point){1, 0};
}

celspan_box cs_curve_box(const cs_curve *curve, double extent) {
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL, radius = 0;
  for (int i = 0; i <= curve->line.degree; i++) {
    cs_hpoint p = curve->line.points[i];
    left = fmin(left, p.x / p.w);
    right = fmax(right, p.x / p.w);
    top = fmin(top, p.y / p.w);
    bottom = fmax(bottom, p.y / p.w);
  }
  for (int i = 0; i <= curve->radius_degree; i++)
    radius = fmax(radius, curve->radius[i]);
  radius *= extent;
  return (celspan_box){left - radius, top - radius, right - left + 2 * radius,
                       bottom - top + 2 * radius};
}

bool cs_curve_is_straight(const cs_bezier *line) {
  return line->degree == 1 && line->points[0].w == line->points[1].w;
}

/* ---------------------------------------------------------------- lengths */

#define LENGTH_DEPTH 30
/* The allowed error, as a share of the polygon's length; the same for every halving, and not below
 * the rounding of coordinates. */
#define LENGTH_ERROR 1e-11

/* The speed of a line at many places: a polynomial of the second degree, unless the line has
 * weights or a higher degree than the third. */
typedef struct ruler {
  const cs_bezier *line;
  bool is_plain;
  celspan_point powers[3]; /* coefficients of the velocity, if it is a plain polynomial */
} ruler;

static ruler ruler_of(const cs_bezier *line) {
  int degree = line->degree;
  ruler out = {.line = line, .is_plain = degree <= 3};
  celspan_point d[3] = {{0, 0}};
  for (int i = 0; out.is_plain && i < degree; i++) {
    const cs_hpoint *p = &line->points[i];
    out.is_plain = p[0].w == 1 && p[1].w == 1;
    d[i] = (celspan_point){degree * (p[1].x - p[0].x), degree * (p[1].y - p[0].y)};
  }
  out.powers[0] = d[0];
  if (degree > 1)
    out.powers[1] =
        (celspan_point){(degree - 1) * (d[1].x - d[0].x), (degree - 1) * (d[1].y - d[0].y)};
  if (degree > 2)
    out.powers[2] = (celspan_point){(d[2].x - d[1].x) - (d[1].x - d[0].x),
                                    (d[2].y - d[1].y) - (d[1].y - d[0].y)};
  return out;
}

static double speed(const ruler *r, double t) {
  const celspan_point *p = r->powers;
  celspan_point point,
      velocity = {p[0].x + t * (p[1].x + t * p[2].x), p[0].y + t * (p[1].y + t * p[2].y)};
  if (!r->is_plain)
    cs_curve_line_at(r->line, t, &point, &velocity);
  return sqrt(velocity.x * velocity.x + velocity.y * velocity.y);
}

/* Gauss and Legendre's rule with five places. */
static double gauss(const ruler *r, double begin, double end) {
  static const double places[] = {0.53846931010568309, 0.90617984593866399};
  static const double weights[] = {0.47862867049936647, 0.23692688505618909};
  double centre = 0.5 * (begin + end), half = 0.5 * (end - begin);
  double sum = 0.56888888888888889 * speed(r, centre);
  for (int i = 0; i < 2; i++)
    sum += weights[i] * (speed(r, centre - half * places[i]) + speed(r, centre + half * places[i]));
  return half * sum;
}

static double measure(const ruler *r, double begin, double end, double whole, double error,
                      int depth) {
  double centre = 0.5 * (begin + end);
  double low = gauss(r, begin, centre), high = gauss(r, centre, end);
  if (depth == LENGTH_DEPTH || fabs(low + high - whole) <= error)
    return low + high;
  return measure(r, begin, centre, low, error, depth + 1) +
         measure(r, centre, end, high, error, depth + 1);
}

double cs_curve_length(const cs_bezier *line, double begin, double end) {
  if (!(end > begin))
    return 0;
  double polygon = 0, farthest = 0; /* farthest: the greatest distance from an axis */
  for (int i = 0; i < line->degree; i++) {
    celspan_point a = cs_hpoint_place(line->points[i]), b = cs_hpoint_place(line->points[i + 1]);
    polygon += sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
    farthest = fmax(farthest, fmax(fabs(a.x), fabs(a.y)));
  }
  if (cs_curve_is_straight(line))
    return (end - begin) * polygon;
  double rounding = line->degree * DBL_EPSILON * farthest;
  const ruler r = ruler_of(line);
  return measure(&r, begin, end, gauss(&r, begin, end), fmax(LENGTH_ERROR * polygon, rounding), 0);
}

/* Newton's steps inside a bracket, which they make smaller; a halving where a step would leave the
 * bracket. */
static double find_parameter(const cs_bezier *line, double whole, double length, double low,
                             double high, const double at_ends[2]) {
  double t = low + (length - at_ends[0]) / (at_ends[1] - at_ends[0]) * (high - low);
  double at = at_ends[0] + cs_curve_length(line, low, t);
  const ruler r = ruler_of(line);
  for (int i = 0; i < 60 && fabs(at - length) > LENGTH_ERROR * whole; i++) {
    if (at < length)
      low = t;
    else
      high = t;
    double pace = speed(&r, t), next = pace > 0 ? t + (length - at) / pace : low;
    next = next > low && next < high ? next : 0.5 * (low + high);
    at += next > t ? cs_curve_length(line, t, next) : -cs_curve_length(line, next, t);
    t = next;
  }
  return t;
}

double cs_curve_parameter(const cs_bezier *line, double whole, double length) {
  const double at_ends[2] = {0, whole};
  if (!(length > 0) || !(length < whole))
    return length > 0 ? 1 : 0;
  return cs_curve_is_straight(line) ? length / whole
                                    : find_parameter(line, whole, length, 0, 1, at_ends);
}

void cs_curve_mark(const cs_bezier *line, double marks[CS_CURVE_MARKS + 1]) {
  marks[0] = 0;
  for (int i = 0; i < CS_CURVE_MARKS; i++)
    marks[i + 1] = marks[i] + cs_curve_length(line, (double)i / CS_CURVE_MARKS,
                                              (double)(i + 1) / CS_CURVE_MARKS);
}

double cs_curve_marked_parameter(const cs_bezier *line, const double marks[CS_CURVE_MARKS + 1],
                                 double length) {
  int low = 0, high = CS_CURVE_MARKS;
  if (!(length > 0) || !(length < marks[CS_CURVE_MARKS]))
    return length > 0 ? 1 : 0;
  while (low + 1 < high) {
    int middle = (low + high) / 2;
    if (marks[middle] <= length)
      low = middle;
    else
      high = middle;
  }
  return find_parameter(line, marks[CS_CURVE_MARKS], length, (double)low / CS_CURVE_MARKS,
                        (double)high / CS_CURVE_MARKS, &marks[low]);
}

/* ---------------------------------------------------------------- swallow */

/* A Bernstein polynomial. */
typedef struct polynomial {
  int degree;
  double c[CS_CURVE_SWALLOW_CHANGES + 1];
} polynomial;

static void multiply(const polynomial *a, const polynomial *b, polynomial *out) {
  out->degree = a->degree + b->degree;
  cs_curve_multiply(a->c, a->degree, b->c, b->degree, out->c);
}

static void differentiate(const polynomial *p, polynomial *out) {
  out->degree = p->degree > 0 ? p->degree - 1 : 0;
  out->c[0] = 0;
  for (int i = 0; i < p->degree; i++)
    out->c[i] = p->degree * (p->c[i + 1] - p->c[i]);
}

/* The same polynomial, written with a higher degree. */
static void elevate(polynomial *p, int degree) {
  polynomial one = {.degree = degree - p->degree}, low = *p;
  for (int i = 0; i <= one.degree; i++)
    one.c[i] = 1;
  multiply(&low, &one, p);
}

/* (p' w - p w')^2 */
static void square_of_way(const polynomial *p, const polynomial *w, polynomial *out) {
  polynomial dp, dw, a, b;
  differentiate(p, &dp);
  differentiate(w, &dw);
  multiply(&dp, w, &a);
  multiply(p, &dw, &b);
  for (int i = 0; i <= a.degree; i++)
    a.c[i] -= b.c[i];
  multiply(&a, &a, out);
}

/* (r' w^2)^2 */
static void square_of_growth(const polynomial *r, const polynomial *w, polynomial *out) {
  polynomial dr, ww, a;
  differentiate(r, &dr);
  multiply(w, w, &ww);
  multiply(&dr, &ww, &a);
  multiply(&a, &a, out);
}

/* Points are taken relative to the first one, so that they are rounded less. */
static void load(const cs_curve *curve, polynomial *x, polynomial *y, polynomial *w,
                 polynomial *r) {
  const cs_hpoint *p = curve->line.points;
  bool is_plain = cs_bezier_is_polynomial(&curve->line);
  x->degree = y->degree = curve->line.degree;
  w->degree = is_plain ? 0 : curve->line.degree;
  r->degree = curve->radius_degree;
  for (int i = 0; i <= curve->line.degree; i++) {
    x->c[i] = p[i].x / p[0].w - p[0].x / p[0].w * (p[i].w / p[0].w);
    y->c[i] = p[i].y / p[0].w - p[0].y / p[0].w * (p[i].w / p[0].w);
    w->c[i] = p[i].w / p[0].w;
  }
  for (int i = 0; i <= r->degree; i++)
    r->c[i] = curve->radius[i];
}

int cs_curve_swallow_changes(const cs_curve *curve, double changes[CS_CURVE_SWALLOW_CHANGES]) {
  polynomial x, y, w, r, growth, along, across;
  if (curve->radius_degree == 0)
    return 0;
  load(curve, &x, &y, &w, &r);
  square_of_growth(&r, &w, &growth);
  square_of_way(&x, &w, &along);
  square_of_way(&y, &w, &across);
  int degree = growth.degree > along.degree ? growth.degree : along.degree;
  elevate(&growth, degree);
  elevate(&along, degree);
  elevate(&across, degree);
  double size = 0;
  for (int i = 0; i <= degree; i++) {
    size = fmax(size, fmax(fabs(growth.c[i]), fmax(fabs(along.c[i]), fabs(across.c[i]))));
    growth.c[i] -= along.c[i] + across.c[i];
  }
  return cs_bezier_roots(growth.c, degree, size, changes);
}

bool cs_curve_is_swallowed(const cs_curve *curve, double t) {
  cs_curve_place place = cs_curve_at(curve, t);
  double x = place.velocity.x, y = place.velocity.y;
  return fabs(place.growth) > 0 && place.growth * place.growth >= x * x + y * y;
}
