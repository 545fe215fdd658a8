/* Timing functions: the share of a change at a share of its time. */
#pragma once

#include "readers/svg/words/values.h"

typedef struct cs_svg_easing {
  const char *stops; /* of linear(), behind its parenthesis, in the text; NULL: no such list */
  size_t size;       /* bytes of the stops; each call reads them */
  int steps;         /* 0: a curve */
  int jumps;         /* at the beginning: bit 0; at the end: bit 1 */
  double at[4];      /* x1, y1, x2, y2 of the curve from 0, 0 to 1, 1 */
} cs_svg_easing;

/* The share at a share of the time. is_before: the time is before its beginning. */
double cs_svg_ease(const cs_svg_easing *easing, double share, bool is_before);
bool cs_svg_easings_equal(const cs_svg_easing *a, const cs_svg_easing *b);
/* A timing function of CSS at *text, which is moved after it; false: there is none. */
bool cs_svg_take_easing(const char **text, cs_svg_easing *out);
