/* From the elements of a document to the items of a drawing. */
#include "readers/svg/read.h"

#include <math.h>
#include <string.h>

#include "inside/number.h"
#include "readers/svg/document/art.h"
#include "readers/svg/document/cascade.h"
#include "readers/svg/document/naming.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/document/shown.h"
#include "readers/svg/draw/boxes.h"
#include "readers/svg/draw/clips.h"
#include "readers/svg/draw/image.h"
#include "readers/svg/draw/markers.h"
#include "readers/svg/draw/paint.h"
#include "readers/svg/draw/regions.h"
#include "readers/svg/draw/strokes.h"
#include "readers/svg/draw/text.h"
#include "readers/svg/draw/viewport.h"
#include "readers/svg/filters/filters.h"

/* The default size of a drawing. Source: CSS 2.1, 10.3.2. */
#define DEFAULT_WIDTH 300
#define DEFAULT_HEIGHT 150

typedef struct builder {
  cs_svg_reading *reading;
  celspan_svg *art;
  celspan_matrix root_matrix; /* user units of the outermost element to the drawing's */
} builder;

/* Adds the drawing of an element to `parent`. place: the place of the element's parent. Recursion:
 * at most CS_SVG_DEPTH elements, including those of `use`. */
static celspan_status add_element(builder *b, const cs_svg_node *node, cs_svg_place place,
                                  cs_svg_item *parent);

static celspan_status add_children(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                                   cs_svg_item *parent) {
  for (const cs_svg_node *child = node->first; child; child = child->next)
    CS_TRY(add_element(b, child, *place, parent));
  return CELSPAN_OK;
}

/* Counts an element against the limits. */
static celspan_status count_element(builder *b, const cs_svg_node *node) {
  cs_svg_reading *reading = b->reading;
  CS_TRY(cs_svg_count_drawn(reading, node));
  if (++reading->depth > CS_SVG_DEPTH)
    return cs_fail(reading->context, CELSPAN_LIMIT,
                   "line %u: elements shown by use are nested more than %d deep", node->line,
                   CS_SVG_DEPTH);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- viewports */

/* Adds the content of a nested svg element or a symbol, whose style *place has. */
static celspan_status add_viewport(builder *b, const cs_svg_node *node, const cs_svg_node *sizes,
                                   cs_svg_place *place, cs_svg_item *parent) {
  celspan_box box;
  CS_TRY(cs_svg_viewport_find(b->reading, node, sizes, place, &box));
  if (!(box.width > 0) || !(box.height > 0))
    return CELSPAN_OK;
  cs_svg_item *inside = parent;
  if (!place->style.shows_overflow) {
    CS_TRY(cs_svg_item_append(b->reading->context, b->art, parent, &inside));
    inside->has_clip = true;
    CS_TRY(cs_svg_rectangle(b->reading->context, &box, &place->matrix, &inside->clip));
  }
  cs_svg_viewport_enter(node, &box, place);
  CS_TRY(add_children(b, node, place, inside));
  return inside == parent ? CELSPAN_OK : cs_svg_item_compose(b->reading->context, inside);
}

/* ---------------------------------------------------------------- contexts */

/* A paint with `place` as its context, for an element that inherits it. If the paint has a context
 * already, this context is kept. */
static cs_svg_paint context_paint(cs_svg_paint paint, const cs_svg_style *style,
                                  const cs_svg_context_box *context) {
  if (paint.kind == CS_SVG_PAINT_CURRENT) {
    paint.kind = CS_SVG_PAINT_COLOUR;
    paint.colour = style->colour;
  }
  if (paint.has_server && !paint.context)
    paint.context = context;
  return paint;
}

/* Gives the contents of a `use` or a marker, in *inner, the paints of the element at `place`.
 * *context: must live until they have been drawn. */
static celspan_status enter_context(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                                    cs_svg_context_box *context, cs_svg_place *inner) {
  const cs_svg_style *style = &place->style;
  cs_svg_place own = *place;
  bool is_there = false;
  *context = (cs_svg_context_box){{0, 0, 0, 0}, place->matrix, place->measure};
  own.matrix = celspan_matrix_identity();
  if (style->fill.has_server || style->stroke.has_server)
    CS_TRY(cs_svg_box_of(b->reading, node, &own, &context->box, &is_there));
  inner->style.context_fill = context_paint(style->fill, style, context);
  inner->style.context_stroke = context_paint(style->stroke, style, context);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- use */

/* The matrix to the drawing's units at an element's place in the file: the transforms of the
 * elements around it. */
static celspan_status find_home(builder *b, const cs_svg_node *node, const cs_svg_place *root,
                                celspan_matrix *out) {
  celspan_matrix whole = celspan_matrix_identity();
  cs_svg_style style;
  for (; node && node->parent; node = node->parent) {
    CS_TRY(cs_svg_style_in_file(b->reading, node, &style));
    whole = celspan_matrix_then(whole, cs_svg_transform_of(&style, &root->measure, NULL));
  }
  *out = celspan_matrix_then(whole, b->root_matrix);
  return CELSPAN_OK;
}

/* Notes in *place how far the element is shown from its own place. */
static celspan_status note_moved(builder *b, const cs_svg_node *used, cs_svg_place *place) {
  celspan_matrix home, back;
  CS_TRY(find_home(b, used->parent, place, &home));
  place->is_moved = celspan_matrix_inverse(home, &back);
  if (place->is_moved)
    place->moved = celspan_matrix_then(back, place->matrix);
  place->is_moved = place->is_moved && celspan_matrix_inverse(place->moved, &back);
  return CELSPAN_OK;
}

static celspan_status add_used(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                               cs_svg_item *parent) {
  celspan_context *context = b->reading->context;
  const cs_svg_node *used = cs_svg_linked(b->reading, node);
  cs_svg_place inner = *place;
  cs_svg_context_box box;
  double x, y;
  if (!used)
    return cs_svg_node_value(node, CS_SVG_HREF)
               ? cs_svg_skip(b->reading, node, "use of an element that is not in the file")
               : CELSPAN_OK;
  if (cs_svg_is_open(place->open, used))
    return cs_svg_skip(b->reading, node, "use that is inside the element that it shows");
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_X, CS_SVG_AXIS_X, &place->measure, &x));
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_Y, CS_SVG_AXIS_Y, &place->measure, &y));
  inner.matrix = celspan_matrix_then(celspan_matrix_translation(x, y), inner.matrix);
  CS_TRY(note_moved(b, used, &inner));
  CS_TRY(enter_context(b, node, place, &box, &inner));
  inner.sizes = node;
  return add_element(b, used, inner, parent);
}

/* ---------------------------------------------------------------- groups */

static celspan_status add_switch(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                                 cs_svg_item *parent) {
  const cs_svg_node *chosen = cs_svg_shown_choice(node);
  return chosen ? add_element(b, chosen, *place, parent) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- shapes */

/* Adds the contents of a marker, for one mark of the shape at `shape`. */
static celspan_status add_mark(builder *b, const cs_svg_node *node, const cs_svg_mark *mark,
                               const cs_svg_place *shape, cs_svg_item *parent) {
  const cs_svg_open open = {mark->marker, shape->open};
  cs_svg_place place = *shape;
  cs_svg_context_box context;
  cs_svg_item *item;
  if (!mark->marker->first)
    return CELSPAN_OK;
  CS_TRY(cs_svg_style_in_file(b->reading, mark->marker, &place.style));
  place.open = &open;
  place.measure = mark->measure;
  place.measure.font_size = place.style.font_size;
  CS_TRY(enter_context(b, node, shape, &context, &place));
  place.matrix = celspan_matrix_then(mark->viewport, shape->matrix);
  CS_TRY(cs_svg_item_append(b->reading->context, b->art, parent, &item));
  if (!place.style.shows_overflow) {
    const celspan_box box = {0, 0, mark->width, mark->height};
    item->has_clip = true;
    CS_TRY(cs_svg_rectangle(b->reading->context, &box, &place.matrix, &item->clip));
  }
  place.matrix = celspan_matrix_then(mark->content, place.matrix);
  CS_TRY(note_moved(b, mark->marker->first, &place));
  CS_TRY(add_children(b, mark->marker, &place, item));
  return cs_svg_item_compose(b->reading->context, item);
}

static celspan_status add_marks(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                                cs_svg_item *parent) {
  cs_svg_marks marks;
  celspan_status status = cs_svg_marks_find(b->reading, node, place, &marks);
  for (size_t i = 0; i < marks.count && status == CELSPAN_OK; i++) {
    status = count_element(b, node);
    if (status == CELSPAN_OK)
      status = add_mark(b, node, &marks.items[i], place, parent);
    b->reading->depth--;
  }
  cs_svg_marks_finish(&marks, b->reading->context->memory);
  return status;
}

/* One paint of a shape: its fill, its stroke or its markers. */
static celspan_status add_layer(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                                cs_svg_layer layer, cs_svg_item *parent) {
  cs_svg_item *item;
  CS_TRY(cs_svg_item_append(b->reading->context, b->art, parent, &item));
  if (layer == CS_SVG_LAYER_FILL)
    CS_TRY(cs_svg_fill(b->reading, node, place, &item->own));
  else if (layer == CS_SVG_LAYER_MARKERS && cs_svg_is_marked(node, &place->style))
    CS_TRY(add_marks(b, node, place, item));
  else if (layer == CS_SVG_LAYER_STROKE && cs_svg_is_stroked(&place->style))
    CS_TRY(cs_svg_stroke(b->reading, node, place, &item->own));
  return cs_svg_item_compose(b->reading->context, item);
}

static celspan_status add_shape(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                                cs_svg_item *item) {
  const cs_svg_style *style = &place->style;
  if (!style->is_visible)
    return CELSPAN_OK;
  if (!cs_svg_is_stroked(style) && !cs_svg_is_marked(node, style))
    return cs_svg_fill(b->reading, node, place, &item->own);
  for (int i = 0; i < 3; i++)
    CS_TRY(add_layer(b, node, place, style->paint_order[i], item));
  return CELSPAN_OK;
}

/* The contents of the element, whose style *place has. sizes: see cs_svg_viewport_find. */
static celspan_status add_content(builder *b, const cs_svg_node *node, const cs_svg_node *sizes,
                                  cs_svg_place *place, cs_svg_item *item) {
  switch (node->element) {
  case CS_SVG_ELEMENT_A:
  case CS_SVG_ELEMENT_G:
    return add_children(b, node, place, item);
  case CS_SVG_ELEMENT_SVG:
  case CS_SVG_ELEMENT_SYMBOL:
    return add_viewport(b, node, sizes, place, item);
  case CS_SVG_ELEMENT_SWITCH:
    return add_switch(b, node, place, item);
  case CS_SVG_ELEMENT_USE:
    return add_used(b, node, place, item);
  case CS_SVG_ELEMENT_TEXT:
    return cs_svg_text_add(b->reading, b->art, node, place, item);
  case CS_SVG_ELEMENT_IMAGE:
    return cs_svg_image_add(b->reading, node, place, item);
  default:
    if (cs_svg_is_shape(node))
      return add_shape(b, node, place, item);
    return node->element == CS_SVG_ELEMENT_OTHER /* this was noted when it was read */
               ? CELSPAN_OK
               : cs_svg_skip(b->reading, node, "%.50s", node->tag);
  }
}

/* ---------------------------------------------------------------- effects */

/* The properties that act on the element as a whole. */
static celspan_status read_effects(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                                   cs_svg_item *item);

static bool counts_in_shares(const cs_svg_node *mask) {
  return cs_svg_node_says(mask, CS_SVG_MASK_CONTENT_UNITS, "objectBoundingBox");
}

/* Draws the contents of a mask into `drawn`: the luminance of codes counts. place: in the units of
 * the contents. */
static celspan_status draw_mask(builder *b, const cs_svg_node *mask, const cs_svg_place *place,
                                cs_svg_item *drawn) {
  cs_svg_reading *reading = b->reading;
  const bool is_coded = reading->is_coded;
  reading->is_coded = is_coded || reading->space != CELSPAN_SPACE_SRGB;
  celspan_status status = add_children(b, mask, place, drawn);
  if (status == CELSPAN_OK)
    status = cs_svg_item_compose(reading->context, drawn);
  reading->is_coded = is_coded;
  return status;
}

/* Makes the drawn contents, cut at the mask's region, the mask of the item. */
static celspan_status take_mask(builder *b, const cs_svg_region *region, cs_svg_item *drawn,
                                cs_svg_item *item) {
  celspan_object *both[2] = {drawn->object, NULL};
  if (!both[0])
    return CELSPAN_OK;
  CS_TRY(cs_svg_rectangle(b->reading->context, &region->box, &region->own, &both[1]));
  celspan_status status = celspan_object_create_boolean(b->reading->context, CELSPAN_OPERATOR_CLIP,
                                                        both, 2, &item->mask);
  celspan_object_unref(both[1]);
  return status;
}

/* place: of the masked element, but with the mask's style. region: has a size. */
static celspan_status make_mask(builder *b, const cs_svg_node *mask, const cs_svg_node *node,
                                cs_svg_place place, const cs_svg_region *region,
                                cs_svg_item *item) {
  cs_svg_item *drawn;
  CS_TRY(cs_svg_item_append(b->reading->context, b->art, NULL, &drawn));
  item->masks_by = place.style.uses_alpha ? CELSPAN_MATTE_ALPHA : CELSPAN_MATTE_LUMA;
  celspan_status status = read_effects(b, node, &place, drawn);
  drawn->opacity = 1;
  if (counts_in_shares(mask))
    place.matrix = region->shares;
  if (status == CELSPAN_OK)
    status = draw_mask(b, mask, &place, drawn);
  if (status == CELSPAN_OK)
    status = take_mask(b, region, drawn, item);
  cs_svg_item_drop(drawn);
  return status;
}

/* Source: CSS Masking Module Level 1, 7. A mask may have a mask and a clip path itself. */
static celspan_status enter_mask(builder *b, const cs_svg_node *mask, const cs_svg_node *node,
                                 const cs_svg_place *element, cs_svg_item *item) {
  cs_svg_reading *reading = b->reading;
  const cs_svg_open open = {mask, element->open};
  cs_svg_place place = *element;
  cs_svg_region region;
  item->has_mask = true;
  place.open = &open;
  if (++reading->depth > CS_SVG_DEPTH)
    return cs_fail(reading->context, CELSPAN_LIMIT,
                   "line %u: masks refer to one another more than %d deep", mask->line,
                   CS_SVG_DEPTH);
  CS_TRY(cs_svg_style_in_file(reading, mask, &place.style));
  CS_TRY(cs_svg_region_find(reading, mask, CS_SVG_MASK_UNITS, node, element, &region));
  if (region.is_sized && (region.has_box || !counts_in_shares(mask)))
    CS_TRY(make_mask(b, mask, node, place, &region, item));
  reading->depth--;
  return CELSPAN_OK;
}

/* The mask to which a style refers; NULL: none. */
static const cs_svg_node *mask_of(const builder *b, const cs_svg_style *style) {
  const cs_svg_node *mask = cs_svg_referred(b->reading, style->mask);
  return mask && mask->element == CS_SVG_ELEMENT_MASK ? mask : NULL;
}

/* Whether a mask is open, or a mask of this mask, and so on: then it would mask itself. */
static celspan_status masks_itself(builder *b, const cs_svg_open *open, const cs_svg_node *mask,
                                   bool *out) {
  *out = cs_svg_is_open(open, mask);
  for (int depth = 0; !*out && depth < CS_SVG_DEPTH; depth++) {
    cs_svg_style style;
    CS_TRY(cs_svg_style_in_file(b->reading, mask, &style));
    mask = style.has_mask ? mask_of(b, &style) : NULL;
    if (!mask)
      return CELSPAN_OK;
    *out = cs_svg_is_open(open, mask);
  }
  return CELSPAN_OK;
}

static celspan_status add_mask(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                               cs_svg_item *item) {
  const cs_svg_node *mask = mask_of(b, &place->style);
  bool is_circular;
  if (!mask)
    return place->style.mask.size > 0
               ? cs_svg_skip(b->reading, node, "mask that is not in the file")
               : CELSPAN_OK;
  CS_TRY(masks_itself(b, place->open, mask, &is_circular));
  return is_circular ? cs_svg_skip(b->reading, mask, "mask that masks itself")
                     : enter_mask(b, mask, node, place, item);
}

static celspan_status read_effects(builder *b, const cs_svg_node *node, const cs_svg_place *place,
                                   cs_svg_item *item) {
  const cs_svg_style *style = &place->style;
  item->opacity = style->opacity;
  item->blend = style->blend;
  item->isolates = style->isolates || style->has_clip_path || style->has_mask || style->filter;
  if (style->has_clip_path)
    CS_TRY(cs_svg_clip_make(b->reading, node, place, &item->clip, &item->has_clip));
  if (style->has_mask)
    CS_TRY(add_mask(b, node, place, item));
  return style->filter ? cs_svg_filter_make(b->reading, node, place, &item->filter) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- elements */

/* A singular transform draws nothing. */
static bool is_regular(const celspan_matrix *matrix) {
  celspan_matrix inverse;
  return celspan_matrix_inverse(*matrix, &inverse);
}

static celspan_status add_element(builder *b, const cs_svg_node *node, cs_svg_place place,
                                  cs_svg_item *parent) {
  const cs_svg_node *sizes = place.sizes;
  const cs_svg_open open = {node, place.open};
  if (!cs_svg_is_shown(node, sizes))
    return CELSPAN_OK;
  CS_TRY(count_element(b, node));
  CS_TRY(cs_svg_enter(b->reading, node, &place));
  place.open = &open;
  if (place.style.is_displayed && is_regular(&place.matrix)) {
    cs_svg_item *item;
    CS_TRY(cs_svg_item_append(b->reading->context, b->art, parent, &item));
    CS_TRY(cs_svg_item_name(b->reading, b->art, node, &place, item));
    CS_TRY(read_effects(b, node, &place, item));
    place.sizes = NULL;
    CS_TRY(add_content(b, node, sizes, &place, item));
    CS_TRY(cs_svg_item_compose(b->reading->context, item));
  }
  b->reading->depth--;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- what is drawn alone */

static celspan_status draw(cs_svg_reading *reading, const cs_svg_node *node, bool is_whole,
                           const cs_svg_place *place, celspan_object **out) {
  builder *b = reading->builder;
  cs_svg_item *item;
  *out = NULL;
  CS_TRY(cs_svg_item_append(reading->context, b->art, NULL, &item));
  celspan_status status =
      is_whole ? add_element(b, node, *place, item) : add_children(b, node, place, item);
  if (status == CELSPAN_OK)
    status = cs_svg_item_compose(reading->context, item);
  if (status == CELSPAN_OK && item->object)
    *out = celspan_object_ref(item->object);
  cs_svg_item_drop(item);
  return status;
}

/* ---------------------------------------------------------------- the whole */

/* The size of the outermost element, and the page; percentages and missing values refer to its view
 * box. */
static celspan_status read_size(builder *b, const cs_svg_node *node, const cs_svg_view_box *box) {
  const cs_svg_length whole = {100, CS_SVG_UNIT_PERCENT};
  const double medium = cs_svg_style_initial().font_size;
  cs_svg_measure measure = {.width = box->is_given ? box->width : DEFAULT_WIDTH,
                            .height = box->is_given ? box->height : DEFAULT_HEIGHT,
                            .font_size = medium,
                            .root_font_size = medium};
  measure.page_width = measure.width;
  measure.page_height = measure.height;
  CS_TRY(cs_svg_length_of(b->reading->context, node, CS_SVG_WIDTH, CS_SVG_AXIS_X, &measure, whole,
                          &b->art->width));
  CS_TRY(cs_svg_length_of(b->reading->context, node, CS_SVG_HEIGHT, CS_SVG_AXIS_Y, &measure, whole,
                          &b->art->height));
  b->art->width = fmax(0, b->art->width);
  b->art->height = fmax(0, b->art->height);
  measure.width = measure.page_width = b->art->width;
  measure.height = measure.page_height = b->art->height;
  b->reading->document->page = measure;
  return CELSPAN_OK;
}

/* Moves *place into the outermost element. */
static celspan_status enter_root(builder *b, const cs_svg_node *node, cs_svg_place *place) {
  const celspan_svg *art = b->art;
  *place = (cs_svg_place){.style = cs_svg_style_initial(), .matrix = celspan_matrix_identity()};
  place->measure = b->reading->document->page;
  CS_TRY(cs_svg_enter(b->reading, node, place));
  b->reading->document->page.root_font_size = place->style.font_size;
  place->measure.root_font_size = place->style.font_size;
  cs_svg_viewport_enter(node, &(celspan_box){0, 0, art->width, art->height}, place);
  b->root_matrix = place->matrix;
  return CELSPAN_OK;
}

celspan_status cs_svg_build(cs_svg_reading *reading, celspan_svg *art) {
  builder b = {.reading = reading, .art = art};
  const cs_svg_node *node = reading->document->root;
  cs_svg_view_box box = {.is_given = false};
  const char *value = cs_svg_node_value(node, CS_SVG_VIEW_BOX);
  cs_svg_place place;
  const cs_svg_open open = {node, NULL};
  reading->draw = draw;
  reading->builder = &b;
  CS_TRY(cs_svg_cascade_geometry(reading->context, reading->document, &reading->tests));
  if (value)
    (void)cs_svg_parse_view_box(value, &box);
  CS_TRY(read_size(&b, node, &box));
  CS_TRY(enter_root(&b, node, &place));
  place.open = &open;
  CS_TRY(cs_svg_item_append(reading->context, art, NULL, &art->root));
  CS_TRY(cs_svg_item_name(reading, art, node, &place, art->root));
  CS_TRY(read_effects(&b, node, &place, art->root));
  art->root->isolates = true; /* the same as for an image */
  if (place.style.is_displayed && art->width > 0 && art->height > 0)
    CS_TRY(add_children(&b, node, &place, art->root));
  if (reading->document->sheet.omitted)
    CS_TRY(cs_svg_skip(reading, &(cs_svg_node){.line = reading->document->sheet_line},
                       "style: selectors or at-rules that are not supported"));
  celspan_context_set_origin(reading->context, reading->source->name, (int32_t)node->line);
  CS_TRY(cs_svg_item_compose(reading->context, art->root));
  return cs_svg_art_complete(reading->context, art);
}
