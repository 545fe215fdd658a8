/* Transfer curves between linear light and coded values in 0..1.
 *
 * Decode maps coded to linear, encode linear to coded. Deterministic: same bits on every machine.
 * Values beyond 0..1 are continued (negative ones by odd symmetry for sRGB and Rec.709).
 */
#pragma once

#include "model/colour/transfer_names.h"

float cs_transfer_decode(celspan_transfer transfer, float coded);
float cs_transfer_encode(celspan_transfer transfer, float linear);
/* The code of sRGB of light, and the light of a code, both at least 0. */
double cs_transfer_code(double light);
double cs_transfer_light(double code);
/* An exact and fast conversion of linear light 0..1 to an 8-bit sRGB code: the true curve, rounded
 * to nearest. */
uint8_t cs_transfer_srgb8(float linear);
