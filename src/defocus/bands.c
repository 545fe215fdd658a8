#include "defocus/bands.h"

#include <pthread.h>

#define BUCKETS 1024

typedef struct entry entry;
struct entry {
  cs_defocus_band band; /* first: what callers hold */
  cs_defocus_bands_key key;
  size_t size;
  uint32_t holders;
  bool is_made;
  entry *next;          /* in its bucket */
  entry *older, *newer; /* while nobody holds it */
};

typedef struct store {
  cs_service service;
  cs_memory *memory;
  pthread_mutex_t lock;
  pthread_cond_t changed; /* a band was made, or could not be */
  size_t budget;
  entry *buckets[BUCKETS];
  entry *oldest, *newest;
  cs_defocus_bands_counts counts;
} store;

/* ---------------------------------------------------------------- life */

static void free_entry(store *bands, entry *e) {
  cs_defocus_band_free(&e->band, bands->memory);
  cs_mem_free(bands->memory, e, sizeof *e);
}

static void destroy(cs_service *service) {
  store *bands = (store *)service;
  for (size_t i = 0; i < BUCKETS; i++)
    for (entry *e = bands->buckets[i], *next; e; e = next) {
      next = e->next;
      free_entry(bands, e);
    }
  pthread_cond_destroy(&bands->changed);
  pthread_mutex_destroy(&bands->lock);
  cs_memory *memory = bands->memory;
  cs_mem_free(memory, bands, sizeof *bands);
  cs_memory_unref(memory);
}

static void shrink_to(store *bands, size_t budget);

static void trim(cs_service *service) {
  store *bands = (store *)service;
  pthread_mutex_lock(&bands->lock);
  shrink_to(bands, 0);
  pthread_mutex_unlock(&bands->lock);
}

celspan_status cs_defocus_bands_ready(celspan_context *context) {
  celspan_context *root = context->root;
  cs_service *held = __atomic_load_n(&root->soft_bands, __ATOMIC_ACQUIRE);
  if (held)
    return CELSPAN_OK;
  store *bands = cs_mem_array(context->memory, 1, sizeof *bands);
  if (!bands)
    return cs_fail_memory(context);
  bands->service = (cs_service){destroy, trim};
  bands->memory = cs_memory_ref(context->memory);
  bands->budget = root->defocus_bytes;
  pthread_mutex_init(&bands->lock, NULL);
  pthread_cond_init(&bands->changed, NULL);
  /* Another thread may have been first. */
  if (!__atomic_compare_exchange_n(&root->soft_bands, &held, &bands->service, false,
                                   __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE))
    destroy(&bands->service);
  return CELSPAN_OK;
}

static store *store_of(celspan_context *context) {
  return (store *)__atomic_load_n(&context->root->soft_bands, __ATOMIC_ACQUIRE);
}

cs_defocus_bands_counts cs_defocus_bands_count(celspan_context *context) {
  store *bands = store_of(context);
  if (!bands)
    return (cs_defocus_bands_counts){0};
  pthread_mutex_lock(&bands->lock);
  cs_defocus_bands_counts counts = bands->counts;
  pthread_mutex_unlock(&bands->lock);
  return counts;
}

/* ---------------------------------------------------------------- entries; the lock is held */

static entry **bucket_of(store *bands, const cs_defocus_bands_key *key) {
  return &bands->buckets[(key->layer.a + (uint32_t)key->number * 0x9e3779b1u) % BUCKETS];
}

static entry *find(store *bands, const cs_defocus_bands_key *key) {
  entry *e = *bucket_of(bands, key);
  while (e && (e->key.layer.a != key->layer.a || e->key.layer.b != key->layer.b ||
               e->key.number != key->number))
    e = e->next;
  return e;
}

static void unlink_idle(store *bands, entry *e) {
  *(e->older ? &e->older->newer : &bands->oldest) = e->newer;
  *(e->newer ? &e->newer->older : &bands->newest) = e->older;
  e->older = e->newer = NULL;
}

static void link_idle(store *bands, entry *e) {
  e->older = bands->newest;
  *(bands->newest ? &bands->newest->newer : &bands->oldest) = e;
  bands->newest = e;
}

static void forget(store *bands, entry *e) {
  entry **place = bucket_of(bands, &e->key);
  while (*place != e)
    place = &(*place)->next;
  *place = e->next;
  bands->counts.bytes -= e->size;
  free_entry(bands, e);
}

static void shrink_to(store *bands, size_t budget) {
  while (bands->oldest && bands->counts.bytes > budget) {
    entry *e = bands->oldest;
    unlink_idle(bands, e);
    forget(bands, e);
  }
}

static void shrink(store *bands) { shrink_to(bands, bands->budget); }

static entry *add(store *bands, const cs_defocus_bands_key *key) {
  entry *e = cs_mem_array(bands->memory, 1, sizeof *e);
  if (!e)
    return NULL;
  e->key = *key;
  entry **bucket = bucket_of(bands, key);
  e->next = *bucket;
  *bucket = e;
  return e;
}

static void drop_holder(store *bands, entry *e) {
  if (--e->holders > 0)
    return;
  if (e->is_made)
    link_idle(bands, e);
  else
    forget(bands, e);
  shrink(bands);
}

/* ---------------------------------------------------------------- making */

/* Makes a new entry's band with the lock let go. */
static celspan_status make_entry(store *bands, celspan_context *context, entry *e,
                                 cs_defocus_bands_maker make, const void *layer) {
  pthread_mutex_unlock(&bands->lock);
  celspan_status status = make(layer, context, e->key.number, &e->band);
  pthread_mutex_lock(&bands->lock);
  e->size = cs_defocus_band_bytes(&e->band);
  bands->counts.bytes += e->size;
  e->is_made = status == CELSPAN_OK;
  bands->counts.made += e->is_made;
  pthread_cond_broadcast(&bands->changed);
  return status;
}

/* Holds an entry that is there; waits while another thread makes it. NULL: it could not be made. */
static entry *hold(store *bands, const cs_defocus_bands_key *key) {
  entry *e = find(bands, key);
  while (e && !e->is_made) {
    pthread_cond_wait(&bands->changed, &bands->lock);
    e = find(bands, key);
  }
  if (e && e->holders++ == 0)
    unlink_idle(bands, e);
  bands->counts.found += e != NULL;
  return e;
}

celspan_status cs_defocus_bands_acquire(celspan_context *context, const cs_defocus_bands_key *key,
                                        cs_defocus_bands_maker make, const void *layer,
                                        cs_defocus_band **out) {
  store *bands = store_of(context);
  celspan_status status = CELSPAN_OK;
  pthread_mutex_lock(&bands->lock);
  entry *e = hold(bands, key);
  if (!e) {
    e = add(bands, key);
    if (e) {
      e->holders = 1;
      status = make_entry(bands, context, e, make, layer);
      if (status != CELSPAN_OK)
        drop_holder(bands, e);
    } else {
      status = cs_fail_memory(context);
    }
    shrink(bands);
  }
  pthread_mutex_unlock(&bands->lock);
  if (status == CELSPAN_OK)
    *out = &e->band;
  return status;
}

void cs_defocus_bands_release(celspan_context *context, cs_defocus_band *band) {
  store *bands = store_of(context);
  pthread_mutex_lock(&bands->lock);
  drop_holder(bands, (entry *)band);
  pthread_mutex_unlock(&bands->lock);
}
