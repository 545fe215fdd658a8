/* Growing memory, and a row while it is put together.
 *
 *   spans     | end 5, run p | end 9, raw | end 40, gradient | ...
 *   values    |  4 raw pixels |  2 pixels  | ...             only of raw and gradient spans
 *
 * INVARIANT: `spans` and `values` are as spanfile_row describes, up to the end of the last span.
 */
#pragma once

#include "layout.h"

typedef struct sf_memory {
  spanfile_resize resize;
  void *user;
} sf_memory;

/* resize: NULL for the C library's. */
sf_memory sf_memory_of(spanfile_resize resize, void *user);
void *sf_allocate(const sf_memory *memory, size_t size);
void sf_release(const sf_memory *memory, void *block, size_t size);

typedef struct sf_bytes {
  unsigned char *at;
  size_t size, capacity;
} sf_bytes;

/* Room for `more` bytes after the size; false: no memory, and nothing changed. */
bool sf_bytes_grow(const sf_memory *memory, sf_bytes *bytes, size_t more);
static inline bool sf_bytes_room(const sf_memory *memory, sf_bytes *bytes, size_t more) {
  return more <= bytes->capacity - bytes->size || sf_bytes_grow(memory, bytes, more);
}
static inline bool sf_bytes_add(const sf_memory *memory, sf_bytes *bytes, const void *more,
                                size_t size) {
  if (!sf_bytes_room(memory, bytes, size))
    return false;
  if (size > 0)
    memcpy(bytes->at + bytes->size, more, size);
  bytes->size += size;
  return true;
}
/* Their start; never NULL, so that 0 may be added to it when there are none. */
static inline const unsigned char *sf_bytes_start(const sf_bytes *bytes) {
  return bytes->at ? bytes->at : (const unsigned char *)"";
}
void sf_bytes_free(const sf_memory *memory, sf_bytes *bytes);

typedef struct sf_row {
  spanfile_span *spans;
  size_t count, capacity;
  sf_bytes values;
} sf_row;

static inline uint32_t sf_row_end(const sf_row *row) {
  return row->count ? row->spans[row->count - 1].end : 0;
}
bool sf_row_grow(const sf_memory *memory, sf_row *row);
/* Appends a span; one that continues the last span is joined with it. The values of raw and
 * gradient spans are appended to `values` by the caller. */
static inline bool sf_row_add(const sf_memory *memory, sf_row *row, uint32_t count, uint32_t kind,
                              uint64_t pixel) {
  uint32_t end = sf_row_end(row) + count;
  if (row->count && kind != SPANFILE_GRADIENT) {
    spanfile_span *last = &row->spans[row->count - 1];
    if (last->kind == kind && last->pixel == pixel) {
      last->end = end;
      return true;
    }
  }
  if (row->count == row->capacity && !sf_row_grow(memory, row))
    return false;
  row->spans[row->count++] = (spanfile_span){end, kind, pixel};
  return true;
}
void sf_row_clear(sf_row *row);
void sf_row_free(const sf_memory *memory, sf_row *row);
