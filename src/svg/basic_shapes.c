#include "svg/basic_shapes.h"

#include <math.h>

#include "base/number.h"
#include "scene/primitive_data.h"
#include "svg/boxes.h"
#include "svg/shapes.h"

/* What is being read. */
typedef struct drafting {
  celspan_context *context;
  const char *text;
  cs_svg_measure measure; /* whose viewport is the box */
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

/* `at` and the centre; the middle of the box without it. */
static bool take_centre(drafting *d, celspan_point *out) {
  double x = 0.5 * d->box.width, y = 0.5 * d->box.height;
  d->text = cs_svg_skip_space(d->text);
  if (cs_svg_take_word(&d->text, "at") &&
      (!take_length(d, CS_SVG_AXIS_X, &x) || !take_length(d, CS_SVG_AXIS_Y, &y)))
    return false;
  *out = (celspan_point){d->box.x + x, d->box.y + y};
  return true;
}

/* circle(r at x y), ellipse(rx ry at x y): radii that are not given reach to the closest side. */
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

/* inset(top right bottom left): those left out are the ones across, or the top. */
static celspan_status add_inset(drafting *d) {
  double inset[4];
  int count = 0;
  while (count < 4 && take_length(d, count % 2 ? CS_SVG_AXIS_X : CS_SVG_AXIS_Y, &inset[count]))
    count++;
  d->is_fit = count > 0;
  if (!d->is_fit)
    return CELSPAN_OK;
  if (count == 1) /* the shares of one length are of either side */
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

/* The object of an outline, which is taken over. */
static celspan_status place_shape(drafting *d, const cs_svg_place *place, celspan_object **out) {
  celspan_object *object;
  CS_TRY(cs_primitive_data_of_outline(d->context, d->outline, d->rule, NULL, &object));
  celspan_status status = celspan_object_transform(d->context, object, &place->matrix, out);
  celspan_object_unref(object);
  return status;
}

celspan_status cs_svg_basic_shape(cs_svg_reading *reading, const cs_svg_node *node,
                                  const cs_svg_place *place, const char *text, celspan_object **out,
                                  bool *is_shape) {
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
