/* Package-merge (Larmore and Hirschberg 1990): level by level, packages of two items of the level
 * before are merged with the leaves; the cheapest 2n - 2 items of the last level say how often each
 * leaf was used, which is its length.
 */
#include "output/huffman.h"

#include <stdbool.h>
#include <string.h>

typedef struct leaves {
  int count;
  uint32_t weight[CS_HUFFMAN_SYMBOLS]; /* ascending */
  int symbol[CS_HUFFMAN_SYMBOLS];
} leaves;

static void sort_leaves(leaves *sorted, const uint32_t *counts, int symbols) {
  sorted->count = 0;
  for (int symbol = 0; symbol < symbols; symbol++) {
    if (counts[symbol] == 0)
      continue;
    int at = sorted->count++;
    for (; at > 0 && sorted->weight[at - 1] > counts[symbol]; at--) {
      sorted->weight[at] = sorted->weight[at - 1];
      sorted->symbol[at] = sorted->symbol[at - 1];
    }
    sorted->weight[at] = counts[symbol];
    sorted->symbol[at] = symbol;
  }
}

typedef struct level {
  int count;
  uint64_t weight[2 * CS_HUFFMAN_SYMBOLS];
  bool is_leaf[2 * CS_HUFFMAN_SYMBOLS];
} level;

static void merge_level(level *next, const level *before, const leaves *sorted) {
  int packages = before->count / 2, package = 0, leaf = 0;
  next->count = sorted->count + packages;
  for (int i = 0; i < next->count; i++) {
    uint64_t pair = package < packages
                        ? before->weight[2 * package] + before->weight[2 * package + 1]
                        : UINT64_MAX;
    next->is_leaf[i] = leaf < sorted->count && sorted->weight[leaf] <= pair;
    next->weight[i] = next->is_leaf[i] ? sorted->weight[leaf++] : pair;
    package += !next->is_leaf[i];
  }
}

void cs_huffman_lengths(const uint32_t *counts, int symbols, int limit, uint8_t *lengths) {
  leaves sorted;
  level levels[CS_HUFFMAN_LIMIT + 1];
  memset(lengths, 0, (size_t)symbols);
  sort_leaves(&sorted, counts, symbols);
  if (sorted.count == 1)
    lengths[sorted.symbol[0]] = 1;
  levels[0].count = 0;
  for (int i = 1; i <= limit; i++)
    merge_level(&levels[i], &levels[i - 1], &sorted);
  int taken = sorted.count > 1 ? 2 * sorted.count - 2 : 0;
  for (int i = limit; i > 0; i--) {
    int leaf = 0;
    for (int item = 0; item < taken; item++)
      if (levels[i].is_leaf[item])
        lengths[sorted.symbol[leaf++]]++;
    taken = 2 * (taken - leaf);
  }
}

void cs_huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes) {
  unsigned code = 0;
  for (int length = 1; length <= CS_HUFFMAN_LIMIT; length++, code <<= 1)
    for (int symbol = 0; symbol < symbols; symbol++) {
      if (lengths[symbol] != length)
        continue;
      unsigned reversed = 0;
      for (int bit = 0; bit < length; bit++)
        reversed |= (code >> bit & 1) << (length - 1 - bit);
      codes[symbol] = (uint16_t)reversed;
      code++;
    }
}
