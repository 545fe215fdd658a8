#include "engine/map/keep.h"

typedef struct entry {
  cs_cache_entry entry;
  cs_map *map; /* a reference: frames that use the map have references of their own */
} entry;

static void clear_entry(cs_cache_entry *cached, cs_memory *memory) {
  (void)memory;
  cs_map_unref(((entry *)cached)->map);
}

static celspan_status create(celspan_context *context, cs_service **out) {
  return cs_cache_service_create(context, sizeof(entry), clear_entry, context->root->map_bytes,
                                 out);
}

static const cs_service_kind kind = {create, cs_cache_service_destroy, cs_cache_service_trim};

cs_cache_counts cs_map_keep_count(celspan_context *context) {
  cs_service *kept = cs_context_find_service(context, &kind);
  return kept ? cs_cache_count(cs_cache_of(kept)) : (cs_cache_counts){0};
}

typedef struct order {
  cs_map_keep_maker make;
  void *user;
} order;

static celspan_status make_map(void *user, celspan_context *context, cs_cache_entry *cached) {
  const order *o = user;
  entry *made = (entry *)cached;
  CS_TRY(cs_map_create(context, &made->map));
  CS_TRY(o->make(o->user, context, made->map));
  cached->bytes = sizeof *made + cs_map_bytes(made->map);
  return CELSPAN_OK;
}

/* Keeps a map that is not in the cache yet, if there is room. */
static celspan_status offer(celspan_context *context, cs_cache *cache, cs_cache_key key,
                            cs_map *map) {
  size_t bytes = sizeof(entry) + cs_map_bytes(map);
  cs_cache_entry *cached;
  if (cs_cache_count(cache).bytes + bytes > context->root->map_bytes)
    return CELSPAN_OK;
  CS_TRY(cs_cache_create(cache, context, key, bytes, &cached));
  ((entry *)cached)->map = map;
  cs_map_ref(map);
  (void)cs_cache_insert(cache, cached, false);
  return CELSPAN_OK;
}

static celspan_status find_or_make(celspan_context *context, cs_cache *cache, cs_cache_key key,
                                   cs_map_keeping keeping, const order *o, cs_map **out) {
  cs_cache_entry *cached = cs_cache_pin(cache, key);
  if (cached) {
    *out = ((entry *)cached)->map;
    cs_map_ref(*out);
    cs_cache_unpin(cache, cached);
    return CELSPAN_OK;
  }
  CS_TRY(cs_map_create(context, out));
  CS_TRY(o->make(o->user, context, *out));
  return keeping == CS_MAP_KEEP_NOT ? CELSPAN_OK : offer(context, cache, key, *out);
}

celspan_status cs_map_keep_acquire(celspan_context *context, cs_cache_key key,
                                   cs_map_keeping keeping, cs_map_keep_maker make, void *user,
                                   cs_map **out) {
  order o = {make, user};
  cs_service *service;
  cs_cache_entry *cached;
  CS_TRY(cs_context_service(context, &kind, &service));
  cs_cache *cache = cs_cache_of(service);
  if (keeping != CS_MAP_KEEP_FIRST)
    return find_or_make(context, cache, key, keeping, &o, out);
  CS_TRY(cs_cache_acquire(cache, context, key, make_map, &o, &cached));
  *out = ((entry *)cached)->map;
  cs_map_ref(*out);
  cs_cache_unpin(cache, cached);
  return CELSPAN_OK;
}
