/* Keys: how much of a colour stays, by its hue or by its brightness, and what is left of it without
 * the light of the screen. All of it is about sRGB codes, and Y, Cb and Cr of Rec. 709.
 *
 *        Cr
 *         |      . - - - .            by hue: clear within the tolerance of the screen's chroma,
 *         |    .   .---.   .          then more and more there over the softness
 *         |   .   ( key )   .
 *         |    .   '---'   .          by brightness: as Y lies between two codes
 *         |      ' - - - '
 *     ----+---------------------- Cb
 *
 * Spill: a chroma of which x lies along the screen's and z across it, as shares of its length,
 * contains the share q = x - |z| / tan 60 degrees of the screen K, if that is above 0. It is taken
 * off, and the rest takes its place: (c - q K) / (1 - q), within 0 and 1, or the brightest channel
 * of c. So an edge half covered by the art gets the colour of the art.
 *
 * Invariant: the result is finite, and the same bits for one colour as for many (keying_lanes.h).
 */
#pragma once

#include "base/vector.h"
#include "model/colour/keying_lanes.h"
#include "model/colour/space.h"

/* The least softness: a fifth of an 8-bit code, over which no rounding can be seen. */
#define CS_KEYING_NARROWEST 0x1p-10

/* codes: of the screen. tolerance, softness: not below 0. */
cs_keying cs_keying_of_chroma(const double codes[3], double tolerance, double softness,
                              double spill);
/* Clear at and beyond the code `from`, whole at and beyond `to`. */
cs_keying cs_keying_of_luma(double from, double to);
/* The distance of codes from grey: the length of Cb, Cr. */
double cs_keying_hue(const double codes[3]);

/* Replaces premultiplied light by the light without spill, and returns the share of it that stays.
 * alpha: the coverage; light without coverage counts as if its coverage were its brightness. */
float cs_keying_light(const cs_keying *key, celspan_space space, float alpha, cs_v4 *light);
