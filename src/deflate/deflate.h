/* A zlib stream (RFC 1950, 1951) made in parts, from runs of equal pixels and from plain bytes.
 *
 * Parts are made each on its own, side by side if one likes, and joined in order between a header
 * and a trailer. Runs become literals and matches of the byte or the pixel before; the checksum
 * follows them in closed form; so their cost does not depend on their length. Plain bytes are
 * looked up among the last 32 KiB (deflate/search.h). The bytes that come out of a part depend on
 * the calls for it alone. Memory: about 850 KiB.
 */
#ifndef CS_DEFLATE_DEFLATE_H
#define CS_DEFLATE_DEFLATE_H

#include "deflate/search.h"

typedef struct cs_deflate cs_deflate;

/* pixel_size: 1..8 bytes; what equal bytes are looked for at that distance. */
CELSPAN_CHECKED celspan_status cs_deflate_create(celspan_context *context, size_t pixel_size,
                                                 cs_block_write write, void *user,
                                                 cs_deflate **out);
void cs_deflate_destroy(cs_deflate *deflate, celspan_context *context);

/* What the checksum of a whole is made of. */
typedef struct cs_deflate_sum {
  uint32_t adler;
  uint64_t size;
} cs_deflate_sum;

/* A part begins, whatever became of the one before. */
void cs_deflate_begin(cs_deflate *deflate);
/* Plain bytes: room for CS_SEARCH_PART of them, and CS_SEARCH_SLACK more that may be written
 * without meaning; then how many were put there. Errors of `write` stick, and come back from
 * cs_deflate_end at the latest. */
unsigned char *cs_deflate_space(cs_deflate *deflate, celspan_context *context);
CELSPAN_CHECKED celspan_status cs_deflate_take(cs_deflate *deflate, const unsigned char *space,
                                               size_t size);
/* `count` times the first pixel_size bytes of `pixel`, lowest first, 2^20 times at most; the bytes
 * above are 0. */
typedef struct cs_deflate_run {
  uint64_t pixel;
  uint32_t count; /* at least 1 */
} cs_deflate_run;
CELSPAN_CHECKED celspan_status cs_deflate_runs(cs_deflate *deflate, celspan_context *context,
                                               const cs_deflate_run *runs, size_t run_count);
/* One byte among runs. */
void cs_deflate_byte(cs_deflate *deflate, unsigned char byte);
/* Fills the last byte and passes on what is held. */
CELSPAN_CHECKED celspan_status cs_deflate_end(cs_deflate *deflate, celspan_context *context,
                                              cs_deflate_sum *out);

enum { CS_DEFLATE_HEADER = 2, CS_DEFLATE_TRAILER = 6 };
void cs_deflate_header(unsigned char header[CS_DEFLATE_HEADER]);
/* sum: of all parts. */
void cs_deflate_trailer(cs_deflate_sum sum, unsigned char trailer[CS_DEFLATE_TRAILER]);
cs_deflate_sum cs_deflate_join(cs_deflate_sum first, cs_deflate_sum second);
/* Of nothing. */
#define CS_DEFLATE_SUM ((cs_deflate_sum){.adler = 1})

#endif
