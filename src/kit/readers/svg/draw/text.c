#include "readers/svg/draw/text.h"

#include "readers/svg/document/naming.h"
#include "readers/svg/draw/letters.h"
#include "readers/svg/draw/paint.h"
#include "readers/svg/draw/strokes.h"

typedef struct lettering {
  cs_svg_reading *reading;
  celspan_svg *art;
  cs_svg_written written;
  cs_svg_letters letters;
  size_t next;     /* text node */
  celspan_box box; /* around all letters, for gradients whose units are shares of it */
  bool has_box;
} lettering;

/* ---------------------------------------------------------------- items */

/* The letters of a text node, filled or stroked. */
static celspan_status add_layer(lettering *l, const cs_svg_text_node *text,
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
      cs_svg_letters_outline(&l->letters, &l->written, text->begin, text->end, &outline);
  if (status == CELSPAN_OK)
    status = (is_stroke ? cs_svg_stroke_outline : cs_svg_fill_outline)(
        l->reading, text->node, place, &outline, box, &item->own);
  cs_outline_finish(&outline, l->reading->context->memory);
  CS_TRY(status);
  return cs_svg_item_compose(l->reading->context, item);
}

/* A text node has the place of its element, without the transform: elements inside a text have no
 * transforms. */
static celspan_status add_text_node(lettering *l, const cs_svg_place *place, cs_svg_item *parent) {
  const cs_svg_text_node *text = &l->written.nodes[l->next++];
  cs_svg_place own = text->place;
  if (!own.style.is_visible)
    return CELSPAN_OK;
  own.matrix = place->matrix;
  own.style.fill_rule = CELSPAN_RULE_NONZERO;
  for (int i = 0; i < 3; i++)
    CS_TRY(add_layer(l, text, &own, own.style.paint_order[i], parent));
  return CELSPAN_OK;
}

/* Whether the next text node lies inside an element, at any depth. */
static bool holds_next(const lettering *l, const cs_svg_node *node) {
  if (l->next == l->written.node_count)
    return false;
  const cs_svg_node *at = l->written.nodes[l->next].node;
  while (at && at != node)
    at = at->parent;
  return at != NULL;
}

/* Adds the contents of an element. Recursion: CS_SVG_DEPTH. */
static celspan_status add_content(lettering *l, const cs_svg_node *node, const cs_svg_place *place,
                                  cs_svg_item *item);

/* Adds an element inside a text: it has its own opacity, but no place. */
static celspan_status add_inner(lettering *l, const cs_svg_node *node, cs_svg_place place,
                                cs_svg_item *parent) {
  cs_svg_reading *reading = l->reading;
  const cs_svg_style above = place.style;
  cs_svg_item *item;
  CS_TRY(cs_svg_style_resolve(reading->context, reading->document, node, &above, &reading->tests,
                              &place.style));
  CS_TRY(cs_svg_item_append(reading->context, l->art, parent, &item));
  CS_TRY(cs_svg_item_name(reading, l->art, node, &place, item));
  item->opacity = place.style.opacity;
  CS_TRY(add_content(l, node, &place, item));
  return cs_svg_item_compose(reading->context, item);
}

static celspan_status add_content(lettering *l, const cs_svg_node *node, const cs_svg_place *place,
                                  cs_svg_item *item) {
  for (const cs_svg_node *child = node->first; child; child = child->next) {
    if (!holds_next(l, child))
      continue;
    if (child->element == CS_SVG_ELEMENT_CHARACTERS) {
      CS_TRY(add_text_node(l, place, item));
      continue;
    }
    CS_TRY(add_inner(l, child, *place, item));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the whole */

/* Makes the letters of a text. *l must be finished even after a failure. */
static celspan_status set_letters(cs_svg_reading *reading, const cs_svg_node *node,
                                  const cs_svg_place *place, lettering *l) {
  *l = (lettering){.reading = reading, .letters = {.context = reading->context}};
  CS_TRY(cs_svg_written_read(reading, node, place, &l->written));
  CS_TRY(cs_svg_letters_make(reading, node, &l->written, &l->letters));
  l->has_box = cs_svg_letters_box(&l->letters, &l->written, &l->box);
  return CELSPAN_OK;
}

static void finish(lettering *l) {
  cs_svg_letters_finish(&l->letters);
  cs_svg_written_finish(&l->written);
}

celspan_status cs_svg_text_add(cs_svg_reading *reading, celspan_svg *art, const cs_svg_node *node,
                               const cs_svg_place *place, cs_svg_item *item) {
  lettering l;
  celspan_status status = set_letters(reading, node, place, &l);
  l.art = art;
  if (status == CELSPAN_OK)
    status = add_content(&l, node, place, item);
  finish(&l);
  return status;
}

celspan_status cs_svg_text_outline(cs_svg_reading *reading, const cs_svg_node *node,
                                   const cs_svg_place *place, cs_outline *outline) {
  lettering l;
  celspan_status status = set_letters(reading, node, place, &l);
  if (status == CELSPAN_OK)
    status = cs_svg_letters_outline(&l.letters, &l.written, 0, l.written.count, outline);
  finish(&l);
  return status;
}

celspan_status cs_svg_text_box(cs_svg_reading *reading, const cs_svg_node *node,
                               const cs_svg_place *place, celspan_box *out, bool *is_there) {
  lettering l;
  celspan_status status = set_letters(reading, node, place, &l);
  *is_there = status == CELSPAN_OK && l.has_box;
  if (*is_there)
    *out = l.box;
  finish(&l);
  return status;
}
