/* Values of attributes: numbers, lengths, words, references, viewBox.
 *
 * An invalid value counts as not given, as in browsers; a number that is not finite or beyond 1e12
 * is unfit, and the file is refused.
 */
#pragma once

#include "celspan/celspan.h"
#include "inside/cache.h"

typedef enum cs_svg_unit {
  CS_SVG_UNIT_NUMBER, /* also for px: absolute units are converted to it */
  CS_SVG_UNIT_PERCENT,
  CS_SVG_UNIT_EM,
  CS_SVG_UNIT_EX,
  CS_SVG_UNIT_REM,
  CS_SVG_UNIT_VW,
  CS_SVG_UNIT_VH,
  CS_SVG_UNIT_VMIN,
  CS_SVG_UNIT_VMAX
} cs_svg_unit;

typedef struct cs_svg_length {
  double value;
  cs_svg_unit unit;
} cs_svg_length;

/* The sizes to which lengths are relative. */
typedef struct cs_svg_measure {
  double width, height; /* the width and height of the nearest viewport, in user units */
  double font_size;
  double root_font_size;
  double page_width, page_height; /* the page width and page height of the whole drawing, in px */
} cs_svg_measure;

typedef enum cs_svg_axis { CS_SVG_AXIS_X, CS_SVG_AXIS_Y, CS_SVG_AXIS_BOTH } cs_svg_axis;

/* The target of a reference in an attribute: url(#id) and #id; size 0: none. Borrowed from the
 * value. */
typedef struct cs_svg_reference {
  const char *id;
  size_t size;
} cs_svg_reference;

typedef struct cs_svg_view_box {
  bool is_given;
  double x, y, width, height;
} cs_svg_view_box;

static inline bool cs_svg_is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
const char *cs_svg_skip_space(const char *text);
/* Space and at most one comma. */
const char *cs_svg_skip_comma(const char *text);

/* Each function reads a value at *text and moves *text to its end. If there is no such value, or it
 * is unfit, returns false, and *text does not move. */
bool cs_svg_take_number(const char **text, double *out);
bool cs_svg_take_length(const char **text, cs_svg_length *out);
bool cs_svg_take_reference(const char **text, cs_svg_reference *out);
/* Reads a word of letters and hyphens, if it is `word`. */
bool cs_svg_take_word(const char **text, const char *word);

/* Reads the whole value. */
bool cs_svg_parse_length(const char *text, cs_svg_length *out);
bool cs_svg_parse_share(const char *text, double *out); /* a number or a percentage, as a share */
bool cs_svg_parse_view_box(const char *text, cs_svg_view_box *out);
bool cs_svg_is_word(const char *text, const char *word); /* text: NULL is no word */
/* Whether a value that could not be read is a number that is never allowed: NaN, infinite, beyond
 * 1e12. */
bool cs_svg_is_unfit(const char *text);

double cs_svg_resolve(cs_svg_length length, cs_svg_axis axis, const cs_svg_measure *measure);

/* The map from a view box to a viewport {0, 0, width, height}. aspect: the value of
 * preserveAspectRatio, or NULL. */
celspan_matrix cs_svg_fit(const cs_svg_view_box *box, double width, double height,
                          const char *aspect);

/* Variables of styles: --name: value, and var(--name, fallback) in other values.
 *
 * Invariant: a list of variables is never changed; an element that sets variables adds them before
 * the inherited ones.
 */
/* the most that the variables of a document may need */
#define CS_SVG_VARIABLE_BYTES ((size_t)64 << 20)

/* One variable. The list continues with variables of the same name, which it hides, and of other
 * names; NULL: the last. */
typedef struct cs_svg_variable {
  const char *name, *value;
  const struct cs_svg_variable *next;
} cs_svg_variable;

/* The memory in which variables and values are made. */
typedef struct cs_svg_variables {
  celspan_context *context;
  cs_arena *arena;
  size_t used; /* bytes of the arena */
} cs_svg_variables;

/* Errors: NO_MEMORY; LIMIT for more than CS_SVG_VARIABLE_BYTES. */
CELSPAN_CHECKED celspan_status cs_svg_variable_add(cs_svg_variables *made, const char *name,
                                                   const char *value, const cs_svg_variable **list);
/* The value with every var() replaced by the value of its variable. *out: NULL if a variable has no
 * value, if the text is too long, or if variables refer to one another in a circle. Errors: as
 * above. */
CELSPAN_CHECKED celspan_status cs_svg_variable_fill(cs_svg_variables *made,
                                                    const cs_svg_variable *list, const char *value,
                                                    const char **out);
