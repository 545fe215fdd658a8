/* base/cache.c: entries stay within the budget except those that are pinned, the oldest is evicted
 * first; one thread makes an entry that several want; a failure leaves nothing behind. */
#include "base/cache.h"

#include "base/thread_pool.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

enum { BYTES = 100, ROOM = 4 }; /* of an entry; entries that fit the budget */

typedef struct item {
  cs_cache_entry cached;
  uint64_t value;
  void *block; /* BYTES, if the maker got that far */
} item;

static void clear_item(cs_cache_entry *cached, cs_memory *memory) {
  cs_mem_free(memory, ((item *)cached)->block, BYTES);
}

static cs_cache make_cache(celspan_context *context, bool shrinks_on_unpin) {
  return (cs_cache){.memory = context->memory,
                    .entry_size = sizeof(item),
                    .clear = clear_item,
                    .shrinks_on_unpin = shrinks_on_unpin,
                    .budget = ROOM * BYTES};
}

static cs_cache_key key_of(uint64_t number) {
  return (cs_cache_key){number % 3, number, number / 2};
}

typedef struct maker {
  int fails; /* how many times it fails before it succeeds */
  atomic_int times, makers, clashes;
} maker;

static void be_busy(void) {
  volatile unsigned sum = 0;
  for (unsigned i = 0; i < 20000; i++)
    sum += i;
  (void)sum;
}

static celspan_status make(void *user, celspan_context *context, cs_cache_entry *cached) {
  maker *m = user;
  item *made = (item *)cached;
  m->clashes += atomic_fetch_add(&m->makers, 1) != 0;
  be_busy();
  int time = atomic_fetch_add(&m->times, 1);
  made->block = cs_mem_array(context->memory, 1, BYTES);
  made->value = 7 * made->cached.key.b;
  cached->bytes = BYTES;
  atomic_fetch_sub(&m->makers, 1);
  if (!made->block)
    return cs_fail_memory(context);
  return time < m->fails ? cs_fail(context, CELSPAN_INPUT, "time %d", time) : CELSPAN_OK;
}

static item *acquire(cs_cache *cache, celspan_context *context, uint64_t number) {
  maker m = {0};
  cs_cache_entry *cached;
  CHECK(cs_cache_acquire(cache, context, key_of(number), make, &m, &cached) == CELSPAN_OK);
  CHECK(((item *)cached)->value == 7 * number);
  return (item *)cached;
}

static item *insert(cs_cache *cache, celspan_context *context, uint64_t number, bool is_pinned) {
  cs_cache_entry *cached;
  CHECK(cs_cache_create(cache, context, key_of(number), BYTES, &cached) == CELSPAN_OK);
  ((item *)cached)->value = 7 * number;
  return (item *)cs_cache_insert(cache, cached, is_pinned);
}

static bool is_kept(cs_cache *cache, uint64_t number) {
  cs_cache_entry *cached = cs_cache_pin(cache, key_of(number));
  if (cached)
    cs_cache_unpin(cache, cached);
  return cached;
}

/* ---------------------------------------------------------------- budget and pins */

static void check_order(celspan_context *context) {
  cs_cache cache = make_cache(context, false);
  cs_cache_init(&cache);
  for (uint64_t i = 0; i < ROOM; i++)
    insert(&cache, context, i, false);
  CHECK(is_kept(&cache, 0)); /* and is the newest now */
  insert(&cache, context, ROOM, false);
  CHECK(cs_cache_count(&cache).bytes == ROOM * BYTES);
  CHECK(!is_kept(&cache, 1) && is_kept(&cache, 0) && is_kept(&cache, 2) && is_kept(&cache, ROOM));
  CHECK(cs_cache_raise_budget(&cache, BYTES) == ROOM * BYTES);
  CHECK(cs_cache_raise_budget(&cache, (ROOM + 1) * BYTES) == (ROOM + 1) * BYTES);
  insert(&cache, context, 1, false);
  CHECK(cs_cache_count(&cache).bytes == (ROOM + 1) * BYTES);
  CHECK(cs_cache_count(&cache).made == ROOM + 2);
  cs_cache_finish(&cache);
}

static void check_pins(celspan_context *context, bool shrinks_on_unpin) {
  cs_cache cache = make_cache(context, shrinks_on_unpin);
  item *pinned[2 * ROOM];
  cs_cache_init(&cache);
  for (uint64_t i = 0; i < 2 * ROOM; i++)
    pinned[i] = acquire(&cache, context, i);
  CHECK(cs_cache_count(&cache).bytes == 2 * ROOM * BYTES);
  cs_cache_trim(&cache);
  for (uint64_t i = 0; i < 2 * ROOM; i++) {
    CHECK(pinned[i]->value == 7 * i && is_kept(&cache, i));
    cs_cache_unpin(&cache, &pinned[i]->cached);
  }
  CHECK(cs_cache_count(&cache).bytes == (shrinks_on_unpin ? ROOM : 2 * ROOM) * BYTES);
  CHECK(is_kept(&cache, 0) == !shrinks_on_unpin && is_kept(&cache, 2 * ROOM - 1));
  cs_cache_unpin(&cache, &acquire(&cache, context, 99)->cached);
  CHECK(cs_cache_count(&cache).bytes == ROOM * BYTES);
  cs_cache_trim(&cache);
  CHECK(cs_cache_count(&cache).bytes == 0 && !is_kept(&cache, 99));
  cs_cache_finish(&cache);
}

/* If two threads make the same entry, the first to insert it wins; a discarded one is not
 * counted. */
static void check_twice(celspan_context *context) {
  cs_cache cache = make_cache(context, false);
  cs_cache_entry *first, *second;
  cs_cache_init(&cache);
  CHECK(cs_cache_create(&cache, context, key_of(5), BYTES, &first) == CELSPAN_OK);
  CHECK(cs_cache_create(&cache, context, key_of(5), BYTES, &second) == CELSPAN_OK);
  CHECK(!is_kept(&cache, 5) && cs_cache_count(&cache).bytes == 2 * BYTES);
  CHECK(cs_cache_insert(&cache, second, false) == second);
  CHECK(cs_cache_insert(&cache, first, true) == second && second->pins == 1);
  CHECK(cs_cache_count(&cache).bytes == BYTES);
  CHECK(cs_cache_create(&cache, context, key_of(6), BYTES, &first) == CELSPAN_OK);
  cs_cache_discard(&cache, first);
  CHECK(cs_cache_count(&cache).bytes == BYTES && cs_cache_count(&cache).made == 1);
  cs_cache_unpin(&cache, second);
  cs_cache_finish(&cache);
}

/* More entries than the initial number of buckets. */
static void check_many(celspan_context *context) {
  enum { MANY = 5000 };
  cs_cache cache = make_cache(context, false);
  cs_cache_init(&cache);
  cs_cache_raise_budget(&cache, MANY * BYTES);
  for (uint64_t i = 0; i < MANY; i++)
    insert(&cache, context, i, false);
  for (uint64_t i = 0; i < MANY; i++)
    CHECK(is_kept(&cache, i));
  cs_cache_trim(&cache);
  for (uint64_t i = 0; i < MANY; i++)
    CHECK(!is_kept(&cache, i));
  cs_cache_finish(&cache);
}

/* ---------------------------------------------------------------- several threads */

enum { THREADS = 8, ROUNDS = 50 };

typedef struct crowd {
  cs_cache *cache;
  celspan_context *context;
  maker maker;
  uint64_t number;
  atomic_int failed, wrong;
} crowd;

static void want(void *user, int worker, int32_t i) {
  crowd *c = user;
  celspan_context own;
  cs_cache_entry *cached;
  (void)worker, (void)i;
  cs_context_branch(&own, c->context);
  if (cs_cache_acquire(c->cache, &own, key_of(c->number), make, &c->maker, &cached) != CELSPAN_OK) {
    c->failed++;
    c->wrong += own.error[0] == '\0';
    return;
  }
  c->wrong += ((item *)cached)->value != 7 * c->number;
  cs_cache_unpin(c->cache, cached);
}

/* All want the same entry; if its maker fails, the next one that waits makes it. */
static void check_crowd(celspan_context *context, int fails) {
  cs_cache cache = make_cache(context, true);
  cs_cache_init(&cache);
  for (uint64_t number = 0; number < ROUNDS; number++) {
    crowd c = {.cache = &cache, .context = context, .number = number, .maker = {.fails = fails}};
    cs_thread_pool_run(THREADS, THREADS, want, &c);
    CHECK(c.failed == fails && c.wrong == 0 && c.maker.times == fails + 1 && c.maker.clashes == 0);
    CHECK(cs_cache_count(&cache).made == number + 1);
    CHECK(cs_cache_count(&cache).bytes <= ROOM * BYTES);
  }
  CHECK(cs_cache_count(&cache).found == ROUNDS * (uint64_t)(THREADS - 1 - fails));
  cs_cache_finish(&cache);
}

/* ---------------------------------------------------------------- shortage */

static void check_memory(void) {
  celspan_status status = CELSPAN_NO_MEMORY;
  for (size_t n = 1; status == CELSPAN_NO_MEMORY; n++) {
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    cs_cache cache = make_cache(context, true);
    maker m = {0};
    cs_cache_entry *cached;
    cs_cache_init(&cache);
    watch.allocations = 0;
    watch.fail_at = n;
    status = cs_cache_acquire(&cache, context, key_of(1), make, &m, &cached);
    CHECK(cs_cache_count(&cache).bytes == (status == CELSPAN_OK ? BYTES : 0));
    if (status == CELSPAN_OK)
      cs_cache_unpin(&cache, cached);
    cs_cache_finish(&cache);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(status == CELSPAN_OK);
}

/* ---------------------------------------------------------------- services */

static atomic_int services;

static celspan_status create_service(celspan_context *context, cs_service **out) {
  *out = cs_mem_array(context->memory, 1, sizeof(cs_service));
  atomic_fetch_add(&services, *out != NULL);
  return *out ? CELSPAN_OK : cs_fail_memory(context);
}

static celspan_context *owner;

static void destroy_service(cs_service *service) {
  atomic_fetch_sub(&services, 1);
  cs_mem_free(owner->memory, service, sizeof *service);
}

static void trim_service(cs_service *service) { (void)service; }

static const cs_service_kind KINDS[] = {{create_service, destroy_service, trim_service},
                                        {create_service, destroy_service, trim_service}};

static void find_services(void *user, int worker, int32_t i) {
  cs_service **found = user;
  (void)worker;
  if (cs_context_service(owner, &KINDS[i % 2], &found[i]) != CELSPAN_OK)
    found[i] = NULL;
}

static void check_services(void) {
  cs_service *found[THREADS];
  CHECK(celspan_context_create(NULL, &owner) == CELSPAN_OK);
  CHECK(!cs_context_find_service(owner, &KINDS[0]));
  cs_thread_pool_run(THREADS, THREADS, find_services, found);
  for (int i = 0; i < THREADS; i++)
    CHECK(found[i] && found[i] == cs_context_find_service(owner, &KINDS[i % 2]) &&
          found[i]->kind == &KINDS[i % 2]);
  CHECK(services == 2);
  celspan_context_destroy(owner);
  CHECK(services == 0);
}

int main(void) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  check_order(context);
  check_pins(context, false);
  check_pins(context, true);
  check_twice(context);
  check_many(context);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  size_t bytes, peak;
  uint64_t allocations;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  celspan_context_memory(context, &bytes, &peak, &allocations);
  size_t before = bytes;
  for (int fails = 0; fails <= 3; fails++)
    check_crowd(context, fails);
  celspan_context_memory(context, &bytes, &peak, &allocations);
  CHECK(bytes == before);
  celspan_context_destroy(context);
  check_memory();
  check_services();
  return check_done();
}
