/* Bits on their way to whole bytes, the first bit lowest (RFC 1951, 3.1.1).
 *
 *   put_bits --> word: up to 7 bits that fill no byte --> buffer of bytes --full--> write
 *
 * cs_deflate_bits is the state between blocks. While a block is put, its fields are copied into a
 * cs_deflate_bit_stream: the compiler can keep those in registers, because no byte that is stored
 * can alias them.
 */
#ifndef CS_DEFLATE_BITS_H
#define CS_DEFLATE_BITS_H

#include <string.h>

#include "base/context.h"

enum {
  CS_DEFLATE_BITS_BUFFER = 1 << 16,
  CS_DEFLATE_BITS_ROOM = 1024 /* bytes: the most that is put after room was made, and a margin */
};

typedef struct cs_deflate_bits {
  celspan_status (*write)(void *user, celspan_context *context, const void *bytes, size_t size);
  void *user;
  celspan_context *context; /* of the call in progress */
  celspan_status status;    /* the first failure of write, which is not called any more then */
  uint64_t bits;            /* that do not fill a byte yet */
  unsigned bit_count;       /* below 8 */
  size_t size;              /* of the bytes that wait */
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

/* count: 0..56. The whole word is stored each time: whether a byte became full could not be
 * predicted by a branch. */
static inline void cs_deflate_bits_put(cs_deflate_bit_stream *stream, uint64_t bits,
                                       unsigned count) {
  stream->bits |= bits << stream->count;
  stream->count += count;
  memcpy(stream->at, &stream->bits, 8);
  stream->at += stream->count / 8;
  stream->bits >>= stream->count & ~7u;
  stream->count &= 7;
}

#endif
