/* Plain pieces: of the third degree at most, with all weights 1, so that their points are pixels.
 * Nothing of them is behind the horizon, and nothing need be projected. Most pieces of most
 * drawings are plain, under any affine matrix.
 *
 *             1 o - - o 2           a cubic: all four points
 *              .       .
 *           0 *    *    * 3         a line: points 0 and 1; points 2 and 3 repeat its end, so that
 *                  |\               what asks for all four points need not ask for the degree
 *               cut at t
 *
 * Invariant: a plain piece has the bits of the same cs_bezier, whatever is done to both.
 */
#pragma once

#include "model/geometry/bezier.h"
#include "model/geometry/matrix.h"
#include "model/geometry/pair.h"

#define CS_PLAIN_DEGREE CS_OUTLINE_PLAIN_DEGREE
#define CS_PLAIN_PARTS CS_PLAIN_DEGREE /* the most parts between extrema */

typedef struct cs_plain {
  cs_pair points[CS_PLAIN_DEGREE + 1]; /* points beyond the degree repeat the last point */
  int degree;
} cs_plain;

/* A matrix that keeps weights of 1 (cs_matrix_keeps_weights), by columns. */
typedef struct cs_plain_map {
  cs_pair x, y, shift;
} cs_plain_map;

/* Whether all pieces of an outline are plain under a matrix. */
static inline bool cs_plain_applies(const cs_outline *outline, const celspan_matrix *matrix) {
  return outline->is_plain && cs_matrix_keeps_weights(matrix);
}

static inline cs_plain_map cs_plain_map_of(const celspan_matrix *matrix) {
  const double *m = matrix->m;
  return (cs_plain_map){{m[0], m[3]}, {m[1], m[4]}, {m[2], m[5]}};
}

static inline cs_pair cs_plain_place(const cs_plain_map *map, const cs_hpoint *point) {
  return map->x * point->x + map->y * point->y + map->shift;
}

/* The piece from a joint on; points: the points after the joint, in units of the outline. */
static inline void cs_plain_load(cs_plain *piece, cs_pair joint, const cs_hpoint *points,
                                 int degree, const cs_plain_map *map) {
  piece->degree = degree;
  piece->points[0] = joint;
  for (int i = 1; i <= CS_PLAIN_DEGREE; i++)
    piece->points[i] = i <= degree ? cs_plain_place(map, &points[i - 1]) : piece->points[i - 1];
}

static inline void cs_plain_swap(cs_pair *a, cs_pair *b) {
  cs_pair swapped = *a;
  *a = *b;
  *b = swapped;
}

static inline void cs_plain_reverse(cs_plain *piece) {
  cs_pair *p = piece->points;
  cs_plain_swap(&p[0], &p[piece->degree]);
  if (piece->degree == CS_PLAIN_DEGREE)
    cs_plain_swap(&p[1], &p[2]);
  for (int i = piece->degree; i < CS_PLAIN_DEGREE; i++)
    p[i + 1] = p[i];
}

/* The rectangle around the points. */
typedef struct cs_plain_hull {
  cs_pair least, most;
} cs_plain_hull;

static inline cs_plain_hull cs_plain_hull_of(const cs_plain *piece) {
  cs_plain_hull hull = {piece->points[0], piece->points[0]};
  for (int i = 1; i <= CS_PLAIN_DEGREE; i++) {
    hull.least = cs_pair_least(hull.least, piece->points[i]);
    hull.most = cs_pair_most(hull.most, piece->points[i]);
  }
  return hull;
}

/* Whether the points only fall or only rise; the piece does the same then. */
static inline bool cs_plain_has_monotone_polygon(const cs_plain *piece) {
  const cs_pair *p = piece->points;
  return (p[0][1] <= p[1][1] && p[1][1] <= p[2][1] && p[2][1] <= p[3][1]) ||
         (p[0][1] >= p[1][1] && p[1][1] >= p[2][1] && p[2][1] >= p[3][1]);
}

/* This and the next functions do the same as functions of bezier.h with similar names. */
bool cs_plain_canonise(cs_plain *piece);
void cs_plain_cut_front(cs_plain *rest, double *from, double t, cs_plain *front);
int cs_plain_extrema(const cs_plain *piece, cs_bezier_axis axis, double roots[CS_PLAIN_DEGREE]);

/* The point at a parameter: the joint that a cut at this parameter makes. */
cs_pair cs_plain_at(const cs_plain *piece, double t);

/* The same piece with its weights. */
void cs_plain_weigh(const cs_plain *piece, cs_bezier *out);
