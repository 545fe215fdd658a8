#include "readers/svg/names.h"

#include <stdlib.h>
#include <string.h>

#define ELEMENT(name, text) text
static const char *const elements[] = {CS_SVG_ELEMENT_LIST(ELEMENT)};

typedef struct name_entry {
  const char *text;
  bool is_property;
} name_entry;

#define NAME(name, text, is_property)                                                              \
  { text, is_property }
static const name_entry names[] = {CS_SVG_NAME_LIST(NAME)};

static int compare_text(const void *key, const void *item) {
  return strcmp(key, *(const char *const *)item);
}

static int compare_name(const void *key, const void *item) {
  return strcmp(key, ((const name_entry *)item)->text);
}

cs_svg_element cs_svg_element_named(const char *text) {
  const char *const *found =
      bsearch(text, elements, CS_SVG_ELEMENT_COUNT, sizeof *elements, compare_text);
  return found ? (cs_svg_element)(found - elements) : CS_SVG_ELEMENT_OTHER;
}

cs_svg_name cs_svg_name_of(const char *text) {
  const name_entry *found = bsearch(text, names, CS_SVG_NAME_COUNT, sizeof *names, compare_name);
  return found ? (cs_svg_name)(found - names) : CS_SVG_NAME_COUNT;
}

bool cs_svg_is_property(cs_svg_name name) { return names[name].is_property; }

const char *cs_svg_name_text(cs_svg_name name) { return names[name].text; }
