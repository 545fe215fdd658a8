/* The bytes of a plane file, as docs/planefile.md specifies them, and the memory of its readers and
 * writers.
 *
 *   file       header (40) | records of bands ... | record of the index | trailer (32)
 *   of films   header | records of bands and of the indices of frames ... | record of the film |
 *              trailer
 *   a record   kind (1) | size of the payload (4) | payload | checksum (4)
 *
 *   payload of 'B'   top, foot, numbers of chains, pieces, cells, changes, borders (4 each) |
 *                    where cells vary: numbers of steps, axes, stops | code
 *   payload of 'D'   as of 'B'; the code says how the band differs from another one
 *   payload of 'I'   of films: flags (4) | offset of the index of the base, or 0 (8)
 *                    where there are pictures: their number (4) | their offsets (8 each)
 *                    entries: top (4) | offset (8)
 *   payload of 'P'   width, height, kind (4 each) | the key of a named picture (8) | code,
 *                    or its name
 *   payload of 'F'   frames a second (8) | of each frame, the offset of its index (8)
 *
 *   a nest     magic (8) | version, numbers of planes and of windows (4 each) | sizes of the planes
 *              (8 each) | windows: left, top, right, foot (8 each), plane (4) | checksum (4) |
 *              the planes, each a file of its own
 *
 * INVARIANT: all numbers are little endian, whatever the machine.
 */
#pragma once

#include <stdlib.h>
#include <string.h>

#include "planefile.h"

enum {
  PF_HEADER_BYTES = 40,
  PF_TRAILER_BYTES = 32,
  PF_HEAD_BYTES = 5, /* of a record */
  PF_CHECK_BYTES = 4,
  PF_BAND_BYTES = 28,   /* before the code */
  PF_VARIED_BYTES = 12, /* after them, where cells vary */
  PF_ENTRY_BYTES = 12,
  PF_FLAG_BYTES = 12, /* of the index of a frame of a film: flags, and its base */
  PF_LIST_BYTES = 4,  /* of the index: how many pictures there are, before their offsets */
  PF_OFFSET_BYTES = 8,
  PF_PICTURE_BYTES = 20, /* of a picture, before its code */
  PF_RATE_BYTES = 8,
  PF_FRAME_BYTES = 8,
  PF_NEST_BYTES = 20, /* of a nest, before the sizes of its planes */
  PF_SIZE_BYTES = 8,
  PF_WINDOW_BYTES = 36,
  PF_NEST_MOST = 1024,      /* planes of a nest, and windows of it */
  PF_WINDOW_PART = 1 << 20, /* of a side of the frame: no window is smaller than one of them */
  PF_NEST_VERSION = 1,
  PF_VERSION = 2,
  PF_OPAQUE = 1,       /* flags of the header: alpha is 1 everywhere; */
  PF_VARIES = 2,       /* cells may have programs; */
  PF_FILM = 4,         /* it is a film, and the other flags are those of each frame; */
  PF_CODED = 8,        /* flat cells are 8-bit codes; */
  PF_PICTURED = 16,    /* there are pictures */
  PF_PAID = 4,         /* things of a kind that a byte of code pays for */
  PF_VARIED_PAID = 4,  /* bytes of code that pay for a step, an axis or a stop */
  PF_PIXELS_PAID = 16, /* pixels that a byte of code pays for */
  PF_GROUP = 8,        /* changes in a group, at most */
  PF_BAND = 'B',
  PF_CHANGED = 'D',
  PF_INDEX = 'I',
  PF_FRAMES = 'F',
  PF_PICTURE = 'P'
};

static const unsigned char pf_magic[8] = {'c', 'e', 'l', 'p', 'l', 'a', 'n', 'e'};
static const unsigned char pf_nest_magic[8] = {'c', 'e', 'l', 'n', 'e', 's', 't', 's'};
static const unsigned char pf_end_magic[8] = {'p', 'l', 'a', 'n', 'e', 'e', 'n', 'd'};

static inline void pf_store_32(unsigned char *at, uint32_t number) {
  for (int i = 0; i < 4; i++)
    at[i] = (unsigned char)(number >> 8 * i);
}
static inline void pf_store_64(unsigned char *at, uint64_t number) {
  pf_store_32(at, (uint32_t)number);
  pf_store_32(at + 4, (uint32_t)(number >> 32));
}
static inline uint32_t pf_load_32(const unsigned char *at) {
  return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}
static inline uint64_t pf_load_64(const unsigned char *at) {
  return pf_load_32(at) | (uint64_t)pf_load_32(at + 4) << 32;
}
static inline void pf_store_double(unsigned char *at, double number) {
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  pf_store_64(at, bits);
}
static inline double pf_load_double(const unsigned char *at) {
  uint64_t bits = pf_load_64(at);
  double number;
  memcpy(&number, &bits, sizeof number);
  return number;
}

/* CRC-32C, continued from `sum`, which is 0 at the beginning. */
uint32_t pf_crc32c(uint32_t sum, const void *bytes, size_t size);
/* Of a record with its head: that of the record's offset, too, so that it is refused elsewhere. */
uint32_t pf_crc32c_record(uint64_t offset, const void *bytes, size_t size);

/* ---------------------------------------------------------------- memory */

typedef struct pf_memory {
  planefile_resize resize; /* never NULL */
  void *user;
} pf_memory;

pf_memory pf_memory_of(planefile_resize resize, void *user);
/* Returns the block with room for at least `count` things of a size, or NULL: no memory, and the
 * block is as it was. *capacity: in things. */
void *pf_grow(const pf_memory *memory, void *block, size_t size, size_t *capacity, size_t count);
/* New things, all 0; at least one. NULL: no memory. */
void *pf_make(const pf_memory *memory, size_t size, size_t count);
static inline void pf_free(const pf_memory *memory, void *block, size_t size, size_t count) {
  if (block)
    memory->resize(memory->user, block, size * (count > 0 ? count : 1), 0);
}
