#include "readers/svg/draw/boxes.h"

#include <math.h>

#include "readers/svg/document/shapes.h"
#include "readers/svg/document/shown.h"
#include "readers/svg/draw/image.h"
#include "readers/svg/draw/text.h"
#include "readers/svg/draw/viewport.h"

static void add_box(const celspan_box *box, celspan_box *whole, bool *is_there) {
  if (!*is_there) {
    *whole = *box;
    *is_there = true;
    return;
  }
  double right = fmax(whole->x + whole->width, box->x + box->width);
  double bottom = fmax(whole->y + whole->height, box->y + box->height);
  whole->x = fmin(whole->x, box->x);
  whole->y = fmin(whole->y, box->y);
  whole->width = right - whole->x;
  whole->height = bottom - whole->y;
}

static celspan_status add_shape_box(cs_svg_reading *reading, const cs_svg_node *node,
                                    const cs_svg_place *place, celspan_box *whole, bool *is_there) {
  cs_svg_line line;
  celspan_box box;
  celspan_status status = cs_svg_line_init(reading->context, node, &place->measure, &line);
  if (status == CELSPAN_OK && line.outline.piece_count > 0 &&
      cs_outline_bounds(&line.outline, &place->matrix, &box))
    add_box(&box, whole, is_there);
  cs_svg_line_finish(&line, reading->context);
  return status;
}

/* Adds an element with its own transform, and its contents. Recursion: CS_SVG_DEPTH. */
static celspan_status add_element_box(cs_svg_reading *reading, const cs_svg_node *node,
                                      cs_svg_place place, celspan_box *whole, bool *is_there) {
  const cs_svg_open open = {node, place.open};
  if (!cs_svg_is_shown(node, place.sizes) || cs_svg_is_open(place.open, node))
    return CELSPAN_OK; /* a note is made when visible contents are drawn */
  if (++reading->depth > CS_SVG_DEPTH)
    return cs_fail(reading->context, CELSPAN_LIMIT,
                   "line %u: elements refer to one another more than %d deep", node->line,
                   CS_SVG_DEPTH);
  CS_TRY(cs_svg_count_drawn(reading, node));
  CS_TRY(cs_svg_enter(reading, node, &place));
  place.open = &open;
  if (place.style.is_displayed)
    CS_TRY(cs_svg_box_of(reading, node, &place, whole, is_there));
  reading->depth--;
  return CELSPAN_OK;
}

static celspan_status add_used_box(cs_svg_reading *reading, const cs_svg_node *node,
                                   const cs_svg_place *place, celspan_box *whole, bool *is_there) {
  const cs_svg_node *used = cs_svg_linked(reading, node);
  double x, y;
  cs_svg_place inner = *place;
  if (!used)
    return CELSPAN_OK;
  CS_TRY(cs_svg_number_of(reading->context, node, CS_SVG_X, CS_SVG_AXIS_X, &place->measure, &x));
  CS_TRY(cs_svg_number_of(reading->context, node, CS_SVG_Y, CS_SVG_AXIS_Y, &place->measure, &y));
  inner.matrix = celspan_matrix_then(celspan_matrix_translation(x, y), inner.matrix);
  inner.sizes = node;
  return add_element_box(reading, used, inner, whole, is_there);
}

static celspan_status add_boxes(cs_svg_reading *reading, const cs_svg_node *node,
                                const cs_svg_place *place, celspan_box *whole, bool *is_there) {
  cs_svg_place inner = *place;
  inner.sizes = NULL;
  for (const cs_svg_node *child = node->first; child; child = child->next)
    CS_TRY(add_element_box(reading, child, inner, whole, is_there));
  return CELSPAN_OK;
}

/* The viewport of a nested svg element or a symbol; the outermost viewport has been entered
 * already. */
static celspan_status add_viewport_box(cs_svg_reading *reading, const cs_svg_node *node,
                                       const cs_svg_place *place, celspan_box *whole,
                                       bool *is_there) {
  cs_svg_place inner = *place;
  celspan_box viewport;
  if (!node->parent)
    return add_boxes(reading, node, place, whole, is_there);
  CS_TRY(cs_svg_viewport_find(reading, node, place->sizes, &inner, &viewport));
  if (!(viewport.width > 0) || !(viewport.height > 0))
    return CELSPAN_OK;
  cs_svg_viewport_enter(node, &viewport, &inner);
  return add_boxes(reading, node, &inner, whole, is_there);
}

static celspan_status add_switch_box(cs_svg_reading *reading, const cs_svg_node *node,
                                     const cs_svg_place *place, celspan_box *whole,
                                     bool *is_there) {
  const cs_svg_node *chosen = cs_svg_shown_choice(node);
  cs_svg_place inner = *place;
  inner.sizes = NULL;
  return chosen ? add_element_box(reading, chosen, inner, whole, is_there) : CELSPAN_OK;
}

/* Adds a box in user units. */
static void add_placed(const celspan_box *box, const celspan_matrix *matrix, celspan_box *whole,
                       bool *is_there) {
  const double *m = matrix->m;
  for (int i = 0; i < 4; i++) {
    double x = box->x + (i & 1) * box->width, y = box->y + (i >> 1) * box->height;
    const celspan_box corner = {m[0] * x + m[1] * y + m[2], m[3] * x + m[4] * y + m[5], 0, 0};
    add_box(&corner, whole, is_there);
  }
}

/* A measured element is drawn later, and notes are made then. */
static celspan_status add_text_box(cs_svg_reading *reading, const cs_svg_node *node,
                                   const cs_svg_place *place, celspan_box *whole, bool *is_there) {
  celspan_box box;
  bool has_box = false;
  size_t skipped = reading->skipped_count;
  CS_TRY(cs_svg_text_box(reading, node, place, &box, &has_box));
  reading->skipped_count = skipped;
  if (has_box)
    add_placed(&box, &place->matrix, whole, is_there);
  return CELSPAN_OK;
}

static celspan_status add_image_box(cs_svg_reading *reading, const cs_svg_node *node,
                                    const cs_svg_place *place, celspan_box *whole, bool *is_there) {
  celspan_box box;
  bool has_box = false;
  CS_TRY(cs_svg_image_box(reading, node, &place->measure, &box, &has_box));
  if (has_box)
    add_placed(&box, &place->matrix, whole, is_there);
  return CELSPAN_OK;
}

celspan_status cs_svg_box_of(cs_svg_reading *reading, const cs_svg_node *node,
                             const cs_svg_place *place, celspan_box *out, bool *is_there) {
  if (cs_svg_is_shape(node))
    return add_shape_box(reading, node, place, out, is_there);
  if (node->element == CS_SVG_ELEMENT_USE)
    return add_used_box(reading, node, place, out, is_there);
  switch (node->element) {
  case CS_SVG_ELEMENT_TEXT:
    return add_text_box(reading, node, place, out, is_there);
  case CS_SVG_ELEMENT_IMAGE:
    return add_image_box(reading, node, place, out, is_there);
  case CS_SVG_ELEMENT_A:
  case CS_SVG_ELEMENT_G:
    return add_boxes(reading, node, place, out, is_there);
  case CS_SVG_ELEMENT_SVG:
  case CS_SVG_ELEMENT_SYMBOL:
    return add_viewport_box(reading, node, place, out, is_there);
  case CS_SVG_ELEMENT_SWITCH:
    return add_switch_box(reading, node, place, out, is_there);
  default:
    return CELSPAN_OK;
  }
}
