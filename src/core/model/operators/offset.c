/* Growing and shrinking. Unlike the other operators it gives shapes in the units around the object,
 * where the distance counts, and no strokes.
 *
 *     grown: the shape, and a stroke of twice the        +-----------+
 *     distance along its outline;                        | +-------+ |  the stroke, from d outside
 *     shrunk: the shape without that stroke.             | |shrunk | |  to d inside
 *                                                        | +-------+ |
 *     A line is grown like the shape inside it: the      +-----------+
 *     ring between two regions, half a width to
 *     either side of the distance.
 */
#include <math.h>

#include "base/number.h"
#include "celspan/operators.h"
#include "model/geometry/matrix.h"
#include "model/operators/lines.h"
#include "model/scene/check.h"
#include "model/scene/pattern.h"
#include "model/scene/primitive_data.h"
#include "model/scene/texture.h"
#include "model/stroke/outliner.h"

#define LIMIT_MOST 1e6

typedef struct growing {
  celspan_context *context;
  double distance;
  celspan_stroke_join join;
  double limit;
} growing;

/* ---------------------------------------------------------------- lines */

typedef enum wanted { EVERY, CLOSED, OPEN } wanted;

static celspan_status check_piece(const growing *g, const cs_bezier *piece) {
  for (int i = 0; i <= piece->degree; i++) {
    celspan_point p = cs_hpoint_place(piece->points[i]);
    if (!(piece->points[i].w > 0) || !cs_number_is_sane(p.x) || !cs_number_is_sane(p.y))
      return cs_fail(g->context, CELSPAN_BAD_ARGUMENT,
                     "offset: the object reaches the horizon of its perspective; change it before "
                     "it is put in perspective");
  }
  return CELSPAN_OK;
}

/* Appends the wanted contours, placed by a matrix. */
static celspan_status place(const growing *g, const cs_lines *from, wanted which,
                            const celspan_matrix *matrix, cs_lines *to) {
  cs_bezier piece;
  size_t closed_at = 0;
  for (size_t c = 0; c < from->outline.contour_count; c++) {
    const cs_lines_contour contour = cs_lines_contour_at(from, c, &closed_at);
    if (which != EVERY && contour.is_closed != (which == CLOSED))
      continue;
    for (size_t i = contour.begin; i < contour.end; i++) {
      cs_bezier_load(&from->outline, i, matrix, &piece);
      CS_TRY(check_piece(g, &piece));
      if (i == contour.begin)
        CS_TRY(cs_lines_begin(g->context, to, piece.points[0]));
      CS_TRY(cs_lines_add(g->context, to, &piece));
    }
    CS_TRY(cs_lines_end(g->context, to, contour.is_closed));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- shapes */

/* Both objects are released. second: NULL: *out is the first. */
static celspan_status combine(const growing *g, celspan_operator op, celspan_object *first,
                              celspan_object *second, celspan_object **out) {
  celspan_object *const both[] = {first, second};
  celspan_status status = CELSPAN_OK;
  if (second)
    status = celspan_object_create_boolean(g->context, op, both, 2, out);
  else
    *out = celspan_object_ref(first);
  celspan_object_unref(first);
  celspan_object_unref(second);
  return status;
}

/* All points within the distance of the lines. */
static celspan_status make_rim(const growing *g, const cs_lines *lines, double distance,
                               celspan_texture *texture, celspan_object **out) {
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  bool is_round = g->join == CELSPAN_STROKE_JOIN_ROUND;
  desc.width = 2 * distance;
  desc.join = g->join;
  desc.miter = g->limit;
  desc.cap = is_round ? CELSPAN_STROKE_CAP_ROUND : CELSPAN_STROKE_CAP_SQUARE;
  desc.texture = texture;
  return cs_primitive_data_of_line(g->context, &lines->outline,
                                   lines->is_filled ? NULL : &lines->closed, &desc, out);
}

static celspan_status make_shape(const growing *g, const cs_lines *lines, celspan_rule rule,
                                 celspan_texture *texture, celspan_object **out) {
  const celspan_matrix identity = celspan_matrix_identity();
  cs_lines own;
  cs_lines_init(&own, true);
  celspan_status status = place(g, lines, EVERY, &identity, &own);
  if (status == CELSPAN_OK) {
    cs_outline taken = own.outline;
    cs_outline_init(&own.outline);
    status = cs_primitive_data_of_outline(g->context, &taken, rule, texture, out);
  }
  cs_lines_finish(&own, g->context->memory);
  return status;
}

/* The region inside the lines, grown or shrunk by the distance. */
static celspan_status make_region(const growing *g, const cs_lines *lines, celspan_rule rule,
                                  double distance, celspan_texture *texture, celspan_object **out) {
  celspan_object *shape, *rim = NULL;
  CS_TRY(make_shape(g, lines, rule, texture, &shape));
  celspan_status status =
      distance != 0 ? make_rim(g, lines, fabs(distance), texture, &rim) : CELSPAN_OK;
  if (status == CELSPAN_OK)
    return combine(g, distance > 0 ? CELSPAN_OPERATOR_UNION : CELSPAN_OPERATOR_DIFFERENCE, shape,
                   rim, out);
  celspan_object_unref(shape);
  return status;
}

/* The ring of closed lines that are `half` wide on either side. */
static celspan_status make_ring(const growing *g, const cs_lines *lines, double half,
                                celspan_texture *texture, celspan_object **out) {
  celspan_object *outer, *inner;
  CS_TRY(make_region(g, lines, CELSPAN_RULE_NONZERO, g->distance + half, texture, &outer));
  celspan_status status =
      make_region(g, lines, CELSPAN_RULE_NONZERO, g->distance - half, texture, &inner);
  if (status == CELSPAN_OK)
    return combine(g, CELSPAN_OPERATOR_DIFFERENCE, outer, inner, out);
  celspan_object_unref(outer);
  return status;
}

/* A line around open lines. */
static celspan_status make_rail(const growing *g, const cs_lines *lines, double half,
                                celspan_texture *texture, celspan_object **out) {
  celspan_object *outer, *inner = NULL;
  double far = fabs(g->distance) + half, near = fabs(g->distance) - half;
  CS_TRY(make_rim(g, lines, far, texture, &outer));
  celspan_status status = near > 0 ? make_rim(g, lines, near, texture, &inner) : CELSPAN_OK;
  if (status == CELSPAN_OK)
    return combine(g, CELSPAN_OPERATOR_DIFFERENCE, outer, inner, out);
  celspan_object_unref(outer);
  return status;
}

/* ---------------------------------------------------------------- primitives */

typedef celspan_status (*maker)(const growing *g, const cs_lines *lines, double half,
                                celspan_texture *texture, celspan_object **out);

/* Makes what the wanted contours give; no object if there are none. */
static celspan_status make_part(const growing *g, const cs_lines *lines, wanted which,
                                const celspan_matrix *matrix, double half, celspan_texture *texture,
                                celspan_object **out) {
  cs_lines placed;
  cs_lines_init(&placed, which == CLOSED);
  celspan_status status = place(g, lines, which, matrix, &placed);
  maker make = which == CLOSED ? make_ring : make_rail;
  if (status == CELSPAN_OK && placed.outline.piece_count > 0)
    status = make(g, &placed, half, texture, out);
  cs_lines_finish(&placed, g->context->memory);
  return status;
}

static celspan_status grow_line(const growing *g, const cs_stroke *stroke,
                                const celspan_matrix *matrix, celspan_texture *texture,
                                celspan_object **out) {
  const double *m = matrix->m;
  double half = stroke->largest * sqrt(fabs(m[0] * m[4] - m[1] * m[3]));
  celspan_object *parts[2] = {NULL, NULL};
  cs_lines lines;
  cs_lines_init(&lines, false);
  celspan_status status = cs_lines_of_stroke(g->context, stroke, &lines);
  if (status == CELSPAN_OK)
    status = make_part(g, &lines, CLOSED, matrix, half, texture, &parts[0]);
  if (status == CELSPAN_OK)
    status = make_part(g, &lines, OPEN, matrix, half, texture, &parts[parts[0] ? 1 : 0]);
  size_t count = (parts[0] != NULL) + (parts[1] != NULL);
  if (status == CELSPAN_OK)
    status = celspan_object_create_boolean(g->context, CELSPAN_OPERATOR_UNION, parts, count, out);
  for (int i = 0; i < 2; i++)
    celspan_object_unref(parts[i]);
  cs_lines_finish(&lines, g->context->memory);
  return status;
}

static celspan_status grow_outline(const growing *g, const cs_outline *outline, celspan_rule rule,
                                   const celspan_matrix *matrix, celspan_texture *texture,
                                   celspan_object **out) {
  const cs_lines from = {.outline = *outline, .is_filled = true};
  cs_lines placed;
  cs_lines_init(&placed, true);
  celspan_status status = place(g, &from, EVERY, matrix, &placed);
  if (status == CELSPAN_OK && placed.outline.piece_count > 0)
    status = make_region(g, &placed, rule, g->distance, texture, out);
  else if (status == CELSPAN_OK)
    status = celspan_object_create_boolean(g->context, CELSPAN_OPERATOR_UNION, NULL, 0, out);
  cs_lines_finish(&placed, g->context->memory);
  return status;
}

/* A stroke with dashes, or with a width that varies, grows like a shape. */
static celspan_status grow_stroke(const growing *g, const cs_stroke *stroke,
                                  const celspan_matrix *matrix, celspan_texture *texture,
                                  celspan_object **out) {
  if (cs_stroke_is_plain(stroke) && cs_matrix_is_affine(matrix))
    return grow_line(g, stroke, matrix, texture, out);
  cs_outline made;
  cs_outline_init(&made);
  celspan_status status = cs_stroke_outline_finely(g->context, stroke, &made);
  if (status == CELSPAN_OK)
    status = grow_outline(g, &made, CELSPAN_RULE_NONZERO, matrix, texture, out);
  cs_outline_finish(&made, g->context->memory);
  return status;
}

/* ---------------------------------------------------------------- textures */

/* The texture as it appears on the placed object; a picture keeps its box. */
static celspan_status place_texture(const growing *g, const cs_primitive_data *data,
                                    const celspan_matrix *matrix, celspan_texture **out) {
  celspan_texture *boxed;
  CS_TRY(cs_texture_boxed(g->context, data->texture, &data->bounds, &boxed));
  celspan_status status = celspan_texture_with_matrix(g->context, boxed, matrix, out);
  celspan_texture_unref(boxed);
  return status;
}

/* A shape and its rim are painted as one, so that what is translucent is painted once. One opaque
 * colour is left as it is. *object is replaced. */
static celspan_status paint(const growing *g, celspan_texture *texture, celspan_object **object) {
  celspan_box box;
  if ((texture->kind == CS_TEXTURE_FLAT && texture->flat.beta == 1) ||
      !celspan_object_bounds(*object, &box))
    return CELSPAN_OK;
  const celspan_rect_desc desc = {sizeof desc, box.x, box.y, box.width, box.height, 0, texture};
  celspan_object *cover, *shape = *object;
  CS_TRY(celspan_object_create_rect(g->context, &desc, &cover));
  *object = NULL;
  return combine(g, CELSPAN_OPERATOR_CLIP, cover, shape, object);
}

static celspan_status grow_primitive(const growing *g, const cs_primitive_data *data,
                                     const celspan_matrix *matrix, celspan_object **out) {
  const celspan_matrix facing = cs_matrix_facing(matrix);
  cs_outline_box room;
  celspan_texture *texture;
  if (data->kind != CS_PRIMITIVE_DATA_OUTLINE)
    return cs_fail(g->context, CELSPAN_BAD_ARGUMENT,
                   "offset: a rostrum, a scan-line procedure and what is blurred have no outline");
  CS_TRY(place_texture(g, data, matrix, &texture));
  celspan_status status = data->stroke ? grow_stroke(g, data->stroke, &facing, texture, out)
                                       : grow_outline(g, cs_primitive_data_outline(data, &room),
                                                      data->rule, &facing, texture, out);
  if (status == CELSPAN_OK)
    status = paint(g, texture, out);
  celspan_texture_unref(texture);
  return status;
}

/* ---------------------------------------------------------------- objects */

static celspan_status grow(const growing *g, celspan_object *object, const celspan_matrix *around,
                           celspan_object **out);

/* All points within the distance of an object's outline. */
static celspan_status make_rim_of(const growing *g, celspan_object *object,
                                  const celspan_matrix *matrix, celspan_object **out) {
  const growing more = {g->context, fabs(g->distance), g->join, g->limit},
                less = {g->context, -fabs(g->distance), g->join, g->limit};
  celspan_object *outer, *inner;
  CS_TRY(grow(&more, object, matrix, &outer));
  celspan_status status = grow(&less, object, matrix, &inner);
  if (status == CELSPAN_OK)
    return combine(g, CELSPAN_OPERATOR_DIFFERENCE, outer, inner, out);
  celspan_object_unref(outer);
  return status;
}

/* parts: the exclusive or itself, in its place, and the rims. What lies in a rim and not in the
 * exclusive or is added when it grows. */
static celspan_status join_rims(const growing *g, celspan_object *const *parts, size_t count,
                                celspan_object **out) {
  celspan_object *rims;
  if (g->distance < 0)
    return celspan_object_create_boolean(g->context, CELSPAN_OPERATOR_DIFFERENCE, parts, count,
                                         out);
  CS_TRY(celspan_object_create_boolean(g->context, CELSPAN_OPERATOR_UNION, parts + 1, count - 1,
                                       &rims));
  CS_TRY(combine(g, CELSPAN_OPERATOR_DIFFERENCE, rims, celspan_object_ref(parts[0]), &rims));
  return combine(g, CELSPAN_OPERATOR_UNION, rims, celspan_object_ref(parts[0]), out);
}

/* An exclusive or has the outlines of all its operands. */
static celspan_status grow_xor(const growing *g, const cs_boolean *boolean,
                               const celspan_matrix *matrix, celspan_object **out) {
  celspan_context *context = g->context;
  const size_t count = boolean->operand_count + 1;
  celspan_object *shape, **parts = cs_mem_array(context->memory, count, sizeof *parts);
  if (!parts)
    return cs_fail_memory(context);
  celspan_status status =
      cs_boolean_like(context, boolean, boolean->operands, boolean->operand_count, &shape);
  if (status == CELSPAN_OK) {
    status = celspan_object_transform(context, shape, matrix, &parts[0]);
    celspan_object_unref(shape);
  }
  for (size_t i = 1; status == CELSPAN_OK && i < count; i++)
    status = make_rim_of(g, boolean->operands[i - 1], matrix, &parts[i]);
  if (status == CELSPAN_OK)
    status = join_rims(g, parts, count, out);
  cs_primitive_data_list_free(context->memory, parts, count);
  return status;
}

/* The first operand of a shape that a pattern fills is the plane of the pattern. What is taken away
 * moves the other way. */
static celspan_status grow_boolean(const growing *g, const cs_boolean *boolean,
                                   const celspan_matrix *matrix, celspan_object **out) {
  celspan_context *context = g->context;
  const growing taken = {context, -g->distance, g->join, g->limit};
  size_t count = boolean->operand_count;
  celspan_object **operands = cs_mem_array(context->memory, count, sizeof *operands);
  if (!operands && count > 0)
    return cs_fail_memory(context);
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; status == CELSPAN_OK && i < count; i++) {
    if (boolean->is_filled && i == 0)
      status = celspan_object_transform(context, boolean->operands[i], matrix, &operands[i]);
    else
      status = grow(boolean->op == CELSPAN_OPERATOR_DIFFERENCE && i > 0 ? &taken : g,
                    boolean->operands[i], matrix, &operands[i]);
  }
  if (status == CELSPAN_OK && boolean->is_filled)
    status = cs_pattern_refill(context, operands[1], &operands[0]);
  if (status == CELSPAN_OK)
    status = cs_boolean_like(context, boolean, operands, count, out);
  cs_primitive_data_list_free(context->memory, operands, count);
  return status;
}

/* Replaces *made by a copy with the fade and the name of the object. */
static celspan_status finish(const growing *g, const celspan_object *object,
                             celspan_object **made) {
  const char *name = cs_mark_name(object->mark);
  celspan_object *faded, *named;
  celspan_status status = celspan_object_fade(g->context, *made, object->fade, &faded);
  celspan_object_unref(*made);
  *made = NULL;
  CS_TRY(status);
  *made = faded;
  if (!name || !*name)
    return CELSPAN_OK;
  CS_TRY(celspan_object_named(g->context, faded, name, &named));
  celspan_object_unref(faded);
  *made = named;
  return CELSPAN_OK;
}

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static celspan_status grow(const growing *g, celspan_object *object, const celspan_matrix *around,
                           celspan_object **out) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix matrix = celspan_matrix_then(*object->matrix, *around);
  celspan_object *made = NULL;
  celspan_status status;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    status = grow_primitive(g, data, &matrix, &made);
  else if (data->boolean->op == CELSPAN_OPERATOR_XOR)
    status = grow_xor(g, data->boolean, &matrix, &made);
  else
    status = grow_boolean(g, data->boolean, &matrix, &made);
  if (status == CELSPAN_OK)
    status = finish(g, object, &made);
  return CS_GIVE(status, made, celspan_object_unref, out);
}

celspan_status celspan_object_offset(celspan_context *context, celspan_object *object,
                                     double distance, celspan_stroke_join join, double limit,
                                     celspan_object **out) {
  const celspan_matrix identity = celspan_matrix_identity();
  CS_TRY(cs_check_given(context, "offset", "the object", object));
  CS_TRY(cs_check_range(context, "offset", "the distance", distance, -CS_NUMBER_LIMIT,
                        CS_NUMBER_LIMIT));
  CS_TRY(cs_check_choice(context, "offset", "join", (unsigned)join, CELSPAN_STROKE_JOIN_BEVEL + 1));
  CS_TRY(cs_check_range(context, "offset", "limit", limit, 1, LIMIT_MOST));
  const growing g = {context, distance, join, limit};
  if (distance != 0)
    return grow(&g, object, &identity, out);
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}
