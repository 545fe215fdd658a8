/* Deflate blocks: tokens to bits (RFC 1951). */
#ifndef CS_OUTPUT_BLOCK_H
#define CS_OUTPUT_BLOCK_H

#include "base/context.h"

/* Receives compressed bytes, in order. */
typedef celspan_status (*cs_block_write)(void *user, celspan_context *context, const void *bytes,
                                         size_t size);

/* A literal is its byte; three of them in one, the first lowest, and matches are made here. length
 * 3..258, distance 1..32768. Of a run's matches all but the last are of the greatest length:
 * `times`, at most CS_TOKEN_TIMES, from a distance of at most CS_TOKEN_NEAR. */
typedef uint32_t cs_token;
enum { CS_TOKEN_LONGEST = 258, CS_TOKEN_TIMES = 127, CS_TOKEN_NEAR = 16 };
static inline cs_token cs_token_triple(uint32_t bytes) { return 0x40000000u | bytes; }
static inline bool cs_token_is_triple(cs_token token) { return token >> 30 == 1; }
static inline cs_token cs_token_match(size_t length, size_t distance) {
  return 0x80000000u | (cs_token)(length - 3) << 16 | (cs_token)(distance - 1);
}
static inline cs_token cs_token_run(size_t times, size_t length, size_t distance) {
  return cs_token_match(length, distance) | (cs_token)times << 24;
}
static inline uint32_t cs_token_times(cs_token token) { return token >> 24 & CS_TOKEN_TIMES; }

enum { CS_BLOCK_BYTES = 1 << 16, CS_BLOCK_TOKENS = 1 << 16 };

/* Tokens of a block, and bits on their way out. Errors stick in status. */
typedef struct cs_block_writer {
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
} cs_block_writer;

/* write, user and context are kept. */
void cs_block_begin(cs_block_writer *writer);

/* One block of the tokens that are held, with codes of its own or the fixed ones, whichever is
 * shorter. */
void cs_block_put(cs_block_writer *writer);

static inline void cs_block_add(cs_block_writer *writer, cs_token token) {
  writer->tokens[writer->token_count++] = token;
  if (writer->token_count == CS_BLOCK_TOKENS)
    cs_block_put(writer);
}

/* Any number of bytes, 3 at least, that are those `distance` before, at most CS_TOKEN_NEAR. */
static inline void cs_block_add_run(cs_block_writer *writer, size_t bytes, size_t distance) {
  size_t times = (bytes - 3) / CS_TOKEN_LONGEST, rest = bytes - times * CS_TOKEN_LONGEST;
  for (; times > CS_TOKEN_TIMES; times -= CS_TOKEN_TIMES + 1)
    cs_block_add(writer, cs_token_run(CS_TOKEN_TIMES, CS_TOKEN_LONGEST, distance));
  if (rest <= CS_TOKEN_LONGEST) {
    cs_block_add(writer, cs_token_run(times, rest, distance));
  } else { /* what is left must not be shorter than a match */
    cs_block_add(writer, cs_token_run(times, rest - 3, distance));
    cs_block_add(writer, cs_token_match(3, distance));
  }
}

/* Puts what is left; an empty block that ends with a whole byte; passes all on. */
void cs_block_end(cs_block_writer *writer);

#endif
