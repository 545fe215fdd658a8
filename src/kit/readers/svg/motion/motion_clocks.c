/* The attributes of time of animation elements: dur, begin, end, repeatCount, ... */
#include "readers/svg/motion/motion_smil.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "inside/sort.h"
#include "readers/svg/motion/motion_lists.h"

/* ---------------------------------------------------------------- times */

/* "1.5s", "200ms", "2min", "1h", "01:02:03.5", "02:03": seconds. */
static bool take_clock(const char **text, double *out) {
  static const struct {
    const char *word;
    double seconds;
  } units[] = {{"ms", 0.001}, {"s", 1}, {"min", 60}, {"h", 3600}};
  const char *at = *text;
  double next;
  if (*at == '-' || *at == '+' || !cs_svg_take_number(&at, out))
    return false;
  for (int i = 0; *at == ':' && i < 2; i++) {
    at++;
    if (!cs_svg_take_number(&at, &next) || next < 0 || next >= 60)
      return false;
    *out = *out * 60 + next;
  }
  for (size_t i = 0; i < sizeof units / sizeof *units; i++)
    if (cs_svg_take_word(&at, units[i].word)) {
      *out *= units[i].seconds;
      break;
    }
  *text = at;
  return true;
}

/* The whole of an attribute as a time above 0; INFINITY: indefinite. False: it does not count. */
static bool clock_of(const cs_svg_node *node, cs_svg_name name, double *out) {
  const char *text = cs_svg_node_value(node, name);
  if (!text)
    return false;
  *out = INFINITY;
  if (cs_svg_is_word(text, "indefinite") || cs_svg_is_word(text, "media"))
    return true;
  text = cs_svg_skip_space(text);
  return take_clock(&text, out) && !*cs_svg_skip_space(text) && *out > 0;
}

static bool count_of(const cs_svg_node *node, double *out) {
  const char *text = cs_svg_node_value(node, CS_SVG_REPEAT_COUNT);
  if (!text)
    return false;
  *out = INFINITY;
  if (cs_svg_is_word(text, "indefinite"))
    return true;
  text = cs_svg_skip_space(text);
  return cs_svg_take_number(&text, out) && *out > 0;
}

/* Source: SMIL 3.0, 5.4.5: the active duration. */
static void read_durations(const cs_svg_node *node, cs_svg_timing *out) {
  double count, limit, least, most;
  if (!clock_of(node, CS_SVG_DUR, &out->simple))
    out->simple = INFINITY;
  bool has_count = count_of(node, &count), has_limit = clock_of(node, CS_SVG_REPEAT_DUR, &limit);
  out->whole = !has_count && !has_limit ? out->simple : INFINITY;
  if (has_count && out->simple < INFINITY)
    out->whole = out->simple * count;
  if (has_limit)
    out->whole = fmin(out->whole, limit);
  out->least = clock_of(node, CS_SVG_MIN, &least) && least < INFINITY ? least : 0;
  out->most = clock_of(node, CS_SVG_MAX, &most) ? most : INFINITY;
  if (out->least > out->most) {
    out->least = 0;
    out->most = INFINITY;
  }
}

/* [+|-] time, or nothing. */
static bool take_offset(const char **text, double *out) {
  const char *at = cs_svg_skip_space(*text);
  const double sign = *at == '-' ? -1 : 1;
  *out = 0;
  if (!*at || *at == ';')
    return true;
  at = cs_svg_skip_space(at + (*at == '-' || *at == '+'));
  if (!take_clock(&at, out))
    return false;
  *out *= sign;
  *text = at;
  return true;
}

/* ---------------------------------------------------------------- moments */

static int compare_numbers(const void *key, const void *item) {
  const uint32_t number = *(const uint32_t *)key;
  return CS_SORT_ORDER(number, ((const cs_svg_animation *)item)->node->number);
}

/* The animation with this id; -1: there is none. */
static int32_t find(const cs_svg_animations *all, const char *id, size_t size) {
  const cs_svg_node *node = cs_svg_document_find(all->reading->document, id, size);
  const cs_svg_animation *found =
      node ? bsearch(&node->number, all->items, all->count, sizeof *all->items, compare_numbers)
           : NULL;
  return found ? (int32_t)(found - all->items) : -1;
}

/* The '.' before `word` in [text, end), of "id.begin + 1s"; NULL: none. */
static const char *dot_before(const char *text, const char *end, const char *word) {
  const size_t size = strlen(word);
  for (const char *at = text; at < end; at++)
    if (*at == '.' && at > text && strncmp(at + 1, word, size) == 0 &&
        (strchr(" \t\r\n+-;", at[size + 1])))
      return at;
  return NULL;
}

/* "id.begin+1s" in [text, end). */
static bool read_follower(const cs_svg_animations *all, const char *text, const char *end,
                          cs_svg_moment *out) {
  const char *begin = dot_before(text, end, "begin"), *finish = dot_before(text, end, "end");
  const char *dot = begin ? begin : finish;
  if (!dot)
    return false;
  *out = (cs_svg_moment){.after = find(all, text, (size_t)(dot - text)), .after_end = !begin};
  const char *at = dot + (begin ? 6 : 4);
  return out->after >= 0 && take_offset(&at, &out->offset) && cs_svg_skip_space(at) >= end;
}

static bool read_moment(const cs_svg_animations *all, const char *text, const char *end,
                        cs_svg_moment *out) {
  *out = (cs_svg_moment){.after = -1};
  const char *at = text;
  bool is_time = *text == '+' || *text == '-' || (*text >= '0' && *text <= '9') || *text == '.';
  if (is_time)
    return take_offset(&at, &out->offset) && cs_svg_skip_space(at) >= end;
  return read_follower(all, text, end, out);
}

static int compare_moments(const void *a, const void *b) {
  const cs_svg_moment *first = a, *second = b;
  int order = CS_SORT_ORDER(first->after >= 0, second->after >= 0);
  order = order ? order : CS_SORT_ORDER(first->offset, second->offset);
  return order ? order : CS_SORT_ORDER(first->after, second->after);
}

/* Reads begin or end; what only an event or a script gives is noted. *is_open: the list has it, or
 * "indefinite". */
static celspan_status read_moments(const cs_svg_animations *all, const cs_svg_node *node,
                                   cs_svg_name name, cs_svg_moment **list, size_t *count,
                                   bool *is_open) {
  const char *text = cs_svg_node_value(node, name);
  size_t parts = text ? cs_svg_list_count(text) : 0;
  *list = cs_arena_take(all->reading->context, &all->reading->document->arena,
                        (parts + 1) * sizeof **list);
  if (!*list)
    return CELSPAN_NO_MEMORY;
  bool is_noted = false;
  for (size_t i = 0; i < parts; i++) {
    text = cs_svg_skip_space(text);
    const char *end = text + strcspn(text, ";");
    const bool is_never = cs_svg_take_word(&(const char *){text}, "indefinite");
    bool is_read = read_moment(all, text, end, &(*list)[*count]);
    *count += is_read;
    *is_open = *is_open || !is_read;
    if (!is_read && !is_noted && !(is_never && name == CS_SVG_END)) {
      is_noted = true;
      CS_TRY(cs_svg_skip(all->reading, node, "%.40s: %s \"%.*s\" is not run", node->tag,
                         cs_svg_name_text(name), (int)(end - text > 40 ? 40 : end - text), text));
    }
    text = end + (*end == ';');
  }
  qsort(*list, *count, sizeof **list, compare_moments);
  return CELSPAN_OK;
}

celspan_status cs_svg_timing_read(const cs_svg_animations *all, const cs_svg_node *node,
                                  cs_svg_timing *out) {
  const char *restart = cs_svg_node_value(node, CS_SVG_RESTART);
  *out = (cs_svg_timing){.restart = CS_SVG_RESTART_ALWAYS};
  read_durations(node, out);
  if (cs_svg_is_word(restart, "never"))
    out->restart = CS_SVG_RESTART_NEVER;
  else if (cs_svg_is_word(restart, "whenNotActive"))
    out->restart = CS_SVG_RESTART_WHEN_NOT_ACTIVE;
  bool begin_is_open = false;
  CS_TRY(read_moments(all, node, CS_SVG_BEGIN, &out->begins, &out->begin_count, &begin_is_open));
  CS_TRY(read_moments(all, node, CS_SVG_END, &out->ends, &out->end_count, &out->end_is_open));
  if (!cs_svg_node_value(node, CS_SVG_BEGIN))
    out->begins[out->begin_count++] = (cs_svg_moment){.after = -1};
  return CELSPAN_OK;
}
