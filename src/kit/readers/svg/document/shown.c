#include "readers/svg/document/shown.h"

#include <string.h>

#include "readers/svg/words/values.h"

static bool has_word(const char *list, const char *word) {
  size_t size = strlen(word);
  for (const char *at = cs_svg_skip_comma(list); *at; at = cs_svg_skip_comma(at)) {
    size_t length = strcspn(at, ", \t\n\f\r");
    if (strncmp(at, word, size) == 0 && (length == size || at[size] == '-'))
      return true;
    at += length;
  }
  return false;
}

/* Whether `switch` may choose this child: it is for readers of English. */
static bool passes_switch(const cs_svg_node *node) {
  const char *extensions = cs_svg_node_value(node, CS_SVG_REQUIRED_EXTENSIONS);
  const char *language = cs_svg_node_value(node, CS_SVG_SYSTEM_LANGUAGE);
  return !(extensions && *cs_svg_skip_space(extensions)) && (!language || has_word(language, "en"));
}

/* Whether an element draws nothing by itself, so that no note is needed. */
static bool is_silent(const cs_svg_node *node, const cs_svg_node *sizes) {
  switch (node->element) {
  case CS_SVG_ELEMENT_ANIMATE:
  case CS_SVG_ELEMENT_ANIMATE_MOTION:
  case CS_SVG_ELEMENT_ANIMATE_TRANSFORM:
  case CS_SVG_ELEMENT_CHARACTERS:
  case CS_SVG_ELEMENT_CLIP_PATH:
  case CS_SVG_ELEMENT_DEFS:
  case CS_SVG_ELEMENT_DESC:
  case CS_SVG_ELEMENT_FILTER:
  case CS_SVG_ELEMENT_LINEAR_GRADIENT:
  case CS_SVG_ELEMENT_MARKER:
  case CS_SVG_ELEMENT_MASK:
  case CS_SVG_ELEMENT_METADATA:
  case CS_SVG_ELEMENT_MPATH:
  case CS_SVG_ELEMENT_PATTERN:
  case CS_SVG_ELEMENT_RADIAL_GRADIENT:
  case CS_SVG_ELEMENT_SET:
  case CS_SVG_ELEMENT_STOP:
  case CS_SVG_ELEMENT_STYLE:
  case CS_SVG_ELEMENT_TITLE:
  case CS_SVG_ELEMENT_VIEW:
    return true;
  case CS_SVG_ELEMENT_SYMBOL:
    return !sizes;
  default:
    return false;
  }
}

bool cs_svg_is_shown(const cs_svg_node *node, const cs_svg_node *sizes) {
  return !is_silent(node, sizes) && passes_switch(node);
}

const cs_svg_node *cs_svg_shown_choice(const cs_svg_node *node) {
  const cs_svg_node *child = node->first;
  while (child && (child->element == CS_SVG_ELEMENT_OTHER ||
                   cs_svg_element_animates(child->element) || !passes_switch(child)))
    child = child->next;
  return child;
}
