/* Bounding boxes of objects and cels: nothing is painted outside them. */
#include <math.h>

#include "scene/primitive_data.h"
#include "stroke/outliner.h"

static celspan_box around(celspan_box a, celspan_box b) {
  double x = fmin(a.x, b.x), y = fmin(a.y, b.y);
  return (celspan_box){x, y, fmax(a.x + a.width, b.x + b.width) - x,
                       fmax(a.y + a.height, b.y + b.height) - y};
}

static celspan_box common(celspan_box a, celspan_box b) {
  double x = fmax(a.x, b.x), y = fmax(a.y, b.y);
  return (celspan_box){x, y, fmin(a.x + a.width, b.x + b.width) - x,
                       fmin(a.y + a.height, b.y + b.height) - y};
}

static bool object_bounds(const celspan_object *object, const celspan_matrix *parent,
                          celspan_box *out);

bool cs_primitive_data_list_bounds(celspan_object *const *objects, size_t count,
                                   const celspan_matrix *matrix, celspan_box *out) {
  bool found = false;
  celspan_box box;
  for (size_t i = 0; i < count; i++) {
    if (!object_bounds(objects[i], matrix, &box))
      continue;
    *out = found ? around(*out, box) : box;
    found = true;
  }
  return found;
}

static bool list_common(celspan_object *const *objects, size_t count, const celspan_matrix *matrix,
                        celspan_box *out) {
  celspan_box box;
  for (size_t i = 0; i < count; i++) {
    if (!object_bounds(objects[i], matrix, &box))
      return false;
    *out = i > 0 ? common(*out, box) : box;
    if (!(out->width > 0 && out->height > 0))
      return false;
  }
  return count > 0;
}

/* Without memory for its outline, the box that holds it, which is larger. */
static bool stroke_bounds(const cs_primitive_data *data, const celspan_matrix *matrix,
                          celspan_box *out) {
  celspan_context context = {.memory = data->memory};
  const celspan_box *around = &data->stroke->around;
  cs_outline outline;
  cs_outline_init(&outline);
  bool is_made = cs_stroke_outline_fine(&context, data->stroke, &outline) == CELSPAN_OK;
  if (!is_made) {
    cs_outline_finish(&outline, data->memory);
    is_made = cs_outline_rect(&context, &outline, around->x, around->y, around->width,
                              around->height, 0) == CELSPAN_OK;
  }
  bool is_seen = is_made && cs_outline_bounds(&outline, matrix, out);
  cs_outline_finish(&outline, data->memory);
  return is_seen;
}

static bool data_bounds(const cs_primitive_data *data, const celspan_matrix *matrix,
                        celspan_box *out) {
  if (data->stroke)
    return stroke_bounds(data, matrix, out);
  cs_outline_box room;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return cs_outline_bounds(cs_primitive_data_outline(data, &room), matrix, out);
  switch (data->boolean->op) {
  case CELSPAN_UNION:
  case CELSPAN_XOR:
    return cs_primitive_data_list_bounds(data->boolean->operands, data->boolean->operand_count,
                                         matrix, out);
  case CELSPAN_INTERSECTION:
  case CELSPAN_CLIP:
    return list_common(data->boolean->operands, data->boolean->operand_count, matrix, out);
  case CELSPAN_DIFFERENCE:
    break;
  }
  return object_bounds(data->boolean->operands[0], matrix, out);
}

static bool object_bounds(const celspan_object *object, const celspan_matrix *parent,
                          celspan_box *out) {
  celspan_matrix whole = celspan_matrix_then(*object->matrix, *parent), inverse;
  if (object->data->is_empty || !celspan_matrix_inverse(whole, &inverse))
    return false;
  return data_bounds(object->data, &whole, out);
}

bool celspan_object_bounds(const celspan_object *object, celspan_box *out) {
  const celspan_matrix identity = celspan_matrix_identity();
  celspan_box box;
  if (!object_bounds(object, &identity, &box))
    return false;
  *out = box;
  return true;
}

bool celspan_cel_bounds(const celspan_cel *cel, celspan_box *out) {
  celspan_box box;
  if (!cs_primitive_data_list_bounds(cel->objects, cel->object_count, &cel->matrix, &box))
    return false;
  *out = box;
  return true;
}
