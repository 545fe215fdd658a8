/* Counted values: a value is made with one reference, and dropping the last one frees it. Any
 * thread may keep and drop references; the thread that drops the last one sees all that others have
 * done.
 *
 *   static void destroy(celspan_cel *cel)       frees what the cel holds, and then the cel
 *   CS_COUNTED(celspan_cel)                     celspan_cel_ref and celspan_cel_unref
 *
 * INVARIANT: the count of a value, its field `references`, changes here only.
 */
#pragma once

#include "base/context.h"

static inline void cs_counted_keep(atomic_size_t *references) {
  atomic_fetch_add_explicit(references, 1, memory_order_relaxed);
}

/* Returns whether this was the last reference. */
static inline bool cs_counted_drop(atomic_size_t *references) {
  return atomic_fetch_sub_explicit(references, 1, memory_order_acq_rel) == 1;
}

static inline celspan_status cs_counted_begin(atomic_size_t *references, cs_memory **own,
                                              cs_memory *memory) {
  atomic_init(references, 1);
  *own = cs_memory_ref(memory);
  return CELSPAN_OK;
}

/* Makes a value of zeros, with one reference, and with a reference to its memory in its field
 * `memory`. Errors: NO_MEMORY. */
#define CS_COUNTED_MAKE(context, value)                                                            \
  (CS_MAKE(context, value, 1) == CELSPAN_OK                                                        \
       ? cs_counted_begin(&(value)->references, &(value)->memory, (context)->memory)               \
       : CELSPAN_NO_MEMORY)

/* Frees a value that has a reference to its memory. */
static inline void cs_counted_free(cs_memory *memory, void *value, size_t size) {
  cs_mem_free(memory, value, size);
  cs_memory_unref(memory);
}

/* Defines TYPE_ref and TYPE_unref, where NULL is ignored, by the file's function `destroy`. */
#define CS_COUNTED(type)                                                                           \
  type *type##_ref(type *value) {                                                                  \
    if (value)                                                                                     \
      cs_counted_keep(&value->references);                                                         \
    return value;                                                                                  \
  }                                                                                                \
                                                                                                   \
  void type##_unref(type *value) {                                                                 \
    if (value && cs_counted_drop(&value->references))                                              \
      destroy(value);                                                                              \
  }
