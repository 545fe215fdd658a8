#include "layout.h"

/* ---------------------------------------------------------------- checksums */

/* Sums of the 16 values of four bits. */
static const uint32_t sums_of[16] = {
    0x00000000, 0x105ec76f, 0x20bd8ede, 0x30e349b1, 0x417b1dbc, 0x5125dad3, 0x61c69362, 0x7198540d,
    0x82f63b78, 0x92a8fc17, 0xa24bb5a6, 0xb21572c9, 0xc38d26c4, 0xd3d3e1ab, 0xe330a81a, 0xf36e6f75};

uint32_t pf_crc32c(uint32_t sum, const void *bytes, size_t size) {
  const unsigned char *at = bytes;
  sum = ~sum;
  for (size_t i = 0; i < size; i++) {
    sum ^= at[i];
    sum = sum >> 4 ^ sums_of[sum & 15];
    sum = sum >> 4 ^ sums_of[sum & 15];
  }
  return ~sum;
}

uint32_t pf_crc32c_record(uint64_t offset, const void *bytes, size_t size) {
  unsigned char number[8];
  pf_store_64(number, offset);
  return pf_crc32c(pf_crc32c(0, number, sizeof number), bytes, size);
}

/* ---------------------------------------------------------------- memory */

static void *resize_plainly(void *user, void *block, size_t old_size, size_t new_size) {
  (void)user;
  (void)old_size;
  if (new_size > 0)
    return realloc(block, new_size);
  free(block);
  return NULL;
}

pf_memory pf_memory_of(planefile_resize resize, void *user) {
  return (pf_memory){resize ? resize : resize_plainly, user};
}

void *pf_grow(const pf_memory *memory, void *block, size_t size, size_t *capacity, size_t count) {
  if (block && count <= *capacity)
    return block;
  size_t wanted = count + count / 2 + 16;
  if (wanted > SIZE_MAX / 2 / size)
    return NULL;
  void *out = memory->resize(memory->user, block, *capacity * size, wanted * size);
  if (out)
    *capacity = wanted;
  return out;
}

void *pf_make(const pf_memory *memory, size_t size, size_t count) {
  count = count > 0 ? count : 1;
  if (count > SIZE_MAX / 2 / size)
    return NULL;
  void *out = memory->resize(memory->user, NULL, 0, count * size);
  return out ? memset(out, 0, count * size) : NULL;
}
