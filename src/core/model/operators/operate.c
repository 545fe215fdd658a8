#include "model/operators/operate.h"

#include <math.h>

#include "base/number.h"
#include "model/scene/pattern.h"
#include "model/scene/primitive_data.h"
#include "model/scene/texture.h"

/* ---------------------------------------------------------------- primitives */

/* The texture that was given, not the unrolled one; a picture keeps its box. */
static celspan_status keep_texture(celspan_context *context, const cs_primitive_data *data,
                                   celspan_texture **out) {
  celspan_texture *given = data->texture->variation->origin;
  return cs_texture_boxed(context, given ? given : data->texture, &data->bounds, out);
}

static celspan_status check_numbers(const cs_operation *operation, const cs_outline *outline) {
  for (size_t i = 0; i < outline->point_count; i++) {
    celspan_point p = cs_hpoint_place(outline->points[i]);
    if (!cs_number_is_sane(p.x) || !cs_number_is_sane(p.y))
      return cs_fail(operation->context, CELSPAN_BAD_ARGUMENT,
                     "%s: it would move a point beyond 1e12 units", operation->noun);
  }
  return CELSPAN_OK;
}

static celspan_status make_shape(const cs_operation *operation, const cs_primitive_data *data,
                                 cs_lines *lines, celspan_texture *texture, celspan_object **out) {
  cs_outline taken = lines->outline;
  cs_outline_init(&lines->outline);
  return cs_primitive_data_of_outline(operation->context, &taken, data->rule, texture, out);
}

static celspan_status make_stroke(const cs_operation *operation, const cs_primitive_data *data,
                                  const cs_lines *lines, celspan_texture *texture,
                                  celspan_object **out) {
  celspan_context *context = operation->context;
  const cs_stroke *stroke = data->stroke;
  const cs_dashes *dashes = &stroke->dashes;
  size_t count = dashes->place_count;
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  desc.width = 2 * stroke->largest;
  desc.cap = stroke->cap;
  desc.join = stroke->join;
  desc.miter = stroke->miter;
  desc.texture = texture;
  double *lengths = NULL;
  if (count > 0)
    CS_TRY(CS_MAKE(context, lengths, count));
  for (size_t i = 0; i < count; i++)
    lengths[i] = (i + 1 < count ? dashes->places[i + 1] : dashes->pattern) - dashes->places[i];
  desc.dashes = lengths;
  desc.dash_count = count;
  desc.dash_offset = dashes->offset;
  celspan_status status =
      cs_primitive_data_of_line(context, &lines->outline, &lines->closed, &desc, out);
  cs_mem_free(context->memory, lengths, count * sizeof *lengths);
  return status;
}

static celspan_status make(const cs_operation *operation, const cs_primitive_data *data,
                           cs_lines *lines, celspan_object **out) {
  celspan_texture *texture;
  CS_TRY(check_numbers(operation, &lines->outline));
  CS_TRY(keep_texture(operation->context, data, &texture));
  celspan_status status = data->stroke ? make_stroke(operation, data, lines, texture, out)
                                       : make_shape(operation, data, lines, texture, out);
  celspan_texture_unref(texture);
  return status;
}

static bool is_even(const cs_stroke *stroke) {
  for (size_t i = 0; i < stroke->radius_count; i++)
    if (stroke->radii[i] != stroke->largest)
      return false;
  return true;
}

/* 0 where a primitive has no area, or lies in perspective with its horizon at the origin. */
static double scale_of(const celspan_matrix *place) {
  const double *m = place->m;
  double scale = sqrt(fabs(m[0] * m[4] - m[1] * m[3])) / fabs(m[8]);
  return scale <= CS_NUMBER_LIMIT ? scale : 0;
}

static celspan_status change_lines(cs_operation *operation, const cs_primitive_data *data,
                                   const cs_lines *from, const celspan_matrix *place,
                                   celspan_object **out) {
  cs_lines to;
  cs_lines_init(&to, from->is_filled);
  celspan_status status = operation->change(operation, from, place, scale_of(place), &to);
  if (status == CELSPAN_OK)
    status = make(operation, data, &to, out);
  cs_lines_finish(&to, operation->context->memory);
  return status;
}

static celspan_status change_stroke(cs_operation *operation, const cs_primitive_data *data,
                                    const celspan_matrix *place, celspan_object **out) {
  cs_lines lines;
  if (!is_even(data->stroke))
    return cs_fail(operation->context, CELSPAN_BAD_ARGUMENT,
                   "%s: a stroke whose width varies has no single line; change the line first, and "
                   "then give it a width",
                   operation->noun);
  cs_lines_init(&lines, false);
  celspan_status status = cs_lines_of_stroke(operation->context, data->stroke, &lines);
  if (status == CELSPAN_OK)
    status = change_lines(operation, data, &lines, place, out);
  cs_lines_finish(&lines, operation->context->memory);
  return status;
}

static celspan_status change_primitive(cs_operation *operation, const cs_primitive_data *data,
                                       const celspan_matrix *place, celspan_object **out) {
  cs_outline_box room;
  if (data->kind != CS_PRIMITIVE_DATA_OUTLINE)
    return cs_fail(operation->context, CELSPAN_BAD_ARGUMENT,
                   "%s: %s has no lines; change the objects that it is made of", operation->noun,
                   data->kind == CS_PRIMITIVE_DATA_SCANLINE
                       ? "a scan-line procedure"
                       : "a rostrum, or what is blurred, has a soft shadow or a glow,");
  if (data->stroke)
    return change_stroke(operation, data, place, out);
  const cs_lines lines = {.outline = *cs_primitive_data_outline(data, &room), .is_filled = true};
  return change_lines(operation, data, &lines, place, out);
}

/* ---------------------------------------------------------------- objects */

static celspan_status operate(cs_operation *operation, const celspan_object *object,
                              const celspan_matrix *around, celspan_object **out);

/* A primitive that a pattern fills is a clip, whose first operand is the plane of the pattern. */
static celspan_status change_boolean(cs_operation *operation, const cs_boolean *boolean,
                                     const celspan_matrix *place, celspan_object **out) {
  celspan_context *context = operation->context;
  size_t count = boolean->operand_count, made = 0;
  celspan_object **operands = cs_mem_array(context->memory, count, sizeof *operands);
  if (!operands && count > 0)
    return cs_fail_memory(context);
  celspan_status status = CELSPAN_OK;
  for (; status == CELSPAN_OK && made < count; made++) {
    if (boolean->is_filled && made == 0)
      operands[made] = celspan_object_ref(boolean->operands[made]);
    else
      status = operate(operation, boolean->operands[made], place, &operands[made]);
  }
  if (status == CELSPAN_OK && boolean->is_filled)
    status = cs_pattern_refill(context, operands[1], &operands[0]);
  if (status == CELSPAN_OK)
    status = cs_boolean_like(context, boolean, operands, count, out);
  cs_primitive_data_list_free(context->memory, operands, count);
  return status;
}

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. What has no size is left as it is. */
static celspan_status operate(cs_operation *operation, const celspan_object *object,
                              const celspan_matrix *around, celspan_object **out) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix place = celspan_matrix_then(*object->matrix, *around);
  celspan_object *made = NULL;
  bool is_boolean = data->kind == CS_PRIMITIVE_DATA_BOOLEAN;
  if (!is_boolean && (data->is_empty || !(scale_of(&place) > 0))) {
    *out = celspan_object_ref((celspan_object *)object);
    return CELSPAN_OK;
  }
  if (is_boolean)
    CS_TRY(change_boolean(operation, data->boolean, &place, &made));
  else
    CS_TRY(change_primitive(operation, data, &place, &made));
  celspan_status status = cs_primitive_data_replace(operation->context, object, made->data, out);
  celspan_object_unref(made);
  return status;
}

celspan_status cs_operate(cs_operation *operation, const celspan_object *object,
                          celspan_object **out) {
  const celspan_matrix identity = celspan_matrix_identity();
  return operate(operation, object, &identity, out);
}
