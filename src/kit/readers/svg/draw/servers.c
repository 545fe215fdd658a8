#include "readers/svg/draw/servers.h"

#include "readers/svg/document/shapes.h"

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

/* Finds the paint of the element from which it was inherited, and converts it to the shape's
 * units. */
static celspan_status find_in_context(cs_svg_reading *reading, const cs_svg_paint *paint,
                                      const cs_svg_style *style, const cs_svg_painted *shape,
                                      cs_svg_server *out) {
  const cs_svg_context_box *context = paint->context;
  cs_svg_paint own = *paint;
  cs_svg_painted other = *shape;
  celspan_matrix from, to;
  if (!celspan_matrix_inverse(context->matrix, &from) ||
      !celspan_matrix_inverse(*shape->matrix, &to))
    return CELSPAN_OK;
  const celspan_matrix there = celspan_matrix_then(*shape->matrix, from);
  own.context = NULL;
  other.measure = &context->measure;
  other.box = context->box;
  other.painted = cs_svg_box_mapped(&shape->painted, &there);
  other.matrix = &context->matrix;
  CS_TRY(cs_svg_server_find(reading, &own, style, &other, out));
  if (out->kind == CS_SVG_SERVER_TEXTURE)
    out->matrix = celspan_matrix_then(celspan_matrix_then(out->matrix, context->matrix), to);
  return CELSPAN_OK;
}

celspan_status cs_svg_server_find(cs_svg_reading *reading, const cs_svg_paint *paint,
                                  const cs_svg_style *style, const cs_svg_painted *shape,
                                  cs_svg_server *out) {
  *out = (cs_svg_server){.matrix = celspan_matrix_identity()};
  const cs_svg_node *node = paint->has_server ? cs_svg_referred(reading, paint->server) : NULL;
  bool is_pattern = node && node->element == CS_SVG_ELEMENT_PATTERN;
  if (node && (cs_svg_is_gradient(node) || is_pattern) && paint->context)
    return find_in_context(reading, paint, style, shape, out);
  if (node && (cs_svg_is_gradient(node) || is_pattern)) {
    bool is_missing;
    CS_TRY(is_pattern ? cs_svg_pattern_make(reading, node, shape, &is_missing, out)
                      : cs_svg_gradient_make(reading, node, shape, &is_missing, out));
    return is_missing && paint->has_fallback
               ? plain_paint(reading, paint, style, shape->opacity, out)
               : CELSPAN_OK;
  }
  return plain_paint(reading, paint, style, shape->opacity, out);
}
