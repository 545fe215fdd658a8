/* Values of properties and attributes that can be mixed: a text as a list of numbers with what is
 * written around them.
 *
 *   "translate(10px, 50%)"   frame "translate(##)"   numbers 10, 50   units "", "%"
 *
 * Two values mix if they have the same frame and the same units; a zero takes every unit. A colour
 * is four numbers. What has no numbers, or refers to another element, does not mix.
 */
#pragma once

#include "readers/svg/words/css.h"
#include "readers/svg/words/values.h"

#define CS_SVG_MIXED_NUMBERS 1000000 /* the most of one value */

typedef struct cs_svg_mixed_number {
  double value;
  char unit[8]; /* "": none; absolute lengths are px without a unit */
} cs_svg_mixed_number;

typedef struct cs_svg_mixed {
  const char *text;  /* as written */
  const char *frame; /* NULL: it does not mix; a colour is CS_SVG_COLOUR_FRAME */
  cs_svg_mixed_number *numbers;
  size_t count;
} cs_svg_mixed;

extern const char cs_svg_colour_frame[];

/* How lists of numbers are read: CS_SVG_NAME_COUNT for a list without a name. text: must live as
 * long as *out. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_mixed_read(const cs_css_place *place, cs_svg_name name,
                                                 const char *text, cs_svg_mixed *out);
/* `count` numbers without units, read from *value. fallbacks: for numbers that are missing. */
CELSPAN_CHECKED celspan_status cs_svg_mixed_fit(const cs_css_place *place, const double *fallbacks,
                                                size_t count, cs_svg_mixed *value);

bool cs_svg_mixed_fits(const cs_svg_mixed *a, const cs_svg_mixed *b);
/* a + (b - a) share, of values that fit. premultiplied: colours are mixed by their alpha. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_mixed_mix(const cs_css_place *place, const cs_svg_mixed *a,
                                                const cs_svg_mixed *b, double share,
                                                bool premultiplied, cs_svg_mixed *out);
/* a + b times, of values that fit; the same errors. */
CELSPAN_CHECKED celspan_status cs_svg_mixed_add(const cs_css_place *place, const cs_svg_mixed *a,
                                                const cs_svg_mixed *b, double times,
                                                cs_svg_mixed *out);
/* The distance of values that fit; 0: of all others. */
double cs_svg_mixed_distance(const cs_svg_mixed *a, const cs_svg_mixed *b);
/* The value as a text; NULL: a number is beyond 1e12. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_mixed_write(const cs_css_place *place,
                                                  const cs_svg_mixed *value, const char **out);

/* ---------------------------------------------------------------- transforms of different kinds */

/* a + (b - a) share: if one of the lists continues the other, with functions that do nothing at the
 * end of the shorter one; otherwise as matrices. Lists that have no matrices change in the middle.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_matrices_mix(const cs_css_place *place, const cs_svg_mixed *a,
                                                   const cs_svg_mixed *b, double share,
                                                   cs_svg_mixed *out);
/* The sum of lists with the same functions: of what they change. Scales of 2 and 3 are 4. The same
 * errors. */
CELSPAN_CHECKED celspan_status cs_svg_matrices_add(const cs_css_place *place, const cs_svg_mixed *a,
                                                   const cs_svg_mixed *b, cs_svg_mixed *out);

/* ---------------------------------------------------------------- values without animations */

/* How a value is added to the one without the animation. */
typedef enum cs_svg_composition {
  CS_SVG_COMPOSITION_REPLACE,
  CS_SVG_COMPOSITION_ADD,       /* functions come after the other list's */
  CS_SVG_COMPOSITION_ACCUMULATE /* numbers of the same functions are added */
} cs_svg_composition;

/* Adds *value of the property to the value with the animations applied so far, which is `under`.
 * Values that do not fit replace it. Errors: NO_MEMORY; LIMIT for lists that are too long. Source:
 * CSS Values Level 4, 3.2, and CSS Transforms Level 2, 12. */
CELSPAN_CHECKED celspan_status cs_svg_motion_compose(const cs_css_place *place, cs_svg_name name,
                                                     cs_svg_composition how,
                                                     const cs_svg_mixed *under,
                                                     cs_svg_mixed *value);
