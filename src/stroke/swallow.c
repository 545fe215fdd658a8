#include "stroke/swallow.h"

#include <math.h>

/* A Bernstein polynomial. */
typedef struct polynomial {
  int degree;
  double c[CS_SWALLOW_CHANGES + 1];
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

/* The same polynomial as one of a higher degree. */
static void raise(polynomial *p, int degree) {
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

/* Points are taken from the first, in which they are rounded less. */
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

int cs_swallow_changes(const cs_curve *curve, double changes[CS_SWALLOW_CHANGES]) {
  polynomial x, y, w, r, growth, along, across;
  if (curve->radius_degree == 0)
    return 0;
  load(curve, &x, &y, &w, &r);
  square_of_growth(&r, &w, &growth);
  square_of_way(&x, &w, &along);
  square_of_way(&y, &w, &across);
  int degree = growth.degree > along.degree ? growth.degree : along.degree;
  raise(&growth, degree);
  raise(&along, degree);
  raise(&across, degree);
  double size = 0;
  for (int i = 0; i <= degree; i++) {
    size = fmax(size, fmax(fabs(growth.c[i]), fmax(fabs(along.c[i]), fabs(across.c[i]))));
    growth.c[i] -= along.c[i] + across.c[i];
  }
  return cs_bezier_roots(growth.c, degree, size, changes);
}

bool cs_swallow_at(const cs_curve *curve, double t) {
  cs_curve_place place = cs_curve_at(curve, t);
  double x = place.velocity.x, y = place.velocity.y;
  return fabs(place.growth) > 0 && place.growth * place.growth >= x * x + y * y;
}
