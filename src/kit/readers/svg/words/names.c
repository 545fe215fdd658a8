#include "readers/svg/words/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "common/utf8.h"

#define ELEMENT(name, text) text
static const char *const elements[] = {CS_SVG_ELEMENT_LIST(ELEMENT)};

#define ATTRIBUTE CS_SVG_USE_ATTRIBUTE
#define PRESENTED CS_SVG_USE_PRESENTED
#define STYLED CS_SVG_USE_STYLED
#define GEOMETRY CS_SVG_USE_GEOMETRY
#define APART CS_SVG_USE_APART
#define FORM(name) CS_SVG_FORM_##name

/* The possible lines at which a baseline lies. */
#define BASELINES                                                                                  \
  "auto|baseline|alphabetic|middle|central|hanging|mathematical|ideographic|text-top|text-bottom|" \
  "before-edge|after-edge|text-before-edge|text-after-edge"

/* Source: W3C Compositing and Blending Level 1, 5.1, and Level 2 for the last. */
#define BLEND_MODES                                                                                \
  "normal|multiply|screen|overlay|darken|lighten|color-dodge|color-burn|hard-light|soft-light|"    \
  "difference|exclusion|hue|saturation|color|luminosity|plus-lighter|inherit"

static const cs_svg_name_facts names[CS_SVG_NAME_COUNT] = {
    {"accumulate", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"additive", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"alignment-baseline", PRESENTED, FORM(WORD), BASELINES "|top|center|bottom", NULL},
    {"amplitude", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"animation", STYLED, FORM(ANY), NULL, NULL},
    {"animation-composition", STYLED, FORM(ANY), NULL, NULL},
    {"animation-delay", STYLED, FORM(ANY), NULL, NULL},
    {"animation-direction", STYLED, FORM(ANY), NULL, NULL},
    {"animation-duration", STYLED, FORM(ANY), NULL, NULL},
    {"animation-fill-mode", STYLED, FORM(ANY), NULL, NULL},
    {"animation-iteration-count", STYLED, FORM(ANY), NULL, NULL},
    {"animation-name", STYLED, FORM(ANY), NULL, NULL},
    {"animation-play-state", STYLED, FORM(ANY), NULL, NULL},
    {"animation-timing-function", STYLED, FORM(ANY), NULL, NULL},
    {"attributeName", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"azimuth", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"baseFrequency", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"baseline-shift", PRESENTED, FORM(LENGTH), "baseline|sub|super", NULL},
    {"begin", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"bias", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"by", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"calcMode", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"class", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"clip-path", PRESENTED, FORM(ANY), NULL, NULL},
    {"clip-rule", PRESENTED, FORM(WORD), "nonzero|evenodd", "nonzero"},
    {"clipPathUnits", ATTRIBUTE, FORM(WORD), "userSpaceOnUse|objectBoundingBox", NULL},
    {"color", PRESENTED, FORM(COLOUR), NULL, "black"},
    {"color-interpolation-filters", PRESENTED, FORM(WORD), "auto|sRGB|linearRGB", "linearRGB"},
    {"cx", GEOMETRY, FORM(LENGTH), NULL, NULL},
    {"cy", GEOMETRY, FORM(LENGTH), NULL, NULL},
    {"d", GEOMETRY, FORM(ANY), NULL, NULL},
    {"diffuseConstant", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"direction", PRESENTED, FORM(WORD), "ltr|rtl", "ltr"},
    {"display", PRESENTED, FORM(ANY), NULL, NULL},
    {"divisor", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"dominant-baseline", PRESENTED, FORM(WORD), BASELINES "|use-script|no-change|reset-size",
     "auto"},
    {"dur", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"dx", ATTRIBUTE, FORM(LENGTHS), NULL, NULL},
    {"dy", ATTRIBUTE, FORM(LENGTHS), NULL, NULL},
    {"edgeMode", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"elevation", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"end", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"exponent", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"fill", PRESENTED, FORM(PAINT), NULL, "black"},
    {"fill-opacity", PRESENTED, FORM(SHARE), NULL, "1"},
    {"fill-rule", PRESENTED, FORM(WORD), "nonzero|evenodd", "nonzero"},
    {"filter", PRESENTED, FORM(FILTERS), "none|inherit", NULL},
    {"filterUnits", ATTRIBUTE, FORM(WORD), "userSpaceOnUse|objectBoundingBox", NULL},
    {"flood-color", PRESENTED, FORM(COLOUR), "inherit", NULL},
    {"flood-opacity", PRESENTED, FORM(SHARE), NULL, NULL},
    {"font-family", PRESENTED, FORM(ANY), NULL, ""},
    {"font-size", PRESENTED, FORM(SIZE),
     "xx-small|x-small|small|medium|large|x-large|xx-large|xxx-large|smaller|larger", "medium"},
    {"font-style", PRESENTED, FORM(SLANT), "normal|italic|oblique", "normal"},
    {"font-weight", PRESENTED, FORM(NUMBER), "normal|bold|bolder|lighter", "normal"},
    {"fr", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"from", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"fx", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"fy", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"gradientTransform", ATTRIBUTE, FORM(TRANSFORM), NULL, NULL},
    {"gradientUnits", ATTRIBUTE, FORM(WORD), "userSpaceOnUse|objectBoundingBox", NULL},
    {"height", GEOMETRY, FORM(LENGTH), "auto", NULL},
    {"href", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"id", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"in", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"in2", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"intercept", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"isolation", STYLED, FORM(WORD), "auto|isolate", NULL},
    {"k1", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"k2", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"k3", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"k4", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"kernelMatrix", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"kernelUnitLength", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"keyPoints", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"keySplines", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"keyTimes", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"label", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"lengthAdjust", ATTRIBUTE, FORM(WORD), "spacing|spacingAndGlyphs", NULL},
    {"letter-spacing", PRESENTED, FORM(LENGTH), "normal", "normal"},
    {"lighting-color", PRESENTED, FORM(COLOUR), "inherit", NULL},
    {"limitingConeAngle", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"marker", STYLED, FORM(REFERENCE), "none", "none"},
    {"marker-end", PRESENTED, FORM(REFERENCE), "none", "none"},
    {"marker-mid", PRESENTED, FORM(REFERENCE), "none", "none"},
    {"marker-start", PRESENTED, FORM(REFERENCE), "none", "none"},
    {"markerHeight", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"markerUnits", ATTRIBUTE, FORM(WORD), "strokeWidth|userSpaceOnUse", NULL},
    {"markerWidth", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"mask", PRESENTED, FORM(REFERENCE), "none|inherit", NULL},
    {"mask-type", PRESENTED, FORM(WORD), "luminance|alpha", NULL},
    {"maskContentUnits", ATTRIBUTE, FORM(WORD), "userSpaceOnUse|objectBoundingBox", NULL},
    {"maskUnits", ATTRIBUTE, FORM(WORD), "userSpaceOnUse|objectBoundingBox", NULL},
    {"max", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"media", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"min", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"mix-blend-mode", STYLED, FORM(WORD), BLEND_MODES, NULL},
    {"mode", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"numOctaves", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"offset", ATTRIBUTE, FORM(SHARE), NULL, NULL},
    {"offset-anchor", STYLED, FORM(ANY), NULL, NULL},
    {"offset-distance", STYLED, FORM(DISTANCE), NULL, NULL},
    {"offset-path", STYLED, FORM(WAY), NULL, NULL},
    {"offset-rotate", STYLED, FORM(HEADING), NULL, NULL},
    {"opacity", PRESENTED, FORM(SHARE), "inherit", NULL},
    {"operator", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"order", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"orient", ATTRIBUTE, FORM(ANGLE), "auto|auto-start-reverse", NULL},
    {"overflow", PRESENTED, FORM(WORD), "visible|hidden|scroll|auto|clip|inherit", NULL},
    {"paint-order", PRESENTED, FORM(ORDER), "normal", "normal"},
    {"path", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"pathLength", ATTRIBUTE, FORM(NUMBER), NULL, NULL},
    {"patternContentUnits", ATTRIBUTE, FORM(WORD), "userSpaceOnUse|objectBoundingBox", NULL},
    {"patternTransform", ATTRIBUTE, FORM(TRANSFORM), NULL, NULL},
    {"patternUnits", ATTRIBUTE, FORM(WORD), "userSpaceOnUse|objectBoundingBox", NULL},
    {"points", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"pointsAtX", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"pointsAtY", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"pointsAtZ", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"preserveAlpha", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"preserveAspectRatio", ATTRIBUTE, FORM(ASPECT), NULL, NULL},
    {"primitiveUnits", ATTRIBUTE, FORM(WORD), "userSpaceOnUse|objectBoundingBox", NULL},
    {"r", GEOMETRY, FORM(LENGTH), NULL, NULL},
    {"radius", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"refX", ATTRIBUTE, FORM(LENGTH), "left|center|right", NULL},
    {"refY", ATTRIBUTE, FORM(LENGTH), "top|center|bottom", NULL},
    {"repeatCount", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"repeatDur", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"requiredExtensions", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"requiredFeatures", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"restart", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"result", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"rotate", APART, FORM(ROTATION), NULL, NULL},
    {"rx", GEOMETRY, FORM(LENGTH), "auto", NULL},
    {"ry", GEOMETRY, FORM(LENGTH), "auto", NULL},
    {"scale", STYLED, FORM(SCALE), "none", NULL},
    {"seed", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"side", ATTRIBUTE, FORM(WORD), "left|right", NULL},
    {"slope", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"space", ATTRIBUTE, FORM(WORD), "default|preserve", NULL},
    {"specularConstant", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"specularExponent", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"spreadMethod", ATTRIBUTE, FORM(WORD), "pad|reflect|repeat", NULL},
    {"startOffset", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"stdDeviation", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"stitchTiles", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"stop-color", PRESENTED, FORM(COLOUR), "inherit", NULL},
    {"stop-opacity", PRESENTED, FORM(SHARE), NULL, NULL},
    {"stroke", PRESENTED, FORM(PAINT), NULL, "none"},
    {"stroke-dasharray", PRESENTED, FORM(LENGTHS), "none", "none"},
    {"stroke-dashoffset", PRESENTED, FORM(LENGTH), NULL, "0"},
    {"stroke-linecap", PRESENTED, FORM(WORD), "butt|round|square", "butt"},
    {"stroke-linejoin", PRESENTED, FORM(WORD), "miter|miter-clip|arcs|round|bevel", "miter"},
    {"stroke-miterlimit", PRESENTED, FORM(NUMBER), NULL, "4"},
    {"stroke-opacity", PRESENTED, FORM(SHARE), NULL, "1"},
    {"stroke-width", PRESENTED, FORM(SIZE), NULL, "1"},
    {"style", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"surfaceScale", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"systemLanguage", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"tableValues", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"targetX", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"targetY", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"text-anchor", PRESENTED, FORM(WORD), "start|middle|end", "start"},
    {"text-decoration", PRESENTED, FORM(WORD), "none", NULL},
    {"textLength", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"to", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"transform", PRESENTED, FORM(TRANSFORM), "none|inherit", NULL},
    {"transform-box", STYLED, FORM(WORD), "view-box|fill-box|content-box", NULL},
    {"transform-origin", PRESENTED, FORM(ANY), NULL, NULL},
    {"translate", STYLED, FORM(TRANSLATE), "none", NULL},
    {"type", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"values", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"vector-effect", PRESENTED, FORM(WORD), "none|non-scaling-stroke", NULL},
    {"viewBox", ATTRIBUTE, FORM(VIEW_BOX), NULL, NULL},
    {"visibility", PRESENTED, FORM(WORD), "visible|hidden|collapse", "visible"},
    {"width", GEOMETRY, FORM(LENGTH), "auto", NULL},
    {"word-spacing", PRESENTED, FORM(LENGTH), "normal", "normal"},
    {"writing-mode", PRESENTED, FORM(WORD), "horizontal-tb|lr|lr-tb", "horizontal-tb"},
    {"x", GEOMETRY, FORM(LENGTHS), NULL, NULL},
    {"x1", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"x2", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"xChannelSelector", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"y", GEOMETRY, FORM(LENGTHS), NULL, NULL},
    {"y1", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"y2", ATTRIBUTE, FORM(LENGTH), NULL, NULL},
    {"yChannelSelector", ATTRIBUTE, FORM(ANY), NULL, NULL},
    {"z", ATTRIBUTE, FORM(ANY), NULL, NULL},
};

#undef ATTRIBUTE
#undef PRESENTED
#undef STYLED
#undef GEOMETRY
#undef APART

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
