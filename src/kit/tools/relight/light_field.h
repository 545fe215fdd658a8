/* The light that fell on a picture, as a field over it: celspan_light_field of the public header.
 *
 *        x = -1        x = 1
 *     y = -1 +-----------+       channel c at x, y:   colour[c] * exp(terms[c] . b(x, y))
 *            |     .     |
 *            |   . F .   |       b = x, y, xx, xy, yy, xxx, xxy, xyy, yyy
 *     y =  1 +-----------+
 *
 * INVARIANT: a field that was checked is above 0 and finite everywhere, because of the exponential;
 * so a picture can be divided by it.
 */
#pragma once

#include "celspan/relight.h"
#include "inside/context.h"

/* Refuses a light by which nothing can be divided. noun: the owner of the light, for the message.
 * Errors: BAD_ARGUMENT, naming the channel. */
CELSPAN_CHECKED celspan_status cs_light_field_check(celspan_context *context, const char *noun,
                                                    const celspan_light_field *field);
/* Whether the field is the same everywhere. */
bool cs_light_field_is_flat(const celspan_light_field *field);
/* The basis functions at a place. */
void cs_light_field_basis(double x, double y, double basis[CELSPAN_LIGHT_FIELD_TERMS]);
/* "red", "green", "blue". */
const char *cs_light_field_channel(int c);

/* A field along one row of a picture. */
typedef struct cs_light_row {
  const celspan_light_field *field;
  int32_t width, height, y;
  bool is_flat;
} cs_light_row;

cs_light_row cs_light_row_make(const celspan_light_field *field, int32_t width, int32_t height,
                               int32_t y);
/* The value at the centre of a pixel. */
void cs_light_row_at(const cs_light_row *row, int32_t x, double rgb[3]);
