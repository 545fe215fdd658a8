/* CRC-32C (Castagnoli), the checksum of headers, trailers and records.
 *
 * INVARIANT: the sum is the same whether the processor's instruction or the tables compute it.
 */
#pragma once

#include "layout.h"

/* Continues from `sum`, which is 0 at the beginning. */
uint32_t sf_crc32c(uint32_t sum, const void *bytes, size_t size);
/* The same without the instruction; tests compare the two. */
uint32_t sf_crc32c_by_tables(uint32_t sum, const void *bytes, size_t size);

/* The checksum of a record covers the number of its row too, so that a record in a wrong place is
 * refused. */
static inline uint32_t sf_crc32c_record(uint32_t row, const void *bytes, size_t size) {
  unsigned char number[4];
  sf_store_32(number, row);
  return sf_crc32c(sf_crc32c(0, number, sizeof number), bytes, size);
}
