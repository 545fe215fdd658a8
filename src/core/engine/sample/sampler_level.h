/* Which mip level a footprint is averaged on, and how many taps it needs there.
 *
 *     level 0   +--+--+--+--+--+--+--+--+     a footprint of 8 texels on a side
 *     level 1   +-----+-----+-----+-----+     4
 *     level 2   +-----------+-----------+     2: enough for taps, which lie half a texel apart
 *
 * A level halves both sides of the picture. More texels under a footprint are more exact at its
 * edges, and slower.
 */
#pragma once

#include <math.h>
#include <string.h>

#include "engine/sample/sampler_texel.h"

/* The shorter side of a footprint has at least this many texels of the chosen level, and less than
 * twice as many. The longer side has at most CS_SAMPLER_MOST_BOX or CS_SAMPLER_MOST_TAPS texels. */
#define CS_SAMPLER_BOX_TEXELS 4
#define CS_SAMPLER_TAP_TEXELS 2
#define CS_SAMPLER_MOST_BOX 64
#define CS_SAMPLER_MOST_TAPS 16

/* The highest level that leaves at least `texels` across the shorter side. If the longer side then
 * has more than `most` texels, a higher level is chosen. */
static inline int cs_sampler_level(int level_count, double shorter, double longer, double texels,
                                   double most) {
  int level = 0;
  while (level + 1 < level_count && (shorter >= 2 * texels || longer > most)) {
    level++;
    shorter *= 0.5;
    longer *= 0.5;
  }
  return level;
}

/* The same for a pixel at a time, without a branch: halvings until a length, given squared, is
 * below `limit`, at most 31. (It rounds the other way where a length is the limit exactly.) */
static inline int32_t cs_sampler_halvings(double squared, double limit) {
  double ratio = squared / (limit * limit);
  int64_t bits;
  memcpy(&bits, &ratio, sizeof bits);
  int32_t octaves = (int32_t)(bits >> 52) - 1023;
  int32_t count = octaves < 0 ? 0 : octaves / 2 + 1;
  return count > 31 ? 31 : count;
}

/* Taps along a side of a footprint, whose length is given squared; texel: the side of a texel of
 * the level, in the same units. */
static inline int32_t cs_sampler_tap_count(double squared, double texel) {
  double taps = sqrt(squared) / texel - CS_SAMPLER_SAME;
  taps = taps > 1 ? taps : 1;
  taps = taps < CS_SAMPLER_MOST_TAPS ? taps : CS_SAMPLER_MOST_TAPS;
  int32_t whole = (int32_t)taps;
  return whole + (whole < taps);
}
