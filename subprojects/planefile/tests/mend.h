/* Corrects the checksums of a file whose bytes were changed, so that the checks behind them are
 * tested.
 */
#pragma once

#include "../src/nest.h"
#include "support.h"

static inline void mend_header(memory_file *file) {
  memcpy(file->bytes, pf_magic, sizeof pf_magic);
  pf_store_32(file->bytes + 8, PF_VERSION);
  pf_store_32(file->bytes + 36, pf_crc32c(0, file->bytes, 36));
}

static inline void mend_trailer(memory_file *file) {
  unsigned char *trailer = file->bytes + file->size - PF_TRAILER_BYTES;
  memcpy(trailer, pf_end_magic, sizeof pf_end_magic);
  pf_store_64(trailer + 16, file->size);
  pf_store_32(trailer + 24, 0);
  pf_store_32(trailer + 28, pf_crc32c(0, trailer, 28));
}

/* The record at an offset, whose length may be anything; returns where its payload is, or 0. */
static inline uint64_t mend_record(memory_file *file, uint64_t offset) {
  uint64_t end = file->size - PF_TRAILER_BYTES;
  if (offset > end || end - offset < PF_HEAD_BYTES + PF_CHECK_BYTES)
    return 0;
  unsigned char *record = file->bytes + offset;
  uint64_t size = PF_HEAD_BYTES + (uint64_t)pf_load_32(record + 1);
  if (size > end - offset - PF_CHECK_BYTES)
    return 0;
  pf_store_32(record + size, pf_crc32c_record(offset, record, (size_t)size));
  return offset + PF_HEAD_BYTES;
}

/* The pictures that an index names; returns the bytes of their list. */
static inline uint64_t mend_pictures(memory_file *file, uint64_t at, uint64_t end) {
  if (at > end || end - at < PF_LIST_BYTES)
    return 0;
  uint64_t count = pf_load_32(file->bytes + at);
  for (uint64_t i = 0; i < count && end - at >= PF_LIST_BYTES + PF_OFFSET_BYTES * (i + 1); i++)
    mend_record(file, pf_load_64(file->bytes + at + PF_LIST_BYTES + PF_OFFSET_BYTES * i));
  return PF_LIST_BYTES + PF_OFFSET_BYTES * count;
}

/* An index, and the bands and pictures that it names. */
static inline void mend_index(memory_file *file, uint64_t index, bool is_film) {
  uint64_t at = mend_record(file, index);
  if (at == 0)
    return;
  uint64_t end = at + pf_load_32(file->bytes + index + 1);
  uint32_t flags = pf_load_32(file->bytes + 12);
  if (is_film) {
    flags = end - at >= PF_FLAG_BYTES ? pf_load_32(file->bytes + at) : 0;
    at += PF_FLAG_BYTES;
  }
  at += flags & PF_PICTURED ? mend_pictures(file, at, end) : 0;
  for (; at <= end && end - at >= PF_ENTRY_BYTES; at += PF_ENTRY_BYTES)
    mend_record(file, pf_load_64(file->bytes + at + 4));
  mend_record(file, index);
}

static inline void mend_film(memory_file *file, uint64_t film) {
  uint64_t at = mend_record(file, film);
  if (at == 0)
    return;
  uint64_t end = at + pf_load_32(file->bytes + film + 1);
  for (at += PF_RATE_BYTES; at <= end && end - at >= PF_FRAME_BYTES; at += PF_FRAME_BYTES)
    mend_index(file, pf_load_64(file->bytes + at), true);
  mend_record(file, film);
}

static inline void mend_sums(memory_file *file);

/* Returns whether the file begins as a nest. All of its bytes become those of its planes. */
static inline bool mend_nest(memory_file *file) {
  size_t head;
  if (file->size < PF_NEST_BYTES || memcmp(file->bytes, pf_nest_magic, 8) != 0)
    return false;
  pf_store_32(file->bytes + 8, PF_NEST_VERSION);
  if (pf_nest_begin(file->bytes, file->size, &head))
    return true;
  size_t left = file->size - head;
  unsigned char *size = file->bytes + PF_NEST_BYTES;
  for (uint32_t i = pf_load_32(file->bytes + 12); i > 0; i--, size += PF_SIZE_BYTES) {
    if (pf_load_64(size) > left || i == 1)
      pf_store_64(size, left);
    memory_file plane = {.bytes = file->bytes + file->size - left,
                         .size = (size_t)pf_load_64(size)};
    mend_sums(&plane);
    left -= plane.size;
  }
  pf_store_32(file->bytes + head - PF_CHECK_BYTES,
              pf_crc32c(0, file->bytes, head - PF_CHECK_BYTES));
  return true;
}

/* All records that are named, header and trailer. */
static inline void mend_sums(memory_file *file) {
  if (mend_nest(file))
    return;
  if (file->size < PF_HEADER_BYTES + PF_TRAILER_BYTES)
    return;
  mend_header(file);
  mend_trailer(file);
  uint64_t last = pf_load_64(file->bytes + file->size - PF_TRAILER_BYTES + 8);
  if (pf_load_32(file->bytes + 12) & PF_FILM)
    mend_film(file, last);
  else
    mend_index(file, last, false);
}
