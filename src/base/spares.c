#include "base/spares.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <sys/mman.h>
#endif

#define HUGE_PAGE ((uintptr_t)2 << 20) /* bytes */

/* Asks the system for huge pages, of which it has to clear and map fewer. */
static void *advised(void *storage, size_t size) {
#ifdef MADV_HUGEPAGE
  uintptr_t at = (uintptr_t)storage, first = (at + HUGE_PAGE - 1) & ~(HUGE_PAGE - 1);
  uintptr_t end = (at + size) & ~(HUGE_PAGE - 1);
  if (storage && size >= 2 * HUGE_PAGE && first < end)
    (void)madvise((void *)first, end - first, MADV_HUGEPAGE);
#else
  (void)size;
#endif
  return storage;
}

static bool has_class(size_t size) {
  return CS_SPARES_ARE_KEPT && size > CS_SPARES_SMALLEST / 2 && size <= CS_SPARES_LARGEST;
}

static size_t bytes_of(size_t rank) { return CS_SPARES_SMALLEST << rank; }

/* Of a size that has one. */
static size_t class_of(size_t size) {
  size_t rank = 0;
  while (bytes_of(rank) < size)
    rank++;
  return rank;
}

static void *take(cs_spares *spares, size_t rank) {
  for (size_t i = 0; i < CS_SPARES_SLOTS; i++) {
    void *spare = atomic_exchange(&spares->kept[rank][i], NULL);
    if (spare) {
      atomic_fetch_sub(&spares->bytes, bytes_of(rank));
      return spare;
    }
  }
  void *made = malloc(bytes_of(rank));
  if (!made) { /* what is kept may be enough */
    cs_spares_trim(spares);
    made = malloc(bytes_of(rank));
  }
  return advised(made, bytes_of(rank));
}

static void give_back(cs_spares *spares, void *spare, size_t rank) {
  size_t bytes = bytes_of(rank);
  bool has_room = atomic_fetch_add(&spares->bytes, bytes) + bytes <= CS_SPARES_MOST;
  for (size_t i = 0; has_room && i < CS_SPARES_SLOTS; i++) {
    void *none = NULL;
    if (atomic_compare_exchange_strong(&spares->kept[rank][i], &none, spare))
      return;
  }
  atomic_fetch_sub(&spares->bytes, bytes);
  free(spare);
}

static void release(cs_spares *spares, void *storage, size_t size) {
  if (storage && has_class(size))
    give_back(spares, storage, class_of(size));
  else
    free(storage);
}

void *cs_spares_resize(void *user, void *storage, size_t old_size, size_t new_size) {
  cs_spares *spares = user;
  if (new_size == 0) {
    release(spares, storage, old_size);
    return NULL;
  }
  if (!has_class(new_size))
    return advised(realloc(storage, new_size), new_size);
  size_t rank = class_of(new_size);
  if (storage && has_class(old_size) && class_of(old_size) == rank)
    return storage;
  void *spare = take(spares, rank);
  if (spare && storage) {
    memcpy(spare, storage, old_size < new_size ? old_size : new_size);
    release(spares, storage, old_size);
  }
  return spare;
}

void cs_spares_trim(cs_spares *spares) {
  for (size_t rank = 0; rank < CS_SPARES_CLASSES; rank++)
    for (size_t i = 0; i < CS_SPARES_SLOTS; i++) {
      void *spare = atomic_exchange(&spares->kept[rank][i], NULL);
      if (spare)
        atomic_fetch_sub(&spares->bytes, bytes_of(rank));
      free(spare);
    }
}
