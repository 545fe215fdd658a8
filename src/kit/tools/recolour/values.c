/* The walk over everything that is painted in a value, and how it is made again. */
#include "tools/recolour/recolour.h"

static celspan_status keep(celspan_object *object, celspan_object **out) {
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}

/* A copy of a list of objects. */
typedef struct copy {
  celspan_object **list;
  size_t count;
  bool is_changed;
} copy;

/* Recolours the first objects of a list, and keeps the others. *out must be freed even after an
 * error. */
static celspan_status recolour_list(cs_recolour *recolour, celspan_object *const *objects,
                                    size_t painted, size_t count, copy *out) {
  *out = (copy){.count = count};
  CS_TRY(CS_MAKE(recolour->context, out->list, count + 1));
  for (size_t i = 0; i < count; i++) {
    CS_TRY(i < painted ? cs_recolour_object(recolour, objects[i], &out->list[i])
                       : keep(objects[i], &out->list[i]));
    out->is_changed = out->is_changed || out->list[i] != objects[i];
  }
  return CELSPAN_OK;
}

static void free_copy(cs_recolour *recolour, copy *objects) {
  for (size_t i = 0; objects->list && i < objects->count; i++)
    celspan_object_unref(objects->list[i]);
  cs_mem_free(recolour->context->memory, objects->list,
              objects->list ? (objects->count + 1) * sizeof *objects->list : 0);
}

/* ---------------------------------------------------------------- objects */

static celspan_status recolour_primitive(cs_recolour *recolour, celspan_object *object,
                                         celspan_object **out) {
  celspan_texture *shown = object->data->texture, *texture;
  /* The texture that was given, not the unrolled one. */
  celspan_texture *given = shown->variation->origin ? shown->variation->origin : shown;
  recolour->object = object;
  CS_TRY(cs_recolour_texture(recolour, given, &texture));
  celspan_status status = texture == given
                              ? keep(object, out)
                              : cs_primitive_data_repaint(recolour->context, object, texture, out);
  celspan_texture_unref(texture);
  return status;
}

/* Of some operators the first operand alone is painted; the others cut. */
static celspan_status recolour_boolean(cs_recolour *recolour, celspan_object *object,
                                       celspan_object **out) {
  const cs_boolean *boolean = object->data->boolean;
  bool is_first = boolean->op == CELSPAN_OPERATOR_DIFFERENCE ||
                  boolean->op == CELSPAN_OPERATOR_CLIP || boolean->op == CS_OPERATOR_MATTE;
  copy made;
  celspan_status status =
      recolour_list(recolour, boolean->operands, is_first ? 1 : boolean->operand_count,
                    boolean->operand_count, &made);
  if (status == CELSPAN_OK)
    status = made.is_changed
                 ? cs_boolean_with(recolour->context, object, made.list, made.count, out)
                 : keep(object, out);
  free_copy(recolour, &made);
  return status;
}

static celspan_status recolour_nested(cs_recolour *recolour, celspan_object *object,
                                      celspan_object **out) {
  celspan_rostrum *from = object->data->rostrum, *rostrum;
  CS_TRY(cs_recolour_rostrum(recolour, from, &rostrum));
  celspan_status status =
      rostrum == from ? keep(object, out) : cs_nested_with(recolour->context, object, rostrum, out);
  celspan_rostrum_unref(rostrum);
  return status;
}

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
celspan_status cs_recolour_object(cs_recolour *recolour, celspan_object *object,
                                  celspan_object **out) {
  switch (object->data->kind) {
  case CS_PRIMITIVE_DATA_OUTLINE:
    return recolour_primitive(recolour, object, out);
  case CS_PRIMITIVE_DATA_BOOLEAN:
    return recolour_boolean(recolour, object, out);
  case CS_PRIMITIVE_DATA_ROSTRUM:
    return recolour_nested(recolour, object, out);
  case CS_PRIMITIVE_DATA_SCANLINE:
    break;
  }
  return keep(object, out);
}

/* ---------------------------------------------------------------- cels and rostrums */

static celspan_status recolour_cel(cs_recolour *recolour, celspan_cel *cel, celspan_cel **out) {
  copy made;
  celspan_status status =
      recolour_list(recolour, cel->objects, cel->object_count, cel->object_count, &made);
  if (status == CELSPAN_OK && made.is_changed)
    status = cs_cel_with(recolour->context, cel, made.list, made.count, out);
  else if (status == CELSPAN_OK)
    *out = celspan_cel_ref(cel);
  free_copy(recolour, &made);
  return status;
}

static celspan_status recolour_cels(cs_recolour *recolour, celspan_rostrum *rostrum,
                                    celspan_cel **cels, celspan_rostrum **out) {
  bool is_changed = false;
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    CS_TRY(recolour_cel(recolour, rostrum->cels[i], &cels[i]));
    is_changed = is_changed || cels[i] != rostrum->cels[i];
  }
  if (is_changed)
    return cs_rostrum_with(recolour->context, rostrum, cels, rostrum->cel_count, out);
  *out = celspan_rostrum_ref(rostrum);
  return CELSPAN_OK;
}

celspan_status cs_recolour_rostrum(cs_recolour *recolour, celspan_rostrum *rostrum,
                                   celspan_rostrum **out) {
  celspan_cel **cels;
  size_t count = rostrum->cel_count;
  CS_TRY(CS_MAKE(recolour->context, cels, count + 1));
  celspan_status status = recolour_cels(recolour, rostrum, cels, out);
  for (size_t i = 0; i < count; i++)
    celspan_cel_unref(cels[i]);
  cs_mem_free(recolour->context->memory, cels, (count + 1) * sizeof *cels);
  return status;
}
