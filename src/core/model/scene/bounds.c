/* Bounding boxes of objects and cels: nothing is painted outside them. */
#include "model/scene/bounds.h"

#include <math.h>

#include "model/geometry/boundary.h"
#include "model/geometry/matrix.h"
#include "model/stroke/outliner.h"

/* The tools for outlines of strokes. The status is that of the last outline that could not be made;
 * the box is then larger than necessary. */
typedef struct finder {
  celspan_context *context; /* NULL: the stroke's memory is used, and errors have no text */
  celspan_status status;
  bool is_outer; /* the wanted box may be larger: no outline is examined, or made for a stroke */
} finder;

static celspan_box common(celspan_box a, celspan_box b) {
  double x = fmax(a.x, b.x), y = fmax(a.y, b.y);
  return (celspan_box){x, y, fmin(a.x + a.width, b.x + b.width) - x,
                       fmin(a.y + a.height, b.y + b.height) - y};
}

static bool object_bounds(finder *f, const celspan_object *object, const celspan_matrix *parent,
                          celspan_box *out);

/* The box around a list's objects under a matrix; false if it would be empty. */
static bool list_around(finder *f, celspan_object *const *objects, size_t count,
                        const celspan_matrix *matrix, celspan_box *out) {
  bool found = false;
  celspan_box box;
  for (size_t i = 0; i < count; i++) {
    if (!object_bounds(f, objects[i], matrix, &box))
      continue;
    *out = found ? cs_outline_box_around(*out, box) : box;
    found = true;
  }
  return found;
}

static bool list_common(finder *f, celspan_object *const *objects, size_t count,
                        const celspan_matrix *matrix, celspan_box *out) {
  celspan_box box;
  for (size_t i = 0; i < count; i++) {
    if (!object_bounds(f, objects[i], matrix, &box))
      return false;
    *out = i > 0 ? common(*out, box) : box;
    if (!(out->width > 0 && out->height > 0))
      return false;
  }
  return count > 0;
}

static bool outer_bounds(const cs_primitive_data *data, const celspan_matrix *matrix,
                         celspan_box *out) {
  const celspan_box *box = data->stroke ? &data->stroke->around : &data->bounds;
  const celspan_matrix facing = cs_matrix_facing(matrix);
  cs_boundary_frame around;
  cs_outline_box room;
  if (cs_boundary_around_box(box, &facing, &around)) {
    *out = (celspan_box){around.left, around.top, around.right - around.left,
                         around.bottom - around.top};
    return true;
  }
  return cs_outline_bounds(cs_outline_of_box(box, &room), matrix, out);
}

/* The bounds of a stroke. If there is no memory for the outline, the outer box. */
static bool stroke_bounds(finder *f, const cs_primitive_data *data, const celspan_matrix *matrix,
                          celspan_box *out) {
  celspan_context own = {.memory = data->memory}, *context = f->context ? f->context : &own;
  bool is_seen;
  celspan_status status = cs_stroke_bounds(context, data->stroke, matrix, out, &is_seen);
  if (status == CELSPAN_OK)
    return is_seen;
  f->status = status;
  return outer_bounds(data, matrix, out);
}

static bool data_bounds(finder *f, const cs_primitive_data *data, const celspan_matrix *matrix,
                        celspan_box *out) {
  cs_outline_box room;
  if (f->is_outer && data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return outer_bounds(data, matrix, out);
  if (data->stroke)
    return stroke_bounds(f, data, matrix, out);
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return cs_outline_bounds(cs_primitive_data_outline(data, &room), matrix, out);
  const cs_boolean *boolean = data->boolean;
  switch (boolean->op) {
  case CELSPAN_OPERATOR_UNION:
  case CELSPAN_OPERATOR_XOR:
    return list_around(f, boolean->operands, boolean->operand_count, matrix, out);
  case CELSPAN_OPERATOR_INTERSECTION:
  case CELSPAN_OPERATOR_CLIP:
    return list_common(f, boolean->operands, boolean->operand_count, matrix, out);
  case CELSPAN_OPERATOR_DIFFERENCE:
    break;
  }
  return object_bounds(f, boolean->operands[0], matrix, out);
}

static bool object_bounds(finder *f, const celspan_object *object, const celspan_matrix *parent,
                          celspan_box *out) {
  celspan_matrix whole = celspan_matrix_then(*object->matrix, *parent), inverse;
  if (object->data->is_empty || !celspan_matrix_inverse(whole, &inverse))
    return false;
  return data_bounds(f, object->data, &whole, out);
}

/* *out is set only if there is something to paint. */
static bool find_object(finder *f, const celspan_object *object, celspan_box *out) {
  const celspan_matrix identity = celspan_matrix_identity();
  celspan_box box;
  bool is_there = object_bounds(f, object, &identity, &box);
  if (is_there)
    *out = box;
  return is_there;
}

static bool find_cel(finder *f, const celspan_cel *cel, celspan_box *out) {
  celspan_box box;
  bool is_there = list_around(f, cel->objects, cel->object_count, &cel->matrix, &box);
  if (is_there)
    *out = box;
  return is_there;
}

celspan_status cs_bounds_object(celspan_context *context, const celspan_object *object,
                                bool *is_there, celspan_box *out) {
  finder f = {.context = context, .status = CELSPAN_OK};
  *is_there = find_object(&f, object, out);
  return f.status;
}

celspan_status cs_bounds_cel(celspan_context *context, const celspan_cel *cel, bool *is_there,
                             celspan_box *out) {
  finder f = {.context = context, .status = CELSPAN_OK};
  *is_there = find_cel(&f, cel, out);
  return f.status;
}

celspan_status cs_bounds_drawing(celspan_context *context, const celspan_cel *cel,
                                 const celspan_matrix *matrix, bool *is_there, celspan_box *out) {
  finder f = {.context = context, .status = CELSPAN_OK};
  celspan_box box;
  *is_there = list_around(&f, cel->objects, cel->object_count, matrix, &box);
  if (*is_there)
    *out = box;
  return f.status;
}

bool cs_bounds_around(celspan_object *const *objects, size_t count, const celspan_matrix *matrix,
                      celspan_box *out) {
  celspan_box box;
  bool is_there = list_around(&(finder){.is_outer = true}, objects, count, matrix, &box);
  if (is_there)
    *out = box;
  return is_there;
}

bool celspan_object_bounds(const celspan_object *object, celspan_box *out) {
  return find_object(&(finder){.context = NULL}, object, out);
}

bool celspan_cel_bounds(const celspan_cel *cel, celspan_box *out) {
  return find_cel(&(finder){.context = NULL}, cel, out);
}
