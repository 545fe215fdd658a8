#include "readers/svg/document/naming.h"

#include <math.h>
#include <stdio.h>

#include "readers/svg/document/shapes.h"

/* Writes the colour of a fill as "#rrggbb"; "" if it has no colour. */
static void write_fill(const cs_svg_style *style, char out[8]) {
  const cs_svg_paint *fill = &style->fill;
  bool is_current = fill->kind == CS_SVG_PAINT_CURRENT;
  const double *rgb = is_current ? style->colour.rgb : fill->colour.rgb;
  unsigned codes[3];
  out[0] = '\0';
  if (fill->has_server || (!is_current && fill->kind != CS_SVG_PAINT_COLOUR))
    return;
  for (int i = 0; i < 3; i++)
    codes[i] = (unsigned)lround(255 * fmin(fmax(rgb[i], 0), 1)) & 255;
  snprintf(out, 8, "#%02x%02x%02x", codes[0], codes[1], codes[2]);
}

/* From here on the new objects are of this line of the file. */
static celspan_status note_facts(celspan_context *context, celspan_svg *art, const char *name,
                                 const cs_svg_node *node, const cs_svg_style *style,
                                 cs_svg_item *item) {
  const char *classes = cs_svg_node_value(node, CS_SVG_CLASS);
  cs_svg_facts *facts = cs_arena_take(context, &art->arena, sizeof *facts);
  if (!facts)
    return CELSPAN_NO_MEMORY;
  celspan_context_set_origin(context, name, (int32_t)node->line);
  *facts = (cs_svg_facts){.number = node->number, .line = node->line, .place = context->origin};
  CS_TRY(cs_svg_text_copy(context, art, node->tag, &facts->tag));
  if (classes && *classes)
    CS_TRY(cs_svg_text_copy(context, art, classes, &facts->classes));
  if (cs_svg_is_shape(node) || node->element == CS_SVG_ELEMENT_TEXT)
    write_fill(style, facts->fill);
  item->facts = facts;
  return CELSPAN_OK;
}

celspan_status cs_svg_item_name(cs_svg_reading *reading, celspan_svg *art, const cs_svg_node *node,
                                const cs_svg_place *place, cs_svg_item *item) {
  celspan_context *context = reading->context;
  const char *id = cs_svg_node_value(node, CS_SVG_ID);
  const char *label = cs_svg_node_value(node, CS_SVG_LABEL);
  if (id && *id)
    CS_TRY(cs_svg_text_copy(context, art, id, &item->id));
  if (label && *label)
    CS_TRY(cs_svg_text_copy(context, art, label, &item->label));
  if (node->parent)
    CS_TRY(note_facts(context, art, reading->source->name, node, &place->style, item));
  item->is_moved = place->is_moved;
  if (item->is_moved) {
    item->moved = place->moved;
    item->is_moved = celspan_matrix_inverse(item->moved, &item->back);
  }
  return CELSPAN_OK;
}
