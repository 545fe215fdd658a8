#include "readers/svg/motion_easing.h"

#include <math.h>
#include <string.h>

#include "base/number.h"

/* A cubic from 0 to 1 with these two values between. */
static double cubic(double first, double second, double t) {
  double u = 1 - t;
  return 3 * u * u * t * first + 3 * u * t * t * second + t * t * t;
}

/* The parameter at which the curve, whose x grows, is at x: by halves, to the last bit. */
static double parameter_at(const double *at, double x) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; i++) {
    double middle = (low + high) / 2;
    if (cubic(at[0], at[2], middle) < x)
      low = middle;
    else
      high = middle;
  }
  return (low + high) / 2;
}

/* Source: CSS Easing Functions Level 1, 2.3.1. */
static double step(const cs_svg_easing *easing, double share, bool is_before) {
  double at = share * easing->steps, done = floor(at);
  int jumps = easing->steps - 1 + (easing->jumps & 1) + (easing->jumps >> 1);
  done += easing->jumps & 1;
  if (is_before && at == floor(at))
    done--;
  done = cs_number_clamp(done, share >= 0 ? 0 : -INFINITY, share <= 1 ? jumps : INFINITY);
  return jumps > 0 ? done / jumps : 0;
}

double cs_svg_ease(const cs_svg_easing *easing, double share, bool is_before) {
  if (easing->steps > 0)
    return step(easing, share, is_before);
  if (share <= 0 || share >= 1)
    return share;
  return cubic(easing->at[1], easing->at[3], parameter_at(easing->at, share));
}

bool cs_svg_easings_equal(const cs_svg_easing *a, const cs_svg_easing *b) {
  bool is_same = a->steps == b->steps && a->jumps == b->jumps;
  for (int i = 0; i < 4; i++)
    is_same = is_same && a->at[i] == b->at[i];
  return is_same;
}

/* ---------------------------------------------------------------- texts */

/* Four numbers between parentheses; x must be within 0..1. */
static bool take_curve(const char **text, cs_svg_easing *out) {
  const char *at = *text;
  for (int i = 0; i < 4; i++) {
    at = cs_svg_skip_comma(at);
    if (!cs_svg_take_number(&at, &out->at[i]))
      return false;
  }
  at = cs_svg_skip_space(at);
  if (*at != ')' || out->at[0] < 0 || out->at[0] > 1 || out->at[2] < 0 || out->at[2] > 1)
    return false;
  *text = at + 1;
  return true;
}

static bool take_jumps(const char **text, int *out) {
  static const struct {
    const char *word;
    int jumps;
  } words[] = {{"start", 1},    {"jump-start", 1}, {"end", 2},
               {"jump-end", 2}, {"jump-none", 0},  {"jump-both", 3}};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (cs_svg_take_word(text, words[i].word)) {
      *out = words[i].jumps;
      return true;
    }
  return false;
}

/* A whole number, without a point; with jump-none at least 2. */
static bool take_steps(const char **text, cs_svg_easing *out) {
  const char *at = cs_svg_skip_space(*text), *number = at;
  double steps;
  if (!cs_svg_take_number(&at, &steps) || steps < 1 || steps > 1e6 ||
      number + strspn(number, "+0123456789") != at)
    return false;
  out->steps = (int)steps;
  out->jumps = 2;
  at = cs_svg_skip_comma(at);
  if (*at != ')' && !take_jumps(&at, &out->jumps))
    return false;
  at = cs_svg_skip_space(at);
  if (*at != ')' || (out->steps == 1 && out->jumps == 0))
    return false;
  *text = at + 1;
  return true;
}

bool cs_svg_take_easing(const char **text, cs_svg_easing *out) {
  static const struct {
    const char *word;
    cs_svg_easing easing;
  } words[] = {{"linear", {0, 0, {0, 0, 1, 1}}},
               {"ease", {0, 0, {0.25, 0.1, 0.25, 1}}},
               {"ease-in", {0, 0, {0.42, 0, 1, 1}}},
               {"ease-out", {0, 0, {0, 0, 0.58, 1}}},
               {"ease-in-out", {0, 0, {0.42, 0, 0.58, 1}}},
               {"step-start", {1, 1, {0}}},
               {"step-end", {1, 2, {0}}}};
  const char *at = cs_svg_skip_space(*text);
  cs_svg_easing made = {.steps = 0};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (cs_svg_take_word(&at, words[i].word) && *at != '(') {
      *out = words[i].easing;
      *text = at;
      return true;
    }
  bool is_curve = cs_svg_take_word(&at, "cubic-bezier");
  if ((!is_curve && !cs_svg_take_word(&at, "steps")) || *at != '(')
    return false;
  at++;
  if (!(is_curve ? take_curve(&at, &made) : take_steps(&at, &made)))
    return false;
  *out = made;
  *text = at;
  return true;
}
