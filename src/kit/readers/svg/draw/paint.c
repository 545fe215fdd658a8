#include "readers/svg/draw/paint.h"

#include "inside/scene.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/draw/servers.h"

static bool is_identity(const celspan_matrix *matrix) {
  const celspan_matrix identity = celspan_matrix_identity();
  for (int i = 0; i < 9; i++)
    if (matrix->m[i] != identity.m[i])
      return false;
  return true;
}

/* An object of the outline, which owns the outline from now on: made in the paint's units, then
 * moved to the drawing's units. */
static celspan_status place_outline(cs_svg_reading *reading, cs_outline *outline,
                                    const cs_svg_place *place, const cs_svg_server *server,
                                    celspan_object **out) {
  celspan_matrix matrix = place->matrix, inverse;
  if (server->kind == CS_SVG_SERVER_TEXTURE) {
    matrix = celspan_matrix_then(server->matrix, place->matrix);
    if (!celspan_matrix_inverse(server->matrix, &inverse) || !cs_svg_outline_map(outline, &inverse))
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
                           const cs_svg_place *place, cs_outline *outline, const celspan_box *box,
                           celspan_object **out) {
  const celspan_matrix identity = celspan_matrix_identity();
  cs_svg_painted shape = {node,       &place->measure,           {.x = 0},
                          {.x = 0},   place->style.fill_opacity, &place->matrix,
                          place->open};
  cs_svg_server server;
  if (outline->piece_count == 0 ||
      (place->style.fill.has_server && !cs_outline_bounds(outline, &identity, &shape.box)))
    return CELSPAN_OK;
  if (box)
    shape.box = *box;
  shape.painted = shape.box;
  CS_TRY(cs_svg_server_find(reading, &place->style.fill, &place->style, &shape, &server));
  if (server.kind == CS_SVG_SERVER_NOTHING)
    return CELSPAN_OK;
  celspan_status status = place_outline(reading, outline, place, &server, out);
  celspan_texture_unref(server.texture);
  return status;
}

celspan_status cs_svg_fill_outline(cs_svg_reading *reading, const cs_svg_node *node,
                                   const cs_svg_place *place, cs_outline *outline,
                                   const celspan_box *box, celspan_object **out) {
  *out = NULL;
  return fill(reading, node, place, outline, box, out);
}

celspan_status cs_svg_fill(cs_svg_reading *reading, const cs_svg_node *node,
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
    status = fill(reading, node, place, &outline, NULL, out);
  cs_outline_finish(&outline, reading->context->memory);
  return status;
}
