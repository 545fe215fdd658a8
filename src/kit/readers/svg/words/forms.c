#include "readers/svg/words/forms.h"

#include <string.h>

#include "readers/svg/words/filter_list.h"
#include "readers/svg/words/offset.h"
#include "readers/svg/words/paints.h"
#include "readers/svg/words/transforms.h"

/* Used where only the form of percentages and units is checked. */
static const cs_svg_measure unit_measure = {1, 1, 1, 1, 1, 1};

bool cs_svg_has_variable(const char *value) { return strstr(value, "var("); }

/* ---------------------------------------------------------------- numbers */

static bool is_number(const char *text) {
  double value;
  text = cs_svg_skip_space(text);
  return cs_svg_take_number(&text, &value) && !*cs_svg_skip_space(text);
}

static bool is_share(const char *text) {
  double share;
  return cs_svg_parse_share(text, &share);
}

static bool is_length(const char *text) {
  cs_svg_length length;
  return cs_svg_parse_length(text, &length);
}

static bool is_size(const char *text) {
  cs_svg_length length;
  return cs_svg_parse_length(text, &length) && length.value >= 0;
}

static bool is_length_list(const char *text) {
  cs_svg_length length;
  for (text = cs_svg_skip_space(text); *text; text = cs_svg_skip_comma(text))
    if (!cs_svg_take_length(&text, &length))
      return false;
  return true;
}

static bool is_angle(const char *text) {
  double degrees;
  text = cs_svg_skip_space(text);
  return cs_svg_take_angle(&text, &degrees) && !*cs_svg_skip_space(text);
}

/* A length in CSS must have a unit, unless it is 0. */
static bool has_unit(const char *text) {
  double value;
  text = cs_svg_skip_space(text);
  return !cs_svg_take_number(&text, &value) || value == 0 || *cs_svg_skip_space(text);
}

/* ---------------------------------------------------------------- other values */

static bool is_colour(const char *text) {
  cs_svg_colour colour;
  text = cs_svg_skip_space(text);
  return (cs_svg_take_word(&text, "currentColor") || cs_svg_take_colour(&text, &colour)) &&
         (!*cs_svg_skip_space(text) || strncmp(cs_svg_skip_space(text), "icc-color", 9) == 0);
}

static bool is_paint(const char *text) {
  cs_svg_paint paint;
  return cs_svg_is_word(text, "context-fill") || cs_svg_is_word(text, "context-stroke") ||
         cs_svg_parse_paint(text, &paint);
}

static bool is_reference(const char *text) {
  cs_svg_reference reference;
  text = cs_svg_skip_space(text);
  return cs_svg_take_reference(&text, &reference) && !*cs_svg_skip_space(text);
}

static bool is_transform(const char *text) {
  celspan_matrix matrix;
  return cs_svg_parse_transform(text, &unit_measure, &matrix);
}

static bool is_translation(const char *text) {
  celspan_matrix matrix;
  return cs_svg_parse_translate(text, &unit_measure, &matrix);
}

static bool is_scaling(const char *text) {
  celspan_matrix matrix;
  return cs_svg_parse_scale(text, &matrix);
}

static bool is_way(const char *text) {
  const char *data;
  size_t size;
  return cs_svg_parse_way(text, &data, &size);
}

static bool is_distance(const char *text) { return has_unit(text) && is_length(text); }

static bool is_heading(const char *text) {
  bool follows;
  double degrees;
  return cs_svg_parse_heading(text, &follows, &degrees);
}

static bool is_slant(const char *text) {
  text = cs_svg_skip_space(text);
  return cs_svg_take_word(&text, "oblique") && is_angle(text);
}

static bool is_view_box(const char *text) {
  cs_svg_view_box box;
  return cs_svg_parse_view_box(text, &box);
}

/* xMidYMid, then meet or slice; or none. */
static bool is_aspect(const char *text) {
  text = cs_svg_skip_space(text);
  if (cs_svg_take_word(&text, "none"))
    return true;
  for (int axis = 0; axis < 2; axis++, text += 4)
    if (*text != "xY"[axis] ||
        (strncmp(text + 1, "Min", 3) != 0 && strncmp(text + 1, "Mid", 3) != 0 &&
         strncmp(text + 1, "Max", 3) != 0))
      return false;
  return !*cs_svg_skip_space(text) || cs_svg_is_word(text, "meet") || cs_svg_is_word(text, "slice");
}

/* none, or path("...") */
static bool is_path_function(const char *text) {
  size_t size = strlen(text);
  const char *begin = strpbrk(text, "\"'"), *end = begin ? strrchr(text, *begin) : NULL;
  return cs_svg_is_word(text, "none") ||
         (begin && strncmp(text, "path(", 5) == 0 && end > begin && text[size - 1] == ')');
}

/* A place or a size in a style: a length of CSS has a unit. */
static bool is_geometry(cs_svg_name name, const char *text) {
  return name == CS_SVG_D ? is_path_function(text) : is_distance(text);
}

/* ---------------------------------------------------------------- the test */

static bool is_order(const char *text) {
  cs_svg_layer order[3];
  return cs_svg_parse_order(text, order);
}

/* Tests for each form; NULL: any value, or only the words of the property. */
typedef bool form_test(const char *text);
static form_test *const tests[] = {
    [CS_SVG_FORM_NUMBER] = is_number,        [CS_SVG_FORM_SHARE] = is_share,
    [CS_SVG_FORM_LENGTH] = is_length,        [CS_SVG_FORM_SIZE] = is_size,
    [CS_SVG_FORM_LENGTHS] = is_length_list,  [CS_SVG_FORM_ANGLE] = is_angle,
    [CS_SVG_FORM_ROTATION] = is_length_list, [CS_SVG_FORM_COLOUR] = is_colour,
    [CS_SVG_FORM_PAINT] = is_paint,          [CS_SVG_FORM_REFERENCE] = is_reference,
    [CS_SVG_FORM_TRANSFORM] = is_transform,  [CS_SVG_FORM_TRANSLATE] = is_translation,
    [CS_SVG_FORM_SCALE] = is_scaling,        [CS_SVG_FORM_SLANT] = is_slant,
    [CS_SVG_FORM_ORDER] = is_order,          [CS_SVG_FORM_VIEW_BOX] = is_view_box,
    [CS_SVG_FORM_ASPECT] = is_aspect,        [CS_SVG_FORM_WAY] = is_way,
    [CS_SVG_FORM_HEADING] = is_heading,      [CS_SVG_FORM_DISTANCE] = is_length};

static bool has_form(cs_svg_form form, const char *text, bool is_style) {
  celspan_matrix matrix;
  if (form == CS_SVG_FORM_ROTATION && is_style)
    return cs_svg_parse_rotate(text, &matrix);
  if (form == CS_SVG_FORM_DISTANCE && is_style)
    return is_distance(text);
  if (form == CS_SVG_FORM_FILTERS)
    return cs_svg_is_filter_list(text, is_style);
  return tests[form] ? tests[form](text) : form == CS_SVG_FORM_ANY;
}

bool cs_svg_value_is_read(cs_svg_name name, const char *value, bool is_style) {
  const cs_svg_name_facts *facts = cs_svg_name_facts_of(name);
  bool is_property = is_style || facts->use == CS_SVG_USE_PRESENTED;
  bool is_place = is_style && facts->use == CS_SVG_USE_GEOMETRY;
  value = cs_svg_skip_space(value);
  /* Most values have the form, so words are compared only for the others. */
  return (is_place ? is_geometry(name, value) : has_form(facts->form, value, is_style)) ||
         cs_svg_has_variable(value) || cs_svg_is_unfit(value) ||
         cs_svg_words_have(facts->words, value) ||
         (is_property && cs_svg_words_have("initial|unset|revert|revert-layer", value)) ||
         (facts->initial && cs_svg_words_have("inherit", value));
}
