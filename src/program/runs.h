/* Pixels as they travel to the page of celspan watch: few bytes for flat colours, and fewer still
 * where a row is like the one above; made and read at the speed of memory.
 *
 *   head, pixel, pixel, ...   LITERAL: `count` pixels as they are
 *   head, pixel               FILL: `count` times this pixel
 *   head                      ABOVE: `count` pixels like those a row higher
 *
 * All are words of 32 bits in the order of this machine: both ends are on it. The two highest bits
 * of a head say which it is, the others are `count`. A run may continue in the next row.
 */
#pragma once

#include <stdint.h>

#include "celspan/celspan.h"

enum { CS_RUNS_LITERAL, CS_RUNS_FILL, CS_RUNS_ABOVE };

/* The words that `count` pixels can need at most. A run saves at least one word, and the head of
 * the literals after it needs one. */
static inline size_t cs_runs_words(size_t count) { return count + 1; }

/* Packs rows of `width` pixels. out: room for cs_runs_words(count). Returns the words used. */
size_t cs_runs_pack(const uint32_t *pixels, size_t count, size_t width, uint32_t *out);
