/* The known names of SVG, as numbers: elements, attributes and properties, with the values that are
 * read. Only these lists say what is drawn: all other names in a document are noted.
 *
 * Invariant: all lists are sorted as strcmp sorts their texts, which is how they are searched.
 */
#pragma once

#include <stdbool.h>

#include "inside/cache.h"
#include "inside/hash.h"

/* Each element: its enumerator after CS_SVG_ELEMENT_, its text. */
#define CS_SVG_ELEMENT_LIST(ELEMENT)                                                               \
  ELEMENT(A, "a"), ELEMENT(ANIMATE, "animate"), ELEMENT(ANIMATE_MOTION, "animateMotion"),          \
      ELEMENT(ANIMATE_TRANSFORM, "animateTransform"), ELEMENT(CIRCLE, "circle"),                   \
      ELEMENT(CLIP_PATH, "clipPath"), ELEMENT(DEFS, "defs"), ELEMENT(DESC, "desc"),                \
      ELEMENT(ELLIPSE, "ellipse"), ELEMENT(FE_BLEND, "feBlend"),                                   \
      ELEMENT(FE_COLOR_MATRIX, "feColorMatrix"),                                                   \
      ELEMENT(FE_COMPONENT_TRANSFER, "feComponentTransfer"), ELEMENT(FE_COMPOSITE, "feComposite"), \
      ELEMENT(FE_CONVOLVE_MATRIX, "feConvolveMatrix"),                                             \
      ELEMENT(FE_DIFFUSE_LIGHTING, "feDiffuseLighting"),                                           \
      ELEMENT(FE_DISPLACEMENT_MAP, "feDisplacementMap"),                                           \
      ELEMENT(FE_DISTANT_LIGHT, "feDistantLight"), ELEMENT(FE_DROP_SHADOW, "feDropShadow"),        \
      ELEMENT(FE_FLOOD, "feFlood"), ELEMENT(FE_FUNC_A, "feFuncA"), ELEMENT(FE_FUNC_B, "feFuncB"),  \
      ELEMENT(FE_FUNC_G, "feFuncG"), ELEMENT(FE_FUNC_R, "feFuncR"),                                \
      ELEMENT(FE_GAUSSIAN_BLUR, "feGaussianBlur"), ELEMENT(FE_IMAGE, "feImage"),                   \
      ELEMENT(FE_MERGE, "feMerge"), ELEMENT(FE_MERGE_NODE, "feMergeNode"),                         \
      ELEMENT(FE_MORPHOLOGY, "feMorphology"), ELEMENT(FE_OFFSET, "feOffset"),                      \
      ELEMENT(FE_POINT_LIGHT, "fePointLight"),                                                     \
      ELEMENT(FE_SPECULAR_LIGHTING, "feSpecularLighting"), ELEMENT(FE_SPOT_LIGHT, "feSpotLight"),  \
      ELEMENT(FE_TILE, "feTile"), ELEMENT(FE_TURBULENCE, "feTurbulence"),                          \
      ELEMENT(FILTER, "filter"), ELEMENT(FOREIGN_OBJECT, "foreignObject"), ELEMENT(G, "g"),        \
      ELEMENT(IMAGE, "image"), ELEMENT(LINE, "line"), ELEMENT(LINEAR_GRADIENT, "linearGradient"),  \
      ELEMENT(MARKER, "marker"), ELEMENT(MASK, "mask"), ELEMENT(METADATA, "metadata"),             \
      ELEMENT(MPATH, "mpath"), ELEMENT(PATH, "path"), ELEMENT(PATTERN, "pattern"),                 \
      ELEMENT(POLYGON, "polygon"), ELEMENT(POLYLINE, "polyline"),                                  \
      ELEMENT(RADIAL_GRADIENT, "radialGradient"), ELEMENT(RECT, "rect"),                           \
      ELEMENT(SCRIPT, "script"), ELEMENT(SET, "set"), ELEMENT(STOP, "stop"),                       \
      ELEMENT(STYLE, "style"), ELEMENT(SVG, "svg"), ELEMENT(SWITCH, "switch"),                     \
      ELEMENT(SYMBOL, "symbol"), ELEMENT(TEXT, "text"), ELEMENT(TEXT_PATH, "textPath"),            \
      ELEMENT(TITLE, "title"), ELEMENT(TSPAN, "tspan"), ELEMENT(USE, "use"), ELEMENT(VIEW, "view")

typedef enum cs_svg_element {
#define ELEMENT(name, text) CS_SVG_ELEMENT_##name
  CS_SVG_ELEMENT_LIST(ELEMENT),
#undef ELEMENT
  CS_SVG_ELEMENT_OTHER,      /* any other element of SVG */
  CS_SVG_ELEMENT_CHARACTERS, /* the characters of a text between its elements */
  CS_SVG_ELEMENT_COUNT = CS_SVG_ELEMENT_OTHER
} cs_svg_element;

/* Each name: its enumerator after CS_SVG_, its text, its use and its form. WITH has the words that
 * are values and the initial value, too (cs_svg_name_facts). */
#define CS_SVG_NAME_LIST(NAME, WITH)                                                               \
  NAME(ACCUMULATE, "accumulate", ATTRIBUTE, ANY), NAME(ADDITIVE, "additive", ATTRIBUTE, ANY),      \
      WITH(ALIGNMENT_BASELINE, "alignment-baseline", PRESENTED, WORD,                              \
           BASELINES "|top|center|bottom", NULL),                                                  \
      NAME(AMPLITUDE, "amplitude", ATTRIBUTE, ANY), NAME(ANIMATION, "animation", STYLED, ANY),     \
      NAME(ANIMATION_COMPOSITION, "animation-composition", STYLED, ANY),                           \
      NAME(ANIMATION_DELAY, "animation-delay", STYLED, ANY),                                       \
      NAME(ANIMATION_DIRECTION, "animation-direction", STYLED, ANY),                               \
      NAME(ANIMATION_DURATION, "animation-duration", STYLED, ANY),                                 \
      NAME(ANIMATION_FILL_MODE, "animation-fill-mode", STYLED, ANY),                               \
      NAME(ANIMATION_ITERATION_COUNT, "animation-iteration-count", STYLED, ANY),                   \
      NAME(ANIMATION_NAME, "animation-name", STYLED, ANY),                                         \
      NAME(ANIMATION_PLAY_STATE, "animation-play-state", STYLED, ANY),                             \
      NAME(ANIMATION_TIMING_FUNCTION, "animation-timing-function", STYLED, ANY),                   \
      NAME(ATTRIBUTE_NAME, "attributeName", ATTRIBUTE, ANY),                                       \
      NAME(AZIMUTH, "azimuth", ATTRIBUTE, ANY),                                                    \
      NAME(BASE_FREQUENCY, "baseFrequency", ATTRIBUTE, ANY),                                       \
      WITH(BASELINE_SHIFT, "baseline-shift", PRESENTED, LENGTH, "baseline|sub|super", NULL),       \
      NAME(BEGIN, "begin", ATTRIBUTE, ANY), NAME(BIAS, "bias", ATTRIBUTE, ANY),                    \
      NAME(BY, "by", ATTRIBUTE, ANY), NAME(CALC_MODE, "calcMode", ATTRIBUTE, ANY),                 \
      NAME(CLASS, "class", ATTRIBUTE, ANY), NAME(CLIP_PATH, "clip-path", PRESENTED, ANY),          \
      WITH(CLIP_RULE, "clip-rule", PRESENTED, WORD, "nonzero|evenodd", "nonzero"),                 \
      WITH(CLIP_PATH_UNITS, "clipPathUnits", ATTRIBUTE, WORD, "userSpaceOnUse|objectBoundingBox",  \
           NULL),                                                                                  \
      WITH(COLOR, "color", PRESENTED, COLOUR, NULL, "black"),                                      \
      WITH(COLOR_INTERPOLATION_FILTERS, "color-interpolation-filters", PRESENTED, WORD,            \
           "auto|sRGB|linearRGB", "linearRGB"),                                                    \
      NAME(CX, "cx", GEOMETRY, LENGTH), NAME(CY, "cy", GEOMETRY, LENGTH),                          \
      NAME(D, "d", GEOMETRY, ANY), NAME(DIFFUSE_CONSTANT, "diffuseConstant", ATTRIBUTE, ANY),      \
      WITH(DIRECTION, "direction", PRESENTED, WORD, "ltr|rtl", "ltr"),                             \
      NAME(DISPLAY, "display", PRESENTED, ANY), NAME(DIVISOR, "divisor", ATTRIBUTE, ANY),          \
      WITH(DOMINANT_BASELINE, "dominant-baseline", PRESENTED, WORD,                                \
           BASELINES "|use-script|no-change|reset-size", "auto"),                                  \
      NAME(DUR, "dur", ATTRIBUTE, ANY), NAME(DX, "dx", ATTRIBUTE, LENGTHS),                        \
      NAME(DY, "dy", ATTRIBUTE, LENGTHS), NAME(EDGE_MODE, "edgeMode", ATTRIBUTE, ANY),             \
      NAME(ELEVATION, "elevation", ATTRIBUTE, ANY), NAME(END, "end", ATTRIBUTE, ANY),              \
      NAME(EXPONENT, "exponent", ATTRIBUTE, ANY),                                                  \
      WITH(FILL, "fill", PRESENTED, PAINT, NULL, "black"),                                         \
      WITH(FILL_OPACITY, "fill-opacity", PRESENTED, SHARE, NULL, "1"),                             \
      WITH(FILL_RULE, "fill-rule", PRESENTED, WORD, "nonzero|evenodd", "nonzero"),                 \
      WITH(FILTER, "filter", PRESENTED, FILTERS, "none|inherit", NULL),                            \
      WITH(FILTER_UNITS, "filterUnits", ATTRIBUTE, WORD, "userSpaceOnUse|objectBoundingBox",       \
           NULL),                                                                                  \
      WITH(FLOOD_COLOR, "flood-color", PRESENTED, COLOUR, "inherit", NULL),                        \
      NAME(FLOOD_OPACITY, "flood-opacity", PRESENTED, SHARE),                                      \
      WITH(FONT_FAMILY, "font-family", PRESENTED, ANY, NULL, ""),                                  \
      WITH(FONT_SIZE, "font-size", PRESENTED, SIZE,                                                \
           "xx-small|x-small|small|medium|large|x-large|xx-large|xxx-large|smaller|larger",        \
           "medium"),                                                                              \
      WITH(FONT_STYLE, "font-style", PRESENTED, SLANT, "normal|italic|oblique", "normal"),         \
      WITH(FONT_WEIGHT, "font-weight", PRESENTED, NUMBER, "normal|bold|bolder|lighter", "normal"), \
      NAME(FR, "fr", ATTRIBUTE, LENGTH), NAME(FROM, "from", ATTRIBUTE, ANY),                       \
      NAME(FX, "fx", ATTRIBUTE, LENGTH), NAME(FY, "fy", ATTRIBUTE, LENGTH),                        \
      NAME(GRADIENT_TRANSFORM, "gradientTransform", ATTRIBUTE, TRANSFORM),                         \
      WITH(GRADIENT_UNITS, "gradientUnits", ATTRIBUTE, WORD, "userSpaceOnUse|objectBoundingBox",   \
           NULL),                                                                                  \
      WITH(HEIGHT, "height", GEOMETRY, LENGTH, "auto", NULL), NAME(HREF, "href", ATTRIBUTE, ANY),  \
      NAME(ID, "id", ATTRIBUTE, ANY), NAME(IN, "in", ATTRIBUTE, ANY),                              \
      NAME(IN2, "in2", ATTRIBUTE, ANY), NAME(INTERCEPT, "intercept", ATTRIBUTE, ANY),              \
      WITH(ISOLATION, "isolation", STYLED, WORD, "auto|isolate", NULL),                            \
      NAME(K1, "k1", ATTRIBUTE, ANY), NAME(K2, "k2", ATTRIBUTE, ANY),                              \
      NAME(K3, "k3", ATTRIBUTE, ANY), NAME(K4, "k4", ATTRIBUTE, ANY),                              \
      NAME(KERNEL_MATRIX, "kernelMatrix", ATTRIBUTE, ANY),                                         \
      NAME(KERNEL_UNIT_LENGTH, "kernelUnitLength", ATTRIBUTE, ANY),                                \
      NAME(KEY_POINTS, "keyPoints", ATTRIBUTE, ANY),                                               \
      NAME(KEY_SPLINES, "keySplines", ATTRIBUTE, ANY),                                             \
      NAME(KEY_TIMES, "keyTimes", ATTRIBUTE, ANY), NAME(LABEL, "label", ATTRIBUTE, ANY),           \
      WITH(LENGTH_ADJUST, "lengthAdjust", ATTRIBUTE, WORD, "spacing|spacingAndGlyphs", NULL),      \
      WITH(LETTER_SPACING, "letter-spacing", PRESENTED, LENGTH, "normal", "normal"),               \
      WITH(LIGHTING_COLOR, "lighting-color", PRESENTED, COLOUR, "inherit", NULL),                  \
      NAME(LIMITING_CONE_ANGLE, "limitingConeAngle", ATTRIBUTE, ANY),                              \
      WITH(MARKER, "marker", STYLED, REFERENCE, "none", "none"),                                   \
      WITH(MARKER_END, "marker-end", PRESENTED, REFERENCE, "none", "none"),                        \
      WITH(MARKER_MID, "marker-mid", PRESENTED, REFERENCE, "none", "none"),                        \
      WITH(MARKER_START, "marker-start", PRESENTED, REFERENCE, "none", "none"),                    \
      NAME(MARKER_HEIGHT, "markerHeight", ATTRIBUTE, LENGTH),                                      \
      WITH(MARKER_UNITS, "markerUnits", ATTRIBUTE, WORD, "strokeWidth|userSpaceOnUse", NULL),      \
      NAME(MARKER_WIDTH, "markerWidth", ATTRIBUTE, LENGTH),                                        \
      WITH(MASK, "mask", PRESENTED, REFERENCE, "none|inherit", NULL),                              \
      WITH(MASK_TYPE, "mask-type", PRESENTED, WORD, "luminance|alpha", NULL),                      \
      WITH(MASK_CONTENT_UNITS, "maskContentUnits", ATTRIBUTE, WORD,                                \
           "userSpaceOnUse|objectBoundingBox", NULL),                                              \
      WITH(MASK_UNITS, "maskUnits", ATTRIBUTE, WORD, "userSpaceOnUse|objectBoundingBox", NULL),    \
      NAME(MAX, "max", ATTRIBUTE, ANY), NAME(MEDIA, "media", ATTRIBUTE, ANY),                      \
      NAME(MIN, "min", ATTRIBUTE, ANY),                                                            \
      WITH(MIX_BLEND_MODE, "mix-blend-mode", STYLED, WORD, BLEND_MODES, NULL),                     \
      NAME(MODE, "mode", ATTRIBUTE, ANY), NAME(NUM_OCTAVES, "numOctaves", ATTRIBUTE, ANY),         \
      NAME(OFFSET, "offset", ATTRIBUTE, SHARE), NAME(OFFSET_ANCHOR, "offset-anchor", STYLED, ANY), \
      NAME(OFFSET_DISTANCE, "offset-distance", STYLED, DISTANCE),                                  \
      NAME(OFFSET_PATH, "offset-path", STYLED, WAY),                                               \
      NAME(OFFSET_ROTATE, "offset-rotate", STYLED, HEADING),                                       \
      WITH(OPACITY, "opacity", PRESENTED, SHARE, "inherit", NULL),                                 \
      NAME(OPERATOR, "operator", ATTRIBUTE, ANY), NAME(ORDER, "order", ATTRIBUTE, ANY),            \
      WITH(ORIENT, "orient", ATTRIBUTE, ANGLE, "auto|auto-start-reverse", NULL),                   \
      WITH(OVERFLOW, "overflow", PRESENTED, WORD, "visible|hidden|scroll|auto|clip|inherit",       \
           NULL),                                                                                  \
      WITH(PAINT_ORDER, "paint-order", PRESENTED, ORDER, "normal", "normal"),                      \
      NAME(PATH, "path", ATTRIBUTE, ANY), NAME(PATH_LENGTH, "pathLength", ATTRIBUTE, NUMBER),      \
      WITH(PATTERN_CONTENT_UNITS, "patternContentUnits", ATTRIBUTE, WORD,                          \
           "userSpaceOnUse|objectBoundingBox", NULL),                                              \
      NAME(PATTERN_TRANSFORM, "patternTransform", ATTRIBUTE, TRANSFORM),                           \
      WITH(PATTERN_UNITS, "patternUnits", ATTRIBUTE, WORD, "userSpaceOnUse|objectBoundingBox",     \
           NULL),                                                                                  \
      NAME(POINTS, "points", ATTRIBUTE, ANY), NAME(POINTS_AT_X, "pointsAtX", ATTRIBUTE, ANY),      \
      NAME(POINTS_AT_Y, "pointsAtY", ATTRIBUTE, ANY),                                              \
      NAME(POINTS_AT_Z, "pointsAtZ", ATTRIBUTE, ANY),                                              \
      NAME(PRESERVE_ALPHA, "preserveAlpha", ATTRIBUTE, ANY),                                       \
      NAME(PRESERVE_ASPECT_RATIO, "preserveAspectRatio", ATTRIBUTE, ASPECT),                       \
      WITH(PRIMITIVE_UNITS, "primitiveUnits", ATTRIBUTE, WORD, "userSpaceOnUse|objectBoundingBox", \
           NULL),                                                                                  \
      NAME(R, "r", GEOMETRY, LENGTH), NAME(RADIUS, "radius", ATTRIBUTE, ANY),                      \
      WITH(REF_X, "refX", ATTRIBUTE, LENGTH, "left|center|right", NULL),                           \
      WITH(REF_Y, "refY", ATTRIBUTE, LENGTH, "top|center|bottom", NULL),                           \
      NAME(REPEAT_COUNT, "repeatCount", ATTRIBUTE, ANY),                                           \
      NAME(REPEAT_DUR, "repeatDur", ATTRIBUTE, ANY),                                               \
      NAME(REQUIRED_EXTENSIONS, "requiredExtensions", ATTRIBUTE, ANY),                             \
      NAME(REQUIRED_FEATURES, "requiredFeatures", ATTRIBUTE, ANY),                                 \
      NAME(RESTART, "restart", ATTRIBUTE, ANY), NAME(RESULT, "result", ATTRIBUTE, ANY),            \
      NAME(ROTATE, "rotate", APART, ROTATION), WITH(RX, "rx", GEOMETRY, LENGTH, "auto", NULL),     \
      WITH(RY, "ry", GEOMETRY, LENGTH, "auto", NULL),                                              \
      WITH(SCALE, "scale", STYLED, SCALE, "none", NULL), NAME(SEED, "seed", ATTRIBUTE, ANY),       \
      WITH(SIDE, "side", ATTRIBUTE, WORD, "left|right", NULL),                                     \
      NAME(SLOPE, "slope", ATTRIBUTE, ANY),                                                        \
      WITH(SPACE, "space", ATTRIBUTE, WORD, "default|preserve", NULL),                             \
      NAME(SPECULAR_CONSTANT, "specularConstant", ATTRIBUTE, ANY),                                 \
      NAME(SPECULAR_EXPONENT, "specularExponent", ATTRIBUTE, ANY),                                 \
      WITH(SPREAD_METHOD, "spreadMethod", ATTRIBUTE, WORD, "pad|reflect|repeat", NULL),            \
      NAME(START_OFFSET, "startOffset", ATTRIBUTE, LENGTH),                                        \
      NAME(STD_DEVIATION, "stdDeviation", ATTRIBUTE, ANY),                                         \
      NAME(STITCH_TILES, "stitchTiles", ATTRIBUTE, ANY),                                           \
      WITH(STOP_COLOR, "stop-color", PRESENTED, COLOUR, "inherit", NULL),                          \
      NAME(STOP_OPACITY, "stop-opacity", PRESENTED, SHARE),                                        \
      WITH(STROKE, "stroke", PRESENTED, PAINT, NULL, "none"),                                      \
      WITH(STROKE_DASHARRAY, "stroke-dasharray", PRESENTED, LENGTHS, "none", "none"),              \
      WITH(STROKE_DASHOFFSET, "stroke-dashoffset", PRESENTED, LENGTH, NULL, "0"),                  \
      WITH(STROKE_LINECAP, "stroke-linecap", PRESENTED, WORD, "butt|round|square", "butt"),        \
      WITH(STROKE_LINEJOIN, "stroke-linejoin", PRESENTED, WORD,                                    \
           "miter|miter-clip|arcs|round|bevel", "miter"),                                          \
      WITH(STROKE_MITERLIMIT, "stroke-miterlimit", PRESENTED, NUMBER, NULL, "4"),                  \
      WITH(STROKE_OPACITY, "stroke-opacity", PRESENTED, SHARE, NULL, "1"),                         \
      WITH(STROKE_WIDTH, "stroke-width", PRESENTED, SIZE, NULL, "1"),                              \
      NAME(STYLE, "style", ATTRIBUTE, ANY), NAME(SURFACE_SCALE, "surfaceScale", ATTRIBUTE, ANY),   \
      NAME(SYSTEM_LANGUAGE, "systemLanguage", ATTRIBUTE, ANY),                                     \
      NAME(TABLE_VALUES, "tableValues", ATTRIBUTE, ANY),                                           \
      NAME(TARGET_X, "targetX", ATTRIBUTE, ANY), NAME(TARGET_Y, "targetY", ATTRIBUTE, ANY),        \
      WITH(TEXT_ANCHOR, "text-anchor", PRESENTED, WORD, "start|middle|end", "start"),              \
      WITH(TEXT_DECORATION, "text-decoration", PRESENTED, WORD, "none", NULL),                     \
      NAME(TEXT_LENGTH, "textLength", ATTRIBUTE, LENGTH), NAME(TO, "to", ATTRIBUTE, ANY),          \
      WITH(TRANSFORM, "transform", PRESENTED, TRANSFORM, "none|inherit", NULL),                    \
      WITH(TRANSFORM_BOX, "transform-box", STYLED, WORD, "view-box|fill-box|content-box", NULL),   \
      NAME(TRANSFORM_ORIGIN, "transform-origin", PRESENTED, ANY),                                  \
      WITH(TRANSLATE, "translate", STYLED, TRANSLATE, "none", NULL),                               \
      NAME(TYPE, "type", ATTRIBUTE, ANY), NAME(VALUES, "values", ATTRIBUTE, ANY),                  \
      WITH(VECTOR_EFFECT, "vector-effect", PRESENTED, WORD, "none|non-scaling-stroke", NULL),      \
      NAME(VIEW_BOX, "viewBox", ATTRIBUTE, VIEW_BOX),                                              \
      WITH(VISIBILITY, "visibility", PRESENTED, WORD, "visible|hidden|collapse", "visible"),       \
      WITH(WIDTH, "width", GEOMETRY, LENGTH, "auto", NULL),                                        \
      WITH(WORD_SPACING, "word-spacing", PRESENTED, LENGTH, "normal", "normal"),                   \
      WITH(WRITING_MODE, "writing-mode", PRESENTED, WORD, "horizontal-tb|lr|lr-tb",                \
           "horizontal-tb"),                                                                       \
      NAME(X, "x", GEOMETRY, LENGTHS), NAME(X1, "x1", ATTRIBUTE, LENGTH),                          \
      NAME(X2, "x2", ATTRIBUTE, LENGTH),                                                           \
      NAME(X_CHANNEL_SELECTOR, "xChannelSelector", ATTRIBUTE, ANY),                                \
      NAME(Y, "y", GEOMETRY, LENGTHS), NAME(Y1, "y1", ATTRIBUTE, LENGTH),                          \
      NAME(Y2, "y2", ATTRIBUTE, LENGTH),                                                           \
      NAME(Y_CHANNEL_SELECTOR, "yChannelSelector", ATTRIBUTE, ANY), NAME(Z, "z", ATTRIBUTE, ANY)

typedef enum cs_svg_name {
#define NAME(name, text, use, form) CS_SVG_##name
#define WITH(name, text, use, form, words, initial) CS_SVG_##name
  CS_SVG_NAME_LIST(NAME, WITH),
#undef NAME
#undef WITH
  CS_SVG_NAME_COUNT
} cs_svg_name;

/* Where a name is used. */
typedef enum cs_svg_use {
  CS_SVG_USE_ATTRIBUTE, /* only an attribute */
  CS_SVG_USE_PRESENTED, /* a property, which can also be given by the attribute of this name */
  CS_SVG_USE_STYLED,    /* a property that only styles can give */
  CS_SVG_USE_GEOMETRY,  /* an attribute, which a style may give to some elements */
  CS_SVG_USE_APART      /* an attribute, and a property with another meaning */
} cs_svg_use;

/* The form of a value. */
typedef enum cs_svg_form {
  CS_SVG_FORM_ANY, /* any; it is checked where it is used */
  CS_SVG_FORM_WORD,
  CS_SVG_FORM_NUMBER,
  CS_SVG_FORM_SHARE, /* a number or a percentage */
  CS_SVG_FORM_LENGTH,
  CS_SVG_FORM_SIZE, /* a length that is not negative */
  CS_SVG_FORM_LENGTHS,
  CS_SVG_FORM_ANGLE,
  CS_SVG_FORM_ROTATION, /* an attribute has numbers; a style has an angle about the z axis */
  CS_SVG_FORM_COLOUR,
  CS_SVG_FORM_PAINT,
  CS_SVG_FORM_REFERENCE,
  CS_SVG_FORM_TRANSFORM,
  CS_SVG_FORM_TRANSLATE,
  CS_SVG_FORM_SCALE,
  CS_SVG_FORM_SLANT,
  CS_SVG_FORM_ORDER, /* the order of fill, stroke and markers */
  CS_SVG_FORM_VIEW_BOX,
  CS_SVG_FORM_ASPECT,
  CS_SVG_FORM_FILTERS,
  CS_SVG_FORM_WAY,
  CS_SVG_FORM_DISTANCE, /* a length, in a style with a unit */
  CS_SVG_FORM_HEADING
} cs_svg_form;

typedef struct cs_svg_name_facts {
  const char *text;
  cs_svg_use use;
  cs_svg_form form;
  const char *words;   /* words that are also values, with '|' between them; NULL: none */
  const char *initial; /* the initial value of an inherited property; NULL: it is not inherited */
} cs_svg_name_facts;

/* OTHER for a name that is not in the list. */
cs_svg_element cs_svg_element_named(const char *text);
/* Whether it changes its parent, or the element that it names, in the course of time. */
bool cs_svg_element_animates(cs_svg_element element);
/* CS_SVG_NAME_COUNT for a name that is not in the list. */
cs_svg_name cs_svg_name_of(const char *text);
/* Whether the element or its contents may be seen; false for notes, scripts and filters. */
bool cs_svg_element_is_drawn(cs_svg_element element);
const cs_svg_name_facts *cs_svg_name_facts_of(cs_svg_name name);
/* Whether a style may set it. */
bool cs_svg_is_property(cs_svg_name name);
const char *cs_svg_name_text(cs_svg_name name);

/* Whether the value is one of the words, which have '|' between them, in upper or lower case.
 * words: NULL: none. */
bool cs_svg_words_have(const char *words, const char *value);

/* A name in a document that is not drawn: an attribute, a property, an element, or a value of one
 * of these. Each name is listed once, at the line where it appears first. */
#define CS_SVG_UNREAD 1000 /* names; no more are noted */

typedef struct cs_svg_unread_name {
  const char *what; /* name, or: name "value" */
  uint32_t line;
} cs_svg_unread_name;

/* All zero is an empty list. */
typedef struct cs_svg_unread {
  cs_svg_unread_name *items;
  size_t count, capacity;
  cs_hash_table names;
} cs_svg_unread;

/* value: NULL where the name alone is not known. Texts are copied to the arena. Errors: NO_MEMORY.
 */
CELSPAN_CHECKED celspan_status cs_svg_unread_add(cs_svg_unread *list, celspan_context *context,
                                                 cs_arena *arena, uint32_t line, const char *name,
                                                 const char *value);
void cs_svg_unread_finish(cs_svg_unread *list, celspan_context *context);
