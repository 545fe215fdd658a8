#include "base/cache.h"

#include "base/self_check.h"

#define BUCKETS_LEAST 1024

/* ---------------------------------------------------------------- buckets (under the lock) */

static cs_cache_entry **bucket_of(const cs_cache *cache, cs_cache_key key) {
  uint64_t mixed = key.a * 0x9e3779b97f4a7c15u;
  mixed = (mixed ^ mixed >> 29 ^ key.b) * 0xc2b2ae3d27d4eb4fu;
  mixed = (mixed ^ mixed >> 31 ^ key.c) * 0x9e3779b97f4a7c15u;
  return &cache->buckets[(size_t)(mixed >> 32) & (cache->bucket_count - 1)];
}

static bool is_key(const cs_cache_entry *entry, cs_cache_key key) {
  return entry->key.a == key.a && entry->key.b == key.b && entry->key.c == key.c;
}

static cs_cache_entry *find(const cs_cache *cache, cs_cache_key key) {
  cs_cache_entry *entry = cache->bucket_count ? *bucket_of(cache, key) : NULL;
  while (entry && !is_key(entry, key))
    entry = entry->next;
  return entry;
}

static void bucket_add(cs_cache *cache, cs_cache_entry *entry) {
  cs_cache_entry **bucket = bucket_of(cache, entry->key);
  entry->next = *bucket;
  *bucket = entry;
  cache->entry_count++;
}

static void bucket_remove(cs_cache *cache, const cs_cache_entry *entry) {
  cs_cache_entry **link = bucket_of(cache, entry->key);
  while (*link != entry)
    link = &(*link)->next;
  *link = entry->next;
  cache->entry_count--;
}

/* False if there are no buckets at all because of a lack of memory. */
static bool grow_buckets(cs_cache *cache) {
  if (cache->entry_count < cache->bucket_count)
    return true;
  size_t old_count = cache->bucket_count, new_count = old_count ? 2 * old_count : BUCKETS_LEAST;
  cs_cache_entry **old = cache->buckets;
  cs_cache_entry **grown = cs_mem_array(cache->memory, new_count, sizeof(cs_cache_entry *));
  if (!grown)
    return old_count > 0;
  cache->buckets = grown;
  cache->bucket_count = new_count;
  cache->entry_count = 0;
  for (size_t i = 0; i < old_count; i++)
    for (cs_cache_entry *entry = old[i], *next; entry; entry = next) {
      next = entry->next;
      bucket_add(cache, entry);
    }
  cs_mem_free(cache->memory, old, old_count * sizeof(cs_cache_entry *));
  return true;
}

/* ---------------------------------------------------------------- idle list (under the lock) */

static void idle_remove(cs_cache *cache, cs_cache_entry *entry) {
  *(entry->older ? &entry->older->newer : &cache->oldest) = entry->newer;
  *(entry->newer ? &entry->newer->older : &cache->newest) = entry->older;
  entry->older = entry->newer = NULL;
}

static void idle_append(cs_cache *cache, cs_cache_entry *entry) {
  entry->older = cache->newest;
  entry->newer = NULL;
  *(cache->newest ? &cache->newest->newer : &cache->oldest) = entry;
  cache->newest = entry;
}

static void free_entry(cs_cache *cache, cs_cache_entry *entry) {
  cache->counts.bytes -= entry->bytes;
  cs_account_give_up(cache->memory, entry->bytes);
  if (cache->clear)
    cache->clear(entry, cache->memory);
  cs_mem_free(cache->memory, entry, cache->entry_size);
}

static void shrink_to(cs_cache *cache, size_t bytes) {
  while (cache->oldest && cache->counts.bytes > bytes) {
    cs_cache_entry *entry = cache->oldest;
    idle_remove(cache, entry);
    bucket_remove(cache, entry);
    free_entry(cache, entry);
  }
}

static void pin(cs_cache *cache, cs_cache_entry *entry) {
  if (entry->pins++ == 0)
    idle_remove(cache, entry);
}

/* ---------------------------------------------------------------- finding */

static cs_cache_entry *pin_made(cs_cache *cache, cs_cache_key key) {
  cs_cache_entry *entry = find(cache, key);
  while (entry && !entry->is_made) {
    pthread_cond_wait(&cache->settled, &cache->lock);
    entry = find(cache, key);
  }
  if (entry)
    pin(cache, entry);
  cache->counts.found += entry != NULL;
  return entry;
}

cs_cache_entry *cs_cache_pin(cs_cache *cache, cs_cache_key key) {
  pthread_mutex_lock(&cache->lock);
  cs_cache_entry *entry = pin_made(cache, key);
  pthread_mutex_unlock(&cache->lock);
  return entry;
}

void cs_cache_unpin(cs_cache *cache, cs_cache_entry *entry) {
  pthread_mutex_lock(&cache->lock);
  if (--entry->pins == 0)
    idle_append(cache, entry);
  if (cache->shrinks_on_unpin)
    shrink_to(cache, cache->budget);
  pthread_mutex_unlock(&cache->lock);
}

/* ---------------------------------------------------------------- making */

/* Called with the lock held. NULL: there is no memory. */
static cs_cache_entry *create_entry(cs_cache *cache, cs_cache_key key, size_t bytes) {
  shrink_to(cache, cache->budget > bytes ? cache->budget - bytes : 0);
  cs_cache_entry *entry =
      grow_buckets(cache) ? cs_mem_array(cache->memory, 1, cache->entry_size) : NULL;
  if (!entry)
    return NULL;
  entry->key = key;
  entry->bytes = bytes;
  cache->counts.bytes += bytes;
  cs_account_keep(cache->memory, bytes);
  return entry;
}

celspan_status cs_cache_create(cs_cache *cache, celspan_context *context, cs_cache_key key,
                               size_t bytes, cs_cache_entry **out) {
  pthread_mutex_lock(&cache->lock);
  *out = create_entry(cache, key, bytes);
  pthread_mutex_unlock(&cache->lock);
  return *out ? CELSPAN_OK : cs_fail_memory(context);
}

cs_cache_entry *cs_cache_insert(cs_cache *cache, cs_cache_entry *entry, bool is_pinned) {
  pthread_mutex_lock(&cache->lock);
  cs_cache_entry *known = find(cache, entry->key);
  if (known) {
    free_entry(cache, entry);
  } else {
    known = entry;
    known->is_made = true;
    cache->counts.made++;
    bucket_add(cache, known);
    idle_append(cache, known);
  }
  if (is_pinned)
    pin(cache, known);
  CS_SELF_CHECK(cs_cache_seems_sound(cache));
  pthread_mutex_unlock(&cache->lock);
  return known;
}

void cs_cache_discard(cs_cache *cache, cs_cache_entry *entry) {
  pthread_mutex_lock(&cache->lock);
  free_entry(cache, entry);
  pthread_mutex_unlock(&cache->lock);
}

/* Fills an entry that is in its bucket and has one pin. Called with the lock held, which is
 * released while the entry is being made. */
static celspan_status make_entry(cs_cache *cache, celspan_context *context, cs_cache_entry *entry,
                                 cs_cache_make make, void *user) {
  pthread_mutex_unlock(&cache->lock);
  celspan_status status = make(user, context, entry);
  pthread_mutex_lock(&cache->lock);
  cache->counts.bytes += entry->bytes;
  cs_account_keep(cache->memory, entry->bytes);
  entry->is_made = status == CELSPAN_OK;
  cache->counts.made += entry->is_made;
  if (!entry->is_made) {
    bucket_remove(cache, entry);
    free_entry(cache, entry);
  }
  shrink_to(cache, cache->budget);
  CS_SELF_CHECK(cs_cache_seems_sound(cache));
  pthread_cond_broadcast(&cache->settled);
  return status;
}

celspan_status cs_cache_acquire(cs_cache *cache, celspan_context *context, cs_cache_key key,
                                cs_cache_make make, void *user, cs_cache_entry **out) {
  celspan_status status = CELSPAN_OK;
  pthread_mutex_lock(&cache->lock);
  cs_cache_entry *entry = pin_made(cache, key);
  if (!entry) {
    entry = create_entry(cache, key, 0);
    if (entry) {
      entry->pins = 1;
      bucket_add(cache, entry);
      status = make_entry(cache, context, entry, make, user);
    } else {
      status = cs_fail_memory(context);
    }
  }
  pthread_mutex_unlock(&cache->lock);
  if (status == CELSPAN_OK)
    *out = entry;
  return status;
}

/* ---------------------------------------------------------------- the cache */

celspan_status cs_cache_service_create(celspan_context *context, size_t entry_size,
                                       void (*clear)(cs_cache_entry *entry, cs_memory *memory),
                                       size_t budget, cs_service **out) {
  cs_cache_service *made;
  CS_TRY(CS_MAKE(context, made, 1));
  made->cache = (cs_cache){.memory = context->memory,
                           .entry_size = entry_size,
                           .clear = clear,
                           .shrinks_on_unpin = true,
                           .budget = budget};
  cs_cache_init(&made->cache);
  *out = &made->service;
  return CELSPAN_OK;
}

void cs_cache_service_destroy(cs_service *service) {
  cs_cache *cache = cs_cache_of(service);
  cs_memory *memory = cache->memory;
  cs_cache_finish(cache);
  cs_mem_free(memory, service, sizeof(cs_cache_service));
}

void cs_cache_service_trim(cs_service *service) { cs_cache_trim(cs_cache_of(service)); }

size_t cs_cache_raise_budget(cs_cache *cache, size_t least) {
  pthread_mutex_lock(&cache->lock);
  cache->budget = cache->budget < least ? least : cache->budget;
  size_t budget = cache->budget;
  pthread_mutex_unlock(&cache->lock);
  return budget;
}

void cs_cache_trim(cs_cache *cache) {
  pthread_mutex_lock(&cache->lock);
  shrink_to(cache, 0);
  CS_SELF_CHECK(cs_cache_is_sound(cache));
  pthread_mutex_unlock(&cache->lock);
}

cs_cache_counts cs_cache_count(cs_cache *cache) {
  pthread_mutex_lock(&cache->lock);
  cs_cache_counts counts = cache->counts;
  pthread_mutex_unlock(&cache->lock);
  return counts;
}

void cs_cache_init(cs_cache *cache) {
  pthread_mutex_init(&cache->lock, NULL);
  pthread_cond_init(&cache->settled, NULL);
}

void cs_cache_finish(cs_cache *cache) {
  CS_SELF_CHECK(cs_cache_is_sound(cache));
  for (size_t i = 0; i < cache->bucket_count; i++)
    for (cs_cache_entry *entry = cache->buckets[i], *next; entry; entry = next) {
      next = entry->next;
      free_entry(cache, entry);
    }
  CS_SELF_CHECK(cache->counts.bytes == 0);
  cs_mem_free(cache->memory, cache->buckets, cache->bucket_count * sizeof *cache->buckets);
  pthread_cond_destroy(&cache->settled);
  pthread_mutex_destroy(&cache->lock);
}
