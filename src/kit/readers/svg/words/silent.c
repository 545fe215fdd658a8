#include "readers/svg/words/silent.h"

#include <stdlib.h>
#include <string.h>

#include "readers/svg/words/names.h"

/* Names for web pages, scripts, links and screen readers, and names that belong to an element that
 * has a note itself; some of them only with a few values, which have '|' between them. */
#define SILENT_NAMES                                                                               \
  "about", "appearance", "autofocus", "backdrop-filter:none", "backface-visibility",               \
      "background:none|transparent", "background-color:none|transparent", "background-image:none", \
      "baseProfile", "block-progression:tb", "border:none|0", "border-collapse", "border-spacing", \
      "box-sizing", "break-inside", "caption-side", "caret-color", "clear:none", "clip:auto",      \
      "color-interpolation:auto|sRGB", "color-profile:auto|sRGB", "color-rendering",               \
      "contain:none", "content-visibility:visible", "contentScriptType", "contentStyleType",       \
      "counter-increment", "counter-reset", "crossorigin", "cursor", "datatype", "decoding",       \
      "download", "empty-cells", "enable-background", "externalResourcesRequired",                 \
      "fetchpriority", "float:none", "focusable", "font-feature-settings:normal",                  \
      "font-kerning:auto|normal", "font-language-override:normal", "font-optical-sizing:auto",     \
      "font-palette:normal", "font-size-adjust:none", "font-stretch:normal|100%",                  \
      "font-synthesis", "font-variant:normal", "font-variant-alternates:normal",                   \
      "font-variant-caps:normal", "font-variant-east-asian:normal",                                \
      "font-variant-ligatures:normal", "font-variant-numeric:normal",                              \
      "font-variant-position:normal", "font-variation-settings:normal",                            \
      "glyph-orientation-horizontal:0|0deg|auto", "glyph-orientation-vertical:auto", "hreflang",   \
      "hyphens", "image-rendering:auto|smooth|high-quality|optimizeQuality", "inline-size:auto|0", \
      "inlist", "kerning:auto", "lang", "line-height", "line-spacing", "list-style", "loading",    \
      "margin", "margin-bottom", "margin-left", "margin-right", "margin-top", "mask-border:none",  \
      "mask-clip:border-box", "mask-composite:add", "mask-image:none", "mask-mode:match-source",   \
      "mask-origin:border-box", "mask-position", "mask-repeat", "mask-size:auto", "max-height",    \
      "max-width", "method:align", "min-height", "min-width", "nonce", "offset-path:none",         \
      "orphans", "outline", "overflow-wrap", "padding", "padding-bottom", "padding-left",          \
      "padding-right", "padding-top", "page-break-after", "page-break-before",                     \
      "page-break-inside", "part", "perspective:none", "ping", "pointer-events", "position",       \
      "property", "quotes", "referrerPolicy", "referrerpolicy", "rel", "resource", "rev", "role",  \
      "shape-inside:none|auto", "shape-margin:0|0px", "shape-padding:0|0px", "shape-rendering",    \
      "shape-subtract:none", "slot", "solid-color", "solid-opacity", "spacing:exact|auto",         \
      "speak", "src", "stroke-alignment:center", "stroke-dashadjust:none",                         \
      "stroke-dashcorner:none", "tabindex", "target", "text-align", "text-align-last:auto",        \
      "text-combine-upright:none", "text-decoration-color", "text-decoration-line:none",           \
      "text-decoration-skip", "text-decoration-skip-ink", "text-decoration-style:solid",           \
      "text-decoration-thickness", "text-emphasis:none", "text-indent", "text-justify",            \
      "text-orientation:mixed", "text-overflow:clip", "text-rendering", "text-shadow:none",        \
      "text-size-adjust", "text-transform:none", "text-underline-offset",                          \
      "text-underline-position", "text-wrap", "title", "touch-action", "transform-style:flat",     \
      "transition", "transition-delay", "transition-duration", "transition-property",              \
      "transition-timing-function", "typeof", "unicode-bidi:normal|embed", "unicode-range",        \
      "user-select", "version", "vertical-align:baseline", "viewport-fill",                        \
      "viewport-fill-opacity", "vocab", "white-space:normal", "widows", "will-change",             \
      "word-break", "word-wrap", "xmlns", "z-index:auto|0", "zoom:1|normal", "zoomAndPan"
static const char *const silent_names[] = {SILENT_NAMES};

/* Compares a name with the name of a row. */
static int compare_silent(const void *key, const void *item) {
  const char *name = key, *row = *(const char *const *)item;
  const size_t size = strcspn(row, ":");
  const int order = strncmp(name, row, size);
  return order != 0 ? order : name[size] != '\0';
}

/* Names that only scripts, screen readers or particular programs use. */
static bool is_for_others(const char *text) {
  return strncmp(text, "data-", 5) == 0 || strncmp(text, "aria-", 5) == 0 ||
         strncmp(text, "on", 2) == 0 || *text == '-';
}

bool cs_svg_name_is_silent(const char *text, const char *value) {
  const char *const *found = bsearch(text, silent_names, sizeof silent_names / sizeof *silent_names,
                                     sizeof *silent_names, compare_silent);
  if (!found)
    return is_for_others(text);
  const char *values = strchr(*found, ':');
  return !values || cs_svg_words_have(values + 1, value);
}
