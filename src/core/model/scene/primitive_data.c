#include "model/scene/primitive_data.h"

#include "model/geometry/matrix.h"
#include "model/scene/check.h"
#include "model/scene/texture.h"
#include "model/scene/texture_fit.h"
#include "model/scene/texture_unroll.h"
#include "model/scene/value.h"

/* ---------------------------------------------------------------- mixing */

/* For a texture of paints. Pigment and medium are mixed where the medium dims the light that the
 * pigment does not block. */
static cs_mixing mixing_of_paint(const cs_paint *paint) {
  bool is_opaque = true, is_single = true;
  for (int c = 0; c < 3; c++) {
    is_opaque = is_opaque && paint->t[c] == 0;
    is_single = is_single && (paint->s[c] == 0 || paint->t[c] == 1 - paint->beta);
  }
  return !is_single ? CS_MIXING_MIXED : is_opaque ? CS_MIXING_OPAQUE : CS_MIXING_SINGLE;
}

static cs_mixing mixing_of_texture(const celspan_texture *texture) {
  if (texture->kind == CS_TEXTURE_FLAT)
    return mixing_of_paint(&texture->flat);
  bool is_plain = texture->kind == CS_TEXTURE_PICTURE && !texture->variation->medium;
  return is_plain ? CS_MIXING_SINGLE : CS_MIXING_MIXED;
}

/* Updates the known properties of a boolean for one more operand. is_only: no other operand is
 * painted. */
static void add_mixing(const celspan_object *object, bool is_only, cs_primitive_data *data) {
  uint8_t mixing = object->data->mixing;
  if (mixing == CS_MIXING_OPAQUE && object->fade < 1)
    mixing = CS_MIXING_SINGLE;
  if (mixing == CS_MIXING_SINGLE && !is_only)
    mixing = CS_MIXING_MIXED;
  data->mixing = mixing > data->mixing ? mixing : data->mixing;
}

/* Whether a boolean mixes its operands, or changes their colours, in addition to painting them. */
static bool has_formula(const cs_boolean *boolean) {
  return boolean->op == CS_OPERATOR_MATTE || boolean->grade ||
         boolean->blend != CELSPAN_BLEND_NORMAL;
}

/* Finds how objects mix that are added after other operands. */
static void measure_mixing(celspan_object *const *objects, size_t count, cs_primitive_data *data) {
  const cs_boolean *boolean = data->boolean;
  bool is_first =
      boolean->op == CELSPAN_OPERATOR_DIFFERENCE || boolean->op == CELSPAN_OPERATOR_CLIP;
  bool is_only = is_first || boolean->operand_count == 1;
  if (!is_only && data->mixing == CS_MIXING_SINGLE)
    data->mixing = CS_MIXING_MIXED;
  size_t shown = !is_first ? count : boolean->operand_count == count && count > 0 ? 1 : 0;
  for (size_t i = 0; i < shown; i++)
    add_mixing(objects[i], is_only, data);
  if (has_formula(boolean))
    data->mixing = CS_MIXING_MIXED;
  data->boolean->mixes = boolean->space != CELSPAN_SPACE_AROUND && data->mixing == CS_MIXING_MIXED;
}

/* ---------------------------------------------------------------- data */

/* Makes the values that only this kind of data has. */
static celspan_status create_part(celspan_context *context, cs_primitive_data *data) {
  if (data->kind == CS_PRIMITIVE_DATA_SCANLINE) {
    return CS_MAKE(context, data->scanline, 1);
  }
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN) {
    return CS_MAKE(context, data->boolean, 1);
  }
  return CELSPAN_OK;
}

celspan_status cs_primitive_data_create(celspan_context *context, cs_primitive_data_kind kind,
                                        celspan_texture *texture, cs_primitive_data **out) {
  cs_primitive_data *data;
  CS_TRY(CS_COUNTED_MAKE(context, data));
  data->kind = kind;
  data->has_procedure = kind == CS_PRIMITIVE_DATA_SCANLINE;
  data->has_uneven = kind == CS_PRIMITIVE_DATA_SCANLINE || kind == CS_PRIMITIVE_DATA_ROSTRUM;
  celspan_status status = kind == CS_PRIMITIVE_DATA_OUTLINE
                              ? cs_texture_or_black(context, texture, &data->texture)
                              : create_part(context, data);
  if (status != CELSPAN_OK) {
    cs_primitive_data_unref(data);
    return status;
  }
  if (data->texture) {
    data->mixing = (uint8_t)mixing_of_texture(data->texture);
    data->has_uneven =
        !cs_texture_is_grey(data->texture) || cs_texture_stays_on_thread(data->texture);
  } else if (kind != CS_PRIMITIVE_DATA_BOOLEAN) {
    data->mixing = CS_MIXING_MIXED;
  }
  *out = data;
  return CELSPAN_OK;
}

static void free_scanline(celspan_scanline_desc *scanline, cs_memory *memory) {
  if (scanline && scanline->release)
    scanline->release(scanline->user);
  cs_mem_free(memory, scanline, sizeof *scanline);
}

static void free_boolean(cs_boolean *boolean, cs_memory *memory) {
  if (boolean) {
    cs_operands_finish(&boolean->view);
    celspan_grade_unref(boolean->grade);
    celspan_object_unref(boolean->inner.object);
  }
  cs_mem_free(memory, boolean, sizeof *boolean);
}

static void free_part(cs_primitive_data *data) {
  switch (data->kind) {
  case CS_PRIMITIVE_DATA_SCANLINE:
    free_scanline(data->scanline, data->memory);
    break;
  case CS_PRIMITIVE_DATA_BOOLEAN:
    free_boolean(data->boolean, data->memory);
    break;
  case CS_PRIMITIVE_DATA_ROSTRUM:
    celspan_rostrum_unref(data->rostrum);
    cs_mem_free(data->memory, data->repeat, sizeof *data->repeat);
    break;
  case CS_PRIMITIVE_DATA_OUTLINE:
    break;
  }
}

static void free_shape(cs_primitive_data *data) {
  if (!data->is_box)
    cs_outline_free_packed(data->outline, data->memory);
  if (data->stroke)
    cs_stroke_finish(data->stroke, data->memory);
  cs_mem_free(data->memory, data->stroke, sizeof *data->stroke);
}

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
void cs_primitive_data_unref(cs_primitive_data *data) {
  if (!data || !cs_counted_drop(&data->references))
    return;
  cs_memory *memory = data->memory;
  free_part(data);
  if (data->shape)
    cs_primitive_data_unref(data->shape);
  else
    free_shape(data);
  celspan_texture_unref(data->texture);
  cs_mem_free(memory, data, sizeof *data);
  cs_memory_unref(memory);
}

/* Nothing is known about the spans of a procedure, so it equals only itself. Its address can be
 * used again after it was freed, but the count of allocations only grows. */
static void hash_procedure(cs_hash *hash, const cs_primitive_data *data) {
  cs_hash_word(hash, (uint64_t)(uintptr_t)data);
  cs_hash_word(hash, atomic_load_explicit(&data->memory->allocations, memory_order_relaxed));
}

static cs_hash hash_primitive(const cs_primitive_data *data) {
  static const cs_outline none = {.is_plain = true};
  cs_outline_box room;
  const cs_outline *outline = cs_primitive_data_outline(data, &room);
  cs_hash hash = cs_hash_begin(CS_VALUE_DATA);
  cs_hash_word(&hash, data->kind);
  cs_outline_hash(&hash, outline ? outline : &none);
  if (data->stroke)
    cs_hash_hash(&hash, data->stroke->hash);
  cs_hash_word(&hash, data->rule);
  if (data->texture)
    cs_hash_hash(&hash, data->texture->hash);
  if (data->kind == CS_PRIMITIVE_DATA_SCANLINE)
    hash_procedure(&hash, data);
  if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
    cs_hash_hash(&hash, data->rostrum->hash);
  if (data->repeat) {
    cs_value_hash_box(&hash, &data->repeat->box);
    cs_value_hash_matrix(&hash, &data->repeat->matrix);
  }
  return cs_hash_end(hash);
}

/* The length comes last, so that the hash of a longer list begins with the hash of a shorter
 * one. */
static cs_hash hash_boolean(cs_boolean *boolean) {
  bool is_extended = boolean->hashed_count > 0;
  cs_hash hash = is_extended ? boolean->operands_hash : cs_hash_begin(CS_VALUE_DATA);
  if (!is_extended) {
    cs_hash_word(&hash, CS_PRIMITIVE_DATA_BOOLEAN);
    cs_hash_word(&hash, boolean->op);
  }
  for (size_t i = boolean->hashed_count; i < boolean->operand_count; i++)
    cs_hash_hash(&hash, boolean->operands[i]->hash);
  boolean->operands_hash = hash;
  boolean->hashed_count = boolean->operand_count;
  cs_hash_word(&hash, boolean->operand_count);
  if (boolean->blend != CELSPAN_BLEND_NORMAL || boolean->isolates || boolean->mixes)
    cs_hash_word(&hash, (uint64_t)(boolean->mixes ? boolean->space : 0) << 16 |
                            (uint64_t)boolean->dissolves << 15 | (uint64_t)boolean->blend << 3 |
                            (uint64_t)boolean->isolates << 2 | (uint64_t)boolean->is_luma << 1 |
                            boolean->inverts);
  cs_grade_hash(&hash, boolean->grade);
  return cs_hash_end(hash);
}

/* ---------------------------------------------------------------- objects */

static const celspan_matrix identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}};

static size_t size_of(const celspan_object *object) {
  return sizeof *object + (object->matrix == object->own ? sizeof *object->own : 0);
}

/* matrix: is copied, unless it is `identity` itself. mark: a reference that becomes the object's;
 * released on failure. */
static celspan_status create_object(celspan_context *context, cs_primitive_data *data,
                                    const celspan_matrix *matrix, double fade, cs_mark mark,
                                    celspan_object **out) {
  bool is_shared = matrix == &identity;
  celspan_object *object =
      cs_mem_array(context->memory, 1, sizeof *object + (is_shared ? 0 : sizeof *object->own));
  if (!object) {
    cs_mark_drop(mark);
    return cs_fail_memory(context);
  }
  if (!is_shared)
    object->own[0] = *matrix;
  object->matrix = is_shared ? &identity : object->own;
  object->mark = mark;
  atomic_init(&object->references, 1);
  object->memory = cs_memory_ref(context->memory);
  cs_counted_keep(&data->references);
  object->data = data;
  object->fade = fade;
  cs_hash hash = cs_hash_begin(CS_VALUE_OBJECT);
  cs_hash_hash(&hash, data->hash);
  cs_value_hash_matrix(&hash, matrix);
  cs_hash_number(&hash, fade);
  object->hash = cs_hash_end(hash);
  *out = object;
  return CELSPAN_OK;
}

celspan_status cs_primitive_data_object(celspan_context *context, cs_primitive_data *data,
                                        celspan_object **out) {
  data->hash =
      data->kind == CS_PRIMITIVE_DATA_BOOLEAN ? hash_boolean(data->boolean) : hash_primitive(data);
  return create_object(context, data, &identity, 1, cs_mark_now(context), out);
}

celspan_status cs_primitive_data_wrap(celspan_context *context, cs_primitive_data *data,
                                      celspan_status status, celspan_object **out) {
  if (status == CELSPAN_OK && data->texture)
    status = cs_texture_fit(context, &data->texture, &data->bounds);
  if (status == CELSPAN_OK && data->texture)
    status = cs_texture_unroll(context, &data->texture, &data->bounds);
  if (status == CELSPAN_OK)
    status = cs_primitive_data_object(context, data, out);
  cs_primitive_data_unref(data);
  return status;
}

celspan_status cs_primitive_data_set_box(celspan_context *context, cs_primitive_data *data,
                                         const celspan_box *box) {
  data->is_box = box->x + box->width > box->x && box->y + box->height > box->y;
  if (data->is_box) {
    data->box = *box;
    return CELSPAN_OK;
  }
  cs_outline outline;
  cs_outline_init(&outline);
  celspan_status status =
      cs_outline_rect(context, &outline, box->x, box->y, box->width, box->height, 0);
  if (status == CELSPAN_OK)
    status = cs_outline_pack(context, &outline, &data->outline);
  cs_outline_finish(&outline, context->memory);
  return status;
}

celspan_status cs_primitive_data_check_placement(celspan_context *context,
                                                 const cs_primitive_data *data,
                                                 const celspan_matrix *matrix) {
  if (!data->has_procedure || cs_matrix_is_upright(matrix))
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
  CS_TRY(cs_check_transform(context, object->matrix, matrix, &whole));
  CS_TRY(cs_primitive_data_check_placement(context, object->data, &whole));
  return create_object(context, object->data, &whole, object->fade, cs_mark_keep(object->mark),
                       out);
}

celspan_status celspan_object_fade(celspan_context *context, celspan_object *object, double k,
                                   celspan_object **out) {
  CS_TRY(cs_check_given(context, "fade", "the object", object));
  CS_TRY(cs_check_share(context, "fade", "k", k, &k));
  return create_object(context, object->data, object->matrix, object->fade * k,
                       cs_mark_keep(object->mark), out);
}

bool celspan_object_hash(const celspan_object *object, uint64_t drawing[2], uint64_t placement[2]) {
  cs_hash rest = cs_hash_begin(CS_VALUE_OBJECT);
  cs_value_hash_matrix(&rest, object->matrix);
  cs_hash_number(&rest, object->fade);
  cs_value_hash_give(object->data->hash, drawing);
  cs_value_hash_give(cs_hash_end(rest), placement);
  return !object->data->has_procedure;
}

celspan_status cs_primitive_data_replace(celspan_context *context, const celspan_object *object,
                                         cs_primitive_data *data, celspan_object **out) {
  return create_object(context, data, object->matrix, object->fade, cs_mark_keep(object->mark),
                       out);
}

celspan_status cs_primitive_data_repaint(celspan_context *context, const celspan_object *object,
                                         celspan_texture *texture, celspan_object **out) {
  cs_primitive_data *from = object->data, *data;
  celspan_object *plain;
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_OUTLINE, texture, &data));
  data->shape = from->shape ? from->shape : from;
  cs_counted_keep(&data->shape->references);
  data->rule = from->rule;
  data->is_empty = from->is_empty;
  data->is_box = from->is_box;
  data->piece_count = from->piece_count;
  data->primitive_count = from->primitive_count;
  data->bounds = from->bounds;
  data->stroke = from->stroke;
  if (from->is_box)
    data->box = from->box;
  else
    data->outline = from->outline;
  CS_TRY(cs_primitive_data_wrap(context, data, CELSPAN_OK, &plain));
  celspan_status status = cs_primitive_data_replace(context, object, plain->data, out);
  celspan_object_unref(plain);
  return status;
}

celspan_status celspan_object_named(celspan_context *context, celspan_object *object,
                                    const char *name, celspan_object **out) {
  CS_TRY(cs_check_given(context, "named", "the object", object));
  cs_mark mark;
  CS_TRY(cs_mark_named(context, object->mark, name, &mark));
  return create_object(context, object->data, object->matrix, object->fade, mark, out);
}

const char *celspan_object_name(const celspan_object *object) { return cs_mark_name(object->mark); }

celspan_origin celspan_object_origin(const celspan_object *object) {
  return cs_mark_origin(object->mark);
}

static void destroy(celspan_object *object) {
  cs_memory *memory = object->memory;
  cs_primitive_data_unref(object->data);
  cs_mark_drop(object->mark);
  cs_counted_free(memory, object, size_of(object));
}

CS_COUNTED(celspan_object)

/* ---------------------------------------------------------------- lists */

celspan_status cs_primitive_data_list_copy(celspan_context *context, const char *noun,
                                           const char *field, celspan_object *const *objects,
                                           size_t count, celspan_object ***out) {
  CS_TRY(cs_check_list(context, noun, field, objects, count, CS_CHECK_ITEMS));
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

/* Records how an operand, or an object of a cel, changes the backdrop of the boolean or cel around
 * it. */
static void add_modes(const celspan_object *object, cs_primitive_data *data) {
  for (int around = CELSPAN_SPACE_LINEAR; around < CS_SPACES; around++) {
    celspan_space space = data->kind == CS_PRIMITIVE_DATA_BOOLEAN
                              ? cs_boolean_space(data->boolean, (celspan_space)around)
                              : (celspan_space)around;
    data->blends[around] |= cs_object_blends(object, space);
  }
  data->has_modes |= cs_object_has_modes(object);
}

/* Adds the pieces of an operand that is not cut away. */
static void add_pieces(const cs_primitive_data *item, cs_primitive_data *data) {
  bool is_cut = data->kind == CS_PRIMITIVE_DATA_BOOLEAN &&
                data->boolean->op == CELSPAN_OPERATOR_DIFFERENCE && data->primitive_count > 0;
  const uint32_t room = UINT32_MAX - data->piece_count;
  if (!is_cut)
    data->piece_count += item->piece_count < room ? item->piece_count : room;
}

celspan_status cs_primitive_data_measure(celspan_context *context, const char *noun,
                                         celspan_object *const *objects, size_t count,
                                         cs_primitive_data *data) {
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
    measure_mixing(objects, count, data);
  for (size_t i = 0; i < count; i++) {
    const cs_primitive_data *item = objects[i]->data;
    data->depth = item->depth > data->depth ? item->depth : data->depth;
    add_pieces(item, data);
    data->primitive_count += item->primitive_count; /* both at most the limit: no overflow */
    data->has_procedure |= item->has_procedure;
    add_modes(objects[i], data);
    data->has_uneven |= item->has_uneven;
    if (data->primitive_count > CS_SCENE_PRIMITIVES)
      return cs_fail(context, CELSPAN_LIMIT, "%s: it holds more than %d primitives", noun,
                     CS_SCENE_PRIMITIVES);
  }
  return CELSPAN_OK;
}

celspan_status cs_primitive_data_deepen(celspan_context *context, const char *noun,
                                        cs_primitive_data *data) {
  data->depth++;
  if (data->depth > CS_SCENE_DEPTH)
    return cs_fail(context, CELSPAN_LIMIT, "%s: nested %d levels deep; the limit is %d", noun,
                   data->depth, CS_SCENE_DEPTH);
  return CELSPAN_OK;
}

void cs_primitive_data_list_free(cs_memory *memory, celspan_object **objects, size_t count) {
  for (size_t i = 0; i < count; i++)
    celspan_object_unref(objects[i]);
  cs_mem_free(memory, objects, count * sizeof *objects);
}
