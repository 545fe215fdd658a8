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

static size_t bytes_of(size_t class) { return CS_SPARES_SMALLEST << class; }

/* Of a size that has one. */
static size_t class_of(size_t size) {
  size_t class = 0;
  while (bytes_of(class) < size)
    class += 1;
  return class;
}

/* realloc; what is kept is given up where memory is short. */
static void *request(cs_spares *spares, void *storage, size_t size) {
  void *made = realloc(storage, size);
  if (!made) {
    cs_spares_trim(spares);
    made = realloc(storage, size);
  }
  return advised(made, size);
}

static void *take(cs_spares *spares, size_t class) {
  for (size_t i = 0; i < CS_SPARES_SLOTS; i++) {
    void *spare = atomic_exchange(&spares->kept[class][i], NULL);
    if (spare) {
      atomic_fetch_sub(&spares->bytes, bytes_of(class));
      return spare;
    }
  }
  return request(spares, NULL, bytes_of(class));
}

static void give_back(cs_spares *spares, void *spare, size_t class) {
  size_t bytes = bytes_of(class);
  bool has_room = atomic_fetch_add(&spares->bytes, bytes) + bytes <= CS_SPARES_MOST;
  for (size_t i = 0; has_room && i < CS_SPARES_SLOTS; i++) {
    void *none = NULL;
    if (atomic_compare_exchange_strong(&spares->kept[class][i], &none, spare))
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
    return request(spares, storage, new_size);
  size_t class = class_of(new_size);
  if (storage && has_class(old_size) && class_of(old_size) == class)
    return storage;
  void *spare = take(spares, class);
  if (!spare)
    return new_size < old_size ? storage : NULL; /* larger than its class is fine, too */
  if (storage) {
    memcpy(spare, storage, old_size < new_size ? old_size : new_size);
    release(spares, storage, old_size);
  }
  return spare;
}

void cs_spares_trim(cs_spares *spares) {
  for (size_t class = 0; class < CS_SPARES_CLASSES; class += 1)
    for (size_t i = 0; i < CS_SPARES_SLOTS; i++) {
      void *spare = atomic_exchange(&spares->kept[class][i], NULL);
      if (spare)
        atomic_fetch_sub(&spares->bytes, bytes_of(class));
      free(spare);
    }
}

void cs_spares_close(cs_spares *spares) {
  atomic_fetch_add(&spares->bytes, CS_SPARES_MOST);
  cs_spares_trim(spares);
}
