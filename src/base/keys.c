#include "base/keys.h"

#include <string.h>

#define FEW 32 /* keys that are sorted by insertion */
#define BITS 11
#define PASSES 3 /* over the upper half: 33 bits, of which the last is 0 */
#define DIGITS (1u << BITS)

static inline uint32_t digit_of(uint64_t key, int pass) {
  return (uint32_t)(key >> (32 + BITS * pass)) & (DIGITS - 1);
}

static void sort_few(uint64_t *keys, size_t count) {
  for (size_t i = 1; i < count; i++) {
    uint64_t moved = keys[i];
    size_t hole = i;
    for (; hole > 0 && keys[hole - 1] >> 32 > moved >> 32; hole--)
      keys[hole] = keys[hole - 1];
    keys[hole] = moved;
  }
}

/* Puts the keys into the order of one of their digits; begins: room for all digits. */
static void sort_digit(const uint64_t *from, uint64_t *to, size_t count, int pass, size_t *begins) {
  size_t sum = 0;
  memset(begins, 0, DIGITS * sizeof *begins);
  for (size_t i = 0; i < count; i++)
    begins[digit_of(from[i], pass)]++;
  for (size_t digit = 0; digit < DIGITS; digit++) {
    size_t these = begins[digit];
    begins[digit] = sum;
    sum += these;
  }
  for (size_t i = 0; i < count; i++)
    to[begins[digit_of(from[i], pass)]++] = from[i];
}

celspan_status cs_keys_sort(celspan_context *context, uint64_t *keys, size_t count) {
  uint64_t *room;
  size_t begins[DIGITS];
  if (count <= FEW) {
    sort_few(keys, count);
    return CELSPAN_OK;
  }
  CS_TRY(CS_MAKE(context, room, count));
  for (int pass = 0; pass < PASSES; pass++)
    sort_digit(pass % 2 == 0 ? keys : room, pass % 2 == 0 ? room : keys, count, pass, begins);
  memcpy(keys, room, count * sizeof *keys);
  cs_mem_free(context->memory, room, count * sizeof *room);
  return CELSPAN_OK;
}
