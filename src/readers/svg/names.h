/* The names of SVG that mean something here, as numbers: elements, attributes and properties.
 *
 * Invariant: both lists are sorted as strcmp sorts their texts, which is how they are searched.
 */
#pragma once

#include <stdbool.h>

/* Each element: its enumerator after CS_SVG_ELEMENT_, its text. */
#define CS_SVG_ELEMENT_LIST(ELEMENT)                                                               \
  ELEMENT(A, "a"), ELEMENT(CIRCLE, "circle"), ELEMENT(CLIP_PATH, "clipPath"),                      \
      ELEMENT(DEFS, "defs"), ELEMENT(DESC, "desc"), ELEMENT(ELLIPSE, "ellipse"),                   \
      ELEMENT(FILTER, "filter"), ELEMENT(FOREIGN_OBJECT, "foreignObject"), ELEMENT(G, "g"),        \
      ELEMENT(IMAGE, "image"), ELEMENT(LINE, "line"), ELEMENT(LINEAR_GRADIENT, "linearGradient"),  \
      ELEMENT(MARKER, "marker"), ELEMENT(MASK, "mask"), ELEMENT(METADATA, "metadata"),             \
      ELEMENT(PATH, "path"), ELEMENT(PATTERN, "pattern"), ELEMENT(POLYGON, "polygon"),             \
      ELEMENT(POLYLINE, "polyline"), ELEMENT(RADIAL_GRADIENT, "radialGradient"),                   \
      ELEMENT(RECT, "rect"), ELEMENT(SCRIPT, "script"), ELEMENT(STOP, "stop"),                     \
      ELEMENT(STYLE, "style"), ELEMENT(SVG, "svg"), ELEMENT(SWITCH, "switch"),                     \
      ELEMENT(SYMBOL, "symbol"), ELEMENT(TEXT, "text"), ELEMENT(TEXT_PATH, "textPath"),            \
      ELEMENT(TITLE, "title"), ELEMENT(TSPAN, "tspan"), ELEMENT(USE, "use"), ELEMENT(VIEW, "view")

typedef enum cs_svg_element {
#define ELEMENT(name, text) CS_SVG_ELEMENT_##name
  CS_SVG_ELEMENT_LIST(ELEMENT),
#undef ELEMENT
  CS_SVG_ELEMENT_OTHER,      /* any other of SVG */
  CS_SVG_ELEMENT_CHARACTERS, /* those of a text, between its elements */
  CS_SVG_ELEMENT_COUNT = CS_SVG_ELEMENT_OTHER
} cs_svg_element;

/* Each attribute or property: its enumerator after CS_SVG_, its text, whether it is a property. */
#define CS_SVG_NAME_LIST(NAME)                                                                     \
  NAME(BASELINE_SHIFT, "baseline-shift", true), NAME(CLASS, "class", false),                       \
      NAME(CLIP_PATH, "clip-path", true), NAME(CLIP_RULE, "clip-rule", true),                      \
      NAME(CLIP_PATH_UNITS, "clipPathUnits", false), NAME(COLOR, "color", true),                   \
      NAME(CX, "cx", false), NAME(CY, "cy", false), NAME(D, "d", false),                           \
      NAME(DIRECTION, "direction", true), NAME(DISPLAY, "display", true), NAME(DX, "dx", false),   \
      NAME(DY, "dy", false), NAME(FILL, "fill", true), NAME(FILL_OPACITY, "fill-opacity", true),   \
      NAME(FILL_RULE, "fill-rule", true), NAME(FILTER, "filter", true),                            \
      NAME(FONT_FAMILY, "font-family", true), NAME(FONT_SIZE, "font-size", true),                  \
      NAME(FONT_STYLE, "font-style", true), NAME(FONT_WEIGHT, "font-weight", true),                \
      NAME(FR, "fr", false), NAME(FX, "fx", false), NAME(FY, "fy", false),                         \
      NAME(GRADIENT_TRANSFORM, "gradientTransform", false),                                        \
      NAME(GRADIENT_UNITS, "gradientUnits", false), NAME(HEIGHT, "height", false),                 \
      NAME(HREF, "href", false), NAME(ID, "id", false), NAME(ISOLATION, "isolation", true),        \
      NAME(LABEL, "label", false), NAME(LENGTH_ADJUST, "lengthAdjust", false),                     \
      NAME(LETTER_SPACING, "letter-spacing", true), NAME(MARKER, "marker", true),                  \
      NAME(MARKER_END, "marker-end", true), NAME(MARKER_MID, "marker-mid", true),                  \
      NAME(MARKER_START, "marker-start", true), NAME(MARKER_HEIGHT, "markerHeight", false),        \
      NAME(MARKER_UNITS, "markerUnits", false), NAME(MARKER_WIDTH, "markerWidth", false),          \
      NAME(MASK, "mask", true), NAME(MASK_TYPE, "mask-type", true),                                \
      NAME(MASK_CONTENT_UNITS, "maskContentUnits", false), NAME(MASK_UNITS, "maskUnits", false),   \
      NAME(MIX_BLEND_MODE, "mix-blend-mode", true), NAME(OFFSET, "offset", false),                 \
      NAME(OPACITY, "opacity", true), NAME(ORIENT, "orient", false),                               \
      NAME(OVERFLOW, "overflow", true), NAME(PAINT_ORDER, "paint-order", true),                    \
      NAME(PATH_LENGTH, "pathLength", false), NAME(POINTS, "points", false),                       \
      NAME(PRESERVE_ASPECT_RATIO, "preserveAspectRatio", false), NAME(R, "r", false),              \
      NAME(REF_X, "refX", false), NAME(REF_Y, "refY", false),                                      \
      NAME(REQUIRED_EXTENSIONS, "requiredExtensions", false),                                      \
      NAME(REQUIRED_FEATURES, "requiredFeatures", false), NAME(ROTATE, "rotate", false),           \
      NAME(RX, "rx", false), NAME(RY, "ry", false), NAME(SIDE, "side", false),                     \
      NAME(SPACE, "space", false), NAME(SPREAD_METHOD, "spreadMethod", false),                     \
      NAME(START_OFFSET, "startOffset", false), NAME(STOP_COLOR, "stop-color", true),              \
      NAME(STOP_OPACITY, "stop-opacity", true), NAME(STROKE, "stroke", true),                      \
      NAME(STROKE_DASHARRAY, "stroke-dasharray", true),                                            \
      NAME(STROKE_DASHOFFSET, "stroke-dashoffset", true),                                          \
      NAME(STROKE_LINECAP, "stroke-linecap", true),                                                \
      NAME(STROKE_LINEJOIN, "stroke-linejoin", true),                                              \
      NAME(STROKE_MITERLIMIT, "stroke-miterlimit", true),                                          \
      NAME(STROKE_OPACITY, "stroke-opacity", true), NAME(STROKE_WIDTH, "stroke-width", true),      \
      NAME(STYLE, "style", false), NAME(SYSTEM_LANGUAGE, "systemLanguage", false),                 \
      NAME(TEXT_ANCHOR, "text-anchor", true), NAME(TEXT_DECORATION, "text-decoration", true),      \
      NAME(TEXT_LENGTH, "textLength", false), NAME(TRANSFORM, "transform", true),                  \
      NAME(TRANSFORM_ORIGIN, "transform-origin", true), NAME(TYPE, "type", false),                 \
      NAME(VECTOR_EFFECT, "vector-effect", true), NAME(VIEW_BOX, "viewBox", false),                \
      NAME(VISIBILITY, "visibility", true), NAME(WIDTH, "width", false),                           \
      NAME(WORD_SPACING, "word-spacing", true), NAME(WRITING_MODE, "writing-mode", true),          \
      NAME(X, "x", false), NAME(X1, "x1", false), NAME(X2, "x2", false), NAME(Y, "y", false),      \
      NAME(Y1, "y1", false), NAME(Y2, "y2", false)

typedef enum cs_svg_name {
#define NAME(name, text, is_property) CS_SVG_##name
  CS_SVG_NAME_LIST(NAME),
#undef NAME
  CS_SVG_NAME_COUNT
} cs_svg_name;

/* OTHER for one that is not in the list. */
cs_svg_element cs_svg_element_named(const char *text);
/* CS_SVG_NAME_COUNT for one that is not in the list. */
cs_svg_name cs_svg_name_of(const char *text);
/* Whether a style sheet may set it. */
bool cs_svg_is_property(cs_svg_name name);
const char *cs_svg_name_text(cs_svg_name name);
