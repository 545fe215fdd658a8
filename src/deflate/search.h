/* Plain bytes to tokens: what follows is looked up among the last 32 KiB.
 *
 * Invariant: the tokens depend on the bytes since the last cs_deflate_search_begin, and on where
 * among them cs_deflate_search_flush was called, on nothing before.
 */
#ifndef CS_DEFLATE_SEARCH_H
#define CS_DEFLATE_SEARCH_H

#include "deflate/block.h"

enum {
  CS_SEARCH_WINDOW = 32768,
  CS_SEARCH_PENDING = 1 << 17, /* bytes gathered before they are searched */
  CS_SEARCH_PART = 4096,       /* bytes that are given at once, at most */
  CS_SEARCH_SLACK = 64,        /* read or written beyond the end, never used */
  CS_SEARCH_LONG_BITS = 15,
  CS_SEARCH_SHORT_BITS = 14
};

typedef struct cs_deflate_search {
  size_t pixel_size;
  cs_deflate_block_writer *writer;
  /* buffer[start..next) is history, [next..end) waits to be searched; buffer[0] is byte `base` of
   * all that was ever given, modulo 2^32. */
  uint32_t base;
  size_t start, next, end;
  uint32_t latest[1 << CS_SEARCH_LONG_BITS];        /* where eight bytes of a hash were seen last */
  uint32_t before[CS_SEARCH_WINDOW];                /* and where before this place */
  uint32_t latest_short[1 << CS_SEARCH_SHORT_BITS]; /* where four bytes of a hash were */
  unsigned char buffer[CS_SEARCH_WINDOW + CS_SEARCH_PENDING + CS_SEARCH_SLACK];
} cs_deflate_search;

/* All is forgotten. */
void cs_deflate_search_begin(cs_deflate_search *search);
/* Room for CS_SEARCH_PART bytes and the slack, then how many there are. */
unsigned char *cs_deflate_search_space(cs_deflate_search *search);
static inline void cs_deflate_search_take(cs_deflate_search *search, size_t size) {
  search->end += size;
}
/* Makes tokens of all that waits; other tokens may follow, and history is given up. */
void cs_deflate_search_flush(cs_deflate_search *search);

#endif
