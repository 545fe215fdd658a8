/* The self-check of a cache's accounts: see the invariants in base/cache.h. */
#include "base/cache.h"

/* Whether an entry is in the list of idle ones exactly if it has no pins, and is linked in both
 * directions. */
static bool is_linked(const cs_cache *cache, const cs_cache_entry *entry) {
  if (entry->pins > 0)
    return !entry->older && !entry->newer && cache->oldest != entry && cache->newest != entry;
  return (entry->older ? entry->older->newer == entry : cache->oldest == entry) &&
         (entry->newer ? entry->newer->older == entry : cache->newest == entry);
}

static size_t count_idle(const cs_cache *cache) {
  size_t count = 0;
  for (const cs_cache_entry *entry = cache->oldest; entry; entry = entry->newer)
    count++;
  return count;
}

bool cs_cache_is_sound(const cs_cache *cache) {
  size_t count = 0, idle = 0, bytes = 0;
  for (size_t i = 0; i < cache->bucket_count; i++)
    for (const cs_cache_entry *entry = cache->buckets[i]; entry; entry = entry->next) {
      if (!is_linked(cache, entry))
        return false;
      count++;
      idle += entry->pins == 0;
      bytes += entry->is_made ? entry->bytes : 0;
    }
  return count == cache->entry_count && idle == count_idle(cache) && bytes <= cache->counts.bytes;
}

bool cs_cache_seems_sound(const cs_cache *cache) {
  size_t pause = cache->entry_count / 16;
  return (pause > 1 && cache->counts.made % pause != 0) || cs_cache_is_sound(cache);
}
