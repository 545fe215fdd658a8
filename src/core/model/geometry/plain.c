#include "model/geometry/plain.h"

static int compare(double a, double b) { return (a > b) - (a < b); }

static int compare_pairs(cs_pair a, cs_pair b) {
  int order = compare(a[0], b[0]);
  return order ? order : compare(a[1], b[1]);
}

bool cs_plain_canonise(cs_plain *piece) {
  int order = 0;
  for (int i = 0, j = piece->degree; i < j && order == 0; i++, j--)
    order = compare_pairs(piece->points[i], piece->points[j]);
  if (order > 0)
    cs_plain_reverse(piece);
  return order > 0;
}

/* De Casteljau's scheme: *front gets the beginning, and *rest the remaining part. */
static inline void split(cs_plain *rest, double t, cs_plain *front, int degree) {
  cs_pair *p = rest->points;
  front->points[0] = p[0];
  for (int level = 1; level <= degree; level++) {
    for (int i = 0; i <= degree - level; i++)
      p[i] = cs_pair_between(p[i], p[i + 1], t);
    front->points[level] = p[0];
  }
  for (int i = degree; i < CS_PLAIN_DEGREE; i++)
    front->points[i + 1] = p[0];
}

void cs_plain_cut_front(cs_plain *rest, double *from, double t, cs_plain *front) {
  double part = (t - *from) / (1 - *from);
  front->degree = rest->degree;
  /* most curves have this degree, and the compiler needs no loops for it */
  if (rest->degree == CS_PLAIN_DEGREE)
    split(rest, part, front, CS_PLAIN_DEGREE);
  else
    split(rest, part, front, rest->degree);
  *from = t;
}

cs_pair cs_plain_at(const cs_plain *piece, double t) {
  cs_plain rest = *piece, front;
  double from = 0;
  cs_plain_cut_front(&rest, &from, t, &front);
  return rest.points[0];
}

int cs_plain_extrema(const cs_plain *piece, cs_bezier_axis axis, double roots[CS_PLAIN_DEGREE]) {
  double coefficients[CS_PLAIN_DEGREE + 1];
  for (int i = 0; i <= piece->degree; i++)
    coefficients[i] = piece->points[i][axis == CS_BEZIER_X ? 0 : 1];
  return cs_bezier_turns(coefficients, piece->degree, roots);
}

void cs_plain_weigh(const cs_plain *piece, cs_bezier *out) {
  out->degree = piece->degree;
  for (int i = 0; i <= piece->degree; i++)
    out->points[i] = (cs_hpoint){piece->points[i][0], piece->points[i][1], 1};
}
