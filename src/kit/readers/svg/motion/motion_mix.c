/* The elements whose styles name animations, and the values of attributes and properties. */
#include "readers/svg/motion/motion.h"

#include <string.h>

#include "readers/svg/words/forms.h"

/* ---------------------------------------------------------------- elements with styles */

/* The bytes and frames that are read for the animations of the visited element. */
static size_t cost_of(const cs_svg_mover *mover) {
  size_t cost = mover->reading->document->sheet.frames_count;
  for (int name = CS_SVG_ANIMATION; name <= CS_SVG_ANIMATION_TIMING_FUNCTION; name++)
    cost += mover->styles->values[name] ? strlen(mover->styles->values[name]) : 0;
  return cost;
}

/* Recursion: the depth of the document. */
static celspan_status visit(cs_svg_mover *mover, cs_svg_node *node,
                            const cs_svg_variable *inherited, cs_svg_mover_visited visited,
                            void *user) {
  cs_svg_reading *reading = mover->reading;
  cs_svg_cascade styles;
  CS_TRY(cs_svg_cascade_collect(reading->context, reading->document, node, inherited,
                                &reading->tests, &styles));
  if (styles.values[CS_SVG_ANIMATION] || styles.values[CS_SVG_ANIMATION_NAME]) {
    mover->node = node;
    mover->styles = &styles;
    CS_TRY(cs_svg_motion_count(reading, node, cost_of(mover)));
    CS_TRY(visited(user));
    mover->styles = NULL;
  }
  for (cs_svg_node *child = node->first; child; child = child->next)
    if (child->element != CS_SVG_ELEMENT_CHARACTERS)
      CS_TRY(visit(mover, child, styles.variables, visited, user));
  return CELSPAN_OK;
}

celspan_status cs_svg_mover_visit(cs_svg_mover *mover, cs_svg_mover_visited visited, void *user) {
  const cs_svg_document *document = mover->reading->document;
  return document->has_motion ? visit(mover, document->root, NULL, visited, user) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- values */

/* In styles `none` is no change, and the second number of translate and scale may be left out. */
static celspan_status complete(const cs_css_place *place, cs_svg_name name, cs_svg_mixed *value) {
  bool is_scale = name == CS_SVG_SCALE, is_pair = is_scale || name == CS_SVG_TRANSLATE;
  size_t count = is_pair ? 2 : name == CS_SVG_ROTATE ? 1 : 0;
  if (value->count >= count || (value->count > 0 && strchr(value->text, '%')))
    return CELSPAN_OK;
  double first = value->count > 0 ? value->numbers[0].value : 1;
  const double missing[2] = {is_scale ? first : 0, is_scale ? first : 0};
  return cs_svg_mixed_fit(place, missing, count, value);
}

/* text: NULL: the value without the animation. */
static celspan_status read_value(cs_svg_mover *mover, const cs_svg_animation *it, const char *text,
                                 cs_svg_mixed *out) {
  cs_svg_reading *reading = mover->reading;
  const cs_css_place place = cs_svg_motion_place(reading, it->node);
  const cs_svg_node *parent = it->target->parent;
  if (text && mover->styles && cs_svg_has_variable(text))
    CS_TRY(
        cs_svg_variable_fill(&reading->document->variables, mover->styles->variables, text, &text));
  if (cs_svg_is_word(text, "currentColor"))
    CS_TRY(cs_svg_motion_base(reading, it->target, CS_SVG_COLOR, &text));
  else if (!mover->styles && cs_svg_is_word(text, "inherit") && parent)
    CS_TRY(cs_svg_motion_base(reading, parent, it->name, &text));
  else if (!text)
    CS_TRY(cs_svg_motion_base(reading, it->target, it->name, &text));
  CS_TRY(cs_svg_motion_count(reading, it->node, strlen(text)));
  CS_TRY(cs_svg_mixed_read(&place, it->name, text, out));
  return mover->styles ? complete(&place, it->name, out) : CELSPAN_OK;
}

/* Adds the value without the animation to an end that asks for it. */
static celspan_status compose(cs_svg_mover *mover, const cs_svg_animation *it,
                              const cs_svg_end *end, cs_svg_mixed *value) {
  const cs_css_place place = cs_svg_motion_place(mover->reading, it->node);
  cs_svg_mixed under;
  if (!end->text || end->composition == CS_SVG_COMPOSITION_REPLACE)
    return CELSPAN_OK;
  CS_TRY(read_value(mover, it, NULL, &under));
  return cs_svg_motion_compose(&place, it->name, end->composition, &under, value);
}

/* The two ends, with what is added to them. */
static celspan_status read_ends(cs_svg_mover *mover, const cs_svg_animation *it,
                                const cs_svg_mixture *given, cs_svg_mixed ends[2]) {
  const cs_css_place place = cs_svg_motion_place(mover->reading, it->node);
  CS_TRY(read_value(mover, it, given->from.text, &ends[0]));
  CS_TRY(read_value(mover, it, given->to.text, &ends[1]));
  if (given->is_by && cs_svg_mixed_fits(&ends[0], &ends[1]))
    CS_TRY(cs_svg_mixed_add(&place, &ends[0], &ends[1], 1, &ends[1]));
  cs_svg_mixed last = ends[1];
  if (given->round > 0 && given->last)
    CS_TRY(read_value(mover, it, given->last, &last));
  for (int i = 0; i < 2; i++) {
    if (given->round > 0 && cs_svg_mixed_fits(&ends[i], &last))
      CS_TRY(cs_svg_mixed_add(&place, &ends[i], &last, given->round, &ends[i]));
    CS_TRY(compose(mover, it, i == 0 ? &given->from : &given->to, &ends[i]));
  }
  return CELSPAN_OK;
}

/* Between two values of visibility, the one that is seen counts. */
static bool is_shown(cs_svg_name name, const cs_svg_mixed *value) {
  return name == CS_SVG_VISIBILITY && cs_svg_is_word(value->text, "visible");
}

static celspan_status mix(const cs_svg_mover *mover, const cs_svg_animation *it,
                          const cs_svg_mixed *from, const cs_svg_mixed *to, double share,
                          cs_svg_mixed *out) {
  const cs_css_place place = cs_svg_motion_place(mover->reading, it->node);
  *out = is_shown(it->name, to) || (share >= 0.5 && !is_shown(it->name, from)) ? *to : *from;
  if (share == 0 || share == 1)
    *out = share == 0 ? *from : *to;
  else if (cs_svg_mixed_fits(from, to))
    return cs_svg_mixed_mix(&place, from, to, share, mover->styles, out);
  else if (cs_svg_name_facts_of(it->name)->form == CS_SVG_FORM_TRANSFORM)
    return cs_svg_matrices_mix(&place, from, to, share, out);
  return CELSPAN_OK;
}

celspan_status cs_svg_mover_mix(cs_svg_mover *mover, const cs_svg_animation *it,
                                const cs_svg_mixture *given) {
  const cs_css_place place = cs_svg_motion_place(mover->reading, it->node);
  cs_svg_mixed ends[2], made;
  const char *text;
  CS_TRY(read_ends(mover, it, given, ends));
  CS_TRY(mix(mover, it, &ends[0], &ends[1], given->share, &made));
  CS_TRY(cs_svg_mixed_write(&place, &made, &text));
  if (!text)
    return CELSPAN_OK;
  text = cs_css_copy(&place, text, text + strlen(text)); /* it may be the caller's */
  if (!text)
    return CELSPAN_NO_MEMORY;
  bool is_property =
      cs_svg_name_facts_of(it->name)->use == CS_SVG_USE_PRESENTED && it->name != CS_SVG_TRANSFORM;
  return is_property || mover->styles
             ? cs_svg_motion_give(mover->reading, it->target, it->name, text)
             : cs_svg_motion_set(mover->reading, it->target, it->name, text);
}

celspan_status cs_svg_mover_distance(cs_svg_mover *mover, const cs_svg_animation *it, const char *a,
                                     const char *b, double *out, bool *mixes) {
  cs_svg_mixed first, second;
  CS_TRY(read_value(mover, it, b, &second));
  first = second;
  if (strcmp(a, b) != 0)
    CS_TRY(read_value(mover, it, a, &first));
  *out = cs_svg_mixed_distance(&first, &second);
  *mixes = second.frame;
  return CELSPAN_OK;
}
