/* base/spares.c: what is freed is allocated again, contents survive every change of size, not more
 * than the limit is kept, and threads that exchange spares never get the same one. */
#include "base/spares.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "tests/support/check.h"

enum { THREADS = 4, ROUNDS = 20000, LIVE = 12 };

#define KIB ((size_t)1024)

/* Sizes on both sides of those of the classes. */
static const size_t sizes[] = {1,        2 * KIB,     2 * KIB + 1,     4 * KIB,    4 * KIB + 1,
                               96 * KIB, 16384 * KIB, 16384 * KIB + 1, 20000 * KIB};

enum { SIZES = sizeof sizes / sizeof *sizes };

static bool holds(const unsigned char *storage, size_t size, unsigned char value) {
  return size == 0 || (storage[0] == value && memcmp(storage, storage + 1, size - 1) == 0);
}

static void check_again(void) {
  cs_spares spares = {0};
  void *first = cs_spares_resize(&spares, NULL, 0, 100 * KIB);
  cs_spares_resize(&spares, first, 100 * KIB, 0);
  size_t kept = atomic_load(&spares.bytes);
  CHECK(kept == (CS_SPARES_ARE_KEPT ? 128 * KIB : 0));
  if (kept > 0) {
    void *second = cs_spares_resize(&spares, NULL, 0, 65 * KIB);
    CHECK(second == first && atomic_load(&spares.bytes) == 0);
    CHECK(cs_spares_resize(&spares, second, 65 * KIB, 128 * KIB) == second);
    cs_spares_resize(&spares, second, 128 * KIB, 0);
  }
  cs_spares_trim(&spares);
  CHECK(atomic_load(&spares.bytes) == 0);
}

static void check_sizes(void) {
  cs_spares spares = {0};
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
  CHECK(atomic_load(&spares.bytes) == 0);
}

static void check_limit(void) {
  cs_spares spares = {0};
  void *held[2 * CS_SPARES_SLOTS];
  for (size_t i = 0; i < 2 * CS_SPARES_SLOTS; i++)
    held[i] = cs_spares_resize(&spares, NULL, 0, CS_SPARES_LARGEST);
  for (size_t i = 0; i < 2 * CS_SPARES_SLOTS; i++)
    cs_spares_resize(&spares, held[i], CS_SPARES_LARGEST, 0);
  CHECK(atomic_load(&spares.bytes) == (CS_SPARES_ARE_KEPT ? CS_SPARES_MOST : 0));
  cs_spares_trim(&spares);
}

static void check_slots(void) {
  cs_spares spares = {0};
  void *held[2 * CS_SPARES_SLOTS];
  for (size_t i = 0; i < 2 * CS_SPARES_SLOTS; i++)
    held[i] = cs_spares_resize(&spares, NULL, 0, 4 * KIB);
  for (size_t i = 0; i < 2 * CS_SPARES_SLOTS; i++)
    cs_spares_resize(&spares, held[i], 4 * KIB, 0);
  CHECK(atomic_load(&spares.bytes) == (CS_SPARES_ARE_KEPT ? CS_SPARES_SLOTS * 4 * KIB : 0));
  cs_spares_trim(&spares);
}

/* What is kept is given up before a request fails, of any size. */
static void check_shortage(void) {
  const size_t sizes_that_fail[] = {SIZE_MAX / 4, PTRDIFF_MAX};
  for (size_t i = 0; i < 2; i++) {
    cs_spares spares = {0};
    cs_spares_resize(&spares, cs_spares_resize(&spares, NULL, 0, 8 * KIB), 8 * KIB, 0);
    CHECK(atomic_load(&spares.bytes) == (CS_SPARES_ARE_KEPT ? 8 * KIB : 0));
    CHECK(!cs_spares_resize(&spares, NULL, 0, sizes_that_fail[i]));
    CHECK(atomic_load(&spares.bytes) == 0);
  }
}

/* Nothing is kept after the end, and nothing that was kept before it is left. */
static void check_close(void) {
  cs_spares spares = {0};
  void *late = cs_spares_resize(&spares, NULL, 0, 8 * KIB);
  cs_spares_resize(&spares, cs_spares_resize(&spares, NULL, 0, 8 * KIB), 8 * KIB, 0);
  cs_spares_close(&spares);
  size_t after = atomic_load(&spares.bytes);
  cs_spares_resize(&spares, late, 8 * KIB, 0);
  CHECK(atomic_load(&spares.bytes) == after && !atomic_load(&spares.kept[1][0]));
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
  cs_spares spares = {0};
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
  CHECK(atomic_load(&spares.bytes) == 0);
}

int main(void) {
  check_again();
  check_sizes();
  check_limit();
  check_slots();
  check_shortage();
  check_close();
  check_threads();
  return check_done();
}
