/* A memory hook for tests: counts allocated bytes, checks the sizes passed to it, and can make the
 * n-th allocation fail, once or with all that follow. Threads may share one. */
#pragma once

#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "celspan/celspan.h"

typedef struct memory_watch {
  atomic_size_t blocks, bytes;
  atomic_size_t size_errors; /* blocks that were resized or freed with a wrong size */
  atomic_size_t allocations; /* the number of allocations so far, including failed ones */
  size_t fail_at;            /* the allocation of this number fails, counted from 1; 0: none */
  bool is_for_good;          /* all later allocations fail, too */
} memory_watch;

typedef union memory_header {
  size_t size;
  max_align_t align;
} memory_header;

static inline void *memory_watch_resize(void *user, void *block, size_t old_size, size_t new_size) {
  memory_watch *watch = user;
  memory_header *header = block ? (memory_header *)block - 1 : NULL;
  if (header && header->size != old_size)
    watch->size_errors++;
  if (new_size > 0) {
    size_t n = ++watch->allocations;
    if (n == watch->fail_at || (watch->is_for_good && watch->fail_at && n > watch->fail_at))
      return NULL;
  }
  watch->blocks += (new_size > 0) - (size_t)(block != NULL);
  watch->bytes += new_size - (header ? header->size : 0);
  if (header && new_size == 0)
    explicit_bzero(header, sizeof *header + header->size); /* makes reads after free fail */
  if (new_size == 0) {
    free(header);
    return NULL;
  }
  header = realloc(header, sizeof *header + new_size);
  header->size = new_size;
  return header + 1;
}

static inline celspan_context *memory_watch_context(memory_watch *watch) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = watch;
  celspan_context *context = NULL;
  return celspan_context_create(&desc, &context) == CELSPAN_OK ? context : NULL;
}
