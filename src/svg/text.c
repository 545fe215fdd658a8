#include "svg/text.h"

#include "svg/letters.h"
#include "svg/naming.h"
#include "svg/paint.h"
#include "svg/strokes.h"

typedef struct lettering {
  cs_svg_reading *reading;
  celspan_svg *art;
  cs_svg_written written;
  cs_svg_letters letters;
  size_t next;     /* stretch */
  celspan_box box; /* around all letters, for gradients in shares of it */
  bool has_box;
} lettering;

/* ---------------------------------------------------------------- boxes */

/* The box is of all letters, whatever element they are in; without a gradient nobody asks for it. */
static bool asks_for_box(const cs_svg_written *written) {
  for (size_t i = 0; i < written->stretch_count; i++)
    if (written->stretches[i].place.style.fill.has_server ||
        written->stretches[i].place.style.stroke.has_server)
      return true;
  return false;
}

static celspan_status find_box(lettering *l) {
  const celspan_matrix identity = celspan_matrix_identity();
  cs_outline outline;
  if (!asks_for_box(&l->written))
    return CELSPAN_OK;
  cs_outline_init(&outline);
  celspan_status status =
      cs_svg_letters_outline(&l->letters, &l->written, 0, l->written.count, &outline);
  if (status == CELSPAN_OK && outline.piece_count > 0)
    l->has_box = cs_outline_bounds(&outline, &identity, &l->box);
  cs_outline_finish(&outline, l->reading->context->memory);
  return status;
}

/* ---------------------------------------------------------------- items */

/* The letters of a stretch, filled or stroked. */
static celspan_status add_layer(lettering *l, const cs_svg_stretch *stretch,
                                const cs_svg_place *place, cs_svg_layer layer,
                                cs_svg_item *parent) {
  const celspan_box *box = l->has_box ? &l->box : NULL;
  bool is_stroke = layer == CS_SVG_LAYER_STROKE;
  cs_svg_item *item;
  cs_outline outline;
  if (layer == CS_SVG_LAYER_MARKERS || (is_stroke && !cs_svg_is_stroked(&place->style)))
    return CELSPAN_OK;
  CS_TRY(cs_svg_item_append(l->reading->context, l->art, parent, &item));
  cs_outline_init(&outline);
  celspan_status status =
      cs_svg_letters_outline(&l->letters, &l->written, stretch->begin, stretch->end, &outline);
  if (status == CELSPAN_OK)
    status = (is_stroke ? cs_svg_stroke_outline : cs_svg_fill_outline)(
        l->reading, stretch->node, place, &outline, box, &item->own);
  cs_outline_finish(&outline, l->reading->context->memory);
  CS_TRY(status);
  return cs_svg_item_compose(l->reading->context, item);
}

/* The place of a stretch is that of its element, but for the transform: elements inside of a text
 * have none of their own. */
static celspan_status add_stretch(lettering *l, const cs_svg_place *place, cs_svg_item *parent) {
  const cs_svg_stretch *stretch = &l->written.stretches[l->next++];
  cs_svg_place own = stretch->place;
  if (!own.style.is_visible)
    return CELSPAN_OK;
  own.matrix = place->matrix;
  own.style.fill_rule = CELSPAN_RULE_NONZERO;
  for (int i = 0; i < 3; i++)
    CS_TRY(add_layer(l, stretch, &own, own.style.paint_order[i], parent));
  return CELSPAN_OK;
}

/* Whether the next stretch is somewhere inside of an element. */
static bool holds_next(const lettering *l, const cs_svg_node *node) {
  if (l->next == l->written.stretch_count)
    return false;
  const cs_svg_node *at = l->written.stretches[l->next].node;
  while (at && at != node)
    at = at->parent;
  return at != NULL;
}

/* Adds what is in an element. Recursion: CS_SVG_DEPTH. */
static celspan_status add_content(lettering *l, const cs_svg_node *node, const cs_svg_place *place,
                                  cs_svg_item *item) {
  for (const cs_svg_node *child = node->first; child; child = child->next) {
    if (!holds_next(l, child))
      continue;
    if (child->element == CS_SVG_ELEMENT_CHARACTERS) {
      CS_TRY(add_stretch(l, place, item));
      continue;
    }
    cs_svg_item *inner;
    CS_TRY(cs_svg_item_append(l->reading->context, l->art, item, &inner));
    CS_TRY(cs_svg_item_name(l->reading, l->art, child, place, inner));
    CS_TRY(add_content(l, child, place, inner));
    CS_TRY(cs_svg_item_compose(l->reading->context, inner));
  }
  return CELSPAN_OK;
}

celspan_status cs_svg_text_add(cs_svg_reading *reading, celspan_svg *art, const cs_svg_node *node,
                               const cs_svg_place *place, cs_svg_item *item) {
  lettering l = {.reading = reading, .art = art, .letters = {.context = reading->context}};
  celspan_status status = cs_svg_written_read(reading, node, place, &l.written);
  if (status == CELSPAN_OK)
    status = cs_svg_letters_make(reading, node, &l.written, &l.letters);
  if (status == CELSPAN_OK)
    status = find_box(&l);
  if (status == CELSPAN_OK)
    status = add_content(&l, node, place, item);
  cs_svg_letters_finish(&l.letters);
  cs_svg_written_finish(&l.written);
  return status;
}
