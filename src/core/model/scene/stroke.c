/* Strokes: the constructors, which check the description. */
#include "base/description.h"
#include "model/scene/check.h"
#include "model/scene/pattern.h"
#include "model/scene/primitive_data.h"
#include "model/scene/texture_fit.h"
#include "model/stroke/outliner.h"

#define NOUN "stroke"

/* ---------------------------------------------------------------- checks */

static celspan_status check_points(celspan_context *context, const celspan_stroke_desc *desc) {
  CS_TRY(cs_check_list(context, NOUN, "points", desc->points, desc->point_count, CS_CHECK_ITEMS));
  for (size_t i = 0; i < desc->point_count; i++) {
    CS_TRY(cs_check_point(context, NOUN, "points", i + 1, desc->points[i]));
    if (desc->widths)
      CS_TRY(cs_check_item(context, (cs_check_field){NOUN, "points", i + 1, "width"},
                           desc->widths[i], 0, 1e12));
  }
  if (desc->degree < 1 || desc->degree > 15)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "stroke: degree is %d; it must be from 1 to 15",
                   desc->degree);
  return CELSPAN_OK;
}

static celspan_status check_dashes(celspan_context *context, const celspan_stroke_desc *desc) {
  double sum = 0;
  CS_TRY(cs_check_list(context, NOUN, "dash", desc->dashes, desc->dash_count, CS_CHECK_ITEMS));
  if (!desc->dashes)
    return CELSPAN_OK;
  if (desc->dash_count == 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "stroke: dash is empty; leave it out for a line without dashes");
  for (size_t i = 0; i < desc->dash_count; i++) {
    CS_TRY(cs_check_item(context, (cs_check_field){NOUN, "dash", i + 1, ""}, desc->dashes[i], 0,
                         1e12));
    sum += desc->dashes[i];
  }
  if (!(sum > 0))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "stroke: the lengths of dash are all 0; their sum must be above 0");
  return CELSPAN_OK;
}

static celspan_status check_numbers(celspan_context *context, const celspan_stroke_desc *desc) {
  CS_TRY(cs_check_size(context, NOUN, "width", desc->width));
  CS_TRY(cs_check_choice(context, NOUN, "cap", (unsigned)desc->cap, CELSPAN_STROKE_CAP_SQUARE + 1));
  CS_TRY(
      cs_check_choice(context, NOUN, "join", (unsigned)desc->join, CELSPAN_STROKE_JOIN_BEVEL + 1));
  CS_TRY(cs_check_range(context, NOUN, "miter", desc->miter, 1, 1e6));
  CS_TRY(cs_check_number(context, NOUN, "dash_offset", desc->dash_offset));
  CS_TRY(cs_check_size(context, NOUN, "taper[1]", desc->taper[0]));
  CS_TRY(cs_check_size(context, NOUN, "taper[2]", desc->taper[1]));
  CS_TRY(cs_check_choice(context, NOUN, "profile", (unsigned)desc->profile,
                         CELSPAN_STROKE_PROFILE_ROUND + 1));
  CS_TRY(cs_check_number(context, NOUN, "from", desc->from));
  CS_TRY(cs_check_number(context, NOUN, "to", desc->to));
  return check_dashes(context, desc);
}

static celspan_status check_outline(celspan_context *context, const celspan_object *object) {
  const cs_primitive_data *data = cs_pattern_shape(object->data);
  if (data->kind == CS_PRIMITIVE_DATA_OUTLINE && !data->stroke)
    return CELSPAN_OK;
  const char *what = data->kind == CS_PRIMITIVE_DATA_OUTLINE    ? "a stroke"
                     : data->kind == CS_PRIMITIVE_DATA_SCANLINE ? "a scan-line procedure"
                     : data->kind == CS_PRIMITIVE_DATA_ROSTRUM  ? "a rostrum"
                                                                : "a boolean object";
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "stroke: the outline must be that of a primitive; %s has none, but the effect "
                 "'outline' goes around any object",
                 what);
}

/* ---------------------------------------------------------------- construction */

/* A picture without a box lies on the tight bounds; for everything else the bounds of the line,
 * enlarged by its largest reach, are good enough. */
static celspan_status find_bounds(celspan_context *context, cs_primitive_data *data) {
  const cs_stroke *stroke = data->stroke;
  data->is_empty = !(stroke->around.width > 0 && stroke->around.height > 0);
  data->bounds = stroke->around;
  if (data->is_empty || data->texture->kind != CS_TEXTURE_PICTURE ||
      data->texture->variation->has_box)
    return CELSPAN_OK;
  const celspan_matrix identity = celspan_matrix_identity();
  bool is_seen;
  CS_TRY(cs_stroke_bounds(context, stroke, &identity, &data->bounds, &is_seen));
  data->is_empty = !is_seen;
  return CELSPAN_OK;
}

/* Fits a gradient without points to the whole line, without dashes, tapers and parts. */
static celspan_status fit_texture(celspan_context *context, cs_primitive_data *data,
                                  const celspan_stroke_desc *desc, const cs_outline *outline,
                                  const cs_outline_closed *closed) {
  const celspan_matrix identity = celspan_matrix_identity();
  celspan_stroke_desc whole = *desc;
  cs_stroke stroke;
  celspan_box box = {0, 0, 0, 0};
  bool is_seen;
  if (data->texture->variation->fit == CS_TEXTURE_FIT_NONE)
    return CELSPAN_OK;
  whole.dashes = NULL;
  whole.dash_count = 0;
  whole.taper[0] = whole.taper[1] = whole.from = 0;
  whole.to = 1;
  celspan_status status = cs_stroke_init(context, &stroke, &whole, outline, closed);
  if (status == CELSPAN_OK)
    status = cs_stroke_bounds(context, &stroke, &identity, &box, &is_seen);
  cs_stroke_finish(&stroke, context->memory);
  return status == CELSPAN_OK ? cs_texture_fit(context, &data->texture, &box) : status;
}

static celspan_status fill(celspan_context *context, cs_primitive_data *data,
                           const celspan_stroke_desc *desc, const cs_outline *outline,
                           const cs_outline_closed *closed) {
  data->primitive_count = 1;
  data->piece_count = CS_SHAPE_PIECES;
  CS_TRY(fit_texture(context, data, desc, outline, closed));
  CS_TRY(CS_MAKE(context, data->stroke, 1));
  cs_outline_init(&data->stroke->line);
  CS_TRY(cs_stroke_init(context, data->stroke, desc, outline, closed));
  return find_bounds(context, data);
}

static celspan_status create(celspan_context *context, const celspan_stroke_desc *desc,
                             const celspan_object *outlined, celspan_object **out) {
  cs_primitive_data *data;
  CS_TRY(check_numbers(context, desc));
  if (outlined)
    CS_TRY(check_outline(context, outlined));
  else if (desc->contours)
    CS_TRY(cs_check_contours(context, NOUN, desc->contours, desc->contour_count));
  else if (!desc->data)
    CS_TRY(check_points(context, desc));
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_OUTLINE, desc->texture, &data));
  cs_outline_box room;
  const cs_outline *outline =
      outlined ? cs_primitive_data_outline(cs_pattern_shape(outlined->data), &room) : NULL;
  celspan_status status = fill(context, data, desc, outline, NULL);
  return cs_pattern_wrap(context, data, status, out);
}

celspan_status cs_primitive_data_of_line(celspan_context *context, const cs_outline *line,
                                         const cs_outline_closed *closed,
                                         const celspan_stroke_desc *desc, celspan_object **out) {
  cs_primitive_data *data;
  CS_TRY(check_numbers(context, desc));
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_OUTLINE, desc->texture, &data));
  celspan_status status = fill(context, data, desc, line, closed);
  return cs_pattern_wrap(context, data, status, out);
}

celspan_status celspan_object_create_stroke(celspan_context *context,
                                            const celspan_stroke_desc *desc, celspan_object **out) {
  CS_READ(context, NOUN, celspan_stroke_desc, desc);
  CS_TRY(cs_check_one(context, NOUN, "points, d, outline and contours",
                      (desc->points != NULL) + (desc->data != NULL) + (desc->outline != NULL) +
                          (desc->contours != NULL)));
  return create(context, desc, desc->outline, out);
}

celspan_status celspan_object_stroke(celspan_context *context, celspan_object *object,
                                     const celspan_stroke_desc *desc, celspan_object **out) {
  CS_READ(context, NOUN, celspan_stroke_desc, desc);
  CS_TRY(cs_check_given(context, NOUN, "the object", object));
  if (desc->points || desc->data || desc->contours)
    return cs_fail(
        context, CELSPAN_BAD_ARGUMENT,
        "stroke: the line is the object's outline; points, d and contours do not go with "
        "it");
  celspan_object *plain, *placed;
  CS_TRY(create(context, desc, object, &plain));
  celspan_status status = celspan_object_transform(context, plain, object->matrix, &placed);
  celspan_object_unref(plain);
  CS_TRY(status);
  status = celspan_object_fade(context, placed, object->fade, out);
  celspan_object_unref(placed);
  return status;
}
