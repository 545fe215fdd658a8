/* Boolean objects: primitive data with operands. inside.h defines where they are present. */
#include "model/scene/check.h"
#include "model/scene/primitive_data.h"

const char *const cs_boolean_words[] = {
    [CELSPAN_OPERATOR_UNION] = "union",
    [CELSPAN_OPERATOR_INTERSECTION] = "intersection",
    [CELSPAN_OPERATOR_DIFFERENCE] = "difference",
    [CELSPAN_OPERATOR_XOR] = "xor",
    [CELSPAN_OPERATOR_CLIP] = "clip",
    [CS_OPERATOR_MATTE] = "matte",
};

static void show_operands(cs_primitive_data *data) {
  const cs_operands *view = &data->boolean->view;
  data->boolean->operands = view->objects;
  data->boolean->operand_count = view->count;
  data->is_empty = view->count == 0;
}

static celspan_status fill(celspan_context *context, cs_primitive_data *data, const char *noun,
                           celspan_object *const *operands, size_t count) {
  CS_TRY(cs_operands_create(context, noun, operands, count, &data->boolean->view));
  show_operands(data);
  CS_TRY(cs_primitive_data_measure(context, noun, operands, count, data));
  return cs_primitive_data_deepen(context, noun, data);
}

celspan_status celspan_object_create_boolean(celspan_context *context, celspan_operator op,
                                             celspan_object *const *operands, size_t operand_count,
                                             celspan_object **out) {
  CS_TRY(cs_check_choice(context, "boolean", "op", (unsigned)op, CELSPAN_OPERATOR_CLIP + 1));
  const char *noun = cs_boolean_words[op];
  if (op == CELSPAN_OPERATOR_CLIP && operand_count != 2)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "clip: %zu operands were given; it takes two",
                   operand_count);
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_BOOLEAN, NULL, &data));
  data->boolean->op = op;
  return cs_primitive_data_wrap(context, data, fill(context, data, noun, operands, operand_count),
                                out);
}

/* Copies the known properties of the operands that were added earlier. */
static celspan_status fill_more(celspan_context *context, cs_primitive_data *data,
                                const cs_primitive_data *from, celspan_object *const *operands,
                                size_t count) {
  const char *noun = cs_boolean_words[from->boolean->op];
  CS_TRY(cs_operands_extend(context, noun, &from->boolean->view, operands, count,
                            &data->boolean->view));
  show_operands(data);
  data->depth = (int16_t)(from->depth - 1); /* below this one */
  data->primitive_count = from->primitive_count;
  data->piece_count = from->piece_count;
  data->has_procedure = from->has_procedure;
  memcpy(data->blends, from->blends, sizeof data->blends);
  data->has_uneven = from->has_uneven;
  data->has_modes = from->has_modes;
  data->mixing = from->mixing;
  data->boolean->operands_hash = from->boolean->operands_hash;
  data->boolean->hashed_count = from->boolean->hashed_count;
  CS_TRY(cs_primitive_data_measure(context, noun, operands, count, data));
  return cs_primitive_data_deepen(context, noun, data);
}

static bool is_identity(const celspan_matrix *matrix) {
  const celspan_matrix identity = celspan_matrix_identity();
  bool is_same = true;
  for (int i = 0; i < 9; i++)
    is_same = is_same && matrix->m[i] == identity.m[i];
  return is_same;
}

static bool is_extendable(const celspan_object *object) {
  const cs_primitive_data *data = object->data;
  return data->kind == CS_PRIMITIVE_DATA_BOOLEAN && data->boolean->op < CELSPAN_OPERATOR_CLIP &&
         data->boolean->blend == CELSPAN_BLEND_NORMAL && !data->boolean->isolates &&
         data->boolean->space == CELSPAN_SPACE_AROUND && is_identity(object->matrix) &&
         object->fade == 1;
}

celspan_status celspan_object_extend_boolean(celspan_context *context, celspan_object *boolean,
                                             celspan_object *const *operands, size_t operand_count,
                                             celspan_object **out) {
  CS_TRY(cs_check_given(context, "extend", "the boolean", boolean));
  if (!is_extendable(boolean))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "extend: the object is not a union, intersection, difference or xor as it was "
                   "made, without transform and fade");
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_BOOLEAN, NULL, &data));
  data->boolean->op = boolean->data->boolean->op;
  celspan_status status = fill_more(context, data, boolean->data, operands, operand_count);
  return cs_primitive_data_wrap(context, data, status, out);
}
