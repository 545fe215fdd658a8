/* Corrects the checksums of a file whose bytes were changed, so that the checks behind them are
 * tested.
 */
#pragma once

#include "../src/crc32c.h"
#include "support.h"

/* Corrects header and trailer, and the records as far as they can be recognised. */
static inline void mend_sums(memory_file *file, uint32_t height) {
  size_t at = SF_HEADER_BYTES, end = file->size - SF_END_BYTES;
  uint32_t y = 0;
  sf_store_32(file->bytes + 42, sf_crc32c(0, file->bytes, 42));
  sf_store_32(file->bytes + end + 36, sf_crc32c(0, file->bytes + end, 36));
  while (at + 6 <= end && y <= height) {
    uint64_t length;
    size_t head = 1 + sf_load_varint(file->bytes + at + 1, 4, &length);
    if (head == 1 || length > end - at - head || end - at - head - length < 4)
      return;
    size_t size = head + (size_t)length;
    bool is_index = file->bytes[at] == SF_INDEX;
    sf_store_32(file->bytes + at + size,
                sf_crc32c_record(is_index ? SF_INDEX_ROW : y, file->bytes + at, size));
    y += !is_index;
    at += size + 4;
  }
}

/* Makes header and trailer agree with each other and the size, which a fuzzer would have to guess.
 */
static inline void mend_ends(memory_file *file) {
  unsigned char *header = file->bytes, *trailer = file->bytes + file->size - SF_END_BYTES;
  header[0] = SF_ID_BYTES;
  header[2] = SF_IMAGE_TYPE;
  memcpy(header + 18, sf_magic, sizeof sf_magic);
  memcpy(trailer, sf_end_magic, sizeof sf_end_magic);
  sf_store_64(trailer + 16, file->size);
  memcpy(trailer + 24, header + 30, 4);
  memcpy(trailer + SF_TRAILER_BYTES, sf_footer, SF_FOOTER_BYTES);
}
