/* All vertices of a group at once, LANES of them in one instruction. See polyline_vertex.h. */
#include "model/geometry/polyline.h"
#include "model/geometry/polyline_vertex.h"

#define ARC_TOLERANCE 0.004 /* pixels */
/* A curve is bent where |x''| > BENT max(1, |x'|), by y: just more than an arc may have
 * (polyline.c). */
#define BENT 0.042
/* A vertex is moved to a whole height if it is nearer than this part of the rows in a step. */
#define NEARBY (1.0 / 6)

enum { LANES = CS_WIDE_LANES / 2 };

typedef double lanes __attribute__((vector_size(8 * LANES)));
typedef int64_t masks __attribute__((vector_size(8 * LANES)));
typedef lanes number;
#include "model/geometry/polyline_point.h"

static const double numbers[CS_POLYLINE_ROOM] = {0, 1, 2, 3, 4, 5, 6, 7};

/* ---------------------------------------------------------------- lanes */

static inline lanes load(const double *from) {
  lanes v;
  memcpy(&v, from, sizeof v);
  return v;
}

static inline void store(double *to, lanes v) { memcpy(to, &v, sizeof v); }

static inline lanes either(masks mask, lanes a, lanes b) {
#if defined(__AVX512F__)
  return _mm512_mask_blend_pd(_mm512_movepi64_mask((__m512i)mask), (__m512d)b, (__m512d)a);
#elif defined(__AVX2__)
  return _mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)mask);
#else
  return (lanes)((mask & (masks)a) | (~mask & (masks)b));
#endif
}

/* a where the mask is set, otherwise 0. */
static inline lanes where(masks mask, lanes a) { return (lanes)(mask & (masks)a); }

static inline lanes magnitude(lanes a) { return (lanes)((masks)a & INT64_MAX); }

/* b where one of them is NaN. */
static inline lanes least(lanes a, lanes b) {
#if defined(__AVX512F__)
  return _mm512_min_pd(a, b);
#elif defined(__AVX2__)
  return _mm256_min_pd(a, b);
#elif defined(__SSE2__)
  return _mm_min_pd(a, b);
#else
  return either(a < b, a, b);
#endif
}

static inline lanes most(lanes a, lanes b) {
#if defined(__AVX512F__)
  return _mm512_max_pd(a, b);
#elif defined(__AVX2__)
  return _mm256_max_pd(a, b);
#elif defined(__SSE2__)
  return _mm_max_pd(a, b);
#else
  return either(a > b, a, b);
#endif
}

static inline lanes clamp(lanes a, double low, double high) {
  const lanes zero = {0};
  return least(most(a, zero + low), zero + high);
}

/* ---------------------------------------------------------------- seats */

/* The seats of a group's vertices. */
typedef struct seat_list {
  /* t of vertex k is at k + 1; 0 before the first and after the last vertex */
  double t[CS_POLYLINE_ROOM + 2];
  double y[CS_POLYLINE_ROOM];      /* for each vertex the nearest whole height */
  int64_t whole[CS_POLYLINE_ROOM]; /* -1: the vertex is moved to this height; 0: it is not moved */
  double bent[CS_POLYLINE_ROOM];   /* 1: no arc can be near the curve at this vertex; otherwise 0 */
} seat_list;

/* The vertices in the lanes, by number, and some of their values that are needed often. */
typedef struct places {
  const cs_boundary_piece *piece;
  lanes vertex;
  masks inner; /* the vertex is not an end of the piece */
} places;

static inline places places_of(const cs_boundary_piece *piece, uint32_t first, uint32_t stride,
                               int k) {
  places at = {.piece = piece, .vertex = (double)first + (double)stride * load(numbers + k)};
  at.inner = (at.vertex > 0) & (at.vertex < (double)piece->chords);
  return at;
}

static inline lanes parameters(const places *at) {
  return clamp((at->vertex - CS_POLYLINE_LEAD) * at->piece->step, 0, 1);
}

/* Whether no arc can be near the curve; if so, the vertex is displaced even if it is a border. */
static inline masks are_bent(const cs_polyline_point *p) {
  lanes cross = magnitude(p->bend_x * p->slope_y - p->bend_y * p->slope_x);
  lanes wide = most(magnitude(p->slope_x), p->slope_y);
  return cross > BENT * (p->slope_y * p->slope_y) * wide;
}

/* p: at the even parameters. A seat is chosen so that the vertex lies near the whole height after
 * it has been displaced. Steps lower than a row have no whole heights to move to. */
static inline void sit(const cs_polyline_point *p, const places *at, int k, seat_list *out) {
  /* the sum of a number and this is rounded to a whole number */
  const lanes bias = (lanes){0} + 0x1.8p52;
  const cs_boundary_piece *piece = at->piece;
  lanes t = parameters(at), y = (p->y + bias) - bias, away = y - p->y;
  lanes rows = p->slope_y * piece->step;
  lanes lift = p->bend_y * ((1.0 / 12) * (piece->step * piece->step));
  masks inside = (y > piece->y0) & (y < piece->y1) & at->inner;
  masks whole = (rows >= 1) & (magnitude(away) <= NEARBY * rows) & inside;
  store(out->t + 1 + k, either(whole, t + (away + lift) / p->slope_y, t));
  store(out->y + k, y);
  memcpy(out->whole + k, &whole, sizeof whole);
  store(out->bent + k, where(are_bent(p), (lanes){0} + 1));
}

/* ---------------------------------------------------------------- places */

/* The limits for displacing the vertices of a group. */
typedef struct limits {
  double above, below; /* the shares of its first and its last vertex, in units of C'' / 12 */
  double lift;         /* the limit for any vertex upwards or downwards, in pixels */
  bool is_halved;      /* the places with one more vertex on the curve are also needed */
} limits;

static inline limits find_limits(const cs_boundary_piece *piece, uint32_t first, uint32_t stride,
                                 const seat_list *seats) {
  uint32_t end = first + stride * piece->group;
  double even = piece->step * piece->step;
  bool is_bent_above = seats->bent[0] > 0, is_bent_below = seats->bent[piece->group] > 0;
  return (limits){is_bent_above && first > 0 ? even : 0,
                  is_bent_below && end < piece->chords ? even : 0,
                  CS_POLYLINE_LIFT * ((double)stride * stride) * piece->sag,
                  piece->half < piece->group && !is_bent_above && !is_bent_below};
}

/* The share of each vertex, in units of C''. With even steps of length h the share is h^2 / 12. If
 * a vertex is not displaced by its share, its neighbour compensates the difference. */
static inline lanes find_shares(const cs_boundary_piece *piece, const limits *most, lanes k,
                                lanes before, lanes after) {
  const double group = piece->group;
  lanes b2 = before * before, a2 = after * after;
  lanes both = (b2 * before + a2 * after) + where(k == 1, (b2 - most->above) * before) +
               where(k == group - 1, (a2 - most->below) * after);
  lanes border =
      where(k == 0, (lanes){0} + most->above) + where(k == group, (lanes){0} + most->below);
  masks inner = (k > 0) & (k < group);
  return (1.0 / 12) * either(inner, both / (before + after), border);
}

/* The same where one more vertex, k == half, is on the curve. */
static inline lanes find_halved(const cs_boundary_piece *piece, lanes shares, lanes k, lanes before,
                                lanes after) {
  const double half = piece->half;
  lanes b3 = before * before * before, a3 = after * after * after;
  lanes more = where(k == half + 1, b3) + where(k == half - 1, a3);
  return where(k != half, shares + (1.0 / 12) * more / (before + after));
}

/* How to find vertices: a place on the curve, and how the vertex moves from there for each unit of
 * C''. */
typedef struct ways {
  lanes x, y, along_x, along_y;
} ways;

/* A seat at a whole height was found by one step of Newton's method, so the curve is not quite at
 * the height there; the vertex is moved along the tangent by the rest. Rounding may place the curve
 * beyond an end of a piece of hardly any height, where no vertex may lie. p: at the seats. */
static inline ways find_ways(const cs_boundary_piece *piece, const cs_polyline_point *p,
                             masks whole, lanes height) {
  lanes run = where(whole, p->slope_x / p->slope_y);
  lanes y = clamp(either(whole, height, p->y), piece->y0, piece->y1);
  return (ways){p->x + (height - p->y) * run, y, p->bend_y * run - p->bend_x,
                where(~whole, -p->bend_y)};
}

static inline void displace(const cs_boundary_piece *piece, const ways *from, lanes share,
                            double limit, double *x, double *y) {
  lanes lift = clamp(share * from->along_y, -limit, limit);
  store(x, clamp(from->x + share * from->along_x, piece->left, piece->right));
  lanes highest = 0.5 * (from->y + piece->y0), lowest = 0.5 * (from->y + piece->y1);
  store(y, least(most(from->y + lift, highest), lowest));
}

static inline void place(const cs_boundary_piece *piece, const limits *most,
                         const cs_polyline_point *p, int k, const seat_list *seats,
                         cs_polyline_vertices *restrict out) {
  lanes t = load(seats->t + 1 + k), vertex = load(numbers + k);
  lanes before = t - load(seats->t + k), after = load(seats->t + 2 + k) - t;
  masks whole;
  memcpy(&whole, seats->whole + k, sizeof whole);
  ways from = find_ways(piece, p, whole, load(seats->y + k));
  lanes shares = find_shares(piece, most, vertex, before, after);
  store(out->on_x + k, from.x);
  store(out->on_y + k, from.y);
  displace(piece, &from, shares, most->lift, out->x + k, out->y + k);
  if (most->is_halved)
    displace(piece, &from, find_halved(piece, shares, vertex, before, after), most->lift,
             out->halved_x + k, out->halved_y + k);
}

/* An end of the piece, exactly. */
static inline void set_end(cs_polyline_vertices *v, int k, double x, double y) {
  v->on_x[k] = v->halved_x[k] = v->x[k] = x;
  v->on_y[k] = v->halved_y[k] = v->y[k] = y;
}

/* Sets the ends of the piece and measures the chords. */
static inline void finish(const cs_boundary_piece *piece, uint32_t first, uint32_t end,
                          const seat_list *seats, cs_polyline_vertices *restrict out) {
  const int group = piece->group;
  out->is_bent_above = seats->bent[0] > 0;
  out->is_bent_below = seats->bent[group] > 0;
  if (first == 0)
    set_end(out, 0, piece->x0, piece->y0);
  if (end == piece->chords)
    set_end(out, group, piece->x1, piece->y1);
  for (int k = 0; k < group; k += LANES) {
    lanes height = load(out->y + 1 + k) - load(out->y + k);
    lanes slope = (load(out->x + 1 + k) - load(out->x + k)) / height;
    store(out->slope + k, where(height > 0, slope));
  }
}

/* ---------------------------------------------------------------- groups */

/* powers: NULL where the curve is rational; a constant of each caller. */
static inline void make_group(const double *powers, const cs_hpoint *points,
                              const cs_boundary_piece *piece, uint32_t first, uint32_t stride,
                              cs_polyline_vertices *restrict out) {
  const cs_boundary_piece own = *piece;
  const int degree = own.degree;
  seat_list seats;
  seats.t[0] = seats.t[CS_POLYLINE_ROOM + 1] = 0;
  for (int k = 0; k <= own.group; k += LANES) {
    const places at = places_of(&own, first, stride, k);
    const lanes t = parameters(&at);
    const cs_polyline_point p =
        powers ? cs_polyline_power(powers, t) : cs_polyline_weigh(points, degree, t);
    sit(&p, &at, k, &seats);
  }
  const limits most = find_limits(&own, first, stride, &seats);
  for (int k = 0; k <= own.group; k += LANES) {
    const lanes t = load(seats.t + 1 + k);
    const cs_polyline_point p =
        powers ? cs_polyline_power(powers, t) : cs_polyline_weigh(points, degree, t);
    place(&own, &most, &p, k, &seats, out);
  }
  finish(&own, first, first + stride * own.group, &seats, out);
}

void CS_WIDE(cs_polyline_powers)(const double c[8], const cs_boundary_piece *piece, uint32_t first,
                                 uint32_t stride, cs_polyline_vertices *restrict out) {
  double own[8];
  memcpy(own, c, sizeof own);
  make_group(own, NULL, piece, first, stride, out);
}

void CS_WIDE(cs_polyline_rational)(const cs_hpoint *points, const cs_boundary_piece *piece,
                                   uint32_t first, uint32_t stride,
                                   cs_polyline_vertices *restrict out) {
  make_group(NULL, points, piece, first, stride, out);
}

bool CS_WIDE(cs_polyline_strays)(const cs_polyline_arc *arc, const cs_polyline_vertices *vertices,
                                 int first, int end) {
  const cs_polyline_arc a = *arc;
  const double low = first, high = end;
  const double *on_x = vertices->on_x, *on_y = vertices->on_y;
  double strays = 0;
#pragma omp simd reduction(+ : strays)
  for (size_t k = 0; k < CS_POLYLINE_ROOM; k++) {
    double down = on_y[k] - a.y;
    double away = (on_x[k] - a.x) - down * (a.mean + a.curve * (down - a.height));
    double slope = a.mean + a.curve * (2 * down - a.height), steep = slope < 0 ? -slope : slope;
    /* the distance from a flat arc is smaller than the distance along x */
    double across = steep > 1 ? steep : 1;
    double near = (away < 0 ? -away : away) <= ARC_TOLERANCE * across ? 0.0 : 1.0;
    strays += numbers[k] >= low ? (numbers[k] <= high ? near : 0.0) : 0.0;
  }
  return strays > 0;
}
