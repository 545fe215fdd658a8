/* Pixels of eight bits as Y'CbCr of eight bits: the matrix of BT.709, the range of television.
 *
 *   Y' = 16 + 219 (0.2126 R + 0.7152 G + 0.0722 B) / 255
 *   Cb = 128 + 224 (B - Y) / (1.8556 x 255)      Cr = 128 + 224 (R - Y) / (1.5748 x 255)
 *
 * where Y is the sum in brackets, and R, G and B are codes as they are, sRGB or other.
 *
 *   4:4:4   a pixel, a colour          4:2:0   y y   the colour of four pixels is
 *                                              y y   from their mean: one cb, one cr
 *
 * INVARIANT: every number is the exact one rounded to nearest, except that sums in float may take
 * one that lies within 2^-14 of a half to either side.
 *
 * Source: Rec. ITU-R BT.709-6, items 3.2 to 3.5.
 */
#pragma once

#include "base/wide.h"

/* Pixels are four bytes: red, green, blue, and one that is not read. */
CS_WIDE_DECLARE(void, cs_ycbcr_luma,
                (const uint32_t *restrict pixels, int32_t count, unsigned char *restrict luma));
CS_WIDE_DECLARE(void, cs_ycbcr_chroma,
                (const uint32_t *restrict pixels, int32_t count, unsigned char *restrict cb,
                 unsigned char *restrict cr));
/* 4:2:0 of two rows. count: of colours; 2 count pixels are read from each row. */
CS_WIDE_DECLARE(void, cs_ycbcr_halved,
                (const uint32_t *restrict upper, const uint32_t *restrict lower, int32_t count,
                 unsigned char *restrict cb, unsigned char *restrict cr));
