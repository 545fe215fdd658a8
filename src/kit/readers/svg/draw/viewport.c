#include "readers/svg/draw/viewport.h"

#include "readers/svg/document/shapes.h"

celspan_box cs_svg_viewport_fit(const char *view_box, const char *aspect, double width,
                                double height, cs_svg_place *place) {
  cs_svg_view_box box = {.is_given = false};
  if (view_box && cs_svg_parse_view_box(view_box, &box))
    place->matrix = celspan_matrix_then(cs_svg_fit(&box, width, height, aspect), place->matrix);
  place->measure.width = box.is_given ? box.width : width;
  place->measure.height = box.is_given ? box.height : height;
  return (celspan_box){box.x, box.y, place->measure.width, place->measure.height};
}

static celspan_box fit(const cs_svg_node *node, double width, double height, cs_svg_place *place) {
  return cs_svg_viewport_fit(cs_svg_node_value(node, CS_SVG_VIEW_BOX),
                             cs_svg_node_value(node, CS_SVG_PRESERVE_ASPECT_RATIO), width, height,
                             place);
}

static celspan_status read_viewport(celspan_context *context, const cs_svg_node *node,
                                    const cs_svg_node *sizes, const cs_svg_measure *measure,
                                    celspan_box *out) {
  const cs_svg_length whole = {100, CS_SVG_UNIT_PERCENT};
  const cs_svg_node *wide = sizes && cs_svg_node_value(sizes, CS_SVG_WIDTH) ? sizes : node;
  const cs_svg_node *high = sizes && cs_svg_node_value(sizes, CS_SVG_HEIGHT) ? sizes : node;
  bool has_place = node->element == CS_SVG_ELEMENT_SVG;
  *out = (celspan_box){0, 0, 0, 0};
  if (has_place) {
    CS_TRY(cs_svg_number_of(context, node, CS_SVG_X, CS_SVG_AXIS_X, measure, &out->x));
    CS_TRY(cs_svg_number_of(context, node, CS_SVG_Y, CS_SVG_AXIS_Y, measure, &out->y));
  }
  CS_TRY(cs_svg_length_of(context, wide, CS_SVG_WIDTH, CS_SVG_AXIS_X, measure, whole, &out->width));
  return cs_svg_length_of(context, high, CS_SVG_HEIGHT, CS_SVG_AXIS_Y, measure, whole,
                          &out->height);
}

/* Moves a symbol so that its point (refX, refY) lies where its corner would be. Source: SVG 2,
 * 5.5. */
static celspan_status shift_to_reference(celspan_context *context, const cs_svg_node *node,
                                         const celspan_box *viewport, cs_svg_place *place) {
  const char *x = cs_svg_node_value(node, CS_SVG_REF_X), *y = cs_svg_node_value(node, CS_SVG_REF_Y);
  cs_svg_place inner = *place;
  celspan_point at = {0, 0};
  if (node->element != CS_SVG_ELEMENT_SYMBOL || (!x && !y))
    return CELSPAN_OK;
  inner.matrix = celspan_matrix_identity();
  celspan_box box = fit(node, viewport->width, viewport->height, &inner);
  CS_TRY(cs_svg_reference_of(context, node, CS_SVG_AXIS_X, &inner.measure, box.x, &at.x));
  CS_TRY(cs_svg_reference_of(context, node, CS_SVG_AXIS_Y, &inner.measure, box.y, &at.y));
  const double *m = inner.matrix.m;
  place->matrix = celspan_matrix_then(
      celspan_matrix_translation(x ? -(m[0] * at.x + m[2]) : 0, y ? -(m[4] * at.y + m[5]) : 0),
      place->matrix);
  return CELSPAN_OK;
}

celspan_status cs_svg_viewport_find(cs_svg_reading *reading, const cs_svg_node *node,
                                    const cs_svg_node *sizes, cs_svg_place *place,
                                    celspan_box *out) {
  CS_TRY(read_viewport(reading->context, node, sizes, &place->measure, out));
  return shift_to_reference(reading->context, node, out, place);
}

void cs_svg_viewport_enter(const cs_svg_node *node, const celspan_box *viewport,
                           cs_svg_place *place) {
  place->matrix =
      celspan_matrix_then(celspan_matrix_translation(viewport->x, viewport->y), place->matrix);
  fit(node, viewport->width, viewport->height, place);
}
