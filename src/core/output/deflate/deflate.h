/* A zlib stream (RFC 1950, 1951) compressed from runs of equal pixels as well as from plain bytes.
 *
 * Why zlib is not enough: it reads bytes. A row of a drawn frame is a few runs of a colour; to lay
 * them out as bytes, and to search those for what repeats, costs time for every pixel. Here a run
 * becomes tokens directly: its first pixel as literals, the others as matches at the distance of a
 * pixel. The checksum passes over a run in closed form (output/deflate/deflate.c). So the cost of a
 * run hardly depends on its length: a token for each 128 matches of 258 bytes. (zlib itself serves
 * for the checksums of plain bytes.)
 *
 *   runs of pixels -----------------+
 *   a byte -------------------------+--> tokens --> block --> codes --> bits --> write
 *   plain bytes --> search matches -+    block.h             huffman.h
 *                   search.h
 *
 * The stream is made in segments, each compressed on its own, on several threads if need be:
 *
 *   | header | segment | segment | ... | segment | trailer: last block, checksum of all |
 *
 * INVARIANT: a segment's bytes depend only on the calls between its cs_deflate_begin and
 * cs_deflate_end. It ends with a whole byte and refers to nothing outside, so segments can be
 * joined by writing one after the other. Memory: about 850 KiB for each cs_deflate.
 */
#pragma once

#include "base/context.h"

typedef struct cs_deflate cs_deflate;

/* Receives compressed bytes, in order. Its first failure is returned by the call that flushes the
 * bytes or by a later one, at the latest by cs_deflate_end. After a failure it is not called
 * again. */
typedef celspan_status (*cs_deflate_write)(void *user, celspan_context *context, const void *bytes,
                                           size_t size);

/* pixel_size: bytes of the pixels in runs, 1..8; plain bytes are also compared at this distance.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_deflate_create(celspan_context *context, size_t pixel_size,
                                                 cs_deflate_write write, void *user,
                                                 cs_deflate **out);
/* NULL is ignored. */
void cs_deflate_destroy(cs_deflate *deflate, celspan_context *context);

/* ---- a segment */

/* Begins a segment. A segment that has not ended is dropped. */
void cs_deflate_begin(cs_deflate *deflate);

/* The first pixel_size bytes of `pixel`, repeated `count` times, the lowest byte first; higher
 * bytes are 0. */
typedef struct cs_deflate_run {
  uint64_t pixel;
  uint32_t count; /* 1..2^20 */
} cs_deflate_run;
CELSPAN_CHECKED celspan_status cs_deflate_runs(cs_deflate *deflate, celspan_context *context,
                                               const cs_deflate_run *runs, size_t run_count);
/* One byte between runs. */
void cs_deflate_byte(cs_deflate *deflate, unsigned char byte);

/* Plain bytes: write up to CS_DEFLATE_SPACE bytes to the space that the first call returns (after
 * them, up to CS_DEFLATE_SLACK bytes may be overwritten). The second call says how many were
 * written. */
enum { CS_DEFLATE_SPACE = 4096, CS_DEFLATE_SLACK = 64 };
unsigned char *cs_deflate_space(cs_deflate *deflate, celspan_context *context);
CELSPAN_CHECKED celspan_status cs_deflate_commit(cs_deflate *deflate, const unsigned char *space,
                                                 size_t size);

/* Adler-32 and the number of uncompressed bytes of a segment, or of several joined segments. */
typedef struct cs_deflate_sum {
  uint32_t adler;
  uint64_t size;
} cs_deflate_sum;
#define CS_DEFLATE_SUM_EMPTY ((cs_deflate_sum){.adler = 1})

/* Fills the last byte and writes all bytes that are waiting. */
CELSPAN_CHECKED celspan_status cs_deflate_end(cs_deflate *deflate, celspan_context *context,
                                              cs_deflate_sum *out);

/* ---- around all segments */

enum { CS_DEFLATE_HEADER = 2, CS_DEFLATE_TRAILER = 6 };
void cs_deflate_header(unsigned char header[CS_DEFLATE_HEADER]);
/* sum: of all segments, joined in order. */
void cs_deflate_trailer(cs_deflate_sum sum, unsigned char trailer[CS_DEFLATE_TRAILER]);
cs_deflate_sum cs_deflate_join(cs_deflate_sum first, cs_deflate_sum second);
