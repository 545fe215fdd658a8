/* Groups, objects with a mode of their own, and mattes: unions, and a matte, that are composited by
 * themselves.
 *
 *     group{ a, b }                 a union
 *     group{ a, b, isolate = true } a union that isolates
 *     group{ a, b, space = s }      a union in a space of its own; it isolates where that is not
 *                                   the space around it
 *     group{ a, b, grade = g }      a union that is graded; it isolates
 *     a:blend(m)                    a union of one object, with a mode; it isolates
 *     matte(art, by)                two operands, of which only the first is painted; it isolates
 */
#include "base/description.h"
#include "model/colour/blend.h"
#include "model/scene/check.h"
#include "model/scene/operands.h"
#include "model/scene/primitive_data.h"

celspan_status cs_primitive_data_of_operands(celspan_context *context, const char *noun,
                                             const cs_boolean *look,
                                             celspan_object *const *operands, size_t count,
                                             cs_primitive_data **out) {
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_BOOLEAN, NULL, &data));
  *data->boolean = *look;
  celspan_grade_ref(look->grade);
  celspan_status status = cs_operands_create(context, noun, operands, count, &data->boolean->view);
  if (status == CELSPAN_OK) {
    data->boolean->operands = data->boolean->view.objects;
    data->boolean->operand_count = count;
    data->is_empty = count == 0;
    status = cs_primitive_data_measure(context, noun, operands, count, data);
  }
  if (status == CELSPAN_OK)
    status = cs_primitive_data_deepen(context, noun, data);
  if (status == CELSPAN_OK) {
    *out = data;
    return CELSPAN_OK;
  }
  cs_primitive_data_unref(data);
  return status;
}

/* ---------------------------------------------------------------- groups */

static celspan_status check_group(celspan_context *context, const celspan_group_desc *desc) {
  double opacity;
  CS_TRY(cs_check_share(context, "group", "opacity", desc->opacity, &opacity));
  CS_TRY(cs_check_choice(context, "group", "blend", (unsigned)desc->blend, CS_BLEND_COUNT));
  CS_TRY(cs_check_choice(context, "group", "isolate", (unsigned)desc->isolate,
                         CELSPAN_ISOLATION_OFF + 1));
  CS_TRY(cs_check_choice(context, "group", "space", (unsigned)desc->space, CELSPAN_SPACE_SRGB + 1));
  const char *must = opacity < 1                           ? "an opacity below 1"
                     : desc->blend != CELSPAN_BLEND_NORMAL ? "a blend mode"
                     : desc->space != CELSPAN_SPACE_AROUND ? "a space of its own"
                     : desc->grade                         ? "a grade"
                                                           : NULL;
  if (must && desc->isolate == CELSPAN_ISOLATION_OFF)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "group: isolate is false, but a group with %s always isolates; leave isolate "
                   "out",
                   must);
  return CELSPAN_OK;
}

celspan_status celspan_object_create_group(celspan_context *context, const celspan_group_desc *desc,
                                           celspan_object **out) {
  CS_READ(context, "group", celspan_group_desc, desc);
  CS_TRY(check_group(context, desc));
  const cs_boolean look = {.op = CELSPAN_OPERATOR_UNION,
                           .blend = desc->blend,
                           .space = desc->space,
                           .grade = desc->grade,
                           .isolates = desc->isolate == CELSPAN_ISOLATION_ON || desc->grade ||
                                       desc->blend != CELSPAN_BLEND_NORMAL};
  cs_primitive_data *data;
  celspan_object *group;
  CS_TRY(cs_primitive_data_of_operands(context, "group", &look, desc->objects, desc->object_count,
                                       &data));
  CS_TRY(cs_primitive_data_wrap(context, data, CELSPAN_OK, &group));
  celspan_status status = celspan_object_fade(context, group, desc->opacity, out);
  celspan_object_unref(group);
  return status;
}

/* ---------------------------------------------------------------- modes */

celspan_blend celspan_object_mode(const celspan_object *object) {
  return CS_BLEND_MODE(cs_object_mode(object));
}

/* A union with the operands of another union, but with a different look. noun: for messages. */
static celspan_status change(celspan_context *context, const char *noun,
                             const celspan_object *object, const cs_boolean *look,
                             celspan_object **out) {
  const cs_boolean *from = object->data->boolean;
  cs_primitive_data *data;
  celspan_object *plain;
  CS_TRY(cs_primitive_data_of_operands(context, noun, look, from->operands, from->operand_count,
                                       &data));
  CS_TRY(cs_primitive_data_wrap(context, data, CELSPAN_OK, &plain));
  celspan_status status = cs_primitive_data_replace(context, object, plain->data, out);
  celspan_object_unref(plain);
  return status;
}

/* A union of the object alone, with a look and the object's mark. noun: for messages. */
static celspan_status surround(celspan_context *context, const char *noun, celspan_object *object,
                               const cs_boolean *look, celspan_object **out) {
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_of_operands(context, noun, look, &object, 1, &data));
  CS_TRY(cs_primitive_data_wrap(context, data, CELSPAN_OK, out));
  cs_mark_drop((*out)->mark);
  (*out)->mark = cs_mark_keep(object->mark);
  return CELSPAN_OK;
}

/* The properties of a boolean that do not depend on its operands. */
static cs_boolean traits_of(const cs_boolean *from) {
  return (cs_boolean){.op = from->op,
                      .blend = from->blend,
                      .space = from->space,
                      .grade = from->grade,
                      .isolates = from->isolates,
                      .is_luma = from->is_luma,
                      .inverts = from->inverts,
                      .dissolves = from->dissolves,
                      .is_filled = from->is_filled};
}

celspan_status cs_boolean_like(celspan_context *context, const cs_boolean *like,
                               celspan_object *const *operands, size_t count,
                               celspan_object **out) {
  const cs_boolean look = traits_of(like);
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_of_operands(context, "boolean", &look, operands, count, &data));
  return cs_primitive_data_wrap(context, data, CELSPAN_OK, out);
}

celspan_status cs_boolean_with(celspan_context *context, const celspan_object *object,
                               celspan_object *const *operands, size_t count,
                               celspan_object **out) {
  celspan_object *plain;
  CS_TRY(cs_boolean_like(context, object->data->boolean, operands, count, &plain));
  celspan_status status = cs_primitive_data_replace(context, object, plain->data, out);
  celspan_object_unref(plain);
  return status;
}

/* Another mode for an object that has one. */
static celspan_status change_mode(celspan_context *context, const celspan_object *object,
                                  celspan_blend mode, celspan_object **out) {
  cs_boolean look = traits_of(object->data->boolean);
  look.blend = mode;
  look.isolates = true;
  return change(context, "blend", object, &look, out);
}

static celspan_status set_mode(celspan_context *context, celspan_object *object, celspan_blend mode,
                               celspan_object **out) {
  if (cs_object_mode(object) != CELSPAN_BLEND_NORMAL)
    return change_mode(context, object, mode, out);
  if (mode == CELSPAN_BLEND_NORMAL) {
    *out = celspan_object_ref(object);
    return CELSPAN_OK;
  }
  const cs_boolean look = {.op = CELSPAN_OPERATOR_UNION, .blend = mode, .isolates = true};
  return surround(context, "blend", object, &look, out);
}

celspan_status celspan_object_blend(celspan_context *context, celspan_object *object,
                                    celspan_blend mode, celspan_object **out) {
  CS_TRY(cs_check_given(context, "blend", "the object", object));
  CS_TRY(cs_check_choice(context, "blend", "mode", (unsigned)mode, CS_BLEND_COUNT));
  return set_mode(context, object, mode, out);
}

celspan_status cs_object_blend_within(celspan_context *context, celspan_object *object,
                                      celspan_blend mode, celspan_object **out) {
  CS_TRY(cs_check_given(context, "blend_within", "the object", object));
  CS_TRY(cs_check_choice(context, "blend_within", "mode", (unsigned)mode, CS_BLEND_COUNT));
  return set_mode(context, object, (celspan_blend)((unsigned)mode | CS_BLEND_WITHIN), out);
}

/* ---------------------------------------------------------------- spaces */

/* Whether the object is a union. Any other object is put into a group. */
static bool is_union(const celspan_object *object) {
  const cs_primitive_data *data = object->data;
  return data->kind == CS_PRIMITIVE_DATA_BOOLEAN && data->boolean->op == CELSPAN_OPERATOR_UNION;
}

/* Whether the object has a space of its own, so that its look does not depend on the space around
 * it. */
static bool has_space(const celspan_object *object) {
  return is_union(object) && object->data->boolean->space != CELSPAN_SPACE_AROUND;
}

celspan_status cs_object_in_space(celspan_context *context, celspan_object *object,
                                  celspan_space space, celspan_object **out) {
  const cs_boolean alone = {.op = CELSPAN_OPERATOR_UNION, .space = space};
  if (space == CELSPAN_SPACE_AROUND || object->data->mixing < CS_MIXING_MIXED ||
      has_space(object)) {
    *out = celspan_object_ref(object);
    return CELSPAN_OK;
  }
  if (is_union(object)) {
    cs_boolean look = traits_of(object->data->boolean);
    look.space = space;
    return change(context, "group", object, &look, out);
  }
  return surround(context, "group", object, &alone, out);
}

celspan_status cs_object_graded(celspan_context *context, celspan_object *object,
                                const celspan_grade_desc *fields, celspan_object **out) {
  celspan_group_desc desc = CELSPAN_GROUP_DESC;
  CS_TRY(celspan_grade_create(context, fields, &desc.grade));
  desc.objects = &object;
  desc.object_count = 1;
  celspan_status status = celspan_object_create_group(context, &desc, out);
  celspan_grade_unref(desc.grade);
  return status;
}

/* ---------------------------------------------------------------- mattes */

celspan_status celspan_object_create_matte(celspan_context *context, celspan_object *art,
                                           celspan_object *by, celspan_matte_from from, bool invert,
                                           celspan_object **out) {
  CS_TRY(cs_check_given(context, "matte", "the art", art));
  CS_TRY(cs_check_given(context, "matte", "the object that it is matted by", by));
  CS_TRY(cs_check_choice(context, "matte", "from", (unsigned)from, CELSPAN_MATTE_DISSOLVE + 1));
  celspan_object *const both[] = {art, by};
  const cs_boolean look = {.op = CS_OPERATOR_MATTE,
                           .isolates = true,
                           .is_luma = from != CELSPAN_MATTE_ALPHA,
                           .inverts = invert,
                           .dissolves = from == CELSPAN_MATTE_DISSOLVE};
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_of_operands(context, "matte", &look, both, 2, &data));
  return cs_primitive_data_wrap(context, data, CELSPAN_OK, out);
}
