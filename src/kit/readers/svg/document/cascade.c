#include "readers/svg/document/cascade.h"

#include <string.h>

#include "readers/svg/words/forms.h"
#include "readers/svg/words/values.h"

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

/* Whether the value of an attribute fulfils the condition of a selector. */
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
  if (compound->is_root && node->parent)
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

/* Whether the first `count` compounds fit the element and the elements around it. */
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

/* ---------------------------------------------------------------- values that win */

typedef struct collecting {
  celspan_context *context;
  cs_svg_document *document;
  const cs_svg_node *node;
  uint64_t *tests;
  cs_svg_cascade *out;
  bool has_variable; /* a value refers to variables */
} collecting;

/* The shorthand `animation` sets all properties whose names begin with it. */
static void forget_parts(const char **values) {
  for (int name = CS_SVG_ANIMATION + 1; name <= CS_SVG_ANIMATION_TIMING_FUNCTION; name++)
    values[name] = NULL;
}

static celspan_status apply_declarations(collecting *c, const cs_css_declarations *list,
                                         bool is_important) {
  for (size_t i = 0; i < list->count; i++) {
    const cs_css_declaration *it = &list->items[i];
    if (it->is_important != is_important)
      continue;
    if (it->custom) {
      CS_TRY(
          cs_svg_variable_add(&c->document->variables, it->custom, it->value, &c->out->variables));
      continue;
    }
    if (it->name == CS_SVG_ANIMATION)
      forget_parts(c->out->values);
    c->out->values[it->name] = it->value;
    c->has_variable = c->has_variable || it->has_variable;
  }
  return CELSPAN_OK;
}

static celspan_status apply_sheet(collecting *c, bool is_important) {
  const cs_css_sheet *sheet = &c->document->sheet;
  for (size_t i = 0; i < sheet->count; i++) {
    const cs_css_rule *rule = &sheet->rules[i];
    if (fits_chain(rule, rule->compound_count, c->node, c->tests))
      CS_TRY(apply_declarations(c, &rule->declarations, is_important));
  }
  return CELSPAN_OK;
}

static void apply_attributes(collecting *c) {
  for (size_t i = 0; i < c->node->attribute_count; i++) {
    const cs_svg_attribute *it = &c->node->attributes[i];
    if (cs_svg_name_facts_of(it->name)->use != CS_SVG_USE_PRESENTED)
      continue;
    c->out->values[it->name] = it->value;
    c->has_variable = c->has_variable || it->has_variable;
  }
}

/* A value whose variables cannot be replaced, or which is invalid afterwards, counts as not
 * given. */
static celspan_status fill_variables(collecting *c) {
  for (int i = 0; i < CS_SVG_NAME_COUNT && c->has_variable; i++) {
    const char **value = &c->out->values[i], *given = *value;
    if (!given || !cs_svg_has_variable(given))
      continue;
    CS_TRY(cs_svg_variable_fill(&c->document->variables, c->out->variables, given, value));
    if (*value && cs_svg_value_is_read((cs_svg_name)i, *value, true))
      continue;
    *value = NULL;
    CS_TRY(cs_svg_unread_add(&c->document->unread, c->context, &c->document->arena, c->node->line,
                             cs_svg_name_text((cs_svg_name)i), given));
  }
  return CELSPAN_OK;
}

/* The meaning of words that are valid for every property, if it is the same for all of them. */
static const char *common_value(cs_svg_name name, const char *value) {
  const char *initial = cs_svg_name_facts_of(name)->initial;
  if (!*value || !strchr("iurIUR", *value))
    return value;
  if (cs_svg_is_word(value, "initial"))
    return initial;
  bool is_unset = cs_svg_is_word(value, "unset") || cs_svg_is_word(value, "revert") ||
                  cs_svg_is_word(value, "revert-layer") ||
                  (initial && cs_svg_is_word(value, "inherit"));
  return is_unset ? NULL : value;
}

celspan_status cs_svg_cascade_collect(celspan_context *context, cs_svg_document *document,
                                      const cs_svg_node *node, const cs_svg_variable *inherited,
                                      uint64_t *tests, cs_svg_cascade *out) {
  collecting c = {context, document, node, tests, out, false};
  *out = (cs_svg_cascade){.variables = inherited};
  apply_attributes(&c);
  CS_TRY(apply_sheet(&c, false));
  CS_TRY(apply_declarations(&c, &node->style, false));
  CS_TRY(apply_declarations(&c, &node->moved, false));
  CS_TRY(apply_sheet(&c, true));
  CS_TRY(apply_declarations(&c, &node->style, true));
  if (*tests == 0)
    return cs_fail(context, CELSPAN_LIMIT,
                   "line %u: the selectors of the style sheets take too long", node->line);
  CS_TRY(fill_variables(&c));
  for (int i = 0; i < CS_SVG_NAME_COUNT; i++)
    if (out->values[i])
      out->values[i] = common_value((cs_svg_name)i, out->values[i]);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- places and sizes */

/* One pass through the document. */
typedef struct pass {
  celspan_context *context;
  cs_svg_document *document;
  uint64_t *tests;
} pass;

/* Source: SVG 2, 8.12 and the tables of properties of the elements. */
static bool has_property(const cs_svg_node *node, cs_svg_name name) {
  bool is_circle = node->element == CS_SVG_ELEMENT_CIRCLE;
  bool is_ellipse = node->element == CS_SVG_ELEMENT_ELLIPSE;
  bool is_rect = node->element == CS_SVG_ELEMENT_RECT;
  switch (name) {
  case CS_SVG_CX:
  case CS_SVG_CY:
    return is_circle || is_ellipse;
  case CS_SVG_R:
    return is_circle;
  case CS_SVG_RX:
  case CS_SVG_RY:
    return is_ellipse || is_rect;
  case CS_SVG_D:
    return node->element == CS_SVG_ELEMENT_PATH;
  case CS_SVG_X:
  case CS_SVG_Y:
  case CS_SVG_WIDTH:
  case CS_SVG_HEIGHT:
    return is_rect || node->element == CS_SVG_ELEMENT_SVG ||
           node->element == CS_SVG_ELEMENT_IMAGE || node->element == CS_SVG_ELEMENT_USE;
  default:
    return false;
  }
}

/* The data in path("..."); other values do not change. */
static celspan_status unwrap(pass *p, const char **value) {
  const char *begin = strpbrk(*value, "\"'"), *end = begin ? strrchr(*value, *begin) : NULL;
  if (!begin || strncmp(*value, "path(", 5) != 0 || end == begin)
    return CELSPAN_OK;
  size_t size = (size_t)(end - begin) - 1;
  char *copy = cs_arena_take(p->context, &p->document->arena, size + 1);
  if (!copy)
    return CELSPAN_NO_MEMORY;
  memcpy(copy, begin + 1, size);
  copy[size] = 0;
  *value = copy;
  return CELSPAN_OK;
}

/* Replaces the attributes of an element by new ones: its own attributes, with the values of styles
 * inserted. */
static celspan_status set_attributes(pass *p, cs_svg_node *node, const cs_svg_cascade *from) {
  cs_svg_attribute *list =
      cs_arena_take(p->context, &p->document->arena, CS_SVG_NAME_COUNT * sizeof *list);
  size_t count = node->attribute_count;
  if (!list)
    return CELSPAN_NO_MEMORY;
  if (count > 0)
    memcpy(list, node->attributes, count * sizeof *list);
  for (int name = 0; name < CS_SVG_NAME_COUNT; name++) {
    const char *value = from->values[name];
    size_t place = 0;
    if (!value || !has_property(node, (cs_svg_name)name))
      continue;
    while (place < count && list[place].name != (cs_svg_name)name)
      place++;
    CS_TRY(unwrap(p, &value));
    list[place] = (cs_svg_attribute){(cs_svg_name)name, false, value};
    count += place == count;
  }
  node->attributes = list;
  node->attribute_count = count;
  return CELSPAN_OK;
}

static bool gives_geometry(const cs_svg_node *node, const cs_svg_cascade *from) {
  for (int name = 0; name < CS_SVG_NAME_COUNT; name++)
    if (from->values[name] && has_property(node, (cs_svg_name)name))
      return true;
  return false;
}

/* Recursion: the depth of the document. */
static celspan_status visit(pass *p, cs_svg_node *node, const cs_svg_variable *inherited) {
  cs_svg_cascade from;
  CS_TRY(cs_svg_cascade_collect(p->context, p->document, node, inherited, p->tests, &from));
  if (gives_geometry(node, &from))
    CS_TRY(set_attributes(p, node, &from));
  for (cs_svg_node *child = node->first; child; child = child->next)
    if (child->element != CS_SVG_ELEMENT_CHARACTERS)
      CS_TRY(visit(p, child, from.variables));
  return CELSPAN_OK;
}

celspan_status cs_svg_cascade_geometry(celspan_context *context, cs_svg_document *document,
                                       uint64_t *tests) {
  pass p = {context, document, tests};
  return document->has_geometry ? visit(&p, document->root, NULL) : CELSPAN_OK;
}
