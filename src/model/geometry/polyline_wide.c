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

/* One cs_polyline_point in each lane. */
typedef struct spots {
  lanes x, y, slope_x, slope_y, bend_x, bend_y;
} spots;

/* A curve in powers of its parameter, and its derivatives. */
typedef struct powers {
  double x[4], y[4], slope_x[3], slope_y[3], bend_x[2], bend_y[2];
} powers;

static inline powers load_powers(const double c[8]) {
  return (powers){{c[0], c[1], c[2], c[3]},   {c[4], c[5], c[6], c[7]}, {c[1], 2 * c[2], 3 * c[3]},
                  {c[5], 2 * c[6], 3 * c[7]}, {2 * c[2], 6 * c[3]},     {2 * c[6], 6 * c[7]}};
}

static inline lanes cubic(const double c[4], lanes t) {
  return ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
}

static inline lanes quadratic(const double c[3], lanes t) { return (c[2] * t + c[1]) * t + c[0]; }

static inline spots at_powers(const powers *c, lanes t) {
  return (spots){cubic(c->x, t),
                 cubic(c->y, t),
                 quadratic(c->slope_x, t),
                 quadratic(c->slope_y, t),
                 c->bend_x[1] * t + c->bend_x[0],
                 c->bend_y[1] * t + c->bend_y[0]};
}

/* A curve with weights. */
typedef struct rational {
  const cs_hpoint *points;
  int degree;
} rational;

typedef struct weighted {
  lanes x, y, w;
} weighted;

/* De Casteljau's scheme down to three points. */
static inline void find_last_three(const rational *c, lanes t, weighted *p) {
  const lanes zero = {0};
  weighted work[CS_BEZIER_DEGREE + 1];
  for (int i = 0; i <= c->degree; i++)
    work[i] = (weighted){zero + c->points[i].x, zero + c->points[i].y, zero + c->points[i].w};
  for (int level = c->degree; level > 2; level--)
    for (int i = 0; i < level; i++) {
      work[i].x += t * (work[i + 1].x - work[i].x);
      work[i].y += t * (work[i + 1].y - work[i].y);
      work[i].w += t * (work[i + 1].w - work[i].w);
    }
  memcpy(p, work, 3 * sizeof *p);
}

/* As at_rational in polyline.c. */
static inline spots at_rational(const rational *c, lanes t) {
  weighted p[3];
  find_last_three(c, t, p);
  const double degree = c->degree, scale = degree * (degree - 1.0);
  lanes s = 1 - t, b0 = s * s, b1 = 2 * s * t, b2 = t * t;
  lanes w = b0 * p[0].w + b1 * p[1].w + b2 * p[2].w;
  lanes w1 = degree * (s * (p[1].w - p[0].w) + t * (p[2].w - p[1].w));
  lanes w2 = scale * (p[0].w - 2 * p[1].w + p[2].w);
  lanes x1 = degree * (s * (p[1].x - p[0].x) + t * (p[2].x - p[1].x));
  lanes y1 = degree * (s * (p[1].y - p[0].y) + t * (p[2].y - p[1].y));
  lanes by_w = 1 / w;
  lanes x = (b0 * p[0].x + b1 * p[1].x + b2 * p[2].x) * by_w;
  lanes y = (b0 * p[0].y + b1 * p[1].y + b2 * p[2].y) * by_w;
  lanes slope_x = (x1 - w1 * x) * by_w, slope_y = (y1 - w1 * y) * by_w;
  lanes x2 = scale * (p[0].x - 2 * p[1].x + p[2].x);
  lanes y2 = scale * (p[0].y - 2 * p[1].y + p[2].y);
  return (spots){x,
                 y,
                 slope_x,
                 slope_y,
                 (x2 - 2 * w1 * slope_x - w2 * x) * by_w,
                 (y2 - 2 * w1 * slope_y - w2 * y) * by_w};
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
static inline masks are_bent(const spots *p) {
  lanes cross = magnitude(p->bend_x * p->slope_y - p->bend_y * p->slope_x);
  lanes wide = most(magnitude(p->slope_x), p->slope_y);
  return cross > BENT * (p->slope_y * p->slope_y) * wide;
}

/* p: at the even parameters. A seat is chosen so that the vertex lies near the whole height after
 * it has been displaced. Steps lower than a row have no whole heights to move to. */
static inline void sit(const spots *p, const places *at, int k, seat_list *out) {
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
static inline ways find_ways(const cs_boundary_piece *piece, const spots *p, masks whole,
                             lanes height) {
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

static inline void place(const cs_boundary_piece *piece, const limits *most, const spots *p, int k,
                         const seat_list *seats, cs_polyline_vertices *restrict out) {
  lanes t = load(seats->t + 1 + k), number = load(numbers + k);
  lanes before = t - load(seats->t + k), after = load(seats->t + 2 + k) - t;
  masks whole;
  memcpy(&whole, seats->whole + k, sizeof whole);
  ways from = find_ways(piece, p, whole, load(seats->y + k));
  lanes shares = find_shares(piece, most, number, before, after);
  store(out->on_x + k, from.x);
  store(out->on_y + k, from.y);
  displace(piece, &from, shares, most->lift, out->x + k, out->y + k);
  if (most->is_halved)
    displace(piece, &from, find_halved(piece, shares, number, before, after), most->lift,
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

/* plain: NULL where the curve is rational; a constant of each caller. */
static inline void make_group(const powers *plain, const rational *other,
                              const cs_boundary_piece *piece, uint32_t first, uint32_t stride,
                              cs_polyline_vertices *restrict out) {
  const cs_boundary_piece own = *piece;
  seat_list seats;
  seats.t[0] = seats.t[CS_POLYLINE_ROOM + 1] = 0;
  for (int k = 0; k <= own.group; k += LANES) {
    const places at = places_of(&own, first, stride, k);
    const lanes t = parameters(&at);
    const spots p = plain ? at_powers(plain, t) : at_rational(other, t);
    sit(&p, &at, k, &seats);
  }
  const limits most = find_limits(&own, first, stride, &seats);
  for (int k = 0; k <= own.group; k += LANES) {
    const lanes t = load(seats.t + 1 + k);
    const spots p = plain ? at_powers(plain, t) : at_rational(other, t);
    place(&own, &most, &p, k, &seats, out);
  }
  finish(&own, first, first + stride * own.group, &seats, out);
}

void CS_WIDE(cs_polyline_powers)(const double c[8], const cs_boundary_piece *piece, uint32_t first,
                                 uint32_t stride, cs_polyline_vertices *restrict out) {
  const powers curve = load_powers(c);
  make_group(&curve, NULL, piece, first, stride, out);
}

void CS_WIDE(cs_polyline_rational)(const cs_hpoint *points, const cs_boundary_piece *piece,
                                   uint32_t first, uint32_t stride,
                                   cs_polyline_vertices *restrict out) {
  const rational curve = {points, piece->degree};
  make_group(NULL, &curve, piece, first, stride, out);
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
