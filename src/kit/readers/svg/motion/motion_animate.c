/* The values of animate, animateTransform and set. */
#include "readers/svg/motion/motion_smil.h"

#include <string.h>

#include "readers/svg/motion/motion_lists.h"
#include "readers/svg/motion/motion_values.h"

/* The kinds of a transform: how many numbers, and those that are missing. */
static const struct {
  const char *word;
  size_t count;
  double missing[3];
} transforms[] = {{"translate", 2, {0, 0}},
                  {"scale", 2, {1, 1}},
                  {"rotate", 3, {0, 0, 0}},
                  {"skewX", 1, {0}},
                  {"skewY", 1, {0}}};

#define SUM 8192 /* the most bytes of transforms to which another is added */

typedef struct applying {
  cs_svg_reading *reading;
  const cs_svg_animation *it;
  const cs_svg_progress *progress;
  cs_css_place place;
  int transform;    /* its kind; -1: the value is no transform */
  const char *text; /* the value so far; NULL: the base, not yet asked for */
} applying;

static celspan_status need_base(applying *a) {
  if (!a->text && a->transform >= 0) { /* styles do not add to it */
    const char *given = cs_svg_node_value(a->it->target, a->it->name);
    a->text = given ? given : "none";
  }
  return a->text ? CELSPAN_OK
                 : cs_svg_motion_base(a->reading, a->it->target, a->it->name, &a->text);
}

static const char *value(const applying *a, cs_svg_name name) {
  return cs_svg_node_value(a->it->node, name);
}

/* One number of scale counts for both axes. */
static celspan_status fit_transform(applying *a, cs_svg_mixed *out) {
  double missing[3];
  memcpy(missing, transforms[a->transform].missing, sizeof missing);
  if (a->transform == 1 && out->count > 0)
    missing[1] = out->numbers[0].value;
  return cs_svg_mixed_fit(&a->place, missing, transforms[a->transform].count, out);
}

static celspan_status read_value(applying *a, const char *text, cs_svg_mixed *out) {
  cs_svg_name name = a->transform >= 0 ? CS_SVG_NAME_COUNT : a->it->name;
  if (cs_svg_is_word(text, "currentColor"))
    CS_TRY(cs_svg_motion_base(a->reading, a->it->target, CS_SVG_COLOR, &text));
  else if (cs_svg_is_word(text, "inherit") && a->it->target->parent)
    CS_TRY(cs_svg_motion_base(a->reading, a->it->target->parent, a->it->name, &text));
  CS_TRY(cs_svg_motion_count(a->reading, a->it->node, strlen(text)));
  CS_TRY(cs_svg_mixed_read(&a->place, name, text, out));
  return a->transform >= 0 ? fit_transform(a, out) : CELSPAN_OK;
}

/* Part i of the list at `list`. */
static celspan_status read_part(applying *a, const char *list, size_t i, cs_svg_mixed *out) {
  const char *text = cs_svg_list_part(&a->place, list, i);
  return text ? read_value(a, text, out) : CELSPAN_NO_MEMORY;
}

static const char *mode_of(const applying *a) {
  const char *mode = value(a, CS_SVG_CALC_MODE);
  return mode ? mode : "linear";
}

/* The distances of the values of a list that is paced; NULL: it is not. */
static celspan_status measure(applying *a, const char *mode, size_t count, double **out) {
  cs_svg_mixed before, next;
  const char *list = value(a, CS_SVG_VALUES);
  *out = NULL;
  if (!cs_svg_is_word(mode, "paced") || count < 2)
    return CELSPAN_OK;
  if (!(*out = cs_arena_take(a->reading->context, a->place.arena, count * sizeof **out)))
    return CELSPAN_NO_MEMORY;
  CS_TRY(read_part(a, list, 0, &before));
  for (size_t i = 1; i < count; i++, before = next) {
    list = strchr(list, ';') + 1;
    CS_TRY(read_part(a, list, 0, &next));
    (*out)[i - 1] = cs_svg_mixed_distance(&before, &next);
  }
  return CELSPAN_OK;
}

/* Between two values; those that do not mix change in the middle. */
static celspan_status between(applying *a, const cs_svg_mixed *from, const cs_svg_mixed *to,
                              double share, cs_svg_mixed *out) {
  *out = share < 0.5 ? *from : *to;
  if (!cs_svg_mixed_fits(from, to))
    return CELSPAN_OK;
  return cs_svg_mixed_mix(&a->place, from, to, share, false, out);
}

/* The value of a list. *last: its last value. *counts: false if the lists of the element lie. */
static celspan_status list_value(applying *a, cs_svg_mixed *out, cs_svg_mixed *last, bool *counts) {
  const char *list = value(a, CS_SVG_VALUES);
  size_t count = cs_svg_list_count(list), first;
  double *distances, share;
  cs_svg_mixed from, to;
  *counts = count > 0;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(read_part(a, list, count - 1, last));
  const char *mode = last->frame ? mode_of(a) : "discrete";
  CS_TRY(measure(a, mode, count, &distances));
  *counts =
      cs_svg_list_place(a->it->node, mode, a->progress->share, count, distances, &first, &share);
  if (!*counts)
    return CELSPAN_OK;
  CS_TRY(read_part(a, list, first, &from));
  CS_TRY(read_part(a, list, first + 1 < count ? first + 1 : first, &to));
  return between(a, &from, &to, share, out);
}

/* The same for from, to and by. */
static celspan_status ends_value(applying *a, cs_svg_mixed *out, cs_svg_mixed *last, bool *counts) {
  const char *from_text = value(a, CS_SVG_FROM), *to_text = value(a, CS_SVG_TO);
  const char *by_text = value(a, CS_SVG_BY);
  cs_svg_mixed from, to;
  size_t first;
  double share;
  *counts = to_text || by_text;
  if (!*counts)
    return CELSPAN_OK;
  CS_TRY(read_value(a, to_text ? to_text : by_text, &to));
  *counts = cs_svg_list_place(a->it->node, to.frame ? mode_of(a) : "discrete", a->progress->share,
                              2, NULL, &first, &share);
  share += (double)first;
  if (!*counts)
    return CELSPAN_OK;
  if (from_text)
    CS_TRY(read_value(a, from_text, &from));
  else if (a->transform >= 0 && to_text)
    CS_TRY(read_value(a, "", &from));
  else if (to_text) {
    CS_TRY(need_base(a));
    CS_TRY(read_value(a, a->text, &from));
  } else { /* only by: from nothing */
    from = to;
    if (to.frame)
      CS_TRY(cs_svg_mixed_add(&a->place, &to, &to, -1, &from));
  }
  if (!to_text && cs_svg_mixed_fits(&from, &to))
    CS_TRY(cs_svg_mixed_add(&a->place, &from, &to, 1, &to));
  *last = to;
  return between(a, &from, &to, share, out);
}

static bool is_word_value(const applying *a, cs_svg_name name, const char *word) {
  return cs_svg_is_word(value(a, name), word);
}

/* Adds the value to the one so far. */
static celspan_status add_to_base(applying *a, cs_svg_mixed *out) {
  cs_svg_mixed base;
  CS_TRY(need_base(a));
  CS_TRY(read_value(a, a->text, &base));
  return cs_svg_mixed_fits(&base, out) ? cs_svg_mixed_add(&a->place, &base, out, 1, out)
                                       : CELSPAN_OK;
}

/* The transform as a function, after those so far if it is added to them. */
static celspan_status write_transform(applying *a, const cs_svg_mixed *made, bool adds) {
  const char *numbers, *before = "";
  if (adds) {
    CS_TRY(need_base(a));
    before = cs_svg_is_word(a->text, "none") ? "" : a->text;
  }
  cs_svg_mixed bare = *made;
  bare.text = NULL;
  CS_TRY(cs_svg_mixed_write(&a->place, &bare, &numbers));
  if (!numbers)
    return CELSPAN_OK;
  if (strlen(before) > SUM)
    return cs_fail(a->reading->context, CELSPAN_LIMIT,
                   "line %u: too many transforms are added to each other", a->it->node->line);
  size_t size = strlen(before) + strlen(numbers) + 16;
  char *text = cs_arena_take(a->reading->context, a->place.arena, size);
  if (!text)
    return CELSPAN_NO_MEMORY;
  strcpy(text, before);
  strcat(text, " ");
  strcat(text, transforms[a->transform].word);
  strcat(text, "(");
  strcat(text, numbers);
  strcat(text, ")");
  a->text = text;
  return CELSPAN_OK;
}

static celspan_status apply_animate(applying *a) {
  cs_svg_mixed made, last;
  bool counts, has_values = value(a, CS_SVG_VALUES);
  bool is_to = !has_values && !value(a, CS_SVG_FROM) && value(a, CS_SVG_TO);
  bool is_by = !has_values && !value(a, CS_SVG_FROM) && !is_to;
  CS_TRY(has_values ? list_value(a, &made, &last, &counts) : ends_value(a, &made, &last, &counts));
  if (!counts)
    return CELSPAN_OK;
  if (is_word_value(a, CS_SVG_ACCUMULATE, "sum") && !is_to && a->progress->round > 0 &&
      cs_svg_mixed_fits(&made, &last))
    CS_TRY(cs_svg_mixed_add(&a->place, &made, &last, a->progress->round, &made));
  bool adds = is_by || (is_word_value(a, CS_SVG_ADDITIVE, "sum") && !is_to);
  if (a->transform >= 0)
    return write_transform(a, &made, adds);
  if (adds && made.frame)
    CS_TRY(add_to_base(a, &made));
  const char *text;
  CS_TRY(cs_svg_mixed_write(&a->place, &made, &text));
  a->text = text ? text : a->text;
  return CELSPAN_OK;
}

/* The kind of animateTransform. False: it is unknown. */
static bool find_transform(applying *a) {
  const char *type = value(a, CS_SVG_TYPE);
  a->transform = -1;
  if (a->it->node->element != CS_SVG_ELEMENT_ANIMATE_TRANSFORM)
    return true;
  for (int i = 0; i < (int)(sizeof transforms / sizeof *transforms); i++)
    if (cs_svg_is_word(type ? type : "translate", transforms[i].word))
      a->transform = i;
  return a->transform >= 0;
}

celspan_status cs_svg_animate(cs_svg_reading *reading, const cs_svg_animation *animation,
                              const cs_svg_progress *progress, const char **text) {
  applying a = {.reading = reading,
                .it = animation,
                .progress = progress,
                .place = cs_svg_motion_place(reading, animation->node),
                .text = *text};
  const char *to = value(&a, CS_SVG_TO);
  if (animation->node->element == CS_SVG_ELEMENT_SET)
    a.text = to ? to : a.text;
  else if (find_transform(&a))
    CS_TRY(apply_animate(&a));
  *text = a.text;
  return CELSPAN_OK;
}
