/* Two tables of places: of eight bytes, with all earlier places of a hash in a chain, because what
 * filters leave is made of few values and four bytes of it are everywhere; and of four bytes, the
 * latest place alone, for what is new.
 */
#include "deflate/search.h"

#include <string.h>

enum {
  WINDOW = CS_SEARCH_WINDOW,
  LONGEST = CS_BLOCK_LONGEST,
  SHORTEST = 4,
  REMEMBERED = 64, /* the longest match whose inner places are remembered */
  CHAIN = 10,      /* earlier places looked at */
  CHAIN_LATER = 3, /* those for a better match a byte later */
  GOOD = 16,       /* a match that is hardly bettered: one place is looked at */
  LAZY = 32        /* one that is not tried to be */
};

/* Places remembered from history that was given up are told by their distance. */
static void forget(cs_deflate_search *search) { search->start = search->next = search->end; }

/* The buffer is filled from its start again, so that it is searched in the same pieces. What is
 * remembered is cleared before the count of bytes comes round; 0 is where nothing was. */
void cs_deflate_search_begin(cs_deflate_search *search) {
  search->base += (uint32_t)search->end;
  search->end = 0;
  forget(search);
  if (search->base != 0 && search->base <= UINT32_MAX / 2)
    return;
  memset(search->latest, 0, sizeof search->latest);
  memset(search->latest_short, 0, sizeof search->latest_short);
  search->base = 1;
}

/* ---------------------------------------------------------------- matches */

static inline uint32_t load_4(const unsigned char *at) {
  uint32_t word;
  memcpy(&word, at, sizeof word);
  return word;
}

static inline uint64_t load_8(const unsigned char *at) {
  uint64_t word;
  memcpy(&word, at, sizeof word);
  return word;
}

/* How many of the next bytes, `most` at most, equal those `distance` before. */
static inline size_t match_length(const unsigned char *at, size_t distance, size_t most) {
  for (size_t length = 0; length < most; length += 8) {
    uint64_t difference = load_8(at + length) ^ load_8(at + length - distance);
    if (difference != 0) {
      length += (size_t)__builtin_ctzll(difference) / 8;
      return length < most ? length : most;
    }
  }
  return most;
}

typedef struct match {
  size_t length, distance;
} match;

/* About the bits that a match costs beyond its length's, and those of literals of residues: small
 * ones are common. */
static inline int distance_bits(size_t distance) {
  return distance <= 8 ? 2 : 3 + (31 - __builtin_clz((unsigned)distance));
}

static inline int literal_bits(unsigned char byte) {
  unsigned size = (unsigned)(byte < 128 ? byte : 256 - byte) + 1;
  return 2 + (31 - __builtin_clz(size)) * 5 / 4;
}

enum { LENGTH_BITS = 7, SURE = 12 };

/* Bits won over literals by a match that is not longer than SURE; longer ones always win. */
static inline int gain(const unsigned char *at, match found) {
  int bits = -LENGTH_BITS - distance_bits(found.distance);
  for (size_t i = 0; i < found.length; i++)
    bits += literal_bits(at[i]);
  return bits;
}

/* What decides between matches of a place: bits of the literals spared, less those of the distance.
 */
static inline int score(match found) {
  return found.length ? 4 * (int)found.length - distance_bits(found.distance) : 0;
}

/* ---------------------------------------------------------------- places */

static inline uint32_t *latest_of(cs_deflate_search *search, const unsigned char *at) {
  return &search->latest[load_8(at) * 0x9e3779b97f4a7c15u >> (64 - CS_SEARCH_LONG_BITS)];
}

static inline uint32_t *latest_short_of(cs_deflate_search *search, const unsigned char *at) {
  return &search->latest_short[load_4(at) * 2654435761u >> (32 - CS_SEARCH_SHORT_BITS)];
}

static inline uint32_t position_of(const cs_deflate_search *search, const unsigned char *at) {
  return search->base + (uint32_t)(at - search->buffer);
}

static inline void remember(cs_deflate_search *search, const unsigned char *at) {
  uint32_t *latest = latest_of(search, at), position = position_of(search, at);
  search->before[position % WINDOW] = *latest;
  *latest = position;
  *latest_short_of(search, at) = position;
}

/* Equal bytes, or else equal pixels. */
static inline match find_run(const cs_deflate_search *search, const unsigned char *at,
                             size_t history, size_t most) {
  uint32_t word = load_4(at);
  if (history >= 1 && word == load_4(at - 1))
    return (match){match_length(at, 1, most), 1};
  size_t size = search->pixel_size;
  if (history >= size && word == load_4(at - size))
    return (match){match_length(at, size, most), size};
  return (match){0, 0};
}

/* The best of `run` and of the latest places where the next eight bytes stood. */
static inline match find_long(cs_deflate_search *search, const unsigned char *at, size_t history,
                              size_t most, int chain, match run) {
  match best = run;
  uint64_t word = load_8(at);
  uint32_t position = position_of(search, at), place = *latest_of(search, at);
  size_t last_distance = 0;
  for (int i = 0; i < chain && best.length < most; i++, place = search->before[place % WINDOW]) {
    size_t distance = position - place;
    if (distance <= last_distance || distance >= WINDOW || distance > history)
      break;
    last_distance = distance;
    if (load_8(at - distance) != word || at[best.length] != at[best.length - distance])
      continue;
    match found = {match_length(at, distance, most), distance};
    if (score(found) > score(best))
      best = found;
  }
  return best;
}

/* The best of `best` and the latest place where the next four bytes stood. */
static inline match find_short(cs_deflate_search *search, const unsigned char *at, size_t history,
                               size_t most, match best) {
  size_t distance = position_of(search, at) - *latest_short_of(search, at);
  if (distance == 0 || distance >= WINDOW || distance > history ||
      load_4(at) != load_4(at - distance))
    return best;
  match found = {match_length(at, distance, most), distance};
  return score(found) > score(best) ? found : best;
}

/* A match for what follows, or one of length 0, out of `chain` earlier places; the place is
 * remembered. */
static inline match find(cs_deflate_search *search, size_t next, int chain) {
  const unsigned char *at = search->buffer + next;
  size_t left = search->end - next, most = left < LONGEST ? left : LONGEST;
  size_t history = next - search->start;
  if (most < SHORTEST)
    return (match){0, 0};
  match best = find_run(search, at, history, most);
  best = find_long(search, at, history, most, chain, best);
  if (best.length < 8)
    best = find_short(search, at, history, most, best);
  remember(search, at);
  if (best.length > 0 && best.length <= SURE && gain(at, best) <= 0)
    return (match){0, 0};
  return best;
}

/* ---------------------------------------------------------------- tokens */

/* The places inside long matches are left out: they only push out the starts of flat runs.
 * remembered: how many of its places are already. */
static inline void remember_match(cs_deflate_search *search, size_t next, size_t remembered,
                                  match found) {
  const unsigned char *at = search->buffer + next, *end = search->buffer + search->end;
  if (found.length <= REMEMBERED)
    for (size_t i = remembered; i < found.length && at + i + SHORTEST <= end; i++)
      remember(search, at + i);
}

/* Runs longer than a match go on as long as they do. The bytes told. */
static inline size_t put_match(cs_deflate_search *search, size_t next, match found) {
  if (found.length < LONGEST || found.distance > CS_BLOCK_NEAR) {
    cs_deflate_block_match(search->writer, found.length, found.distance);
    return found.length;
  }
  size_t most = search->end - next;
  size_t length = match_length(search->buffer + next, found.distance, most);
  cs_deflate_block_run(search->writer, length, found.distance);
  return length;
}

/* A short match gives way to a longer one a byte later. Words are read across the end: what is
 * there must not tell what the buffer held before. */
static void search_all(cs_deflate_search *search) {
  size_t next = search->next, end = search->end;
  memset(search->buffer + end, 0, sizeof(uint64_t));
  while (next < end) {
    match best = find(search, next, CHAIN);
    size_t remembered = 1;
    while (best.length > 0 && best.length < LAZY && next + 1 < end) {
      match later = find(search, next + 1, best.length < GOOD ? CHAIN_LATER : 1);
      remembered = 2;
      if (later.length <= best.length)
        break;
      cs_deflate_block_literal(search->writer, search->buffer[next++]);
      best = later;
      remembered = 1;
    }
    if (best.length == 0) {
      cs_deflate_block_literal(search->writer, search->buffer[next++]);
    } else {
      remember_match(search, next, remembered, best);
      next += put_match(search, next, best);
    }
  }
  search->next = next;
}

/* Searches what waits and moves the last 32 KiB to the front. */
static void slide(cs_deflate_search *search) {
  search_all(search);
  if (search->end <= WINDOW)
    return;
  size_t gone = search->end - WINDOW;
  memmove(search->buffer, search->buffer + gone, WINDOW);
  search->base += (uint32_t)gone;
  search->start = search->start > gone ? search->start - gone : 0;
  search->next = search->end = WINDOW;
}

unsigned char *cs_deflate_search_space(cs_deflate_search *search) {
  if (WINDOW + CS_SEARCH_PENDING - search->end < CS_SEARCH_PART)
    slide(search);
  return search->buffer + search->end;
}

void cs_deflate_search_flush(cs_deflate_search *search) {
  if (search->next < search->end)
    search_all(search);
  forget(search);
}
