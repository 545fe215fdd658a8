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
 * INVARIANT: `counts` are the counts of the tokens that wait. times is 0 unless the distance is at
 * most CS_DEFLATE_NEAR: so a run of a colour, whose distance is the size of a pixel, takes a token
 * for each 128 longest matches.
 */
#pragma once

#include <string.h>

#include "base/context.h"

/* ---- symbols
 *
 * The alphabets of deflate and how lengths and distances become symbols (RFC 1951, 3.2.5).
 *
 * Both are coded alike: a symbol stands for the highest bits of a number, and the lower ones follow
 * as they are, as extra bits. With `kept` bits after the leading one in the symbol:
 *
 *   distance - 1 (kept = 1)      0  1  2  3  4..5  6..7  8..11  12..15  16..23 ...
 *   symbol                       0  1  2  3   4     5     6       7       8
 *   extra bits                   0  0  0  0   1     1     2       2       3
 */

enum {
  /* 256 bytes, the end of a block and 29 lengths; the last two are never used. */
  CS_DEFLATE_LITERALS = 288,
  CS_DEFLATE_END_OF_BLOCK = 256,
  CS_DEFLATE_DISTANCES = 30,
  CS_DEFLATE_LONGEST_MATCH = 258,
  CS_DEFLATE_SHORTEST_MATCH = 3
};

typedef struct cs_deflate_symbol {
  int symbol, extra_bits;
  unsigned extra;
} cs_deflate_symbol;

static inline cs_deflate_symbol cs_deflate_symbol_of(unsigned number, int kept) {
  if (number >> (kept + 1) == 0)
    return (cs_deflate_symbol){(int)number, 0, 0};
  int extra_bits = 31 - __builtin_clz(number) - kept;
  int symbol = (extra_bits << kept) + (int)(number >> extra_bits);
  return (cs_deflate_symbol){symbol, extra_bits, number & ((1u << extra_bits) - 1)};
}

/* The greatest length, 258, has its own symbol. */
static inline cs_deflate_symbol cs_deflate_symbol_of_length(unsigned length_less_3) {
  cs_deflate_symbol made =
      length_less_3 == 255 ? (cs_deflate_symbol){28, 0, 0} : cs_deflate_symbol_of(length_less_3, 2);
  made.symbol += CS_DEFLATE_END_OF_BLOCK + 1;
  return made;
}

static inline cs_deflate_symbol cs_deflate_symbol_of_distance(unsigned distance_less_1) {
  return cs_deflate_symbol_of(distance_less_1, 1);
}

/* ---- bits
 *
 * Bits on their way to whole bytes, the first bit lowest (RFC 1951, 3.1.1).
 *
 *   put_bits --> word: up to 7 bits that fill no byte --> buffer of bytes --full--> write
 *
 * cs_deflate_bits is the state between blocks. While a block is put, its fields are copied into a
 * cs_deflate_bit_stream: the compiler can keep those in registers, because no byte that is stored
 * can alias them.
 */

enum {
  CS_DEFLATE_BITS_BUFFER = 1 << 16,
  CS_DEFLATE_BITS_ROOM = 1024 /* bytes: the most that is put after room was made, and a margin */
};

typedef struct cs_deflate_bits {
  celspan_status (*write)(void *user, celspan_context *context, const void *bytes, size_t size);
  void *user;
  celspan_context *context; /* the context of the call in progress */
  celspan_status status;    /* the first failure of write, which is not called again after it */
  uint64_t bits;            /* bits that do not fill a byte yet */
  unsigned bit_count;       /* below 8 */
  size_t size;              /* bytes that wait to be written */
  unsigned char bytes[CS_DEFLATE_BITS_BUFFER + 8];
} cs_deflate_bits;

typedef struct cs_deflate_bit_stream {
  uint64_t bits;
  unsigned count;
  unsigned char *at;
  cs_deflate_bits *target;
} cs_deflate_bit_stream;

static inline void cs_deflate_bits_begin(cs_deflate_bits *bits) {
  bits->status = CELSPAN_OK;
  bits->bits = 0;
  bits->bit_count = 0;
  bits->size = 0;
}

static inline cs_deflate_bit_stream cs_deflate_bits_open(cs_deflate_bits *bits) {
  return (cs_deflate_bit_stream){bits->bits, bits->bit_count, bits->bytes + bits->size, bits};
}

static inline void cs_deflate_bits_close(const cs_deflate_bit_stream *stream) {
  stream->target->bits = stream->bits;
  stream->target->bit_count = stream->count;
  stream->target->size = (size_t)(stream->at - stream->target->bytes);
}

/* Writes the first `size` bytes of the buffer, which are all that wait. */
static inline void cs_deflate_bits_drain(cs_deflate_bits *bits, size_t size) {
  if (bits->status == CELSPAN_OK && size > 0)
    bits->status = bits->write(bits->user, bits->context, bits->bytes, size);
  bits->size = 0;
}

/* Makes room for CS_DEFLATE_BITS_ROOM more bytes: for a token, or for a block's header. */
static inline void cs_deflate_bits_make_room(cs_deflate_bit_stream *stream) {
  cs_deflate_bits *target = stream->target;
  if (stream->at > target->bytes + CS_DEFLATE_BITS_BUFFER - CS_DEFLATE_BITS_ROOM) {
    cs_deflate_bits_drain(target, (size_t)(stream->at - target->bytes));
    stream->at = target->bytes;
  }
}

/* count: 0..56. The whole word is stored each time, because a branch on whether a byte is full
 * could not be predicted. */
static inline void cs_deflate_bits_put(cs_deflate_bit_stream *stream, uint64_t bits,
                                       unsigned count) {
  stream->bits |= bits << stream->count;
  stream->count += count;
  memcpy(stream->at, &stream->bits, 8);
  stream->at += stream->count / 8;
  stream->bits >>= stream->count & ~7u;
  stream->count &= 7;
}

/* ---- tokens */

typedef uint32_t cs_deflate_token;

enum {
  CS_DEFLATE_TOKENS = 1 << 16,
  CS_DEFLATE_TIMES = 127, /* the most longest matches in a token, before its last match */
  CS_DEFLATE_NEAR = 16
};

/* How often each symbol was added. The three literals of a token are counted in three tables:
 * neighbours are often equal, and to add to the same counter three times in a row would wait for
 * memory each time. Distances up to CS_DEFLATE_NEAR of cs_deflate_block_matches are counted as they
 * are, all others by their symbol. */
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

/* Drops all tokens and bits that wait to be written, and any failure. */
void cs_deflate_block_begin(cs_deflate_block *block);

/* Puts the waiting tokens as one block, with its own codes or the fixed ones, whichever needs fewer
 * bits. */
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

/* Adds three bytes, the first one lowest. */
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

/* Adds at least 3 bytes that equal the bytes `distance` before them (near). */
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
