#include "base/spares.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <sys/mman.h>
#endif

#define HUGE_PAGE ((uintptr_t)2 << 20) /* bytes */

struct cs_spare {
  cs_spare *next;
};

/* ---------------------------------------------------------------- life */

bool cs_spares_init(cs_spares *spares) {
  *spares = (cs_spares){.most = CS_SPARES_MOST};
  return pthread_mutex_init(&spares->lock, NULL) == 0;
}

static void free_all(cs_spares *spares) {
  spares->bytes = 0;
  for (size_t class = 0; class < CS_SPARES_CLASSES; class += 1)
    for (cs_spare *spare; (spare = spares->kept[class]);) {
      spares->kept[class] = spare->next;
      free(spare);
    }
}

void cs_spares_trim(cs_spares *spares) {
  pthread_mutex_lock(&spares->lock);
  free_all(spares);
  pthread_mutex_unlock(&spares->lock);
}

void cs_spares_close(cs_spares *spares) {
  pthread_mutex_lock(&spares->lock);
  spares->is_closed = true;
  free_all(spares);
  pthread_mutex_unlock(&spares->lock);
}

void cs_spares_finish(cs_spares *spares) {
  free_all(spares);
  pthread_mutex_destroy(&spares->lock);
}

/* ---------------------------------------------------------------- classes */

static bool has_class(size_t size) {
  return CS_SPARES_ARE_KEPT && size > CS_SPARES_SMALLEST / 2 && size <= CS_SPARES_LARGEST;
}

static size_t bytes_of(size_t class) {
  return (CS_SPARES_SMALLEST / 4 * (4 + class % 4)) << class / 4;
}

/* The class of a size; the size must have one. */
static size_t class_of(size_t size) {
  size_t class = 0;
  while (bytes_of(class + 4) <= size)
    class += 4;
  while (bytes_of(class) < size)
    class += 1;
  return class;
}

/* ---------------------------------------------------------------- the C library */

/* As realloc. New memory of at least a huge page begins at one. */
static void *reserve(void *storage, size_t size) {
#ifdef MADV_HUGEPAGE
  void *made = NULL;
  if (!storage && size >= HUGE_PAGE)
    return posix_memalign(&made, HUGE_PAGE, size) == 0 ? made : NULL;
#endif
  return realloc(storage, size);
}

/* Asks the system for huge pages: it then has fewer pages to clear and to map. */
static void *advised(void *storage, size_t size) {
#ifdef MADV_HUGEPAGE
  uintptr_t at = (uintptr_t)storage, first = (at + HUGE_PAGE - 1) & ~(HUGE_PAGE - 1);
  uintptr_t end = (at + size) & ~(HUGE_PAGE - 1);
  if (storage && first < end)
    (void)madvise((void *)first, end - first, MADV_HUGEPAGE);
#else
  (void)size;
#endif
  return storage;
}

/* As realloc. If memory is short, it frees the kept memory and tries again. */
static void *request(cs_spares *spares, void *storage, size_t size) {
  void *made = reserve(storage, size);
  if (!made) {
    cs_spares_trim(spares);
    made = reserve(storage, size);
  }
  return advised(made, size);
}

/* ---------------------------------------------------------------- exchange */

static void *take(cs_spares *spares, size_t class) {
  pthread_mutex_lock(&spares->lock);
  cs_spare *spare = spares->kept[class];
  if (spare) {
    spares->kept[class] = spare->next;
    spares->bytes -= bytes_of(class);
  }
  pthread_mutex_unlock(&spares->lock);
  return spare ? spare : request(spares, NULL, bytes_of(class));
}

static bool keep(cs_spares *spares, cs_spare *spare, size_t class) {
  size_t bytes = bytes_of(class);
  pthread_mutex_lock(&spares->lock);
  bool has_room = !spares->is_closed && spares->bytes + bytes <= spares->most;
  if (has_room) {
    spare->next = spares->kept[class];
    spares->kept[class] = spare;
    spares->bytes += bytes;
  }
  pthread_mutex_unlock(&spares->lock);
  return has_room;
}

static void release(cs_spares *spares, void *storage, size_t size) {
  if (!storage || !has_class(size) || !keep(spares, storage, class_of(size)))
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
    return new_size < old_size ? storage : NULL; /* a block may be larger than its class */
  if (storage) {
    memcpy(spare, storage, old_size < new_size ? old_size : new_size);
    release(spares, storage, old_size);
  }
  return spare;
}
