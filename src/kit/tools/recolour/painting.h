/* Pixels in other colours.
 *
 *   exactly one colour of the table      becomes its new one
 *   near such pixels                     a mixture of two colours near it, then of three: of the
 *                                        table, else with colours around that stay, else with any
 *                                        colour of the table, for lines thinner than a pixel
 *   all others                           stay, and are reported
 *
 * Alpha stays, and is no part of a mixture: at the border to nothing a colour is the whole mixture.
 */
#pragma once

#include "tools/recolour/mixture.h"

/* How far the codes of a pixel may be from those of a colour that it has exactly. */
#define CS_PAINTING_WITHIN 1e-5
#define CS_PAINTING_WITHIN_HALF 4e-4 /* where they were stored as half floats */

#define CS_PAINTING_RADIUS 3  /* pixels: how far colours are looked for */
#define CS_PAINTING_AROUND 48 /* pixels within it */

typedef struct cs_painting {
  const cs_swatches *swatches;
  int32_t width, height;
  float *rgba;     /* light, premultiplied */
  double within;   /* one of the above */
  bool only_known; /* it stays, and nothing is reported, unless most of it is of the table */
  bool is_changed; /* result: whether a pixel has a new colour */
  /* Called for each pixel that stays and is no mixture, with its codes. */
  void (*report)(void *user, const double code[3], int32_t x, int32_t y);
  void *user;
  /* scratch: how far a mixture may be off, of each pixel its colour or a mark, and the ways to its
   * neighbours, shortest first: x, y, and whether it is longer than the one before */
  double rounded;
  const cs_swatch **exact;
  int8_t around[CS_PAINTING_AROUND][3];
} cs_painting;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_painting_recolour(celspan_context *context,
                                                    cs_painting *painting);
