/* Gradients by definition, for tests: the position of a point along the stops, and the weight of
 * each corner at it. No code is shared with engine/paint/shade.c. */
#pragma once

#include <math.h>

#include "celspan/celspan.h"

#define STOPS 4

typedef enum shape { LINEAR, RADIAL, FOCAL, TRIANGLE, SHAPES } shape;

typedef struct gradient {
  shape shape;
  celspan_point points[3];   /* from and to; centre, a point at the radius and focus; the corners */
  celspan_stop stops[STOPS]; /* ascending */
  celspan_paint paints[3];   /* of the corners */
} gradient;

static inline celspan_point away(celspan_point a, celspan_point b) {
  return (celspan_point){b.x - a.x, b.y - a.y};
}

static inline double dot(celspan_point a, celspan_point b) { return a.x * b.x + a.y * b.y; }

static inline double cross(celspan_point a, celspan_point b) { return a.x * b.y - a.y * b.x; }

static inline double gradient_radius(const gradient *g) {
  celspan_point leg = away(g->points[0], g->points[1]);
  return sqrt(dot(leg, leg));
}

/* The position of a point between the first and the last stop, 0..1, or outside of it. For circles,
 * the position of the circle, between the focus and the whole circle, that passes through the
 * point: p with |p - focus - t d| = t radius, d the vector from the focus to the centre. */
static inline double gradient_place(const gradient *g, celspan_point at) {
  celspan_point way = away(g->points[0], g->points[1]), from = g->points[g->shape == FOCAL ? 2 : 0];
  celspan_point d = away(from, g->points[0]), q = away(from, at);
  if (g->shape == LINEAR)
    return dot(q, way) / dot(way, way);
  double a = dot(way, way) - dot(d, d), b = dot(q, d);
  return (sqrt(b * b + a * dot(q, q)) - b) / a;
}

/* The weights of a triangle's corners at a point; their sum is 1, and outside of the triangle one
 * of them is negative. */
static inline void gradient_weights(const gradient *g, celspan_point at, double weights[3]) {
  const celspan_point *p = g->points;
  double whole = cross(away(p[0], p[1]), away(p[0], p[2]));
  for (int i = 0; i < 3; i++)
    weights[i] = cross(away(at, p[(i + 1) % 3]), away(at, p[(i + 2) % 3])) / whole;
}
