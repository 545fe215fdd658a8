#include "readers/svg/motion/motion_smil.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "inside/sort.h"
#include "readers/svg/motion/motion.h"
#include "readers/svg/words/silent.h"

/* The animations of a document, at its time. */
typedef struct run {
  cs_svg_reading *reading;
  cs_svg_animations all;
  cs_svg_timing *timings;
  cs_svg_interval *intervals;
} run;

/* ---------------------------------------------------------------- elements */

/* The name that attributeName gives. */
static cs_svg_name name_of(const cs_svg_node *node) {
  const char *text = cs_svg_node_value(node, CS_SVG_ATTRIBUTE_NAME);
  if (!text || node->element == CS_SVG_ELEMENT_ANIMATE_MOTION)
    return CS_SVG_NAME_COUNT;
  cs_svg_name name = cs_svg_name_of(strcmp(text, "xlink:href") == 0 ? "href" : text);
  bool is_transform = name == CS_SVG_TRANSFORM || name == CS_SVG_GRADIENT_TRANSFORM ||
                      name == CS_SVG_PATTERN_TRANSFORM;
  bool is_wrong = is_transform != (node->element == CS_SVG_ELEMENT_ANIMATE_TRANSFORM);
  return is_wrong || name == CS_SVG_ID || name == CS_SVG_STYLE ? CS_SVG_NAME_COUNT : name;
}

static celspan_status note_unknown(run *r, const cs_svg_animation *it) {
  const char *text = cs_svg_node_value(it->node, CS_SVG_ATTRIBUTE_NAME);
  if (it->node->element == CS_SVG_ELEMENT_ANIMATE_MOTION || it->name != CS_SVG_NAME_COUNT ||
      !text || cs_svg_name_is_silent(text, ""))
    return CELSPAN_OK;
  return cs_svg_skip(r->reading, it->node, "%.40s of %.40s", it->node->tag, text);
}

/* Recursion: the depth of the document. */
static celspan_status collect(run *r, cs_svg_node *node) {
  for (; node; node = node->next) {
    if (cs_svg_element_animates(node->element)) {
      const cs_svg_node *named = cs_svg_linked(r->reading, node);
      bool has_href = cs_svg_node_value(node, CS_SVG_HREF);
      cs_svg_animation *it = &r->all.items[r->all.count++];
      *it = (cs_svg_animation){.node = node,
                               .target = has_href ? (cs_svg_node *)(size_t)named : node->parent,
                               .name = name_of(node),
                               .freezes = cs_svg_node_says(node, CS_SVG_FILL, "freeze")};
      CS_TRY(note_unknown(r, it));
    }
    CS_TRY(collect(r, node->first));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- all of them */

/* An animation that has an effect at the time. */
typedef struct active {
  uint32_t target;
  cs_svg_name name;
  double begin;
  size_t index;
} active;

/* Those that began later win. */
static int compare_active(const void *a, const void *b) {
  const active *first = a, *second = b;
  int order = CS_SORT_ORDER(first->target, second->target);
  order = order ? order : CS_SORT_ORDER(first->name, second->name);
  order = order ? order : CS_SORT_ORDER(first->begin, second->begin);
  return order ? order : CS_SORT_ORDER(first->index, second->index);
}

/* Rounding of the end of a frozen animation must not begin another round. */
#define SAME_TIME 1e-9

/* Its end, or the end of what it repeats where min makes it longer. */
static double end_of(const run *r, size_t i) {
  const cs_svg_interval *interval = &r->intervals[i];
  return fmin(interval->end, interval->begin + r->timings[i].whole);
}

static bool is_running(const run *r, size_t i) {
  return r->intervals[i].is_active && r->reading->seconds < end_of(r, i);
}

static cs_svg_progress progress_of(const run *r, size_t i) {
  const cs_svg_interval *interval = &r->intervals[i];
  double simple = r->timings[i].simple;
  double end = is_running(r, i) ? r->reading->seconds : end_of(r, i);
  double rounds = simple < INFINITY ? (end - interval->begin) / simple : 0;
  cs_svg_progress at = {.round = floor(rounds)};
  at.share = rounds - at.round;
  if (!is_running(r, i) && at.round > 0 && at.share < SAME_TIME) {
    at.round--;
    at.share = 1;
  }
  return at;
}

static bool has_effect(const run *r, size_t i) {
  const cs_svg_animation *it = &r->all.items[i];
  bool is_motion = it->node->element == CS_SVG_ELEMENT_ANIMATE_MOTION;
  return it->target && (is_motion || it->name != CS_SVG_NAME_COUNT) && r->intervals[i].has_begun &&
         (is_running(r, i) || it->freezes);
}

static size_t list_active(const run *r, active *out) {
  size_t count = 0;
  for (size_t i = 0; i < r->all.count; i++)
    if (has_effect(r, i))
      out[count++] =
          (active){r->all.items[i].target->number, r->all.items[i].name, r->intervals[i].begin, i};
  if (count > 0)
    qsort(out, count, sizeof *out, compare_active);
  return count;
}

/* Gives an element what a group of animations of one of its attributes makes. */
static celspan_status apply_group(run *r, const active *list, size_t count) {
  const cs_svg_animation *first = &r->all.items[list[0].index];
  const char *text = NULL;
  const celspan_matrix *motion = NULL;
  for (size_t i = 0; i < count; i++) {
    cs_svg_progress progress = progress_of(r, list[i].index);
    const cs_svg_animation *it = &r->all.items[list[i].index];
    if (first->name == CS_SVG_NAME_COUNT)
      CS_TRY(cs_svg_motion_path(r->reading, it, &progress, &motion));
    else
      CS_TRY(cs_svg_animate(r->reading, it, &progress, &text));
  }
  if (first->name == CS_SVG_NAME_COUNT)
    first->target->motion = motion;
  else if (text && first->name != CS_SVG_TRANSFORM &&
           cs_svg_name_facts_of(first->name)->use == CS_SVG_USE_PRESENTED)
    return cs_svg_motion_give(r->reading, first->target, first->name, text);
  else if (text)
    return cs_svg_motion_set(r->reading, first->target, first->name, text);
  return CELSPAN_OK;
}

static celspan_status apply_all(run *r) {
  celspan_context *context = r->reading->context;
  active *list = cs_arena_take(context, &r->reading->document->arena, r->all.count * sizeof *list);
  if (!list)
    return CELSPAN_NO_MEMORY;
  size_t count = list_active(r, list);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1;
         end < count && list[end].target == list[i].target && list[end].name == list[i].name;)
      end++;
    CS_TRY(apply_group(r, &list[i], end - i));
  }
  return CELSPAN_OK;
}

celspan_status cs_svg_smil_run(cs_svg_reading *reading, cs_svg_extent *extent) {
  cs_svg_document *document = reading->document;
  celspan_context *context = reading->context;
  size_t count = document->animation_count;
  run r = {.reading = reading, .all = {.reading = reading}};
  r.all.items = cs_arena_take(context, &document->arena, count * sizeof *r.all.items);
  r.timings = cs_arena_take(context, &document->arena, count * sizeof *r.timings);
  r.intervals = cs_arena_take(context, &document->arena, count * sizeof *r.intervals);
  if (!r.all.items || !r.timings || !r.intervals)
    return CELSPAN_NO_MEMORY;
  CS_TRY(collect(&r, document->root));
  for (size_t i = 0; i < r.all.count; i++)
    CS_TRY(cs_svg_timing_read(&r.all, r.all.items[i].node, &r.timings[i]));
  CS_TRY(cs_svg_times_measure(context, r.timings, r.all.count, extent));
  if (reading->seconds < 0)
    return CELSPAN_OK;
  CS_TRY(cs_svg_times_run(context, r.timings, r.all.count, reading->seconds, r.intervals));
  return apply_all(&r);
}
