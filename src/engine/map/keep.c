#include "engine/map/keep.h"

typedef struct entry {
  cs_cache_entry entry;
  cs_map *map; /* a reference: frames that have the map keep it by their own */
} entry;

typedef struct maps {
  cs_service service;
  cs_cache cache;
} maps;

static void clear_entry(cs_cache_entry *cached, cs_memory *memory) {
  (void)memory;
  cs_map_unref(((entry *)cached)->map);
}

static celspan_status create(celspan_context *context, cs_service **out) {
  maps *kept;
  CS_TRY(CS_MAKE(context, kept, 1));
  kept->cache = (cs_cache){.memory = context->memory,
                           .entry_size = sizeof(entry),
                           .clear = clear_entry,
                           .shrinks_on_unpin = true,
                           .budget = context->root->map_bytes};
  cs_cache_init(&kept->cache);
  *out = &kept->service;
  return CELSPAN_OK;
}

static void destroy(cs_service *service) {
  maps *kept = (maps *)service;
  cs_memory *memory = kept->cache.memory;
  cs_cache_finish(&kept->cache);
  cs_mem_free(memory, kept, sizeof *kept);
}

static void trim(cs_service *service) { cs_cache_trim(&((maps *)service)->cache); }

static const cs_service_kind kind = {create, destroy, trim};

cs_cache_counts cs_map_keep_count(celspan_context *context) {
  maps *kept = (maps *)cs_context_find_service(context, &kind);
  return kept ? cs_cache_count(&kept->cache) : (cs_cache_counts){0};
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

celspan_status cs_map_keep_acquire(celspan_context *context, cs_cache_key key,
                                   cs_map_keep_maker make, void *user, cs_map **out) {
  order o = {make, user};
  cs_service *service;
  cs_cache_entry *cached;
  CS_TRY(cs_context_service(context, &kind, &service));
  cs_cache *cache = &((maps *)service)->cache;
  CS_TRY(cs_cache_acquire(cache, context, key, make_map, &o, &cached));
  *out = ((entry *)cached)->map;
  cs_map_ref(*out);
  cs_cache_unpin(cache, cached);
  return CELSPAN_OK;
}
