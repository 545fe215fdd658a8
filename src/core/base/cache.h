/* A cache: entries found by a key, shared by all threads, within a budget of bytes.
 *
 *              bucket of a key          pins > 0: in use, never dropped
 *   buckets --> entry -> entry -> ...   pins = 0: in the idle list
 *
 *   oldest <-> ... <-> newest           dropped from the oldest on, appended when the last pin goes
 *
 * INVARIANTS
 *   At most one entry of a key is in the cache, and an entry is either pinned or in the idle list.
 *   An entry's contents are a function of its key, and do not change while it is in the cache; so
 *   results depend neither on the budget nor on the number of threads.
 *   `bytes` is the sum over all entries, including those that are not in the cache yet. It exceeds
 *   the budget only by entries that are pinned, or were pinned when the last entry was made.
 *   The lock is never held while an entry is being made.
 *
 * An entry is made in one of two ways. cs_cache_acquire lets one thread make it while others that
 * want it wait. With cs_cache_create, _insert and _discard a thread makes several entries together;
 * when two threads made the same, the first to insert it wins.
 */
#pragma once

#include <pthread.h>

#include "base/context.h"

typedef struct cs_cache_key {
  uint64_t a, b, c;
} cs_cache_key;

/* The first member of the structure that a user keeps in the cache. */
typedef struct cs_cache_entry cs_cache_entry;
struct cs_cache_entry {
  cs_cache_key key;
  size_t bytes; /* the bytes by which the entry counts in the budget */
  uint32_t pins;
  bool is_made;
  cs_cache_entry *next;          /* the next one in its bucket */
  cs_cache_entry *older, *newer; /* linked only while it has no pins */
};

typedef struct cs_cache_counts {
  uint64_t made, found; /* entries, since the cache was made */
  size_t bytes;         /* the bytes of all entries now */
} cs_cache_counts;

typedef struct cs_cache {
  cs_memory *memory;
  size_t entry_size; /* size of the user's structure, cs_cache_entry included */
  /* Frees what an entry owns, even if its making has failed half-way. NULL: entries own nothing. */
  void (*clear)(cs_cache_entry *entry, cs_memory *memory);
  bool shrinks_on_unpin; /* it is also reduced to its budget when a pin is removed */
  size_t budget;
  pthread_mutex_t lock;
  pthread_cond_t settled; /* an entry was made, or could not be */
  cs_cache_entry **buckets;
  size_t bucket_count, entry_count;
  cs_cache_entry *oldest, *newest;
  cs_cache_counts counts;
} cs_cache;

/* The caller has set the first four fields and the budget; the rest is zero. */
void cs_cache_init(cs_cache *cache);
/* No entry may be pinned. */
void cs_cache_finish(cs_cache *cache);

/* A service that is one cache. Its kind has a function that creates it, and the two below. */
typedef struct cs_cache_service {
  cs_service service;
  cs_cache cache;
} cs_cache_service;
CELSPAN_CHECKED celspan_status cs_cache_service_create(celspan_context *context, size_t entry_size,
                                                       void (*clear)(cs_cache_entry *entry,
                                                                     cs_memory *memory),
                                                       size_t budget, cs_service **out);
void cs_cache_service_destroy(cs_service *service);
void cs_cache_service_trim(cs_service *service);
static inline cs_cache *cs_cache_of(cs_service *service) {
  return &((cs_cache_service *)service)->cache;
}

/* All functions below: any thread. */

/* Raises the budget to `least`, unless it is larger already; returns the budget. */
size_t cs_cache_raise_budget(cs_cache *cache, size_t least);
/* Frees all entries that are not pinned. */
void cs_cache_trim(cs_cache *cache);
cs_cache_counts cs_cache_count(cs_cache *cache);

/* Pins the entry of a key and returns it. If another thread is making it, waits for that. NULL: the
 * cache has no entry of this key. */
cs_cache_entry *cs_cache_pin(cs_cache *cache, cs_cache_key key);
void cs_cache_unpin(cs_cache *cache, cs_cache_entry *entry);

/* Fills a zeroed entry and sets its bytes. */
typedef celspan_status (*cs_cache_make)(void *user, celspan_context *context,
                                        cs_cache_entry *entry);
/* The same, but makes an entry that the cache does not have. Errors: NO_MEMORY, those of make. */
CELSPAN_CHECKED celspan_status cs_cache_acquire(cs_cache *cache, celspan_context *context,
                                                cs_cache_key key, cs_cache_make make, void *user,
                                                cs_cache_entry **out);

/* A new entry, zeroed except for its key. It is not in the cache yet, but counted with `bytes`.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_cache_create(cs_cache *cache, celspan_context *context,
                                               cs_cache_key key, size_t bytes,
                                               cs_cache_entry **out);
/* Puts an entry into the cache, with one pin or none. If the cache already has an entry of this
 * key, the new one is freed and the old one is returned. */
cs_cache_entry *cs_cache_insert(cs_cache *cache, cs_cache_entry *entry, bool is_pinned);
/* Frees an entry that was not inserted. */
void cs_cache_discard(cs_cache *cache, cs_cache_entry *entry);

/* Self-check: whether buckets, pins, the idle list and the bytes agree. The lock is held, or no
 * other thread uses the cache. */
bool cs_cache_is_sound(const cs_cache *cache);
/* The same check for a cache that changes. It is made once in n / 16 changes, where n is the number
 * of entries, because each check takes n steps. */
bool cs_cache_seems_sound(const cs_cache *cache);
