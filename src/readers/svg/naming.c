#include "readers/svg/naming.h"

celspan_status cs_svg_item_name(cs_svg_reading *reading, celspan_svg *art, const cs_svg_node *node,
                                const cs_svg_place *place, cs_svg_item *item) {
  celspan_context *context = reading->context;
  const char *id = cs_svg_node_value(node, CS_SVG_ID);
  const char *label = cs_svg_node_value(node, CS_SVG_LABEL);
  if (id && *id)
    CS_TRY(cs_svg_text_copy(context, art, id, &item->id));
  if (label && *label)
    CS_TRY(cs_svg_text_copy(context, art, label, &item->label));
  item->is_moved = place->is_moved;
  if (item->is_moved) {
    item->moved = place->moved;
    item->is_moved = celspan_matrix_inverse(item->moved, &item->back);
  }
  return CELSPAN_OK;
}
