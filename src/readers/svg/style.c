#include "readers/svg/style.h"

#include <string.h>

#include "base/number.h"

/* The value that wins for each property; NULL: none is given. */
typedef struct cascade {
  const char *values[CS_SVG_NAME_COUNT];
} cascade;

/* ---------------------------------------------------------------- selectors */

/* Whether one of the words of `list` is `word`. */
static bool has_class(const char *list, const char *word) {
  size_t size = strlen(word);
  for (const char *at = cs_svg_skip_space(list); *at; at = cs_svg_skip_space(at)) {
    size_t length = strcspn(at, " \t\n\f\r");
    if (length == size && memcmp(at, word, size) == 0)
      return true;
    at += length;
  }
  return false;
}

/* Whether an attribute's value is as a condition of a selector asks. */
static bool fits_condition(const cs_css_condition *condition, const char *value) {
  if (!value || !condition->comparison)
    return value;
  size_t size = strlen(condition->value), length = strlen(value);
  bool begins = strncmp(value, condition->value, size) == 0;
  switch (condition->comparison) {
  case '=':
    return strcmp(value, condition->value) == 0;
  case '~':
    return size > 0 && has_class(value, condition->value);
  case '|':
    return begins && (value[size] == 0 || value[size] == '-');
  case '^':
    return size > 0 && begins;
  case '$':
    return size > 0 && length >= size && strcmp(value + length - size, condition->value) == 0;
  default:
    return size > 0 && strstr(value, condition->value);
  }
}

static bool fits_compound(const cs_css_compound *compound, const cs_svg_node *node) {
  if (compound->element && strcmp(compound->element, node->tag) != 0)
    return false;
  const char *id = compound->id ? cs_svg_node_value(node, CS_SVG_ID) : NULL;
  if (compound->id && (!id || strcmp(compound->id, id) != 0))
    return false;
  const char *classes = compound->class_count > 0 ? cs_svg_node_value(node, CS_SVG_CLASS) : "";
  for (size_t i = 0; i < compound->class_count; i++)
    if (!classes || !has_class(classes, compound->classes[i]))
      return false;
  for (size_t i = 0; i < compound->condition_count; i++)
    if (!fits_condition(&compound->conditions[i],
                        cs_svg_node_value(node, compound->conditions[i].name)))
      return false;
  return true;
}

/* Whether the first `count` compounds fit the element and what it is in. */
static bool fits_chain(const cs_css_rule *rule, size_t count, const cs_svg_node *node,
                       uint64_t *tests) {
  if (*tests == 0 || --*tests == 0 || !fits_compound(&rule->compounds[count - 1], node))
    return false;
  if (count == 1)
    return true;
  bool is_child = rule->compounds[count - 1].is_child;
  for (const cs_svg_node *above = node->parent; above; above = is_child ? NULL : above->parent)
    if (fits_chain(rule, count - 1, above, tests))
      return true;
  return false;
}

/* ---------------------------------------------------------------- paints */

static bool take_paint_colour(const char **text, cs_svg_paint *out) {
  if (cs_svg_take_word(text, "none"))
    out->kind = CS_SVG_PAINT_NONE;
  else if (cs_svg_take_word(text, "currentColor"))
    out->kind = CS_SVG_PAINT_CURRENT;
  else if (cs_svg_take_colour(text, &out->colour))
    out->kind = CS_SVG_PAINT_COLOUR;
  else
    return false;
  return true;
}

/* Parses a paint; false: it is invalid. */
static bool parse_paint(const char *text, cs_svg_paint *out) {
  *out = (cs_svg_paint){.kind = CS_SVG_PAINT_NONE};
  text = cs_svg_skip_space(text);
  out->has_server = cs_svg_take_reference(&text, &out->server);
  text = cs_svg_skip_space(text);
  bool has_colour = *text && take_paint_colour(&text, out);
  out->has_fallback = out->has_server && has_colour;
  /* Only an ICC profile may follow; it is passed over. */
  text = cs_svg_skip_space(text);
  return out->has_server || (has_colour && (!*text || strncmp(text, "icc-color", 9) == 0));
}

static bool is_paint(const char *text) {
  cs_svg_paint paint;
  return cs_svg_is_word(text, "inherit") || cs_svg_is_word(text, "context-fill") ||
         cs_svg_is_word(text, "context-stroke") || parse_paint(text, &paint);
}

/* ---------------------------------------------------------------- the cascade */

/* An invalid paint does not override an earlier valid one: authors put a fallback first, as in
 * fill: #f00; fill: color(display-p3 1 0 0). */
static bool counts(const cs_css_declaration *declaration) {
  bool has_paint = declaration->name == CS_SVG_FILL || declaration->name == CS_SVG_STROKE ||
                   declaration->name == CS_SVG_COLOR || declaration->name == CS_SVG_STOP_COLOR;
  return !has_paint || is_paint(declaration->value);
}

static void apply_declarations(const cs_css_declarations *list, bool is_important, cascade *out) {
  for (size_t i = 0; i < list->count; i++)
    if (list->items[i].is_important == is_important && counts(&list->items[i]))
      out->values[list->items[i].name] = list->items[i].value;
}

static void apply_sheet(const cs_css_sheet *sheet, const cs_svg_node *node, bool is_important,
                        uint64_t *tests, cascade *out) {
  for (size_t i = 0; i < sheet->count; i++) {
    const cs_css_rule *rule = &sheet->rules[i];
    if (fits_chain(rule, rule->compound_count, node, tests))
      apply_declarations(&rule->declarations, is_important, out);
  }
}

static void collect(const cs_svg_document *document, const cs_svg_node *node, uint64_t *tests,
                    cascade *out) {
  *out = (cascade){{0}};
  for (size_t i = 0; i < node->attribute_count; i++)
    if (cs_svg_is_property(node->attributes[i].name) &&
        node->attributes[i].name != CS_SVG_MARKER) /* a shorthand: of style sheets alone */
      out->values[node->attributes[i].name] = node->attributes[i].value;
  apply_sheet(&document->sheet, node, false, tests, out);
  apply_declarations(&node->style, false, out);
  apply_sheet(&document->sheet, node, true, tests, out);
  apply_declarations(&node->style, true, out);
}

/* ---------------------------------------------------------------- values */

static void read_paint(const char *text, const cs_svg_style *style, const cs_svg_paint *inherited,
                       cs_svg_paint *out) {
  cs_svg_paint paint;
  if (!text)
    return;
  if (cs_svg_is_word(text, "inherit"))
    *out = *inherited;
  else if (cs_svg_is_word(text, "context-fill"))
    *out = style->context_fill;
  else if (cs_svg_is_word(text, "context-stroke"))
    *out = style->context_stroke;
  else if (parse_paint(text, &paint))
    *out = paint;
}

static void read_colour(const char *text, const cs_svg_colour *current, cs_svg_colour *out) {
  cs_svg_colour colour;
  if (!text)
    return;
  text = cs_svg_skip_space(text);
  if (cs_svg_take_word(&text, "currentColor"))
    *out = *current;
  else if (cs_svg_take_colour(&text, &colour))
    *out = colour;
}

/* A number or a percentage, clamped to 0..1. */
static void read_share(const char *text, double inherited, double *out) {
  cs_svg_length length;
  if (!text)
    return;
  if (cs_svg_is_word(text, "inherit"))
    *out = inherited;
  else if (cs_svg_parse_length(text, &length))
    *out = cs_number_clamp(length.unit == CS_SVG_UNIT_PERCENT ? length.value / 100 : length.value,
                           0, 1);
}

static void read_rule(const char *text, celspan_rule *out) {
  if (text && cs_svg_is_word(text, "evenodd"))
    *out = CELSPAN_RULE_EVENODD;
  else if (text && cs_svg_is_word(text, "nonzero"))
    *out = CELSPAN_RULE_NONZERO;
}

/* Parses `none` or a reference; anything else is an unresolvable reference, and treated as `none`.
 */
static bool read_reference(const char *text, cs_svg_reference *out) {
  if (!text)
    return false;
  text = cs_svg_skip_space(text);
  return cs_svg_take_reference(&text, out);
}

static void read_font_size(const char *text, double inherited, double *out) {
  cs_svg_length length;
  if (!text || !cs_svg_parse_length(text, &length))
    return;
  const cs_svg_measure measure = {
      .width = inherited, .height = inherited, .font_size = inherited, .root_font_size = inherited};
  *out = cs_svg_resolve(length, CS_SVG_AXIS_X, &measure);
}

/* ---------------------------------------------------------------- the style */

cs_svg_style cs_svg_style_initial(void) {
  const cs_svg_colour black = {{0, 0, 0}, 1};
  return (cs_svg_style){
      .colour = black,
      .fill = {.kind = CS_SVG_PAINT_COLOUR, .colour = black},
      .fill_opacity = 1,
      .stroke_opacity = 1,
      .stroke_width = {1, CS_SVG_UNIT_NUMBER},
      .miter = 4,
      .paint_order = {CS_SVG_LAYER_FILL, CS_SVG_LAYER_STROKE, CS_SVG_LAYER_MARKERS},
      .font_size = 16,
      .is_visible = true,
      .is_displayed = true,
      .opacity = 1,
      .stop_colour = black};
}

static void inherit(const cs_svg_style *parent, cs_svg_style *out) {
  const cs_svg_style initial = cs_svg_style_initial();
  *out = *parent;
  out->is_displayed = true;
  out->opacity = 1;
  out->clip_path = out->mask = (cs_svg_reference){NULL, 0};
  out->clip_shape = NULL;
  out->has_clip_path = out->has_mask = out->has_filter = out->has_blend = false;
  out->shows_overflow = out->uses_alpha = out->keeps_width = false;
  out->stop_colour = initial.stop_colour;
  out->transform = out->transform_origin = NULL;
}

static void read_cap_and_join(const char *cap, const char *join, cs_svg_style *out) {
  if (cap && cs_svg_is_word(cap, "butt"))
    out->cap = CELSPAN_CAP_BUTT;
  else if (cap && cs_svg_is_word(cap, "round"))
    out->cap = CELSPAN_CAP_ROUND;
  else if (cap && cs_svg_is_word(cap, "square"))
    out->cap = CELSPAN_CAP_SQUARE;
  if (join && (cs_svg_is_word(join, "miter") || cs_svg_is_word(join, "miter-clip") ||
               cs_svg_is_word(join, "arcs")))
    out->join = CELSPAN_JOIN_MITER; /* where there is no other, as browsers have it */
  else if (join && cs_svg_is_word(join, "round"))
    out->join = CELSPAN_JOIN_ROUND;
  else if (join && cs_svg_is_word(join, "bevel"))
    out->join = CELSPAN_JOIN_BEVEL;
}

/* Layers that are named come first, in that order; then the others in theirs. */
static void read_paint_order(const char *text, cs_svg_style *out) {
  static const char *const words[] = {"fill", "stroke", "markers"};
  bool is_named[3] = {false, false, false};
  int count = 0;
  for (text = cs_svg_skip_space(text); *text; text = cs_svg_skip_space(text)) {
    int layer = 0;
    while (layer < 3 && !cs_svg_take_word(&text, words[layer]))
      layer++;
    if (layer == 3 || is_named[layer])
      break;
    is_named[layer] = true;
    out->paint_order[count++] = (cs_svg_layer)layer;
  }
  if (*text) { /* a fault, or `normal` */
    is_named[0] = is_named[1] = is_named[2] = false;
    count = 0;
  }
  for (int layer = 0; layer < 3; layer++)
    if (!is_named[layer])
      out->paint_order[count++] = (cs_svg_layer)layer;
}

/* The properties of lines; an invalid value leaves the inherited one. */
static void read_line(const char *const *values, cs_svg_style *out) {
  cs_svg_length length;
  if (values[CS_SVG_STROKE_WIDTH] && cs_svg_parse_length(values[CS_SVG_STROKE_WIDTH], &length) &&
      length.value >= 0)
    out->stroke_width = length;
  if (values[CS_SVG_STROKE_DASHOFFSET])
    (void)cs_svg_parse_length(values[CS_SVG_STROKE_DASHOFFSET], &out->dash_offset);
  if (values[CS_SVG_STROKE_MITERLIMIT] &&
      cs_svg_parse_length(values[CS_SVG_STROKE_MITERLIMIT], &length) &&
      length.unit == CS_SVG_UNIT_NUMBER && length.value >= 1)
    out->miter = length.value;
  read_cap_and_join(values[CS_SVG_STROKE_LINECAP], values[CS_SVG_STROKE_LINEJOIN], out);
  const char *dashes = values[CS_SVG_STROKE_DASHARRAY];
  if (dashes && !cs_svg_is_word(dashes, "inherit"))
    out->dashes = cs_svg_is_word(dashes, "none") ? NULL : dashes;
  const char *order = values[CS_SVG_PAINT_ORDER];
  if (order && !cs_svg_is_word(order, "inherit"))
    read_paint_order(order, out);
}

static void read_painting(const cascade *from, const cs_svg_style *parent, cs_svg_style *out) {
  const char *const *values = from->values;
  read_colour(values[CS_SVG_COLOR], &parent->colour, &out->colour);
  read_paint(values[CS_SVG_FILL], parent, &parent->fill, &out->fill);
  read_paint(values[CS_SVG_STROKE], parent, &parent->stroke, &out->stroke);
  read_share(values[CS_SVG_FILL_OPACITY], parent->fill_opacity, &out->fill_opacity);
  read_share(values[CS_SVG_STROKE_OPACITY], parent->stroke_opacity, &out->stroke_opacity);
  read_rule(values[CS_SVG_FILL_RULE], &out->fill_rule);
  read_rule(values[CS_SVG_CLIP_RULE], &out->clip_rule);
  read_line(values, out);
  read_font_size(values[CS_SVG_FONT_SIZE], parent->font_size, &out->font_size);
  static const cs_svg_name markers[] = {CS_SVG_MARKER_START, CS_SVG_MARKER_MID, CS_SVG_MARKER_END};
  for (int i = 0; i < 3; i++) {
    const char *value = values[markers[i]] ? values[markers[i]] : values[CS_SVG_MARKER];
    if (value && !read_reference(value, &out->markers[i]))
      out->markers[i] = (cs_svg_reference){NULL, 0};
  }
  if (values[CS_SVG_VISIBILITY])
    out->is_visible = cs_svg_is_word(values[CS_SVG_VISIBILITY], "inherit")
                          ? parent->is_visible
                          : cs_svg_is_word(values[CS_SVG_VISIBILITY], "visible");
}

static void read_own(const cascade *from, const cs_svg_style *parent, cs_svg_style *out) {
  const char *const *values = from->values;
  double stop_opacity = 1;
  out->is_displayed = !values[CS_SVG_DISPLAY] || !cs_svg_is_word(values[CS_SVG_DISPLAY], "none");
  read_share(values[CS_SVG_OPACITY], parent->opacity, &out->opacity);
  out->has_clip_path = read_reference(values[CS_SVG_CLIP_PATH], &out->clip_path);
  const char *clip = values[CS_SVG_CLIP_PATH];
  if (clip && !out->has_clip_path && !cs_svg_is_word(clip, "none") &&
      !cs_svg_is_word(clip, "inherit")) {
    out->clip_shape = clip;
    out->has_clip_path = true;
  }
  out->has_mask = read_reference(values[CS_SVG_MASK], &out->mask);
  out->has_filter = values[CS_SVG_FILTER] && !cs_svg_is_word(values[CS_SVG_FILTER], "none");
  out->has_blend =
      values[CS_SVG_MIX_BLEND_MODE] && !cs_svg_is_word(values[CS_SVG_MIX_BLEND_MODE], "normal");
  out->shows_overflow =
      values[CS_SVG_OVERFLOW] && (cs_svg_is_word(values[CS_SVG_OVERFLOW], "visible") ||
                                  cs_svg_is_word(values[CS_SVG_OVERFLOW], "auto"));
  out->keeps_width = values[CS_SVG_VECTOR_EFFECT] &&
                     cs_svg_is_word(values[CS_SVG_VECTOR_EFFECT], "non-scaling-stroke");
  out->uses_alpha = values[CS_SVG_MASK_TYPE] && cs_svg_is_word(values[CS_SVG_MASK_TYPE], "alpha");
  if (values[CS_SVG_STOP_COLOR] && cs_svg_is_word(values[CS_SVG_STOP_COLOR], "inherit"))
    out->stop_colour = parent->stop_colour;
  else
    read_colour(values[CS_SVG_STOP_COLOR], &out->colour, &out->stop_colour);
  read_share(values[CS_SVG_STOP_OPACITY], 1, &stop_opacity);
  out->stop_colour.alpha *= stop_opacity;
  out->transform = values[CS_SVG_TRANSFORM];
  out->transform_origin = values[CS_SVG_TRANSFORM_ORIGIN];
}

static celspan_status check_numbers(celspan_context *context, const cascade *from,
                                    const cs_svg_node *node) {
  static const cs_svg_name numbers[] = {
      CS_SVG_OPACITY,      CS_SVG_FILL_OPACITY, CS_SVG_FONT_SIZE,         CS_SVG_STROKE_OPACITY,
      CS_SVG_STOP_OPACITY, CS_SVG_STROKE_WIDTH, CS_SVG_STROKE_DASHOFFSET, CS_SVG_STROKE_MITERLIMIT};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
    const char *value = from->values[numbers[i]];
    if (value && cs_svg_is_unfit(value))
      return cs_fail(context, CELSPAN_INPUT,
                     "line %u: %s is \"%.40s\"; it must be a finite number within 1e12", node->line,
                     cs_svg_name_text(numbers[i]), value);
  }
  return CELSPAN_OK;
}

celspan_status cs_svg_style_resolve(celspan_context *context, const cs_svg_document *document,
                                    const cs_svg_node *node, const cs_svg_style *parent,
                                    uint64_t *tests, cs_svg_style *out) {
  cascade from;
  collect(document, node, tests, &from);
  if (*tests == 0)
    return cs_fail(context, CELSPAN_LIMIT,
                   "line %u: the selectors of the style sheets take too long", node->line);
  CS_TRY(check_numbers(context, &from, node));
  inherit(parent, out);
  read_painting(&from, parent, out);
  cs_svg_text_style_read(node, from.values, out->font_size, &out->text);
  read_own(&from, parent, out);
  return CELSPAN_OK;
}
