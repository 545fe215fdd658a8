#include "scene/operands.h"

#include <stdint.h>
#include <string.h>

#include "scene/check.h"
#include "scene/value.h"

struct cs_operands_list {
  atomic_size_t references;
  cs_memory *memory;
  size_t capacity;
  atomic_size_t used;
  celspan_object *objects[];
};

/* ---------------------------------------------------------------- lists */

static size_t bytes_of(size_t capacity) {
  return sizeof(cs_operands_list) + capacity * sizeof(celspan_object *);
}

/* NULL when there is no memory. */
static cs_operands_list *create_list(cs_memory *memory, size_t capacity) {
  if (capacity > (SIZE_MAX - sizeof(cs_operands_list)) / sizeof(celspan_object *))
    return NULL;
  cs_operands_list *list = cs_mem_resize(memory, NULL, 0, bytes_of(capacity));
  if (!list)
    return NULL;
  atomic_init(&list->references, 1);
  list->memory = cs_memory_ref(memory);
  list->capacity = capacity;
  atomic_init(&list->used, 0);
  return list;
}

static void unref_objects(celspan_object **objects, size_t count) {
  for (size_t i = 0; i < count; i++)
    celspan_object_unref(objects[i]);
}

static void unref_list(cs_operands_list *list) {
  if (!cs_value_drop(&list->references))
    return;
  unref_objects(list->objects, atomic_load_explicit(&list->used, memory_order_relaxed));
  cs_memory *memory = list->memory;
  cs_mem_free(memory, list, bytes_of(list->capacity));
  cs_memory_unref(memory);
}

static void keep_objects(celspan_object **to, celspan_object *const *from, size_t count) {
  for (size_t i = 0; i < count; i++)
    to[i] = celspan_object_ref(from[i]);
}

/* ---------------------------------------------------------------- views */

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
  atomic_store_explicit(&list->used, count, memory_order_relaxed);
  *out = (cs_operands){list, list->objects, count, 0};
  return CELSPAN_OK;
}

/* Claims the places after those that `from` shows. Only the view that shows all of a list can: its
 * count is the used one. The order pairs with that of give_back. */
static bool claim(const cs_operands *from, size_t count) {
  cs_operands_list *list = from->list;
  size_t used = from->count;
  return list && count > 0 && count <= list->capacity - used &&
         atomic_compare_exchange_strong_explicit(&list->used, &used, used + count,
                                                 memory_order_acquire, memory_order_relaxed);
}

/* A list with room for as many again, so that the copies of a chain are as many as its operands. */
static cs_operands_list *copy_list(cs_memory *memory, const cs_operands *from, size_t more) {
  size_t count = from->count + more;
  cs_operands_list *list = create_list(memory, count > SIZE_MAX / 2 ? count : 2 * count);
  if (!list)
    return NULL;
  keep_objects(list->objects, from->objects, from->count);
  atomic_store_explicit(&list->used, count, memory_order_relaxed);
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
    cs_value_keep(&list->references);
  keep_objects(list->objects + from->count, objects, count);
  *out = (cs_operands){list, list->objects, from->count + count, is_shared ? from->count : 0};
  return CELSPAN_OK;
}

/* Where nothing was added after what this view had added, its places are free for another. */
static void give_back(const cs_operands *operands) {
  cs_operands_list *list = operands->list;
  if (atomic_load_explicit(&list->used, memory_order_acquire) != operands->count)
    return;
  unref_objects(list->objects + operands->first, operands->count - operands->first);
  atomic_store_explicit(&list->used, operands->first, memory_order_release);
}

void cs_operands_finish(cs_operands *operands) {
  if (operands->list) {
    give_back(operands);
    unref_list(operands->list);
  }
  *operands = (cs_operands){0};
}
