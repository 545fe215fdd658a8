/* base/arrays.c: arrays of a structure get exactly the room that was asked for, keep their
 * contents, are freed together, and are unchanged after a lack of memory. */
#include "base/arrays.h"

#include "tests/support/check.h"
#include "tests/support/memory.h"

typedef struct owner {
  size_t before;
  CS_ARRAY(uint32_t, numbers);
  CS_ARRAY(float[4], colours);
  CS_ARRAY(const char *, names);
  size_t behind;
} owner;

enum { MANY = 1000 };

static size_t bytes_of(const celspan_context *context) {
  return atomic_load(&context->memory->bytes);
}

static void check_counted(const owner *o) {
  bool is_counted = true;
  for (uint32_t i = 0; i < MANY; i++)
    is_counted &= o->numbers[i] == i;
  CHECK(is_counted);
}

static void check_room(celspan_context *context) {
  owner o = {.before = 7, .behind = 9};
  size_t count = 0, empty = bytes_of(context);
  CHECK(CS_ARRAY_MAKE(context, o.colours, 0) == CELSPAN_OK && !o.colours);
  CHECK(CS_ARRAY_RESERVE(context, o.colours, 0) == CELSPAN_OK && !o.colours);
  CHECK(CS_ARRAY_FIT(context, o.colours, 0) == CELSPAN_OK && !o.colours);
  CHECK(CS_ARRAYS_BYTES(&o, numbers, names) == 0);
  for (uint32_t i = 0; i < MANY; i++)
    CHECK(CS_ARRAY_APPEND(context, o.numbers, count, i) == CELSPAN_OK);
  CHECK(count == MANY && o.numbers_room.capacity >= MANY);
  CHECK(CS_ARRAY_FIT(context, o.numbers, MANY) == CELSPAN_OK);
  check_counted(&o);
  CHECK(CS_ARRAY_FIT(context, o.colours, 3) == CELSPAN_OK);
  CHECK(CS_ARRAY_MAKE(context, o.names, 5) == CELSPAN_OK && !o.names[0] && !o.names[4]);
  size_t bytes = MANY * sizeof(uint32_t) + 3 * sizeof(float[4]) + 5 * sizeof(char *);
  CHECK(CS_ARRAYS_BYTES(&o, numbers, names) == bytes && bytes_of(context) == empty + bytes);
  CS_ARRAYS_FREE(context->memory, &o, numbers, colours);
  CHECK(!o.numbers && !o.colours && o.names && o.before == 7 && o.behind == 9);
  CHECK(CS_ARRAY_MAKE(context, o.names, 2) == CELSPAN_OK);
  CHECK(bytes_of(context) == empty + 2 * sizeof(char *));
  CHECK(CS_ARRAY_FIT(context, o.names, 0) == CELSPAN_OK && !o.names);
  CS_ARRAYS_FREE(context->memory, &o, numbers, names);
  CHECK(bytes_of(context) == empty);
}

static void check_lack(celspan_context *context, memory_watch *watch) {
  owner o = {.before = 0};
  size_t count = 0;
  for (uint32_t i = 0; i < MANY; i++)
    CHECK(CS_ARRAY_APPEND(context, o.numbers, count, i) == CELSPAN_OK);
  size_t capacity = o.numbers_room.capacity;
  watch->fail_at = watch->allocations + 1;
  CHECK(CS_ARRAY_RESERVE(context, o.numbers, capacity + 1) == CELSPAN_NO_MEMORY);
  watch->fail_at = watch->allocations + 1;
  CHECK(CS_ARRAY_FIT(context, o.numbers, capacity + 1) == CELSPAN_NO_MEMORY);
  watch->fail_at = watch->allocations + 1;
  CHECK(CS_ARRAY_FIT(context, o.numbers, MANY) == CELSPAN_OK);
  watch->fail_at = 0;
  CHECK(CS_ARRAY_RESERVE(context, o.numbers, SIZE_MAX / 4) == CELSPAN_NO_MEMORY);
  CHECK(CS_ARRAY_FIT(context, o.numbers, SIZE_MAX / 4) == CELSPAN_NO_MEMORY);
  check_counted(&o);
  CHECK(CS_ARRAY_MAKE(context, o.numbers, SIZE_MAX / 4) == CELSPAN_NO_MEMORY && !o.numbers);
  watch->fail_at = watch->allocations + 1;
  CHECK(CS_ARRAY_MAKE(context, o.names, 5) == CELSPAN_NO_MEMORY && !o.names);
  watch->fail_at = 0;
  CS_ARRAYS_FREE(context->memory, &o, numbers, names);
}

int main(void) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  check_room(context);
  check_lack(context, &watch);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
