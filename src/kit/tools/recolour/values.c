/* The walk over everything that is painted in a value, and how it is made again. */
#include "tools/recolour/recolour.h"

/* ---------------------------------------------------------------- objects */

static celspan_status recolour_primitive(cs_recolour *recolour, celspan_object *object,
                                         celspan_object **out) {
  celspan_texture *shown = object->data->texture, *texture;
  /* The texture that was given, not the unrolled one. */
  celspan_texture *given = shown->variation->origin ? shown->variation->origin : shown;
  recolour->object = object;
  CS_TRY(cs_recolour_texture(recolour, given, &texture));
  celspan_status status = CELSPAN_OK;
  if (texture == given)
    *out = celspan_object_ref(object);
  else
    status = cs_primitive_data_repaint(recolour->context, object, texture, out);
  celspan_texture_unref(texture);
  return status;
}

/* How many operands are painted; the others cut. */
static size_t painted_count(const cs_boolean *boolean) {
  bool is_first = boolean->op == CELSPAN_OPERATOR_DIFFERENCE ||
                  boolean->op == CELSPAN_OPERATOR_CLIP || boolean->op == CS_OPERATOR_MATTE;
  return is_first && boolean->operand_count > 1 ? 1 : boolean->operand_count;
}

/* A copy of a list in which the first objects are recoloured. *out: freed by free_list. */
static celspan_status recolour_list(cs_recolour *recolour, celspan_object *const *objects,
                                    size_t painted, size_t count, celspan_object ***out,
                                    bool *is_changed) {
  celspan_status status = CELSPAN_OK;
  *is_changed = false;
  CS_TRY(CS_MAKE(recolour->context, *out, count + 1));
  for (size_t i = 0; i < count && status == CELSPAN_OK; i++) {
    if (i < painted)
      status = cs_recolour_object(recolour, objects[i], &(*out)[i]);
    else
      (*out)[i] = celspan_object_ref(objects[i]);
    *is_changed = *is_changed || (*out)[i] != objects[i];
  }
  return status;
}

static void free_list(cs_recolour *recolour, celspan_object **objects, size_t count) {
  for (size_t i = 0; objects && i < count; i++)
    celspan_object_unref(objects[i]);
  cs_mem_free(recolour->context->memory, objects, objects ? (count + 1) * sizeof *objects : 0);
}

static celspan_status recolour_boolean(cs_recolour *recolour, celspan_object *object,
                                       celspan_object **out) {
  const cs_boolean *boolean = object->data->boolean;
  size_t count = boolean->operand_count;
  celspan_object **operands = NULL;
  bool is_changed;
  celspan_status status = recolour_list(recolour, boolean->operands, painted_count(boolean), count,
                                        &operands, &is_changed);
  if (status == CELSPAN_OK && is_changed)
    status = cs_boolean_with(recolour->context, object, operands, count, out);
  else if (status == CELSPAN_OK)
    *out = celspan_object_ref(object);
  free_list(recolour, operands, count);
  return status;
}

static celspan_status recolour_nested(cs_recolour *recolour, celspan_object *object,
                                      celspan_object **out) {
  celspan_rostrum *from = object->data->rostrum, *rostrum;
  CS_TRY(cs_recolour_rostrum(recolour, from, &rostrum));
  celspan_status status = CELSPAN_OK;
  if (rostrum == from)
    *out = celspan_object_ref(object);
  else
    status = cs_nested_with(recolour->context, object, rostrum, out);
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
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- cels and rostrums */

celspan_status cs_recolour_cel(cs_recolour *recolour, celspan_cel *cel, celspan_cel **out) {
  size_t count = cel->object_count;
  celspan_object **objects = NULL;
  bool is_changed;
  celspan_status status =
      recolour_list(recolour, cel->objects, count, count, &objects, &is_changed);
  if (status == CELSPAN_OK && is_changed)
    status = cs_cel_with(recolour->context, cel, objects, count, out);
  else if (status == CELSPAN_OK)
    *out = celspan_cel_ref(cel);
  free_list(recolour, objects, count);
  return status;
}

static celspan_status recolour_cels(cs_recolour *recolour, celspan_rostrum *rostrum,
                                    celspan_cel **cels, celspan_rostrum **out) {
  bool is_changed = false;
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    CS_TRY(cs_recolour_cel(recolour, rostrum->cels[i], &cels[i]));
    is_changed = is_changed || cels[i] != rostrum->cels[i];
  }
  if (!is_changed) {
    *out = celspan_rostrum_ref(rostrum);
    return CELSPAN_OK;
  }
  cs_light back = cs_light_ref(&rostrum->back);
  celspan_status status =
      cs_rostrum_change(recolour->context, rostrum, cels, rostrum->cel_count, back, out);
  if (status != CELSPAN_OK)
    cs_light_unref(&back);
  return status;
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
