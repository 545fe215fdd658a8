#include "readers/svg/words/filter_list.h"

#include <math.h>

#include "readers/svg/words/transforms.h"

/* The kind of a function's arguments. */
typedef enum arguments { LENGTH, SHADOW, ANGLE, AMOUNT, SHARE } arguments;

static const struct function {
  const char *name;
  arguments arguments;
} functions[CS_SVG_FILTER_REFERENCE] = {
    [CS_SVG_FILTER_BLUR] = {"blur", LENGTH},
    [CS_SVG_FILTER_BRIGHTNESS] = {"brightness", AMOUNT},
    [CS_SVG_FILTER_CONTRAST] = {"contrast", AMOUNT},
    [CS_SVG_FILTER_SHADOW] = {"drop-shadow", SHADOW},
    [CS_SVG_FILTER_GRAYSCALE] = {"grayscale", SHARE},
    [CS_SVG_FILTER_HUE] = {"hue-rotate", ANGLE},
    [CS_SVG_FILTER_INVERT] = {"invert", SHARE},
    [CS_SVG_FILTER_OPACITY] = {"opacity", SHARE},
    [CS_SVG_FILTER_SATURATE] = {"saturate", AMOUNT},
    [CS_SVG_FILTER_SEPIA] = {"sepia", SHARE},
};

const char *cs_svg_filter_name(cs_svg_filter_kind kind) {
  return kind == CS_SVG_FILTER_REFERENCE ? "url" : functions[kind].name;
}

/* ---------------------------------------------------------------- arguments */

/* Whether a number that ends at `end` has a unit; 0 needs none. */
static bool has_unit(const char *text, const char *end) {
  double value;
  return !cs_svg_take_number(&text, &value) || value == 0 || text != end;
}

static bool take_length(const char **text, cs_svg_filter_call *call, int index) {
  const char *begin = cs_svg_skip_space(*text), *at = begin;
  cs_svg_length length;
  if (!cs_svg_take_length(&at, &length) || length.unit == CS_SVG_UNIT_PERCENT)
    return false;
  call->lengths[index] = length;
  call->is_bare = call->is_bare || !has_unit(begin, at);
  *text = at;
  return true;
}

static bool take_colour(const char **text, cs_svg_filter_call *call) {
  const char *at = cs_svg_skip_space(*text);
  bool is_current = cs_svg_take_word(&at, "currentColor");
  call->has_colour = !is_current && cs_svg_take_colour(&at, &call->colour);
  if (is_current || call->has_colour)
    *text = at;
  return is_current || call->has_colour;
}

/* Two or three lengths, and a colour before or behind them. */
static bool take_shadow(const char **text, cs_svg_filter_call *call) {
  int count = 0;
  bool is_coloured = take_colour(text, call);
  while (count < 3 && take_length(text, call, count))
    count++;
  if (!is_coloured)
    (void)take_colour(text, call);
  return count >= 2 && call->lengths[2].value >= 0;
}

static bool take_angle(const char **text, double *out) {
  const char *begin = *text;
  return cs_svg_take_angle(text, out) && has_unit(begin, *text);
}

/* A number or a percentage. */
static bool take_amount(const char **text, double most, double *out) {
  if (!cs_svg_take_number(text, out) || *out < 0)
    return false;
  if (**text == '%') {
    *out /= 100;
    ++*text;
  }
  *out = fmin(*out, most);
  return true;
}

/* Functions of one argument may have none. */
static bool take_arguments(const char **text, arguments wanted, cs_svg_filter_call *call) {
  *text = cs_svg_skip_space(*text);
  call->amount = wanted == ANGLE ? 0 : 1;
  if (**text == ')' && wanted != SHADOW)
    return true;
  switch (wanted) {
  case LENGTH:
    return take_length(text, call, 0) && call->lengths[0].value >= 0;
  case SHADOW:
    return take_shadow(text, call);
  case ANGLE:
    return take_angle(text, &call->amount);
  default:
    return take_amount(text, wanted == SHARE ? 1 : INFINITY, &call->amount);
  }
}

/* ---------------------------------------------------------------- calls */

/* The name of a function and its parenthesis. */
static bool take_name(const char **text, cs_svg_filter_kind *out) {
  for (int kind = 0; kind < CS_SVG_FILTER_REFERENCE; kind++) {
    const char *at = *text;
    if (!cs_svg_take_word(&at, functions[kind].name) || *at != '(')
      continue;
    *text = at + 1;
    *out = (cs_svg_filter_kind)kind;
    return true;
  }
  return false;
}

static bool take_function(const char **text, cs_svg_filter_call *out) {
  if (!take_name(text, &out->kind) || !take_arguments(text, functions[out->kind].arguments, out))
    return false;
  *text = cs_svg_skip_space(*text);
  return *(*text)++ == ')';
}

bool cs_svg_take_filter(const char **text, cs_svg_filter_call *out) {
  const char *at = cs_svg_skip_space(*text);
  *out = (cs_svg_filter_call){.kind = CS_SVG_FILTER_REFERENCE};
  if (!cs_svg_take_reference(&at, &out->reference) && !take_function(&at, out))
    return false;
  *text = cs_svg_skip_space(at);
  return true;
}

bool cs_svg_is_filter_list(const char *text, bool is_style) {
  cs_svg_filter_call call;
  do {
    if (!cs_svg_take_filter(&text, &call) || (is_style && call.is_bare))
      return false;
  } while (*text);
  return true;
}
