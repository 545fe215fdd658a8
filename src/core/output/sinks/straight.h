/* Loops of the coder for which registers of any width are good: with exact arithmetic, so that the
 * numbers are the same whichever instructions made them. */
#pragma once

#include "base/wide.h"

/* Divides the colours of `count` pixels by their alpha. Where this is not above 0, the colour
 * becomes 0, unless keeps_clear. */
CS_WIDE_DECLARE(void, cs_straight_divide, (float *rgba, int32_t count, bool keeps_clear));

/* Numbers clamped to 0..1, as 16-bit integers, rounded half up. NaN becomes 0. */
CS_WIDE_DECLARE(void, cs_straight_words,
                (const float *restrict numbers, int32_t count, uint16_t *restrict words));
