/* OpenEXR of one part in rows, uncompressed or compressed by runs or zlib, as celspan writes it.
 * Other files are refused with a sentence.
 * Source: OpenEXR File Layout, and Technical Introduction to OpenEXR (openexr.com).
 *
 *   magic, version | attributes, 0 | place of each chunk | chunks
 *   a chunk: first row, size, rows; a row: the values of each channel, in the order of their names
 */
#pragma once

#include "plugins/raster/raster.h"

#define CS_EXR_MAGIC 20000630u

enum { CS_EXR_ROWS = 3, CS_EXR_LINES = 16 }; /* the packing by zlib, and the rows of its chunks */

typedef enum cs_exr_type { CS_EXR_WHOLE, CS_EXR_HALF, CS_EXR_FLOAT } cs_exr_type;

/* Before compression, the bytes are reordered, first those with even indices and then those with
 * odd ones; then each byte is replaced by its difference from the previous one. */
void cs_exr_spread(const unsigned char *bytes, size_t size, unsigned char *out);
/* The reverse: changes `from`, and fills `out`. */
void cs_exr_restore(unsigned char *from, size_t size, unsigned char *out);
