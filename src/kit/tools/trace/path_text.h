/* Path data, written piece by piece, and the decimals that it is made of.
 *
 * INVARIANT: a coordinate is written as a decimal of at most three places, which stands for the
 * same number when it is read again.
 */
#pragma once

#include "inside/context.h"

typedef struct cs_writing {
  char *bytes; /* ends in a zero once anything is added */
  size_t count, capacity;
} cs_writing;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_writing_add(celspan_context *context, cs_writing *writing,
                                              const char *text);
/* A letter, then points, which are whole multiples of 1/1000. */
CELSPAN_CHECKED celspan_status cs_writing_draw(celspan_context *context, cs_writing *writing,
                                               char letter, const celspan_point *points, int count);
/* The number as at most three places, in `text`. */
typedef struct cs_decimal {
  char text[32];
} cs_decimal;
cs_decimal cs_decimal_of(double number);
void cs_writing_finish(celspan_context *context, cs_writing *writing);
