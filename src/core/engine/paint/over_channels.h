/* The fold of over_row.h for programs of flat layers and gradients that dim the three channels
 * alike, in front of all back lights: most programs. They lie in no group, or all in one that does
 * nothing but be lit by a gradient. A register holds one channel of as many pixels as it has lanes,
 * so that their shares and transmissions are computed once for all channels, and the codes of
 * pixels need no shuffling.
 *
 *     red      [ r r r r r r r r   r r r r ...     light gathered
 *     green    [ g g g g g g g g   g g g g ...
 *     blue     [ b b b b b b b b   b b b b ...
 *     through  [ t t t t t t t t   t t t t ...     transmission
 *
 * Both layouts remain. Without this one, a frame of scripts/demo.lua takes 3.1 % more instructions
 * (171.1 million instead of 166.0, at 1280 x 720). Without over_row.h, this one would need a
 * transmission for each channel, groups, keys, mattes and blend modes.
 *
 * Invariant: the arithmetic is the same as in over_row.h, so the bits are the same.
 */
#pragma once

#include "engine/paint/ahead.h"
#include "engine/paint/over_row.h"
#include "engine/paint/painter.h"

/* Whether a program is folded so. It has several gradients: one alone is read from a table. */
bool cs_over_channels_fits(const cs_stack *stack, const cs_program *program);
/* Folds a run ahead, if the program is folded so and neither it nor the run is long. This function
 * and the last one: only where the painter has room for what is folded ahead. */
void cs_over_channels_prepare(cs_painter *painter, const cs_program *program, cs_run run);

/* The colours of a batch, premultiplied RGBA, and its codes, folded ahead or not. False: the
 * program is not folded so. */
bool cs_over_channels_colours(cs_painter *painter, const cs_program *program, const cs_batch *batch,
                              float (*rgba)[4]);
bool cs_over_channels_codes(cs_painter *painter, const cs_program *program, const cs_batch *batch,
                            unsigned char *codes);
/* The colours where they have been folded ahead. False: they have not. */
bool cs_over_channels_ready(const cs_painter *painter, const cs_program *program,
                            const cs_batch *batch, float (*rgba)[4]);

/* ---- over_channels_wide.c */

CS_WIDE_DECLARE(void, cs_over_channels_clear, (cs_over_channels * pixels, int32_t count));
CS_WIDE_DECLARE(void, cs_over_channels_add_flat,
                (cs_over_channels * pixels, const cs_over_pair *lit));
CS_WIDE_DECLARE(void, cs_over_channels_add_light,
                (cs_over_channels * pixels, const float light[4]));
/* Multiplies light by the light of a front light, as cs_over_row_light_group. */
CS_WIDE_DECLARE(void, cs_over_channels_light,
                (cs_over_channels * pixels, const cs_over_channels *front));
/* Adds a layer with a gradient, for the pixels of the batch. */
CS_WIDE_DECLARE(void, cs_over_channels_add_shade,
                (cs_over_channels * pixels, const cs_layer *layer, const cs_shade *shade,
                 const cs_batch *batch));
/* 8-bit sRGB of `count` pixels from a first one on. */
CS_WIDE_DECLARE(void, cs_over_channels_to_codes,
                (const cs_over_channels *pixels, int32_t first, int32_t count, unsigned char *out));
