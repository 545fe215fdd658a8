#include "model/warp/bend.h"

#include <math.h>

#include "model/geometry/bezier.h"
#include "model/geometry/matrix.h"

/* The most halvings of a piece. If the error is still too large after these, the map has a jump. */
#define DEPTH 40
#define PARTS 16 /* the most into which a stretch is divided at once */
/* A cubic is only examined if it is no longer than this share of the object, or after FORCED
 * halvings: in a longer cubic the map may turn twice. */
#define LONG 0.125
#define FORCED 3
/* The share of the tolerance that is used, because only three places are compared. */
#define SAFE 0.85

typedef struct bender {
  const cs_warp_map *map;
  cs_outline *out;
  cs_bezier piece;    /* placed; all weights above 0 */
  bool is_polynomial; /* all weights are 1 */
  size_t cubics;
  int forced; /* halvings of this piece that are always made */
} bender;

/* A stretch of the piece, and the places to which the map moves its ends. */
typedef struct stretch {
  double from, to; /* parameters */
  celspan_point a, b;
} stretch;

/* The point of a piece at a parameter, by de Casteljau; equal numbers stay equal. */
static celspan_point polynomial_at(const cs_bezier *piece, double t) {
  double x[CS_BEZIER_DEGREE + 1], y[CS_BEZIER_DEGREE + 1];
  for (int i = 0; i <= piece->degree; i++) {
    x[i] = piece->points[i].x;
    y[i] = piece->points[i].y;
  }
  for (int level = piece->degree; level > 0; level--)
    for (int i = 0; i < level; i++) {
      x[i] += t * (x[i + 1] - x[i]);
      y[i] += t * (y[i + 1] - y[i]);
    }
  return (celspan_point){x[0], y[0]};
}

static celspan_point rational_at(const cs_bezier *piece, double t) {
  cs_hpoint p[CS_BEZIER_DEGREE + 1];
  for (int i = 0; i <= piece->degree; i++)
    p[i] = piece->points[i];
  for (int level = piece->degree; level > 0; level--)
    for (int i = 0; i < level; i++)
      p[i] = (cs_hpoint){p[i].x + t * (p[i + 1].x - p[i].x), p[i].y + t * (p[i + 1].y - p[i].y),
                         p[i].w + t * (p[i + 1].w - p[i].w)};
  return cs_hpoint_place(p[0]);
}

static celspan_point point_at(const bender *b, double t) {
  if (t == 1) /* the beginning of the next piece, to the bit */
    return cs_hpoint_place(b->piece.points[b->piece.degree]);
  return b->is_polynomial ? polynomial_at(&b->piece, t) : rational_at(&b->piece, t);
}

static celspan_status image(const bender *b, double t, celspan_point *out) {
  return cs_warp_at(b->map, point_at(b, t), out);
}

static double distance(celspan_point p, celspan_point q) {
  return cs_number_length(p.x - q.x, p.y - q.y);
}

static celspan_point mixed(celspan_point p, celspan_point q, double u) {
  return (celspan_point){p.x + u * (q.x - p.x), p.y + u * (q.y - p.y)};
}

/* ---------------------------------------------------------------- cubics */

/* The cubic that goes through four points at the parameters 0, 1/3, 2/3 and 1. */
static void fit(const stretch *s, celspan_point q1, celspan_point q2, celspan_point cubic[4]) {
  cubic[0] = s->a;
  cubic[1] = (celspan_point){(-5 * s->a.x + 18 * q1.x - 9 * q2.x + 2 * s->b.x) / 6,
                             (-5 * s->a.y + 18 * q1.y - 9 * q2.y + 2 * s->b.y) / 6};
  cubic[2] = (celspan_point){(2 * s->a.x - 9 * q1.x + 18 * q2.x - 5 * s->b.x) / 6,
                             (2 * s->a.y - 9 * q1.y + 18 * q2.y - 5 * s->b.y) / 6};
  cubic[3] = s->b;
}

static celspan_point cubic_at(const celspan_point cubic[4], double t) {
  celspan_point p[4] = {cubic[0], cubic[1], cubic[2], cubic[3]};
  for (int level = 3; level > 0; level--)
    for (int i = 0; i < level; i++)
      p[i] = mixed(p[i], p[i + 1], t);
  return p[0];
}

static bool is_line(const stretch *s, celspan_point q1, celspan_point q2, double within) {
  return distance(q1, mixed(s->a, s->b, 1 / 3.0)) <= within &&
         distance(q2, mixed(s->a, s->b, 2 / 3.0)) <= within;
}

/* How far the map is from the cubic, at most, at places near where a smooth one is farthest. */
static celspan_status measure(const bender *b, const stretch *s, const celspan_point cubic[4],
                              double *error) {
  /* uneven steps, because waves could be missed between even ones */
  static const double places[] = {0.5, 0.1283, 0.8761};
  *error = 0;
  for (int i = 0; i < 3; i++) {
    celspan_point there;
    CS_TRY(image(b, s->from + places[i] * (s->to - s->from), &there));
    *error = fmax(*error, distance(there, cubic_at(cubic, places[i])));
  }
  return CELSPAN_OK;
}

/* Into how many parts a stretch is divided whose error is this many times too large: the error
 * falls with the fourth power of the length. *halvings: as many as this counts for. */
static int parts_for(double error, int *halvings) {
  double parts = ceil(sqrt(sqrt(error)));
  int count = parts < PARTS ? (int)fmax(parts, 2) : PARTS;
  *halvings = 1 + (count > 2) + (count > 4) + (count > 8);
  return count;
}

static celspan_status append(bender *b, const celspan_point cubic[4], bool is_line) {
  cs_hpoint points[3];
  if (++b->cubics > CS_WARP_CUBICS)
    return cs_fail(b->map->context, CELSPAN_LIMIT,
                   "warp: the map is too rough: an outline would become more than %d curves; make "
                   "the map smoother, or give a greater tolerance (within)",
                   CS_WARP_CUBICS);
  for (int i = 0; i < 3; i++)
    points[i] = (cs_hpoint){cubic[i + 1].x, cubic[i + 1].y, 1};
  return is_line ? cs_outline_line(b->map->context, b->out, points[2])
                 : cs_outline_piece(b->map->context, b->out, 3, points);
}

/* Called for a piece whose error is still too large after all halvings: it contains a kink of the
 * map, or a jump. */
static celspan_status end_halving(bender *b, const stretch *s) {
  const celspan_point straight[4] = {s->a, s->a, s->b, s->b};
  if (distance(s->a, s->b) <= b->map->within)
    return append(b, straight, true);
  celspan_point at = point_at(b, s->from);
  return cs_fail(b->map->context, CELSPAN_BAD_ARGUMENT,
                 "warp: the map jumps at the point %g, %g, from %g, %g to %g, %g; it must be "
                 "continuous on the object",
                 at.x, at.y, s->a.x, s->a.y, s->b.x, s->b.y);
}

static celspan_status bend(bender *b, stretch s, int depth) {
  int parts = 2, halvings = 1;
  if (depth >= b->forced) {
    double within = SAFE * b->map->within, error;
    celspan_point q1, q2, cubic[4];
    CS_TRY(image(b, s.from + (s.to - s.from) / 3, &q1));
    CS_TRY(image(b, s.from + 2 * (s.to - s.from) / 3, &q2));
    fit(&s, q1, q2, cubic);
    CS_TRY(measure(b, &s, cubic, &error));
    if (error <= within)
      return append(b, cubic, is_line(&s, q1, q2, (b->map->within - within) / 2));
    if (depth >= DEPTH)
      return end_halving(b, &s);
    parts = parts_for(error / within, &halvings);
  }
  stretch part = {s.from, s.from, s.a, s.a};
  for (int i = 1; i <= parts; i++) {
    part.from = part.to;
    part.a = part.b;
    part.to = i < parts ? s.from + i * (s.to - s.from) / parts : s.to;
    part.b = s.b;
    if (i < parts)
      CS_TRY(image(b, part.to, &part.b));
    CS_TRY(bend(b, part, depth + halvings));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- outlines */

static celspan_status load(bender *b, const cs_outline *outline, size_t i,
                           const celspan_matrix *matrix) {
  cs_bezier_load(outline, i, matrix, &b->piece);
  double length = 0;
  b->is_polynomial = true;
  for (int k = 0; k <= b->piece.degree; k++) {
    b->is_polynomial = b->is_polynomial && b->piece.points[k].w == 1;
    if (!(b->piece.points[k].w > 0))
      return cs_warp_fail_at_horizon(b->map);
    if (k > 0)
      length +=
          distance(cs_hpoint_place(b->piece.points[k - 1]), cs_hpoint_place(b->piece.points[k]));
  }
  b->forced = 0;
  for (; b->forced < FORCED && length > LONG * b->map->extent; length /= 2)
    b->forced++;
  return CELSPAN_OK;
}

static celspan_status bend_contour(bender *b, const cs_outline *outline, size_t begin, size_t end,
                                   const celspan_matrix *matrix) {
  stretch s = {.to = 1};
  for (size_t i = begin; i < end; i++) {
    CS_TRY(load(b, outline, i, matrix));
    if (i == begin) {
      CS_TRY(image(b, 0, &s.a));
      CS_TRY(cs_outline_move(b->map->context, b->out, (cs_hpoint){s.a.x, s.a.y, 1}));
    }
    CS_TRY(image(b, 1, &s.b));
    CS_TRY(bend(b, s, 0));
    s.a = s.b;
  }
  return cs_outline_close(b->map->context, b->out);
}

celspan_status cs_warp_bend(const cs_warp_map *map, const cs_outline *outline,
                            const celspan_matrix *matrix, cs_outline *out) {
  const celspan_matrix facing = cs_matrix_facing(matrix);
  bender b = {.map = map, .out = out};
  for (size_t i = 0; i < outline->contour_count; i++) {
    size_t end = i + 1 < outline->contour_count ? outline->contours[i + 1] : outline->piece_count;
    CS_TRY(bend_contour(&b, outline, outline->contours[i], end, &facing));
  }
  return CELSPAN_OK;
}
