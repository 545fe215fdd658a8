/* base/spares.c: what is freed is allocated again, contents survive every change of size, not more
 * than the limit is kept, and threads that exchange spares never get the same one. */
#include "base/spares.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "tests/support/check.h"

enum { THREADS = 4, ROUNDS = 20000, LIVE = 12, MANY = 5000 };

#define KIB ((size_t)1024)

/* Sizes on both sides of those of the classes. */
static const size_t sizes[] = {1,        2 * KIB,     2 * KIB + 1,     4 * KIB,    4 * KIB + 1,
                               96 * KIB, 16384 * KIB, 16384 * KIB + 1, 20000 * KIB};

enum { SIZES = sizeof sizes / sizeof *sizes };

static bool holds(const unsigned char *storage, size_t size, unsigned char value) {
  return size == 0 || (storage[0] == value && memcmp(storage, storage + 1, size - 1) == 0);
}

static void check_again(void) {
  cs_spares spares;
  CHECK(cs_spares_init(&spares));
  void *first = cs_spares_resize(&spares, NULL, 0, 100 * KIB);
  cs_spares_resize(&spares, first, 100 * KIB, 0);
  CHECK(spares.bytes == (CS_SPARES_ARE_KEPT ? 112 * KIB : 0));
  if (spares.bytes > 0) {
    void *second = cs_spares_resize(&spares, NULL, 0, 96 * KIB + 1);
    CHECK(second == first && spares.bytes == 0);
    CHECK(cs_spares_resize(&spares, second, 96 * KIB + 1, 112 * KIB) == second);
    cs_spares_resize(&spares, second, 112 * KIB, 0);
  }
  cs_spares_finish(&spares);
}

/* No class is more than a quarter larger than what was requested. */
static void check_classes(void) {
  cs_spares spares;
  CHECK(cs_spares_init(&spares));
  for (size_t size = CS_SPARES_SMALLEST; CS_SPARES_ARE_KEPT && size <= CS_SPARES_LARGEST;
       size += size / 9) {
    size_t before = spares.bytes;
    cs_spares_resize(&spares, cs_spares_resize(&spares, NULL, 0, size), size, 0);
    size_t class = spares.bytes - before;
    CHECK(class >= size && 4 * class <= 5 * size + 4);
    cs_spares_trim(&spares);
  }
  cs_spares_finish(&spares);
}

static void check_sizes(void) {
  cs_spares spares;
  CHECK(cs_spares_init(&spares));
  for (size_t i = 0; i < SIZES; i++)
    for (size_t k = 0; k < SIZES; k++) {
      unsigned char *storage = cs_spares_resize(&spares, NULL, 0, sizes[i]);
      memset(storage, (int)(i + 1), sizes[i]);
      storage = cs_spares_resize(&spares, storage, sizes[i], sizes[k]);
      size_t common = sizes[i] < sizes[k] ? sizes[i] : sizes[k];
      CHECK(holds(storage, common, (unsigned char)(i + 1)));
      memset(storage, 0, sizes[k]);
      cs_spares_resize(&spares, storage, sizes[k], 0);
    }
  cs_spares_trim(&spares);
  CHECK(spares.bytes == 0);
  cs_spares_finish(&spares);
}

/* Frees allocations of one size together. bytes: of those that are kept afterwards. */
static void check_limit(size_t count, size_t size, size_t bytes) {
  static void *held[MANY];
  cs_spares spares;
  CHECK(cs_spares_init(&spares));
  for (size_t i = 0; i < count; i++)
    held[i] = cs_spares_resize(&spares, NULL, 0, size);
  for (size_t i = 0; i < count; i++)
    cs_spares_resize(&spares, held[i], size, 0);
  CHECK(spares.bytes == (CS_SPARES_ARE_KEPT ? bytes : 0));
  cs_spares_finish(&spares);
}

/* What is kept is given up before a request fails, of any size. */
static void check_shortage(void) {
  const size_t sizes_that_fail[] = {SIZE_MAX / 4, PTRDIFF_MAX};
  for (size_t i = 0; i < 2; i++) {
    cs_spares spares;
    CHECK(cs_spares_init(&spares));
    cs_spares_resize(&spares, cs_spares_resize(&spares, NULL, 0, 8 * KIB), 8 * KIB, 0);
    CHECK(spares.bytes == (CS_SPARES_ARE_KEPT ? 8 * KIB : 0));
    CHECK(!cs_spares_resize(&spares, NULL, 0, sizes_that_fail[i]));
    CHECK(spares.bytes == 0);
    cs_spares_finish(&spares);
  }
}

/* Nothing is kept after the end, and nothing that was kept before it is left. */
static void check_close(void) {
  cs_spares spares;
  CHECK(cs_spares_init(&spares));
  void *late = cs_spares_resize(&spares, NULL, 0, 8 * KIB);
  cs_spares_resize(&spares, cs_spares_resize(&spares, NULL, 0, 8 * KIB), 8 * KIB, 0);
  cs_spares_close(&spares);
  CHECK(spares.bytes == 0);
  cs_spares_resize(&spares, late, 8 * KIB, 0);
  CHECK(spares.bytes == 0);
  cs_spares_finish(&spares);
}

typedef struct exchanger {
  cs_spares *spares;
  size_t number;
  size_t wrong;
} exchanger;

/* Fills spares of three classes with its own number, and finds it in them when it frees them. */
static void *exchange(void *user) {
  exchanger *e = user;
  unsigned char *held[LIVE] = {NULL}, value = (unsigned char)e->number;
  for (size_t i = 0; i < ROUNDS; i++) {
    size_t at = i % LIVE, size = (4 * KIB) << at % 3;
    e->wrong += held[at] && !holds(held[at], size, value);
    cs_spares_resize(e->spares, held[at], size, 0);
    held[at] = cs_spares_resize(e->spares, NULL, 0, size);
    e->wrong += !held[at];
    if (held[at])
      memset(held[at], value, size);
    if (i % 1000 == 0)
      cs_spares_trim(e->spares);
  }
  for (size_t at = 0; at < LIVE; at++)
    cs_spares_resize(e->spares, held[at], (4 * KIB) << at % 3, 0);
  return NULL;
}

static void check_threads(void) {
  cs_spares spares;
  CHECK(cs_spares_init(&spares));
  pthread_t threads[THREADS];
  exchanger exchangers[THREADS];
  for (size_t i = 0; i < THREADS; i++) {
    exchangers[i] = (exchanger){&spares, i + 1, 0};
    CHECK(pthread_create(&threads[i], NULL, exchange, &exchangers[i]) == 0);
  }
  for (size_t i = 0; i < THREADS; i++) {
    CHECK(pthread_join(threads[i], NULL) == 0);
    CHECK(exchangers[i].wrong == 0);
  }
  cs_spares_trim(&spares);
  CHECK(spares.bytes == 0);
  cs_spares_finish(&spares);
}

int main(void) {
  check_again();
  check_sizes();
  check_classes();
  check_limit(8, CS_SPARES_LARGEST, CS_SPARES_MOST);
  check_limit(MANY, 4 * KIB, MANY * 4 * KIB);
  check_shortage();
  check_close();
  check_threads();
  return check_done();
}
