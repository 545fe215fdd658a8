/* base/hash_table.c: it finds the keys that were added, even where keys share a slot, and is
 * unchanged after a lack of memory. */
#include "base/hash_table.h"

#include "tests/support/check.h"
#include "tests/support/memory.h"

enum { KEYS = 1000 };

/* Every eighth key begins its search at one slot. */
static cs_hash key_of(size_t i) {
  return (cs_hash){i % 8 ? i * UINT64_C(0x9e3779b97f4a7c15) : 7, i};
}

static void check_all(const cs_hash_table *table, size_t count, size_t added) {
  size_t found = 0, number = 0;
  for (size_t i = 0; i < count; i++)
    found += cs_hash_table_find(table, key_of(i), &number) && number == i + added;
  CHECK(found == count);
  CHECK(!cs_hash_table_find(table, key_of(count), &number));
}

static void check_keys(celspan_context *context) {
  cs_hash_table table = {.count = 0};
  check_all(&table, 0, 0);
  for (size_t i = 0; i < KEYS; i++)
    CHECK(cs_hash_table_add(&table, context, key_of(i), i) == CELSPAN_OK);
  check_all(&table, KEYS, 0);
  for (size_t i = 0; i < KEYS; i++)
    CHECK(cs_hash_table_add(&table, context, key_of(i), i + 3) == CELSPAN_OK);
  check_all(&table, KEYS, 3);
  CHECK(table.count == KEYS);
  cs_hash_table_finish(&table, context);
}

static void check_memory(celspan_context *context, memory_watch *watch) {
  cs_hash_table table = {.count = 0};
  size_t count = 0;
  while (count < 100) {
    watch->fail_at = watch->allocations + 1;
    celspan_status status = cs_hash_table_add(&table, context, key_of(count), count);
    watch->fail_at = 0;
    check_all(&table, status == CELSPAN_OK ? count + 1 : count, 0);
    if (status != CELSPAN_OK)
      CHECK(cs_hash_table_add(&table, context, key_of(count), count) == CELSPAN_OK);
    count++;
  }
  cs_hash_table_finish(&table, context);
}

int main(void) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  check_keys(context);
  check_memory(context, &watch);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
