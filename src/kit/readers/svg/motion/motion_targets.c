#include "readers/svg/motion/motion_targets.h"

#include <string.h>

#include "readers/svg/document/cascade.h"
#include "readers/svg/words/forms.h"

cs_css_place cs_svg_motion_place(const cs_svg_reading *reading, const cs_svg_node *node) {
  cs_svg_document *document = reading->document;
  return (cs_css_place){reading->context, &document->arena, &document->unread, node->line};
}

/* One byte counts as much as several tests of selectors, and one value as much as several bytes. */
#define BYTE 8
#define VALUE 8

celspan_status cs_svg_motion_count(cs_svg_reading *reading, const cs_svg_node *node, size_t count) {
  uint64_t cost = BYTE * ((uint64_t)count + VALUE);
  if (cost >= reading->tests)
    return cs_fail(reading->context, CELSPAN_LIMIT,
                   "line %u: the values of the animations are too long together", node->line);
  reading->tests -= cost;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- values before */

/* The initial values of properties that are not inherited and of attributes, where they are not 0.
 * CS_SVG_ELEMENT_COUNT: of all elements that are not in a line before. */
static const struct {
  cs_svg_name name;
  cs_svg_element element;
  const char *value;
} initials[] = {
    {CS_SVG_AMPLITUDE, CS_SVG_ELEMENT_COUNT, "1"},
    {CS_SVG_CLIP_PATH, CS_SVG_ELEMENT_COUNT, "none"},
    {CS_SVG_CX, CS_SVG_ELEMENT_RADIAL_GRADIENT, "50%"},
    {CS_SVG_CY, CS_SVG_ELEMENT_RADIAL_GRADIENT, "50%"},
    {CS_SVG_DISPLAY, CS_SVG_ELEMENT_COUNT, "inline"},
    {CS_SVG_DX, CS_SVG_ELEMENT_FE_DROP_SHADOW, "2"},
    {CS_SVG_DY, CS_SVG_ELEMENT_FE_DROP_SHADOW, "2"},
    {CS_SVG_EXPONENT, CS_SVG_ELEMENT_COUNT, "1"},
    {CS_SVG_FILTER, CS_SVG_ELEMENT_COUNT, "none"},
    {CS_SVG_FLOOD_COLOR, CS_SVG_ELEMENT_COUNT, "black"},
    {CS_SVG_FLOOD_OPACITY, CS_SVG_ELEMENT_COUNT, "1"},
    {CS_SVG_GRADIENT_TRANSFORM, CS_SVG_ELEMENT_COUNT, "none"},
    {CS_SVG_HEIGHT, CS_SVG_ELEMENT_FILTER, "120%"},
    {CS_SVG_HEIGHT, CS_SVG_ELEMENT_MASK, "120%"},
    {CS_SVG_HEIGHT, CS_SVG_ELEMENT_SVG, "100%"},
    {CS_SVG_MARKER_HEIGHT, CS_SVG_ELEMENT_COUNT, "3"},
    {CS_SVG_MARKER_WIDTH, CS_SVG_ELEMENT_COUNT, "3"},
    {CS_SVG_MASK, CS_SVG_ELEMENT_COUNT, "none"},
    {CS_SVG_OFFSET_ANCHOR, CS_SVG_ELEMENT_COUNT, "auto"},
    {CS_SVG_OFFSET_PATH, CS_SVG_ELEMENT_COUNT, "none"},
    {CS_SVG_OFFSET_ROTATE, CS_SVG_ELEMENT_COUNT, "auto"},
    {CS_SVG_OPACITY, CS_SVG_ELEMENT_COUNT, "1"},
    {CS_SVG_PATTERN_TRANSFORM, CS_SVG_ELEMENT_COUNT, "none"},
    {CS_SVG_R, CS_SVG_ELEMENT_RADIAL_GRADIENT, "50%"},
    {CS_SVG_SCALE, CS_SVG_ELEMENT_COUNT, "none"},
    {CS_SVG_SLOPE, CS_SVG_ELEMENT_COUNT, "1"},
    {CS_SVG_STD_DEVIATION, CS_SVG_ELEMENT_FE_DROP_SHADOW, "2"},
    {CS_SVG_STOP_COLOR, CS_SVG_ELEMENT_COUNT, "black"},
    {CS_SVG_STOP_OPACITY, CS_SVG_ELEMENT_COUNT, "1"},
    {CS_SVG_TRANSFORM, CS_SVG_ELEMENT_COUNT, "none"},
    {CS_SVG_TRANSFORM_ORIGIN, CS_SVG_ELEMENT_COUNT, "0 0"},
    {CS_SVG_TRANSLATE, CS_SVG_ELEMENT_COUNT, "none"},
    {CS_SVG_WIDTH, CS_SVG_ELEMENT_FILTER, "120%"},
    {CS_SVG_WIDTH, CS_SVG_ELEMENT_MASK, "120%"},
    {CS_SVG_WIDTH, CS_SVG_ELEMENT_SVG, "100%"},
    {CS_SVG_X, CS_SVG_ELEMENT_FILTER, "-10%"},
    {CS_SVG_X, CS_SVG_ELEMENT_MASK, "-10%"},
    {CS_SVG_X2, CS_SVG_ELEMENT_LINEAR_GRADIENT, "100%"},
    {CS_SVG_Y, CS_SVG_ELEMENT_FILTER, "-10%"},
    {CS_SVG_Y, CS_SVG_ELEMENT_MASK, "-10%"},
};

static const char *initial_of(const cs_svg_node *node, cs_svg_name name) {
  for (size_t i = 0; i < sizeof initials / sizeof *initials; i++)
    if (initials[i].name == name &&
        (initials[i].element == node->element || initials[i].element == CS_SVG_ELEMENT_COUNT))
      return initials[i].value;
  return "0";
}

/* The values of an element, and *value of the property that it has or inherits; NULL: none. Each
 * element above it is asked once. Recursion: the depth of the document. */
static celspan_status collect(cs_svg_reading *reading, const cs_svg_node *node, cs_svg_name name,
                              cs_svg_cascade *out, const char **value) {
  const cs_svg_variable *inherited = NULL;
  *value = NULL;
  if (node->parent) {
    CS_TRY(collect(reading, node->parent, name, out, value));
    inherited = out->variables;
  }
  CS_TRY(cs_svg_cascade_collect(reading->context, reading->document, node, inherited,
                                &reading->tests, out));
  const char *given = out->values[name];
  bool is_inherited = cs_svg_name_facts_of(name)->initial;
  bool inherits = given ? cs_svg_is_word(given, "inherit") : is_inherited;
  *value = inherits ? *value : given;
  return CELSPAN_OK;
}

celspan_status cs_svg_motion_base(cs_svg_reading *reading, const cs_svg_node *node,
                                  cs_svg_name name, const char **out) {
  const cs_svg_name_facts *facts = cs_svg_name_facts_of(name);
  cs_svg_cascade from;
  *out = NULL;
  if (facts->use != CS_SVG_USE_ATTRIBUTE)
    CS_TRY(collect(reading, node, name, &from, out));
  if (!*out && !facts->initial)
    *out = cs_svg_node_value(node, name);
  if (!*out || cs_svg_is_word(*out, "inherit"))
    *out = facts->initial ? facts->initial : initial_of(node, name);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- values after */

static celspan_status give_attribute(cs_svg_reading *reading, cs_svg_node *node, cs_svg_name name,
                                     const char *value) {
  size_t count = node->attribute_count, place = 0;
  cs_svg_attribute *list =
      cs_arena_take(reading->context, &reading->document->arena, (count + 1) * sizeof *list);
  if (!list)
    return CELSPAN_NO_MEMORY;
  if (count > 0)
    memcpy(list, node->attributes, count * sizeof *list);
  while (place < count && list[place].name != name)
    place++;
  list[place] = (cs_svg_attribute){name, false, value};
  node->attributes = list;
  node->attribute_count = count + (place == count);
  return CELSPAN_OK;
}

/* The memory, which only this function writes, is doubled whenever it is full: at 2^n values. */
static celspan_status give_property(cs_svg_reading *reading, cs_svg_node *node, cs_svg_name name,
                                    const char *value) {
  cs_css_declarations *moved = &node->moved;
  size_t count = moved->count;
  cs_css_declaration *items = (cs_css_declaration *)(size_t)moved->items;
  if ((count & (count - 1)) == 0) {
    items =
        cs_arena_take(reading->context, &reading->document->arena, (2 * count + 1) * sizeof *items);
    if (!items)
      return CELSPAN_NO_MEMORY;
    if (count > 0)
      memcpy(items, moved->items, count * sizeof *items);
  }
  items[count] = (cs_css_declaration){.name = name, .value = value};
  moved->items = items;
  moved->count = count + 1;
  return CELSPAN_OK;
}

celspan_status cs_svg_motion_give(cs_svg_reading *reading, cs_svg_node *node, cs_svg_name name,
                                  const char *value) {
  if (cs_svg_is_unfit(value) ||
      !(cs_svg_value_is_read(name, value, true) || cs_svg_value_is_read(name, value, false)))
    return CELSPAN_OK;
  return give_property(reading, node, name, value);
}

celspan_status cs_svg_motion_set(cs_svg_reading *reading, cs_svg_node *node, cs_svg_name name,
                                 const char *value) {
  if (cs_svg_is_unfit(value) || !cs_svg_value_is_read(name, value, false))
    return CELSPAN_OK;
  return give_attribute(reading, node, name, value);
}
