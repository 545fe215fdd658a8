#include "model/geometry/bezier.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "model/geometry/matrix.h"
#include "model/geometry/pair.h"

#define HORIZON 1e-9  /* a share of the outline's largest |w| */
#define ROOT_DEPTH 46 /* halvings: two roots that are nearer than this count as one */
#define CLIP_DEPTH 40
#define NOISE 4e-15 /* relative to the terms of the sum: a coefficient below this is rounding */
#define COEFFICIENTS (CS_BEZIER_POLYNOMIAL + 1)

/* ---------------------------------------------------------------- pieces */

void cs_bezier_load(const cs_outline *outline, size_t piece, const celspan_matrix *matrix,
                    cs_bezier *out) {
  out->degree = outline->degrees[piece];
  for (int i = 0; i <= out->degree; i++)
    out->points[i] = cs_matrix_apply(matrix, outline->points[outline->starts[piece] + (size_t)i]);
}

cs_bezier cs_bezier_line(cs_hpoint from, cs_hpoint to) {
  return (cs_bezier){.degree = 1, .points = {from, to}};
}

void cs_bezier_reverse(cs_bezier *piece) {
  for (int i = 0, j = piece->degree; i < j; i++, j--) {
    cs_hpoint swapped = piece->points[i];
    piece->points[i] = piece->points[j];
    piece->points[j] = swapped;
  }
}

static int compare(double a, double b) { return (a > b) - (a < b); }

static int compare_points(const cs_hpoint *a, const cs_hpoint *b) {
  int order = compare(a->x, b->x);
  order = order ? order : compare(a->y, b->y);
  return order ? order : compare(a->w, b->w);
}

bool cs_bezier_canonise(cs_bezier *piece) {
  int order = 0;
  for (int i = 0, j = piece->degree; i < j && order == 0; i++, j--)
    order = compare_points(&piece->points[i], &piece->points[j]);
  if (order > 0)
    cs_bezier_reverse(piece);
  return order > 0;
}

bool cs_bezier_is_polynomial(const cs_bezier *piece) {
  for (int i = 1; i <= piece->degree; i++)
    if (piece->points[i].w != piece->points[0].w)
      return false;
  return true;
}

void cs_bezier_copy(const cs_bezier *piece, cs_bezier *copy) {
  memcpy(copy, piece,
         offsetof(cs_bezier, points) + ((size_t)piece->degree + 1) * sizeof(cs_hpoint));
}

static cs_hpoint between(cs_hpoint a, cs_hpoint b, double t) {
  cs_pair pair = cs_pair_between(cs_pair_load(&a), cs_pair_load(&b), t);
  return (cs_hpoint){pair[0], pair[1], a.w + t * (b.w - a.w)};
}

void cs_bezier_split(const cs_bezier *piece, double t, cs_bezier *low, cs_bezier *high) {
  int degree = piece->degree;
  if (high != piece)
    cs_bezier_copy(piece, high);
  low->degree = degree;
  low->points[0] = high->points[0];
  for (int level = 1; level <= degree; level++) {
    for (int i = 0; i <= degree - level; i++)
      high->points[i] = between(high->points[i], high->points[i + 1], t);
    low->points[level] = high->points[0];
  }
}

void cs_bezier_cut_front(cs_bezier *rest, double *from, double t, cs_bezier *front) {
  cs_bezier_split(rest, (t - *from) / (1 - *from), front, rest);
  *from = t;
}

/* ---------------------------------------------------------------- Bernstein polynomials' roots */

typedef struct root_list {
  int count, limit;
  double *roots;
} root_list;

static double evaluate(const double *coefficients, int degree, double t) {
  double work[COEFFICIENTS];
  for (int i = 0; i <= degree; i++)
    work[i] = coefficients[i];
  for (int level = degree; level > 0; level--)
    for (int i = 0; i < level; i++)
      work[i] += t * (work[i + 1] - work[i]);
  return work[0];
}

static void halve(const double *coefficients, int degree, double *low, double *high) {
  double work[COEFFICIENTS];
  for (int i = 0; i <= degree; i++)
    work[i] = coefficients[i];
  for (int level = 0; level <= degree; level++) {
    low[level] = work[0];
    high[degree - level] = work[degree - level];
    for (int i = 0; i < degree - level; i++)
      work[i] = 0.5 * (work[i] + work[i + 1]);
  }
}

/* The signs of the coefficients, without coefficients that are noise; 0 if all are noise. */
typedef struct sign_pattern {
  int first, last, changes;
} sign_pattern;

static sign_pattern signs_of(const double *coefficients, int degree, double noise) {
  sign_pattern signs = {0, 0, 0};
  for (int i = 0; i <= degree; i++) {
    int sign = (coefficients[i] > noise) - (coefficients[i] < -noise);
    if (sign == 0)
      continue;
    signs.changes += sign == -signs.last;
    signs.first = signs.first == 0 ? sign : signs.first;
    signs.last = sign;
  }
  return signs;
}

/* The only root, by regula falsi (the Illinois variant), whose bracket is halved at least every
 * third step. sign: the sign of the polynomial at 0. */
static double bracketed_root(const double *coefficients, int degree, int sign) {
  double low = 0, high = 1;
  double at_low = coefficients[0] * sign, at_high = coefficients[degree] * sign;
  for (int step = 0; step < 150 && high - low > 1e-16 * high; step++) {
    double t = 0.5 * (low + high);
    if (step % 3 != 2 && at_low > 0 && at_high < 0)
      t = low + (high - low) * (at_low / (at_low - at_high));
    if (t <= low || t >= high)
      t = 0.5 * (low + high);
    if (t <= low || t >= high)
      break;
    double value = evaluate(coefficients, degree, t) * sign;
    if (value == 0)
      return t;
    if (value > 0) {
      low = t;
      at_low = value;
      at_high *= 0.5;
    } else {
      high = t;
      at_high = value;
      at_low *= 0.5;
    }
  }
  return 0.5 * (low + high);
}

static void add_root(root_list *list, double root) {
  double last = list->count > 0 ? list->roots[list->count - 1] : 0;
  if (root > last && root < 1 && list->count < list->limit)
    list->roots[list->count++] = root;
}

/* Both roots in closed form: extrema of cubics, the most frequent case. */
static void find_quadratic_roots(const double *c, root_list *list) {
  double square = c[0] - 2 * c[1] + c[2], half = c[1] - c[0];
  double discriminant = c[1] * c[1] - c[0] * c[2];
  if (!(discriminant > 0))
    return;
  /* Each root has two formulas; this one has no cancellation. */
  double sum = half < 0 ? -half + sqrt(discriminant) : -half - sqrt(discriminant);
  double one = c[0] / sum, other = sum / square;
  add_root(list, one < other ? one : other);
  add_root(list, one < other ? other : one);
}

/* Isolates roots by halving. By the variation diminishing property there is no root without a
 * change of sign of the coefficients, and exactly one with one change. Recursion ends at
 * ROOT_DEPTH. */
static void isolate_roots(const double *coefficients, int degree, double noise, double from,
                          double to, int depth, root_list *list) {
  sign_pattern signs = signs_of(coefficients, degree, noise);
  if (signs.changes == 0 || list->count == list->limit)
    return;
  if (signs.changes == 1) {
    add_root(list, from + (to - from) * bracketed_root(coefficients, degree, signs.first));
    return;
  }
  double middle = 0.5 * (from + to);
  if (depth == ROOT_DEPTH) {
    if (signs.changes % 2 == 1)
      add_root(list, middle);
    return;
  }
  double low[COEFFICIENTS], high[COEFFICIENTS];
  halve(coefficients, degree, low, high);
  isolate_roots(low, degree, noise, from, middle, depth + 1, list);
  /* A root exactly in the middle is an end of both halves, and both halves leave it out. */
  if (signs_of(low, degree, noise).last * signs_of(high, degree, noise).first < 0)
    add_root(list, middle);
  isolate_roots(high, degree, noise, middle, to, depth + 1, list);
}

static void find_roots(const double *coefficients, int degree, double noise, root_list *list) {
  if (degree != 2)
    isolate_roots(coefficients, degree, noise, 0, 1, 0, list);
  else if (signs_of(coefficients, degree, noise).changes > 0)
    find_quadratic_roots(coefficients, list);
}

int cs_bezier_roots(const double *coefficients, int degree, double size, double *roots) {
  root_list list = {0, degree, roots};
  find_roots(coefficients, degree, NOISE * (degree + 1) * size, &list);
  return list.count;
}

int cs_bezier_crossings(const cs_bezier *piece, cs_bezier_form form,
                        double roots[CS_BEZIER_ROOTS]) {
  double coefficients[COEFFICIENTS], size = 0;
  for (int i = 0; i <= piece->degree; i++) {
    cs_hpoint p = piece->points[i];
    coefficients[i] = form.x * p.x + form.y * p.y + form.w * p.w + form.constant;
    double terms =
        fabs(form.x * p.x) + fabs(form.y * p.y) + fabs(form.w * p.w) + fabs(form.constant);
    size = cs_number_most(terms, size);
  }
  root_list list = {0, CS_BEZIER_ROOTS, roots};
  find_roots(coefficients, piece->degree, NOISE * size, &list);
  return list.count;
}

/* ---------------------------------------------------------------- extrema */

static double component(cs_hpoint point, cs_bezier_axis axis) {
  return axis == CS_BEZIER_X ? point.x : point.y;
}

static double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; i++)
    value = value * (n - k + i) / i;
  return value;
}

/* Bernstein coefficients of Y'W - YW', divided by the degree p; they have degree 2p - 1. */
static double slope_numerator(const cs_bezier *piece, cs_bezier_axis axis, double *coefficients) {
  int p = piece->degree;
  double size = 0, across[2][CS_BEZIER_DEGREE + 1];
  for (int i = 0; i <= p; i++) {
    across[0][i] = i < p ? binomial(p - 1, i) : 0;
    across[1][i] = binomial(p, i);
  }
  for (int k = 0; k < 2 * p; k++) {
    double sum = 0, terms = 0, whole = binomial(2 * p - 1, k);
    for (int i = k > p ? k - p : 0; i < p && i <= k; i++) {
      cs_hpoint a = piece->points[i], b = piece->points[i + 1], c = piece->points[k - i];
      double share = across[0][i] * across[1][k - i] / whole;
      double rise = component(b, axis) - component(a, axis);
      sum += share * (rise * c.w - component(c, axis) * (b.w - a.w));
      terms += share * (fabs(rise * c.w) + fabs(component(c, axis) * (b.w - a.w)));
    }
    coefficients[k] = sum;
    size = cs_number_most(terms, size);
  }
  return size;
}

int cs_bezier_turns(const double *coefficients, int degree, double *roots) {
  double rises[CS_BEZIER_DEGREE], size = 0;
  for (int i = 0; i < degree; i++) {
    double a = coefficients[i], b = coefficients[i + 1];
    rises[i] = b - a;
    size = cs_number_most(fabs(a) + fabs(b), size);
  }
  size *= 0.05; /* a difference is rounded only once */
  root_list list = {0, CS_BEZIER_ROOTS, roots};
  find_roots(rises, degree - 1, NOISE * size, &list);
  return list.count;
}

int cs_bezier_extrema(const cs_bezier *piece, cs_bezier_axis axis, double roots[CS_BEZIER_ROOTS]) {
  double coefficients[COEFFICIENTS];
  if (cs_bezier_is_polynomial(piece)) {
    for (int i = 0; i <= piece->degree; i++)
      coefficients[i] = component(piece->points[i], axis);
    return cs_bezier_turns(coefficients, piece->degree, roots);
  }
  double size = slope_numerator(piece, axis, coefficients);
  root_list list = {0, CS_BEZIER_ROOTS, roots};
  find_roots(coefficients, 2 * piece->degree - 1, NOISE * size, &list);
  return list.count;
}

/* ---------------------------------------------------------------- horizon */

/* The largest |w| of an outline under a matrix; false when a number is not finite. */
static bool find_largest_weight(const cs_outline *outline, const celspan_matrix *matrix,
                                double *largest) {
  *largest = fabs(matrix->m[8]);
  if (outline->is_plain && cs_matrix_is_affine(matrix) && cs_matrix_is_sane(matrix))
    return true; /* this is the weight of every point */
  *largest = 0;
  for (size_t i = 0; i < outline->point_count; i++) {
    cs_hpoint p = cs_matrix_apply(matrix, outline->points[i]);
    double sum = p.x + p.y + p.w;
    if (sum - sum != 0)
      return false;
    *largest = cs_number_most(fabs(p.w), *largest);
  }
  return true;
}

bool cs_bezier_horizon(const cs_outline *outline, const celspan_matrix *matrix, double *least) {
  double largest;
  if (!find_largest_weight(outline, matrix, &largest))
    return false;
  *least = HORIZON * largest;
  return *least > 0;
}

static double least_weight(const cs_bezier *piece) {
  double least = piece->points[0].w;
  for (int i = 1; i <= piece->degree; i++)
    least = cs_number_least(piece->points[i].w, least);
  return least;
}

/* A part in front of the horizon may have control points behind it. It is halved until no part has
 * such points. */
static celspan_status visit_front(const cs_bezier *part, double least, cs_bezier_visit visit,
                                  void *user, int depth) {
  if (least_weight(part) >= 0.5 * least)
    return visit(user, part);
  cs_bezier low, high;
  if (depth == CLIP_DEPTH) {
    low = *part;
    for (int i = 0; i <= low.degree; i++)
      low.points[i].w = fmax(low.points[i].w, 0.5 * least);
    return visit(user, &low);
  }
  cs_bezier_split(part, 0.5, &low, &high);
  CS_TRY(visit_front(&low, least, visit, user, depth + 1));
  return visit_front(&high, least, visit, user, depth + 1);
}

static bool is_front(const cs_bezier *part, double least) {
  cs_bezier low, high;
  cs_bezier_split(part, 0.5, &low, &high);
  return high.points[0].w > least;
}

celspan_status cs_bezier_clip(const cs_bezier *piece, double least, cs_bezier_visit visit,
                              void *user) {
  if (least_weight(piece) >= least)
    return visit(user, piece);
  double roots[CS_BEZIER_ROOTS], from = 0;
  int count = cs_bezier_crossings(piece, (cs_bezier_form){.w = 1, .constant = -least}, roots);
  cs_bezier rest, part;
  cs_bezier_copy(piece, &rest);
  for (int i = 0; i < count; i++) {
    cs_bezier_cut_front(&rest, &from, roots[i], &part);
    if (is_front(&part, least))
      CS_TRY(visit_front(&part, least, visit, user, 0));
  }
  return is_front(&rest, least) ? visit_front(&rest, least, visit, user, 0) : CELSPAN_OK;
}
