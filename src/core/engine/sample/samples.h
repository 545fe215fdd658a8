/* Samples of some pixels of a row, in the order in which they are soonest made and read.
 *
 *     pixel by pixel   | r g b a | r g b a | r g b a | ...            pixels 0, 1, 2, ...
 *
 *     in planes        | r0 r4 r8 r12 r1 r5 .. r15 | g0 .. | b0 .. | a0 .. |       pixels 0 to 15
 *                      | r16 ..                                                    16 to 31 ...
 *
 * Sixteen codes become planes when they are decoded in registers of 64 bytes, and planes are coded
 * in the same way: lane 4 l + j is pixel 4 j + l. Only AVX-512 makes and reads them.
 */
#pragma once

#include <stdbool.h>

#define CS_SAMPLER_BATCH 256 /* pixels made at a time, a multiple of a plane's pixels */
#define CS_SAMPLES_PLANE 16  /* pixels */

typedef struct cs_samples {
  bool are_planes;
  /* or planes; the last planes may have more pixels than requested */
  float rgba[CS_SAMPLER_BATCH][4];
} cs_samples;
