/* Deflate blocks: tokens to bits (RFC 1951). */
#ifndef CS_DEFLATE_BLOCK_H
#define CS_DEFLATE_BLOCK_H

#include "base/context.h"

/* Receives compressed bytes, in order. */
typedef celspan_status (*cs_block_write)(void *user, celspan_context *context, const void *bytes,
                                         size_t size);

/* A literal is its byte; in bits 30 and 31 else: 1, three literals, the first lowest; 2 and 3, a
 * match: its length less 3 from bit 16 on, its distance less 1 from bit 0 on, and from bit 24 on
 * how many matches of the greatest length come before it, from a distance of at most CS_BLOCK_NEAR.
 */
typedef uint32_t cs_token;

enum {
  CS_BLOCK_BYTES = 1 << 16,
  CS_BLOCK_TOKENS = 1 << 16,
  CS_BLOCK_LONGEST = 258, /* and the shortest match is 3 */
  CS_BLOCK_TIMES = 127,   /* matches before one, at most */
  CS_BLOCK_NEAR = 16,
  CS_BLOCK_DISTANCES = 30 /* their symbols */
};

/* How often what was told; literals by their place in a token, so that equal ones in a row are
 * counted side by side. */
typedef struct cs_deflate_block_counts {
  uint32_t literals[3][256], lengths[256], near_distances[CS_BLOCK_NEAR];
  uint32_t distances[CS_BLOCK_DISTANCES]; /* of matches that cs_deflate_block_match was told */
} cs_deflate_block_counts;

/* Tokens of a block, and bits on their way out. Errors stick in status. */
typedef struct cs_deflate_block_writer {
  cs_block_write write;
  void *user;
  celspan_context *context; /* of the call in progress */
  celspan_status status;
  uint64_t bits; /* not yet in bytes, the first lowest */
  unsigned bit_count;
  size_t size;
  unsigned char bytes[CS_BLOCK_BYTES + 8];
  size_t token_count;
  cs_token tokens[CS_BLOCK_TOKENS];
  cs_deflate_block_counts counts; /* of the tokens */
} cs_deflate_block_writer;

/* write, user and context are kept. */
void cs_deflate_block_begin(cs_deflate_block_writer *writer);

/* One block of the tokens that are held, with codes of its own or the fixed ones, whichever is
 * shorter. */
void cs_deflate_block_put(cs_deflate_block_writer *writer);

static inline void cs_deflate_block_add(cs_deflate_block_writer *writer, cs_token token) {
  writer->tokens[writer->token_count++] = token;
  if (writer->token_count == CS_BLOCK_TOKENS)
    cs_deflate_block_put(writer);
}

static inline void cs_deflate_block_literal(cs_deflate_block_writer *writer, unsigned char byte) {
  writer->counts.literals[0][byte]++;
  cs_deflate_block_add(writer, byte);
}

/* Three of them, the first lowest. */
static inline void cs_deflate_block_literals(cs_deflate_block_writer *writer, uint32_t bytes) {
  for (int i = 0; i < 3; i++)
    writer->counts.literals[i][bytes >> 8 * i & 255]++;
  cs_deflate_block_add(writer, 0x40000000u | bytes);
}

/* length 3..258, distance 1..32768. */
void cs_deflate_block_match(cs_deflate_block_writer *writer, size_t length, size_t distance);

/* `times` of the longest matches, and one more. */
static inline void cs_deflate_block_matches(cs_deflate_block_writer *writer, size_t times,
                                            size_t length, size_t distance) {
  writer->counts.lengths[255] += (uint32_t)times;
  writer->counts.lengths[length - 3]++;
  writer->counts.near_distances[distance - 1] += (uint32_t)times + 1;
  cs_deflate_block_add(writer, 0x80000000u | (cs_token)times << 24 | (cs_token)(length - 3) << 16 |
                                   (cs_token)(distance - 1));
}

/* Any number of bytes, 3 at least, that are those `distance` before, at most CS_BLOCK_NEAR. */
static inline void cs_deflate_block_run(cs_deflate_block_writer *writer, size_t bytes,
                                        size_t distance) {
  size_t times = (bytes - 3) / CS_BLOCK_LONGEST, rest = bytes - times * CS_BLOCK_LONGEST;
  for (; times > CS_BLOCK_TIMES; times -= CS_BLOCK_TIMES + 1)
    cs_deflate_block_matches(writer, CS_BLOCK_TIMES, CS_BLOCK_LONGEST, distance);
  if (rest <= CS_BLOCK_LONGEST) {
    cs_deflate_block_matches(writer, times, rest, distance);
  } else { /* what is left must not be shorter than a match */
    cs_deflate_block_matches(writer, times, rest - 3, distance);
    cs_deflate_block_matches(writer, 0, 3, distance);
  }
}

/* Puts what is left; an empty block that ends with a whole byte; passes all on. */
void cs_deflate_block_end(cs_deflate_block_writer *writer);

#endif
