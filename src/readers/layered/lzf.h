/* LZF, the packing of Krita's tiles: literal runs and copies of what was unpacked before.
 *
 *   000nnnnn                   n + 1 bytes follow
 *   lllooooo oooooooo          copy l + 2 bytes from o + 1 bytes back; l from 1 to 6
 *   111ooooo llllllll oooooooo   the same with l + 9 bytes
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* False unless the packed bytes unpack to exactly out_size bytes. */
bool cs_lzf_unpack(const unsigned char *packed, size_t size, unsigned char *out, size_t out_size);
