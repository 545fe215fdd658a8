#include "readers/svg/draw/strokes.h"

#include <math.h>

#include "inside/geometry.h"
#include "inside/number.h"
#include "inside/scene.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/draw/servers.h"

/* A stroke that is being made. */
typedef struct stroking {
  cs_svg_reading *reading;
  const cs_svg_node *node;
  const cs_svg_place *place;
  cs_outline *outline;             /* in the units of the stroke */
  const cs_outline_closed *closed; /* the closed contours; NULL: all */
  celspan_matrix to_page;          /* from these units to the drawing's */
  celspan_stroke_desc desc;
  double *dashes;
  size_t dash_capacity;
} stroking;

bool cs_svg_is_stroked(const cs_svg_style *style) {
  return (style->stroke.kind != CS_SVG_PAINT_NONE || style->stroke.has_server) &&
         style->stroke_width.value > 0 && style->stroke_opacity > 0;
}

/* ---------------------------------------------------------------- dashes */

/* Appends the lengths of the list; *is_fit: false unless it is a list of lengths that can be
 * drawn. */
static celspan_status take_dashes(stroking *p, const char *text, double unit, bool *is_fit) {
  double sum = 0;
  cs_svg_length length;
  for (text = cs_svg_skip_space(text); *text; text = cs_svg_skip_comma(text)) {
    *is_fit = cs_svg_take_length(&text, &length) && length.value >= 0;
    if (!*is_fit)
      return CELSPAN_OK;
    CS_TRY(CS_RESERVE(p->reading->context, p->dashes, p->dash_capacity, p->desc.dash_count + 1));
    double dash = unit * cs_svg_resolve(length, CS_SVG_AXIS_BOTH, &p->place->measure);
    p->dashes[p->desc.dash_count++] = dash;
    sum += dash;
  }
  *is_fit = sum > 0 && cs_number_is_sane(sum);
  return CELSPAN_OK;
}

/* The number of units in one unit of dash lengths: the element may define the length of its
 * line. */
static celspan_status dash_unit(stroking *p, double *out) {
  double declared, length = 0;
  *out = 1;
  CS_TRY(cs_svg_number_of(p->reading->context, p->node, CS_SVG_PATH_LENGTH, CS_SVG_AXIS_BOTH,
                          &p->place->measure, &declared));
  if (declared < 0 || !cs_svg_node_value(p->node, CS_SVG_PATH_LENGTH))
    return CELSPAN_OK;
  for (size_t i = 0; i < p->outline->piece_count; i++) {
    cs_bezier piece;
    cs_curve_load_line(p->outline, i, 0, 1, &piece);
    length += cs_curve_length(&piece, 0, 1);
  }
  *out = declared > 0 ? length / declared : 0;
  return CELSPAN_OK;
}

static celspan_status read_dashes(stroking *p) {
  const cs_svg_style *style = &p->place->style;
  bool is_fit = false;
  double unit = 1;
  if (style->dashes) {
    CS_TRY(dash_unit(p, &unit));
    CS_TRY(take_dashes(p, style->dashes, unit, &is_fit));
  }
  if (!is_fit) {
    p->desc.dash_count = 0;
    return CELSPAN_OK;
  }
  double offset = unit * cs_svg_resolve(style->dash_offset, CS_SVG_AXIS_BOTH, &p->place->measure);
  p->desc.dashes = p->dashes;
  p->desc.dash_offset = cs_number_is_sane(offset) ? offset : 0;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the stroke */

static celspan_status read_desc(stroking *p) {
  const cs_svg_style *style = &p->place->style;
  p->desc = CELSPAN_STROKE_DESC;
  p->desc.width = cs_svg_resolve(style->stroke_width, CS_SVG_AXIS_BOTH, &p->place->measure);
  p->desc.cap = style->cap;
  p->desc.join = style->join;
  p->desc.miter = fmin(style->miter, 1e6);
  return read_dashes(p);
}

/* The stroke in the drawing's units. If there are too many dashes, a solid line is drawn. */
static celspan_status make_stroke(stroking *p, celspan_texture *texture, celspan_object **out) {
  celspan_context *context = p->reading->context;
  celspan_object *object;
  p->desc.texture = texture;
  celspan_status status =
      cs_primitive_data_of_line(context, p->outline, p->closed, &p->desc, &object);
  if (status == CELSPAN_LIMIT && p->desc.dash_count > 0) {
    CS_TRY(cs_svg_skip(p->reading, p->node, "stroke-dasharray of %.30s", p->node->tag));
    p->desc.dashes = NULL;
    p->desc.dash_count = 0;
    status = cs_primitive_data_of_line(context, p->outline, p->closed, &p->desc, &object);
  }
  CS_TRY(status);
  status = celspan_object_transform(context, object, &p->to_page, out);
  celspan_object_unref(object);
  return status;
}

/* A rectangle that covers `box` of the drawing, made in the gradient's units and moved there. *out:
 * NULL if its numbers would be too large. */
static celspan_status cover(stroking *p, const cs_svg_server *server, const celspan_box *box,
                            celspan_object **out) {
  celspan_context *context = p->reading->context;
  celspan_matrix whole = celspan_matrix_then(server->matrix, p->place->matrix), inverse;
  celspan_object *object;
  *out = NULL;
  if (!celspan_matrix_inverse(whole, &inverse))
    return CELSPAN_OK;
  celspan_box area = cs_svg_box_mapped(box, &inverse);
  if (!cs_number_is_sane(area.x) || !cs_number_is_sane(area.y) ||
      !cs_number_is_sane(area.x + area.width) || !cs_number_is_sane(area.y + area.height))
    return CELSPAN_OK;
  const celspan_rect_desc desc = {sizeof desc, area.x, area.y,         area.width,
                                  area.height, 0,      server->texture};
  CS_TRY(celspan_object_create_rect(context, &desc, &object));
  celspan_status status = celspan_object_transform(context, object, &whole, out);
  celspan_object_unref(object);
  return status;
}

static celspan_status clip_cover(stroking *p, const cs_svg_server *server, celspan_object *stroke,
                                 const celspan_box *box, celspan_object **out) {
  celspan_object *both[2] = {NULL, stroke};
  CS_TRY(cover(p, server, box, &both[0]));
  celspan_status status =
      both[0]
          ? celspan_object_create_boolean(p->reading->context, CELSPAN_OPERATOR_CLIP, both, 2, out)
          : CELSPAN_OK;
  celspan_object_unref(both[0]);
  return status;
}

/* ---------------------------------------------------------------- paint */

/* Makes the stroke a shape, because a gradient may be spread over the box of this shape. */
static celspan_status paint_by_server(stroking *p, const celspan_box *outline_box,
                                      celspan_object **out) {
  const cs_svg_style *style = &p->place->style;
  cs_svg_painted shape = {p->node,       &p->place->measure,    *outline_box,
                          {.x = 0},      style->stroke_opacity, &p->place->matrix,
                          p->place->open};
  cs_svg_server server;
  celspan_object *stroke;
  celspan_matrix inverse;
  celspan_box box;
  bool is_there;
  CS_TRY(make_stroke(p, NULL, &stroke));
  celspan_status status = cs_bounds_object(p->reading->context, stroke, &is_there, &box);
  if (status == CELSPAN_OK && is_there && celspan_matrix_inverse(p->place->matrix, &inverse)) {
    shape.painted = cs_svg_box_mapped(&box, &inverse);
    status = cs_svg_server_find(p->reading, &style->stroke, style, &shape, &server);
    if (status == CELSPAN_OK && server.kind == CS_SVG_SERVER_FLAT)
      status = make_stroke(p, server.texture, out);
    else if (status == CELSPAN_OK && server.kind == CS_SVG_SERVER_TEXTURE)
      status = clip_cover(p, &server, stroke, &box, out);
    celspan_texture_unref(server.texture);
  }
  celspan_object_unref(stroke);
  return status;
}

static celspan_status paint_flat(stroking *p, celspan_object **out) {
  const cs_svg_style *style = &p->place->style;
  const cs_svg_painted shape = {p->node,       &p->place->measure,    {.x = 0},
                                {.x = 0},      style->stroke_opacity, &p->place->matrix,
                                p->place->open};
  cs_svg_server server;
  CS_TRY(cs_svg_server_find(p->reading, &style->stroke, style, &shape, &server));
  celspan_status status =
      server.kind == CS_SVG_SERVER_FLAT ? make_stroke(p, server.texture, out) : CELSPAN_OK;
  celspan_texture_unref(server.texture);
  return status;
}

/* box: gradients in shares of a box are spread over this box; NULL: the box of the outline. */
static celspan_status draw(stroking *p, const celspan_box *given, celspan_object **out) {
  const celspan_matrix identity = celspan_matrix_identity();
  celspan_box box;
  if (p->outline->piece_count == 0 || !cs_outline_bounds(p->outline, &identity, &box))
    return CELSPAN_OK;
  CS_TRY(read_desc(p));
  p->to_page = p->place->matrix;
  if (p->place->style.keeps_width) {
    if (!cs_svg_outline_map(p->outline, &p->to_page))
      return CELSPAN_OK;
    p->to_page = identity;
  }
  if (!(p->desc.width > 0) || !cs_number_is_sane(p->desc.width))
    return CELSPAN_OK;
  return p->place->style.stroke.has_server ? paint_by_server(p, given ? given : &box, out)
                                           : paint_flat(p, out);
}

static celspan_status draw_and_finish(stroking *p, const celspan_box *box, celspan_object **out) {
  *out = NULL;
  celspan_status status = draw(p, box, out);
  cs_mem_free(p->reading->context->memory, p->dashes, p->dash_capacity * sizeof *p->dashes);
  return status;
}

celspan_status cs_svg_stroke(cs_svg_reading *reading, const cs_svg_node *node,
                             const cs_svg_place *place, celspan_object **out) {
  cs_svg_line line;
  stroking p = {.reading = reading,
                .node = node,
                .place = place,
                .outline = &line.outline,
                .closed = &line.closed};
  *out = NULL;
  celspan_status status = cs_svg_line_init(reading->context, node, &place->measure, &line);
  if (status == CELSPAN_OK)
    status = draw_and_finish(&p, NULL, out);
  cs_svg_line_finish(&line, reading->context);
  return status;
}

celspan_status cs_svg_stroke_outline(cs_svg_reading *reading, const cs_svg_node *node,
                                     const cs_svg_place *place, cs_outline *outline,
                                     const celspan_box *box, celspan_object **out) {
  stroking p = {.reading = reading, .node = node, .place = place, .outline = outline};
  return draw_and_finish(&p, box, out);
}
