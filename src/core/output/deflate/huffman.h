/* Prefix codes of limited length for deflate (RFC 1951, 3.2.2).
 *
 * INVARIANT: the sum of lengths times counts is the least that any prefix code within the limit
 * has; if there are several such codes, the choice depends on the counts alone.
 */
#pragma once

#include <stdint.h>

enum { CS_DEFLATE_HUFFMAN_SYMBOLS = 288, CS_DEFLATE_HUFFMAN_LIMIT = 15 };

/* Sets lengths[s] to the code length of symbol s: 0 if counts[s] is 0, otherwise 1..limit. symbols:
 * at most CS_DEFLATE_HUFFMAN_SYMBOLS; limit: at most CS_DEFLATE_HUFFMAN_LIMIT. */
void cs_deflate_huffman_lengths(const uint32_t *counts, int symbols, int limit, uint8_t *lengths);
/* The canonical codes for these lengths; the first bit of each is its lowest. */
void cs_deflate_huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes);
