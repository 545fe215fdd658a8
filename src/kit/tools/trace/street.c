#include "tools/trace/street.h"

#include <math.h>

#include "common/solve.h"

/* A narrower street does not count; neither does a smaller weight. */
#define NARROWEST 1e-3
#define WEIGHTLESS 1e-12
/* The search ends when its possible gain is smaller than this share. */
#define GAIN 1e-6
enum { STEPS = 100, AXES = 3, CORNERS = AXES + 1 };

/* x, y, and x^2 + y^2 or, for lines, 0. */
typedef struct place {
  double at[AXES];
} place;

typedef struct search {
  celspan_point origin;
  bool is_line;
  place lefts[CS_GATES_MOST], rights[CS_GATES_MOST];
  size_t gates;
  /* Differences of a left and a right place; and the weights of the nearest point to 0 in their
   * convex hull. */
  place corners[CORNERS];
  double weights[CORNERS];
  int count;
  place nearest;
  /* in the direction of the nearest point: the least value of the left places, and the greatest of
   * the right ones */
  double left, right;
} search;

static double dot(const place *a, const place *b) {
  return a->at[0] * b->at[0] + a->at[1] * b->at[1] + a->at[2] * b->at[2];
}

static place difference(const place *a, const place *b) {
  return (place){{a->at[0] - b->at[0], a->at[1] - b->at[1], a->at[2] - b->at[2]}};
}

static place lift(const search *s, celspan_point point) {
  double x = point.x - s->origin.x, y = point.y - s->origin.y;
  return (place){{x, y, s->is_line ? 0 : x * x + y * y}};
}

/* The difference that is least in the direction of the nearest point. */
static place closest(search *s) {
  size_t left = 0, right = 0;
  s->left = HUGE_VAL;
  s->right = -HUGE_VAL;
  for (size_t i = 0; i < s->gates; i++) {
    double a = dot(&s->nearest, &s->lefts[i]), b = dot(&s->nearest, &s->rights[i]);
    left = a < s->left ? i : left;
    s->left = a < s->left ? a : s->left;
    right = b > s->right ? i : right;
    s->right = b > s->right ? b : s->right;
  }
  return difference(&s->lefts[left], &s->rights[right]);
}

/* ---------------------------------------------------------------- Wolfe's steps */

/* The weights, which add up to 1, of the point nearest to 0 in the plane through all corners: it is
 * the last corner plus, for each other corner, the vector to this corner times its weight. */
static bool weigh(const search *s, double weights[CORNERS]) {
  double m[(CORNERS - 1) * CORNERS];
  int n = s->count - 1, width = n + 1;
  const place *last = &s->corners[n];
  place ways[CORNERS];
  for (int i = 0; i < n; i++)
    ways[i] = difference(&s->corners[i], last);
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < n; j++)
      m[i * width + j] = dot(&ways[i], &ways[j]);
    m[i * width + n] = -dot(&ways[i], last);
  }
  if (!cs_solve(m, n, width, WEIGHTLESS, weights))
    return false;
  weights[n] = 1;
  for (int i = 0; i < n; i++) {
    weights[n] -= weights[i];
  }
  return true;
}

/* How far the weights can be moved towards other weights until one becomes 0; also which one, or
 * -1. */
static double way_to(const search *s, const double weights[CORNERS], int *first) {
  double way = 1;
  *first = -1;
  for (int i = 0; i < s->count; i++) {
    double own = weights[i] > WEIGHTLESS ? 1 : s->weights[i] / (s->weights[i] - weights[i]);
    if (weights[i] <= WEIGHTLESS && own <= way) {
      way = own;
      *first = i;
    }
  }
  return way;
}

static void remove_corner(search *s, int at) {
  s->count--;
  for (int i = at; i < s->count; i++) {
    s->corners[i] = s->corners[i + 1];
    s->weights[i] = s->weights[i + 1];
  }
}

/* Moves the nearest point to the nearest one in the hull of the corners, and removes corners that
 * are not needed. */
static bool settle(search *s) {
  for (int first = 0; first >= 0;) {
    double weights[CORNERS];
    if (!weigh(s, weights))
      return false;
    double way = way_to(s, weights, &first);
    for (int i = 0; i < s->count; i++)
      s->weights[i] += way * (weights[i] - s->weights[i]);
    if (first >= 0)
      remove_corner(s, first);
  }
  s->nearest = (place){{0}};
  for (int i = 0; i < s->count; i++)
    for (int k = 0; k < AXES; k++)
      s->nearest.at[k] += s->weights[i] * s->corners[i].at[k];
  return true;
}

/* Searches until it is known that the hulls are apart, or until their distance is known. */
static bool run(search *s, bool is_enough) {
  s->nearest = (place){{1, 0, 0}};
  s->corners[0] = s->nearest = closest(s);
  s->weights[0] = 1;
  s->count = 1;
  for (int step = 0; step < STEPS; step++) {
    double square = dot(&s->nearest, &s->nearest);
    if (square < NARROWEST * NARROWEST)
      return false;
    place next = closest(s);
    double gap = s->left - s->right;
    if ((is_enough && gap > 0) || gap >= square * (1 - GAIN) || s->count == CORNERS)
      return gap > 0;
    s->corners[s->count] = next;
    s->weights[s->count++] = 0;
    if (!settle(s))
      return gap > 0;
  }
  return s->left > s->right;
}

/* ---------------------------------------------------------------- the street */

static void begin(search *s, const cs_gate_row *row, bool is_line) {
  s->origin = row->list[row->count / 2].left;
  s->is_line = is_line;
  s->gates = row->count;
  for (size_t i = 0; i < row->count; i++) {
    s->lefts[i] = lift(s, row->list[i].left);
    s->rights[i] = lift(s, row->list[i].right);
  }
}

/* Finds a plane between the hulls, in the form that is 0 on the arc and grows like the distance
 * from it. */
static bool find(const cs_gate_row *row, bool is_line, bool is_enough, cs_street *out) {
  search s;
  begin(&s, row, is_line);
  if (!run(&s, is_enough))
    return false;
  const double *across = s.nearest.at;
  double offset = -0.5 * (s.left + s.right);
  double square = across[0] * across[0] + across[1] * across[1] - 4 * across[2] * offset;
  if (!(square > 0))
    return false;
  double scale = 1 / sqrt(square);
  out->width = scale * (s.left - s.right);
  out->middle = (cs_arc){.origin = s.origin,
                         .across = {scale * across[0], scale * across[1]},
                         .bend = scale * across[2],
                         .offset = scale * offset};
  return true;
}

bool cs_street_find_any(const cs_gate_row *row, bool is_line, cs_street *out) {
  return find(row, is_line, true, out);
}

bool cs_street_find(const cs_gate_row *row, bool is_line, cs_street *out) {
  return find(row, is_line, false, out);
}

bool cs_street_passes(const cs_street *street, const cs_gate *gate) {
  celspan_point across;
  return cs_arc_off(&street->middle, gate->left, &across) > 0 &&
         cs_arc_off(&street->middle, gate->right, &across) < 0;
}
