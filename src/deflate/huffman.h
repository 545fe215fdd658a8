/* Optimal prefix codes of limited length, as deflate wants them (RFC 1951, 3.2.2). */
#ifndef CS_DEFLATE_HUFFMAN_H
#define CS_DEFLATE_HUFFMAN_H

#include <stdint.h>

enum { CS_HUFFMAN_SYMBOLS = 288, CS_HUFFMAN_LIMIT = 15 };

/* lengths[s] becomes the code length of symbol s: 0 where counts[s] is 0, else 1..limit. The sum of
 * the lengths times the counts is least. symbols <= CS_HUFFMAN_SYMBOLS, limit <= CS_HUFFMAN_LIMIT.
 */
void cs_deflate_huffman_lengths(const uint32_t *counts, int symbols, int limit, uint8_t *lengths);
/* The canonical codes of these lengths, first bit lowest. */
void cs_deflate_huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes);

#endif
