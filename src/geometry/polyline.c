#include "geometry/polyline.h"

#include "geometry/polyline_vertex.h"
#include "geometry/polyline_wide.h"

#include <math.h>
#include <string.h>

/* A single chord must be nearer than the tolerance, because its vertices are the ends of the piece,
 * which cannot be displaced to keep the area. */
#define ONE_CHORD (CS_BOUNDARY_TOLERANCE / 8)
/* 4 times the distance that an arc may have from its chord within a row: pixels. */
#define ARC_CURVE 0.02
/* Groups of fewer chords are not cut: two chords alone would need a vertex far from the curve. */
#define HALVES_LEAST 6
/* Of chords of mean length: those that end at moved vertices are up to 1.5 times as long. */
#define CHORD_SAG (0.8 * CS_BOUNDARY_TOLERANCE)
#define CHORD_LIMIT 1e9
#define LEAP_MOST 8 /* groups */
/* How much larger the second derivative may be between two samples of it. */
#define SAMPLING_MARGIN 1.25

/* ---------------------------------------------------------------- evaluation */

/* De Casteljau down to three points, from which value and both derivatives follow; then the
 * quotient rule. */
static cs_polyline_point at_rational(const cs_hpoint *points, int degree, double t) {
  cs_hpoint work[CS_BEZIER_DEGREE + 1];
  for (int i = 0; degree > 2 && i <= degree; i++)
    work[i] = points[i];
  for (int level = degree; level > 2; level--)
    for (int i = 0; i < level; i++) {
      work[i].x += t * (work[i + 1].x - work[i].x);
      work[i].y += t * (work[i + 1].y - work[i].y);
      work[i].w += t * (work[i + 1].w - work[i].w);
    }
  const cs_hpoint *p = degree > 2 ? work : points;
  double s = 1 - t, b0 = s * s, b1 = 2 * s * t, b2 = t * t, scale = degree * (degree - 1.0);
  double w = b0 * p[0].w + b1 * p[1].w + b2 * p[2].w;
  double w1 = degree * (s * (p[1].w - p[0].w) + t * (p[2].w - p[1].w));
  double w2 = scale * (p[0].w - 2 * p[1].w + p[2].w);
  double x1 = degree * (s * (p[1].x - p[0].x) + t * (p[2].x - p[1].x));
  double y1 = degree * (s * (p[1].y - p[0].y) + t * (p[2].y - p[1].y));
  double by_w = 1 / w;
  double x = (b0 * p[0].x + b1 * p[1].x + b2 * p[2].x) * by_w;
  double y = (b0 * p[0].y + b1 * p[1].y + b2 * p[2].y) * by_w;
  double slope_x = (x1 - w1 * x) * by_w, slope_y = (y1 - w1 * y) * by_w;
  double x2 = scale * (p[0].x - 2 * p[1].x + p[2].x);
  double y2 = scale * (p[0].y - 2 * p[1].y + p[2].y);
  return (cs_polyline_point){x,
                             y,
                             slope_x,
                             slope_y,
                             (x2 - 2 * w1 * slope_x - w2 * x) * by_w,
                             (y2 - 2 * w1 * slope_y - w2 * y) * by_w};
}

/* 4 coefficients of x and 4 of y of a piece in powers. */
static inline void load_powers(const cs_boundary_set *set, const cs_boundary_piece *piece,
                               double c[8]) {
  const cs_hpoint *p = set->points + piece->point;
  const cs_hpoint cubic = piece->degree == 3 ? p[3] : (cs_hpoint){0};
  for (int i = 0; i < 3; i++) {
    c[i] = p[i].x;
    c[4 + i] = p[i].y;
  }
  c[3] = cubic.x;
  c[7] = cubic.y;
}

static cs_polyline_point at(const cs_boundary_set *set, const cs_boundary_piece *piece, double t) {
  double c[8];
  if (!piece->is_power)
    return at_rational(set->points + piece->point, piece->degree, t);
  load_powers(set, piece, c);
  return cs_polyline_power(c, t);
}

static void find_vertices(const cs_boundary_set *set, const cs_boundary_piece *piece,
                          uint32_t first, uint32_t stride, cs_polyline_vertices *out) {
  const cs_boundary_piece strided = cs_polyline_strided(piece, stride);
  cs_polyline_seat seats[CS_POLYLINE_ROOM];
  double t[CS_POLYLINE_ROOM + 2] = {0}; /* the ends have no neighbour and do not need one */
  for (int k = 0; k <= piece->group; k++) {
    double vertex = (double)first + (double)stride * k;
    cs_polyline_point p = at(set, piece, vertex * piece->step);
    seats[k] = cs_polyline_seat_of(piece, vertex, k, &p);
    t[k + 1] = seats[k].t;
  }
  for (int k = 0; k <= piece->group; k++) {
    double before = t[k + 1] - t[k], after = t[k + 2] - t[k + 1];
    double share = cs_polyline_share(piece, k, before, after);
    cs_polyline_point p = at(set, piece, seats[k].t);
    celspan_point on = cs_polyline_place(&strided, 0, &seats[k], &p);
    celspan_point beside = cs_polyline_place(&strided, share, &seats[k], &p);
    out->on_x[k] = on.x;
    out->on_y[k] = on.y;
    out->x[k] = beside.x;
    out->y[k] = beside.y;
  }
}

/* ---------------------------------------------------------------- groups */

/* An end of the piece, exactly. */
static void set_end(cs_polyline_vertices *v, int k, double x, double y) {
  v->on_x[k] = v->x[k] = x;
  v->on_y[k] = v->y[k] = y;
}

/* The vertices of a group, or every stride-th of a leap's; its ends on the curve. */
static void make_vertices(const cs_boundary_set *set, const cs_boundary_piece *piece,
                          uint32_t first, uint32_t stride, cs_polyline_vertices *v) {
  if (piece->degree > 1 && piece->is_power) {
    double c[8];
    load_powers(set, piece, c);
    CS_WIDE_CHOOSE(cs_isa_best(), cs_polyline_powers)(c, piece, first, stride, v);
  } else if (piece->degree > 1) {
    find_vertices(set, piece, first, stride, v);
  }
  if (first == 0)
    set_end(v, 0, piece->x0, piece->y0);
  if (first + stride * piece->group == piece->chords)
    set_end(v, piece->group, piece->x1, piece->y1);
}

/* The arc through vertices first and end that has the area of the chords between them. */
static cs_polyline_arc fit_arc(const cs_polyline_vertices *v, int first, int end) {
  double x = v->x[first], y = v->y[first], height = v->y[end] - y, width = v->x[end] - x;
  double area = 0; /* twice that of the chords, left of them */
  for (int k = first; k < end; k++)
    area += ((v->x[k] - x) + (v->x[k + 1] - x)) * (v->y[k + 1] - v->y[k]);
  double curve = 3 * (width * height - area) / (height * height * height);
  return (cs_polyline_arc){x, y, height, width / height, curve};
}

/* Whether the arc is near its chord within every row: rows treat it as one. */
static bool is_straight(const cs_polyline_arc *a) {
  double top = a->mean - a->curve * a->height, foot = a->mean + a->curve * a->height;
  double gentlest = top < 0 ? -foot : foot, other = top < 0 ? -top : top;
  gentlest = other < gentlest ? other : gentlest; /* less than 0 where x has an extremum inside */
  return fabs(a->curve) <= ARC_CURVE * (gentlest > 1 ? gentlest : 1);
}

/* Adds one arc for the chords from vertex first to end, if it is near the curve. */
static bool add_arc(const cs_polyline_vertices *v, int first, int end, cs_boundary_group *out) {
  cs_polyline_arc a = fit_arc(v, first, end);
  if (end - first < 2 || !(a.height > 0) || !is_straight(&a) ||
      CS_WIDE_CHOOSE(cs_isa_best(), cs_polyline_strays)(&a, v, first, end))
    return false;
  out->x[out->count] = a.x;
  out->y[out->count] = a.y;
  out->slope[out->count] = a.mean - a.curve * a.height;
  out->curve[out->count++] = a.curve;
  return true;
}

static void add_chords(const cs_polyline_vertices *v, int first, int end, cs_boundary_group *out) {
  for (int k = first; k < end; k++) {
    double height = v->y[k + 1] - v->y[k];
    out->x[out->count] = v->x[k];
    out->y[out->count] = v->y[k];
    out->slope[out->count] = height > 0 ? (v->x[k + 1] - v->x[k]) / height : 0;
    out->curve[out->count++] = 0;
  }
}

static void end_group(const cs_polyline_vertices *v, int count, uint32_t first, uint32_t groups,
                      cs_boundary_group *out) {
  out->x[out->count] = v->x[count];
  out->y[out->count] = v->y[count];
  out->first = first;
  out->groups = groups;
}

/* One arc for the whole leap of a group, if the leap is complete and the arc near enough. */
static bool try_leap(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t group,
                     cs_boundary_group *out) {
  cs_polyline_vertices v;
  uint32_t leap = piece->leap, base = group - group % leap;
  if (leap == 1 || (base + leap) * piece->group > piece->chords)
    return false;
  make_vertices(set, piece, base * piece->group, leap, &v);
  if (!add_arc(&v, 0, piece->group, out))
    return false;
  end_group(&v, piece->group, base, leap, out);
  return true;
}

void cs_polyline_group(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t group,
                       bool leaps, cs_boundary_group *out) {
  cs_polyline_vertices v;
  int half = piece->half, count = piece->group;
  out->count = 0;
  if (leaps && try_leap(set, piece, group, out))
    return;
  make_vertices(set, piece, group * piece->group, 1, &v);
  if (!add_arc(&v, 0, count, out)) {
    if (!add_arc(&v, 0, half, out))
      add_chords(&v, 0, half, out);
    if (half < count && !add_arc(&v, half, count, out))
      add_chords(&v, half, count, out);
  }
  end_group(&v, count, group, 1, out);
}

celspan_point cs_polyline_plain(const cs_boundary_set *set, const cs_boundary_piece *piece,
                                uint32_t vertex) {
  if (vertex == 0)
    return (celspan_point){piece->x0, piece->y0};
  if (vertex == piece->chords)
    return (celspan_point){piece->x1, piece->y1};
  cs_polyline_point p = at(set, piece, vertex * piece->step);
  return (celspan_point){p.x, p.y};
}

/* ---------------------------------------------------------------- fitting */

static double polynomial_bend(const cs_bezier *curve) {
  double largest = 0, w = curve->points[0].w;
  for (int i = 0; i + 2 <= curve->degree; i++) {
    const cs_hpoint *p = curve->points + i;
    double x = p[0].x - 2 * p[1].x + p[2].x, y = p[0].y - 2 * p[1].y + p[2].y;
    largest = fmax(largest, x * x + y * y);
  }
  return curve->degree * (curve->degree - 1) * sqrt(largest) / w;
}

static double rational_bend(const cs_bezier *curve) {
  double largest = 0;
  int steps = 4 * curve->degree;
  for (int i = 0; i <= steps; i++) {
    cs_polyline_point p = at_rational(curve->points, curve->degree, (double)i / steps);
    largest = fmax(largest, p.bend_x * p.bend_x + p.bend_y * p.bend_y);
  }
  return SAMPLING_MARGIN * sqrt(largest);
}

static void to_powers(const cs_bezier *curve, cs_hpoint *c) {
  cs_hpoint p[4];
  for (int i = 0; i <= curve->degree; i++)
    p[i] = (cs_hpoint){curve->points[i].x / curve->points[i].w,
                       curve->points[i].y / curve->points[i].w, 0};
  c[0] = p[0];
  double n = curve->degree;
  c[1] = (cs_hpoint){n * (p[1].x - p[0].x), n * (p[1].y - p[0].y), 0};
  double pairs = n * (n - 1) / 2;
  c[2] = (cs_hpoint){pairs * ((p[2].x - p[1].x) - (p[1].x - p[0].x)),
                     pairs * ((p[2].y - p[1].y) - (p[1].y - p[0].y)), 0};
  if (curve->degree == 3)
    c[3] = (cs_hpoint){(p[3].x - p[0].x) - 3 * (p[2].x - p[1].x),
                       (p[3].y - p[0].y) - 3 * (p[2].y - p[1].y), 0};
}

static celspan_status store_points(celspan_context *context, cs_boundary_set *set,
                                   const cs_bezier *curve, cs_boundary_piece *piece) {
  size_t count = (size_t)curve->degree + 1;
  if (set->point_count > UINT32_MAX - count)
    return cs_fail(context, CELSPAN_LIMIT, "the frame has more than 4294967295 curve points");
  CS_TRY(cs_mem_reserve(context, (void **)&set->points, &set->point_capacity,
                        set->point_count + count, sizeof *set->points));
  piece->point = (uint32_t)set->point_count;
  piece->degree = (uint8_t)curve->degree;
  if (piece->is_power)
    to_powers(curve, set->points + set->point_count);
  else
    memcpy(set->points + set->point_count, curve->points, count * sizeof *set->points);
  set->point_count += count;
  return CELSPAN_OK;
}

/* The error of an arc grows with the cube of its length, that of a chord with the square. So an arc
 * can replace more chords the more chords the piece has, in proportion to the third root. The
 * factor 110 was measured. */
static uint8_t choose_leap(uint32_t chords) {
  uint32_t leap = 1;
  while (leap < LEAP_MOST && 110 * (leap + 1) * (leap + 1) * (leap + 1) <= chords)
    leap++;
  return (uint8_t)leap;
}

celspan_status cs_polyline_fit(celspan_context *context, cs_boundary_set *set,
                               const cs_bezier *curve, cs_boundary_piece *piece) {
  bool is_polynomial = cs_bezier_is_polynomial(curve);
  double bend = is_polynomial ? polynomial_bend(curve) : rational_bend(curve);
  piece->chords = 1;
  piece->degree = 1;
  if (!(bend > 8 * ONE_CHORD))
    return CELSPAN_OK;
  double chords = fmin(fmax(2, ceil(sqrt(bend / (8 * CHORD_SAG)))), CHORD_LIMIT);
  double groups = ceil(chords / CS_BOUNDARY_GROUP);
  piece->group = (uint8_t)ceil(chords / groups);
  piece->half = piece->group >= HALVES_LEAST ? piece->group / 2 : piece->group;
  piece->chords = piece->group * (uint32_t)groups;
  piece->leap = choose_leap(piece->chords);
  piece->step = 1.0 / piece->chords;
  piece->sag = bend * (1.0 / 8) * (piece->step * piece->step);
  piece->is_power = is_polynomial && curve->degree <= 3;
  return store_points(context, set, curve, piece);
}
