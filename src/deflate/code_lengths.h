/* The header of a block with codes of its own: the lengths of its codes, from which a reader
 * derives the codes, compressed once more (RFC 1951, 3.2.7).
 *
 *   literal lengths, distance lengths --> items: a length, or a run of equal ones --> bits
 */
#ifndef CS_DEFLATE_CODE_LENGTHS_H
#define CS_DEFLATE_CODE_LENGTHS_H

#include <stdint.h>

#include "deflate/bits.h"
#include "deflate/symbols.h"

enum { CS_DEFLATE_LENGTH_SYMBOLS = 19 };

/* Items have a symbol: 0..15 is that length; 16 repeats the length before it, 17 and 18 are runs of
 * zeros, and their extra bits tell how many. They are coded by a third code, `lengths` and `codes`.
 */
typedef struct cs_deflate_code_lengths {
  int literal_count, distance_count; /* without unused symbols at the end */
  int item_count, code_count;
  uint8_t symbol[CS_DEFLATE_LITERALS + CS_DEFLATE_DISTANCES];
  uint8_t extra[CS_DEFLATE_LITERALS + CS_DEFLATE_DISTANCES];
  uint8_t lengths[CS_DEFLATE_LENGTH_SYMBOLS];
  uint16_t codes[CS_DEFLATE_LENGTH_SYMBOLS];
  uint64_t size; /* of the header in bits, without the block's first three */
} cs_deflate_code_lengths;

void cs_deflate_code_lengths_make(cs_deflate_code_lengths *header,
                                  const uint8_t literals[CS_DEFLATE_LITERALS],
                                  const uint8_t distances[CS_DEFLATE_DISTANCES]);
/* Room must have been made. */
void cs_deflate_code_lengths_put(const cs_deflate_code_lengths *header,
                                 cs_deflate_bit_stream *stream);

#endif
