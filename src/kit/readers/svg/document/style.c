#include "readers/svg/document/style.h"

#include <string.h>

#include "inside/colour.h"
#include "inside/number.h"
#include "readers/svg/document/cascade.h"
#include "readers/svg/words/filter_list.h"

#define MEDIUM 16 /* the size of medium letters, in px */

/* ---------------------------------------------------------------- texts */

/* Source: CSS Fonts Module Level 4, 2.2: from 600 on, a bold face is chosen. */
#define BOLD 600

static void read_weight(const char *text, bool *is_bold) {
  if (!text)
    return;
  cs_svg_length weight;
  if (cs_svg_is_word(text, "bold") || cs_svg_is_word(text, "bolder"))
    *is_bold = true;
  else if (cs_svg_parse_length(text, &weight))
    *is_bold = weight.value >= BOLD;
  else
    *is_bold = false;
}

static void read_slant(const char *text, bool *is_italic) {
  if (text)
    *is_italic = cs_svg_is_word(text, "italic") || strncmp(text, "oblique", 7) == 0;
}

static void read_spacing(const char *text, const cs_svg_measure *em, double *out) {
  cs_svg_length length;
  if (!text)
    return;
  double resolved =
      cs_svg_parse_length(text, &length) ? cs_svg_resolve(length, CS_SVG_AXIS_X, em) : 0;
  *out = cs_number_is_sane(resolved) ? resolved : 0;
}

static void read_anchor(const char *text, cs_svg_anchor *out) {
  if (cs_svg_is_word(text, "start"))
    *out = CS_SVG_ANCHOR_START;
  else if (cs_svg_is_word(text, "middle"))
    *out = CS_SVG_ANCHOR_MIDDLE;
  else if (cs_svg_is_word(text, "end"))
    *out = CS_SVG_ANCHOR_END;
}

/* False for a word that is not a line. */
static bool read_baseline(const char *text, cs_svg_baseline *out) {
  static const struct {
    const char *words;
    cs_svg_baseline line;
  } lines[] = {
      {"alphabetic", CS_SVG_BASELINE_ALPHABETIC},
      {"middle", CS_SVG_BASELINE_MIDDLE},
      {"central|center", CS_SVG_BASELINE_CENTRAL},
      {"hanging", CS_SVG_BASELINE_HANGING},
      {"mathematical", CS_SVG_BASELINE_MATHEMATICAL},
      {"ideographic|text-bottom|text-after-edge|after-edge|bottom", CS_SVG_BASELINE_BOTTOM},
      {"text-top|text-before-edge|before-edge|top", CS_SVG_BASELINE_TOP}};
  for (size_t i = 0; text && i < sizeof lines / sizeof *lines; i++)
    if (cs_svg_words_have(lines[i].words, text)) {
      *out = lines[i].line;
      return true;
    }
  return false;
}

static void read_baselines(const char *const *values, cs_svg_text_style *out) {
  const char *dominant = values[CS_SVG_DOMINANT_BASELINE];
  if (dominant && !read_baseline(dominant, &out->dominant) &&
      !cs_svg_is_word(dominant, "no-change"))
    out->dominant = CS_SVG_BASELINE_ALPHABETIC;
  if (!read_baseline(values[CS_SVG_ALIGNMENT_BASELINE], &out->own))
    out->own = out->dominant;
}

/* The shifts of nested elements add up. Source of the shares: CSS Inline Layout Module Level 3,
 * 4.2.3. */
static void read_shift(const cs_svg_node *node, const char *text, const cs_svg_measure *em,
                       double parent_em, double *out) {
  cs_svg_length length;
  if (node->element != CS_SVG_ELEMENT_TSPAN && node->element != CS_SVG_ELEMENT_TEXT_PATH &&
      node->element != CS_SVG_ELEMENT_A)
    *out = 0;
  else if (cs_svg_is_word(text, "super"))
    *out += parent_em / 3;
  else if (cs_svg_is_word(text, "sub"))
    *out -= parent_em / 5;
  else if (text && cs_svg_parse_length(text, &length))
    *out += cs_svg_resolve(length, CS_SVG_AXIS_X, em);
}

void cs_svg_text_style_read(const cs_svg_node *node, const char *const *values,
                            const cs_svg_measure *em, double parent_em, cs_svg_text_style *out) {
  const char *family = values[CS_SVG_FONT_FAMILY], *direction = values[CS_SVG_DIRECTION];
  const char *space = cs_svg_node_value(node, CS_SVG_SPACE);
  if (family)
    out->font_family = family;
  read_weight(values[CS_SVG_FONT_WEIGHT], &out->is_bold);
  read_slant(values[CS_SVG_FONT_STYLE], &out->is_italic);
  read_spacing(values[CS_SVG_LETTER_SPACING], em, &out->letter_spacing);
  read_spacing(values[CS_SVG_WORD_SPACING], em, &out->word_spacing);
  read_anchor(values[CS_SVG_TEXT_ANCHOR], &out->anchor);
  read_baselines(values, out);
  read_shift(node, values[CS_SVG_BASELINE_SHIFT], em, parent_em, &out->raised);
  if (direction)
    out->is_leftward = cs_svg_is_word(direction, "rtl");
  if (space)
    out->is_preserved = cs_svg_is_word(space, "preserve");
}

/* ---------------------------------------------------------------- values */

static void read_paint(const char *text, const cs_svg_style *style, cs_svg_paint *out) {
  cs_svg_paint paint;
  if (!text)
    return;
  if (cs_svg_is_word(text, "context-fill"))
    *out = style->context_fill;
  else if (cs_svg_is_word(text, "context-stroke"))
    *out = style->context_stroke;
  else if (cs_svg_parse_paint(text, &paint))
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
  double share;
  if (!text)
    return;
  if (cs_svg_is_word(text, "inherit"))
    *out = inherited;
  else if (cs_svg_parse_share(text, &share))
    *out = cs_number_clamp(share, 0, 1);
}

static void read_rule(const char *text, celspan_rule *out) {
  if (cs_svg_is_word(text, "evenodd"))
    *out = CELSPAN_RULE_EVENODD;
  else if (cs_svg_is_word(text, "nonzero"))
    *out = CELSPAN_RULE_NONZERO;
}

/* Parses `none` or a reference; any other value is treated as a reference that leads nowhere, like
 * `none`. */
static bool read_reference(const char *text, cs_svg_reference *out) {
  if (!text)
    return false;
  text = cs_svg_skip_space(text);
  return cs_svg_take_reference(&text, out);
}

/* Words for sizes, as shares of a medium letter or of the inherited size. Source: CSS Fonts Module
 * Level 4, 2.5. */
static bool font_size_word(const char *text, double inherited, double *out) {
  static const struct {
    const char *word;
    double share;
    bool is_relative;
  } words[] = {{"xx-small", 0.6, false}, {"x-small", 0.75, false}, {"small", 8.0 / 9, false},
               {"medium", 1, false},     {"large", 1.2, false},    {"x-large", 1.5, false},
               {"xx-large", 2, false},   {"xxx-large", 3, false},  {"smaller", 1 / 1.2, true},
               {"larger", 1.2, true}};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (cs_svg_is_word(text, words[i].word)) {
      *out = words[i].share * (words[i].is_relative ? inherited : MEDIUM);
      return true;
    }
  return false;
}

/* Sizes by which percentages are shares of the em. */
static cs_svg_measure em_of(const cs_svg_document *document, double em) {
  cs_svg_measure measure = document->page;
  measure.width = measure.height = measure.font_size = em;
  return measure;
}

static void read_font_size(const cs_svg_document *document, const char *text, double inherited,
                           double *out) {
  cs_svg_length length;
  if (!text || font_size_word(text, inherited, out) || !cs_svg_parse_length(text, &length))
    return;
  const cs_svg_measure em = em_of(document, inherited);
  *out = cs_svg_resolve(length, CS_SVG_AXIS_X, &em);
}

/* ---------------------------------------------------------------- the style */

cs_svg_style cs_svg_style_initial(void) {
  const cs_svg_colour black = {{0, 0, 0}, 1}, white = {{1, 1, 1}, 1};
  return (cs_svg_style){
      .colour = black,
      .fill = {.kind = CS_SVG_PAINT_COLOUR, .colour = black},
      .fill_opacity = 1,
      .stroke_opacity = 1,
      .stroke_width = {1, CS_SVG_UNIT_NUMBER},
      .miter = 4,
      .paint_order = {CS_SVG_LAYER_FILL, CS_SVG_LAYER_STROKE, CS_SVG_LAYER_MARKERS},
      .font_size = MEDIUM,
      .is_visible = true,
      .is_displayed = true,
      .opacity = 1,
      .stop_colour = black,
      .flood_colour = black,
      .light_colour = white};
}

static void inherit(const cs_svg_style *parent, cs_svg_style *out) {
  const cs_svg_style initial = cs_svg_style_initial();
  *out = *parent;
  out->is_displayed = true;
  out->opacity = 1;
  out->clip_path = out->mask = (cs_svg_reference){NULL, 0};
  out->clip_shape = out->filter = NULL;
  out->has_clip_path = out->has_mask = out->isolates = false;
  out->blend = CELSPAN_BLEND_NORMAL;
  out->shows_overflow = out->uses_alpha = out->keeps_width = false;
  out->stop_colour = initial.stop_colour;
  out->flood_colour = initial.flood_colour;
  out->light_colour = initial.light_colour;
  out->is_about_box = false;
  out->transform = out->translate = out->rotate = out->scale = out->transform_origin = NULL;
  out->offset = initial.offset;
}

static void read_cap_and_join(const char *cap, const char *join, cs_svg_style *out) {
  if (cs_svg_is_word(cap, "butt"))
    out->cap = CELSPAN_STROKE_CAP_BUTT;
  else if (cs_svg_is_word(cap, "round"))
    out->cap = CELSPAN_STROKE_CAP_ROUND;
  else if (cs_svg_is_word(cap, "square"))
    out->cap = CELSPAN_STROKE_CAP_SQUARE;
  if (join && (cs_svg_is_word(join, "miter") || cs_svg_is_word(join, "miter-clip") ||
               cs_svg_is_word(join, "arcs")))
    out->join = CELSPAN_STROKE_JOIN_MITER; /* browsers do not support other joins here */
  else if (cs_svg_is_word(join, "round"))
    out->join = CELSPAN_STROKE_JOIN_ROUND;
  else if (cs_svg_is_word(join, "bevel"))
    out->join = CELSPAN_STROKE_JOIN_BEVEL;
}

static const cs_svg_layer normal_order[3] = {CS_SVG_LAYER_FILL, CS_SVG_LAYER_STROKE,
                                             CS_SVG_LAYER_MARKERS};

/* Reads the properties of lines; an invalid value does not change the inherited one. */
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
  if (dashes)
    out->dashes = cs_svg_is_word(dashes, "none") ? NULL : dashes;
  if (values[CS_SVG_PAINT_ORDER] &&
      !cs_svg_parse_order(values[CS_SVG_PAINT_ORDER], out->paint_order))
    memcpy(out->paint_order, normal_order, sizeof normal_order);
}

static void read_painting(const cs_svg_cascade *from, const cs_svg_style *parent,
                          cs_svg_style *out) {
  const char *const *values = from->values;
  read_colour(values[CS_SVG_COLOR], &parent->colour, &out->colour);
  read_paint(values[CS_SVG_FILL], parent, &out->fill);
  read_paint(values[CS_SVG_STROKE], parent, &out->stroke);
  read_share(values[CS_SVG_FILL_OPACITY], parent->fill_opacity, &out->fill_opacity);
  read_share(values[CS_SVG_STROKE_OPACITY], parent->stroke_opacity, &out->stroke_opacity);
  read_rule(values[CS_SVG_FILL_RULE], &out->fill_rule);
  read_rule(values[CS_SVG_CLIP_RULE], &out->clip_rule);
  read_line(values, out);
  static const cs_svg_name markers[] = {CS_SVG_MARKER_START, CS_SVG_MARKER_MID, CS_SVG_MARKER_END};
  for (int i = 0; i < 3; i++) {
    const char *value = values[markers[i]] ? values[markers[i]] : values[CS_SVG_MARKER];
    if (value && !read_reference(value, &out->markers[i]))
      out->markers[i] = (cs_svg_reference){NULL, 0};
  }
  const char *numbers = values[CS_SVG_COLOR_INTERPOLATION_FILTERS];
  if (numbers && !cs_svg_is_word(numbers, "auto"))
    out->filters_codes = cs_svg_is_word(numbers, "sRGB");
  if (values[CS_SVG_VISIBILITY])
    out->is_visible = cs_svg_is_word(values[CS_SVG_VISIBILITY], "visible");
}

static bool is_inherited(const char *text) { return cs_svg_is_word(text, "inherit"); }

static void read_blend(const char *text, const cs_svg_style *parent, cs_svg_style *out) {
  if (is_inherited(text))
    out->blend = parent->blend;
  else if (cs_svg_is_word(text, "plus-lighter"))
    out->blend = CELSPAN_BLEND_ADD;
  for (int mode = 0; text && mode < CELSPAN_BLEND_ADD; mode++)
    if (cs_svg_is_word(text, cs_blend_words[mode]))
      out->blend = (celspan_blend)mode;
}

/* The properties that act on the element as a whole. */
static void read_effects(const char *const *values, const cs_svg_style *parent, cs_svg_style *out) {
  const char *clip = values[CS_SVG_CLIP_PATH], *filter = values[CS_SVG_FILTER];
  out->has_clip_path = read_reference(clip, &out->clip_path);
  if (is_inherited(clip)) {
    out->has_clip_path = parent->has_clip_path;
    out->clip_path = parent->clip_path;
    out->clip_shape = parent->clip_shape;
  } else if (clip && !out->has_clip_path && !cs_svg_is_word(clip, "none")) {
    out->clip_shape = clip;
    out->has_clip_path = true;
  }
  out->has_mask = read_reference(values[CS_SVG_MASK], &out->mask);
  if (is_inherited(values[CS_SVG_MASK])) {
    out->has_mask = parent->has_mask;
    out->mask = parent->mask;
  }
  if (is_inherited(filter))
    out->filter = parent->filter;
  else if (filter && cs_svg_is_filter_list(filter, false))
    out->filter = filter;
  out->isolates = cs_svg_is_word(values[CS_SVG_ISOLATION], "isolate");
  read_blend(values[CS_SVG_MIX_BLEND_MODE], parent, out);
}

/* The colour of a stop or a flood, with its opacity. inherited: the colour of the parent. */
static void read_own_colour(const char *text, const char *opacity, const cs_svg_colour *inherited,
                            const cs_svg_style *style, cs_svg_colour *out) {
  double share = 1;
  if (is_inherited(text))
    *out = *inherited;
  else
    read_colour(text, &style->colour, out);
  read_share(opacity, 1, &share);
  out->alpha *= share;
}

static void read_own(const cs_svg_cascade *from, const cs_svg_style *parent, cs_svg_style *out) {
  const char *const *values = from->values;
  out->is_displayed = is_inherited(values[CS_SVG_DISPLAY])
                          ? parent->is_displayed
                          : !cs_svg_is_word(values[CS_SVG_DISPLAY], "none");
  read_share(values[CS_SVG_OPACITY], parent->opacity, &out->opacity);
  read_effects(values, parent, out);
  out->shows_overflow =
      is_inherited(values[CS_SVG_OVERFLOW])
          ? parent->shows_overflow
          : values[CS_SVG_OVERFLOW] && (cs_svg_is_word(values[CS_SVG_OVERFLOW], "visible") ||
                                        cs_svg_is_word(values[CS_SVG_OVERFLOW], "auto"));
  out->keeps_width = cs_svg_is_word(values[CS_SVG_VECTOR_EFFECT], "non-scaling-stroke");
  out->uses_alpha = cs_svg_is_word(values[CS_SVG_MASK_TYPE], "alpha");
  read_own_colour(values[CS_SVG_STOP_COLOR], values[CS_SVG_STOP_OPACITY], &parent->stop_colour, out,
                  &out->stop_colour);
  read_own_colour(values[CS_SVG_FLOOD_COLOR], values[CS_SVG_FLOOD_OPACITY], &parent->flood_colour,
                  out, &out->flood_colour);
  read_own_colour(values[CS_SVG_LIGHTING_COLOR], NULL, &parent->light_colour, out,
                  &out->light_colour);
  out->transform =
      is_inherited(values[CS_SVG_TRANSFORM]) ? parent->transform : values[CS_SVG_TRANSFORM];
  out->translate = values[CS_SVG_TRANSLATE];
  out->rotate = values[CS_SVG_ROTATE];
  out->scale = values[CS_SVG_SCALE];
  out->transform_origin = values[CS_SVG_TRANSFORM_ORIGIN];
  out->is_about_box =
      values[CS_SVG_TRANSFORM_BOX] && !cs_svg_is_word(values[CS_SVG_TRANSFORM_BOX], "view-box");
}

static celspan_status check_numbers(celspan_context *context, const cs_svg_cascade *from,
                                    const cs_svg_node *node) {
  static const cs_svg_name numbers[] = {
      CS_SVG_OPACITY,        CS_SVG_FILL_OPACITY,      CS_SVG_FONT_SIZE,
      CS_SVG_STROKE_OPACITY, CS_SVG_STOP_OPACITY,      CS_SVG_FLOOD_OPACITY,
      CS_SVG_STROKE_WIDTH,   CS_SVG_STROKE_DASHOFFSET, CS_SVG_STROKE_MITERLIMIT};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
    const char *value = from->values[numbers[i]];
    if (value && cs_svg_is_unfit(value))
      return cs_fail(context, CELSPAN_INPUT,
                     "line %u: %s is \"%.40s\"; it must be a finite number within 1e12", node->line,
                     cs_svg_name_text(numbers[i]), value);
  }
  return CELSPAN_OK;
}

celspan_status cs_svg_style_resolve(celspan_context *context, cs_svg_document *document,
                                    const cs_svg_node *node, const cs_svg_style *parent,
                                    uint64_t *tests, cs_svg_style *out) {
  cs_svg_cascade from;
  CS_TRY(cs_svg_cascade_collect(context, document, node, parent->variables, tests, &from));
  CS_TRY(check_numbers(context, &from, node));
  inherit(parent, out);
  read_font_size(document, from.values[CS_SVG_FONT_SIZE], parent->font_size, &out->font_size);
  out->variables = from.variables;
  read_painting(&from, parent, out);
  const cs_svg_measure em = em_of(document, out->font_size);
  cs_svg_text_style_read(node, from.values, &em, parent->font_size, &out->text);
  read_own(&from, parent, out);
  out->motion = node->motion;
  return cs_svg_offset_read(context, &document->arena, node->line, from.values, &em, tests,
                            &out->offset);
}
