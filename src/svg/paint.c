#include "svg/paint.h"

#include "base/number.h"
#include "scene/primitive_data.h"
#include "svg/servers.h"
#include "svg/shapes.h"

static celspan_status flat(cs_svg_reading *reading, const cs_svg_colour *colour, double opacity,
                           cs_svg_server *out) {
  const celspan_paint paint = cs_svg_paint_of(reading, colour, opacity);
  CS_TRY(celspan_texture_create_paint(reading->context, &paint, &out->texture));
  out->kind = CS_SVG_SERVER_FLAT;
  return CELSPAN_OK;
}

static celspan_status plain_paint(cs_svg_reading *reading, const cs_svg_paint *paint,
                                  const cs_svg_style *style, double opacity, cs_svg_server *out) {
  if (paint->kind == CS_SVG_PAINT_NONE || !(opacity > 0))
    return CELSPAN_OK;
  return flat(reading, paint->kind == CS_SVG_PAINT_CURRENT ? &style->colour : &paint->colour,
              opacity, out);
}

/* What a shape is painted with. */
static celspan_status find_paint(cs_svg_reading *reading, const cs_svg_paint *paint,
                                 const cs_svg_style *style, const cs_svg_painted *shape,
                                 cs_svg_server *out) {
  *out = (cs_svg_server){.matrix = celspan_matrix_identity()};
  const cs_svg_node *node = paint->has_server ? cs_svg_referred(reading, paint->server) : NULL;
  if (node && cs_svg_is_gradient(node))
    return cs_svg_server_make(reading, node, shape, out);
  if (node && node->element == CS_SVG_ELEMENT_PATTERN)
    CS_TRY(cs_svg_skip(reading, shape->node, "pattern of %s", shape->node->tag));
  return plain_paint(reading, paint, style, shape->opacity, out);
}

/* Brings an outline into other units; false when it does not fit into them. */
static bool map_outline(cs_outline *outline, const celspan_matrix *matrix) {
  const double *m = matrix->m;
  for (size_t i = 0; i < outline->point_count; i++) {
    const cs_hpoint p = outline->points[i];
    cs_hpoint *to = &outline->points[i];
    to->x = m[0] * p.x + m[1] * p.y + m[2] * p.w;
    to->y = m[3] * p.x + m[4] * p.y + m[5] * p.w;
    if (!cs_number_is_sane(to->x) || !cs_number_is_sane(to->y))
      return false;
  }
  return true;
}

static bool is_identity(const celspan_matrix *matrix) {
  const celspan_matrix identity = celspan_matrix_identity();
  for (int i = 0; i < 9; i++)
    if (matrix->m[i] != identity.m[i])
      return false;
  return true;
}

/* An object of the outline, which is taken over, in the paint's units, brought to the drawing's. */
static celspan_status place_outline(cs_svg_reading *reading, cs_outline *outline,
                                    const cs_svg_place *place, const cs_svg_server *server,
                                    celspan_object **out) {
  celspan_matrix matrix = place->matrix, inverse;
  if (server->kind == CS_SVG_SERVER_GRADIENT) {
    matrix = celspan_matrix_then(server->matrix, place->matrix);
    if (!celspan_matrix_inverse(server->matrix, &inverse) || !map_outline(outline, &inverse))
      return CELSPAN_OK;
  }
  celspan_object *object;
  CS_TRY(cs_primitive_data_of_outline(reading->context, outline, place->style.fill_rule,
                                      server->texture, &object));
  if (is_identity(&matrix)) {
    *out = object;
    return CELSPAN_OK;
  }
  celspan_status status = celspan_object_transform(reading->context, object, &matrix, out);
  celspan_object_unref(object);
  return status;
}

static celspan_status fill(cs_svg_reading *reading, const cs_svg_node *node,
                           const cs_svg_place *place, cs_outline *outline, celspan_object **out) {
  const celspan_matrix identity = celspan_matrix_identity();
  cs_svg_painted shape = {node, &place->measure, {0, 0, 0, 0}, place->style.fill_opacity};
  cs_svg_server server;
  if (outline->piece_count == 0 ||
      (place->style.fill.has_server && !cs_outline_bounds(outline, &identity, &shape.box)))
    return CELSPAN_OK;
  CS_TRY(find_paint(reading, &place->style.fill, &place->style, &shape, &server));
  if (server.kind == CS_SVG_SERVER_NOTHING)
    return CELSPAN_OK;
  celspan_status status = place_outline(reading, outline, place, &server, out);
  celspan_texture_unref(server.texture);
  return status;
}

static celspan_status note_lines(cs_svg_reading *reading, const cs_svg_node *node,
                                 const cs_svg_style *style) {
  if (style->stroke.kind != CS_SVG_PAINT_NONE || style->stroke.has_server)
    CS_TRY(cs_svg_skip(reading, node, "stroke of %s", node->tag));
  for (int i = 0; i < 3; i++)
    if (style->markers[i].size > 0)
      return cs_svg_skip(reading, node, "markers of %s", node->tag);
  return CELSPAN_OK;
}

celspan_status cs_svg_paint_shape(cs_svg_reading *reading, const cs_svg_node *node,
                                  const cs_svg_place *place, celspan_object **out) {
  cs_outline outline;
  bool is_broken;
  *out = NULL;
  cs_outline_init(&outline);
  celspan_status status =
      cs_svg_shape_outline(reading->context, node, &place->measure, &outline, &is_broken);
  if (status == CELSPAN_OK && is_broken)
    status = cs_svg_skip(reading, node, "%s from a fault in its data on", node->tag);
  if (status == CELSPAN_OK)
    status = fill(reading, node, place, &outline, out);
  cs_outline_finish(&outline, reading->context->memory);
  if (status == CELSPAN_OK)
    status = note_lines(reading, node, &place->style);
  return status;
}
