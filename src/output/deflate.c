#include "output/deflate.h"

#include <string.h>
#include <zlib.h>

enum {
  WINDOW = 32768,
  PENDING = 1 << 16, /* bytes gathered before they are searched */
  SLACK = 16,        /* read or written beyond the end, never used */
  LONGEST = CS_TOKEN_LONGEST,
  SHORTEST = 4,
  REMEMBERED = 32, /* the longest match whose inner places are remembered */
  CHAIN = 40,      /* earlier places looked at */
  GOOD = 16,       /* a match that is hardly bettered a byte later */
  LAZY = 200,      /* one that is not tried to be */
  HASH_BITS = 15,
  BLOCK_TOKENS = 1 << 16,
  ADLER_BASE = 65521
};

struct cs_deflate {
  size_t pixel_size;
  uint64_t adler_a, adler_b; /* not reduced; see reduce_adler */
  /* buffer[start..next) is history, [next..end) waits to be searched; buffer[0] is byte `base` of
   * the stream, modulo 2^32. */
  uint32_t base;
  size_t start, next, end;
  uint64_t size;      /* bytes of the part so far */
  size_t zeros;       /* of a run, not yet tokens: more may follow */
  bool ends_in_zeros; /* the last token but for them */
  size_t token_count;
  uint32_t latest[1 << HASH_BITS]; /* where four bytes of a hash were seen last */
  uint32_t before[WINDOW];         /* and where before this place, modulo the window */
  cs_token tokens[BLOCK_TOKENS];
  unsigned char buffer[WINDOW + PENDING + SLACK];
  cs_block_writer writer;
};

celspan_status cs_deflate_create(celspan_context *context, size_t pixel_size, cs_block_write write,
                                 void *user, cs_deflate **out) {
  cs_deflate *deflate = cs_mem_array(context->memory, 1, sizeof *deflate);
  if (!deflate)
    return cs_fail_memory(context);
  deflate->pixel_size = pixel_size;
  deflate->writer.write = write;
  deflate->writer.user = user;
  *out = deflate;
  return CELSPAN_OK;
}

void cs_deflate_destroy(cs_deflate *deflate, celspan_context *context) {
  if (deflate)
    cs_mem_free(context->memory, deflate, sizeof *deflate);
}

/* History is given up; places remembered from it are told by their distance. */
static void forget(cs_deflate *deflate) { deflate->start = deflate->next = deflate->end; }

/* The buffer is filled from its start again, so that it is searched in the same pieces. What is
 * remembered is cleared before the count of bytes comes round; 0 is where nothing was. */
void cs_deflate_begin(cs_deflate *deflate) {
  cs_block_writer *writer = &deflate->writer;
  deflate->base += (uint32_t)deflate->end;
  deflate->end = 0;
  forget(deflate);
  if (deflate->base == 0 || deflate->base > UINT32_MAX / 2) {
    memset(deflate->latest, 0, sizeof deflate->latest);
    deflate->base = 1;
  }
  deflate->adler_a = 1;
  deflate->adler_b = 0;
  deflate->size = deflate->zeros = deflate->token_count = 0;
  deflate->ends_in_zeros = false;
  writer->status = CELSPAN_OK;
  writer->bits = 0;
  writer->bit_count = 0;
  writer->size = 0;
}

/* ---------------------------------------------------------------- checksum */

static void reduce_adler(cs_deflate *deflate) {
  deflate->adler_a %= ADLER_BASE;
  deflate->adler_b %= ADLER_BASE;
}

static void adler_bytes(cs_deflate *deflate, const unsigned char *bytes, size_t size) {
  reduce_adler(deflate);
  uLong sum = deflate->adler_b << 16 | deflate->adler_a;
  sum = adler32_z(sum, bytes, size);
  deflate->adler_a = sum & 0xffff;
  deflate->adler_b = sum >> 16;
}

/* n pixels of s bytes p[0..s): a grows by n S, S the sum of the bytes; b by n s a and, since byte j
 * of pixel i counts once for itself and each byte after it, by S s n (n + 1)/2 - n sum(j p[j]).
 * Held to 2^20 pixels and reduced in time, nothing passes 2^63. */
static inline void adler_run(cs_deflate *deflate, uint64_t pixel, uint64_t count, uint64_t size) {
  if (((deflate->adler_a | deflate->adler_b >> 24) >> 32) != 0)
    reduce_adler(deflate);
  deflate->adler_b += count * size * deflate->adler_a;
  if (pixel == 0)
    return;
  /* In lanes of 16 bits: bytes 0, 2, 4, 6 and bytes 1, 3, 5, 7; a product gathers its lanes, times
   * 1 or times their number, in the highest. */
  const uint64_t lanes = 0x00ff00ff00ff00ffu, ones = 0x0001000100010001u;
  uint64_t odd = pixel >> 8 & lanes, both = (pixel & lanes) + odd;
  uint64_t sum = both * ones >> 48;
  uint64_t weighted = 2 * (both * 0x0000000100020003u >> 48) + (odd * ones >> 48);
  deflate->adler_a += count * sum;
  deflate->adler_b += sum * size * (count * (count + 1) / 2) - count * weighted;
}

/* ---------------------------------------------------------------- tokens */

static inline void put_token(cs_deflate *deflate, cs_token token) {
  deflate->tokens[deflate->token_count++] = token;
  if (deflate->token_count == BLOCK_TOKENS) {
    cs_block_put(&deflate->writer, deflate->tokens, BLOCK_TOKENS, false);
    deflate->token_count = 0;
  }
}

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

/* Equal bytes, or else equal pixels. */
static inline match find_run(const cs_deflate *deflate, const unsigned char *at, size_t history,
                             size_t most) {
  uint32_t word = load_4(at);
  if (history >= 1 && word == load_4(at - 1))
    return (match){match_length(at, 1, most), 1};
  size_t size = deflate->pixel_size;
  if (history >= size && word == load_4(at - size))
    return (match){match_length(at, size, most), size};
  return (match){0, 0};
}

static inline uint32_t *latest_of(cs_deflate *deflate, uint32_t word) {
  return &deflate->latest[word * 2654435761u >> (32 - HASH_BITS)];
}

static inline uint32_t position_of(const cs_deflate *deflate, const unsigned char *at) {
  return deflate->base + (uint32_t)(at - deflate->buffer);
}

static inline void remember(cs_deflate *deflate, const unsigned char *at) {
  uint32_t *latest = latest_of(deflate, load_4(at)), position = position_of(deflate, at);
  deflate->before[position % WINDOW] = *latest;
  *latest = position;
}

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

/* The best of `run` and of the latest places where the next four bytes stood. */
static inline match find_earlier(cs_deflate *deflate, const unsigned char *at, size_t history,
                                 size_t most, int chain, match run) {
  match best = run;
  uint32_t word = load_4(at), position = position_of(deflate, at);
  uint32_t place = *latest_of(deflate, word);
  size_t last_distance = 0;
  for (int i = 0; i < chain && best.length < most; i++, place = deflate->before[place % WINDOW]) {
    size_t distance = position - place;
    if (distance <= last_distance || distance >= WINDOW || distance > history)
      break;
    last_distance = distance;
    if (load_4(at - distance) != word || at[best.length] != at[best.length - distance])
      continue;
    match found = {match_length(at, distance, most), distance};
    if (score(found) > score(best))
      best = found;
  }
  return best;
}

/* A match for what follows, or one of length 0, out of `chain` earlier places; the place is
 * remembered. */
static match find(cs_deflate *deflate, size_t next, int chain) {
  const unsigned char *at = deflate->buffer + next;
  size_t left = deflate->end - next, most = left < LONGEST ? left : LONGEST;
  size_t history = next - deflate->start;
  if (most < SHORTEST)
    return (match){0, 0};
  match run = find_run(deflate, at, history, most);
  match best = find_earlier(deflate, at, history, most, chain, run);
  remember(deflate, at);
  if (best.length > 0 && best.length <= SURE && gain(at, best) <= 0)
    return (match){0, 0};
  return best;
}

/* The places inside short matches are worth remembering in photographs; those inside long ones only
 * push out the starts of flat runs. remembered: how many of its places are already. */
static inline void put_match(cs_deflate *deflate, const unsigned char *at, size_t remembered,
                             match found) {
  const unsigned char *end = deflate->buffer + deflate->end;
  put_token(deflate, cs_token_match(found.length, found.distance));
  if (found.length <= REMEMBERED && found.distance > deflate->pixel_size)
    for (size_t i = remembered; i < found.length && at + i + SHORTEST <= end; i++)
      remember(deflate, at + i);
}

/* Makes tokens of all that waits; a short match gives way to a longer one a byte later. */
static void search(cs_deflate *deflate) {
  size_t next = deflate->next, end = deflate->end;
  while (next < end) {
    match best = find(deflate, next, CHAIN);
    size_t remembered = 1;
    while (best.length > 0 && best.length < LAZY && next + 1 < end) {
      match later = find(deflate, next + 1, best.length < GOOD ? CHAIN : CHAIN / 8);
      remembered = 2;
      if (later.length <= best.length)
        break;
      put_token(deflate, deflate->buffer[next++]);
      best = later;
      remembered = 1;
    }
    if (best.length == 0)
      put_token(deflate, deflate->buffer[next]);
    else
      put_match(deflate, deflate->buffer + next, remembered, best);
    next += best.length == 0 ? 1 : best.length;
  }
  deflate->next = next;
}

/* Searches what waits and moves the last 32 KiB to the front. */
static void slide(cs_deflate *deflate) {
  search(deflate);
  if (deflate->end <= WINDOW)
    return;
  size_t gone = deflate->end - WINDOW;
  memmove(deflate->buffer, deflate->buffer + gone, WINDOW);
  deflate->base += (uint32_t)gone;
  deflate->start = deflate->start > gone ? deflate->start - gone : 0;
  deflate->next = deflate->end = WINDOW;
}

static size_t room(const cs_deflate *deflate) { return WINDOW + PENDING - deflate->end; }

/* ---------------------------------------------------------------- runs */

static inline void put_matches(cs_deflate *deflate, size_t bytes, size_t distance) {
  size_t times = (bytes - 3) / LONGEST, rest = bytes - times * LONGEST;
  for (; times > CS_TOKEN_TIMES; times -= CS_TOKEN_TIMES + 1)
    put_token(deflate, cs_token_run(CS_TOKEN_TIMES, LONGEST, distance));
  if (rest <= LONGEST) {
    put_token(deflate, cs_token_run(times, rest, distance));
  } else { /* what is left must not be shorter than a match */
    put_token(deflate, cs_token_run(times, rest - 3, distance));
    put_token(deflate, cs_token_match(3, distance));
  }
}

static void put_zeros(cs_deflate *deflate) {
  size_t count = deflate->zeros;
  deflate->zeros = 0;
  if (count > 0 && !(deflate->ends_in_zeros && count >= 3)) {
    put_token(deflate, 0);
    count--;
  }
  if (count >= 3)
    put_matches(deflate, count, 1);
  else
    for (; count > 0; count--)
      put_token(deflate, 0);
}

static inline void put_byte(cs_deflate *deflate, unsigned char byte) {
  if (byte == 0) {
    deflate->zeros++;
    return;
  }
  if (deflate->zeros > 0)
    put_zeros(deflate);
  put_token(deflate, byte);
  deflate->ends_in_zeros = false;
}

/* The usual pixel begins with three bytes that are not 0. */
static inline void put_pixel(cs_deflate *deflate, uint64_t pixel, size_t size) {
  size_t i = 0;
  if (size >= 3 && pixel & 0xff && pixel & 0xff00 && pixel & 0xff0000) {
    if (deflate->zeros > 0)
      put_zeros(deflate);
    put_token(deflate, cs_token_triple((uint32_t)pixel & 0xffffff));
    deflate->ends_in_zeros = false;
    i = 3;
  }
  for (; i < size; i++)
    put_byte(deflate, (unsigned char)(pixel >> 8 * i));
}

static inline void put_run(cs_deflate *deflate, cs_deflate_run run, size_t size) {
  uint64_t pixel = run.pixel;
  put_pixel(deflate, pixel, size);
  size_t bytes = (run.count - 1) * size;
  if (bytes >= 3) {
    put_zeros(deflate);
    put_matches(deflate, bytes, size);
    deflate->ends_in_zeros = pixel >> 8 * (size - 1) == 0;
  } else {
    for (size_t i = 0; i < bytes; i++)
      put_byte(deflate, (unsigned char)(pixel >> 8 * (i % size)));
  }
}

/* size: of a pixel, known to the compiler for the usual ones. */
static inline void put_runs(cs_deflate *deflate, const cs_deflate_run *run, size_t run_count,
                            size_t size) {
  for (const cs_deflate_run *end = run + run_count; run < end; run++) {
    adler_run(deflate, run->pixel, run->count, size);
    deflate->size += run->count * size;
    if (run->pixel == 0)
      deflate->zeros += run->count * size;
    else
      put_run(deflate, *run, size);
  }
}

celspan_status cs_deflate_runs(cs_deflate *deflate, celspan_context *context,
                               const cs_deflate_run *runs, size_t run_count) {
  deflate->writer.context = context;
  if (deflate->next < deflate->end)
    search(deflate);
  if (deflate->pixel_size == 3)
    put_runs(deflate, runs, run_count, 3);
  else if (deflate->pixel_size == 4)
    put_runs(deflate, runs, run_count, 4);
  else
    put_runs(deflate, runs, run_count, deflate->pixel_size);
  forget(deflate);
  return deflate->writer.status;
}

void cs_deflate_byte(cs_deflate *deflate, unsigned char byte) {
  if (deflate->next < deflate->end)
    search(deflate);
  deflate->adler_a += byte;
  deflate->adler_b += deflate->adler_a;
  deflate->size++;
  put_byte(deflate, byte);
  forget(deflate);
}

/* ---------------------------------------------------------------- bytes */

celspan_status cs_deflate_bytes(cs_deflate *deflate, celspan_context *context, const void *bytes,
                                size_t size) {
  const unsigned char *from = bytes;
  deflate->writer.context = context;
  put_zeros(deflate);
  adler_bytes(deflate, from, size);
  deflate->size += size;
  while (size > 0) {
    if (room(deflate) == 0)
      slide(deflate);
    size_t part = size < room(deflate) ? size : room(deflate);
    memcpy(deflate->buffer + deflate->end, from, part);
    deflate->end += part;
    from += part;
    size -= part;
  }
  deflate->ends_in_zeros = false;
  return deflate->writer.status;
}

/* ---------------------------------------------------------------- parts */

celspan_status cs_deflate_end(cs_deflate *deflate, celspan_context *context, cs_deflate_sum *out) {
  cs_block_writer *writer = &deflate->writer;
  writer->context = context;
  search(deflate);
  put_zeros(deflate);
  if (deflate->token_count > 0)
    cs_block_put(writer, deflate->tokens, deflate->token_count, false);
  cs_block_align(writer);
  cs_block_flush(writer);
  reduce_adler(deflate);
  *out = (cs_deflate_sum){(uint32_t)(deflate->adler_b << 16 | deflate->adler_a), deflate->size};
  return writer->status;
}

void cs_deflate_header(unsigned char header[CS_DEFLATE_HEADER]) {
  header[0] = 0x78; /* deflate, 32 KiB */
  header[1] = 0x9c;
}

/* An empty last block of the fixed codes, and the checksum. */
void cs_deflate_trailer(cs_deflate_sum sum, unsigned char trailer[CS_DEFLATE_TRAILER]) {
  trailer[0] = 3;
  trailer[1] = 0;
  for (int i = 0; i < 4; i++)
    trailer[2 + i] = (unsigned char)(sum.adler >> (24 - 8 * i));
}

cs_deflate_sum cs_deflate_join(cs_deflate_sum first, cs_deflate_sum second) {
  uLong adler = adler32_combine(first.adler, second.adler, (z_off_t)second.size);
  return (cs_deflate_sum){(uint32_t)adler, first.size + second.size};
}
