#include "base/context.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/machine.h"

#define ORIGIN_SIZE 255   /* bytes of a source that are kept */
#define ORIGIN_COUNT 4096 /* sources that are kept */

/* A file in which values were made. It lives as long as the memory, and therefore at least as long
 * as any value: it needs no reference count, which every value would have to change. */
typedef struct cs_source {
  struct cs_source *next;
  size_t size; /* the size of the whole structure */
  char bytes[];
} cs_source;

/* ---------------------------------------------------------------- memory */

/* The spares free the memory that contains them, and must not keep it. */
static_assert(sizeof(cs_memory) <= CS_SPARES_SMALLEST / 2, "cs_memory has a class");

/* resize: NULL for the C library's. */
static cs_memory *memory_create(celspan_resize resize, void *user) {
  cs_memory *memory = resize ? resize(user, NULL, 0, sizeof *memory) : malloc(sizeof *memory);
  if (!memory)
    return NULL;
  memory->resize = resize ? resize : cs_spares_resize;
  memory->user = resize ? user : &memory->spares;
  if (!cs_spares_init(&memory->spares)) {
    memory->resize(memory->user, memory, sizeof *memory, 0);
    return NULL;
  }
  atomic_init(&memory->references, 1);
  atomic_init(&memory->bytes, 0);
  atomic_init(&memory->peak, 0);
  atomic_init(&memory->allocations, 0);
  atomic_init(&memory->kept, 0);
  atomic_init(&memory->rendering, 0);
  atomic_init(&memory->renders, 0);
  atomic_init(&memory->beside, 0);
  memory->most_rendering = 0;
  memory->ceiling = NULL;
  memory->account = NULL;
  memory->sources = NULL;
  memory->refuses = NULL;
  return memory;
}

cs_memory *cs_memory_ref(cs_memory *memory) {
  atomic_fetch_add_explicit(&memory->references, 1, memory_order_relaxed);
  return memory;
}

void cs_memory_unref(cs_memory *memory) {
  if (atomic_fetch_sub_explicit(&memory->references, 1, memory_order_acq_rel) != 1)
    return;
  for (cs_source *source = memory->sources, *next; source; source = next) {
    next = source->next;
    memory->resize(memory->user, source, source->size, 0);
  }
  cs_spares_finish(&memory->spares);
  memory->resize(memory->user, memory, sizeof *memory, 0);
}

/* ---------------------------------------------------------------- accounts */

cs_account_kind cs_account_of(const cs_memory *memory) {
  return memory->account ? memory->account()->kind : CS_ACCOUNT_NONE;
}

cs_account_kind cs_account_set(const cs_memory *memory, cs_account_kind kind) {
  cs_account_kind before = cs_account_of(memory);
  if (memory->account)
    memory->account()->kind = kind;
  return before;
}

cs_account_kind cs_account_begin_rendering(cs_memory *memory) {
  cs_account_kind before = cs_account_of(memory);
  atomic_fetch_add(&memory->renders, 1);
  if (before == CS_ACCOUNT_NONE)
    cs_account_set(memory, CS_ACCOUNT_RENDERING);
  return before;
}

/* A block may be freed on another account than it was allocated on. Such differences end when no
 * frame is rendered. */
void cs_account_end_rendering(cs_memory *memory, cs_account_kind before) {
  cs_account_set(memory, before);
  if (atomic_fetch_sub(&memory->renders, 1) == 1)
    atomic_store(&memory->rendering, 0);
}

static void count_rendering(cs_memory *memory, size_t change) {
  if (cs_account_of(memory) == CS_ACCOUNT_RENDERING)
    atomic_fetch_add_explicit(&memory->rendering, change, memory_order_relaxed);
}

void cs_account_keep(cs_memory *memory, size_t bytes) {
  atomic_fetch_add_explicit(&memory->kept, bytes, memory_order_relaxed);
  count_rendering(memory, 0 - bytes);
}

void cs_account_give_up(cs_memory *memory, size_t bytes) {
  atomic_fetch_sub_explicit(&memory->kept, bytes, memory_order_relaxed);
  count_rendering(memory, bytes);
}

/* An unsigned value that stands for a number below 0 counts as 0. */
static size_t rendering_bytes(const cs_memory *memory) {
  size_t bytes = atomic_load_explicit(&memory->rendering, memory_order_relaxed);
  return bytes > SIZE_MAX / 2 ? 0 : bytes;
}

size_t cs_account_scene_bytes(const cs_memory *memory) {
  size_t all = atomic_load_explicit(&memory->bytes, memory_order_relaxed);
  size_t apart =
      atomic_load_explicit(&memory->kept, memory_order_relaxed) + rendering_bytes(memory);
  return all > apart ? all - apart : 0;
}

static cs_refusal refuses_rendering(const cs_memory *memory, size_t more) {
  size_t most = memory->most_rendering;
  if (!most || cs_account_of(memory) != CS_ACCOUNT_RENDERING)
    return CS_REFUSAL_NONE;
  bool is_refused = more > most || rendering_bytes(memory) > most - more;
  return is_refused ? CS_REFUSAL_RENDERING : CS_REFUSAL_NONE;
}

size_t cs_account_bytes(const cs_memory *memory) {
  return atomic_load_explicit(&memory->bytes, memory_order_relaxed) +
         atomic_load_explicit(&memory->beside, memory_order_relaxed);
}

void cs_account_beside(cs_memory *memory, size_t change) {
  atomic_fetch_add_explicit(&memory->beside, change, memory_order_relaxed);
}

bool cs_account_allows(cs_memory *memory, size_t more) {
  cs_refusal refusal = refuses_rendering(memory, more);
  if (!refusal && memory->ceiling)
    refusal = cs_ceiling_refuses(memory->ceiling, cs_account_bytes(memory), more);
  if (memory->account)
    memory->account()->refusal = refusal;
  return !refusal;
}

bool cs_account_tell(const cs_memory *memory, char *text, size_t size) {
  cs_refusal refusal = memory->account ? memory->account()->refusal : CS_REFUSAL_NONE;
  if (!memory->ceiling || refusal < CS_REFUSAL_HELD)
    return false;
  cs_ceiling_tell(memory->ceiling, refusal, text, size);
  return true;
}

/* ---------------------------------------------------------------- allocating */

static void count_bytes(cs_memory *memory, size_t old_size, size_t new_size) {
  size_t now =
      atomic_fetch_add_explicit(&memory->bytes, new_size - old_size, memory_order_relaxed) +
      (new_size - old_size);
  size_t peak = atomic_load_explicit(&memory->peak, memory_order_relaxed);
  while (now > peak && !atomic_compare_exchange_weak_explicit(
                           &memory->peak, &peak, now, memory_order_relaxed, memory_order_relaxed)) {
  }
}

void *cs_mem_resize(cs_memory *memory, void *storage, size_t old_size, size_t new_size) {
  size_t more = new_size - (storage ? old_size : 0);
  bool grows = new_size > (storage ? old_size : 0);
  if (grows && memory->refuses && memory->refuses(memory, more))
    return NULL;
  if (grows && !cs_account_allows(memory, more))
    return NULL;
  void *resized = memory->resize(memory->user, storage, old_size, new_size);
  if (!resized && new_size > 0)
    return NULL;
  if (new_size > 0)
    atomic_fetch_add_explicit(&memory->allocations, 1, memory_order_relaxed);
  count_bytes(memory, storage ? old_size : 0, new_size);
  count_rendering(memory, more);
  return resized;
}

void *cs_mem_resize_of(void *user, void *storage, size_t old_size, size_t new_size) {
  return cs_mem_resize(user, storage, old_size, new_size);
}

void cs_mem_free(cs_memory *memory, void *storage, size_t size) {
  if (storage)
    cs_mem_resize(memory, storage, size, 0);
}

void *cs_mem_array(cs_memory *memory, size_t count, size_t item_size) {
  size_t size;
  if (count == 0 || __builtin_mul_overflow(count, item_size, &size))
    return NULL;
  void *items = cs_mem_resize(memory, NULL, 0, size);
  return items ? memset(items, 0, size) : NULL;
}

celspan_status cs_mem_make(celspan_context *context, void **items, size_t count, size_t item_size) {
  *items = cs_mem_array(context->memory, count, item_size);
  return *items ? CELSPAN_OK : cs_fail_memory(context);
}

celspan_status cs_mem_grow(celspan_context *context, void **items, size_t *capacity, size_t needed,
                           size_t item_size) {
  size_t wanted = *capacity < 16 ? 16 : *capacity, size;
  while (wanted < needed)
    if (__builtin_mul_overflow(wanted, (size_t)2, &wanted))
      return cs_fail_memory(context);
  if (__builtin_mul_overflow(wanted, item_size, &size))
    return cs_fail_memory(context);
  void *grown = cs_mem_resize(context->memory, *items, *capacity * item_size, size);
  if (!grown)
    return cs_fail_memory(context);
  *items = grown;
  *capacity = wanted;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- errors */

const char *celspan_status_name(celspan_status status) {
  static const char *const names[] = {
      [CELSPAN_OK] = "ok",
      [CELSPAN_NO_MEMORY] = "no memory",
      [CELSPAN_BAD_ARGUMENT] = "bad argument",
      [CELSPAN_LIMIT] = "limit",
      [CELSPAN_INPUT] = "input",
      [CELSPAN_OUTPUT] = "output",
      [CELSPAN_CALLBACK] = "callback",
      [CELSPAN_CANCELLED] = "cancelled",
      [CELSPAN_INTERNAL] = "internal error",
  };
  return (unsigned)status < sizeof names / sizeof *names ? names[status] : "unknown status";
}

__attribute__((format(printf, 3, 0))) static celspan_status
fail(celspan_context *context, celspan_status status, const char *format, va_list arguments) {
  vsnprintf(context->error, sizeof context->error, format, arguments);
  return status;
}

celspan_status cs_fail(celspan_context *context, celspan_status status, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fail(context, status, format, arguments);
  va_end(arguments);
  return status;
}

celspan_status celspan_context_fail(celspan_context *context, celspan_status status,
                                    const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fail(context, status, format, arguments);
  va_end(arguments);
  return status;
}

celspan_status cs_fail_memory(celspan_context *context) {
  const cs_memory *memory = context->memory;
  char reason[256];
  if (cs_account_tell(memory, reason, sizeof reason))
    return cs_fail(context, CELSPAN_NO_MEMORY, "out of memory: %s", reason);
  if (memory->account && memory->account()->refusal == CS_REFUSAL_RENDERING)
    return cs_fail(context, CELSPAN_NO_MEMORY,
                   "out of memory: rendering needs more than %zu MiB (--limit "
                   "render-memory=SIZE allows more)",
                   memory->most_rendering >> 20);
  return cs_fail(context, CELSPAN_NO_MEMORY, "out of memory (%zu bytes are held)",
                 atomic_load_explicit(&memory->bytes, memory_order_relaxed));
}

/* ---------------------------------------------------------------- context */

celspan_status cs_context_make(const celspan_context_desc *desc, celspan_context **out) {
  cs_memory *memory = memory_create(desc->resize, desc->resize_user);
  if (!memory)
    return CELSPAN_NO_MEMORY;
  celspan_context *context = cs_mem_array(memory, 1, sizeof *context);
  if (!context) {
    cs_memory_unref(memory);
    return CELSPAN_NO_MEMORY;
  }
  context->memory = memory;
  context->root = context;
  context->picture_bytes = desc->picture_bytes;
  context->map_bytes = desc->defocus_bytes / 4;
  /* the rest is for outlines (model/stroke/kept.h) */
  context->held_bytes = desc->defocus_bytes / 8;
  context->defocus_bytes =
      desc->defocus_bytes - context->map_bytes - context->map_bytes / 8 - context->held_bytes;
  *out = context;
  return CELSPAN_OK;
}

void celspan_context_destroy(celspan_context *context) {
  if (!context)
    return;
  for (cs_service *service = atomic_load(&context->services), *next; service; service = next) {
    next = service->next;
    service->kind->destroy(service);
  }
  cs_memory *memory = context->memory;
  cs_mem_free(memory, context, sizeof *context);
  cs_spares_close(&memory->spares); /* values may live much longer, and render nothing */
  cs_memory_unref(memory);
}

/* The source of this name, which is stored if it is new and there is room for it; otherwise
 * NULL. */
static const char *find_source(cs_memory *memory, const char *name, size_t length) {
  size_t count = 0, size = sizeof(cs_source) + length + 1;
  for (const cs_source *at = memory->sources; at; at = at->next, count++)
    if (strncmp(at->bytes, name, length) == 0 && at->bytes[length] == 0)
      return at->bytes;
  cs_source *source = count < ORIGIN_COUNT ? cs_mem_resize(memory, NULL, 0, size) : NULL;
  if (!source)
    return NULL;
  source->next = memory->sources;
  source->size = size;
  memcpy(source->bytes, name, length);
  source->bytes[length] = 0;
  memory->sources = source;
  return source->bytes;
}

void celspan_context_set_origin(celspan_context *context, const char *source, int32_t line) {
  cs_mark *at = &context->origin;
  at->line = source && line > 0 ? line : 0;
  at->callers = 0;
  if (at->line == 0 || (at->source && strcmp(at->source, source) == 0))
    return;
  size_t length = strlen(source);
  at->source = find_source(context->memory, source, length < ORIGIN_SIZE ? length : ORIGIN_SIZE);
  if (!at->source)
    at->line = 0;
}

const char *celspan_context_error(const celspan_context *context) {
  return context ? context->error
                 : "there is no context: celspan_context_create makes one, and celspan_lua_open "
                   "opens celspan in a Lua state";
}

void celspan_context_memory(const celspan_context *context, size_t *bytes, size_t *peak_bytes,
                            uint64_t *allocations) {
  const cs_memory *memory = context->memory;
  *bytes = atomic_load_explicit(&memory->bytes, memory_order_relaxed);
  *peak_bytes = atomic_load_explicit(&memory->peak, memory_order_relaxed);
  *allocations = atomic_load_explicit(&memory->allocations, memory_order_relaxed);
}

void cs_context_branch(celspan_context *branch, celspan_context *from) {
  *branch = (celspan_context){.memory = from->memory,
                              .root = from->root,
                              .picture_bytes = from->picture_bytes,
                              .defocus_bytes = from->defocus_bytes,
                              .map_bytes = from->map_bytes,
                              .held_bytes = from->held_bytes};
}

/* ---------------------------------------------------------------- services */

static cs_service *find_service(cs_service *service, const cs_service_kind *kind) {
  while (service && service->kind != kind)
    service = service->next;
  return service;
}

cs_service *cs_context_find_service(const celspan_context *context, const cs_service_kind *kind) {
  return find_service(atomic_load_explicit(&context->root->services, memory_order_acquire), kind);
}

/* Another thread may create the same service meanwhile and add it first. In this case its service
 * is used, and this one is destroyed. */
celspan_status cs_context_service(celspan_context *context, const cs_service_kind *kind,
                                  cs_service **out) {
  celspan_context *root = context->root;
  cs_service *made, *head = atomic_load_explicit(&root->services, memory_order_acquire);
  *out = find_service(head, kind);
  if (*out)
    return CELSPAN_OK;
  CS_TRY(kind->create(context, &made));
  made->kind = kind;
  do {
    *out = find_service(head, kind);
    made->next = head;
  } while (!*out && !atomic_compare_exchange_weak(&root->services, &head, made));
  if (*out)
    kind->destroy(made);
  else
    *out = made;
  return CELSPAN_OK;
}

void cs_context_trim(celspan_context *context) {
  for (cs_service *service = atomic_load(&context->root->services); service;
       service = service->next)
    if (service->kind->trim)
      service->kind->trim(service);
  cs_spares_trim(&context->memory->spares);
}

int cs_context_workers(celspan_context *context, int64_t wanted, int most) {
  atomic_int *processors = &context->root->processors;
  if (wanted <= 0 && atomic_load_explicit(processors, memory_order_relaxed) == 0) {
    cs_control_group group;
    cs_machine_group(&group);
    atomic_store_explicit(processors, cs_machine_processors(&group), memory_order_relaxed);
  }
  int64_t count = wanted > 0 ? wanted : atomic_load_explicit(processors, memory_order_relaxed);
  return count < most ? (int)count : most;
}

#define CS_TEXT_(x) #x
#define CS_TEXT(x) CS_TEXT_(x)

#define CS_VERSION                                                                                 \
  CS_TEXT(CELSPAN_VERSION_MAJOR)                                                                   \
  "." CS_TEXT(CELSPAN_VERSION_MINOR) "." CS_TEXT(CELSPAN_VERSION_PATCH)

const char *celspan_version(void) { return CS_VERSION; }

const char *cs_context_maker(const celspan_context *context) {
  return context->root->maker ? context->root->maker : "celspan " CS_VERSION;
}
