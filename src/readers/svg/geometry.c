#include "readers/svg/geometry.h"

#include <string.h>

#include "readers/svg/values.h"

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

/* The data in path("..."); other values unchanged. */
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

/* Gives the element other attributes: its own with the values of styles in their place. */
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

celspan_status cs_svg_geometry_apply(celspan_context *context, cs_svg_document *document,
                                     uint64_t *tests) {
  pass p = {context, document, tests};
  return document->has_geometry ? visit(&p, document->root, NULL) : CELSPAN_OK;
}
