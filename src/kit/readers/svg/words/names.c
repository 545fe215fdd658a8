#include "readers/svg/words/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "common/utf8.h"

#define ELEMENT(name, text) text
static const char *const elements[] = {CS_SVG_ELEMENT_LIST(ELEMENT)};

/* The possible lines at which a baseline lies. */
#define BASELINES                                                                                  \
  "auto|baseline|alphabetic|middle|central|hanging|mathematical|ideographic|text-top|text-bottom|" \
  "before-edge|after-edge|text-before-edge|text-after-edge"

/* Source: W3C Compositing and Blending Level 1, 5.1, and Level 2 for the last. */
#define BLEND_MODES                                                                                \
  "normal|multiply|screen|overlay|darken|lighten|color-dodge|color-burn|hard-light|soft-light|"    \
  "difference|exclusion|hue|saturation|color|luminosity|plus-lighter|inherit"

#define NAME(name, text, use, form)                                                                \
  { text, CS_SVG_USE_##use, CS_SVG_FORM_##form, NULL, NULL }
#define WITH(name, text, use, form, words, initial)                                                \
  { text, CS_SVG_USE_##use, CS_SVG_FORM_##form, words, initial }
static const cs_svg_name_facts names[] = {CS_SVG_NAME_LIST(NAME, WITH)};

static int compare_text(const void *key, const void *item) {
  return strcmp(key, *(const char *const *)item);
}

static int compare_name(const void *key, const void *item) {
  return strcmp(key, ((const cs_svg_name_facts *)item)->text);
}

cs_svg_element cs_svg_element_named(const char *text) {
  const char *const *found =
      bsearch(text, elements, CS_SVG_ELEMENT_COUNT, sizeof *elements, compare_text);
  return found ? (cs_svg_element)(found - elements) : CS_SVG_ELEMENT_OTHER;
}

bool cs_svg_element_is_drawn(cs_svg_element element) {
  if (element >= CS_SVG_ELEMENT_FE_BLEND && element <= CS_SVG_ELEMENT_FILTER)
    return false;
  switch (element) {
  case CS_SVG_ELEMENT_ANIMATE:
  case CS_SVG_ELEMENT_ANIMATE_MOTION:
  case CS_SVG_ELEMENT_ANIMATE_TRANSFORM:
  case CS_SVG_ELEMENT_DESC:
  case CS_SVG_ELEMENT_FOREIGN_OBJECT:
  case CS_SVG_ELEMENT_METADATA:
  case CS_SVG_ELEMENT_MPATH:
  case CS_SVG_ELEMENT_SCRIPT:
  case CS_SVG_ELEMENT_SET:
  case CS_SVG_ELEMENT_TITLE:
  case CS_SVG_ELEMENT_VIEW:
  case CS_SVG_ELEMENT_OTHER:
    return false;
  default:
    return true;
  }
}

bool cs_svg_element_animates(cs_svg_element element) {
  return element == CS_SVG_ELEMENT_ANIMATE || element == CS_SVG_ELEMENT_ANIMATE_MOTION ||
         element == CS_SVG_ELEMENT_ANIMATE_TRANSFORM || element == CS_SVG_ELEMENT_SET;
}

cs_svg_name cs_svg_name_of(const char *text) {
  const cs_svg_name_facts *found =
      bsearch(text, names, CS_SVG_NAME_COUNT, sizeof *names, compare_name);
  return found ? (cs_svg_name)(found - names) : CS_SVG_NAME_COUNT;
}

const cs_svg_name_facts *cs_svg_name_facts_of(cs_svg_name name) { return &names[name]; }

bool cs_svg_is_property(cs_svg_name name) { return names[name].use != CS_SVG_USE_ATTRIBUTE; }

const char *cs_svg_name_text(cs_svg_name name) { return names[name].text; }

#define SPACE " \t\n\v\f\r"

bool cs_svg_words_have(const char *words, const char *value) {
  value += strspn(value, SPACE);
  size_t size = strcspn(value, SPACE);
  if (size == 0 || value[size + strspn(value + size, SPACE)])
    return false;
  for (const char *at = words; at; at = strchr(at, '|') ? strchr(at, '|') + 1 : NULL)
    if (strncasecmp(at, value, size) == 0 && (at[size] == '|' || at[size] == 0))
      return true;
  return false;
}

/* ---------------------------------------------------------------- names that are not read */

#define TEXT 120 /* bytes of an entry */

static cs_hash hash_name(const char *name) {
  cs_hash hash = cs_hash_begin(0x756e7265u);
  cs_hash_text(&hash, name);
  return cs_hash_end(hash);
}

celspan_status cs_svg_unread_add(cs_svg_unread *list, celspan_context *context, cs_arena *arena,
                                 uint32_t line, const char *name, const char *value) {
  size_t there;
  if (list->count == CS_SVG_UNREAD || cs_hash_table_find(&list->names, hash_name(name), &there))
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(context, (void **)&list->items, &list->capacity, list->count + 1,
                        sizeof *list->items));
  char *text = cs_arena_take(context, arena, TEXT);
  if (!text)
    return CELSPAN_NO_MEMORY;
  if (value)
    snprintf(text, TEXT, "%.*s \"%.*s\"", (int)cs_utf8_cut(name, 40), name,
             (int)cs_utf8_cut(value, 60), value);
  else
    snprintf(text, TEXT, "%.*s", (int)cs_utf8_cut(name, 60), name);
  CS_TRY(cs_hash_table_add(&list->names, context, hash_name(name), list->count));
  list->items[list->count++] = (cs_svg_unread_name){text, line};
  return CELSPAN_OK;
}

void cs_svg_unread_finish(cs_svg_unread *list, celspan_context *context) {
  cs_mem_free(context->memory, list->items, list->capacity * sizeof *list->items);
  cs_hash_table_finish(&list->names, context);
  *list = (cs_svg_unread){0};
}
