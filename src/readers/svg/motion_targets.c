#include "readers/svg/motion_targets.h"

#include <string.h>

#include "readers/svg/cascade.h"
#include "readers/svg/forms.h"

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

/* Values of properties that are not inherited, and of attributes, where none is given. */
static const char *initial_of(const cs_svg_node *node, cs_svg_name name) {
  switch (name) {
  case CS_SVG_OPACITY:
  case CS_SVG_STOP_OPACITY:
  case CS_SVG_FLOOD_OPACITY:
  case CS_SVG_SLOPE:
    return "1";
  case CS_SVG_STOP_COLOR:
  case CS_SVG_FLOOD_COLOR:
    return "black";
  case CS_SVG_TRANSFORM:
  case CS_SVG_TRANSLATE:
  case CS_SVG_SCALE:
  case CS_SVG_FILTER:
  case CS_SVG_CLIP_PATH:
  case CS_SVG_MASK:
    return "none";
  case CS_SVG_DISPLAY:
    return "inline";
  case CS_SVG_X2:
    return node->element == CS_SVG_ELEMENT_LINEAR_GRADIENT ? "100%" : "0";
  default:
    return "0";
  }
}

/* Recursion: the depth of the document. */
static celspan_status variables_of(cs_svg_reading *reading, const cs_svg_node *node,
                                   cs_svg_cascade *out) {
  const cs_svg_variable *inherited = NULL;
  if (node->parent) {
    CS_TRY(variables_of(reading, node->parent, out));
    inherited = out->variables;
  }
  return cs_svg_cascade_collect(reading->context, reading->document, node, inherited,
                                &reading->tests, out);
}

celspan_status cs_svg_motion_base(cs_svg_reading *reading, const cs_svg_node *node,
                                  cs_svg_name name, const char **out) {
  const cs_svg_name_facts *facts = cs_svg_name_facts_of(name);
  *out = NULL;
  if (facts->use != CS_SVG_USE_ATTRIBUTE)
    for (const cs_svg_node *at = node; at && !*out; at = facts->initial ? at->parent : NULL) {
      cs_svg_cascade from;
      CS_TRY(variables_of(reading, at, &from));
      *out = from.values[name];
    }
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

static celspan_status give_property(cs_svg_reading *reading, cs_svg_node *node, cs_svg_name name,
                                    const char *value) {
  cs_css_declarations *moved = &node->moved;
  cs_css_declaration *items = cs_arena_take(reading->context, &reading->document->arena,
                                            (moved->count + 1) * sizeof *items);
  if (!items)
    return CELSPAN_NO_MEMORY;
  if (moved->count > 0)
    memcpy(items, moved->items, moved->count * sizeof *items);
  items[moved->count] = (cs_css_declaration){.name = name, .value = value};
  moved->items = items;
  moved->count++;
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
