/* Sets of layers: which are present at a place of a row.
 *
 *     layer      0 ........ 63   64 ...... 127   128 ..... 191
 *     set        [0..101..001]   [00......000]   [1........00]     one bit a layer
 *     filled      1               0               1                one byte a word
 *
 * Beside the bits goes a hash: the keys of the layers present, exclusive-ored. Two keys of 64 bits
 * make it unlikely beyond practice that different sets share one.
 *
 * Invariant: the hash depends on the set alone; a layer that is entered and left again leaves no
 * trace.
 */
#pragma once

#include "engine/compose/layer.h"

typedef struct cs_set_hash {
  uint64_t a, b;
} cs_set_hash;

static inline bool cs_set_hash_same(cs_set_hash p, cs_set_hash q) {
  return p.a == q.a && p.b == q.b;
}

/* How often a layer's boundary winds around the place, and for which winding numbers the layer is
 * present. */
typedef struct cs_presence {
  cs_layer_rule rule;
  int32_t winding;
} cs_presence;

/* Updates the presence of a layer, the set and the set's hash for the crossing of a boundary.
 * direction: of the boundary, +1 or -1, as it is crossed from left to right. */
static inline void cs_set_cross(cs_presence *presences, uint64_t *set, uint8_t *filled,
                                cs_set_hash *hash, uint32_t layer, int32_t direction) {
  cs_presence *presence = &presences[layer];
  const cs_layer_rule *rule = &presence->rule;
  int32_t before = presence->winding, after = before + direction;
  presence->winding = after;
  /* The processor can hardly predict whether the presence changes, so nothing here is a branch. */
  uint64_t flips = ((before & rule->winding_mask) != 0) != ((after & rule->winding_mask) != 0);
  uint64_t word = set[layer / 64] ^ flips << (layer % 64);
  set[layer / 64] = word;
  filled[layer / 64] = word != 0;
  hash->a ^= rule->key[0] & -flips;
  hash->b ^= rule->key[1] & -flips;
}

/* Words of `filled` for a set of `words`: a multiple of eight, so that eight can be read at a
 * time. */
static inline size_t cs_set_filled_count(size_t words) { return (words + 7) / 8 * 8; }

/* Skips groups of eight empty words: the end of the first group at or below `end` that is not
 * empty. end: a multiple of eight. */
static inline uint32_t cs_set_skip(const uint8_t *filled, uint32_t end) {
  uint64_t eight = 0;
  for (; end > 0; end -= 8) {
    memcpy(&eight, filled + end - 8, sizeof eight);
    if (eight != 0)
      break;
  }
  return end;
}

/* The nearest layer of a set that lies below `end`, or CS_STACK_NONE. filled: has a bit for each
 * word of the set that is not 0, at least. */
static inline uint32_t cs_set_below(const uint64_t *set, const uint8_t *filled, uint32_t end) {
  if (end == 0)
    return CS_STACK_NONE;
  uint32_t word = (end - 1) / 64;
  uint64_t bits = set[word] & (~(uint64_t)0 >> (63 - (end - 1) % 64));
  while (bits == 0) {
    if (word == 0)
      return CS_STACK_NONE;
    word = word % 8 == 0 ? cs_set_skip(filled, word) : word;
    bits = word > 0 ? set[--word] : 0;
  }
  return word * 64 + 63 - (uint32_t)__builtin_clzll(bits);
}
