#include "readers/svg/draw/clips.h"

#include <math.h>

#include "inside/number.h"
#include "inside/scene.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/draw/boxes.h"
#include "readers/svg/draw/text.h"
#include "readers/svg/words/transforms.h"

/* ---------------------------------------------------------------- objects */

/* Moves an object, which is released; *out is new. */
static celspan_status moved(celspan_context *context, celspan_object *object,
                            const celspan_matrix *matrix, celspan_object **out) {
  celspan_status status = celspan_object_transform(context, object, matrix, out);
  celspan_object_unref(object);
  return status;
}

celspan_status cs_svg_intersect(cs_svg_reading *reading, celspan_object *a, celspan_object *b,
                                celspan_object **out) {
  celspan_object *both[2] = {a, b};
  celspan_status status = CELSPAN_OK;
  *out = NULL;
  if (a && b)
    status = celspan_object_create_boolean(reading->context, CELSPAN_OPERATOR_INTERSECTION, both, 2,
                                           out);
  celspan_object_unref(a);
  celspan_object_unref(b);
  return status;
}

/* Whether the element has an outline of its own, as shapes and texts have. */
static bool has_outline(const cs_svg_node *node) {
  return cs_svg_is_shape(node) || node->element == CS_SVG_ELEMENT_TEXT;
}

static celspan_status outline_object(cs_svg_reading *reading, const cs_svg_node *node,
                                     const cs_svg_place *place, celspan_rule rule,
                                     celspan_object **out) {
  cs_outline outline;
  bool is_broken;
  celspan_object *object;
  cs_outline_init(&outline);
  celspan_status status =
      node->element == CS_SVG_ELEMENT_TEXT
          ? cs_svg_text_outline(reading, node, place, &outline)
          : cs_svg_shape_outline(reading->context, node, &place->measure, &outline, &is_broken);
  if (status != CELSPAN_OK) {
    cs_outline_finish(&outline, reading->context->memory);
    return status;
  }
  CS_TRY(cs_primitive_data_of_outline(reading->context, &outline, rule, NULL, &object));
  return moved(reading->context, object, &place->matrix, out);
}

/* ---------------------------------------------------------------- children of clip paths */

static celspan_status clip_by_own(cs_svg_reading *reading, const cs_svg_node *node,
                                  const cs_svg_place *place, celspan_object **object) {
  celspan_object *clip;
  bool is_clip;
  if (!place->style.has_clip_path || !*object)
    return CELSPAN_OK;
  celspan_object *given_up = *object;
  celspan_status status = cs_svg_clip_make(reading, node, place, &clip, &is_clip);
  if (status != CELSPAN_OK || !is_clip)
    return status;
  *object = NULL;
  return cs_svg_intersect(reading, given_up, clip, object);
}

/* Only a shape or a text may be used through `use`. */
static celspan_status used_object(cs_svg_reading *reading, const cs_svg_node *node,
                                  const cs_svg_place *place, bool uses_fill_rule,
                                  celspan_object **out) {
  const cs_svg_node *used = cs_svg_linked(reading, node);
  cs_svg_style style;
  double x, y;
  if (!used || !has_outline(used))
    return CELSPAN_OK;
  CS_TRY(cs_svg_number_of(reading->context, node, CS_SVG_X, CS_SVG_AXIS_X, &place->measure, &x));
  CS_TRY(cs_svg_number_of(reading->context, node, CS_SVG_Y, CS_SVG_AXIS_Y, &place->measure, &y));
  cs_svg_place inner = *place;
  inner.matrix = celspan_matrix_then(celspan_matrix_translation(x, y), inner.matrix);
  return cs_svg_shape_object(reading, used, inner, uses_fill_rule, out, &style);
}

celspan_status cs_svg_shape_object(cs_svg_reading *reading, const cs_svg_node *node,
                                   cs_svg_place place, bool uses_fill_rule, celspan_object **out,
                                   cs_svg_style *style) {
  *out = NULL;
  CS_TRY(cs_svg_count_drawn(reading, node));
  CS_TRY(cs_svg_enter(reading, node, &place));
  *style = place.style;
  if (!place.style.is_displayed)
    return CELSPAN_OK;
  if (node->element == CS_SVG_ELEMENT_USE)
    CS_TRY(used_object(reading, node, &place, uses_fill_rule, out));
  else if (has_outline(node) && place.style.is_visible)
    CS_TRY(outline_object(reading, node, &place,
                          uses_fill_rule ? place.style.fill_rule : place.style.clip_rule, out));
  celspan_status status = clip_by_own(reading, node, &place, out);
  if (status != CELSPAN_OK) {
    celspan_object_unref(*out);
    *out = NULL;
  }
  return status;
}

/* ---------------------------------------------------------------- basic shapes */

/* A clip path that is written as circle(), ellipse(), inset() or polygon(), while it is read.
 * Lengths and shares refer to the element's box without its stroke. Source: CSS Shapes Module Level
 * 1, 3.1. */
typedef struct drafting {
  celspan_context *context;
  const char *text;
  cs_svg_measure measure; /* the viewport is the box */
  celspan_box box;
  cs_outline *outline;
  celspan_rule rule;
  bool is_fit;
} drafting;

static bool take_sign(drafting *d, char sign) {
  const char *at = cs_svg_skip_space(d->text);
  if (*at != sign)
    return false;
  d->text = at + 1;
  return true;
}

static bool take_length(drafting *d, cs_svg_axis axis, double *out) {
  cs_svg_length length;
  d->text = cs_svg_skip_space(d->text);
  if (!cs_svg_take_length(&d->text, &length))
    return false;
  *out = cs_svg_resolve(length, axis, &d->measure);
  return cs_number_is_sane(*out);
}

/* `at` and the centre; without it, the middle of the box. */
static bool take_centre(drafting *d, celspan_point *out) {
  double x = 0.5 * d->box.width, y = 0.5 * d->box.height;
  d->text = cs_svg_skip_space(d->text);
  if (cs_svg_take_word(&d->text, "at") &&
      (!take_length(d, CS_SVG_AXIS_X, &x) || !take_length(d, CS_SVG_AXIS_Y, &y)))
    return false;
  *out = (celspan_point){d->box.x + x, d->box.y + y};
  return true;
}

/* circle(r at x y), ellipse(rx ry at x y): a missing radius extends to the closest side. */
static celspan_status add_round(drafting *d, bool is_circle) {
  celspan_point centre;
  double rx = -1, ry = -1;
  bool has_radius = take_length(d, is_circle ? CS_SVG_AXIS_BOTH : CS_SVG_AXIS_X, &rx);
  if (has_radius && !is_circle)
    d->is_fit = take_length(d, CS_SVG_AXIS_Y, &ry);
  d->is_fit = d->is_fit && take_centre(d, &centre) && (!has_radius || rx >= 0);
  if (!d->is_fit)
    return CELSPAN_OK;
  if (!has_radius) {
    rx = fmin(centre.x - d->box.x, d->box.x + d->box.width - centre.x);
    ry = fmin(centre.y - d->box.y, d->box.y + d->box.height - centre.y);
    rx = is_circle ? fmin(rx, ry) : rx;
  }
  ry = is_circle ? rx : ry;
  return rx > 0 && ry > 0 ? cs_outline_ellipse(d->context, d->outline, centre, rx, ry) : CELSPAN_OK;
}

/* inset(top right bottom left): a missing side equals the opposite side, or the top. */
static celspan_status add_inset(drafting *d) {
  double inset[4];
  int count = 0;
  while (count < 4 && take_length(d, count % 2 ? CS_SVG_AXIS_X : CS_SVG_AXIS_Y, &inset[count]))
    count++;
  d->is_fit = count > 0;
  if (!d->is_fit)
    return CELSPAN_OK;
  if (count == 1) /* a single length refers to either side */
    inset[1] = inset[0];
  for (int i = count > 2 ? count : 2; i < 4; i++)
    inset[i] = inset[i - 2];
  double width = d->box.width - inset[1] - inset[3], height = d->box.height - inset[0] - inset[2];
  return width > 0 && height > 0 ? cs_outline_rect(d->context, d->outline, d->box.x + inset[3],
                                                   d->box.y + inset[0], width, height, 0)
                                 : CELSPAN_OK;
}

/* polygon(evenodd, x y, x y, ...) */
static celspan_status add_polygon(drafting *d) {
  bool is_first = true, has_rule;
  d->text = cs_svg_skip_space(d->text);
  if (cs_svg_take_word(&d->text, "evenodd"))
    d->rule = CELSPAN_RULE_EVENODD;
  has_rule = d->rule == CELSPAN_RULE_EVENODD || cs_svg_take_word(&d->text, "nonzero");
  if (has_rule)
    d->is_fit = take_sign(d, ',');
  while (d->is_fit && (is_first || take_sign(d, ','))) {
    cs_hpoint point = {0, 0, 1};
    d->is_fit = take_length(d, CS_SVG_AXIS_X, &point.x) && take_length(d, CS_SVG_AXIS_Y, &point.y);
    point.x += d->box.x;
    point.y += d->box.y;
    if (d->is_fit)
      CS_TRY(is_first ? cs_outline_move(d->context, d->outline, point)
                      : cs_outline_line(d->context, d->outline, point));
    is_first = false;
  }
  return cs_outline_close(d->context, d->outline);
}

static celspan_status add_shape(drafting *d) {
  d->text = cs_svg_skip_space(d->text);
  bool is_circle = cs_svg_take_word(&d->text, "circle");
  bool is_ellipse = !is_circle && cs_svg_take_word(&d->text, "ellipse");
  bool is_inset = cs_svg_take_word(&d->text, "inset");
  bool is_polygon = cs_svg_take_word(&d->text, "polygon");
  d->is_fit = (is_circle || is_ellipse || is_inset || is_polygon) && take_sign(d, '(');
  if (!d->is_fit)
    return CELSPAN_OK;
  CS_TRY(is_inset ? add_inset(d) : is_polygon ? add_polygon(d) : add_round(d, is_circle));
  d->is_fit = d->is_fit && take_sign(d, ')') && !*cs_svg_skip_space(d->text);
  return CELSPAN_OK;
}

/* The object of an outline. The object owns the outline from now on. */
static celspan_status place_shape(drafting *d, const cs_svg_place *place, celspan_object **out) {
  celspan_object *object;
  CS_TRY(cs_primitive_data_of_outline(d->context, d->outline, d->rule, NULL, &object));
  celspan_status status = celspan_object_transform(d->context, object, &place->matrix, out);
  celspan_object_unref(object);
  return status;
}

/* The shape that `text` describes, for an element at `place`. *out: new, in the drawing's units;
 * NULL: everything is cut away. *is_shape: false if text is not such a shape. */
static celspan_status make_basic_shape(cs_svg_reading *reading, const cs_svg_node *node,
                                       const cs_svg_place *place, const char *text,
                                       celspan_object **out, bool *is_shape) {
  cs_outline outline;
  cs_svg_place own = *place;
  bool is_there = false;
  drafting d = {.context = reading->context, .text = text, .measure = place->measure};
  own.matrix = celspan_matrix_identity();
  *out = NULL;
  CS_TRY(cs_svg_box_of(reading, node, &own, &d.box, &is_there));
  d.measure.width = d.box.width;
  d.measure.height = d.box.height;
  d.outline = &outline;
  cs_outline_init(&outline);
  celspan_status status = add_shape(&d);
  *is_shape = d.is_fit;
  if (status == CELSPAN_OK && d.is_fit && is_there && outline.piece_count > 0)
    return place_shape(&d, place, out);
  cs_outline_finish(&outline, reading->context->memory);
  return status;
}

/* ---------------------------------------------------------------- clip paths */

/* Unites the children of a clip path at `place`. *out: new; NULL if there are none. */
static celspan_status unite_children(cs_svg_reading *reading, const cs_svg_node *clip,
                                     const cs_svg_place *place, celspan_object **out) {
  celspan_object **objects = NULL;
  size_t count = 0, capacity = 0;
  celspan_status status = CELSPAN_OK;
  for (const cs_svg_node *child = clip->first; child && status == CELSPAN_OK; child = child->next) {
    cs_svg_style style;
    status = CS_RESERVE(reading->context, objects, capacity, count + 1);
    if (status == CELSPAN_OK)
      status = cs_svg_shape_object(reading, child, *place, false, &objects[count], &style);
    count += status == CELSPAN_OK && objects[count];
  }
  if (status == CELSPAN_OK && count > 0)
    status = celspan_object_create_boolean(reading->context, CELSPAN_OPERATOR_UNION, objects, count,
                                           out);
  for (size_t i = 0; i < count; i++)
    celspan_object_unref(objects[i]);
  cs_mem_free(reading->context->memory, objects, capacity * sizeof(celspan_object *));
  return status;
}

/* The units of the clip path's content; its transform is already in *place. *is_sized: false if the
 * units are shares of a box without a size. */
static celspan_status find_units(cs_svg_reading *reading, const cs_svg_node *node,
                                 const cs_svg_node *clip, const cs_svg_place *element,
                                 cs_svg_place *place, bool *is_sized) {
  cs_svg_place own = *element;
  celspan_box box = {0, 0, 0, 0};
  bool is_there = false;
  *is_sized = true;
  if (!cs_svg_node_says(clip, CS_SVG_CLIP_PATH_UNITS, "objectBoundingBox"))
    return CELSPAN_OK;
  own.matrix = celspan_matrix_identity();
  CS_TRY(cs_svg_box_of(reading, node, &own, &box, &is_there));
  *is_sized = is_there && box.width > 0 && box.height > 0;
  place->matrix = celspan_matrix_then(cs_svg_box_matrix(&box), place->matrix);
  place->measure.width = place->measure.height = 1;
  return CELSPAN_OK;
}

static celspan_status make_clip(cs_svg_reading *reading, const cs_svg_node *node,
                                const cs_svg_node *clip, const cs_svg_place *element,
                                celspan_object **out) {
  const cs_svg_open open = {clip, element->open};
  cs_svg_place place = *element;
  bool is_sized;
  place.open = &open;
  if (clip->parent)
    CS_TRY(cs_svg_style_in_file(reading, clip->parent, &place.style));
  cs_svg_place outer = place;
  CS_TRY(cs_svg_enter(reading, clip, &place));
  CS_TRY(find_units(reading, node, clip, element, &place, &is_sized));
  celspan_matrix ignored;
  bool is_regular = !place.style.transform ||
                    (cs_svg_parse_transform(place.style.transform, &place.measure, &ignored) &&
                     celspan_matrix_inverse(ignored, &ignored));
  if (!is_sized || !is_regular)
    return CELSPAN_OK;
  CS_TRY(unite_children(reading, clip, &place, out));
  outer.style = place.style; /* its own clip path uses the element's units */
  outer.matrix = element->matrix;
  outer.measure = element->measure;
  celspan_status status = clip_by_own(reading, node, &outer, out);
  if (status != CELSPAN_OK) {
    celspan_object_unref(*out);
    *out = NULL;
  }
  return status;
}

static celspan_status make_shape(cs_svg_reading *reading, const cs_svg_node *node,
                                 const cs_svg_place *place, celspan_object **out, bool *is_clip) {
  const char *text = place->style.clip_shape;
  CS_TRY(make_basic_shape(reading, node, place, text, out, is_clip));
  return *is_clip ? CELSPAN_OK : cs_svg_skip(reading, node, "clip-path \"%.30s\"", text);
}

celspan_status cs_svg_clip_make(cs_svg_reading *reading, const cs_svg_node *node,
                                const cs_svg_place *place, celspan_object **out, bool *is_clip) {
  if (place->style.clip_shape)
    return make_shape(reading, node, place, out, is_clip);
  const cs_svg_node *clip = cs_svg_referred(reading, place->style.clip_path);
  *out = NULL;
  *is_clip = clip && clip->element == CS_SVG_ELEMENT_CLIP_PATH;
  if (!*is_clip)
    return place->style.clip_path.size > 0
               ? cs_svg_skip(
                     reading, node, "clip-path \"%.*s\", which is not in the file",
                     (int)(place->style.clip_path.size < 30 ? place->style.clip_path.size : 30),
                     place->style.clip_path.id)
               : CELSPAN_OK;
  *is_clip = !cs_svg_is_open(place->open, clip);
  if (!*is_clip)
    return cs_svg_skip(reading, clip, "clipPath that clips itself");
  if (++reading->depth > CS_SVG_DEPTH)
    return cs_fail(reading->context, CELSPAN_LIMIT,
                   "line %u: clip paths refer to one another more than %d deep", clip->line,
                   CS_SVG_DEPTH);
  CS_TRY(make_clip(reading, node, clip, place, out));
  reading->depth--;
  return CELSPAN_OK;
}
