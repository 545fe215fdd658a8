/* Blend modes against their formulas: the oracle's in doubles, the engine's in floats. The formulas
 * are written here once more, with colours that are not premultiplied. */
#include <math.h>

#include "engine/compose/over.h"
#include "model/scene/oracle.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define PAIRS 10000
#define MODES CS_BLEND_COUNT

/* ---------------------------------------------------------------- formulas */

static double unit(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

static double burn(double b, double s) { return b >= 1 ? 1 : s <= 0 ? 0 : unit(1 - (1 - b) / s); }
static double dodge(double b, double s) { return b <= 0 ? 0 : s >= 1 ? 1 : unit(b / (1 - s)); }

static double soft(double b, double s) {
  double root = b > 0.25 ? sqrt(b) : 16 * b * b * b - 12 * b * b + 4 * b;
  return b + (2 * s - 1) * (s > 0.5 ? root - b : b - b * b);
}

static double soft_photoshop(double b, double s) {
  return b + (2 * s - 1) * (s > 0.5 ? sqrt(b) - b : b - b * b);
}

static double hard(double b, double s) { return s > 0.5 ? 2 * (b + s - b * s) - 1 : 2 * b * s; }

static double channel(celspan_blend mode, double b, double s) {
  switch (mode) {
  case CELSPAN_BLEND_MULTIPLY:
    return b * s;
  case CELSPAN_BLEND_SCREEN:
    return b + s - b * s;
  case CELSPAN_BLEND_OVERLAY:
    return hard(s, b);
  case CELSPAN_BLEND_DARKEN:
    return b < s ? b : s;
  case CELSPAN_BLEND_LIGHTEN:
    return b > s ? b : s;
  case CELSPAN_BLEND_COLOR_DODGE:
    return dodge(b, s);
  case CELSPAN_BLEND_COLOR_BURN:
    return burn(b, s);
  case CELSPAN_BLEND_HARD_LIGHT:
    return hard(b, s);
  case CELSPAN_BLEND_SOFT_LIGHT:
    return soft(b, s);
  case CELSPAN_BLEND_DIFFERENCE:
    return b > s ? b - s : s - b;
  case CELSPAN_BLEND_EXCLUSION:
    return b * (1 - s) + s * (1 - b);
  case CELSPAN_BLEND_LINEAR_DODGE:
    return unit(b + s);
  case CELSPAN_BLEND_SOFT_LIGHT_PHOTOSHOP:
    return soft_photoshop(b, s);
  case CELSPAN_BLEND_LINEAR_BURN:
    return unit(b + s - 1);
  case CELSPAN_BLEND_VIVID_LIGHT:
    return s < 0.5 ? burn(b, s + s) : dodge(b, s + s - 1);
  case CELSPAN_BLEND_LINEAR_LIGHT:
    return unit(b - 1 + s + s);
  case CELSPAN_BLEND_PIN_LIGHT:
    return b > 2 * s ? 2 * s : b < 2 * s - 1 ? 2 * s - 1 : b;
  case CELSPAN_BLEND_HARD_MIX:
    return b > 0 && b + s > 1 - 1e-6;
  case CELSPAN_BLEND_SUBTRACT:
    return unit(b - s);
  case CELSPAN_BLEND_DIVIDE:
    return b > 0 ? s > 0 ? unit(b / s) : 1 : 0;
  default:
    return s;
  }
}

static double lum(const double c[3]) { return 0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2]; }

static void extremes(const double c[3], double *low, double *high) {
  *low = *high = c[0];
  for (int i = 1; i < 3; i++) {
    *low = c[i] < *low ? c[i] : *low;
    *high = c[i] > *high ? c[i] : *high;
  }
}

/* The colour with another luminosity: moved there, then drawn in towards grey until it fits. */
static void with_lum(const double c[3], double target, double out[3]) {
  double low, high, share = 1, moved[3];
  for (int i = 0; i < 3; i++)
    moved[i] = c[i] + target - lum(c);
  extremes(moved, &low, &high);
  if (low < 0)
    share = target / (target - low);
  if (high > 1 && (1 - target) / (high - target) < share)
    share = (1 - target) / (high - target);
  for (int i = 0; i < 3; i++)
    out[i] = target + share * (moved[i] - target);
}

static void with_sat(const double c[3], const double like[3], double out[3]) {
  double low, high, from, to;
  extremes(c, &low, &high);
  extremes(like, &from, &to);
  for (int i = 0; i < 3; i++)
    out[i] = high > low ? (c[i] - low) / (high - low) * (to - from) : 0;
}

static void whole(celspan_blend mode, const double b[3], const double s[3], double out[3]) {
  double mixed[3] = {s[0], s[1], s[2]};
  if (mode >= CELSPAN_BLEND_DARKER_COLOR) {
    bool takes_dark = mode == CELSPAN_BLEND_DARKER_COLOR;
    memcpy(out, (lum(s) < lum(b)) == takes_dark ? s : b, sizeof mixed);
    return;
  }
  if (mode == CELSPAN_BLEND_LUMINOSITY) {
    with_lum(b, lum(s), out);
    return;
  }
  if (mode == CELSPAN_BLEND_HUE)
    with_sat(s, b, mixed);
  if (mode == CELSPAN_BLEND_SATURATION)
    with_sat(b, s, mixed);
  with_lum(mixed, lum(b), out);
}

/* ---------------------------------------------------------------- pairs */

/* A source and a backdrop: colours and alphas. */
typedef struct pair {
  double s[3], b[3], as, ab;
} pair;

static double any(test_random *r) {
  return random_below(r, 5) == 0 ? 0.5 * random_below(r, 3) : random_between(r, 0, 1);
}

static pair random_pair(test_random *r) {
  pair p = {.as = random_between(r, 0.05, 1)};
  p.ab = random_between(r, 0.05, 1);
  for (int i = 0; i < 3; i++) {
    p.s[i] = any(r);
    p.b[i] = any(r);
  }
  return p;
}

/* Premultiplied, with the alpha in place 3. */
static void expect(celspan_blend mode, const pair *p, double out[4]) {
  double mixed[3];
  for (int i = 0; i < 3; i++)
    mixed[i] = channel(mode, p->b[i], p->s[i]);
  if ((mode >= CELSPAN_BLEND_HUE && mode <= CELSPAN_BLEND_LUMINOSITY) ||
      mode >= CELSPAN_BLEND_DARKER_COLOR)
    whole(mode, p->b, p->s, mixed);
  for (int i = 0; i < 3; i++)
    out[i] = mode == CELSPAN_BLEND_ADD
                 ? p->as * p->s[i] + p->ab * p->b[i]
                 : p->as * (1 - p->ab) * p->s[i] + p->ab * (1 - p->as) * p->b[i] +
                       p->as * p->ab * mixed[i];
  out[3] = mode == CELSPAN_BLEND_ADD ? unit(p->as + p->ab) : p->as + p->ab - p->as * p->ab;
}

static cs_oracle_sight sight_of(const double c[3], double alpha) {
  cs_oracle_sight sight = {.keep = 1};
  for (int i = 0; i < 3; i++) {
    sight.light[i] = alpha * c[i];
    sight.through[i] = 1 - alpha;
  }
  return sight;
}

static cs_over_pair pair_of(const double c[3], double alpha) {
  float t = (float)(1 - alpha);
  return (cs_over_pair){{(float)(alpha * c[0]), (float)(alpha * c[1]), (float)(alpha * c[2]), 0},
                        {t, t, t, 0}};
}

/* ---------------------------------------------------------------- tests */

/* Where colours are near a place at which a formula jumps, rounding may put them on the other side
 * of it. */
static bool jumps(celspan_blend mode, const pair *p) {
  bool does = false;
  for (int i = 0; i < 3; i++) {
    bool is_vivid = mode == CELSPAN_BLEND_VIVID_LIGHT;
    does |= (mode == CELSPAN_BLEND_COLOR_DODGE || is_vivid) && p->b[i] < 1e-4;
    does |= (mode == CELSPAN_BLEND_COLOR_BURN || is_vivid) && p->b[i] > 1 - 1e-4;
    does |= mode == CELSPAN_BLEND_DIVIDE && p->b[i] < 1e-4;
  }
  if (mode == CELSPAN_BLEND_DARKER_COLOR || mode == CELSPAN_BLEND_LIGHTER_COLOR)
    return fabs(lum(p->s) - lum(p->b)) < 1e-3;
  double low, high;
  extremes(mode == CELSPAN_BLEND_HUE ? p->s : p->b, &low, &high);
  return does || (mode >= CELSPAN_BLEND_HUE && high - low < 1e-2);
}

static void test_oracle(celspan_blend mode) {
  test_random r = {(uint64_t)mode + 1};
  double worst = 0;
  for (int k = 0; k < PAIRS; k++) {
    pair p = random_pair(&r);
    double right[4];
    if (jumps(mode, &p))
      continue;
    cs_oracle_sight source = sight_of(p.s, p.as), back = sight_of(p.b, p.ab);
    cs_oracle_sight both = cs_oracle_blend(mode, &source, &back);
    expect(mode, &p, right);
    for (int i = 0; i < 3; i++)
      worst = fmax(worst, fabs(both.light[i] - right[i]));
    worst = fmax(worst, fabs(cs_oracle_alpha(&both) - right[3]));
  }
  if (!CHECK(worst <= 1e-6))
    fprintf(stderr, "  mode %d: the oracle is off by %g\n", (int)mode, worst);
}

static void test_engine(celspan_blend mode) {
  test_random r = {(uint64_t)mode + 101};
  double worst = 0;
  int tried = 0;
  for (int k = 0; k < PAIRS; k++) {
    pair p = random_pair(&r);
    double right[4];
    float keep = 1;
    if (jumps(mode, &p))
      continue;
    tried++;
    cs_over_pair both = cs_over_blend(mode, pair_of(p.s, p.as), pair_of(p.b, p.ab), &keep);
    expect(mode, &p, right);
    for (int i = 0; i < 3; i++)
      worst = fmax(worst, fabs((double)both.e[i] - right[i]));
    worst = fmax(worst, fabs((double)cs_over_alpha(both.t, keep) - right[3]));
  }
  CHECK(tried > PAIRS / 3);
  if (!CHECK(worst <= 1e-5))
    fprintf(stderr, "  mode %d: the engine is off by %g\n", (int)mode, worst);
}

/* A source within its backdrop is shown in the share of it that is there. */
static void test_within(celspan_blend mode) {
  const celspan_blend within = (celspan_blend)((unsigned)mode | CS_BLEND_WITHIN);
  test_random r = {(uint64_t)mode + 301};
  double worst = 0;
  for (int k = 0; k < PAIRS; k++) {
    pair p = random_pair(&r);
    double right[4], ab = p.ab;
    float keep = 1;
    if (jumps(mode, &p) || mode == CELSPAN_BLEND_ADD)
      continue;
    p.ab = 1;
    expect(mode, &p, right);
    p.ab = ab;
    cs_oracle_sight source = sight_of(p.s, p.as), back = sight_of(p.b, p.ab);
    cs_oracle_sight both = cs_oracle_blend(within, &source, &back);
    cs_over_pair floats = cs_over_blend(within, pair_of(p.s, p.as), pair_of(p.b, ab), &keep);
    for (int i = 0; i < 3; i++) {
      worst = fmax(worst, fabs(both.light[i] - ab * right[i]));
      worst = fmax(worst, fabs((double)floats.e[i] - both.light[i]));
    }
    worst = fmax(worst, fabs(cs_oracle_alpha(&both) - ab));
    worst = fmax(worst, fabs((double)cs_over_alpha(floats.t, keep) - ab));
  }
  CHECK(worst <= 1e-5);
}

/* A source that is not there leaves its backdrop as it is, to the bit, and a backdrop that is not
 * there leaves the source: also where the channels are let through differently. */
static void test_identities(celspan_blend mode) {
  test_random r = {(uint64_t)mode + 201};
  for (int k = 0; k < 100; k++) {
    cs_over_pair back, both;
    float keep = 1;
    for (int i = 0; i < 3; i++) {
      back.t[i] = random_unit(&r);
      back.e[i] = random_unit(&r);
    }
    back.e[3] = back.t[3] = 0;
    both = cs_over_blend(mode, cs_over_pair_clear, back, &keep);
    for (int i = 0; i < 3; i++) {
      CHECK(both.e[i] == back.e[i]);
      CHECK(fabsf(both.t[i] - back.t[i]) <= 0x1p-23f);
    }
    both = cs_over_blend(mode, back, cs_over_pair_clear, &keep);
    for (int i = 0; i < 3; i++)
      CHECK(both.e[i] == back.e[i]);
  }
}

/* Colours that are clamped to 0..1 inside a mode are not clamped outside of it. */
static void test_bright(void) {
  const double bright[3] = {3, 2, 4}, dim[3] = {0.5, 0.5, 0.5};
  cs_oracle_sight source = sight_of(bright, 1), back = sight_of(dim, 0.25);
  cs_oracle_sight both = cs_oracle_blend(CELSPAN_BLEND_MULTIPLY, &source, &back);
  for (int i = 0; i < 3; i++)
    CHECK(fabs(both.light[i] - (0.75 * bright[i] + 0.25 * 0.5)) < 1e-12);
  float keep = 1;
  cs_over_pair floats =
      cs_over_blend(CELSPAN_BLEND_MULTIPLY, pair_of(bright, 1), pair_of(dim, 0.25), &keep);
  for (int i = 0; i < 3; i++)
    CHECK(fabs((double)floats.e[i] - both.light[i]) < 1e-5);
}

int main(void) {
  for (int mode = 0; mode < MODES; mode++) {
    test_oracle((celspan_blend)mode);
    test_engine((celspan_blend)mode);
    test_identities((celspan_blend)mode);
    test_within((celspan_blend)mode);
  }
  test_bright();
  return check_done();
}
