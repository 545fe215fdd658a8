#include "model/scene/grow.h"

#include <math.h>

#include "base/number.h"
#include "model/geometry/matrix.h"
#include "model/scene/pattern.h"
#include "model/scene/primitive_data.h"
#include "model/stroke/outliner.h"

#define ALIKE 1e-9 /* lengths count as equal if their squares differ by less */

/* ---------------------------------------------------------------- what is grown how */

bool cs_grow_is_vector(const celspan_object *object) {
  const cs_primitive_data *data = cs_pattern_shape(object->data);
  if (data->kind == CS_PRIMITIVE_DATA_OUTLINE)
    return data->texture->kind != CS_TEXTURE_PICTURE;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN || data->boolean->op == CS_OPERATOR_MATTE ||
      cs_grade_keys(data->boolean->grade))
    return false;
  for (size_t i = 0; i < data->boolean->operand_count; i++)
    if (!cs_grow_is_vector(data->boolean->operands[i]))
      return false;
  return true;
}

typedef struct grower {
  celspan_context *context;
  const cs_grow *how;
} grower;

/* The grown object and the shrunken one; NULL if one of them is not wanted. Both are made at once,
 * since an xor needs both of each operand: otherwise nested operands would be made again at every
 * level. */
typedef struct sizes {
  celspan_object *grown, *shrunk;
} sizes;

typedef struct wanted {
  bool grown, shrunk;
} wanted;

static void drop(sizes *both) {
  celspan_object_unref(both->grown);
  celspan_object_unref(both->shrunk);
  *both = (sizes){NULL, NULL};
}

static celspan_status combine(const grower *g, celspan_operator op, celspan_object *first,
                              celspan_object *second, celspan_object **out) {
  celspan_object *const both[] = {first, second};
  return celspan_object_create_boolean(g->context, op, both, 2, out);
}

/* The shape with the rim of its outline added, and the shape without the rim. */
static celspan_status add_rim(const grower *g, celspan_object *shape, celspan_object *rim,
                              wanted want, sizes *out) {
  if (want.grown)
    CS_TRY(combine(g, CELSPAN_OPERATOR_UNION, shape, rim, &out->grown));
  return want.shrunk ? combine(g, CELSPAN_OPERATOR_DIFFERENCE, shape, rim, &out->shrunk)
                     : CELSPAN_OK;
}

/* ---------------------------------------------------------------- primitives */

static celspan_status place_point(const grower *g, const celspan_matrix *matrix, cs_hpoint from,
                                  cs_hpoint *to) {
  *to = cs_matrix_apply(matrix, from);
  if (to->w > 0 && cs_number_is_sane(to->x / to->w) && cs_number_is_sane(to->y / to->w))
    return CELSPAN_OK;
  return cs_fail(g->context, CELSPAN_BAD_ARGUMENT,
                 "outline: the object reaches the horizon of its perspective; give it its outline "
                 "before it is put in perspective");
}

static celspan_status place_piece(const grower *g, const celspan_matrix *matrix,
                                  const cs_outline *from, size_t piece, cs_outline *to) {
  cs_hpoint points[UINT8_MAX];
  const cs_hpoint *own = from->points + from->starts[piece] + 1;
  for (size_t i = 0; i < from->degrees[piece]; i++)
    CS_TRY(place_point(g, matrix, own[i], &points[i]));
  return cs_outline_piece(g->context, to, from->degrees[piece], points);
}

/* Appends the outline under a matrix. */
static celspan_status place_outline(const grower *g, const celspan_matrix *matrix,
                                    const cs_outline *from, cs_outline *to) {
  for (size_t c = 0; c < from->contour_count; c++) {
    size_t piece = from->contours[c];
    size_t end = c + 1 < from->contour_count ? from->contours[c + 1] : from->piece_count;
    cs_hpoint start;
    CS_TRY(place_point(g, matrix, from->points[from->starts[piece]], &start));
    CS_TRY(cs_outline_move(g->context, to, start));
    for (; piece < end; piece++)
      CS_TRY(place_piece(g, matrix, from, piece, to));
  }
  return cs_outline_close(g->context, to);
}

/* The outline of data in the units around the whole. */
static celspan_status find_outline(const grower *g, const celspan_matrix *matrix,
                                   const cs_primitive_data *data, cs_outline *out) {
  cs_outline_box room;
  cs_outline made;
  if (!data->stroke)
    return place_outline(g, matrix, cs_primitive_data_outline(data, &room), out);
  cs_outline_init(&made);
  celspan_status status = cs_stroke_outline_finely(g->context, data->stroke, &made);
  if (status == CELSPAN_OK)
    status = place_outline(g, matrix, &made, out);
  cs_outline_finish(&made, g->context->memory);
  return status;
}

/* All points within the width of the outline. */
static celspan_status make_rim(const grower *g, const cs_primitive_data *data,
                               const celspan_matrix *matrix, celspan_object **out) {
  const celspan_matrix facing = cs_matrix_facing(matrix);
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  cs_outline outline;
  desc.width = 2 * fabs(g->how->width);
  desc.join = g->how->join;
  cs_outline_init(&outline);
  celspan_status status = find_outline(g, &facing, data, &outline);
  if (status == CELSPAN_OK)
    status = cs_primitive_data_of_line(g->context, &outline, NULL, &desc, out);
  cs_outline_finish(&outline, g->context->memory);
  return status;
}

/* data: of the object, or of the shape in it. around: from the units around the object to the units
 * around the whole. */
static celspan_status grow_primitive(const grower *g, celspan_object *object,
                                     const cs_primitive_data *data, const celspan_matrix *around,
                                     wanted want, sizes *out) {
  const celspan_matrix whole = celspan_matrix_then(*object->matrix, *around);
  celspan_object *shape, *rim = NULL;
  CS_TRY(celspan_object_transform(g->context, object, around, &shape));
  if (data->is_empty) {
    out->grown = want.grown ? celspan_object_ref(shape) : NULL;
    out->shrunk = want.shrunk ? celspan_object_ref(shape) : NULL;
    celspan_object_unref(shape);
    return CELSPAN_OK;
  }
  celspan_status status = make_rim(g, data, &whole, &rim);
  if (status == CELSPAN_OK)
    status = add_rim(g, shape, rim, want, out);
  celspan_object_unref(shape);
  celspan_object_unref(rim);
  return status;
}

/* ---------------------------------------------------------------- booleans */

static celspan_status grow_any(const grower *g, celspan_object *object,
                               const celspan_matrix *around, wanted want, sizes *out);

/* The operands of a boolean for growing it, and after them the operands for shrinking it. */
static celspan_status grow_operands(const grower *g, const cs_boolean *boolean,
                                    const celspan_matrix *around, wanted want,
                                    celspan_object **list) {
  const size_t count = boolean->operand_count;
  for (size_t i = 0; i < count; i++) {
    sizes both = {NULL, NULL};
    const bool is_taken_off = boolean->op == CELSPAN_OPERATOR_DIFFERENCE && i > 0;
    const wanted of_it = is_taken_off ? (wanted){want.shrunk, want.grown} : want;
    celspan_status status = grow_any(g, boolean->operands[i], around, of_it, &both);
    list[i] = is_taken_off ? both.shrunk : both.grown;
    list[count + i] = is_taken_off ? both.grown : both.shrunk;
    CS_TRY(status);
  }
  return CELSPAN_OK;
}

/* An xor has the outlines of all its operands. */
static celspan_status grow_xor(const grower *g, celspan_object *object,
                               const celspan_matrix *around, wanted want, celspan_object **list,
                               sizes *out) {
  const size_t count = object->data->boolean->operand_count;
  celspan_object *shape = NULL, *rim = NULL;
  for (size_t i = 0; i < count; i++) {
    celspan_object *border;
    CS_TRY(combine(g, CELSPAN_OPERATOR_DIFFERENCE, list[i], list[count + i], &border));
    celspan_object_unref(list[i]);
    list[i] = border;
  }
  CS_TRY(celspan_object_create_boolean(g->context, CELSPAN_OPERATOR_UNION, list, count, &rim));
  celspan_status status = celspan_object_transform(g->context, object, around, &shape);
  if (status == CELSPAN_OK)
    status = add_rim(g, shape, rim, want, out);
  celspan_object_unref(shape);
  celspan_object_unref(rim);
  return status;
}

static celspan_status join_operands(const grower *g, const cs_boolean *boolean, wanted want,
                                    celspan_object **list, sizes *out) {
  const size_t count = boolean->operand_count;
  const celspan_operator op =
      boolean->op == CELSPAN_OPERATOR_CLIP ? CELSPAN_OPERATOR_INTERSECTION : boolean->op;
  celspan_object **shrunk = count > 0 ? list + count : NULL; /* an empty list is NULL */
  if (want.grown)
    CS_TRY(celspan_object_create_boolean(g->context, op, list, count, &out->grown));
  return want.shrunk ? celspan_object_create_boolean(g->context, op, shrunk, count, &out->shrunk)
                     : CELSPAN_OK;
}

static celspan_status grow_boolean(const grower *g, celspan_object *object,
                                   const celspan_matrix *around, wanted want, sizes *out) {
  const cs_boolean *boolean = object->data->boolean;
  const wanted both = {true, true}, of_them = boolean->op == CELSPAN_OPERATOR_XOR ? both : want;
  const celspan_matrix whole = celspan_matrix_then(*object->matrix, *around);
  const size_t count = 2 * boolean->operand_count;
  celspan_object **list = cs_mem_array(g->context->memory, count, sizeof *list);
  if (!list && count > 0)
    return cs_fail_memory(g->context);
  celspan_status status = grow_operands(g, boolean, &whole, of_them, list);
  if (status == CELSPAN_OK)
    status = boolean->op == CELSPAN_OPERATOR_XOR ? grow_xor(g, object, around, want, list, out)
                                                 : join_operands(g, boolean, want, list, out);
  cs_primitive_data_list_free(g->context->memory, list, count);
  return status;
}

/* ---------------------------------------------------------------- inner objects */

/* An inner object in its place, and how it is grown there. */
typedef struct placed_inner {
  celspan_object *object; /* borrowed */
  celspan_matrix matrix;
  cs_grow how;
} placed_inner;

/* The factor by which a matrix scales all lengths; false if it differs between directions. */
static bool find_scale(const celspan_matrix *matrix, double *scale) {
  const double *m = matrix->m;
  const double across = m[0] * m[0] + m[3] * m[3], down = m[1] * m[1] + m[4] * m[4];
  *scale = sqrt(across);
  return cs_matrix_keeps_weights(matrix) && fabs(across - down) <= ALIKE * across &&
         fabs(m[0] * m[1] + m[3] * m[4]) <= ALIKE * across;
}

/* The object inside an object with a mode, or inside a named group, may have an inner object. */
static const celspan_object *find_inner(const celspan_object *object, celspan_matrix *matrix) {
  const cs_primitive_data *data = object->data;
  while (data->kind == CS_PRIMITIVE_DATA_BOOLEAN && data->boolean->op == CELSPAN_OPERATOR_UNION &&
         data->boolean->operand_count == 1 && !data->boolean->inner.object) {
    object = data->boolean->operands[0];
    data = object->data;
    *matrix = celspan_matrix_then(*object->matrix, *matrix);
  }
  return object;
}

/* Whether growing an object gives the same as growing its inner object farther. */
static bool place_inner(const cs_grow *how, const celspan_object *object,
                        const celspan_matrix *around, placed_inner *out) {
  double scale;
  out->matrix = celspan_matrix_then(*object->matrix, *around);
  const cs_primitive_data *data = find_inner(object, &out->matrix)->data;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN || !data->boolean->inner.object)
    return false;
  const cs_inner *inner = &data->boolean->inner;
  if ((inner->join != CELSPAN_STROKE_JOIN_ROUND && inner->join != how->join) ||
      !find_scale(&out->matrix, &scale))
    return false;
  out->object = inner->object;
  out->how = (cs_grow){scale * inner->width + how->width, inner->join};
  return true;
}

celspan_status cs_grow_note(celspan_context *context, celspan_object *boolean,
                            celspan_object *object, const cs_grow *grow) {
  const celspan_matrix identity = celspan_matrix_identity();
  placed_inner inner = {object, identity, *grow};
  if (!place_inner(grow, object, &identity, &inner))
    inner = (placed_inner){object, identity, *grow};
  celspan_object *placed;
  CS_TRY(celspan_object_transform(context, inner.object, &inner.matrix, &placed));
  boolean->data->boolean->inner = (cs_inner){placed, inner.how.width, inner.how.join};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- objects */

/* Recursion ends: nesting is at most CS_SCENE_DEPTH, and an inner object inside another has other
 * joins. After an error *out is empty. */
static celspan_status grow_any(const grower *g, celspan_object *object,
                               const celspan_matrix *around, wanted want, sizes *out) {
  placed_inner inner;
  if (!want.shrunk && place_inner(g->how, object, around, &inner)) {
    const grower farther = {g->context, &inner.how};
    return grow_any(&farther, inner.object, &inner.matrix, want, out);
  }
  const cs_primitive_data *data = cs_pattern_shape(object->data);
  celspan_status status = data->kind == CS_PRIMITIVE_DATA_BOOLEAN
                              ? grow_boolean(g, object, around, want, out)
                              : grow_primitive(g, object, data, around, want, out);
  if (status != CELSPAN_OK)
    drop(out);
  return status;
}

celspan_status cs_grow_object(celspan_context *context, celspan_object *object, const cs_grow *grow,
                              celspan_object **out) {
  const grower g = {context, grow};
  const celspan_matrix identity = celspan_matrix_identity();
  const wanted want = {.grown = grow->width > 0, .shrunk = grow->width <= 0};
  sizes made = {NULL, NULL};
  CS_TRY(grow_any(&g, object, &identity, want, &made));
  *out = want.grown ? made.grown : made.shrunk;
  return CELSPAN_OK;
}
