/* A zlib stream (RFC 1950, 1951) made from runs of equal pixels and from plain bytes.
 *
 * Made for filtered rows of pictures: long runs cost a token each 258 bytes and a closed-form step
 * of the checksum; everything else is looked up at its last two occurrences within 32 KiB.
 * The bytes that come out depend on the calls alone. Memory: about 750 KiB, whatever the length.
 */
#ifndef CS_OUTPUT_DEFLATE_H
#define CS_OUTPUT_DEFLATE_H

#include "output/block.h"

typedef struct cs_deflate cs_deflate;

/* pixel_size: 1..8 bytes; what equal bytes are looked for at that distance. */
CELSPAN_CHECKED celspan_status cs_deflate_create(celspan_context *context, size_t pixel_size,
                                                 cs_block_write write, void *user,
                                                 cs_deflate **out);
void cs_deflate_destroy(cs_deflate *deflate, celspan_context *context);

/* Errors of `write` stick, and come back from cs_deflate_finish at the latest. */
CELSPAN_CHECKED celspan_status cs_deflate_bytes(cs_deflate *deflate, celspan_context *context,
                                                const void *bytes, size_t size);
/* `count` times the first pixel_size bytes of `pixel`, lowest first. */
CELSPAN_CHECKED celspan_status cs_deflate_run(cs_deflate *deflate, celspan_context *context,
                                              uint64_t pixel, size_t count);
CELSPAN_CHECKED celspan_status cs_deflate_finish(cs_deflate *deflate, celspan_context *context);

#endif
