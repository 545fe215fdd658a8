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

typedef enum cs_svg_name {
  CS_SVG_ACCUMULATE,
  CS_SVG_ADDITIVE,
  CS_SVG_ALIGNMENT_BASELINE,
  CS_SVG_AMPLITUDE,
  CS_SVG_ANIMATION,
  CS_SVG_ANIMATION_COMPOSITION,
  CS_SVG_ANIMATION_DELAY,
  CS_SVG_ANIMATION_DIRECTION,
  CS_SVG_ANIMATION_DURATION,
  CS_SVG_ANIMATION_FILL_MODE,
  CS_SVG_ANIMATION_ITERATION_COUNT,
  CS_SVG_ANIMATION_NAME,
  CS_SVG_ANIMATION_PLAY_STATE,
  CS_SVG_ANIMATION_TIMING_FUNCTION,
  CS_SVG_ATTRIBUTE_NAME,
  CS_SVG_AZIMUTH,
  CS_SVG_BASE_FREQUENCY,
  CS_SVG_BASELINE_SHIFT,
  CS_SVG_BEGIN,
  CS_SVG_BIAS,
  CS_SVG_BY,
  CS_SVG_CALC_MODE,
  CS_SVG_CLASS,
  CS_SVG_CLIP_PATH,
  CS_SVG_CLIP_RULE,
  CS_SVG_CLIP_PATH_UNITS,
  CS_SVG_COLOR,
  CS_SVG_COLOR_INTERPOLATION_FILTERS,
  CS_SVG_CX,
  CS_SVG_CY,
  CS_SVG_D,
  CS_SVG_DIFFUSE_CONSTANT,
  CS_SVG_DIRECTION,
  CS_SVG_DISPLAY,
  CS_SVG_DIVISOR,
  CS_SVG_DOMINANT_BASELINE,
  CS_SVG_DUR,
  CS_SVG_DX,
  CS_SVG_DY,
  CS_SVG_EDGE_MODE,
  CS_SVG_ELEVATION,
  CS_SVG_END,
  CS_SVG_EXPONENT,
  CS_SVG_FILL,
  CS_SVG_FILL_OPACITY,
  CS_SVG_FILL_RULE,
  CS_SVG_FILTER,
  CS_SVG_FILTER_UNITS,
  CS_SVG_FLOOD_COLOR,
  CS_SVG_FLOOD_OPACITY,
  CS_SVG_FONT_FAMILY,
  CS_SVG_FONT_SIZE,
  CS_SVG_FONT_STYLE,
  CS_SVG_FONT_WEIGHT,
  CS_SVG_FR,
  CS_SVG_FROM,
  CS_SVG_FX,
  CS_SVG_FY,
  CS_SVG_GRADIENT_TRANSFORM,
  CS_SVG_GRADIENT_UNITS,
  CS_SVG_HEIGHT,
  CS_SVG_HREF,
  CS_SVG_ID,
  CS_SVG_IN,
  CS_SVG_IN2,
  CS_SVG_INTERCEPT,
  CS_SVG_ISOLATION,
  CS_SVG_K1,
  CS_SVG_K2,
  CS_SVG_K3,
  CS_SVG_K4,
  CS_SVG_KERNEL_MATRIX,
  CS_SVG_KERNEL_UNIT_LENGTH,
  CS_SVG_KEY_POINTS,
  CS_SVG_KEY_SPLINES,
  CS_SVG_KEY_TIMES,
  CS_SVG_LABEL,
  CS_SVG_LENGTH_ADJUST,
  CS_SVG_LETTER_SPACING,
  CS_SVG_LIGHTING_COLOR,
  CS_SVG_LIMITING_CONE_ANGLE,
  CS_SVG_MARKER,
  CS_SVG_MARKER_END,
  CS_SVG_MARKER_MID,
  CS_SVG_MARKER_START,
  CS_SVG_MARKER_HEIGHT,
  CS_SVG_MARKER_UNITS,
  CS_SVG_MARKER_WIDTH,
  CS_SVG_MASK,
  CS_SVG_MASK_TYPE,
  CS_SVG_MASK_CONTENT_UNITS,
  CS_SVG_MASK_UNITS,
  CS_SVG_MAX,
  CS_SVG_MEDIA,
  CS_SVG_MIN,
  CS_SVG_MIX_BLEND_MODE,
  CS_SVG_MODE,
  CS_SVG_NUM_OCTAVES,
  CS_SVG_OFFSET,
  CS_SVG_OFFSET_ANCHOR,
  CS_SVG_OFFSET_DISTANCE,
  CS_SVG_OFFSET_PATH,
  CS_SVG_OFFSET_ROTATE,
  CS_SVG_OPACITY,
  CS_SVG_OPERATOR,
  CS_SVG_ORDER,
  CS_SVG_ORIENT,
  CS_SVG_OVERFLOW,
  CS_SVG_PAINT_ORDER,
  CS_SVG_PATH,
  CS_SVG_PATH_LENGTH,
  CS_SVG_PATTERN_CONTENT_UNITS,
  CS_SVG_PATTERN_TRANSFORM,
  CS_SVG_PATTERN_UNITS,
  CS_SVG_POINTS,
  CS_SVG_POINTS_AT_X,
  CS_SVG_POINTS_AT_Y,
  CS_SVG_POINTS_AT_Z,
  CS_SVG_PRESERVE_ALPHA,
  CS_SVG_PRESERVE_ASPECT_RATIO,
  CS_SVG_PRIMITIVE_UNITS,
  CS_SVG_R,
  CS_SVG_RADIUS,
  CS_SVG_REF_X,
  CS_SVG_REF_Y,
  CS_SVG_REPEAT_COUNT,
  CS_SVG_REPEAT_DUR,
  CS_SVG_REQUIRED_EXTENSIONS,
  CS_SVG_REQUIRED_FEATURES,
  CS_SVG_RESTART,
  CS_SVG_RESULT,
  CS_SVG_ROTATE,
  CS_SVG_RX,
  CS_SVG_RY,
  CS_SVG_SCALE,
  CS_SVG_SEED,
  CS_SVG_SIDE,
  CS_SVG_SLOPE,
  CS_SVG_SPACE,
  CS_SVG_SPECULAR_CONSTANT,
  CS_SVG_SPECULAR_EXPONENT,
  CS_SVG_SPREAD_METHOD,
  CS_SVG_START_OFFSET,
  CS_SVG_STD_DEVIATION,
  CS_SVG_STITCH_TILES,
  CS_SVG_STOP_COLOR,
  CS_SVG_STOP_OPACITY,
  CS_SVG_STROKE,
  CS_SVG_STROKE_DASHARRAY,
  CS_SVG_STROKE_DASHOFFSET,
  CS_SVG_STROKE_LINECAP,
  CS_SVG_STROKE_LINEJOIN,
  CS_SVG_STROKE_MITERLIMIT,
  CS_SVG_STROKE_OPACITY,
  CS_SVG_STROKE_WIDTH,
  CS_SVG_STYLE,
  CS_SVG_SURFACE_SCALE,
  CS_SVG_SYSTEM_LANGUAGE,
  CS_SVG_TABLE_VALUES,
  CS_SVG_TARGET_X,
  CS_SVG_TARGET_Y,
  CS_SVG_TEXT_ANCHOR,
  CS_SVG_TEXT_DECORATION,
  CS_SVG_TEXT_LENGTH,
  CS_SVG_TO,
  CS_SVG_TRANSFORM,
  CS_SVG_TRANSFORM_BOX,
  CS_SVG_TRANSFORM_ORIGIN,
  CS_SVG_TRANSLATE,
  CS_SVG_TYPE,
  CS_SVG_VALUES,
  CS_SVG_VECTOR_EFFECT,
  CS_SVG_VIEW_BOX,
  CS_SVG_VISIBILITY,
  CS_SVG_WIDTH,
  CS_SVG_WORD_SPACING,
  CS_SVG_WRITING_MODE,
  CS_SVG_X,
  CS_SVG_X1,
  CS_SVG_X2,
  CS_SVG_X_CHANNEL_SELECTOR,
  CS_SVG_Y,
  CS_SVG_Y1,
  CS_SVG_Y2,
  CS_SVG_Y_CHANNEL_SELECTOR,
  CS_SVG_Z,
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
  CS_SVG_FORM_ROTATION, /* of an attribute: numbers; of a style: an angle about the z axis */
  CS_SVG_FORM_COLOUR,
  CS_SVG_FORM_PAINT,
  CS_SVG_FORM_REFERENCE,
  CS_SVG_FORM_TRANSFORM,
  CS_SVG_FORM_TRANSLATE,
  CS_SVG_FORM_SCALE,
  CS_SVG_FORM_SLANT,
  CS_SVG_FORM_ORDER, /* of fill, stroke and markers */
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
