/* Rows of raw pictures: loops over their samples and pixels, which raw_row.c puts together.
 *
 * Mixtures of samples are exact: shares are quarters, and samples have 16 bits at most. So they may
 * be mixed down first, and across then.
 */
#pragma once

#include "inside/wide.h"

/* By how much colours change the light. */
typedef struct cs_raw_shares {
  float red_cr, blue_cb, green_cb, green_cr;
} cs_raw_shares;

/* Between two rows of samples of one or two bytes: a at share 0. */
CS_WIDE_DECLARE(void, cs_raw_widen,
                (const unsigned char *a, const unsigned char *b, float share, int bytes,
                 int32_t count, float *out));
/* `count` pairs of pixels. The first one of pair i lies between samples i and i + 1, the second one
 * between i + 1 and i + 2. */
CS_WIDE_DECLARE(void, cs_raw_spread,
                (const float *samples, const float shares[2], int32_t count, float *out));
CS_WIDE_DECLARE(void, cs_raw_scale, (float black, float scale, int32_t count, float *values));
/* Light, Cb and Cr become red, green and blue in their places. */
CS_WIDE_DECLARE(void, cs_raw_mix,
                (const cs_raw_shares *by, int32_t count, float *red, float *green, float *blue));
/* Codes of 8 bits, or of 16 where `is_deep`, at an even address. */
CS_WIDE_DECLARE(void, cs_raw_put, (float *const rows[4], int32_t count, bool is_deep, void *out));
