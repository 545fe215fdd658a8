#include "svg/style.h"

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

/* ---------------------------------------------------------------- the cascade */

static void apply_declarations(const cs_css_declarations *list, bool is_important, cascade *out) {
  for (size_t i = 0; i < list->count; i++)
    if (list->items[i].is_important == is_important)
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
    if (cs_svg_is_property(node->attributes[i].name))
      out->values[node->attributes[i].name] = node->attributes[i].value;
  apply_sheet(&document->sheet, node, false, tests, out);
  apply_declarations(&node->style, false, out);
  apply_sheet(&document->sheet, node, true, tests, out);
  apply_declarations(&node->style, true, out);
}

/* ---------------------------------------------------------------- values */

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

static void read_paint(const char *text, const cs_svg_style *style, const cs_svg_paint *inherited,
                       cs_svg_paint *out) {
  cs_svg_paint paint = {.kind = CS_SVG_PAINT_NONE};
  if (!text)
    return;
  text = cs_svg_skip_space(text);
  if (cs_svg_is_word(text, "inherit")) {
    *out = *inherited;
    return;
  }
  if (cs_svg_is_word(text, "context-fill") || cs_svg_is_word(text, "context-stroke")) {
    *out = cs_svg_is_word(text, "context-fill") ? style->context_fill : style->context_stroke;
    return;
  }
  paint.has_server = cs_svg_take_reference(&text, &paint.server);
  text = cs_svg_skip_space(text);
  bool has_colour = *text && take_paint_colour(&text, &paint);
  paint.has_fallback = paint.has_server && has_colour;
  /* Only an ICC profile may follow; it is passed over. */
  text = cs_svg_skip_space(text);
  if (paint.has_server || (has_colour && (!*text || strncmp(text, "icc-color", 9) == 0)))
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

/* A number or a percentage, held to 0..1. */
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

/* A reference or none; what is neither is a reference to nothing, which counts as none. */
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
  const cs_svg_measure measure = {inherited, inherited, inherited, inherited};
  *out = cs_svg_resolve(length, CS_SVG_AXIS_X, &measure);
}

/* ---------------------------------------------------------------- the style */

cs_svg_style cs_svg_style_initial(void) {
  const cs_svg_colour black = {{0, 0, 0}, 1};
  return (cs_svg_style){.colour = black,
                        .fill = {.kind = CS_SVG_PAINT_COLOUR, .colour = black},
                        .fill_opacity = 1,
                        .stroke_opacity = 1,
                        .stroke_width = {1, CS_SVG_UNIT_NUMBER},
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
  out->has_clip_path = out->has_mask = out->has_filter = out->has_blend = false;
  out->shows_overflow = out->uses_alpha = false;
  out->stop_colour = initial.stop_colour;
  out->transform = out->transform_origin = NULL;
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
  if (values[CS_SVG_STROKE_WIDTH])
    (void)cs_svg_parse_length(values[CS_SVG_STROKE_WIDTH], &out->stroke_width);
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
  out->has_mask = read_reference(values[CS_SVG_MASK], &out->mask);
  out->has_filter = values[CS_SVG_FILTER] && !cs_svg_is_word(values[CS_SVG_FILTER], "none");
  out->has_blend =
      values[CS_SVG_MIX_BLEND_MODE] && !cs_svg_is_word(values[CS_SVG_MIX_BLEND_MODE], "normal");
  out->shows_overflow =
      values[CS_SVG_OVERFLOW] && (cs_svg_is_word(values[CS_SVG_OVERFLOW], "visible") ||
                                  cs_svg_is_word(values[CS_SVG_OVERFLOW], "auto"));
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
  static const cs_svg_name numbers[] = {CS_SVG_OPACITY,      CS_SVG_FILL_OPACITY,
                                        CS_SVG_FONT_SIZE,    CS_SVG_STROKE_OPACITY,
                                        CS_SVG_STOP_OPACITY, CS_SVG_STROKE_WIDTH};
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
  read_own(&from, parent, out);
  return CELSPAN_OK;
}
