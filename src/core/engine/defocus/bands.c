#include "engine/defocus/bands.h"

#include <stddef.h>

typedef struct entry {
  cs_cache_entry entry; /* key: the layer's hash and the band's number */
  cs_defocus_band band;
} entry;

/* ---------------------------------------------------------------- life */

static void clear_entry(cs_cache_entry *cached, cs_memory *memory) {
  cs_defocus_band_free(&((entry *)cached)->band, memory);
}

static celspan_status create(celspan_context *context, cs_service **out) {
  return cs_cache_service_create(context, sizeof(entry), clear_entry, context->root->defocus_bytes,
                                 out);
}

static const cs_service_kind kind = {create, cs_cache_service_destroy, cs_cache_service_trim};

celspan_status cs_defocus_bands_ready(celspan_context *context) {
  cs_service *service;
  return cs_context_service(context, &kind, &service);
}

static cs_cache *cache_of(const celspan_context *context) {
  cs_service *service = cs_context_find_service(context, &kind);
  return service ? cs_cache_of(service) : NULL;
}

cs_cache_counts cs_defocus_bands_count(celspan_context *context) {
  cs_cache *cache = cache_of(context);
  return cache ? cs_cache_count(cache) : (cs_cache_counts){0};
}

/* ---------------------------------------------------------------- bands */

typedef struct order {
  cs_defocus_bands_maker make;
  const void *layer;
} order;

static celspan_status make_band(void *user, celspan_context *context, cs_cache_entry *cached) {
  const order *o = user;
  cs_defocus_band *band = &((entry *)cached)->band;
  celspan_status status = o->make(o->layer, context, (int32_t)cached->key.c, band);
  cached->bytes = cs_defocus_band_bytes(band);
  return status;
}

celspan_status cs_defocus_bands_acquire(celspan_context *context, const cs_defocus_bands_key *key,
                                        cs_defocus_bands_maker make, const void *layer,
                                        cs_defocus_band **out) {
  order o = {make, layer};
  cs_cache_key place = {key->layer.a, key->layer.b, (uint64_t)(int64_t)key->number};
  cs_cache_entry *cached;
  CS_TRY(cs_cache_acquire(cache_of(context), context, place, make_band, &o, &cached));
  *out = &((entry *)cached)->band;
  return CELSPAN_OK;
}

void cs_defocus_bands_release(celspan_context *context, cs_defocus_band *band) {
  entry *e = (entry *)((char *)band - offsetof(entry, band));
  cs_cache_unpin(cache_of(context), &e->entry);
}
