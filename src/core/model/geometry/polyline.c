#include "model/geometry/polyline.h"
#include "model/geometry/polyline_vertex.h"

#include <math.h>
#include <string.h>

typedef double number;
#include "model/geometry/polyline_point.h"

/* A single chord must be nearer than the tolerance, because its vertices are the ends of the piece,
 * which cannot be displaced to keep the area. */
#define ONE_CHORD (CS_BOUNDARY_TOLERANCE / 8)
/* Pixels. A piece with less height counts as flat: one chord without a slope. Its slope could be
 * infinite, and so could a quotient of an arc by the third power of a height. */
#define FLAT 0x1p-100
/* 4 times the allowed distance between an arc and its chord within a row, in pixels. */
#define ARC_CURVE 0.02
/* Groups of fewer chords are not cut in halves: two chords alone would need a vertex far from the
 * curve. */
#define HALVES_LEAST 6
/* The sag of chords that have a mean length. */
#define CHORD_SAG (0.8 * CS_BOUNDARY_TOLERANCE)
/* Gives the number of chords for their length: see choose_chords. Measured. */
#define CHORDS_MOST 2.45
#define CHORDS_SHORT 1.64
#define CHORD_LIMIT 1e9
#define LEAP_MOST 8 /* groups */
/* The factor by which the second derivative may be larger between two of its samples. */
#define SAMPLING_MARGIN 1.25

/* ---------------------------------------------------------------- evaluation */

/* The coefficients of a piece in powers: 4 of x and 4 of y. */
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
    return cs_polyline_weigh(set->points + piece->point, piece->degree, t);
  load_powers(set, piece, c);
  return cs_polyline_power(c, t);
}

/* ---------------------------------------------------------------- groups */

/* The vertices of a group, or every `stride`-th vertex of a leap. */
static void make_vertices(const cs_boundary_set *set, const cs_boundary_piece *piece,
                          uint32_t first, uint32_t stride, cs_polyline_vertices *v) {
  double c[8];
  if (piece->is_power) {
    load_powers(set, piece, c);
    CS_WIDE_CHOOSE(cs_isa_best(), cs_polyline_powers)(c, piece, first, stride, v);
  } else {
    CS_WIDE_CHOOSE(cs_isa_best(), cs_polyline_rational)
    (set->points + piece->point, piece, first, stride, v);
  }
}

/* The arc through vertices first and end that has the area of the chords between them. */
static cs_polyline_arc fit_arc(const double *vx, const double *vy, int first, int end) {
  double x = vx[first], y = vy[first], height = vy[end] - y, width = vx[end] - x;
  double area = 0; /* twice the area left of the chords */
  for (int k = first; k < end; k++)
    area += ((vx[k] - x) + (vx[k + 1] - x)) * (vy[k + 1] - vy[k]);
  double curve = 3 * (width * height - area) / (height * height * height);
  return (cs_polyline_arc){x, y, height, width / height, curve};
}

/* Whether the arc is near its chord within every row: rows then treat it as a line. */
static bool is_straight(const cs_polyline_arc *a) {
  double top = a->mean - a->curve * a->height, foot = a->mean + a->curve * a->height;
  double gentlest = top < 0 ? -foot : foot, other = top < 0 ? -top : top;
  gentlest = other < gentlest ? other : gentlest; /* less than 0 if x has an extremum inside */
  return fabs(a->curve) <= ARC_CURVE * (gentlest > 1 ? gentlest : 1);
}

/* Adds one arc for the chords from vertex `first` to `end`, if the arc is near the curve. x, y: the
 * vertices. */
static bool add_arc(const cs_polyline_vertices *v, const double *x, const double *y, int first,
                    int end, cs_boundary_group *out) {
  if (end - first < 2)
    return false;
  cs_polyline_arc a = fit_arc(x, y, first, end);
  if (!(a.height > 0) || !is_straight(&a) ||
      CS_WIDE_CHOOSE(cs_isa_best(), cs_polyline_strays)(&a, v, first, end))
    return false;
  out->x[out->count] = a.x;
  out->y[out->count] = a.y;
  out->slope[out->count] = a.mean - a.curve * a.height;
  out->curve[out->count++] = a.curve;
  return true;
}

/* All chords of a group. */
static void set_chords(const cs_polyline_vertices *v, int count, cs_boundary_group *out) {
  memcpy(out->x, v->x, sizeof out->x);
  memcpy(out->y, v->y, sizeof out->y);
  memcpy(out->slope, v->slope, sizeof out->slope);
  memset(out->curve, 0, sizeof out->curve);
  out->count = (uint32_t)count;
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
  if (v.is_bent_above || v.is_bent_below || !add_arc(&v, v.x, v.y, 0, piece->group, out))
    return false;
  end_group(&v, piece->group, base, leap, out);
  return true;
}

/* An arc for the whole group, or one for each half. */
static bool try_arcs(const cs_polyline_vertices *v, int half, int count, cs_boundary_group *out) {
  if (add_arc(v, v->x, v->y, 0, count, out))
    return true;
  return half < count && add_arc(v, v->halved_x, v->halved_y, 0, half, out) &&
         add_arc(v, v->halved_x, v->halved_y, half, count, out);
}

static inline bool is_flat(const cs_boundary_piece *piece) { return piece->y1 - piece->y0 < FLAT; }

/* The single chord of a piece. */
static void set_line(const cs_boundary_piece *piece, cs_boundary_group *out) {
  out->x[0] = piece->x0;
  out->y[0] = piece->y0;
  out->x[1] = piece->x1;
  out->y[1] = piece->y1;
  out->slope[0] = is_flat(piece) ? 0 : (piece->x1 - piece->x0) / (piece->y1 - piece->y0);
  out->curve[0] = 0;
  out->count = 1;
  out->first = 0;
  out->groups = 1;
}

void cs_polyline_group(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t group,
                       bool leaps, cs_boundary_group *out) {
  cs_polyline_vertices v;
  int half = piece->half, count = piece->group;
  if (piece->chords == 1) {
    set_line(piece, out);
    return;
  }
  out->count = 0;
  if (leaps && try_leap(set, piece, group, out))
    return;
  make_vertices(set, piece, group * piece->group, 1, &v);
  if (v.is_bent_above || v.is_bent_below || !try_arcs(&v, half, count, out))
    set_chords(&v, count, out);
  end_group(&v, count, group, 1, out);
}

celspan_point cs_polyline_plain(const cs_boundary_set *set, const cs_boundary_piece *piece,
                                uint32_t vertex) {
  if (vertex == 0)
    return (celspan_point){piece->x0, piece->y0};
  if (vertex == piece->chords)
    return (celspan_point){piece->x1, piece->y1};
  cs_polyline_point p = at(set, piece, cs_polyline_parameter(piece, vertex));
  return (celspan_point){p.x, p.y};
}

/* A cubic at the parameters of all inner vertices. */
static void place_vertices(const double c[4], const cs_boundary_piece *piece, double *out) {
  double step = piece->step;
  for (uint32_t k = 0; k + 1 < piece->chords; k++) {
    double t = ((int32_t)k + (1 - CS_POLYLINE_LEAD)) * step;
    out[k] = ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
  }
}

/* Each end of a chord compensates half of the area beside it. For the shorter chords at the ends of
 * the piece, only their other end is displaced. The difference of a cubic and its second derivative
 * is a cubic. */
void cs_polyline_displaced(const cs_boundary_set *set, const cs_boundary_piece *piece, double *x,
                           double *y) {
  double share = piece->step * piece->step * (1.0 / 12), c[8];
  if (piece->is_power) {
    load_powers(set, piece, c);
    for (int axis = 0; axis < 8; axis += 4) {
      c[axis] -= share * 2 * c[axis + 2];
      c[axis + 1] -= share * 6 * c[axis + 3];
    }
    place_vertices(c, piece, x);
    place_vertices(c + 4, piece, y);
    return;
  }
  for (uint32_t k = 1; k < piece->chords; k++) {
    cs_polyline_point p = at(set, piece, cs_polyline_parameter(piece, k));
    x[k - 1] = p.x - share * p.bend_x;
    y[k - 1] = p.y - share * p.bend_y;
  }
}

/* ---------------------------------------------------------------- fitting */

static inline double bend_at(const cs_pair *p) {
  cs_pair bend = p[0] - 2 * p[1] + p[2];
  bend *= bend;
  return bend[0] + bend[1];
}

/* The largest second derivative of a polynomial, by its control points. */
static inline double polynomial_bend(const cs_pair *p, int degree) {
  double largest = 0;
  for (int i = 0; i + 2 <= degree; i++) {
    double bend = bend_at(&p[i]);
    largest = bend > largest ? bend : largest;
  }
  return degree * (degree - 1) * sqrt(largest);
}

static double rational_bend(const cs_bezier *curve) {
  double largest = 0;
  int steps = 4 * curve->degree;
  for (int i = 0; i <= steps; i++) {
    cs_polyline_point p = cs_polyline_weigh(curve->points, curve->degree, (double)i / steps);
    largest = fmax(largest, p.bend_x * p.bend_x + p.bend_y * p.bend_y);
  }
  return SAMPLING_MARGIN * sqrt(largest);
}

static inline cs_hpoint power(cs_pair coefficient) {
  return (cs_hpoint){coefficient[0], coefficient[1], 0};
}

/* p: in pixels; of degree 2 or 3. */
static inline void to_powers(const cs_pair *p, int degree, cs_hpoint *c) {
  double n = degree, pairs = n * (n - 1) / 2;
  cs_pair first = p[1] - p[0], second = p[2] - p[1];
  c[0] = power(p[0]);
  c[1] = power(n * first);
  c[2] = power(pairs * (second - first));
  if (degree == 3)
    c[3] = power((p[3] - p[0]) - 3 * second);
}

/* Appends points of a piece, for which there is room, and sets the degree of the piece. */
static inline cs_hpoint *append_points(cs_boundary_set *set, int degree, cs_boundary_piece *piece) {
  size_t first = set->point_count;
  piece->point = (uint32_t)first;
  piece->degree = (uint8_t)degree;
  set->point_count = first + (size_t)degree + 1;
  return &set->points[first];
}

/* The error of an arc grows with the cube of its length, the error of a chord with the square. So
 * the number of chords that an arc can replace grows with the third root of the number of chords.
 * The factor 40 was measured. */
static uint8_t choose_leap(uint32_t chords) {
  uint32_t leap = 1;
  while (leap < LEAP_MOST && 40 * (leap + 1) * (leap + 1) * (leap + 1) <= chords)
    leap++;
  return (uint8_t)leap;
}

/* Rounds a positive number up to a whole number. */
static inline uint32_t ceiling(double x) {
  int32_t whole = (int32_t)x;
  return (uint32_t)whole + (whole < x);
}

/* A little more than the length of the control polygon. */
static inline double length_of(const cs_pair *p, int degree) {
  double length = 0;
  for (int i = 0; i < degree; i++) {
    cs_pair leg = p[i + 1] - p[i];
    double x = fabs(leg[0]), y = fabs(leg[1]);
    length += cs_number_most(x, y) + 0.5 * cs_number_least(x, y);
  }
  return length;
}

/* False: a single chord is near enough.
 *
 * The error is the area between curve and polyline in a pixel, about where a vertex is displaced:
 *
 *    .-o-.         short chords: a pixel sees both sides of   .--.__o__.--.  long ones: it sees one
 *   '     '        the curve, and they cancel each other      |    |  |   |
 *  |       |                                                       pixel
 *  pixel
 *
 * So chords shorter than about two pixels may have a larger sag, and longer ones must have a
 * smaller one; by the square of the number of chords, sag x length / (length + CHORDS_SHORT) stays
 * about the same. */
static inline bool choose_chords(double bend, double length, cs_boundary_piece *piece) {
  if (!(bend > 8 * ONE_CHORD) || is_flat(piece))
    return false;
  double even = sqrt(bend / (8 * CHORD_SAG));
  double by_length = sqrt(CHORDS_MOST * length / (length + CHORDS_SHORT * even));
  double wanted = even * by_length + 2 * CS_POLYLINE_LEAD;
  uint32_t chords = ceiling(cs_number_clamp(wanted, 2, CHORD_LIMIT));
  uint32_t groups = (chords + CS_BOUNDARY_GROUP - 1) / CS_BOUNDARY_GROUP;
  piece->group = (uint8_t)((chords + groups - 1) / groups);
  piece->half = piece->group >= HALVES_LEAST ? piece->group / 2 : piece->group;
  piece->chords = piece->group * groups;
  piece->leap = choose_leap(piece->chords);
  piece->step = cs_polyline_step(piece->chords);
  piece->sag = bend * (1.0 / 8) * (piece->step * piece->step);
  return true;
}

static inline void fit_plain(cs_boundary_set *set, const cs_pair *points, int degree,
                             cs_boundary_piece *piece) {
  if (!choose_chords(polynomial_bend(points, degree), length_of(points, degree), piece) &&
      !set->keeps_curves)
    return;
  piece->is_power = true;
  to_powers(points, degree, append_points(set, degree, piece));
}

void cs_polyline_fit_plain(cs_boundary_set *set, const cs_plain *curve, cs_boundary_piece *piece) {
  /* most curves have this degree, and the compiler needs no loops for it */
  if (curve->degree == CS_PLAIN_DEGREE)
    fit_plain(set, curve->points, CS_PLAIN_DEGREE, piece);
  else
    fit_plain(set, curve->points, curve->degree, piece);
}

celspan_status cs_polyline_fit(celspan_context *context, cs_boundary_set *set,
                               const cs_bezier *curve, cs_boundary_piece *piece) {
  bool is_polynomial = cs_bezier_is_polynomial(curve);
  int degree = curve->degree;
  cs_pair p[CS_BEZIER_DEGREE + 1];
  for (int i = 0; i <= degree; i++)
    p[i] = cs_pair_load(&curve->points[i]) / curve->points[i].w;
  double bend = is_polynomial ? polynomial_bend(p, degree) : rational_bend(curve);
  if (!choose_chords(bend, length_of(p, degree), piece) && !set->keeps_curves)
    return CELSPAN_OK;
  CS_TRY(cs_polyline_reserve(context, set, (size_t)degree + 1));
  cs_hpoint *points = append_points(set, degree, piece);
  piece->is_power = is_polynomial && degree <= 3;
  for (int i = 0; i <= degree; i++) {
    points[i] = curve->points[i];
  }
  if (piece->is_power)
    to_powers(p, degree, points);
  return CELSPAN_OK;
}
