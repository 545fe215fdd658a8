#include "readers/svg/motion/motion_lists.h"

#include <math.h>
#include <string.h>

#include "readers/svg/motion/motion_easing.h"

size_t cs_svg_list_count(const char *text) {
  size_t count = 0;
  for (text = cs_svg_skip_space(text); *text; text = cs_svg_skip_space(text)) {
    count++;
    text += strcspn(text, ";");
    text += *text == ';';
  }
  return count;
}

const char *cs_svg_list_part(const cs_css_place *place, const char *text, size_t i) {
  for (; i > 0; i--) {
    text += strcspn(text, ";");
    text += *text == ';';
  }
  return cs_css_copy(place, text, text + strcspn(text, ";"));
}

/* The place of a share in a list of shares: *first is the last one at or before it. False: the list
 * is no list of `count` shares that grow from 0, to 1 if `ends`. */
static bool place_in_times(const char *text, double at, size_t count, bool ends, size_t *first,
                           double *share) {
  double before = 0, time = 0, low = 0, high = 1;
  if (cs_svg_list_count(text) != count)
    return false;
  for (size_t i = 0; i < count; i++, before = time) {
    text = cs_svg_skip_space(text);
    if (!cs_svg_take_number(&text, &time) || time < before || time > 1 || (i == 0 && time != 0))
      return false;
    text = cs_svg_skip_space(text);
    text += *text == ';';
    if (time <= at && (i + 1 < count || !ends)) {
      *first = i;
      low = time;
      high = 1;
    } else if (i == *first + 1)
      high = time;
  }
  *share = high > low ? (at - low) / (high - low) : 1;
  return !ends || time == 1;
}

static void place_by_distance(const double *distances, double at, size_t count, size_t *first,
                              double *share) {
  double whole = 0, done = 0;
  for (size_t i = 0; i + 1 < count; i++)
    whole += distances[i];
  *first = 0;
  while (*first + 2 < count && done + distances[*first] < at * whole)
    done += distances[(*first)++];
  *share = distances[*first] > 0 ? fmin(1, (at * whole - done) / distances[*first]) : 0;
}

static void place_evenly(double at, size_t parts, size_t most, size_t *first, double *share) {
  double place = at * (double)parts;
  *first = (size_t)fmin(floor(place), (double)most);
  *share = place - (double)*first;
}

/* Bends *share by curve `first` of keySplines; false: the list lies. */
static bool bend(const char *text, size_t first, size_t count, double *share) {
  if (!text || cs_svg_list_count(text) != count)
    return false;
  cs_svg_easing easing = {.steps = 0};
  double result = *share;
  for (size_t i = 0; i < count; i++) {
    for (int k = 0; k < 4; k++) {
      text = cs_svg_skip_comma(text);
      if (!cs_svg_take_number(&text, &easing.at[k]) || easing.at[k] < 0 || easing.at[k] > 1)
        return false;
    }
    text = cs_svg_skip_space(text);
    text += *text == ';';
    if (i == first)
      result = cs_svg_ease(&easing, *share, false);
  }
  *share = result;
  return true;
}

bool cs_svg_list_place(const cs_svg_node *node, const char *mode, double at, size_t count,
                       const double *distances, size_t *first, double *share) {
  const char *times = cs_svg_node_value(node, CS_SVG_KEY_TIMES);
  bool is_discrete = cs_svg_is_word(mode, "discrete"), is_spline = cs_svg_is_word(mode, "spline");
  *first = 0;
  *share = 0;
  if (distances && count > 1) {
    place_by_distance(distances, at, count, first, share);
    return true;
  }
  if (times && !cs_svg_is_word(mode, "paced")) {
    if (!place_in_times(times, at, count, !is_discrete, first, share))
      return false;
  } else if (is_discrete)
    place_evenly(at, count, count - 1, first, share);
  else if (count > 1)
    place_evenly(at, count - 1, count - 2, first, share);
  if (is_discrete)
    *share = 0;
  return !is_spline || count < 2 ||
         bend(cs_svg_node_value(node, CS_SVG_KEY_SPLINES), *first, count - 1, share);
}
