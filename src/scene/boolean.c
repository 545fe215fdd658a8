/* Boolean objects: primitive data with operands. inside.h defines where they are present. */
#include "scene/check.h"
#include "scene/primitive_data.h"

static const char *const nouns[] = {
    [CELSPAN_UNION] = "union",
    [CELSPAN_INTERSECTION] = "intersection",
    [CELSPAN_DIFFERENCE] = "difference",
    [CELSPAN_XOR] = "xor",
    [CELSPAN_CLIP] = "clip",
};

/* Finds the depth and the number of primitives, and checks them against their limits. */
static celspan_status measure(celspan_context *context, cs_primitive_data *data, const char *noun) {
  for (size_t i = 0; i < data->operand_count; i++) {
    const cs_primitive_data *operand = data->operands[i]->data;
    data->depth = operand->depth > data->depth ? operand->depth : data->depth;
    data->primitive_count += operand->primitive_count;
    data->has_procedure |= operand->has_procedure;
    if (data->primitive_count > CS_SCENE_PRIMITIVES)
      return cs_fail(context, CELSPAN_LIMIT, "%s: it holds more than %d primitives", noun,
                     CS_SCENE_PRIMITIVES);
  }
  data->depth++;
  if (data->depth > CS_SCENE_DEPTH)
    return cs_fail(context, CELSPAN_LIMIT, "%s: nested %d levels deep; the limit is %d", noun,
                   data->depth, CS_SCENE_DEPTH);
  return CELSPAN_OK;
}

static celspan_status fill(celspan_context *context, cs_primitive_data *data, const char *noun,
                           celspan_object *const *operands, size_t count) {
  CS_TRY(cs_primitive_data_list_copy(context, noun, "operands", operands, count, &data->operands));
  data->operand_count = count;
  data->is_empty = count == 0;
  return measure(context, data, noun);
}

celspan_status celspan_object_create_boolean(celspan_context *context, celspan_operator op,
                                             celspan_object *const *operands, size_t operand_count,
                                             celspan_object **out) {
  CS_TRY(cs_check_choice(context, "boolean", "op", (unsigned)op, CELSPAN_CLIP + 1));
  const char *noun = nouns[op];
  if (op == CELSPAN_CLIP && operand_count != 2)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "clip: %zu operands were given; it takes two",
                   operand_count);
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_BOOLEAN, NULL, &data));
  data->op = op;
  return cs_primitive_data_wrap(context, data, fill(context, data, noun, operands, operand_count),
                                out);
}
