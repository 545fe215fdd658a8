/* Plain bytes to tokens: each place is compared with earlier ones among the last 32 KiB.
 *
 *   buffer   |<---- history, 32 KiB at most ---->|<---- to be searched ---->|<- space ->|slack|
 *            0         start                    next                       end
 *
 * Bytes gather after `end`. When no space is left, all of them become tokens and the last 32 KiB
 * move to the front.
 *
 * INVARIANT: the tokens depend on the bytes since the last cs_deflate_search_begin, and on where
 * among them cs_deflate_search_flush was called; on nothing before.
 */
#pragma once

#include "output/deflate/block.h"

enum {
  CS_DEFLATE_SEARCH_WINDOW = 32768,
  CS_DEFLATE_SEARCH_PENDING = 1 << 17, /* bytes that are collected before they are searched */
  CS_DEFLATE_SEARCH_SPACE = 4096,      /* bytes that may be added at once */
  CS_DEFLATE_SEARCH_SLACK = 64,        /* bytes read or written beyond the end, without meaning */
  CS_DEFLATE_SEARCH_LONG_BITS = 15,    /* bits in the hash of eight bytes */
  CS_DEFLATE_SEARCH_SHORT_BITS = 14    /* bits in the hash of four bytes */
};

/* A position is a count of all bytes ever added, modulo 2^32, from 1 on; 0 in a table means no
 * position. */
typedef struct cs_deflate_search {
  size_t pixel_size;
  cs_deflate_block *block;
  uint32_t base; /* the position of buffer[0] */
  size_t start, next, end;
  /* The latest position of a hash of eight bytes; `before` leads from each position to the one
   * before it with the same hash. For a hash of four bytes, only the latest position. */
  uint32_t latest[1 << CS_DEFLATE_SEARCH_LONG_BITS];
  uint32_t before[CS_DEFLATE_SEARCH_WINDOW];
  uint32_t latest_short[1 << CS_DEFLATE_SEARCH_SHORT_BITS];
  unsigned char
      buffer[CS_DEFLATE_SEARCH_WINDOW + CS_DEFLATE_SEARCH_PENDING + CS_DEFLATE_SEARCH_SLACK];
} cs_deflate_search;

/* Drops all bytes and positions. */
void cs_deflate_search_begin(cs_deflate_search *search);
/* Room for CS_DEFLATE_SEARCH_SPACE bytes and the slack; then cs_deflate_search_commit says how many
 * bytes were written there. */
unsigned char *cs_deflate_search_space(cs_deflate_search *search);
static inline void cs_deflate_search_commit(cs_deflate_search *search, size_t size) {
  search->end += size;
}
/* Makes tokens of all waiting bytes, and drops the history, because tokens from elsewhere may
 * follow. */
void cs_deflate_search_flush(cs_deflate_search *search);
