/* A context's memory function that records the peak, and refuses allocations beyond a bound. */
#pragma once

#include "tests/support/memory.h"

typedef struct meter {
  memory_watch watch;
  size_t peak, limit; /* bytes */
} meter;

static inline void *meter_resize(void *user, void *block, size_t old_size, size_t new_size) {
  meter *m = user;
  if (new_size > m->limit - m->watch.bytes)
    return NULL;
  void *made = memory_watch_resize(&m->watch, block, old_size, new_size);
  m->peak = m->watch.bytes > m->peak ? m->watch.bytes : m->peak;
  return made;
}

/* NULL if even the context cannot be allocated. */
static inline celspan_context *meter_context(meter *m) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  celspan_context *context = NULL;
  desc.resize = meter_resize;
  desc.resize_user = m;
  return celspan_context_create(&desc, &context) == CELSPAN_OK ? context : NULL;
}

/* To be called after everything was released. */
static inline void meter_close(const meter *m) {
  demand(m->watch.blocks == 0 && m->watch.size_errors == 0,
         "memory is kept, or its size forgotten");
}
