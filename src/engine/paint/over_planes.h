/* The fold of over_row.h for programs of flat layers and gradients that dim the three channels
 * alike, in no group and in front of all back lights: most programs. A register holds one channel
 * of as many pixels as it has lanes, so that their shares and transmissions are computed once for
 * all channels, and the codes of pixels need no shuffling.
 *
 *     red      [ r r r r r r r r   r r r r ...     light gathered
 *     green    [ g g g g g g g g   g g g g ...
 *     blue     [ b b b b b b b b   b b b b ...
 *     through  [ t t t t t t t t   t t t t ...     transmission
 *
 * Invariant: the arithmetic is that of over_row.h, so the bits are the same.
 */
#pragma once

#include "engine/paint/over_row.h"
#include "engine/paint/painter.h"

#define CS_OVER_PLANES_ROOM (CS_OVER_ROW_BATCH + 16) /* whole registers are read and written */

typedef struct cs_over_planes {
  float light[3][CS_OVER_PLANES_ROOM], through[CS_OVER_PLANES_ROOM];
  int32_t count; /* pixels */
  float keep;    /* the share of transparency that the mattes of back lights leave */
} cs_over_planes;

/* Whether a program is folded so. It has several gradients: one alone is read from a table. */
bool cs_over_planes_fits(const cs_stack *stack, const cs_program *program);

/* Folds such a program for the pixels of a batch. */
void cs_over_planes_fold(cs_painter *painter, const cs_program *program, const cs_batch *batch,
                         cs_over_planes *out);

/* ---- over_planes_wide.c */

CS_WIDE_DECLARE(void, cs_over_planes_clear, (cs_over_planes * planes, int32_t count));
CS_WIDE_DECLARE(void, cs_over_planes_add_flat, (cs_over_planes * planes, const cs_over_pair *lit));
CS_WIDE_DECLARE(void, cs_over_planes_add_light, (cs_over_planes * planes, const float light[4]));
/* Adds a layer with a gradient, whose pixels are those of the batch. */
CS_WIDE_DECLARE(void, cs_over_planes_add_shade,
                (cs_over_planes * planes, const cs_layer *layer, const cs_shade *shade,
                 const cs_batch *batch));
/* Premultiplied RGBA, and 8-bit sRGB. */
CS_WIDE_DECLARE(void, cs_over_planes_to_rgba, (const cs_over_planes *planes, float (*rgba)[4]));
CS_WIDE_DECLARE(void, cs_over_planes_to_codes, (const cs_over_planes *planes, unsigned char *out));
