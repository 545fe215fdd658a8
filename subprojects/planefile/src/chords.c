#include "chords.h"

#include <math.h>

#define SAG (0.012 * PF_HEIGHT)       /* of a chord: twice that of the area it must make up for */
#define ONE_CHORD (0.004 * PF_HEIGHT) /* less is not made up for */
#define LEAD 0.29289321881345254      /* 1 - 1 / sqrt(2) */
#define CHORDS_MOST 268435456.0
#define SAMPLES 12
#define MARGIN 1.25 /* between samples */

/* A point of a curve, and its first and second derivative. */
typedef struct jet {
  double at, first, second;
} jet;

static inline double value_of(const double c[4], double t) {
  return ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
}

static jet jet_of(const double c[4], double t) {
  return (jet){value_of(c, t), (3 * c[3] * t + 2 * c[2]) * t + c[1], 6 * c[3] * t + 2 * c[2]};
}

static jet divide(jet a, jet w) {
  double at = a.at / w.at, first = (a.first - at * w.first) / w.at;
  return (jet){at, first, (a.second - 2 * first * w.first - at * w.second) / w.at};
}

static void find_point(const pf_curve *curve, double t, jet *x, jet *y) {
  *x = jet_of(curve->x, t);
  *y = jet_of(curve->y, t);
  if (curve->is_rational) {
    jet w = jet_of(curve->w, t);
    *x = divide(*x, w);
    *y = divide(*y, w);
  }
}

static void to_powers(const double p[4], int degree, double c[4]) {
  memset(c, 0, 4 * sizeof *c);
  c[0] = p[0];
  c[1] = degree * (p[1] - p[0]);
  if (degree == 2)
    c[2] = p[0] - 2 * p[1] + p[2];
  if (degree == 3) {
    c[2] = 3 * (p[0] - 2 * p[1] + p[2]);
    c[3] = p[3] - p[0] + 3 * (p[1] - p[2]);
  }
}

/* The largest second derivative, about. That of a polynomial is the largest at one of its ends. */
static double find_bend(const pf_curve *curve) {
  double largest = 0;
  int samples = curve->is_rational ? SAMPLES : 1;
  for (int i = 0; i <= samples; i++) {
    jet x, y;
    find_point(curve, (double)i / samples, &x, &y);
    largest = fmax(largest, x.second * x.second + y.second * y.second);
  }
  return (curve->is_rational ? MARGIN : 1) * sqrt(largest);
}

/* Displaces a polynomial outwards, from its chords. */
static void displace(double c[4], double share) {
  c[0] -= 2 * share * c[2];
  c[1] -= 6 * share * c[3];
}

static void choose_chords(pf_curve *curve) {
  double sag = find_bend(curve) / 8;
  if (!(sag > ONE_CHORD))
    return;
  curve->chords = (uint32_t)fmin(ceil(sqrt(sag / SAG) + 2 * LEAD), CHORDS_MOST);
  curve->chords = curve->chords > 2 ? curve->chords : 2;
  curve->step = 1 / (curve->chords - 2 * LEAD);
  if (!curve->is_rational) {
    displace(curve->x, curve->step * curve->step / 12);
    displace(curve->y, curve->step * curve->step / 12);
  }
}

void pf_curve_make(const planefile_point *points, const planefile_piece *piece, pf_scale scale,
                   pf_curve *out) {
  const planefile_point *last = &points[piece->degree];
  int32_t low = points[0].x, high = low;
  for (int i = 1; i <= piece->degree; i++) {
    low = points[i].x < low ? points[i].x : low;
    high = points[i].x > high ? points[i].x : high;
  }
  out->low = low * scale.x;
  out->high = high * scale.x;
  out->x0 = points[0].x * scale.x;
  out->x1 = last->x * scale.x;
  out->y0 = pf_round(points[0].y * scale.y);
  out->y1 = pf_round(last->y * scale.y);
  out->chords = 1;
}

void pf_curve_bend(const planefile_point *points, const planefile_piece *piece, pf_scale scale,
                   pf_curve *curve) {
  double x[4], y[4], w[4] = {1, 1, 1, 1};
  int degree = piece->degree;
  curve->is_rational = piece->is_rational;
  for (int i = 0; i <= degree; i++) {
    w[i] = piece->is_rational ? (double)points[i].w / PLANEFILE_WEIGHT : 1;
    x[i] = points[i].x * scale.x * w[i];
    y[i] = points[i].y * scale.y * w[i];
  }
  to_powers(x, degree, curve->x);
  to_powers(y, degree, curve->y);
  to_powers(w, degree, curve->w);
  choose_chords(curve);
}

/* A point of a rational curve, displaced outwards. */
static void find_displaced(const pf_curve *curve, double t, double *x, double *y) {
  jet across, down;
  double share = curve->step * curve->step / 12;
  find_point(curve, t, &across, &down);
  *x = across.at - share * across.second;
  *y = down.at - share * down.second;
}

pf_vertex pf_curve_vertex(const pf_curve *curve, uint32_t vertex) {
  if (vertex == 0)
    return (pf_vertex){curve->x0, curve->y0};
  if (vertex >= curve->chords)
    return (pf_vertex){curve->x1, curve->y1};
  double t = (vertex - LEAD) * curve->step, x = value_of(curve->x, t), y = value_of(curve->y, t);
  if (curve->is_rational)
    find_displaced(curve, t, &x, &y);
  int64_t height = pf_round(y);
  height = height > curve->y0 ? height : curve->y0;
  return (pf_vertex){x, height < curve->y1 ? height : curve->y1};
}

uint32_t pf_curve_find(const pf_curve *curve, int64_t y) {
  uint32_t low = 0, high = curve->chords;
  while (high - low > 1) {
    uint32_t middle = low + (high - low) / 2;
    if (pf_curve_vertex(curve, middle).y > y)
      high = middle;
    else
      low = middle;
  }
  return low;
}
