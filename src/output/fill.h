/* Long runs of one pixel, at the width of the machine's stores.
 *
 * Invariant: the bytes are the same whichever way is taken; only whole blocks of CS_FILL_BLOCK
 * bytes are written, each inside the run.
 */
#ifndef CS_OUTPUT_FILL_H
#define CS_OUTPUT_FILL_H

#include <stddef.h>

enum { CS_FILL_BLOCK = 64 };

/* Repeats a pixel of `pixel_size` bytes, 1, 2, 4, 8 or 16, over `size` bytes, a multiple of it and
 * no less than a block. block: CS_FILL_BLOCK bytes, the pixel repeated. */
typedef void (*cs_fill)(unsigned char *out, size_t size, size_t pixel_size,
                        const unsigned char *block);

/* The widest that this processor has. */
cs_fill cs_fill_choose(void);

#endif
