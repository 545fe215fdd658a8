#include "stroke/line.h"

#include <math.h>

#define SETTLED 1e-14 /* of the coordinates */

/* ---------------------------------------------------------------- what is given */

/* Lines from point to point. A single point is a line of no length. */
static celspan_status add_polyline(celspan_context *context, cs_outline *line,
                                   const celspan_point *points, size_t count, bool is_closed) {
  for (size_t i = 0; i < count; i++) {
    cs_hpoint to = {points[i].x, points[i].y, 1};
    CS_TRY(i == 0 ? cs_outline_begin(context, line, to) : cs_outline_line(context, line, to));
  }
  cs_hpoint first = {points[0].x, points[0].y, 1};
  return is_closed || count == 1 ? cs_outline_line(context, line, first) : CELSPAN_OK;
}

/* A clamped spline has one piece for every knot span; the line that closes it as an outline is
 * taken off again. */
static celspan_status add_spline(celspan_context *context, cs_outline *line,
                                 const celspan_point *points, size_t count,
                                 const celspan_stroke_desc *desc) {
  size_t most = count > 1 ? count - 1 : 1;
  int degree = (size_t)desc->degree < most ? desc->degree : (int)most;
  if (degree == 1)
    return add_polyline(context, line, points, count, desc->closed);
  const celspan_nurbs_desc spline = {.points = points,
                                     .point_count = count,
                                     .degree = degree,
                                     .closure = desc->closed ? CELSPAN_NURBS_PERIODIC
                                                             : CELSPAN_NURBS_CLAMPED};
  CS_TRY(cs_outline_nurbs(context, line, &spline));
  size_t pieces = desc->closed ? count : count - (size_t)degree;
  if (line->piece_count > pieces) {
    line->piece_count--;
    line->point_count--;
  }
  return CELSPAN_OK;
}

static celspan_status add_widths(celspan_context *context, cs_stroke_raw *raw,
                                 const celspan_stroke_desc *desc) {
  size_t count = desc->point_count;
  celspan_point *widths = cs_mem_array(context->memory, count, sizeof *widths);
  if (!widths)
    return cs_fail_memory(context);
  for (size_t i = 0; i < count; i++)
    widths[i].x = desc->widths[i];
  celspan_status status = add_spline(context, &raw->widths, widths, count, desc);
  cs_mem_free(context->memory, widths, count * sizeof *widths);
  return status;
}

static celspan_status add_points(celspan_context *context, cs_stroke_raw *raw,
                                 const celspan_stroke_desc *desc) {
  if (desc->point_count == 0)
    return CELSPAN_OK;
  CS_TRY(add_spline(context, &raw->line, desc->points, desc->point_count, desc));
  if (desc->widths)
    CS_TRY(add_widths(context, raw, desc));
  return desc->closed ? cs_outline_closed_add(context, &raw->closed, 0) : CELSPAN_OK;
}

static celspan_status add_outline(celspan_context *context, cs_stroke_raw *raw,
                                  const cs_outline *outline, const cs_outline_closed *closed) {
  size_t count = closed ? closed->count : outline->contour_count;
  for (size_t i = 0; i < count; i++)
    CS_TRY(cs_outline_closed_add(context, &raw->closed, closed ? closed->contours[i] : i));
  for (size_t i = 0; i < outline->contour_count; i++) {
    size_t begin, end;
    cs_stroke_contour(outline, i, &begin, &end);
    CS_TRY(cs_outline_begin(context, &raw->line, outline->points[outline->starts[begin]]));
    for (size_t piece = begin; piece < end; piece++)
      CS_TRY(cs_outline_piece(context, &raw->line, outline->degrees[piece],
                              outline->points + outline->starts[piece] + 1));
  }
  return CELSPAN_OK;
}

celspan_status cs_stroke_raw_init(celspan_context *context, cs_stroke_raw *raw,
                                  const celspan_stroke_desc *desc, const cs_outline *outline,
                                  const cs_outline_closed *closed) {
  *raw = (cs_stroke_raw){.width = desc->width};
  cs_outline_init(&raw->line);
  cs_outline_init(&raw->widths);
  if (outline)
    return add_outline(context, raw, outline, closed);
  return desc->data ? cs_outline_path_open(context, &raw->line, &raw->closed, desc->data)
                    : add_points(context, raw, desc);
}

void cs_stroke_raw_finish(cs_stroke_raw *raw, cs_memory *memory) {
  cs_outline_finish(&raw->line, memory);
  cs_outline_finish(&raw->widths, memory);
  cs_outline_closed_finish(&raw->closed, memory);
}

/* ---------------------------------------------------------------- pieces */

/* Control points next to an end that are as good as the end become it: their rounding would bend the
 * line there. */
static void settle_end(cs_bezier *line, int end, int step) {
  cs_hpoint at = line->points[end];
  for (int i = end + step; i >= 0 && i <= line->degree; i += step) {
    cs_hpoint *p = &line->points[i];
    double size = fabs(at.x) + fabs(at.y) + fabs(p->x) + fabs(p->y);
    if (fabs(p->x / p->w - at.x / at.w) + fabs(p->y / p->w - at.y / at.w) > SETTLED * size)
      return;
    *p = (cs_hpoint){at.x / at.w * p->w, at.y / at.w * p->w, p->w};
  }
}

static void settle(cs_bezier *line) {
  if (cs_curve_is_point(line) || line->degree < 2)
    return;
  settle_end(line, 0, 1);
  settle_end(line, line->degree, -1);
}

celspan_status cs_stroke_append(celspan_context *context, cs_stroke *stroke, const cs_curve *curve,
                                bool is_first) {
  size_t piece = stroke->line.piece_count, count = (size_t)curve->radius_degree + 1;
  CS_TRY(cs_mem_reserve(context, (void **)&stroke->radii, &stroke->radius_capacity,
                        stroke->radius_count + count, sizeof *stroke->radii));
  CS_TRY(cs_mem_reserve(context, (void **)&stroke->radius_starts, &stroke->radius_start_capacity,
                        piece + 1, sizeof *stroke->radius_starts));
  CS_TRY(cs_mem_reserve(context, (void **)&stroke->radius_degrees, &stroke->radius_degree_capacity,
                        piece + 1, sizeof *stroke->radius_degrees));
  if (is_first)
    CS_TRY(cs_outline_begin(context, &stroke->line, curve->line.points[0]));
  cs_bezier line;
  cs_bezier_copy(&curve->line, &line);
  settle(&line);
  CS_TRY(cs_outline_piece(context, &stroke->line, line.degree, line.points + 1));
  stroke->radius_starts[piece] = (uint32_t)stroke->radius_count;
  stroke->radius_degrees[piece] = (uint8_t)curve->radius_degree;
  for (size_t i = 0; i < count; i++) {
    stroke->radii[stroke->radius_count++] = curve->radius[i];
    stroke->largest = fmax(stroke->largest, curve->radius[i]);
  }
  return CELSPAN_OK;
}

static void load_raw(const cs_stroke_raw *raw, size_t piece, cs_curve *out) {
  cs_curve_load_line(&raw->line, piece, 0, 1, &out->line);
  out->radius_degree = raw->widths.piece_count > 0 ? out->line.degree : 0;
  out->radius[0] = 0.5 * raw->width;
  if (raw->widths.piece_count > 0)
    for (int i = 0; i <= out->radius_degree; i++)
      out->radius[i] = fmax(0, 0.5 * raw->widths.points[raw->widths.starts[piece] + (size_t)i].x);
}

/* A contour that is one point: the widest of it counts. */
static celspan_status append_point(celspan_context *context, cs_stroke *stroke,
                                   const cs_stroke_raw *raw, size_t begin, size_t end) {
  double most = 0;
  cs_curve curve;
  for (size_t piece = begin; piece < end; piece++) {
    load_raw(raw, piece, &curve);
    for (int i = 0; i <= curve.radius_degree; i++)
      most = fmax(most, curve.radius[i]);
  }
  load_raw(raw, begin, &curve);
  curve.line = cs_bezier_line(curve.line.points[0], curve.line.points[0]);
  curve.radius_degree = 0;
  curve.radius[0] = most;
  return cs_stroke_append(context, stroke, &curve, true);
}

celspan_status cs_stroke_append_contour(celspan_context *context, cs_stroke *stroke,
                                        const cs_stroke_raw *raw, size_t contour) {
  size_t begin, end;
  bool is_first = true;
  cs_stroke_contour(&raw->line, contour, &begin, &end);
  for (size_t piece = begin; piece < end; piece++) {
    cs_curve curve;
    load_raw(raw, piece, &curve);
    if (cs_curve_is_point(&curve.line))
      continue;
    CS_TRY(cs_stroke_append(context, stroke, &curve, is_first));
    is_first = false;
  }
  return is_first ? append_point(context, stroke, raw, begin, end) : CELSPAN_OK;
}
