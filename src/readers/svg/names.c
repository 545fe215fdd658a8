#include "readers/svg/names.h"

#include <stdlib.h>
#include <string.h>

static const char *const elements[CS_SVG_ELEMENT_COUNT] = {
    "a",        "circle",  "clipPath", "defs",
    "desc",     "ellipse", "filter",   "foreignObject",
    "g",        "image",   "line",     "linearGradient",
    "marker",   "mask",    "metadata", "path",
    "pattern",  "polygon", "polyline", "radialGradient",
    "rect",     "script",  "stop",     "style",
    "svg",      "switch",  "symbol",   "text",
    "textPath", "title",   "tspan",    "use",
    "view",
};

typedef struct name_entry {
  const char *text;
  bool is_property;
} name_entry;

static const name_entry names[CS_SVG_NAME_COUNT] = {
    {"baseline-shift", true},
    {"class", false},
    {"clip-path", true},
    {"clip-rule", true},
    {"clipPathUnits", false},
    {"color", true},
    {"cx", false},
    {"cy", false},
    {"d", false},
    {"direction", true},
    {"display", true},
    {"dx", false},
    {"dy", false},
    {"fill", true},
    {"fill-opacity", true},
    {"fill-rule", true},
    {"filter", true},
    {"font-family", true},
    {"font-size", true},
    {"font-style", true},
    {"font-weight", true},
    {"fr", false},
    {"fx", false},
    {"fy", false},
    {"gradientTransform", false},
    {"gradientUnits", false},
    {"height", false},
    {"href", false},
    {"id", false},
    {"isolation", true},
    {"label", false},
    {"lengthAdjust", false},
    {"letter-spacing", true},
    {"marker", true},
    {"marker-end", true},
    {"marker-mid", true},
    {"marker-start", true},
    {"markerHeight", false},
    {"markerUnits", false},
    {"markerWidth", false},
    {"mask", true},
    {"mask-type", true},
    {"maskContentUnits", false},
    {"maskUnits", false},
    {"mix-blend-mode", true},
    {"offset", false},
    {"opacity", true},
    {"orient", false},
    {"overflow", true},
    {"paint-order", true},
    {"pathLength", false},
    {"points", false},
    {"preserveAspectRatio", false},
    {"r", false},
    {"refX", false},
    {"refY", false},
    {"requiredExtensions", false},
    {"requiredFeatures", false},
    {"rotate", false},
    {"rx", false},
    {"ry", false},
    {"side", false},
    {"space", false},
    {"spreadMethod", false},
    {"startOffset", false},
    {"stop-color", true},
    {"stop-opacity", true},
    {"stroke", true},
    {"stroke-dasharray", true},
    {"stroke-dashoffset", true},
    {"stroke-linecap", true},
    {"stroke-linejoin", true},
    {"stroke-miterlimit", true},
    {"stroke-opacity", true},
    {"stroke-width", true},
    {"style", false},
    {"systemLanguage", false},
    {"text-anchor", true},
    {"text-decoration", true},
    {"textLength", false},
    {"transform", true},
    {"transform-origin", true},
    {"type", false},
    {"vector-effect", true},
    {"viewBox", false},
    {"visibility", true},
    {"width", false},
    {"word-spacing", true},
    {"writing-mode", true},
    {"x", false},
    {"x1", false},
    {"x2", false},
    {"y", false},
    {"y1", false},
    {"y2", false},
};

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
