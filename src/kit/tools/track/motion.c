#include "tools/track/motion.h"

#include <math.h>
#include <stdlib.h>

#include "common/solve.h"
#include "inside/elementary.h"
#include "inside/number.h"

enum { MOST_UNKNOWNS = 8, SAMPLES = 300, REFINEMENTS = 12 };

#define TUKEY 4.685          /* the distance at which a pair's weight becomes 0, in deviations */
#define LEAST_DEVIATION 0.02 /* pixels: the least error of the place of a patch */
#define LEAST_PIVOT 1e-10    /* for equations whose numbers are near 1 */

/* ---------------------------------------------------------------- linear equations */

/* The sums of a least-squares fit: the matrix is symmetric, and its last column is the right
 * side. */
typedef struct equations {
  int count;
  double rows[MOST_UNKNOWNS][MOST_UNKNOWNS + 1];
} equations;

/* Adds weight x (sum of factor x unknown = value). */
static void add_equation(equations *e, const double *factors, double value, double weight) {
  for (int i = 0; i < e->count; i++) {
    for (int k = 0; k < e->count; k++)
      e->rows[i][k] += weight * factors[i] * factors[k];
    e->rows[i][e->count] += weight * factors[i] * value;
  }
}

/* ---------------------------------------------------------------- one fit */

static const int unknowns[] = {[CELSPAN_MOTION_TRANSLATION] = 2,
                               [CELSPAN_MOTION_SIMILARITY] = 4,
                               [CELSPAN_MOTION_PERSPECTIVE] = 8};

size_t cs_motion_least(celspan_motion model) {
  return (size_t)unknowns[model] / 2 + (model == CELSPAN_MOTION_PERSPECTIVE ? 4 : 2);
}

bool cs_motion_apply(const celspan_matrix *matrix, celspan_point point, celspan_point *out) {
  const double *m = matrix->m;
  double w = m[6] * point.x + m[7] * point.y + m[8];
  if (!(w > 1e-9))
    return false;
  *out = (celspan_point){(m[0] * point.x + m[1] * point.y + m[2]) / w,
                         (m[3] * point.x + m[4] * point.y + m[5]) / w};
  return true;
}

/* The factors of the unknowns in the two equations of a pair. For a perspective, they are divided
 * by the denominator of the previous fit, so that the distance in pixels is minimised. */
static void add_pair(equations *e, celspan_motion model, const cs_motion_pair *pair, double weight,
                     double denominator) {
  double x = pair->from.x, y = pair->from.y, u = pair->to.x, v = pair->to.y;
  if (model == CELSPAN_MOTION_TRANSLATION) {
    add_equation(e, (double[]){1, 0}, u - x, weight);
    add_equation(e, (double[]){0, 1}, v - y, weight);
  } else if (model == CELSPAN_MOTION_SIMILARITY) {
    add_equation(e, (double[]){x, -y, 1, 0}, u, weight);
    add_equation(e, (double[]){y, x, 0, 1}, v, weight);
  } else {
    weight /= denominator * denominator;
    add_equation(e, (double[]){x, y, 1, 0, 0, 0, -u * x, -u * y}, u, weight);
    add_equation(e, (double[]){0, 0, 0, x, y, 1, -v * x, -v * y}, v, weight);
  }
}

static celspan_matrix matrix_of(celspan_motion model, const double *s) {
  if (model == CELSPAN_MOTION_TRANSLATION)
    return (celspan_matrix){{1, 0, s[0], 0, 1, s[1], 0, 0, 1}};
  if (model == CELSPAN_MOTION_SIMILARITY)
    return (celspan_matrix){{s[0], -s[1], s[2], s[1], s[0], s[3], 0, 0, 1}};
  return (celspan_matrix){{s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], 1}};
}

/* before: the previous fit; NULL: none. weights NULL: all 1. */
static bool fit(celspan_motion model, const cs_motion_pair *pairs, const double *weights,
                size_t count, const celspan_matrix *before, celspan_matrix *out) {
  equations e = {.count = unknowns[model]};
  double solution[MOST_UNKNOWNS];
  for (size_t i = 0; i < count; i++) {
    const double *m = before ? before->m : (double[]){0, 0, 0, 0, 0, 0, 0, 0, 1};
    double denominator = m[6] * pairs[i].from.x + m[7] * pairs[i].from.y + m[8];
    double weight = weights ? weights[i] : 1;
    if (weight > 0 && denominator > 1e-9)
      add_pair(&e, model, &pairs[i], weight, denominator);
  }
  if (!cs_solve(e.rows[0], e.count, MOST_UNKNOWNS + 1, LEAST_PIVOT, solution))
    return false;
  *out = matrix_of(model, solution);
  return true;
}

static double distance(const celspan_matrix *matrix, const cs_motion_pair *pair) {
  celspan_point there;
  if (!cs_motion_apply(matrix, pair->from, &there))
    return INFINITY;
  return cs_number_length(there.x - pair->to.x, there.y - pair->to.y);
}

/* ---------------------------------------------------------------- who agrees */

/* Draws the least number of different pairs that determines a motion. */
static void draw(const cs_motion_pair *pairs, size_t count, int wanted, uint64_t *state,
                 cs_motion_pair *out) {
  size_t taken[MOST_UNKNOWNS / 2];
  for (int i = 0; i < wanted;) {
    taken[i] = cs_splitmix_next(state) % count;
    bool is_new = true;
    for (int k = 0; k < i; k++)
      is_new = is_new && taken[k] != taken[i];
    if (is_new)
      out[i] = pairs[taken[i]], i++;
  }
}

static size_t count_agreeing(const celspan_matrix *matrix, const cs_motion_pair *pairs,
                             size_t count, double tolerance) {
  size_t agreeing = 0;
  for (size_t i = 0; i < count; i++)
    agreeing += distance(matrix, &pairs[i]) <= tolerance;
  return agreeing;
}

/* The motion of a few pairs with which most other pairs agree (Fischler and Bolles 1981). */
static size_t search(celspan_motion model, const cs_motion_pair *pairs, size_t count,
                     double tolerance, celspan_matrix *out) {
  const int wanted = unknowns[model] / 2;
  uint64_t state = 0;
  size_t most = 0;
  for (int i = 0; i < SAMPLES && most < count; i++) {
    cs_motion_pair few[MOST_UNKNOWNS / 2];
    celspan_matrix matrix;
    draw(pairs, count, wanted, &state, few);
    if (!fit(model, few, NULL, (size_t)wanted, NULL, &matrix))
      continue;
    size_t agreeing = count_agreeing(&matrix, pairs, count, tolerance);
    if (agreeing > most) {
      most = agreeing;
      *out = matrix;
    }
  }
  return most;
}

/* ---------------------------------------------------------------- the best fit of those */

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The deviation of a normal distribution in two dimensions whose median distance is that of the
 * agreeing pairs. */
static double typical_distance(const celspan_matrix *matrix, const cs_motion_pair *pairs,
                               size_t count, double tolerance, double least, double *room) {
  size_t n = 0;
  for (size_t i = 0; i < count; i++) {
    double d = distance(matrix, &pairs[i]);
    if (d <= tolerance)
      room[n++] = d;
  }
  if (n == 0)
    return least;
  qsort(room, n, sizeof *room, compare);
  double deviation = room[n / 2] / 1.1774;
  return deviation > least ? deviation : least;
}

/* Weights that fall with the distance, from 1 to 0 at TUKEY deviations. */
static void weigh(const celspan_matrix *matrix, const cs_motion_pair *pairs, size_t count,
                  double deviation, double tolerance, double *weights) {
  for (size_t i = 0; i < count; i++) {
    double d = distance(matrix, &pairs[i]), share = d / (TUKEY * deviation);
    weights[i] = d <= tolerance && share < 1 ? (1 - share * share) * (1 - share * share) : 0;
  }
}

/* Moves and scales places so that their numbers are near 1, which keeps equations well behaved. */
typedef struct frame {
  double x, y, scale;
} frame;

static frame frame_of(const cs_motion_pair *pairs, size_t count) {
  frame f = {0, 0, 0};
  for (size_t i = 0; i < count; i++) {
    f.x += pairs[i].from.x / (double)count;
    f.y += pairs[i].from.y / (double)count;
  }
  for (size_t i = 0; i < count; i++)
    f.scale += cs_number_length(pairs[i].from.x - f.x, pairs[i].from.y - f.y) / (double)count;
  f.scale = f.scale > 1e-6 ? f.scale : 1;
  return f;
}

static celspan_point framed(frame f, celspan_point p) {
  return (celspan_point){(p.x - f.x) / f.scale, (p.y - f.y) / f.scale};
}

static celspan_matrix unframed(frame f, celspan_matrix matrix) {
  celspan_matrix in = {{1 / f.scale, 0, -f.x / f.scale, 0, 1 / f.scale, -f.y / f.scale, 0, 0, 1}};
  celspan_matrix out = {{f.scale, 0, f.x, 0, f.scale, f.y, 0, 0, 1}};
  celspan_matrix whole = celspan_matrix_then(celspan_matrix_then(in, matrix), out);
  for (int i = 0; i < 9 && whole.m[8] > 0; i++)
    whole.m[i] /= i < 8 ? whole.m[8] : 1;
  whole.m[8] = 1;
  return whole;
}

static void refine(celspan_motion model, const cs_motion_pair *pairs, size_t count,
                   double tolerance, double least, celspan_matrix *matrix, double *weights) {
  for (int i = 0; i < REFINEMENTS; i++) {
    double deviation = typical_distance(matrix, pairs, count, tolerance, least, weights);
    weigh(matrix, pairs, count, deviation, tolerance, weights);
    celspan_matrix better;
    if (!fit(model, pairs, weights, count, matrix, &better))
      return;
    *matrix = better;
  }
}

static void judge(cs_motion_pair *pairs, size_t count, double tolerance, cs_motion_verdict *out) {
  double squares = 0;
  out->agreeing = 0;
  for (size_t i = 0; i < count; i++) {
    double d = distance(&out->matrix, &pairs[i]);
    pairs[i].agrees = d <= tolerance;
    squares += pairs[i].agrees ? d * d : 0;
    out->agreeing += pairs[i].agrees;
  }
  out->error = out->agreeing ? sqrt(squares / (double)out->agreeing) : INFINITY;
}

bool cs_motion_agree(celspan_motion model, cs_motion_pair *pairs, size_t count, double tolerance,
                     cs_motion_verdict *out) {
  cs_motion_pair near_one[CS_MOTION_MOST];
  double weights[CS_MOTION_MOST];
  celspan_matrix matrix;
  *out = (cs_motion_verdict){.error = INFINITY};
  if (count < cs_motion_least(model) || count > CS_MOTION_MOST)
    return false;
  frame f = frame_of(pairs, count);
  for (size_t i = 0; i < count; i++)
    near_one[i] = (cs_motion_pair){framed(f, pairs[i].from), framed(f, pairs[i].to), false};
  double close = tolerance / f.scale;
  if (search(model, near_one, count, close, &matrix) < cs_motion_least(model))
    return false;
  refine(model, near_one, count, close, LEAST_DEVIATION / f.scale, &matrix, weights);
  out->matrix = unframed(f, matrix);
  judge(pairs, count, tolerance, out);
  return out->agreeing >= cs_motion_least(model);
}
