/* output/deflate/deflate.c and below: zlib inflates to the original bytes; code lengths are
 * optimal.
 */
#include "output/deflate/deflate.h"

#include <stdlib.h>
#include <zlib.h>

#include "output/deflate/huffman.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

static test_random numbers = {1};

/* ---------------------------------------------------------------- streams */

typedef struct store {
  unsigned char *bytes;
  size_t size, capacity, limit;
} store;

static void append(store *to, const void *bytes, size_t size) {
  while (to->size + size >= to->capacity)
    to->bytes = realloc(to->bytes, to->capacity = 2 * to->capacity + size + 1);
  memcpy(to->bytes + to->size, bytes, size);
  to->size += size;
}

static celspan_status write_store(void *user, celspan_context *context, const void *bytes,
                                  size_t size) {
  store *to = user;
  if (to->limit && to->size + size > to->limit)
    return celspan_context_fail(context, CELSPAN_OUTPUT, "full");
  append(to, bytes, size);
  return CELSPAN_OK;
}

static void check_inflates(const store *plain, const store *packed) {
  unsigned char *found = malloc(plain->size + 1);
  uLongf size = plain->size + 1;
  CHECK(uncompress(found, &size, packed->bytes, packed->size) == Z_OK);
  CHECK(size == plain->size && memcmp(found, plain->bytes, plain->size) == 0);
  free(found);
}

static uint64_t random_pixel(int style) {
  static const uint64_t palette[4] = {0, 0xff00000000ff8040u, 0x0101010101010101u, 0x80};
  uint64_t pixel = palette[random_below(&numbers, 4)];
  if (style % 3 == 2 || random_below(&numbers, 8) == 0)
    pixel ^= random_bits(&numbers);
  return pixel;
}

static size_t random_count(int style) {
  int most[] = {2, 8, 100, 600, style % 2 ? 20000 : 3, style > 6 ? 1000000 : 2};
  return 1 + (size_t)random_below(&numbers, most[random_below(&numbers, 6)]);
}

static void add_bytes(store *plain, cs_deflate *deflate, celspan_context *context, int style) {
  unsigned char bytes[3000];
  size_t size = (size_t)random_below(&numbers, style % 4 == 3 ? 3000 : 20);
  for (size_t i = 0; i < size; i++)
    bytes[i] =
        (unsigned char)(style & 1 ? random_below(&numbers, 256) : random_below(&numbers, 3) * 50);
  append(plain, bytes, size);
  unsigned char *space = cs_deflate_space(deflate, context);
  memcpy(space, bytes, size);
  CHECK(cs_deflate_commit(deflate, space, size) == CELSPAN_OK);
}

static void add_run(store *plain, cs_deflate *deflate, celspan_context *context, int style,
                    size_t pixel_size) {
  uint64_t pixel = random_pixel(style);
  size_t count = random_count(style);
  pixel &= UINT64_MAX >> (64 - 8 * pixel_size);
  for (size_t i = 0; i < count; i++)
    append(plain, &pixel, pixel_size);
  cs_deflate_run run = {pixel, (uint32_t)count};
  CHECK(cs_deflate_runs(deflate, context, &run, 1) == CELSPAN_OK);
}

typedef struct stream {
  store packed;
  cs_deflate_sum sum;
} stream;

static void begin_stream(stream *made) {
  unsigned char header[CS_DEFLATE_HEADER];
  *made = (stream){.sum = CS_DEFLATE_SUM_EMPTY};
  cs_deflate_header(header);
  append(&made->packed, header, sizeof header);
}

/* `items` bytes and runs, as one segment. */
static void add_segment(stream *made, store *plain, celspan_context *context, cs_deflate *deflate,
                        int style, size_t pixel_size, int items) {
  cs_deflate_sum sum;
  cs_deflate_begin(deflate);
  for (int i = 0; i < items; i++)
    switch (random_below(&numbers, 4)) {
    case 0:
      add_bytes(plain, deflate, context, style);
      break;
    case 1:
      append(plain, &(unsigned char){(unsigned char)(i % 3)}, 1);
      cs_deflate_byte(deflate, (unsigned char)(i % 3));
      break;
    default:
      add_run(plain, deflate, context, style, pixel_size);
    }
  CHECK(cs_deflate_end(deflate, context, &sum) == CELSPAN_OK);
  made->sum = cs_deflate_join(made->sum, sum);
}

static void end_stream(stream *made, const store *plain) {
  unsigned char trailer[CS_DEFLATE_TRAILER];
  cs_deflate_trailer(made->sum, trailer);
  append(&made->packed, trailer, sizeof trailer);
  CHECK(made->sum.size == plain->size);
  check_inflates(plain, &made->packed);
  free(made->packed.bytes);
}

static void check_stream(celspan_context *context, int style, size_t pixel_size, int items) {
  store plain = {0};
  stream made;
  cs_deflate *deflate;
  begin_stream(&made);
  CHECK(cs_deflate_create(context, pixel_size, write_store, &made.packed, &deflate) == CELSPAN_OK);
  for (int segments = random_below(&numbers, 4); segments < 4; segments++)
    add_segment(&made, &plain, context, deflate, style, pixel_size, items);
  cs_deflate_destroy(deflate, context);
  append(&plain, "", 0);
  end_stream(&made, &plain);
  free(plain.bytes);
}

/* A segment's bytes do not depend on earlier input of the compressor. */
static void check_segments_are_independent(celspan_context *context) {
  const test_random begun = numbers;
  store plain = {0};
  stream made[2] = {{.sum = CS_DEFLATE_SUM_EMPTY}, {.sum = CS_DEFLATE_SUM_EMPTY}};
  for (int i = 0; i < 2; i++) {
    cs_deflate *deflate;
    CHECK(cs_deflate_create(context, 3, write_store, &made[i].packed, &deflate) == CELSPAN_OK);
    numbers.state = 17;
    for (int other = 0; other < 3 * i; other++)
      add_segment(&made[i], &plain, context, deflate, other, 3, 100);
    size_t start = made[i].packed.size;
    numbers = begun;
    add_segment(&made[i], &plain, context, deflate, 3, 3, 400);
    made[i].packed.size -= start;
    memmove(made[i].packed.bytes, made[i].packed.bytes + start, made[i].packed.size);
    cs_deflate_destroy(deflate, context);
  }
  CHECK(made[0].packed.size == made[1].packed.size &&
        memcmp(made[0].packed.bytes, made[1].packed.bytes, made[0].packed.size) == 0);
  free(made[0].packed.bytes);
  free(made[1].packed.bytes);
  free(plain.bytes);
}

/* Bytes of few values, so that anything beyond their end might match too. */
static void add_few(cs_deflate *deflate, celspan_context *context, uint64_t seed) {
  cs_deflate_sum sum;
  numbers.state = seed;
  cs_deflate_begin(deflate);
  for (int i = 0; i < 20; i++) {
    unsigned char *space = cs_deflate_space(deflate, context);
    size_t size = 1 + (size_t)random_below(&numbers, 128);
    for (size_t k = 0; k < size; k++)
      space[k] = (unsigned char)(40 * random_below(&numbers, 3));
    CHECK(cs_deflate_commit(deflate, space, size) == CELSPAN_OK);
  }
  CHECK(cs_deflate_end(deflate, context, &sum) == CELSPAN_OK);
}

/* The last bytes of a segment do not depend on the contents of the buffer beyond them either. */
static void check_ends_are_independent(celspan_context *context) {
  for (uint64_t seed = 1; seed <= 40; seed++) {
    store packed[2] = {{0}};
    for (uint64_t others = 0; others < 2; others++) {
      cs_deflate *deflate;
      CHECK(cs_deflate_create(context, 4, write_store, &packed[others], &deflate) == CELSPAN_OK);
      if (others > 0)
        add_few(deflate, context, seed + 1000);
      packed[others].size = 0;
      add_few(deflate, context, seed);
      cs_deflate_destroy(deflate, context);
    }
    CHECK(packed[0].size == packed[1].size &&
          memcmp(packed[0].bytes, packed[1].bytes, packed[0].size) == 0);
    free(packed[0].bytes);
    free(packed[1].bytes);
  }
}

/* 2^20 pixels of 255 over and over: the checksum's closed form at its largest. */
static void check_long_white(celspan_context *context) {
  store plain = {0};
  stream made;
  cs_deflate *deflate;
  cs_deflate_sum sum;
  begin_stream(&made);
  CHECK(cs_deflate_create(context, 8, write_store, &made.packed, &deflate) == CELSPAN_OK);
  plain.bytes = malloc(plain.size = plain.capacity = (size_t)16 << 20);
  memset(plain.bytes, 255, plain.size);
  cs_deflate_begin(deflate);
  const cs_deflate_run runs[2] = {{UINT64_MAX, 1 << 20}, {UINT64_MAX, 1 << 20}};
  CHECK(cs_deflate_runs(deflate, context, runs, 2) == CELSPAN_OK);
  CHECK(cs_deflate_end(deflate, context, &sum) == CELSPAN_OK);
  made.sum = cs_deflate_join(made.sum, sum);
  cs_deflate_destroy(deflate, context);
  CHECK(made.packed.size < plain.size / 600);
  end_stream(&made, &plain);
  free(plain.bytes);
}

enum { GRADIENT_ROW = 3000, GRADIENT_ROWS = 400 };

/* The differences of neighbours in a slow gradient of three channels: ones between long runs of
 * zeros, at nearly the same places as in the row above. */
static void fill_gradient_row(unsigned char row[GRADIENT_ROW], int y) {
  const int across[] = {11, 8, 6}, down[] = {3, 5, 2};
  for (int i = 0; i < GRADIENT_ROW; i++) {
    int x = i / 3, value = x * across[i % 3] + y * down[i % 3];
    row[i] = (unsigned char)((value + across[i % 3]) / 1000 - value / 1000);
  }
}

/* A search that stopped at the end of each run, or tried only a few places, needed a quarter
 * more. */
static void check_gradient(celspan_context *context) {
  store plain = {0};
  stream made;
  cs_deflate *deflate;
  cs_deflate_sum sum;
  begin_stream(&made);
  CHECK(cs_deflate_create(context, 3, write_store, &made.packed, &deflate) == CELSPAN_OK);
  cs_deflate_begin(deflate);
  for (int y = 0; y < GRADIENT_ROWS; y++) {
    unsigned char *space = cs_deflate_space(deflate, context);
    fill_gradient_row(space, y);
    append(&plain, space, GRADIENT_ROW);
    CHECK(cs_deflate_commit(deflate, space, GRADIENT_ROW) == CELSPAN_OK);
  }
  CHECK(cs_deflate_end(deflate, context, &sum) == CELSPAN_OK);
  made.sum = cs_deflate_join(made.sum, sum);
  cs_deflate_destroy(deflate, context);
  uLongf size = compressBound(plain.size);
  unsigned char *by_zlib = malloc(size);
  CHECK(compress2(by_zlib, &size, plain.bytes, plain.size, 6) == Z_OK);
  printf("a slow gradient: %zu bytes, by zlib %lu\n", made.packed.size, size);
  CHECK(made.packed.size < size);
  free(by_zlib);
  end_stream(&made, &plain);
  free(plain.bytes);
}

static void check_errors_stick(celspan_context *context) {
  store packed = {.limit = 100000};
  cs_deflate *deflate;
  cs_deflate_sum sum;
  CHECK(cs_deflate_create(context, 4, write_store, &packed, &deflate) == CELSPAN_OK);
  celspan_status status = CELSPAN_OK;
  cs_deflate_begin(deflate);
  for (int i = 0; i < 300000; i++) {
    cs_deflate_run run = {random_bits(&numbers) >> 32, 1};
    status = cs_deflate_runs(deflate, context, &run, 1);
  }
  CHECK(status == CELSPAN_OUTPUT);
  CHECK(cs_deflate_end(deflate, context, &sum) == CELSPAN_OUTPUT);
  CHECK(packed.size <= packed.limit);
  CHECK_TEXT(celspan_context_error(context), "full");
  cs_deflate_begin(deflate);
  const cs_deflate_run one = {1, 1};
  CHECK(cs_deflate_runs(deflate, context, &one, 1) == CELSPAN_OK);
  cs_deflate_destroy(deflate, context);
  cs_deflate_destroy(NULL, context);
  free(packed.bytes);
}

/* ---------------------------------------------------------------- code lengths */

/* Huffman's own construction, without a limit: the least possible sum. */
static uint64_t least_size(const uint32_t *counts, int symbols) {
  uint64_t weights[CS_DEFLATE_HUFFMAN_SYMBOLS], sum = 0;
  int left = 0;
  for (int i = 0; i < symbols; i++)
    if (counts[i])
      weights[left++] = counts[i];
  while (left > 1) {
    for (int pick = 0; pick < 2; pick++) {
      int least = pick;
      for (int i = pick; i < left; i++)
        if (weights[i] < weights[least])
          least = i;
      uint64_t weight = weights[least];
      weights[least] = weights[pick];
      weights[pick] = weight;
    }
    weights[1] += weights[0];
    sum += weights[1];
    weights[0] = weights[--left];
  }
  return sum;
}

static void check_lengths(const uint32_t *counts, int symbols, int limit) {
  uint8_t lengths[CS_DEFLATE_HUFFMAN_SYMBOLS];
  uint64_t size = 0, kraft = 0;
  int used = 0, longest = 0;
  cs_deflate_huffman_lengths(counts, symbols, limit, lengths);
  for (int i = 0; i < symbols; i++) {
    CHECK((lengths[i] > 0) == (counts[i] > 0));
    used += counts[i] > 0;
    longest = lengths[i] > longest ? lengths[i] : longest;
    size += (uint64_t)lengths[i] * counts[i];
    kraft += lengths[i] ? (uint64_t)1 << (32 - lengths[i]) : 0;
  }
  CHECK(longest <= limit);
  CHECK(used < 2 || kraft == (uint64_t)1 << 32);
  CHECK(used < 2 || (longest < limit ? size == least_size(counts, symbols)
                                     : size >= least_size(counts, symbols)));
}

static void check_huffman(void) {
  uint32_t counts[CS_DEFLATE_HUFFMAN_SYMBOLS] = {0};
  check_lengths(counts, 30, 15);
  counts[7] = 5;
  check_lengths(counts, 30, 15);
  for (int round = 0; round < 200; round++) {
    int symbols = 2 + random_below(&numbers, CS_DEFLATE_HUFFMAN_SYMBOLS - 1);
    for (int i = 0; i < symbols; i++)
      counts[i] = random_below(&numbers, 3)
                      ? (uint32_t)random_below(&numbers, 1 << random_below(&numbers, 20))
                      : 0;
    check_lengths(counts, symbols, symbols < 100 && round % 2 ? 7 : 15);
  }
  uint32_t a = 1, b = 1; /* Fibonacci's numbers make the deepest tree */
  for (int i = 0; i < 40; i++) {
    counts[i] = a;
    b += a;
    a = b - a;
  }
  check_lengths(counts, 40, 15);
  check_lengths(counts, 40, 7);
}

int main(void) {
  celspan_context *context;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  check_huffman();
  for (int style = 0; style < 9; style++)
    for (size_t pixel_size = 1; pixel_size <= 8; pixel_size++)
      for (int items = 0; items < 80; items += 1 + items)
        check_stream(context, style, pixel_size, items);
  for (int style = 0; style < 6; style++)
    check_stream(context, style, style % 2 ? 8 : 4, 4000);
  check_segments_are_independent(context);
  check_ends_are_independent(context);
  check_long_white(context);
  check_gradient(context);
  check_errors_stick(context);
  size_t bytes, peak;
  uint64_t allocations;
  celspan_context_memory(context, &bytes, &peak, &allocations);
  CHECK(peak < 1000000);
  celspan_context_destroy(context);
  return check_done();
}
