/* The public constructors of primitives: they check the description and make the primitive data,
 * that is outline, bounds and texture. */
#include "base/description.h"
#include "base/number.h"
#include "model/scene/check.h"
#include "model/scene/pattern.h"
#include "model/scene/primitive_data.h"

/* ---------------------------------------------------------------- data with an outline */

/* Finds the bounds of data that have an outline. */
static void measure_outline(cs_primitive_data *data) {
  const celspan_matrix identity = celspan_matrix_identity();
  cs_outline_box room;
  const cs_outline *outline = cs_primitive_data_outline(data, &room);
  const size_t pieces = outline->piece_count < UINT32_MAX ? outline->piece_count : UINT32_MAX;
  if (!cs_outline_bounds(outline, &identity, &data->bounds))
    data->bounds = (celspan_box){0, 0, 0, 0};
  data->is_empty = !(data->bounds.width > 0 && data->bounds.height > 0);
  data->primitive_count = 1;
  data->piece_count = pieces > CS_SHAPE_PIECES ? (uint32_t)pieces : CS_SHAPE_PIECES;
}

celspan_status cs_primitive_data_complete(celspan_context *context, cs_primitive_data *data,
                                          cs_outline *outline, celspan_status status,
                                          celspan_object **out) {
  if (status == CELSPAN_OK)
    status = cs_outline_pack(context, outline, &data->outline);
  cs_outline_finish(outline, context->memory);
  if (status == CELSPAN_OK)
    measure_outline(data);
  return cs_pattern_wrap(context, data, status, out);
}

celspan_status cs_primitive_data_complete_box(celspan_context *context, cs_primitive_data *data,
                                              const celspan_box *box, celspan_object **out) {
  celspan_status status = cs_primitive_data_set_box(context, data, box);
  if (status == CELSPAN_OK)
    measure_outline(data);
  return cs_pattern_wrap(context, data, status, out);
}

/* ---------------------------------------------------------------- constructors */

static celspan_status begin(celspan_context *context, const char *noun, celspan_rule rule,
                            celspan_texture *texture, cs_primitive_data **out) {
  CS_TRY(cs_check_choice(context, noun, "rule", (unsigned)rule, CELSPAN_RULE_EVENODD + 1));
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_OUTLINE, texture, out));
  (*out)->rule = rule;
  return CELSPAN_OK;
}

static celspan_status create_rounded(celspan_context *context, cs_primitive_data *data,
                                     const celspan_rect_desc *desc, celspan_object **out) {
  cs_outline outline;
  cs_outline_init(&outline);
  celspan_status status =
      cs_outline_rect(context, &outline, desc->x, desc->y, desc->width, desc->height, desc->radius);
  return cs_primitive_data_complete(context, data, &outline, status, out);
}

static celspan_status check_rect(celspan_context *context, const celspan_rect_desc *desc) {
  CS_TRY(cs_check_number(context, "rect", "x", desc->x));
  CS_TRY(cs_check_number(context, "rect", "y", desc->y));
  CS_TRY(cs_check_size(context, "rect", "w", desc->width));
  return cs_check_size(context, "rect", "h", desc->height);
}

celspan_status celspan_object_create_rect(celspan_context *context, const celspan_rect_desc *desc,
                                          celspan_object **out) {
  CS_READ(context, "rect", celspan_rect_desc, desc);
  CS_TRY(check_rect(context, desc));
  CS_TRY(cs_check_size(context, "rect", "radius", desc->radius));
  cs_primitive_data *data;
  CS_TRY(begin(context, "rect", CELSPAN_RULE_NONZERO, desc->texture, &data));
  if (desc->radius > 0)
    return create_rounded(context, data, desc, out);
  const celspan_box box = {desc->x, desc->y, desc->width, desc->height};
  return cs_primitive_data_complete_box(context, data, &box, out);
}

/* The factor by which four radii become so small that they fit. */
static double fitting(const celspan_rect_desc *desc, const double radii[4]) {
  double factor = 1;
  for (int i = 0; i < 4; i++) {
    double side = i % 2 == 0 ? desc->width : desc->height, sum = radii[i] + radii[(i + 1) % 4];
    if (sum * factor > side)
      factor = side / sum;
  }
  return factor;
}

celspan_status celspan_object_create_rounded(celspan_context *context,
                                             const celspan_rect_desc *desc, const double radii[4],
                                             celspan_object **out) {
  CS_READ(context, "rect", celspan_rect_desc, desc);
  CS_TRY(check_rect(context, desc));
  CS_TRY(cs_check_given(context, "rect", "radii", radii));
  for (size_t i = 0; i < 4; i++)
    CS_TRY(cs_check_item(context, (cs_check_field){"rect", "radius", i + 1, ""}, radii[i], 0,
                         CS_NUMBER_LIMIT));
  double factor = fitting(desc, radii), fitted[4];
  for (int i = 0; i < 4; i++)
    fitted[i] = factor * radii[i];
  cs_primitive_data *data;
  CS_TRY(begin(context, "rect", CELSPAN_RULE_NONZERO, desc->texture, &data));
  const celspan_box box = {desc->x, desc->y, desc->width, desc->height};
  cs_outline outline;
  cs_outline_init(&outline);
  celspan_status status = cs_outline_cornered(context, &outline, &box, fitted);
  return cs_primitive_data_complete(context, data, &outline, status, out);
}

static celspan_status check_points(celspan_context *context, const char *noun,
                                   const celspan_point *points, size_t count) {
  CS_TRY(cs_check_list(context, noun, "points", points, count, CS_CHECK_ITEMS));
  for (size_t i = 0; i < count; i++)
    CS_TRY(cs_check_point(context, noun, "points", i + 1, points[i]));
  return CELSPAN_OK;
}

static celspan_status create_polygon(celspan_context *context, const char *noun,
                                     const celspan_polygon_desc *desc, celspan_object **out) {
  CS_TRY(check_points(context, noun, desc->points, desc->point_count));
  cs_primitive_data *data;
  CS_TRY(begin(context, noun, desc->rule, desc->texture, &data));
  cs_outline outline;
  cs_outline_init(&outline);
  celspan_status status = cs_outline_polygon(context, &outline, desc->points, desc->point_count);
  return cs_primitive_data_complete(context, data, &outline, status, out);
}

celspan_status celspan_object_create_polygon(celspan_context *context,
                                             const celspan_polygon_desc *desc,
                                             celspan_object **out) {
  CS_READ(context, "polygon", celspan_polygon_desc, desc);
  return create_polygon(context, "polygon", desc, out);
}

celspan_status celspan_object_create_triangle(celspan_context *context,
                                              const celspan_triangle_desc *desc,
                                              celspan_object **out) {
  CS_READ(context, "triangle", celspan_triangle_desc, desc);
  celspan_polygon_desc polygon = {sizeof polygon, desc->points, 3, CELSPAN_RULE_NONZERO,
                                  desc->texture};
  return create_polygon(context, "triangle", &polygon, out);
}

celspan_status celspan_object_create_ellipse(celspan_context *context,
                                             const celspan_ellipse_desc *desc,
                                             celspan_object **out) {
  CS_READ(context, "ellipse", celspan_ellipse_desc, desc);
  CS_TRY(cs_check_point(context, "ellipse", "centre", 0, desc->centre));
  CS_TRY(cs_check_size(context, "ellipse", "radii[1]", desc->radius_x));
  CS_TRY(cs_check_size(context, "ellipse", "radii[2]", desc->radius_y));
  cs_primitive_data *data;
  CS_TRY(begin(context, "ellipse", CELSPAN_RULE_NONZERO, desc->texture, &data));
  cs_outline outline;
  cs_outline_init(&outline);
  celspan_status status =
      cs_outline_ellipse(context, &outline, desc->centre, desc->radius_x, desc->radius_y);
  return cs_primitive_data_complete(context, data, &outline, status, out);
}

celspan_status celspan_object_create_nurbs(celspan_context *context, const celspan_nurbs_desc *desc,
                                           celspan_object **out) {
  CS_READ(context, "nurbs", celspan_nurbs_desc, desc);
  CS_TRY(check_points(context, "nurbs", desc->points, desc->point_count));
  CS_TRY(cs_check_choice(context, "nurbs", "closed", (unsigned)desc->closure,
                         CELSPAN_NURBS_CLAMPED + 1));
  cs_primitive_data *data;
  CS_TRY(begin(context, "nurbs", desc->rule, desc->texture, &data));
  cs_outline outline;
  cs_outline_init(&outline);
  celspan_status status = cs_outline_nurbs(context, &outline, desc);
  return cs_primitive_data_complete(context, data, &outline, status, out);
}

celspan_status celspan_object_create_path(celspan_context *context, const celspan_path_desc *desc,
                                          celspan_object **out) {
  CS_READ(context, "path", celspan_path_desc, desc);
  CS_TRY(cs_check_one(context, "path", "d and contours",
                      (desc->data != NULL) + (desc->contours != NULL)));
  if (desc->contours)
    CS_TRY(cs_check_contours(context, "path", desc->contours, desc->contour_count));
  cs_primitive_data *data;
  CS_TRY(begin(context, "path", desc->rule, desc->texture, &data));
  cs_outline outline;
  cs_outline_init(&outline);
  celspan_status status = desc->data ? cs_outline_path(context, &outline, desc->data)
                                     : cs_outline_contours(context, &outline, NULL, desc->contours,
                                                           desc->contour_count);
  return cs_primitive_data_complete(context, data, &outline, status, out);
}

celspan_status cs_primitive_data_of_outline(celspan_context *context, cs_outline *outline,
                                            celspan_rule rule, celspan_texture *texture,
                                            celspan_object **out) {
  cs_primitive_data *data;
  celspan_status status = begin(context, "outline", rule, texture, &data);
  if (status != CELSPAN_OK) {
    cs_outline_finish(outline, context->memory);
    return status;
  }
  return cs_primitive_data_complete(context, data, outline, CELSPAN_OK, out);
}

celspan_status celspan_object_create_scanline(celspan_context *context,
                                              const celspan_scanline_desc *desc,
                                              celspan_object **out) {
  CS_READ(context, "scanline", celspan_scanline_desc, desc);
  CS_TRY(cs_check_box(context, "scanline", "bounds", &desc->bounds));
  if (!desc->spans)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "scanline: spans is missing");
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_SCANLINE, NULL, &data));
  celspan_object *object;
  CS_TRY(cs_primitive_data_complete_box(context, data, &desc->bounds, &object));
  /* Not earlier: if no object is made, the caller must release `user`. */
  *data->scanline = *desc;
  *out = object;
  return CELSPAN_OK;
}
