/* The animations of styles: @keyframes, and the properties that begin with `animation`. */
#include "readers/svg/motion/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "inside/sort.h"
#include "readers/svg/document/cascade.h"
#include "readers/svg/motion/motion_compose.h"
#include "readers/svg/motion/motion_easing.h"
#include "readers/svg/motion/motion_targets.h"
#include "readers/svg/motion/motion_values.h"
#include "readers/svg/words/forms.h"

#define ANIMATIONS 64 /* the most of one element */

/* One animation of an element. */
typedef struct animation {
  const cs_css_frames *frames; /* NULL: none of this name */
  double duration, delay, rounds;
  bool begins_backward, alternates, fills_before, fills_after, is_paused;
  cs_svg_easing easing;
  cs_svg_composition composition;
} animation;

/* A frame of one property. */
typedef struct frame {
  double at;
  size_t order;
  const char *value; /* NULL: the value without the animation */
  cs_svg_easing easing;
  cs_svg_composition composition;
} frame;

typedef struct animating {
  cs_svg_reading *reading;
  cs_svg_extent *extent;
  cs_svg_node *node;
  const cs_svg_cascade *from;
  cs_css_place place;
} animating;

/* ---------------------------------------------------------------- lists of words */

/* The end of an item of a list: the next comma outside of parentheses. */
static const char *item_end(const char *text) {
  int depth = 0;
  for (; *text && (*text != ',' || depth > 0); text++)
    depth += (*text == '(') - (*text == ')');
  return text;
}

static size_t count_items(const char *text) {
  size_t count = 1;
  for (text = item_end(text); *text; text = item_end(text + 1))
    count++;
  return count;
}

/* Item i of a list, which begins again after its end. */
static const char *item_at(const char *text, size_t i) {
  for (i %= count_items(text); i > 0; i--)
    text = item_end(text) + 1;
  return cs_svg_skip_space(text);
}

/* ---------------------------------------------------------------- one animation */

/* A word that ends with its item: "ease" is no part of the name "ease.2". */
static bool take_keyword(const char **text, const char *word) {
  const char *at = *text;
  if (!cs_svg_take_word(&at, word) || (*at && *at != ',' && !cs_svg_is_space(*at)))
    return false;
  *text = at;
  return true;
}

static bool take_time(const char **text, double *out) {
  const char *at = *text;
  double time;
  if (!cs_svg_take_number(&at, &time))
    return false;
  bool is_short = cs_svg_take_word(&at, "ms");
  if (!is_short && !cs_svg_take_word(&at, "s"))
    return false;
  *out = is_short ? time / 1000 : time;
  *text = at;
  return true;
}

/* Which of four words comes next, so that its number is made of two flags. */
static bool take_flags(const char **text, const char *const words[4], bool *low, bool *high) {
  for (int i = 0; i < 4; i++)
    if (take_keyword(text, words[i])) {
      *low = i & 1;
      *high = i > 1;
      return true;
    }
  return false;
}

static bool take_direction(const char **text, animation *out) {
  static const char *const words[] = {"normal", "reverse", "alternate", "alternate-reverse"};
  return take_flags(text, words, &out->begins_backward, &out->alternates);
}

static bool take_fill(const char **text, animation *out) {
  static const char *const words[] = {"none", "forwards", "backwards", "both"};
  return take_flags(text, words, &out->fills_after, &out->fills_before);
}

static bool take_state(const char **text, animation *out) {
  bool is_paused = take_keyword(text, "paused");
  if (!is_paused && !take_keyword(text, "running"))
    return false;
  out->is_paused = is_paused;
  return true;
}

static bool take_composition(const char **text, cs_svg_composition *out) {
  static const char *const words[] = {"replace", "add", "accumulate"};
  for (int i = 0; i < 3; i++)
    if (take_keyword(text, words[i])) {
      *out = (cs_svg_composition)i;
      return true;
    }
  return false;
}

static bool take_rounds(const char **text, animation *out) {
  double rounds = INFINITY;
  const char *at = *text;
  if (!take_keyword(&at, "infinite") && (!cs_svg_take_number(&at, &rounds) || rounds < 0))
    return false;
  out->rounds = rounds;
  *text = at;
  return true;
}

/* The frames of the name at *text, which is moved after it. */
static const cs_css_frames *take_name(const cs_css_sheet *sheet, const char **text) {
  const char quote = **text == '"' || **text == '\'' ? *(*text)++ : 0;
  size_t size = quote ? strcspn(*text, "\"'") : strcspn(*text, " \t\r\n\f,");
  const char *name = *text;
  *text += size + (quote && name[size]);
  for (size_t i = sheet->frames_count; i > 0; i--) {
    const char *known = sheet->frames[i - 1].name;
    if (strncmp(known, name, size) == 0 && !known[size])
      return &sheet->frames[i - 1];
  }
  return NULL;
}

/* An item of `animation`: what is no other value is the name. With two names it is invalid. */
static void read_shorthand(const cs_css_sheet *sheet, const char *text, animation *out) {
  int times = 0;
  bool has_rounds = false, has_easing = false, has_fill = false, has_name = false;
  for (text = cs_svg_skip_space(text); *text && *text != ','; text = cs_svg_skip_space(text)) {
    double *time = times == 0 ? &out->duration : &out->delay;
    if (times < 2 && take_time(&text, time))
      times++;
    else if (!has_rounds && take_rounds(&text, out))
      has_rounds = true;
    else if (!has_easing && cs_svg_take_easing(&text, &out->easing))
      has_easing = true;
    else if (!has_fill && take_fill(&text, out))
      has_fill = true;
    else if (!take_direction(&text, out) && !take_state(&text, out)) {
      out->frames = has_name ? NULL : take_name(sheet, &text);
      if (has_name)
        return;
      has_name = true;
    }
    if (*text && *text != ',' && !cs_svg_is_space(*text))
      return; /* not a list of words */
  }
}

/* The properties for one thing each, which win over the shorthand before them. */
static void read_parts(const animating *a, size_t i, animation *out) {
  const char *const *values = a->from->values;
  const char *text;
  if (values[CS_SVG_ANIMATION_NAME]) {
    text = item_at(values[CS_SVG_ANIMATION_NAME], i);
    out->frames = take_name(&a->reading->document->sheet, &text);
  }
  if (values[CS_SVG_ANIMATION_DURATION] && (text = item_at(values[CS_SVG_ANIMATION_DURATION], i)))
    (void)take_time(&text, &out->duration);
  if (values[CS_SVG_ANIMATION_DELAY] && (text = item_at(values[CS_SVG_ANIMATION_DELAY], i)))
    (void)take_time(&text, &out->delay);
  if (values[CS_SVG_ANIMATION_ITERATION_COUNT] &&
      (text = item_at(values[CS_SVG_ANIMATION_ITERATION_COUNT], i)))
    (void)take_rounds(&text, out);
  if (values[CS_SVG_ANIMATION_DIRECTION] && (text = item_at(values[CS_SVG_ANIMATION_DIRECTION], i)))
    (void)take_direction(&text, out);
  if (values[CS_SVG_ANIMATION_FILL_MODE] && (text = item_at(values[CS_SVG_ANIMATION_FILL_MODE], i)))
    (void)take_fill(&text, out);
  if (values[CS_SVG_ANIMATION_PLAY_STATE] &&
      (text = item_at(values[CS_SVG_ANIMATION_PLAY_STATE], i)))
    (void)take_state(&text, out);
  if (values[CS_SVG_ANIMATION_TIMING_FUNCTION] &&
      (text = item_at(values[CS_SVG_ANIMATION_TIMING_FUNCTION], i)))
    (void)cs_svg_take_easing(&text, &out->easing);
  if (values[CS_SVG_ANIMATION_COMPOSITION] &&
      (text = item_at(values[CS_SVG_ANIMATION_COMPOSITION], i)))
    (void)take_composition(&text, &out->composition);
}

static animation read_animation(const animating *a, size_t i) {
  animation made = {.rounds = 1};
  const char *shorthand = a->from->values[CS_SVG_ANIMATION];
  const char *ease = "ease";
  (void)cs_svg_take_easing(&ease, &made.easing);
  if (shorthand)
    read_shorthand(&a->reading->document->sheet, item_at(shorthand, i), &made);
  read_parts(a, i, &made);
  made.duration = fmax(0, made.duration);
  return made;
}

/* ---------------------------------------------------------------- times */

static void add_extent(const animation *it, cs_svg_extent *out) {
  double end = it->delay + (it->duration > 0 ? it->duration * it->rounds : 0);
  if (it->is_paused)
    return;
  if (end < INFINITY)
    out->end = fmax(out->end, end);
  else
    out->period = fmax(out->period, it->duration * (it->alternates ? 2 : 1));
}

/* The share of the round at `seconds`, as the direction has it. False: there is no effect. Source:
 * Web Animations Level 1, 4.7 to 4.10. */
static bool find_share(const animation *it, double seconds, double *share, bool *is_before) {
  double local = (it->is_paused ? 0 : seconds) - it->delay;
  double active = it->duration > 0 ? it->duration * it->rounds : 0;
  bool is_after = local >= active;
  *is_before = local < 0;
  if ((*is_before && !it->fills_before) || (!*is_before && is_after && !it->fills_after))
    return false;
  double whole = *is_before ? 0 : is_after ? it->rounds : local / it->duration;
  double round = whole < INFINITY ? floor(whole) : 0;
  *share = whole < INFINITY ? whole - round : 1;
  if (*share == 0 && is_after && !*is_before && whole > 0) {
    *share = 1;
    round--;
  }
  bool is_odd = fmod(round, 2) == 1;
  bool is_backward = it->begins_backward != (it->alternates && is_odd);
  *share = is_backward ? 1 - *share : *share;
  *is_before = *is_before ? !is_backward : is_after && is_backward;
  return true;
}

/* ---------------------------------------------------------------- values of a property */

/* `none` is no change, and the second number of translate and scale may be left out. */
static celspan_status complete(animating *a, cs_svg_name name, cs_svg_mixed *value) {
  bool is_scale = name == CS_SVG_SCALE, is_pair = is_scale || name == CS_SVG_TRANSLATE;
  size_t count = is_pair ? 2 : name == CS_SVG_ROTATE ? 1 : 0;
  if (value->count >= count || (value->count > 0 && strchr(value->text, '%')))
    return CELSPAN_OK;
  double first = value->count > 0 ? value->numbers[0].value : 1;
  const double missing[2] = {is_scale ? first : 0, is_scale ? first : 0};
  return cs_svg_mixed_fit(&a->place, missing, count, value);
}

/* The value of an end of a pair, with variables replaced. Errors: NO_MEMORY, LIMIT. */
static celspan_status read_end(animating *a, cs_svg_name name, const char *text,
                               cs_svg_mixed *out) {
  if (text && cs_svg_has_variable(text))
    CS_TRY(cs_svg_variable_fill(&a->reading->document->variables, a->from->variables, text, &text));
  if (cs_svg_is_word(text, "currentColor"))
    CS_TRY(cs_svg_motion_base(a->reading, a->node, CS_SVG_COLOR, &text));
  if (!text)
    CS_TRY(cs_svg_motion_base(a->reading, a->node, name, &text));
  CS_TRY(cs_svg_motion_count(a->reading, a->node, strlen(text)));
  CS_TRY(cs_svg_mixed_read(&a->place, name, text, out));
  return complete(a, name, out);
}

/* The value of a frame, added to the one without the animation if it asks for that. */
static celspan_status read_frame(animating *a, cs_svg_name name, const frame *it,
                                 cs_svg_mixed *out) {
  cs_svg_mixed under;
  CS_TRY(read_end(a, name, it->value, out));
  if (!it->value || it->composition == CS_SVG_COMPOSITION_REPLACE)
    return CELSPAN_OK;
  CS_TRY(read_end(a, name, NULL, &under));
  return cs_svg_motion_compose(&a->place, name, it->composition, &under, out);
}

/* Between two values of visibility, the one that is seen counts. */
static bool is_shown(cs_svg_name name, const cs_svg_mixed *from) {
  return name == CS_SVG_VISIBILITY && cs_svg_is_word(from->text, "visible");
}

/* Gives the property a value between two others; those that do not mix change in the middle. */
static celspan_status give_between(animating *a, cs_svg_name name, const frame *low,
                                   const frame *high, double share) {
  cs_svg_mixed from, to, made;
  const char *text;
  CS_TRY(read_frame(a, name, low, &from));
  CS_TRY(read_frame(a, name, high, &to));
  made = is_shown(name, &to) || (share >= 0.5 && !is_shown(name, &from)) ? to : from;
  if (share == 0 || share == 1)
    made = share == 0 ? from : to;
  else if (cs_svg_mixed_fits(&from, &to))
    CS_TRY(cs_svg_mixed_mix(&a->place, &from, &to, share, true, &made));
  else if (cs_svg_name_facts_of(name)->form == CS_SVG_FORM_TRANSFORM)
    CS_TRY(cs_svg_matrices_mix(&a->place, &from, &to, share, &made));
  CS_TRY(cs_svg_mixed_write(&a->place, &made, &text));
  return text ? cs_svg_motion_give(a->reading, a->node, name, text) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- frames of a property */

static int compare_frames(const void *a, const void *b) {
  const frame *first = a, *second = b;
  int order = CS_SORT_ORDER(first->at, second->at);
  return order ? order : CS_SORT_ORDER(first->order, second->order);
}

/* A frame of the property; without a value: the declarations do not give it. */
static frame frame_of(const cs_css_frame *it, size_t order, cs_svg_name name, const animation *of) {
  frame found = {it->at, order, NULL, of->easing, of->composition};
  for (size_t k = 0; k < it->declarations.count; k++) {
    const cs_css_declaration *declaration = &it->declarations.items[k];
    const char *text = declaration->value;
    if (declaration->is_important)
      continue;
    if (declaration->name == CS_SVG_ANIMATION_TIMING_FUNCTION)
      (void)cs_svg_take_easing(&text, &found.easing);
    else if (declaration->name == CS_SVG_ANIMATION_COMPOSITION)
      (void)take_composition(&text, &found.composition);
    else if (declaration->name == name)
      found.value = text;
  }
  return found;
}

/* Of frames at the same share with the same easing and composition, the last one counts. Source:
 * CSS Animations Level 2, 3. */
static size_t drop_replaced(frame *list, size_t count) {
  size_t left = 0;
  for (size_t i = 0; i < count; i++)
    if (i + 1 == count || list[i + 1].at != list[i].at ||
        list[i + 1].composition != list[i].composition ||
        !cs_svg_easings_equal(&list[i + 1].easing, &list[i].easing))
      list[left++] = list[i];
  return left;
}

/* The frames that give the property, sorted, with one at 0 and one at 1. list: has room. */
static size_t list_frames(const animation *it, cs_svg_name name, frame *list) {
  size_t count = 0;
  bool begins = false, ends = false;
  for (size_t i = 0; i < it->frames->count; i++) {
    const frame found = frame_of(&it->frames->items[i], i + 1, name, it);
    if (!found.value)
      continue;
    begins = begins || found.at == 0;
    ends = ends || found.at == 1;
    list[count++] = found;
  }
  if (!begins)
    list[count++] = (frame){.at = 0, .easing = it->easing};
  if (!ends)
    list[count++] = (frame){.at = 1, .easing = it->easing};
  qsort(list, count, sizeof *list, compare_frames);
  return drop_replaced(list, count);
}

/* The frame at or before a share, which another one follows. */
static size_t find_frame(const frame *list, size_t count, double share) {
  size_t low = 0;
  while (low + 2 < count && list[low + 1].at <= share)
    low++;
  return low;
}

/* list: has room for two more frames than the animation has. */
static celspan_status move_property(animating *a, const animation *it, cs_svg_name name,
                                    double share, bool is_before, frame *list) {
  const size_t count = list_frames(it, name, list);
  const frame *low = &list[find_frame(list, count, share)], *high = low + 1;
  CS_TRY(cs_svg_motion_count(a->reading, a->node, low->easing.size));
  double span = high->at - low->at, local = span > 0 ? (share - low->at) / span : 1;
  return give_between(a, name, low, high, cs_svg_ease(&low->easing, local, is_before));
}

/* ---------------------------------------------------------------- elements */

/* Moves the properties that a frame gives, and that are not yet done. */
static celspan_status move_frame(animating *a, const animation *it,
                                 const cs_css_declarations *given, double share, bool is_before,
                                 frame *list, bool *is_done) {
  for (size_t k = 0; k < given->count; k++) {
    cs_svg_name name = given->items[k].name;
    bool is_timing = name >= CS_SVG_ANIMATION && name <= CS_SVG_ANIMATION_TIMING_FUNCTION;
    if (given->items[k].custom || is_timing || given->items[k].is_important || is_done[name])
      continue;
    is_done[name] = true;
    CS_TRY(cs_svg_motion_count(a->reading, a->node, it->frames->size));
    CS_TRY(move_property(a, it, name, share, is_before, list));
  }
  return CELSPAN_OK;
}

/* Moves all properties that the frames give, each once. */
static celspan_status move_all(animating *a, const animation *it, double share, bool is_before) {
  bool is_done[CS_SVG_NAME_COUNT] = {false};
  celspan_context *context = a->reading->context;
  size_t room = it->frames->count + 2;
  frame *list;
  CS_TRY(cs_svg_motion_count(a->reading, a->node, it->frames->size));
  CS_TRY(CS_MAKE(context, list, room));
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; i < it->frames->count && status == CELSPAN_OK; i++)
    status = move_frame(a, it, &it->frames->items[i].declarations, share, is_before, list, is_done);
  cs_mem_free(context->memory, list, room * sizeof *list);
  return status;
}

/* The bytes and frames that are read for each animation of an element. */
static size_t cost_of(const animating *a) {
  size_t cost = a->reading->document->sheet.frames_count;
  for (int name = CS_SVG_ANIMATION; name <= CS_SVG_ANIMATION_TIMING_FUNCTION; name++)
    cost += a->from->values[name] ? strlen(a->from->values[name]) : 0;
  return cost;
}

/* Later animations win over those before them in the list. */
static celspan_status move_element(animating *a) {
  const char *names = a->from->values[CS_SVG_ANIMATION_NAME];
  const char *list = names ? names : a->from->values[CS_SVG_ANIMATION];
  size_t cost = list ? cost_of(a) : 0, count = list ? count_items(list) : 0;
  for (size_t i = 0; i < count && i < ANIMATIONS; i++) {
    CS_TRY(cs_svg_motion_count(a->reading, a->node, cost));
    const animation it = read_animation(a, i);
    double share;
    bool is_before;
    if (!it.frames)
      continue;
    add_extent(&it, a->extent);
    if (a->reading->seconds >= 0 && find_share(&it, a->reading->seconds, &share, &is_before))
      CS_TRY(move_all(a, &it, share, is_before));
  }
  if (count > ANIMATIONS)
    return cs_svg_skip(a->reading, a->node, "animations after the first %d", ANIMATIONS);
  return CELSPAN_OK;
}

/* Recursion: the depth of the document. */
static celspan_status visit(cs_svg_reading *reading, cs_svg_extent *extent, cs_svg_node *node,
                            const cs_svg_variable *inherited) {
  cs_svg_cascade from;
  CS_TRY(cs_svg_cascade_collect(reading->context, reading->document, node, inherited,
                                &reading->tests, &from));
  animating a = {reading, extent, node, &from, cs_svg_motion_place(reading, node)};
  CS_TRY(move_element(&a));
  for (cs_svg_node *child = node->first; child; child = child->next)
    if (child->element != CS_SVG_ELEMENT_CHARACTERS)
      CS_TRY(visit(reading, extent, child, from.variables));
  return CELSPAN_OK;
}

celspan_status cs_svg_keyframes_run(cs_svg_reading *reading, cs_svg_extent *extent) {
  return visit(reading, extent, reading->document->root, NULL);
}
