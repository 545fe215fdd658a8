/* splitmix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014): a
 * counter whose values are mixed. Seeds that lie side by side give streams that have nothing in
 * common, and every 64-bit value comes once in 2^64 steps. */
#pragma once

#include <stdint.h>

/* The next word of the stream; *state: any seed at first. */
static inline uint64_t cs_splitmix_next(uint64_t *state) {
  uint64_t word = *state += UINT64_C(0x9e3779b97f4a7c15);
  word = (word ^ word >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  word = (word ^ word >> 27) * UINT64_C(0x94d049bb133111eb);
  return word ^ word >> 31;
}
