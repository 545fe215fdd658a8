#include "written.h"

enum { FIRST_SLOTS = 64 }; /* a power of two */

typedef struct slot {
  pf_print print;
  uint64_t offset; /* 0: the slot is free */
} slot;

struct pf_written {
  pf_memory memory;
  slot *slots;
  size_t count, slot_count; /* a power of two, at most half of them in use */
};

/* ---------------------------------------------------------------- prints */

/* The finaliser of SplitMix64. */
static uint64_t mix(uint64_t word) {
  word = (word ^ word >> 30) * 0xbf58476d1ce4e5b9u;
  word = (word ^ word >> 27) * 0x94d049bb133111ebu;
  return word ^ word >> 31;
}

static void add_word(pf_print *print, uint64_t word) {
  print->words[0] = mix(print->words[0] ^ word) + 0x9e3779b97f4a7c15u;
  print->words[1] = mix(print->words[1] + word) ^ print->words[0] >> 1;
}

pf_print pf_print_of(const unsigned char *bytes, size_t size, uint64_t kind) {
  pf_print print = {{kind, ~kind}, size};
  unsigned char last[8] = {0};
  size_t whole = size & ~(size_t)7;
  for (size_t i = 0; i < whole; i += 8)
    add_word(&print, pf_load_64(bytes + i));
  if (size > whole)
    memcpy(last, bytes + whole, size - whole);
  add_word(&print, pf_load_64(last));
  return print;
}

/* ---------------------------------------------------------------- slots */

pf_written *pf_written_create(const pf_memory *memory) {
  pf_written *written = pf_make(memory, sizeof *written, 1);
  if (!written)
    return NULL;
  written->memory = *memory;
  written->slot_count = FIRST_SLOTS;
  written->slots = pf_make(memory, sizeof *written->slots, FIRST_SLOTS);
  if (written->slots)
    return written;
  pf_free(memory, written, sizeof *written, 1);
  return NULL;
}

void pf_written_destroy(pf_written *written) {
  if (!written)
    return;
  pf_memory memory = written->memory;
  pf_free(&memory, written->slots, sizeof *written->slots, written->slot_count);
  pf_free(&memory, written, sizeof *written, 1);
}

/* That of a print, or the free one where it belongs. */
static slot *find_slot(slot *slots, size_t count, const pf_print *print) {
  size_t i = (size_t)print->words[0] & (count - 1);
  while (slots[i].offset && memcmp(&slots[i].print, print, sizeof *print) != 0)
    i = (i + 1) & (count - 1);
  return &slots[i];
}

static bool grow(pf_written *written) {
  size_t count = 2 * written->slot_count;
  slot *slots = pf_make(&written->memory, sizeof *slots, count);
  if (!slots)
    return false;
  for (size_t i = 0; i < written->slot_count; i++)
    if (written->slots[i].offset)
      *find_slot(slots, count, &written->slots[i].print) = written->slots[i];
  pf_free(&written->memory, written->slots, sizeof *slots, written->slot_count);
  written->slots = slots;
  written->slot_count = count;
  return true;
}

bool pf_written_has(const pf_written *written, pf_print print) {
  return find_slot(written->slots, written->slot_count, &print)->offset != 0;
}

uint64_t *pf_written_find(pf_written *written, pf_print print) {
  if (2 * written->count >= written->slot_count && !grow(written))
    return NULL;
  slot *found = find_slot(written->slots, written->slot_count, &print);
  if (found->offset == 0) {
    found->print = print;
    written->count++;
  }
  return &found->offset;
}
