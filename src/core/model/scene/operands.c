#include "model/scene/operands.h"

#include <pthread.h>
#include <stdint.h>
#include <string.h>

#include "model/scene/check.h"
#include "model/scene/value.h"

/* the value of `used` while the places of ended views are being freed */
#define GIVING_BACK SIZE_MAX

struct cs_operands_list {
  atomic_size_t references;
  cs_memory *memory;
  pthread_mutex_t lock; /* protects `used` and `lives` */
  size_t capacity, used;
  /* stored after the objects: for each length from 0 on, whether a view of this length exists */
  bool *lives;
  celspan_object *objects[];
};

/* ---------------------------------------------------------------- lists */

static size_t bytes_of(size_t capacity) {
  return sizeof(cs_operands_list) + capacity * sizeof(celspan_object *) +
         (capacity + 1) * sizeof(bool);
}

/* NULL when there is no memory. */
static cs_operands_list *create_list(cs_memory *memory, size_t capacity) {
  if (capacity >= (SIZE_MAX - sizeof(cs_operands_list)) / (sizeof(celspan_object *) + sizeof(bool)))
    return NULL;
  cs_operands_list *list = cs_mem_resize(memory, NULL, 0, bytes_of(capacity));
  if (!list)
    return NULL;
  if (pthread_mutex_init(&list->lock, NULL) != 0) {
    cs_mem_free(memory, list, bytes_of(capacity));
    return NULL;
  }
  atomic_init(&list->references, 1);
  list->memory = cs_memory_ref(memory);
  list->capacity = capacity;
  list->used = 0;
  list->lives = (bool *)(list->objects + capacity);
  memset(list->lives, 0, (capacity + 1) * sizeof *list->lives);
  return list;
}

static void unref_objects(celspan_object **objects, size_t count) {
  for (size_t i = 0; i < count; i++)
    celspan_object_unref(objects[i]);
}

/* Called when the last view has returned all places. */
static void unref_list(cs_operands_list *list) {
  if (!cs_counted_drop(&list->references))
    return;
  cs_memory *memory = list->memory;
  pthread_mutex_destroy(&list->lock);
  cs_mem_free(memory, list, bytes_of(list->capacity));
  cs_memory_unref(memory);
}

static void keep_objects(celspan_object **to, celspan_object *const *from, size_t count) {
  for (size_t i = 0; i < count; i++)
    to[i] = celspan_object_ref(from[i]);
}

/* ---------------------------------------------------------------- views */

/* Adds a view. Called under the lock, or before any other thread knows the list. */
static void begin_view(cs_operands_list *list, size_t count) {
  list->used = count;
  list->lives[count] = true;
}

static celspan_status check_objects(celspan_context *context, const char *noun,
                                    celspan_object *const *objects, size_t count) {
  CS_TRY(cs_check_list(context, noun, "operands", objects, count, CS_CHECK_ITEMS));
  for (size_t i = 0; i < count; i++)
    if (!objects[i])
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: operands[%zu] is missing", noun, i + 1);
  return CELSPAN_OK;
}

celspan_status cs_operands_create(celspan_context *context, const char *noun,
                                  celspan_object *const *objects, size_t count, cs_operands *out) {
  CS_TRY(check_objects(context, noun, objects, count));
  *out = (cs_operands){0};
  if (count == 0)
    return CELSPAN_OK;
  cs_operands_list *list = create_list(context->memory, count);
  if (!list)
    return cs_fail_memory(context);
  keep_objects(list->objects, objects, count);
  begin_view(list, count);
  *out = (cs_operands){list, list->objects, count};
  return CELSPAN_OK;
}

/* Claims the places after the operands that `from` shows. Only a view that shows its whole list can
 * do this. */
static bool claim(const cs_operands *from, size_t count) {
  cs_operands_list *list = from->list;
  if (!list || count == 0)
    return false;
  pthread_mutex_lock(&list->lock);
  bool is_claimed = list->used == from->count && count <= list->capacity - from->count;
  if (is_claimed)
    begin_view(list, from->count + count);
  pthread_mutex_unlock(&list->lock);
  return is_claimed;
}

/* A list with as much additional room as it has operands, so that a growing chain copies each
 * operand about once. */
static cs_operands_list *copy_list(cs_memory *memory, const cs_operands *from, size_t more) {
  size_t count = from->count + more;
  cs_operands_list *list = create_list(memory, count > SIZE_MAX / 2 ? count : 2 * count);
  if (!list)
    return NULL;
  keep_objects(list->objects, from->objects, from->count);
  begin_view(list, count);
  return list;
}

celspan_status cs_operands_extend(celspan_context *context, const char *noun,
                                  const cs_operands *from, celspan_object *const *objects,
                                  size_t count, cs_operands *out) {
  CS_TRY(check_objects(context, noun, objects, count));
  *out = (cs_operands){0};
  bool is_shared = claim(from, count);
  cs_operands_list *list = is_shared ? from->list : copy_list(context->memory, from, count);
  if (!list)
    return cs_fail_memory(context);
  if (is_shared)
    cs_counted_keep(&list->references);
  keep_objects(list->objects + from->count, objects, count);
  *out = (cs_operands){list, list->objects, from->count + count};
  return CELSPAN_OK;
}

/* The length of the longest living view that is shorter than `count`, or 0. */
static size_t longest_below(const cs_operands_list *list, size_t count) {
  do
    count--;
  while (count > 0 && !list->lives[count]);
  return count;
}

/* As long as the longest view has ended: frees the places that no shorter view shows. Shorter views
 * that end meanwhile, on this or another thread, find that `used` is not their length, and leave
 * their places to this loop. */
static void end_view(cs_operands_list *list, size_t count) {
  pthread_mutex_lock(&list->lock);
  list->lives[count] = false;
  while (count > 0 && list->used == count && !list->lives[count]) {
    size_t kept = longest_below(list, count);
    list->used = GIVING_BACK;
    pthread_mutex_unlock(&list->lock);
    unref_objects(list->objects + kept, count - kept);
    pthread_mutex_lock(&list->lock);
    list->used = count = kept;
  }
  pthread_mutex_unlock(&list->lock);
}

void cs_operands_finish(cs_operands *operands) {
  cs_operands view = *operands;
  *operands = (cs_operands){0};
  if (!view.list)
    return;
  end_view(view.list, view.count);
  unref_list(view.list);
}
