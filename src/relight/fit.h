/* A light field fitted to how bright a picture is, part by part.
 *
 *   picture --means of up to 32 x 32 parts--> logarithms --least squares, robust--> terms
 *
 * The logarithm of a part's mean is that of the light there plus that of its mean pigment. Parts whose
 * pigments differ from the others' stick out from the smooth field, and count the less the farther
 * they do.
 */
#ifndef CS_RELIGHT_FIT_H
#define CS_RELIGHT_FIT_H

#include "relight/original.h"

/* Sets the terms of *field; its colours are left. Errors: those of pictures; BAD_ARGUMENT where too
 * few parts are lit to tell a field. */
CELSPAN_CHECKED celspan_status cs_fit_terms(celspan_context *context, cs_original *original,
                                            celspan_light_field *field);

#endif
