#include "readers/svg/motion/motion_easing.h"

#include <math.h>
#include <string.h>

#include "inside/number.h"

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

/* ---------------------------------------------------------------- stops */

/* A list of stops while it is read. Those without a place lie evenly between those around them. */
typedef struct stops {
  const char *at;
  double x, y;     /* the last stop */
  bool has_second; /* it is at another place, too: */
  double second;
  size_t run;  /* how many of the stops that come next have no place, */
  double step; /* and their distance */
  bool is_begun;
} stops;

/* A stop as written: a number, and up to two percentages, before or behind it. */
typedef struct stop {
  double y, places[2];
  int count; /* the count of places */
} stop;

static bool take_stop(const char **text, stop *out) {
  bool has_y = false;
  const char *at = cs_svg_skip_space(*text);
  out->count = 0;
  for (; *at && *at != ',' && *at != ')'; at = cs_svg_skip_space(at)) {
    double value;
    if (!cs_svg_take_number(&at, &value))
      return false;
    bool is_place = *at == '%';
    if (is_place ? out->count == 2 : has_y)
      return false;
    if (is_place) {
      out->places[out->count++] = value / 100;
      at++;
    } else {
      out->y = value;
      has_y = true;
    }
  }
  *text = at;
  return has_y;
}

/* The distance of the stops from *text on that have no place; *run: how many they are. */
static double step_of(const char *text, double from, bool is_begun, size_t *run) {
  stop it;
  for (*run = 0; take_stop(&text, &it) && it.count == 0; text++) {
    ++*run;
    if (*text == ')')
      break;
  }
  bool ends = it.count == 0; /* the last one lies at 1, the first one at 0 */
  double to = fmax(from, ends ? 1 : it.places[0]);
  size_t parts = *run + !ends - !is_begun;
  return parts > 0 ? (to - from) / (double)parts : 0;
}

/* The next point of the list; false: there is none. */
static bool next_stop(stops *s) {
  stop it;
  const double before = s->x;
  if (s->has_second) {
    s->x = fmax(before, s->second);
    s->has_second = false;
    return true;
  }
  if (s->is_begun && *s->at++ != ',')
    return false;
  if (s->run == 0)
    s->step = step_of(s->at, before, s->is_begun, &s->run);
  (void)take_stop(&s->at, &it);
  if (s->run > 0)
    s->run--;
  s->x = it.count > 0 ? s->is_begun ? fmax(before, it.places[0]) : it.places[0]
                      : before + (s->is_begun ? s->step : 0);
  s->y = it.y;
  s->has_second = it.count == 2;
  s->second = it.places[1];
  s->is_begun = true;
  return true;
}

/* Source: CSS Easing Functions Level 2, 2.2.1. Beyond the ends the outer lines continue. */
static double between_stops(const char *text, double share) {
  stops s = {.at = text};
  (void)next_stop(&s);
  double x = s.x, y = s.y, from_x = x, from_y = y;
  for (size_t count = 1; next_stop(&s); count++) {
    if (count > 1 && x > share)
      break;
    from_x = x;
    from_y = y;
    x = s.x;
    y = s.y;
  }
  return x > from_x && share != x ? from_y + (y - from_y) * ((share - from_x) / (x - from_x)) : y;
}

static bool take_stops(const char **text, cs_svg_easing *out) {
  const char *at = *text;
  size_t count = 0;
  stop it;
  do {
    if (!take_stop(&at, &it))
      return false;
    count++;
  } while (*at++ == ',');
  if (*--at != ')' || count < 2)
    return false;
  out->stops = *text;
  out->size = (size_t)(at - *text);
  *text = at + 1;
  return true;
}

/* ---------------------------------------------------------------- shares */

double cs_svg_ease(const cs_svg_easing *easing, double share, bool is_before) {
  if (easing->stops)
    return between_stops(easing->stops, share);
  if (easing->steps > 0)
    return step(easing, share, is_before);
  if (share <= 0 || share >= 1)
    return share;
  return cubic(easing->at[1], easing->at[3], parameter_at(easing->at, share));
}

bool cs_svg_easings_equal(const cs_svg_easing *a, const cs_svg_easing *b) {
  bool is_same = a->steps == b->steps && a->jumps == b->jumps && a->size == b->size &&
                 (a->size == 0 || memcmp(a->stops, b->stops, a->size) == 0);
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
  } words[] = {{"linear", {.at = {0, 0, 1, 1}}},
               {"ease", {.at = {0.25, 0.1, 0.25, 1}}},
               {"ease-in", {.at = {0.42, 0, 1, 1}}},
               {"ease-out", {.at = {0, 0, 0.58, 1}}},
               {"ease-in-out", {.at = {0.42, 0, 0.58, 1}}},
               {"step-start", {.steps = 1, .jumps = 1}},
               {"step-end", {.steps = 1, .jumps = 2}}};
  static const struct {
    const char *word;
    bool (*take)(const char **text, cs_svg_easing *out);
  } functions[] = {{"cubic-bezier", take_curve}, {"steps", take_steps}, {"linear", take_stops}};
  const char *at = cs_svg_skip_space(*text);
  cs_svg_easing made = {.steps = 0};
  size_t i = 0, most = sizeof functions / sizeof *functions;
  for (const char *word = at; i < most; i++, word = at)
    if (cs_svg_take_word(&word, functions[i].word) && *word == '(') {
      at = word + 1;
      break;
    }
  if (i < most && !functions[i].take(&at, &made))
    return false;
  for (size_t k = 0; i == most && k < sizeof words / sizeof *words; k++)
    if (cs_svg_take_word(&at, words[k].word)) {
      made = words[k].easing;
      i = 0;
    }
  if (i == most)
    return false;
  *out = made;
  *text = at;
  return true;
}
