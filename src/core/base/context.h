/* Memory, errors and the context that carries both.
 *
 * Every allocation goes through cs_mem_resize. Its callers give the old size and the new one, so
 * the number of allocated bytes is known at any moment. A context belongs to one thread; workers
 * get a branch of it, which has an error text of its own and shares the memory. All failures pass
 * through cs_fail, which makes it a natural breakpoint.
 */
#pragma once

#include <stdatomic.h>

#include "base/ceiling.h"
#include "base/spares.h"
#include "celspan/celspan.h"

/* The purpose for which a thread allocates. Memory for frames that a script renders counts for the
 * script. */
typedef enum cs_account_kind {
  CS_ACCOUNT_NONE,
  CS_ACCOUNT_SCRIPT,
  CS_ACCOUNT_RENDERING
} cs_account_kind;

typedef struct cs_account {
  cs_account_kind kind;
  cs_refusal refusal; /* for the last allocation that was larger than its predecessor */
} cs_account;

/* Shared by a context, its branches and every value made in it; counted, because scene values may
 * outlive their context. */
typedef struct cs_memory {
  celspan_resize resize;
  void *user;
  /* used if the host has no function of its own; kept bytes do not count as held */
  cs_spares spares;
  atomic_size_t references;
  atomic_size_t bytes;
  atomic_size_t peak;
  atomic_uint_fast64_t allocations;
  atomic_size_t kept;      /* bytes of caches */
  atomic_size_t rendering; /* other bytes of the frames that are rendered now */
  atomic_uint renders;     /* the number of frames that are rendered now */
  atomic_size_t beside;    /* bytes of the host, such as Lua's; not in `bytes` */
  size_t most_rendering;   /* the limit of `rendering`; 0: no limit */
  cs_ceiling *ceiling;     /* the ceiling of `bytes` and `beside` together; NULL: none; borrowed */
  /* Returns the account of this thread, which the host keeps; NULL: threads have no accounts. This
   * and the next two members are set before other threads use the memory. */
  cs_account *(*account)(void);
  struct cs_source *sources; /* files in which values were made; owned */
  /* Returns whether this thread may not have `more` further bytes; NULL: it has no limit. Set
   * before other threads use the memory. */
  bool (*refuses)(const struct cs_memory *memory, size_t more);
} cs_memory;

/* A service is something that a higher folder keeps for a context, such as decoded pictures;
 * cs_service is the first member of its structure. A context has at most one service of a kind,
 * which is made on first use and destroyed with the context. */
typedef struct cs_service cs_service;
typedef struct cs_service_kind {
  celspan_status (*create)(celspan_context *context, cs_service **out);
  void (*destroy)(cs_service *service);
  /* Frees memory that is not in use; any thread. NULL: all is in use. */
  void (*trim)(cs_service *service);
} cs_service_kind;

struct cs_service {
  const cs_service_kind *kind;
  cs_service *next;
};

enum { CS_ERROR_SIZE = 1024 }; /* bytes of the sentence that describes a failure */

typedef struct cs_mark { /* see base/mark.h */
  struct cs_text *name;  /* NULL: none */
  const char *source;    /* NULL: not known; else the memory's */
  int32_t line;          /* the line of the source, from 1; 0: not known */
  /* the lines that called this line: a number that the host gives; 0: not known */
  uint32_t callers;
} cs_mark;

struct celspan_context {
  cs_memory *memory;
  celspan_context *root;          /* itself, or the context it was branched from */
  _Atomic(cs_service *) services; /* root only; owned; grows at its head, by any thread */
  size_t picture_bytes, defocus_bytes, map_bytes, held_bytes;
  cs_mark origin; /* where values are made now; its source is kept while the line is 0 */
  const struct cs_picture_module *picture_module; /* root only; NULL: it is loaded on first use */
  const struct cs_colour_module *colour_module;   /* the same for colour profiles */
  const char *maker;     /* root only; borrowed; NULL: see cs_context_maker */
  atomic_int processors; /* root only; see cs_context_workers; 0: not counted yet */
  int forced_way;        /* root only; of tests: a cs_ways_forced (frames/render/ways.h) */
  /* gets the contents of each file when it is completed; NULL: not wanted */
  struct cs_file_contents *contents;
  char error[CS_ERROR_SIZE];
};

/* The program that makes files, as their headers name it: the host, or "celspan" with its
 * version. */
const char *cs_context_maker(const celspan_context *context);

cs_memory *cs_memory_ref(cs_memory *memory);
void cs_memory_unref(cs_memory *memory);

/* Sets the account of this thread, and returns the previous one. A thread that works for another
 * thread uses the account of that thread. */
cs_account_kind cs_account_set(const cs_memory *memory, cs_account_kind kind);
cs_account_kind cs_account_of(const cs_memory *memory);
/* Must be called when the rendering of a frame begins. Returns the previous account, for
 * cs_account_end_rendering. */
cs_account_kind cs_account_begin_rendering(cs_memory *memory);
void cs_account_end_rendering(cs_memory *memory, cs_account_kind before);
/* Must be called when a cache begins to keep allocated bytes, or gives them up in order to free
 * them. */
void cs_account_keep(cs_memory *memory, size_t bytes);
void cs_account_give_up(cs_memory *memory, size_t bytes);
/* Whether a host may allocate `more` bytes for itself. A limit of all held bytes may refuse them;
 * the account of the thread then says so. The host counts the bytes in `beside`. */
bool cs_account_allows(cs_memory *memory, size_t more);
void cs_account_beside(cs_memory *memory, size_t change);
/* All held bytes, including those of the host. */
size_t cs_account_bytes(const cs_memory *memory);
/* Whether the limit of all held bytes refused the last allocation of this thread. The text says
 * why, as the end of a sentence. */
bool cs_account_tell(const cs_memory *memory, char *text, size_t size);
/* Bytes of scripts and scenes: neither kept by caches nor used to render a frame. */
size_t cs_account_scene_bytes(const cs_memory *memory);

/* Allocates, resizes or (new_size 0) frees; NULL if there is no memory. Any thread. It does not
 * record an error: callers that return a status use cs_fail_memory. */
void *cs_mem_resize(cs_memory *memory, void *storage, size_t old_size, size_t new_size);
/* The same for other libraries. user: a cs_memory. */
void *cs_mem_resize_of(void *user, void *storage, size_t old_size, size_t new_size);
void cs_mem_free(cs_memory *memory, void *storage, size_t size);
/* count items of item_size bytes, zeroed. NULL on overflow, without memory, and for count 0. */
void *cs_mem_array(cs_memory *memory, size_t count, size_t item_size);
/* The same into *items. Errors: NO_MEMORY, also for count 0; *items is then NULL. */
CELSPAN_CHECKED celspan_status cs_mem_make(celspan_context *context, void **items, size_t count,
                                           size_t item_size);
/* cs_mem_make for a typed array or a value, a variable. */
#define CS_MAKE(context, items, count)                                                             \
  cs_mem_make(context, (void **)&(items), count, sizeof *(items))

/* Doubles *items, an array of *capacity items, until it has room for `needed` items; its contents
 * are kept. Errors: NO_MEMORY; *items is then unchanged. */
CELSPAN_CHECKED celspan_status cs_mem_grow(celspan_context *context, void **items, size_t *capacity,
                                           size_t needed, size_t item_size);
static inline CELSPAN_CHECKED celspan_status cs_mem_reserve(celspan_context *context, void **items,
                                                            size_t *capacity, size_t needed,
                                                            size_t item_size) {
  return needed <= *capacity ? CELSPAN_OK
                             : cs_mem_grow(context, items, capacity, needed, item_size);
}

/* cs_mem_reserve for a typed array, `items`, and its capacity, both variables. */
#define CS_RESERVE(context, items, capacity, needed)                                               \
  cs_mem_reserve(context, (void **)&(items), &(capacity), needed, sizeof *(items))

/* Appends an item, the last argument, to a typed array. Errors: NO_MEMORY. */
#define CS_APPEND(context, items, count, capacity, ...)                                            \
  (CS_RESERVE(context, items, capacity, (count) + 1) == CELSPAN_OK                                 \
       ? ((items)[(count)++] = (__VA_ARGS__), CELSPAN_OK)                                          \
       : CELSPAN_NO_MEMORY)

/* Records the sentence that format describes, and returns status. */
celspan_status cs_fail(celspan_context *context, celspan_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
celspan_status cs_fail_memory(celspan_context *context);

/* celspan_context_create of a whole description. */
CELSPAN_CHECKED celspan_status cs_context_make(const celspan_context_desc *desc,
                                               celspan_context **out);
/* Makes *branch a context for a worker thread: it shares the memory of `from` and has an error text
 * of its own. It is not counted and must not outlive `from`. */
void cs_context_branch(celspan_context *branch, celspan_context *from);

/* The service of a kind, which is created if it does not exist yet. Any thread. Errors: those of
 * create. */
CELSPAN_CHECKED celspan_status cs_context_service(celspan_context *context,
                                                  const cs_service_kind *kind, cs_service **out);
/* The same, but NULL if it does not exist yet. Any thread. */
cs_service *cs_context_find_service(const celspan_context *context, const cs_service_kind *kind);
/* Frees everything that is only kept for later frames. Any thread. */
void cs_context_trim(celspan_context *context);
/* The number of threads for a number that is wanted; 0 or less: one for each processor that this
 * process may use, which are counted once for a context. At most `most`. Any thread. */
int cs_context_workers(celspan_context *context, int64_t wanted, int most);

#define CS_TRY(call)                                                                               \
  do {                                                                                             \
    celspan_status try_status_ = (call);                                                           \
    if (try_status_ != CELSPAN_OK)                                                                 \
      return try_status_;                                                                          \
  } while (0)

/* The end of a function that makes a value: *out is the value after a success; after a failure the
 * value is released. Its result is the status. */
#define CS_GIVE(status, value, release, out)                                                       \
  ((status) == CELSPAN_OK ? (void)(*(out) = (value)) : release(value), (status))
