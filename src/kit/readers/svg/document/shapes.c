#include "readers/svg/document/shapes.h"

#include <math.h>

#include "inside/number.h"

static celspan_status unfit(celspan_context *context, const cs_svg_node *node, cs_svg_name name,
                            const char *value) {
  return cs_fail(context, CELSPAN_INPUT,
                 "line %u: %s is \"%.40s\"; it must be a finite number within 1e12", node->line,
                 cs_svg_name_text(name), value);
}

celspan_status cs_svg_length_of(celspan_context *context, const cs_svg_node *node, cs_svg_name name,
                                cs_svg_axis axis, const cs_svg_measure *measure,
                                cs_svg_length fallback, double *out) {
  const char *value = cs_svg_node_value(node, name);
  cs_svg_length length;
  if (!value || !cs_svg_parse_length(value, &length)) {
    if (value && cs_svg_is_unfit(value))
      return unfit(context, node, name, value);
    length = fallback;
  }
  double resolved = cs_svg_resolve(length, axis, measure);
  if (!cs_number_is_sane(resolved))
    return unfit(context, node, name, value ? value : "");
  *out = resolved;
  return CELSPAN_OK;
}

celspan_status cs_svg_number_of(celspan_context *context, const cs_svg_node *node, cs_svg_name name,
                                cs_svg_axis axis, const cs_svg_measure *measure, double *out) {
  return cs_svg_length_of(context, node, name, axis, measure,
                          (cs_svg_length){0, CS_SVG_UNIT_NUMBER}, out);
}

/* Source: SVG 2, 11.6.2. */
celspan_status cs_svg_reference_of(celspan_context *context, const cs_svg_node *node,
                                   cs_svg_axis axis, const cs_svg_measure *measure, double from,
                                   double *out) {
  static const char *const words[2][3] = {{"left", "center", "right"}, {"top", "center", "bottom"}};
  bool is_x = axis == CS_SVG_AXIS_X;
  cs_svg_name name = is_x ? CS_SVG_REF_X : CS_SVG_REF_Y;
  const char *value = cs_svg_node_value(node, name);
  for (int i = 0; i < 3 && value; i++)
    if (cs_svg_is_word(value, words[!is_x][i])) {
      *out = from + 0.5 * i * (is_x ? measure->width : measure->height);
      return CELSPAN_OK;
    }
  return cs_svg_number_of(context, node, name, axis, measure, out);
}

/* ---------------------------------------------------------------- rectangles and ellipses */

/* rx and ry: if only one is given, both are equal; a negative value counts as not given. */
static celspan_status read_radii(celspan_context *context, const cs_svg_node *node,
                                 const cs_svg_measure *measure, double *rx, double *ry) {
  const cs_svg_length none = {-1, CS_SVG_UNIT_NUMBER};
  CS_TRY(cs_svg_length_of(context, node, CS_SVG_RX, CS_SVG_AXIS_X, measure, none, rx));
  CS_TRY(cs_svg_length_of(context, node, CS_SVG_RY, CS_SVG_AXIS_Y, measure, none, ry));
  if (*rx < 0)
    *rx = *ry;
  if (*ry < 0)
    *ry = *rx;
  return CELSPAN_OK;
}

static celspan_status add_rect(celspan_context *context, const cs_svg_node *node,
                               const cs_svg_measure *measure, cs_outline *outline) {
  celspan_box box;
  double rx, ry;
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_X, CS_SVG_AXIS_X, measure, &box.x));
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_Y, CS_SVG_AXIS_Y, measure, &box.y));
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_WIDTH, CS_SVG_AXIS_X, measure, &box.width));
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_HEIGHT, CS_SVG_AXIS_Y, measure, &box.height));
  CS_TRY(read_radii(context, node, measure, &rx, &ry));
  if (!(box.width > 0) || !(box.height > 0))
    return CELSPAN_OK;
  rx = fmin(rx, box.width / 2);
  ry = fmin(ry, box.height / 2);
  if (rx > 0 && ry > 0)
    return cs_outline_rounded(context, outline, &box, rx, ry);
  return cs_outline_rect(context, outline, box.x, box.y, box.width, box.height, 0);
}

static celspan_status add_ellipse(celspan_context *context, const cs_svg_node *node,
                                  const cs_svg_measure *measure, cs_outline *outline) {
  celspan_point centre;
  double rx, ry;
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_CX, CS_SVG_AXIS_X, measure, &centre.x));
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_CY, CS_SVG_AXIS_Y, measure, &centre.y));
  if (node->element == CS_SVG_ELEMENT_CIRCLE) {
    CS_TRY(cs_svg_number_of(context, node, CS_SVG_R, CS_SVG_AXIS_BOTH, measure, &rx));
    ry = rx;
  } else {
    CS_TRY(read_radii(context, node, measure, &rx, &ry));
  }
  if (!(rx > 0) || !(ry > 0))
    return CELSPAN_OK;
  return cs_outline_ellipse(context, outline, centre, rx, ry);
}

/* ---------------------------------------------------------------- points and paths */

/* Reads a point of a list at *at, and moves *at to the end of the point. */
static celspan_status take_point(celspan_context *context, const cs_svg_node *node, const char **at,
                                 cs_hpoint *point, bool *is_broken) {
  const char *begin = *at;
  *point = (cs_hpoint){0, 0, 1};
  *is_broken = !cs_svg_take_number(at, &point->x);
  *at = cs_svg_skip_comma(*at);
  *is_broken = *is_broken || !cs_svg_take_number(at, &point->y);
  if (*is_broken && cs_svg_is_unfit(begin))
    return unfit(context, node, CS_SVG_POINTS, begin);
  *at = cs_svg_skip_comma(*at);
  return CELSPAN_OK;
}

/* Lines from point to point; nothing for a single point. */
static celspan_status add_points(celspan_context *context, const cs_svg_node *node,
                                 cs_outline *outline, bool *is_broken) {
  const char *at = cs_svg_node_value(node, CS_SVG_POINTS);
  cs_hpoint first, point;
  size_t count = 0;
  for (at = cs_svg_skip_space(at ? at : ""); *at; count++) {
    CS_TRY(take_point(context, node, &at, &point, is_broken));
    if (*is_broken)
      break;
    if (count == 0)
      first = point;
    if (count == 1)
      CS_TRY(cs_outline_begin(context, outline, first));
    if (count > 0)
      CS_TRY(cs_outline_piece(context, outline, 1, &point));
  }
  return CELSPAN_OK;
}

static celspan_status add_polygon(celspan_context *context, const cs_svg_node *node,
                                  cs_outline *outline, bool *is_broken) {
  CS_TRY(add_points(context, node, outline, is_broken));
  return outline->piece_count > 0 ? cs_outline_close(context, outline) : CELSPAN_OK;
}

/* A path with an error in its data is drawn up to the error. Source: SVG 2, 9.5.4. */
static celspan_status add_path(celspan_context *context, const cs_svg_node *node,
                               cs_outline *outline, bool *is_broken) {
  const char *data = cs_svg_node_value(node, CS_SVG_D);
  if (!data || cs_svg_is_word(data, "none"))
    return CELSPAN_OK;
  celspan_status status = cs_outline_path(context, outline, data);
  if (status != CELSPAN_BAD_ARGUMENT)
    return status;
  *is_broken = true;
  return cs_outline_close(context, outline);
}

bool cs_svg_is_shape(const cs_svg_node *node) {
  switch (node->element) {
  case CS_SVG_ELEMENT_CIRCLE:
  case CS_SVG_ELEMENT_ELLIPSE:
  case CS_SVG_ELEMENT_LINE:
  case CS_SVG_ELEMENT_PATH:
  case CS_SVG_ELEMENT_POLYGON:
  case CS_SVG_ELEMENT_POLYLINE:
  case CS_SVG_ELEMENT_RECT:
    return true;
  default:
    return false;
  }
}

celspan_status cs_svg_shape_outline(celspan_context *context, const cs_svg_node *node,
                                    const cs_svg_measure *measure, cs_outline *outline,
                                    bool *is_broken) {
  *is_broken = false;
  switch (node->element) {
  case CS_SVG_ELEMENT_RECT:
    return add_rect(context, node, measure, outline);
  case CS_SVG_ELEMENT_CIRCLE:
  case CS_SVG_ELEMENT_ELLIPSE:
    return add_ellipse(context, node, measure, outline);
  case CS_SVG_ELEMENT_POLYGON:
  case CS_SVG_ELEMENT_POLYLINE:
    return add_polygon(context, node, outline, is_broken);
  case CS_SVG_ELEMENT_PATH:
    return add_path(context, node, outline, is_broken);
  default: /* a line has no inside */
    return CELSPAN_OK;
  }
}

/* ---------------------------------------------------------------- lines */

static celspan_status add_line(celspan_context *context, const cs_svg_node *node,
                               const cs_svg_measure *measure, cs_outline *outline) {
  cs_hpoint from = {0, 0, 1}, to = {0, 0, 1};
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_X1, CS_SVG_AXIS_X, measure, &from.x));
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_Y1, CS_SVG_AXIS_Y, measure, &from.y));
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_X2, CS_SVG_AXIS_X, measure, &to.x));
  CS_TRY(cs_svg_number_of(context, node, CS_SVG_Y2, CS_SVG_AXIS_Y, measure, &to.y));
  CS_TRY(cs_outline_begin(context, outline, from));
  return cs_outline_piece(context, outline, 1, &to);
}

static celspan_status add_path_line(celspan_context *context, const cs_svg_node *node,
                                    cs_svg_line *line) {
  const char *data = cs_svg_node_value(node, CS_SVG_D);
  if (!data || cs_svg_is_word(data, "none"))
    return CELSPAN_OK;
  celspan_status status = cs_outline_path_open(context, &line->outline, &line->closed, data);
  line->is_broken = status == CELSPAN_BAD_ARGUMENT;
  return line->is_broken ? CELSPAN_OK : status;
}

celspan_status cs_svg_line_init(celspan_context *context, const cs_svg_node *node,
                                const cs_svg_measure *measure, cs_svg_line *line) {
  *line = (cs_svg_line){.is_broken = false};
  cs_outline_init(&line->outline);
  switch (node->element) {
  case CS_SVG_ELEMENT_LINE:
    return add_line(context, node, measure, &line->outline);
  case CS_SVG_ELEMENT_POLYLINE:
    return add_points(context, node, &line->outline, &line->is_broken);
  case CS_SVG_ELEMENT_PATH:
    return add_path_line(context, node, line);
  default:
    CS_TRY(cs_svg_shape_outline(context, node, measure, &line->outline, &line->is_broken));
    for (size_t i = 0; i < line->outline.contour_count; i++)
      CS_TRY(cs_outline_closed_add(context, &line->closed, i));
    return CELSPAN_OK;
  }
}

void cs_svg_line_finish(cs_svg_line *line, celspan_context *context) {
  cs_outline_finish(&line->outline, context->memory);
  cs_outline_closed_finish(&line->closed, context->memory);
}

bool cs_svg_outline_map(cs_outline *outline, const celspan_matrix *matrix) {
  const double *m = matrix->m;
  for (size_t i = 0; i < outline->point_count; i++) {
    const cs_hpoint p = outline->points[i];
    cs_hpoint *to = &outline->points[i];
    to->x = m[0] * p.x + m[1] * p.y + m[2] * p.w;
    to->y = m[3] * p.x + m[4] * p.y + m[5] * p.w;
    if (!cs_number_is_sane(to->x) || !cs_number_is_sane(to->y))
      return false;
  }
  return true;
}

/* ---------------------------------------------------------------- rectangles */

celspan_box cs_svg_box_mapped(const celspan_box *box, const celspan_matrix *matrix) {
  const double *m = matrix->m;
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL;
  for (int i = 0; i < 4; i++) {
    double x = box->x + (i & 1) * box->width, y = box->y + (i >> 1) * box->height;
    double to_x = m[0] * x + m[1] * y + m[2], to_y = m[3] * x + m[4] * y + m[5];
    left = fmin(left, to_x);
    right = fmax(right, to_x);
    top = fmin(top, to_y);
    bottom = fmax(bottom, to_y);
  }
  return (celspan_box){left, top, right - left, bottom - top};
}

celspan_matrix cs_svg_box_matrix(const celspan_box *box) {
  return (celspan_matrix){{box->width, 0, box->x, 0, box->height, box->y, 0, 0, 1}};
}

celspan_status cs_svg_rectangle(celspan_context *context, const celspan_box *box,
                                const celspan_matrix *matrix, celspan_object **out) {
  const celspan_rect_desc desc = {sizeof desc, box->x, box->y, box->width, box->height, 0, NULL};
  celspan_object *object;
  CS_TRY(celspan_object_create_rect(context, &desc, &object));
  celspan_status status = celspan_object_transform(context, object, matrix, out);
  celspan_object_unref(object);
  return status;
}
