#include "readers/svg/draw/regions.h"

#include "readers/svg/document/shapes.h"
#include "readers/svg/draw/boxes.h"

static celspan_status read_box(celspan_context *context, const cs_svg_node *node,
                               const cs_svg_measure *measure, celspan_box *out) {
  const cs_svg_length least = {-10, CS_SVG_UNIT_PERCENT}, whole = {120, CS_SVG_UNIT_PERCENT};
  CS_TRY(cs_svg_length_of(context, node, CS_SVG_X, CS_SVG_AXIS_X, measure, least, &out->x));
  CS_TRY(cs_svg_length_of(context, node, CS_SVG_Y, CS_SVG_AXIS_Y, measure, least, &out->y));
  CS_TRY(cs_svg_length_of(context, node, CS_SVG_WIDTH, CS_SVG_AXIS_X, measure, whole, &out->width));
  return cs_svg_length_of(context, node, CS_SVG_HEIGHT, CS_SVG_AXIS_Y, measure, whole,
                          &out->height);
}

celspan_status cs_svg_region_find(cs_svg_reading *reading, const cs_svg_node *node,
                                  cs_svg_name units, const cs_svg_node *element,
                                  const cs_svg_place *place, cs_svg_region *out) {
  bool is_in_user_space = cs_svg_node_says(node, units, "userSpaceOnUse"), is_there = false;
  cs_svg_measure measure = place->measure;
  cs_svg_place own = *place;
  *out = (cs_svg_region){.own = place->matrix};
  own.matrix = celspan_matrix_identity();
  CS_TRY(cs_svg_box_of(reading, element, &own, &out->element, &is_there));
  out->has_box = is_there && out->element.width > 0 && out->element.height > 0;
  out->shares = celspan_matrix_then(cs_svg_box_matrix(&out->element), place->matrix);
  if (!is_in_user_space) {
    measure.width = measure.height = 1;
    out->own = out->shares;
  }
  CS_TRY(read_box(reading->context, node, &measure, &out->box));
  out->is_sized = (is_in_user_space || out->has_box) && out->box.width > 0 && out->box.height > 0;
  return CELSPAN_OK;
}
