/* A point of a curve with its first and second derivatives by the parameter: for one parameter, or
 * for one in each lane of a register.
 *
 * The file that includes this has a type `number` first: double, or a vector of doubles. Both give
 * the same bits.
 */
#include "model/geometry/bezier.h"

typedef struct cs_polyline_point {
  number x, y, slope_x, slope_y, bend_x, bend_y;
} cs_polyline_point;

/* c: the coefficients in powers of t, 4 of x and 4 of y. */
static inline cs_polyline_point cs_polyline_power(const double c[8], number t) {
  return (cs_polyline_point){((c[3] * t + c[2]) * t + c[1]) * t + c[0],
                             ((c[7] * t + c[6]) * t + c[5]) * t + c[4],
                             (3 * c[3] * t + 2 * c[2]) * t + c[1],
                             (3 * c[7] * t + 2 * c[6]) * t + c[5],
                             6 * c[3] * t + 2 * c[2],
                             6 * c[7] * t + 2 * c[6]};
}

typedef struct cs_polyline_weighted {
  number x, y, w;
} cs_polyline_weighted;

/* De Casteljau's scheme down to three points. */
static inline void cs_polyline_last_three(const cs_hpoint *points, int degree, number t,
                                          cs_polyline_weighted *p) {
  const number zero = {0};
  cs_polyline_weighted work[CS_BEZIER_DEGREE + 1];
  for (int i = 0; i <= degree; i++)
    work[i] = (cs_polyline_weighted){zero + points[i].x, zero + points[i].y, zero + points[i].w};
  for (int level = degree; level > 2; level--)
    for (int i = 0; i < level; i++) {
      work[i].x += t * (work[i + 1].x - work[i].x);
      work[i].y += t * (work[i + 1].y - work[i].y);
      work[i].w += t * (work[i + 1].w - work[i].w);
    }
  memcpy(p, work, 3 * sizeof *p);
}

/* The three points give the value and both derivatives; then the quotient rule. */
static inline cs_polyline_point cs_polyline_weigh(const cs_hpoint *points, int degree, number t) {
  cs_polyline_weighted p[3];
  cs_polyline_last_three(points, degree, t, p);
  const double scale = degree * (degree - 1.0);
  number s = 1 - t, b0 = s * s, b1 = 2 * s * t, b2 = t * t;
  number w = b0 * p[0].w + b1 * p[1].w + b2 * p[2].w;
  number w1 = (double)degree * (s * (p[1].w - p[0].w) + t * (p[2].w - p[1].w));
  number w2 = scale * (p[0].w - 2 * p[1].w + p[2].w);
  number x1 = (double)degree * (s * (p[1].x - p[0].x) + t * (p[2].x - p[1].x));
  number y1 = (double)degree * (s * (p[1].y - p[0].y) + t * (p[2].y - p[1].y));
  number by_w = 1 / w;
  number x = (b0 * p[0].x + b1 * p[1].x + b2 * p[2].x) * by_w;
  number y = (b0 * p[0].y + b1 * p[1].y + b2 * p[2].y) * by_w;
  number slope_x = (x1 - w1 * x) * by_w, slope_y = (y1 - w1 * y) * by_w;
  number x2 = scale * (p[0].x - 2 * p[1].x + p[2].x);
  number y2 = scale * (p[0].y - 2 * p[1].y + p[2].y);
  return (cs_polyline_point){x,
                             y,
                             slope_x,
                             slope_y,
                             (x2 - 2 * w1 * slope_x - w2 * x) * by_w,
                             (y2 - 2 * w1 * slope_y - w2 * y) * by_w};
}
