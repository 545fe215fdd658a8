#include "output/deflate/deflate.h"

#include <assert.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <zlib.h>

#include "output/deflate/block.h"
#include "output/deflate/search.h"

static_assert(CS_DEFLATE_SPACE == (int)CS_DEFLATE_SEARCH_SPACE &&
                  CS_DEFLATE_SLACK == (int)CS_DEFLATE_SEARCH_SLACK,
              "the space of the search is handed out");

/* ---------------------------------------------------------------- checksum */

/* Adler-32, the checksum of zlib streams (RFC 1950, 9): two sums modulo 65521, `a` of all bytes and
 * `b` of all values that `a` went through.
 *
 * INVARIANT: the sums may exceed the modulus between calls; a stays below 2^33 and b below 2^57. */
enum { ADLER_BASE = 65521 };

typedef struct checksum {
  uint64_t a, b;
} checksum;

/* The checksum of an empty text. */
#define CHECKSUM_EMPTY ((checksum){.a = 1})

static inline void reduce_checksum(checksum *sum) {
  sum->a %= ADLER_BASE;
  sum->b %= ADLER_BASE;
}

static inline uint32_t end_checksum(checksum sum) {
  reduce_checksum(&sum);
  return (uint32_t)(sum.b << 16 | sum.a);
}

/* Adds `count` pixels of `size` bytes p[0], p[1], ... in closed form. Of the N = count * size
 * bytes, each adds its value to a; and b sums a after every byte, so b gains N times the old a, and
 * byte j of pixel i, which has s (n - i) - j bytes from itself to the end, as often its own value:
 *
 *   a += n S                                  S = sum of p[j], n = count, s = size
 *   b += n s a + S s n (n + 1) / 2 - n sum(j p[j])
 *
 * For n up to 2^20 and s up to 8 every term is below 2^56, so nothing overflows when the sums are
 * reduced once a reaches 2^32 or b 2^56. */
static inline void checksum_run(checksum *sum, uint64_t pixel, uint64_t count, uint64_t size) {
  if (((sum->a | sum->b >> 24) >> 32) != 0)
    reduce_checksum(sum);
  sum->b += count * size * sum->a;
  if (pixel == 0)
    return;
  /* Four lanes of 16 bits hold bytes 0, 2, 4, 6 (`even`) or 1, 3, 5, 7 (`odd`); `pairs` is their
   * sum. Multiplying by one constant a lane leaves the weighted sum of all lanes in the highest:
   * sum(j p[j]) is 2 (0, 1, 2, 3) . pairs + (1, 1, 1, 1) . odd. */
  const uint64_t lanes = 0x00ff00ff00ff00ffu, ones = 0x0001000100010001u;
  uint64_t odd = pixel >> 8 & lanes, pairs = (pixel & lanes) + odd;
  uint64_t bytes = pairs * ones >> 48;
  uint64_t weighted = 2 * (pairs * 0x0000000100020003u >> 48) + (odd * ones >> 48);
  sum->a += count * bytes;
  sum->b += bytes * size * (count * (count + 1) / 2) - count * weighted;
}

static void checksum_bytes(checksum *sum, const void *bytes, size_t size) {
  uLong joined = adler32_z(end_checksum(*sum), bytes, size);
  sum->a = joined & 0xffff;
  sum->b = joined >> 16;
}

/* ---------------------------------------------------------------- the stream */

/* Runs of zeros, the most common by far, are joined across pixels and rows: zeros are counted, and
 * become tokens only when another byte follows. */
struct cs_deflate {
  size_t pixel_size;
  checksum sum;
  uint64_t size;            /* uncompressed bytes of the segment so far */
  size_t zeros;             /* zeros at the end that are not tokens yet */
  bool ends_in_zeros;       /* the last byte in a token is 0, so zeros after it can match it */
  cs_deflate_search search; /* the search of plain bytes */
  cs_deflate_block block;
};

celspan_status cs_deflate_create(celspan_context *context, size_t pixel_size,
                                 cs_deflate_write write, void *user, cs_deflate **out) {
  cs_deflate *deflate;
  CS_TRY(CS_MAKE(context, deflate, 1));
  deflate->pixel_size = deflate->search.pixel_size = pixel_size;
  deflate->search.block = &deflate->block;
  deflate->block.output.write = write;
  deflate->block.output.user = user;
  *out = deflate;
  return CELSPAN_OK;
}

void cs_deflate_destroy(cs_deflate *deflate, celspan_context *context) {
  if (deflate)
    cs_mem_free(context->memory, deflate, sizeof *deflate);
}

void cs_deflate_begin(cs_deflate *deflate) {
  cs_deflate_search_begin(&deflate->search);
  cs_deflate_block_begin(&deflate->block);
  deflate->sum = CHECKSUM_EMPTY;
  deflate->size = deflate->zeros = 0;
  deflate->ends_in_zeros = false;
}

/* ---------------------------------------------------------------- runs */

static void put_zeros(cs_deflate *deflate) {
  size_t count = deflate->zeros;
  deflate->zeros = 0;
  if (count > 0 && !(deflate->ends_in_zeros && count >= 3)) {
    cs_deflate_block_literal(&deflate->block, 0);
    count--;
  }
  if (count >= 3)
    cs_deflate_block_run(&deflate->block, count, 1);
  else
    for (; count > 0; count--)
      cs_deflate_block_literal(&deflate->block, 0);
}

static inline void put_byte(cs_deflate *deflate, unsigned char byte) {
  if (byte == 0) {
    deflate->zeros++;
    return;
  }
  if (deflate->zeros > 0)
    put_zeros(deflate);
  cs_deflate_block_literal(&deflate->block, byte);
  deflate->ends_in_zeros = false;
}

/* Three bytes become one token, unless the first byte is 0 and therefore belongs to a run of
 * zeros. */
static inline void put_pixel(cs_deflate *deflate, uint64_t pixel, size_t size) {
  size_t i = 0;
  if (size >= 3 && pixel & 0xff) {
    if (deflate->zeros > 0)
      put_zeros(deflate);
    cs_deflate_block_literals(&deflate->block, (uint32_t)pixel & 0xffffff);
    deflate->ends_in_zeros = (pixel & 0xff0000) == 0;
    i = 3;
  }
  for (; i < size; i++)
    put_byte(deflate, (unsigned char)(pixel >> 8 * i));
}

static inline void put_run(cs_deflate *deflate, cs_deflate_run run, size_t size) {
  uint64_t pixel = run.pixel;
  put_pixel(deflate, pixel, size);
  size_t bytes = (run.count - 1) * size;
  if (bytes >= 3) {
    put_zeros(deflate);
    cs_deflate_block_run(&deflate->block, bytes, size);
    deflate->ends_in_zeros = pixel >> 8 * (size - 1) == 0;
  } else {
    for (size_t i = 0; i < bytes; i++)
      put_byte(deflate, (unsigned char)(pixel >> 8 * (i % size)));
  }
}

/* size: of a pixel; the compiler sees a constant if it is 3 or 4. */
static inline void put_runs(cs_deflate *deflate, const cs_deflate_run *run, size_t run_count,
                            size_t size) {
  checksum sum = deflate->sum;
  uint64_t pixels = 0;
  for (const cs_deflate_run *end = run + run_count; run < end; run++) {
    checksum_run(&sum, run->pixel, run->count, size);
    pixels += run->count;
    if (run->pixel == 0)
      deflate->zeros += run->count * size;
    else
      put_run(deflate, *run, size);
  }
  deflate->sum = sum;
  deflate->size += pixels * size;
}

celspan_status cs_deflate_runs(cs_deflate *deflate, celspan_context *context,
                               const cs_deflate_run *runs, size_t run_count) {
  deflate->block.output.context = context;
  cs_deflate_search_flush(&deflate->search);
  if (deflate->pixel_size == 3)
    put_runs(deflate, runs, run_count, 3);
  else if (deflate->pixel_size == 4)
    put_runs(deflate, runs, run_count, 4);
  else
    put_runs(deflate, runs, run_count, deflate->pixel_size);
  return deflate->block.output.status;
}

void cs_deflate_byte(cs_deflate *deflate, unsigned char byte) {
  cs_deflate_search_flush(&deflate->search);
  deflate->sum.a += byte;
  deflate->sum.b += deflate->sum.a;
  deflate->size++;
  put_byte(deflate, byte);
}

/* ---------------------------------------------------------------- bytes */

unsigned char *cs_deflate_space(cs_deflate *deflate, celspan_context *context) {
  deflate->block.output.context = context;
  put_zeros(deflate);
  deflate->ends_in_zeros = false;
  return cs_deflate_search_space(&deflate->search);
}

celspan_status cs_deflate_commit(cs_deflate *deflate, const unsigned char *space, size_t size) {
  checksum_bytes(&deflate->sum, space, size);
  deflate->size += size;
  cs_deflate_search_commit(&deflate->search, size);
  return deflate->block.output.status;
}

/* ---------------------------------------------------------------- segments */

celspan_status cs_deflate_end(cs_deflate *deflate, celspan_context *context, cs_deflate_sum *out) {
  deflate->block.output.context = context;
  cs_deflate_search_flush(&deflate->search);
  put_zeros(deflate);
  cs_deflate_block_end(&deflate->block);
  *out = (cs_deflate_sum){end_checksum(deflate->sum), deflate->size};
  return deflate->block.output.status;
}

void cs_deflate_header(unsigned char header[CS_DEFLATE_HEADER]) {
  header[0] = 0x78; /* deflate, within 32 KiB */
  header[1] = 0x9c;
}

/* An empty last block with the fixed codes, and the checksum, highest byte first. */
void cs_deflate_trailer(cs_deflate_sum sum, unsigned char trailer[CS_DEFLATE_TRAILER]) {
  trailer[0] = 3;
  trailer[1] = 0;
  for (int i = 0; i < 4; i++)
    trailer[2 + i] = (unsigned char)(sum.adler >> (24 - 8 * i));
}

cs_deflate_sum cs_deflate_join(cs_deflate_sum first, cs_deflate_sum second) {
  uLong adler = adler32_combine(first.adler, second.adler, (z_off_t)second.size);
  return (cs_deflate_sum){(uint32_t)adler, first.size + second.size};
}
