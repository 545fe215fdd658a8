#include "scene/primitive_data.h"

#include "geometry/matrix.h"
#include "scene/check.h"
#include "scene/texture.h"
#include "scene/value.h"

/* ---------------------------------------------------------------- bodies */

celspan_status cs_primitive_data_create(celspan_context *context, cs_primitive_data_kind kind,
                                        celspan_texture *texture, cs_primitive_data **out) {
  celspan_texture *kept = NULL;
  if (kind == CS_PRIMITIVE_DATA_OUTLINE)
    CS_TRY(cs_texture_or_black(context, texture, &kept));
  cs_primitive_data *body = cs_mem_array(context->memory, 1, sizeof *body);
  if (!body) {
    celspan_texture_unref(kept);
    return cs_fail_memory(context);
  }
  atomic_init(&body->references, 1);
  body->memory = cs_memory_ref(context->memory);
  body->kind = kind;
  body->has_procedure = kind == CS_PRIMITIVE_DATA_SCANLINE;
  body->texture = kept;
  cs_outline_init(&body->outline);
  *out = body;
  return CELSPAN_OK;
}

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
void cs_primitive_data_unref(cs_primitive_data *body) {
  if (!body || !cs_value_drop(&body->references))
    return;
  cs_memory *memory = body->memory;
  if (body->kind == CS_PRIMITIVE_DATA_SCANLINE && body->scanline.release)
    body->scanline.release(body->scanline.user);
  cs_outline_finish(&body->outline, memory);
  celspan_texture_unref(body->texture);
  cs_primitive_data_list_free(memory, body->operands, body->operand_count);
  cs_mem_free(memory, body, sizeof *body);
  cs_memory_unref(memory);
}

static void hash_outline(cs_hash *hash, const cs_outline *outline) {
  cs_hash_word(hash, outline->contour_count);
  for (size_t i = 0; i < outline->contour_count; i++)
    cs_hash_word(hash, outline->contours[i]);
  cs_hash_word(hash, outline->piece_count);
  for (size_t i = 0; i < outline->piece_count; i++)
    cs_hash_word(hash, outline->degrees[i]);
  cs_hash_word(hash, outline->point_count);
  for (size_t i = 0; i < outline->point_count; i++) {
    cs_hash_number(hash, outline->points[i].x);
    cs_hash_number(hash, outline->points[i].y);
    cs_hash_number(hash, outline->points[i].w);
  }
}

/* A procedure cannot be looked into, so it equals itself alone. Its address may be used again once
 * it is gone; the count of allocations never comes back. */
static void hash_procedure(cs_hash *hash, const cs_primitive_data *body) {
  cs_hash_word(hash, (uint64_t)(uintptr_t)body);
  cs_hash_word(hash, atomic_load_explicit(&body->memory->allocations, memory_order_relaxed));
}

static cs_hash hash_body(const cs_primitive_data *body) {
  cs_hash hash = cs_hash_begin(CS_VALUE_BODY);
  cs_hash_word(&hash, body->kind);
  hash_outline(&hash, &body->outline);
  cs_hash_word(&hash, body->rule);
  if (body->texture)
    cs_hash_hash(&hash, body->texture->hash);
  if (body->kind == CS_PRIMITIVE_DATA_SCANLINE)
    hash_procedure(&hash, body);
  cs_hash_word(&hash, body->op);
  cs_hash_word(&hash, body->operand_count);
  for (size_t i = 0; i < body->operand_count; i++)
    cs_hash_hash(&hash, body->operands[i]->hash);
  return cs_hash_end(hash);
}

/* ---------------------------------------------------------------- objects */

static celspan_status create_object(celspan_context *context, cs_primitive_data *body,
                                    const celspan_matrix *matrix, double fade,
                                    celspan_object **out) {
  celspan_object *object = cs_mem_array(context->memory, 1, sizeof *object);
  if (!object)
    return cs_fail_memory(context);
  atomic_init(&object->references, 1);
  object->memory = cs_memory_ref(context->memory);
  cs_value_keep(&body->references);
  object->body = body;
  object->matrix = *matrix;
  object->fade = fade;
  cs_hash hash = cs_hash_begin(CS_VALUE_OBJECT);
  cs_hash_hash(&hash, body->hash);
  cs_value_hash_matrix(&hash, matrix);
  cs_hash_number(&hash, fade);
  object->hash = cs_hash_end(hash);
  *out = object;
  return CELSPAN_OK;
}

celspan_status cs_primitive_data_wrap(celspan_context *context, cs_primitive_data *body,
                                      celspan_status status, celspan_object **out) {
  const celspan_matrix identity = celspan_matrix_identity();
  if (status == CELSPAN_OK) {
    body->hash = hash_body(body);
    status = create_object(context, body, &identity, 1, out);
  }
  cs_primitive_data_unref(body);
  return status;
}

celspan_status cs_primitive_data_check_placement(celspan_context *context,
                                                 const cs_primitive_data *body,
                                                 const celspan_matrix *matrix) {
  if (!body->has_procedure || cs_matrix_is_upright(matrix))
    return CELSPAN_OK;
  return cs_fail(
      context, CELSPAN_BAD_ARGUMENT,
      "transform: a scan-line primitive can be moved and scaled, but not rotated, skewed "
      "or put in perspective");
}

celspan_status celspan_object_transform(celspan_context *context, celspan_object *object,
                                        const celspan_matrix *matrix, celspan_object **out) {
  CS_TRY(cs_check_given(context, "transform", "the object", object));
  celspan_matrix whole;
  CS_TRY(cs_check_transform(context, &object->matrix, matrix, &whole));
  CS_TRY(cs_primitive_data_check_placement(context, object->body, &whole));
  return create_object(context, object->body, &whole, object->fade, out);
}

celspan_status celspan_object_fade(celspan_context *context, celspan_object *object, double k,
                                   celspan_object **out) {
  CS_TRY(cs_check_given(context, "fade", "the object", object));
  CS_TRY(cs_check_share(context, "fade", "k", k));
  return create_object(context, object->body, &object->matrix, object->fade * k, out);
}

celspan_object *celspan_object_ref(celspan_object *object) {
  cs_value_keep(&object->references);
  return object;
}

void celspan_object_unref(celspan_object *object) {
  if (!object || !cs_value_drop(&object->references))
    return;
  cs_memory *memory = object->memory;
  cs_primitive_data_unref(object->body);
  cs_mem_free(memory, object, sizeof *object);
  cs_memory_unref(memory);
}

/* ---------------------------------------------------------------- lists */

celspan_status cs_primitive_data_list_copy(celspan_context *context, const char *noun,
                                           const char *field, celspan_object *const *objects,
                                           size_t count, celspan_object ***out) {
  if (count > 0)
    CS_TRY(cs_check_given(context, noun, field, objects));
  for (size_t i = 0; i < count; i++)
    if (!objects[i])
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: %s[%zu] is missing", noun, field, i + 1);
  celspan_object **copy = cs_mem_array(context->memory, count, sizeof *copy);
  if (!copy && count > 0)
    return cs_fail_memory(context);
  for (size_t i = 0; i < count; i++)
    copy[i] = celspan_object_ref(objects[i]);
  *out = copy;
  return CELSPAN_OK;
}

void cs_primitive_data_list_free(cs_memory *memory, celspan_object **objects, size_t count) {
  for (size_t i = 0; i < count; i++)
    celspan_object_unref(objects[i]);
  cs_mem_free(memory, objects, count * sizeof *objects);
}
