/* Earlier places are found by two tables. Filtered rows have few different values, so four equal
 * bytes are found everywhere and say little: the table of eight bytes is searched first, along the
 * chain of all places with that hash. The table of four bytes has the latest place alone, for
 * content that has not repeated at length yet.
 *
 *   latest[hash] --> position --before--> position --before--> ... (within 32 KiB, CHAIN at most)
 */
#include "output/deflate/search.h"

#include <stdbool.h>
#include <string.h>

enum {
  WINDOW = CS_DEFLATE_SEARCH_WINDOW,
  LONGEST = CS_DEFLATE_LONGEST_MATCH,
  SHORTEST = 4,
  REMEMBERED = 64, /* the longest match whose inner places are added to the tables */
  CHAIN = 20,      /* earlier places that are tried */
  CHAIN_LATER = 3, /* places that are tried for a longer match one byte later */
  GOOD = 16,       /* after a match of this length, only one place is tried one byte later */
  LAZY = 32        /* after a match of this length, no place is tried one byte later */
};

/* The places of the history remain in the tables, but their distance shows that they are too
 * old. */
static void drop_history(cs_deflate_search *search) { search->start = search->next = search->end; }

/* The buffer is always filled from its start, so that equal bytes are searched for at equal times.
 * The tables are cleared at the beginning, and before positions could wrap around. */
void cs_deflate_search_begin(cs_deflate_search *search) {
  search->base += (uint32_t)search->end;
  search->end = 0;
  drop_history(search);
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

/* How many of the next bytes, up to `most`, equal the bytes `distance` before them. */
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

/* Estimated bits of a distance, and of a literal that is a filter's difference: differences near 0
 * are common, so their codes are short. */
static inline int distance_bits(size_t distance) {
  return distance <= 8 ? 2 : 3 + (31 - __builtin_clz((unsigned)distance));
}

static inline int literal_bits(unsigned char byte) {
  unsigned size = (unsigned)(byte < 128 ? byte : 256 - byte) + 1;
  return 2 + (31 - __builtin_clz(size)) * 5 / 4;
}

enum { LENGTH_BITS = 7, SURE = 12 };

/* How many bits a match saves compared with literals. A match longer than SURE always saves
 * bits. */
static inline int gain(const unsigned char *at, match found) {
  int bits = -LENGTH_BITS - distance_bits(found.distance);
  for (size_t i = 0; i < found.length; i++)
    bits += literal_bits(at[i]);
  return bits;
}

/* The match with the highest score is the best: the bits of the literals that it replaces, minus
 * the bits of its distance. */
static inline int score(match found) {
  return found.length ? 4 * (int)found.length - distance_bits(found.distance) : 0;
}

/* ---------------------------------------------------------------- places */

static inline uint32_t *latest_of(cs_deflate_search *search, const unsigned char *at) {
  return &search->latest[load_8(at) * 0x9e3779b97f4a7c15u >> (64 - CS_DEFLATE_SEARCH_LONG_BITS)];
}

static inline uint32_t *latest_short_of(cs_deflate_search *search, const unsigned char *at) {
  return &search->latest_short[load_4(at) * 2654435761u >> (32 - CS_DEFLATE_SEARCH_SHORT_BITS)];
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

/* A match with the previous byte, otherwise with the previous pixel; it needs no table. */
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

/* The best of `run` and of matches at the latest places with the same eight bytes. */
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
    if (load_8(at - distance) != word || at[best.length] != (at - distance)[best.length])
      continue;
    match found = {match_length(at, distance, most), distance};
    if (score(found) > score(best))
      best = found;
  }
  return best;
}

/* The better of `best` and a match at the latest place with the same four bytes. */
static inline match find_short(cs_deflate_search *search, const unsigned char *at, size_t history,
                               size_t most, match best) {
  size_t distance = position_of(search, at) - *latest_short_of(search, at);
  if (distance == 0 || distance >= WINDOW || distance > history ||
      load_4(at) != load_4(at - distance))
    return best;
  match found = {match_length(at, distance, most), distance};
  return score(found) > score(best) ? found : best;
}

/* The best match for the bytes from `next` on, out of `chain` earlier places; length 0 if none
 * saves bits. This place is added to the tables. */
static inline match find(cs_deflate_search *search, size_t next, int chain) {
  const unsigned char *at = search->buffer + next;
  size_t left = search->end - next, most = left < LONGEST ? left : LONGEST;
  size_t history = next - search->start;
  if (most < SHORTEST)
    return (match){0, 0};
  match best = find_run(search, at, history, most);
  if (best.length < 8)
    best = find_long(search, at, history, most, chain, best);
  if (best.length < 8)
    best = find_short(search, at, history, most, best);
  remember(search, at);
  if (best.length > 0 && best.length <= SURE && gain(at, best) <= 0)
    return (match){0, 0};
  return best;
}

/* ---------------------------------------------------------------- tokens */

/* Places inside a long match are not added to the tables: they would only replace the starts of
 * runs. remembered: how many places of the match have been added already. */
static inline void remember_match(cs_deflate_search *search, size_t next, size_t remembered,
                                  match found) {
  const unsigned char *at = search->buffer + next, *end = search->buffer + search->end;
  if (found.length <= REMEMBERED)
    for (size_t i = remembered; i < found.length && at + i + SHORTEST <= end; i++)
      remember(search, at + i);
}

/* A near match of full length is continued after its end as a run. Returns the number of bytes that
 * became tokens. */
static inline size_t put_match(cs_deflate_search *search, size_t next, match found) {
  if (found.length < LONGEST || found.distance > CS_DEFLATE_NEAR) {
    cs_deflate_block_match(search->block, found.length, found.distance);
    return found.length;
  }
  size_t most = search->end - next;
  size_t length = match_length(search->buffer + next, found.distance, most);
  cs_deflate_block_run(search->block, length, found.distance);
  return length;
}

/* As long as a longer match begins one byte later, the current byte becomes a literal, and the
 * longer match becomes the best one. Returns how many places of the best match are in the
 * tables. */
static inline size_t defer(cs_deflate_search *search, size_t *next, match *best) {
  while (best->length > 0 && best->length < LAZY) {
    match later = find(search, *next + 1, best->length < GOOD ? CHAIN_LATER : 1);
    if (later.length <= best->length)
      return 2;
    cs_deflate_block_literal(search->block, search->buffer[(*next)++]);
    *best = later;
  }
  return 1;
}

/* Whether the match after a run at `next` can begin with the run, so that both need one token. */
static inline bool takes_run(const cs_deflate_search *search, size_t next, match run, match later) {
  return later.length > 0 && run.length + later.length <= LONGEST &&
         later.distance <= next - search->start &&
         match_length(search->buffer + next, later.distance, run.length) == run.length;
}

/* Puts tokens for the next bytes, for which `best` was found. Returns the best match after them. */
static inline match put_best(cs_deflate_search *search, size_t *next, match best) {
  size_t remembered = defer(search, next, &best);
  if (best.length == 0) {
    cs_deflate_block_literal(search->block, search->buffer[(*next)++]);
    return find(search, *next, CHAIN);
  }
  remember_match(search, *next, remembered, best);
  if (best.distance <= CS_DEFLATE_NEAR && best.length < LONGEST) {
    size_t after = *next + best.length;
    match later = find(search, after, CHAIN);
    if (!takes_run(search, *next, best, later)) {
      *next += put_match(search, *next, best);
      return later;
    }
    remember_match(search, after, 1, later);
    best = (match){best.length + later.length, later.distance};
  }
  *next += put_match(search, *next, best);
  return find(search, *next, CHAIN);
}

/* Words are read beyond the end, so the bytes there are cleared: the result must not depend on
 * their earlier contents. */
static void search_all(cs_deflate_search *search) {
  size_t next = search->next;
  memset(search->buffer + search->end, 0, sizeof(uint64_t));
  match best = find(search, next, CHAIN);
  while (next < search->end)
    best = put_best(search, &next, best);
  search->next = next;
}

static void move_to_front(cs_deflate_search *search) {
  search_all(search);
  if (search->end <= WINDOW)
    return;
  size_t dropped = search->end - WINDOW;
  memmove(search->buffer, search->buffer + dropped, WINDOW);
  search->base += (uint32_t)dropped;
  search->start = search->start > dropped ? search->start - dropped : 0;
  search->next = search->end = WINDOW;
}

unsigned char *cs_deflate_search_space(cs_deflate_search *search) {
  if (WINDOW + CS_DEFLATE_SEARCH_PENDING - search->end < CS_DEFLATE_SEARCH_SPACE)
    move_to_front(search);
  return search->buffer + search->end;
}

void cs_deflate_search_flush(cs_deflate_search *search) {
  if (search->next < search->end)
    search_all(search);
  drop_history(search);
}
