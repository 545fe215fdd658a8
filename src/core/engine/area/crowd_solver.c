#include "engine/area/crowd_solver.h"

#include "base/sort.h"

#define LIMIT (0.5f / 255) /* the most light that the weak way may leave out */
#define FEW 10             /* the most lines that are followed to their crossings */
#define MANY 64 /* lines that are too many to be followed at all; and the most even slabs */
#define EVEN 16 /* even slabs where no layer hides more than half */

/* ---------------------------------------------------------------- sets */

/* Adds one set of partial layers, those whose sum is inside, with its share of the pixel. */
static inline void add_set(cs_crowd_solver *solver, float share) {
  cs_v4 through = cs_v4_all(share);
  for (size_t i = 0; i < solver->partial_count; i++) {
    cs_crowd_partial *partial = &solver->partials[i];
    if ((partial->sum & partial->mask) != 0) {
      partial->reached += through;
      through *= partial->layer->t;
    }
    partial->after += through;
  }
}

/* Adds all sets of up to two layers. shares: by set, bit i for layer i. */
static void add_sets(cs_crowd_solver *solver, const double *shares) {
  size_t count = solver->partial_count;
  for (int32_t set = 0; set < 1 << count; set++) {
    for (size_t i = 0; i < count; i++)
      solver->partials[i].sum = (set >> i & 1) * solver->partials[i].mask;
    add_set(solver, (float)shares[set]);
  }
}

/* The share of the pixel in two layers. */
static double joint_area(const cs_crowd_solver *solver, const cs_crowd_partial *a,
                         const cs_crowd_partial *b) {
  const cs_crowd_line *lines = solver->lines;
  double twice = 0;
  for (size_t i = a->first; i < a->end; i++)
    for (size_t k = b->first; k < b->end; k++)
      twice +=
          lines[i].direction * lines[k].direction * cs_crowd_right_of_two(&lines[i], &lines[k]);
  return twice * (1 / CS_CROWD_TWICE);
}

static void solve_two(cs_crowd_solver *solver) {
  const cs_crowd_partial *p = solver->partials;
  double a = p[0].area, b = p[1].area, both = joint_area(solver, &p[0], &p[1]);
  add_sets(solver, (double[]){1 - a - b + both, a - both, b - both, both});
}

/* ---------------------------------------------------------------- weak */

/* At least the cube root of 0 < x <= 1/8: Newton's steps never fall below it. */
static float cube_root(float x) {
  float root = 0.841f * sqrtf(sqrtf(x));
  for (int k = 0; k < 3; k++)
    root = (2 * root + x / (root * root)) * (1 / 3.0f);
  return root;
}

/* Whether products of means with covariances are near enough. What they leave out has at least
 * three layers; the mean of the product of three deviations is at most the product of the roots of
 * their third absolute moments (Hoelder). Opaque layers are exact in any case, so that nothing
 * shines through where they abut. */
static bool is_weak(const cs_crowd_solver *solver) {
  const cs_crowd_partial *p = solver->partials;
  float one = 0, two = 0, three = 0;
  for (size_t i = 0; i < solver->partial_count; i++) {
    if (p[i].hides > 0.99f)
      return false;
    float a = (float)p[i].area, b = 1 - a;
    float each = p[i].hides * cube_root(a * b * (a * a + b * b));
    three += two * each;
    two += one * each;
    one += each;
  }
  return three * cs_crowd_most(p[2].before) * (1 + 0.4f * one) < LIMIT;
}

/* Writes the lines of a layer as numbers, without weights yet. */
static void write_numbers(const cs_crowd_solver *solver, const cs_crowd_partial *partial, size_t at,
                          const cs_crowd_numbers *n) {
  for (size_t k = partial->first; k < partial->end; k++, at++) {
    const cs_crowd_line *line = &solver->lines[k];
    n->x[at] = (float)line->xa;
    n->slope[at] = (float)(line->xb - line->xa) / (float)(line->yb - line->ya);
    n->top[at] = (float)line->ya;
    n->foot[at] = (float)line->yb;
    n->direction[at] = (float)line->direction;
    n->weight[at] = 0;
  }
}

/* The weak way in one channel, or in all if `channels` is 3. room: in each array of n. */
static void solve_weak_in(cs_crowd_solver *solver, const cs_crowd_numbers *n, size_t room,
                          int channel, int channels) {
  float product = 1, pairs = 0, sum = 0;
  size_t count = 0;
  memset(n->weight, 0, room * sizeof *n->weight);
  for (size_t i = 0; i < solver->partial_count; i++) {
    cs_crowd_partial *p = &solver->partials[i];
    size_t end = count + p->end - p->first;
    float a = (float)p->area, h = 1 - p->layer->t[channel], mean = 1 - h * a, weight = h / mean;
    write_numbers(solver, p, count, n);
    float joint = CS_WIDE_CHOOSE(solver->isa, cs_crowd_solver_joint)(n, count, end);
    float with = joint * (float)(1 / CS_CROWD_TWICE) - a * sum;
    float reached = product * (a * (1 + pairs) - with);
    pairs += weight * with;
    sum += weight * a;
    product *= mean;
    for (int c = channel; c < channel + channels; c++) {
      p->reached[c] = reached;
      p->after[c] = product * (1 + pairs);
    }
    for (; count < end; count++)
      n->weight[count] = n->direction[count] * weight;
  }
}

static bool is_grey(const cs_crowd_solver *solver) {
  bool is = true;
  for (size_t i = 0; i < solver->partial_count; i++) {
    cs_v4 t = solver->partials[i].layer->t;
    is &= t[0] == t[1] && t[1] == t[2];
  }
  return is;
}

static celspan_status solve_weak(cs_crowd_solver *solver, celspan_context *context) {
  size_t room = (solver->line_count + CS_CROWD_SUMS) / CS_CROWD_SUMS * CS_CROWD_SUMS;
  CS_TRY(CS_ARRAY_RESERVE(context, solver->numbers, 6 * room));
  float *at = memset(solver->numbers, 0, 6 * room * sizeof *solver->numbers);
  const cs_crowd_numbers n = {at,           at + room, at + 2 * room, at + 3 * room, at + 4 * room,
                              at + 5 * room};
  if (is_grey(solver)) {
    solve_weak_in(solver, &n, room, 0, 3);
    return CELSPAN_OK;
  }
  for (int channel = 0; channel < 3; channel++)
    solve_weak_in(solver, &n, room, channel, 1);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- strong */

static inline bool height_is_before(const double *a, const double *b) { return *a < *b; }

CS_SORT_DEFINE(sort_heights, double, height_is_before)

static inline bool passage_is_before(const cs_crowd_passage *a, const cs_crowd_passage *b) {
  return a->x != b->x ? a->x < b->x : a->line < b->line;
}

CS_SORT_DEFINE(sort_passages, cs_crowd_passage, passage_is_before)

/* Even slabs, cut once more where lines begin and end, unless these are very many. So crossings
 * alone are not exact: those of lines that meet within a slab. */
static size_t cut_evenly(cs_crowd_solver *solver) {
  size_t even = EVEN, count = 0;
  for (size_t i = 0; i < solver->partial_count; i++)
    even = solver->line_count > MANY || solver->partials[i].hides > 0.5f ? MANY : even;
  for (size_t k = 0; k <= even; k++)
    solver->heights[count++] = (double)(k * (CS_CROWD_UNIT / even));
  for (size_t i = 0; i < solver->line_count && solver->line_count <= MANY; i++) {
    solver->heights[count++] = solver->lines[i].ya;
    solver->heights[count++] = solver->lines[i].yb;
  }
  sort_heights(solver->heights, count);
  return count;
}

/* Slabs between all heights at which lines begin, end or cross. */
static size_t cut_exactly(cs_crowd_solver *solver) {
  const cs_crowd_line *lines = solver->lines;
  double *heights = solver->heights;
  size_t count = 0;
  heights[count++] = 0;
  heights[count++] = CS_CROWD_UNIT;
  for (size_t i = 0; i < solver->line_count; i++) {
    heights[count++] = lines[i].ya;
    heights[count++] = lines[i].yb;
    for (size_t k = 0; k < i; k++) {
      int32_t top = lines[i].ya > lines[k].ya ? lines[i].ya : lines[k].ya;
      int32_t foot = lines[i].yb < lines[k].yb ? lines[i].yb : lines[k].yb;
      cs_crowd_ends a = cs_crowd_ends_of(&lines[i], top, foot);
      cs_crowd_ends b = cs_crowd_ends_of(&lines[k], top, foot);
      double above = a.top - b.top, below = a.foot - b.foot;
      if (top < foot && above * below < 0)
        heights[count++] = top + (foot - top) * (above / (above - below));
    }
  }
  sort_heights(heights, count);
  return count;
}

/* Adds the spans between two heights. */
static void add_slab(cs_crowd_solver *solver, double top, double foot) {
  double middle = 0.5 * (top + foot), height = (foot - top) * (2 / CS_CROWD_TWICE), x = 0;
  size_t count = 0;
  for (size_t i = 0; i < solver->partial_count; i++) {
    cs_crowd_partial *partial = &solver->partials[i];
    partial->sum = 0;
    for (size_t k = partial->first; k < partial->end; k++) {
      const cs_crowd_line *line = &solver->lines[k];
      if (line->ya <= middle && line->yb > middle)
        solver->passages[count++] =
            (cs_crowd_passage){cs_crowd_ends_of(line, middle, middle).top, k, partial};
    }
  }
  sort_passages(solver->passages, count);
  for (size_t k = 0; k <= count; k++) {
    double next = k < count ? solver->passages[k].x : CS_CROWD_UNIT;
    if (next > x)
      add_set(solver, (float)(height * (next - x)));
    x = next > x ? next : x;
    if (k < count)
      solver->passages[k].partial->sum += solver->lines[solver->passages[k].line].direction;
  }
}

static celspan_status solve_strong(cs_crowd_solver *solver, celspan_context *context) {
  size_t lines = solver->line_count, most = 3 * MANY + 1;
  CS_TRY(CS_ARRAY_RESERVE(context, solver->heights, most));
  CS_TRY(CS_ARRAY_RESERVE(context, solver->passages, lines));
  size_t count = lines > FEW ? cut_evenly(solver) : cut_exactly(solver);
  for (size_t k = 1; k < count; k++)
    if (solver->heights[k] > solver->heights[k - 1])
      add_slab(solver, solver->heights[k - 1], solver->heights[k]);
  return CELSPAN_OK;
}

celspan_status cs_crowd_solver_solve(cs_crowd_solver *solver, celspan_context *context) {
  bool is_plain = true;
  for (size_t i = 0; i < solver->partial_count; i++) {
    solver->partials[i].reached = solver->partials[i].after = cs_v4_all(0);
    is_plain &= solver->partials[i].is_plain;
  }
  double area = solver->partial_count == 1 ? solver->partials[0].area : 0;
  if (is_plain && solver->partial_count == 1)
    add_sets(solver, (double[]){1 - area, area});
  else if (is_plain && solver->partial_count == 2)
    solve_two(solver);
  else if (is_plain && is_weak(solver))
    return solve_weak(solver, context);
  else
    return solve_strong(solver, context);
  return CELSPAN_OK;
}
