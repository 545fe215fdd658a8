#include "base/keys.h"

#include <string.h>

#define FEW 32 /* keys that are sorted by insertion */
#define BITS 11
#define PASSES 3 /* passes over the upper half: 33 bits, the last of which is 0 */
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

/* Sorts the keys by one of their digits. counts: how many keys have each digit. */
static void sort_digit(const uint64_t *from, uint64_t *to, size_t count, int pass,
                       uint32_t *counts) {
  uint32_t sum = 0;
  for (size_t digit = 0; digit < DIGITS; digit++) {
    uint32_t these = counts[digit];
    counts[digit] = sum;
    sum += these;
  }
  for (size_t i = 0; i < count; i++)
    to[counts[digit_of(from[i], pass)]++] = from[i];
}

/* Sorts with `room` for as many keys. A digit that all keys have in common needs no pass. */
static void sort_many(uint64_t *keys, uint64_t *room, size_t count) {
  uint32_t counts[PASSES][DIGITS] = {{0}}; /* numbers of things have 32 bits, too */
  uint64_t *from = keys, *to = room;
  for (size_t i = 0; i < count; i++)
    for (int pass = 0; pass < PASSES; pass++)
      counts[pass][digit_of(keys[i], pass)]++;
  for (int pass = 0; pass < PASSES; pass++) {
    if (counts[pass][digit_of(keys[0], pass)] == count)
      continue;
    sort_digit(from, to, count, pass, counts[pass]);
    uint64_t *sorted = to;
    to = from;
    from = sorted;
  }
  if (from != keys)
    memcpy(keys, from, count * sizeof *keys);
}

celspan_status cs_keys_sort(celspan_context *context, uint64_t *keys, size_t count) {
  if (count <= FEW) {
    sort_few(keys, count);
    return CELSPAN_OK;
  }
  uint64_t *room = cs_mem_resize(context->memory, NULL, 0, count * sizeof *room);
  if (!room)
    return cs_fail_memory(context);
  sort_many(keys, room, count);
  cs_mem_free(context->memory, room, count * sizeof *room);
  return CELSPAN_OK;
}
