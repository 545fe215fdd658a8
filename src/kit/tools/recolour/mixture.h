/* Colours as mixtures of the colours of a table, and their mixtures of other colours.
 *
 *        b             p lies nearly on the way from a to b: it is a mixture of these two, and
 *       /              becomes the same mixture of the two new colours. Of three colours the
 *      p   . q         mixtures fill a triangle, as q.
 *     /
 *    a ------- c
 *
 * INVARIANT: shares are 0 or more, with the sum 1. Distances are measured in codes of sRGB, even
 * where light is mixed.
 */
#pragma once

#include "inside/context.h"

/* A colour of a table, and its new one. In the space of mixing: */
typedef struct cs_swatch {
  double at[3], to[3];
  double code[3]; /* the old colour's codes */
} cs_swatch;

/* By their red, ascending. */
typedef struct cs_swatches {
  cs_swatch *list;
  size_t count;
  bool is_linear; /* light is mixed, not codes */
} cs_swatches;

/* codes: three of each colour; they are mixed as is_linear says. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_swatches_init(celspan_context *context, const double *from,
                                                const double *to, size_t count, bool is_linear,
                                                cs_swatches *out);
void cs_swatches_finish(celspan_context *context, cs_swatches *swatches);
/* The colour with these codes, up to `within`; NULL: there is none. */
const cs_swatch *cs_swatches_find(const cs_swatches *swatches, const double code[3], double within);
/* A colour that becomes itself. */
cs_swatch cs_swatches_stay(const cs_swatches *swatches, const double code[3]);
/* The light of a new colour, `to` of a swatch or a mixture of these. */
void cs_swatches_light(const cs_swatches *swatches, const double to[3], double light[3]);

/* The best mixture so far. */
typedef struct cs_mixture {
  const cs_swatches *swatches;
  cs_swatch colour; /* to: the mixture of the new colours, once there is one */
  double off;       /* how far the mixture is from the colour */
} cs_mixture;

cs_mixture cs_mixture_begin(const cs_swatches *swatches, const double code[3]);
/* Tries two or three colours (c is NULL for two). */
void cs_mixture_try(cs_mixture *mixture, const cs_swatch *a, const cs_swatch *b,
                    const cs_swatch *c);
