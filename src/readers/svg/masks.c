#include "readers/svg/masks.h"

#include "base/number.h"
#include "model/scene/bounds.h"
#include "readers/svg/boxes.h"
#include "readers/svg/clips.h"
#include "readers/svg/markers.h"
#include "readers/svg/shapes.h"
#include "readers/svg/strokes.h"

#define SHAPES 64 /* of one mask */

/* One shape of a mask, and what it lets through where it is on top. */
typedef struct masked_shape {
  celspan_object *object; /* owned */
  double share, alpha;
  celspan_box box; /* where is_there */
  bool is_there;
} masked_shape;

typedef struct mask {
  cs_svg_reading *reading;
  masked_shape shapes[SHAPES];
  size_t count;
  bool is_flat;
  bool uses_alpha;
} mask;

/* Source: CSS Masking Module Level 1, 7.10: luminance of the coded colour, times alpha. */
static double luminance(const cs_svg_colour *colour) {
  return 0.2125 * colour->rgb[0] + 0.7154 * colour->rgb[1] + 0.0721 * colour->rgb[2];
}

/* The one colour of a fill or a stroke; false if it has several or none. */
static bool flat_colour(const cs_svg_style *style, cs_svg_layer layer, cs_svg_colour *out) {
  bool is_fill = layer == CS_SVG_LAYER_FILL;
  const cs_svg_paint *paint = is_fill ? &style->fill : &style->stroke;
  *out = paint->kind == CS_SVG_PAINT_CURRENT ? style->colour : paint->colour;
  if (paint->kind == CS_SVG_PAINT_NONE)
    out->alpha = 0;
  out->alpha *= is_fill ? style->fill_opacity : style->stroke_opacity;
  return !paint->has_server;
}

/* Adds the fill or the stroke of a shape. place: of what it is in, and the shape's own. opacity: of
 * the shape and the groups around. */
static celspan_status add_layer(mask *m, const cs_svg_node *node, const cs_svg_place *parent,
                                const cs_svg_place *place, cs_svg_layer layer, double opacity) {
  cs_svg_style style;
  cs_svg_colour colour;
  if (m->count == SHAPES) {
    m->is_flat = false;
    return CELSPAN_OK;
  }
  masked_shape *shape = &m->shapes[m->count];
  if (layer == CS_SVG_LAYER_FILL)
    CS_TRY(cs_svg_shape_object(m->reading, node, *parent, true, &shape->object, &style));
  else
    CS_TRY(cs_svg_stroke(m->reading, node, place, &shape->object));
  if (!shape->object)
    return CELSPAN_OK;
  m->is_flat = flat_colour(&place->style, layer, &colour) && m->is_flat;
  shape->alpha = colour.alpha * opacity;
  shape->share = cs_number_clamp(shape->alpha * (m->uses_alpha ? 1 : luminance(&colour)), 0, 1);
  m->count++;
  return CELSPAN_OK;
}

static celspan_status add_shape(mask *m, const cs_svg_node *node, const cs_svg_place *parent,
                                double opacity) {
  cs_svg_place place = *parent;
  size_t before = m->count;
  CS_TRY(cs_svg_enter(m->reading, node, &place));
  const cs_svg_style *style = &place.style;
  bool is_stroked = cs_svg_is_stroked(style);
  if (!style->is_displayed || !style->is_visible)
    return CELSPAN_OK;
  m->is_flat = m->is_flat && !style->has_mask && !style->has_filter &&
               !(is_stroked && style->has_clip_path) && !cs_svg_is_marked(node, style);
  for (int i = 0; i < 3; i++)
    if (style->paint_order[i] == CS_SVG_LAYER_FILL ||
        (style->paint_order[i] == CS_SVG_LAYER_STROKE && is_stroked))
      CS_TRY(add_layer(m, node, parent, &place, style->paint_order[i], opacity * style->opacity));
  m->is_flat = m->is_flat && (style->opacity == 1 || m->count - before <= 1);
  return CELSPAN_OK;
}

/* Recursion: through groups and `use`, CS_SVG_DEPTH. opacity: of the groups around. */
static celspan_status add_child(mask *m, const cs_svg_node *node, const cs_svg_place *parent,
                                double opacity);

/* What `use` shows. */
static celspan_status add_used(mask *m, const cs_svg_node *node, cs_svg_place *place,
                               double opacity) {
  const cs_svg_node *used = cs_svg_linked(m->reading, node);
  double x, y;
  if (!used)
    return CELSPAN_OK;
  if (cs_svg_is_open(place->open, used))
    return cs_svg_skip(m->reading, node, "use that is inside the element that it shows");
  CS_TRY(cs_svg_number_of(m->reading->context, node, CS_SVG_X, CS_SVG_AXIS_X, &place->measure, &x));
  CS_TRY(cs_svg_number_of(m->reading->context, node, CS_SVG_Y, CS_SVG_AXIS_Y, &place->measure, &y));
  place->matrix = celspan_matrix_then(celspan_matrix_translation(x, y), place->matrix);
  return add_child(m, used, place, opacity);
}

static celspan_status add_content(mask *m, const cs_svg_node *node, cs_svg_place *place,
                                  double opacity) {
  if (node->element == CS_SVG_ELEMENT_USE)
    return add_used(m, node, place, opacity);
  for (const cs_svg_node *child = node->first; child; child = child->next)
    CS_TRY(add_child(m, child, place, opacity));
  return CELSPAN_OK;
}

static celspan_status add_group(mask *m, const cs_svg_node *node, cs_svg_place place,
                                double opacity) {
  const cs_svg_open open = {node, place.open};
  const size_t before = m->count;
  CS_TRY(cs_svg_enter(m->reading, node, &place));
  if (!place.style.is_displayed)
    return CELSPAN_OK;
  if (++m->reading->depth > CS_SVG_DEPTH)
    return cs_fail(m->reading->context, CELSPAN_LIMIT,
                   "line %u: elements of a mask refer to one another more than %d deep", node->line,
                   CS_SVG_DEPTH);
  place.open = &open;
  const double own = place.style.opacity;
  m->is_flat =
      m->is_flat && !place.style.has_clip_path && !place.style.has_mask && !place.style.has_filter;
  CS_TRY(add_content(m, node, &place, opacity * own));
  m->is_flat = m->is_flat && (own == 1 || m->count - before <= 1);
  m->reading->depth--;
  return CELSPAN_OK;
}

static celspan_status add_child(mask *m, const cs_svg_node *node, const cs_svg_place *parent,
                                double opacity) {
  if (cs_svg_is_shape(node))
    return add_shape(m, node, parent, opacity);
  switch (node->element) {
  case CS_SVG_ELEMENT_A:
  case CS_SVG_ELEMENT_G:
  case CS_SVG_ELEMENT_USE:
    return add_group(m, node, *parent, opacity);
  case CS_SVG_ELEMENT_IMAGE:
  case CS_SVG_ELEMENT_SVG:
  case CS_SVG_ELEMENT_SWITCH:
  case CS_SVG_ELEMENT_SYMBOL:
  case CS_SVG_ELEMENT_TEXT:
    m->is_flat = false;
    return CELSPAN_OK;
  default:
    return CELSPAN_OK;
  }
}

static bool are_apart(const masked_shape *a, const masked_shape *b) {
  return !a->is_there || !b->is_there || a->box.x >= b->box.x + b->box.width ||
         b->box.x >= a->box.x + a->box.width || a->box.y >= b->box.y + b->box.height ||
         b->box.y >= a->box.y + a->box.height;
}

/* A mask is flat where no shape shines through another: all are opaque, or their boxes are apart.
 */
static celspan_status check_separate(mask *m) {
  size_t end = m->count; /* through those from here on nothing shines */
  while (end > 0 && m->shapes[end - 1].alpha >= 1)
    end--;
  for (size_t i = 0; i < end && m->is_flat; i++) {
    masked_shape *shape = &m->shapes[i];
    CS_TRY(cs_bounds_object(m->reading->context, shape->object, &shape->is_there, &shape->box));
    for (size_t k = 0; k < i; k++)
      m->is_flat = m->is_flat && (shape->alpha >= 1 || are_apart(&m->shapes[k], shape));
  }
  return CELSPAN_OK;
}

/* Shape i without what lies over it, inside the mask's region. */
static celspan_status cut_piece(mask *m, size_t i, celspan_object *region, celspan_object **out) {
  celspan_object *operands[SHAPES], *piece;
  size_t count = 0;
  for (size_t k = i; k < m->count; k++)
    operands[count++] = m->shapes[k].object;
  CS_TRY(celspan_object_create_boolean(m->reading->context, CELSPAN_DIFFERENCE, operands, count,
                                       &piece));
  return cs_svg_intersect(m->reading, piece, celspan_object_ref(region), out);
}

static celspan_status cut_pieces(mask *m, celspan_svg *art, celspan_object *region,
                                 cs_svg_mask **out) {
  celspan_context *context = m->reading->context;
  cs_svg_mask *pieces = cs_arena_take(context, &art->arena, sizeof *pieces);
  if (!pieces)
    return CELSPAN_NO_MEMORY;
  *pieces = (cs_svg_mask){0};
  pieces->shapes = cs_arena_take(context, &art->arena, m->count * sizeof(celspan_object *));
  pieces->shares = cs_arena_take(context, &art->arena, m->count * sizeof *pieces->shares);
  if (!pieces->shapes || !pieces->shares)
    return CELSPAN_NO_MEMORY;
  *out = pieces;
  for (size_t i = 0; i < m->count; i++)
    if (m->shapes[i].share > 0) {
      CS_TRY(cut_piece(m, i, region, &pieces->shapes[pieces->count]));
      pieces->shares[pieces->count++] = m->shapes[i].share;
    }
  return CELSPAN_OK;
}

/* The mask's region, and the units of its contents. *is_sized: false when these are shares of a box
 * without a size. */
static celspan_status read_region(mask *m, const cs_svg_node *node, const cs_svg_node *element,
                                  cs_svg_place *place, celspan_object **region, bool *is_sized) {
  celspan_context *context = m->reading->context;
  const char *units = cs_svg_node_value(node, CS_SVG_MASK_UNITS);
  const char *content = cs_svg_node_value(node, CS_SVG_MASK_CONTENT_UNITS);
  bool is_in_user_space = units && cs_svg_is_word(units, "userSpaceOnUse");
  bool has_box_content = content && cs_svg_is_word(content, "objectBoundingBox");
  const cs_svg_length least = {-10, CS_SVG_UNIT_PERCENT}, whole = {120, CS_SVG_UNIT_PERCENT};
  cs_svg_measure measure = place->measure;
  celspan_box box = {0, 0, 0, 0}, part;
  cs_svg_place own = *place;
  bool is_there = false;
  own.matrix = celspan_matrix_identity();
  CS_TRY(cs_svg_box_of(m->reading, element, &own, &box, &is_there));
  *is_sized = is_there && box.width > 0 && box.height > 0;
  if (!*is_sized && !(is_in_user_space && !has_box_content))
    return CELSPAN_OK;
  *is_sized = true;
  if (!is_in_user_space)
    measure.width = measure.height = 1;
  CS_TRY(cs_svg_length_of(context, node, CS_SVG_X, CS_SVG_AXIS_X, &measure, least, &part.x));
  CS_TRY(cs_svg_length_of(context, node, CS_SVG_Y, CS_SVG_AXIS_Y, &measure, least, &part.y));
  CS_TRY(
      cs_svg_length_of(context, node, CS_SVG_WIDTH, CS_SVG_AXIS_X, &measure, whole, &part.width));
  CS_TRY(
      cs_svg_length_of(context, node, CS_SVG_HEIGHT, CS_SVG_AXIS_Y, &measure, whole, &part.height));
  *is_sized = part.width > 0 && part.height > 0;
  if (!*is_sized)
    return CELSPAN_OK;
  celspan_matrix in_box = celspan_matrix_then(cs_svg_box_matrix(&box), place->matrix);
  CS_TRY(cs_svg_rectangle(m->reading->context, &part, is_in_user_space ? &place->matrix : &in_box,
                          region));
  if (has_box_content)
    place->matrix = in_box;
  return CELSPAN_OK;
}

static celspan_status read_mask(mask *m, celspan_svg *art, const cs_svg_node *node,
                                const cs_svg_node *element, cs_svg_place place, cs_svg_mask **out) {
  celspan_object *region = NULL;
  bool is_sized;
  CS_TRY(read_region(m, node, element, &place, &region, &is_sized));
  celspan_status status = cs_svg_style_in_file(m->reading, node, &place.style);
  m->uses_alpha = place.style.uses_alpha;
  m->is_flat = !place.style.has_mask && !place.style.has_clip_path;
  for (const cs_svg_node *child = node->first; child && is_sized && status == CELSPAN_OK;
       child = child->next)
    status = add_child(m, child, &place, 1);
  if (status == CELSPAN_OK)
    status = check_separate(m);
  if (status == CELSPAN_OK)
    status = m->is_flat ? cut_pieces(m, art, region, out)
                        : cs_svg_skip(m->reading, node, "mask that is not flat");
  celspan_object_unref(region);
  return status;
}

celspan_status cs_svg_mask_make(cs_svg_reading *reading, celspan_svg *art,
                                const cs_svg_node *element, const cs_svg_place *place,
                                cs_svg_mask **out) {
  const cs_svg_node *node = cs_svg_referred(reading, place->style.mask);
  *out = NULL;
  if (!node || node->element != CS_SVG_ELEMENT_MASK)
    return place->style.mask.size > 0
               ? cs_svg_skip(reading, element, "mask that is not in the file")
               : CELSPAN_OK;
  if (cs_svg_is_open(place->open, node))
    return cs_svg_skip(reading, node, "mask that masks itself");
  mask m = {.reading = reading};
  celspan_status status = read_mask(&m, art, node, element, *place, out);
  for (size_t i = 0; i < m.count; i++)
    celspan_object_unref(m.shapes[i].object);
  return status;
}
