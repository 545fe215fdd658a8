/* Huffman's construction over leaves in order of weight; where that makes codes too long,
 * package-merge (Larmore and Hirschberg 1990). Package-merge makes as many lists as the
 * limit: the items of a list, cheapest first, are the leaves and the packages, which are
 * neighbouring pairs of items of the list before. For n leaves, the cheapest 2n - 2 items of the
 * last list are chosen, and with a package the two items in it; a leaf's length is how often it was
 * chosen. For weights 1, 1, 2, 4, 8 and a limit of 3 (Huffman's construction would need 4):
 *
 *   list 1    A1  B1  C2  D4  E8                                    chosen: A B C D
 *               \_/     \_/                                         (in 2 packages)
 *   list 2    A1  B1  C2  AB2  D4  CD6  E8                          chosen: A B C D
 *               \_/     \__/     \_/                                (in 3 packages)
 *   list 3    A1  B1  C2  AB2  D4  CAB4  E8  DCD10                  chosen: A B C D E
 *
 * So A, B, C and D have codes of 3 bits and E one of 1 bit.
 */
#include "output/deflate/huffman.h"

#include <stdbool.h>
#include <string.h>

typedef struct leaves {
  int count;
  uint32_t weight[CS_DEFLATE_HUFFMAN_SYMBOLS]; /* ascending */
  int symbol[CS_DEFLATE_HUFFMAN_SYMBOLS];
} leaves;

/* Merges the sorted halves [from, middle) and [middle, end). */
static void merge_keys(const uint64_t *keys, int from, int middle, int end, uint64_t *out) {
  int left = from, right = middle;
  for (int i = from; i < end; i++)
    out[i] =
        left < middle && (right >= end || keys[left] <= keys[right]) ? keys[left++] : keys[right++];
}

/* Leaves of equal weight are in the order of their symbols. A merge sort is used, because the order
 * must not depend on a library. */
static void sort_leaves(leaves *sorted, const uint32_t *counts, int symbols) {
  uint64_t keys[2][CS_DEFLATE_HUFFMAN_SYMBOLS], *from = keys[0], *to = keys[1];
  int count = 0;
  for (int symbol = 0; symbol < symbols; symbol++)
    if (counts[symbol] > 0)
      from[count++] = (uint64_t)counts[symbol] << 16 | (unsigned)symbol;
  for (int width = 1; width < count; width *= 2) {
    for (int at = 0; at < count; at += 2 * width) {
      int middle = at + width < count ? at + width : count;
      merge_keys(from, at, middle, middle + width < count ? middle + width : count, to);
    }
    uint64_t *swapped = from;
    from = to;
    to = swapped;
  }
  sorted->count = count;
  for (int i = 0; i < count; i++) {
    sorted->weight[i] = (uint32_t)(from[i] >> 16);
    sorted->symbol[i] = (int)(from[i] & 0xffff);
  }
}

/* Huffman's construction with two queues: both the leaves and the inner nodes are in order of
 * weight, so the two lightest nodes are always at the two fronts. depths: by leaf. Returns the
 * greatest one. */
static int huffman_depths(const leaves *sorted, uint8_t *depths) {
  uint64_t weight[2 * CS_DEFLATE_HUFFMAN_SYMBOLS];
  int parent[2 * CS_DEFLATE_HUFFMAN_SYMBOLS], count = sorted->count, deepest = 0;
  uint8_t depth[2 * CS_DEFLATE_HUFFMAN_SYMBOLS];
  for (int i = 0; i < count; i++)
    weight[i] = sorted->weight[i];
  for (int made = count, leaf = 0, node = count; made < 2 * count - 1; made++) {
    weight[made] = 0;
    for (int pick = 0; pick < 2; pick++) {
      bool is_leaf = leaf < count && (node >= made || weight[leaf] <= weight[node]);
      int chosen = is_leaf ? leaf++ : node++;
      weight[made] += weight[chosen];
      parent[chosen] = made;
    }
  }
  depth[2 * count - 2] = 0;
  for (int i = 2 * count - 3; i >= 0; i--) {
    int below = depth[parent[i]] + 1;
    depth[i] = (uint8_t)(below < 255 ? below : 255);
    deepest = below > deepest ? below : deepest;
  }
  memcpy(depths, depth, (size_t)count);
  return deepest;
}

typedef struct package_list {
  int count;
  uint64_t weight[2 * CS_DEFLATE_HUFFMAN_SYMBOLS];
  bool is_leaf[2 * CS_DEFLATE_HUFFMAN_SYMBOLS];
} package_list;

static void merge_list(package_list *next, const package_list *before, const leaves *sorted) {
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

static void package_merge(const leaves *sorted, int limit, uint8_t *lengths) {
  package_list lists[CS_DEFLATE_HUFFMAN_LIMIT + 1];
  lists[0].count = 0;
  for (int i = 1; i <= limit; i++)
    merge_list(&lists[i], &lists[i - 1], sorted);
  int chosen = 2 * sorted->count - 2;
  for (int i = limit; i > 0; i--) {
    int leaf = 0;
    for (int item = 0; item < chosen; item++)
      if (lists[i].is_leaf[item])
        lengths[sorted->symbol[leaf++]]++;
    chosen = 2 * (chosen - leaf);
  }
}

void cs_deflate_huffman_lengths(const uint32_t *counts, int symbols, int limit, uint8_t *lengths) {
  leaves sorted;
  uint8_t depths[CS_DEFLATE_HUFFMAN_SYMBOLS];
  memset(lengths, 0, (size_t)symbols);
  sort_leaves(&sorted, counts, symbols);
  if (sorted.count == 1)
    lengths[sorted.symbol[0]] = 1;
  if (sorted.count < 2)
    return;
  if (huffman_depths(&sorted, depths) > limit)
    package_merge(&sorted, limit, lengths);
  else
    for (int i = 0; i < sorted.count; i++)
      lengths[sorted.symbol[i]] = depths[i];
}

static uint16_t reverse_bits(unsigned code, int length) {
  unsigned reversed = 0;
  for (int bit = 0; bit < length; bit++)
    reversed |= (code >> bit & 1) << (length - 1 - bit);
  return (uint16_t)reversed;
}

void cs_deflate_huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes) {
  unsigned next[CS_DEFLATE_HUFFMAN_LIMIT + 1], count[CS_DEFLATE_HUFFMAN_LIMIT + 1] = {0}, code = 0;
  for (int symbol = 0; symbol < symbols; symbol++)
    count[lengths[symbol]]++;
  for (int length = 1; length <= CS_DEFLATE_HUFFMAN_LIMIT; length++) {
    next[length] = code;
    code = (code + count[length]) << 1;
  }
  for (int symbol = 0; symbol < symbols; symbol++)
    if (lengths[symbol] > 0)
      codes[symbol] = reverse_bits(next[lengths[symbol]]++, lengths[symbol]);
}
