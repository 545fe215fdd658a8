/* Deflate blocks: tokens are gathered, counted, and put as bits with the best codes for them
 * (RFC 1951).
 *
 *   tokens (65,536 at most) --+--> counts of symbols --> codes --+--> bits --> write
 *                             +----------------------------------+
 *
 * A token is a word of 32 bits:
 *
 *    31  30      24 23       16 15  14            0
 *   +---+----------+-----------+---+---------------+
 *   | 0 | 0                              |  byte   |   a literal
 *   | 0 | 1 | 0 .. |   third   | second  |  first  |   three literals
 *   | 1 |  times   | length-3  | 0 |  distance-1   |   a match after `times` longest ones
 *   +---+----------+-----------+---+---------------+
 *
 * INVARIANT: `counts` are those of the tokens that wait. times is 0 unless the distance is at most
 * CS_DEFLATE_NEAR: so a run of a colour, whose distance is the size of a pixel, takes a token for
 * each 128 longest matches.
 */
#ifndef CS_DEFLATE_BLOCK_H
#define CS_DEFLATE_BLOCK_H

#include "deflate/bits.h"
#include "deflate/symbols.h"

typedef uint32_t cs_deflate_token;

enum {
  CS_DEFLATE_TOKENS = 1 << 16,
  CS_DEFLATE_TIMES = 127, /* longest matches in a token, before its last match */
  CS_DEFLATE_NEAR = 16
};

/* How often each thing was added. The three literals of a token are counted in three tables, by
 * their place in it: neighbours are often equal, and adding to one counter three times in a row
 * would wait for memory each time. Distances up to CS_DEFLATE_NEAR of cs_deflate_block_matches are
 * counted as they are, all others by their symbol. */
typedef struct cs_deflate_block_counts {
  uint32_t literals[3][256], lengths[256], near_distances[CS_DEFLATE_NEAR];
  uint32_t distances[CS_DEFLATE_DISTANCES];
} cs_deflate_block_counts;

typedef struct cs_deflate_block {
  cs_deflate_bits output; /* its write, user and context are set by the caller */
  size_t token_count;
  cs_deflate_token tokens[CS_DEFLATE_TOKENS];
  cs_deflate_block_counts counts;
} cs_deflate_block;

/* Drops all tokens and bits that wait, and any failure. */
void cs_deflate_block_begin(cs_deflate_block *block);

/* Puts the waiting tokens as one block, with codes of its own or the fixed ones, whichever is
 * shorter. */
void cs_deflate_block_put(cs_deflate_block *block);

static inline void cs_deflate_block_add(cs_deflate_block *block, cs_deflate_token token) {
  block->tokens[block->token_count++] = token;
  if (block->token_count == CS_DEFLATE_TOKENS)
    cs_deflate_block_put(block);
}

static inline void cs_deflate_block_literal(cs_deflate_block *block, unsigned char byte) {
  block->counts.literals[0][byte]++;
  cs_deflate_block_add(block, byte);
}

/* Three bytes, the first lowest. */
static inline void cs_deflate_block_literals(cs_deflate_block *block, uint32_t bytes) {
  for (int i = 0; i < 3; i++)
    block->counts.literals[i][bytes >> 8 * i & 255]++;
  cs_deflate_block_add(block, 0x40000000u | bytes);
}

/* length 3..258, distance 1..32768. */
void cs_deflate_block_match(cs_deflate_block *block, size_t length, size_t distance);

/* `times` longest matches and then one of `length`, all from the same near distance. */
static inline void cs_deflate_block_matches(cs_deflate_block *block, size_t times, size_t length,
                                            size_t distance) {
  block->counts.lengths[255] += (uint32_t)times;
  block->counts.lengths[length - 3]++;
  block->counts.near_distances[distance - 1] += (uint32_t)times + 1;
  cs_deflate_block_add(block, 0x80000000u | (cs_deflate_token)times << 24 |
                                  (cs_deflate_token)(length - 3) << 16 |
                                  (cs_deflate_token)(distance - 1));
}

/* Any number of bytes, at least 3, that equal those `distance` before them (near). */
static inline void cs_deflate_block_run(cs_deflate_block *block, size_t bytes, size_t distance) {
  const size_t longest = CS_DEFLATE_LONGEST_MATCH;
  size_t times = (bytes - 3) / longest, rest = bytes - times * longest;
  for (; times > CS_DEFLATE_TIMES; times -= CS_DEFLATE_TIMES + 1)
    cs_deflate_block_matches(block, CS_DEFLATE_TIMES, longest, distance);
  if (rest <= longest) {
    cs_deflate_block_matches(block, times, rest, distance);
  } else { /* the remainder must not be shorter than a match */
    cs_deflate_block_matches(block, times, rest - 3, distance);
    cs_deflate_block_matches(block, 0, 3, distance);
  }
}

/* Puts the waiting tokens, fills the last byte with an empty block, and writes all bytes. */
void cs_deflate_block_end(cs_deflate_block *block);

#endif
