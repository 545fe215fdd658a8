#include "model/stroke/parts.h"

#include <math.h>

#include "model/stroke/dashes.h"

/* A line that is being divided. */
typedef struct divider {
  celspan_context *context;
  cs_stroke *stroke;
  const celspan_stroke_desc *desc;
  cs_ruler ruler;
  double *ends; /* the ruler's */
  double whole; /* the length of the line */
} divider;

static celspan_status append_part(divider *d, cs_stroke_part part) {
  cs_stroke *stroke = d->stroke;
  return CS_ARRAY_APPEND(d->context, stroke->parts, stroke->part_count, part);
}

/* ---------------------------------------------------------------- dashes */

static celspan_status check_dashes(divider *d) {
  const cs_dashes *dashes = &d->stroke->dashes;
  double count = d->whole / dashes->pattern * (0.5 * (double)dashes->place_count);
  if (!(count <= CS_STROKE_DASHES))
    return cs_fail(d->context, CELSPAN_LIMIT,
                   "the line has about %.0f dashes; at most %d are allowed: make the dashes "
                   "longer, or the line shorter",
                   count, CS_STROKE_DASHES);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- contours */

static bool is_point(const cs_stroke *stroke, size_t piece) {
  cs_bezier line;
  cs_curve_load_line(&stroke->line, piece, 0, 1, &line);
  return cs_curve_is_point(&line);
}

static celspan_status add_whole(divider *d, size_t contour, bool is_closed) {
  size_t begin, end;
  cs_stroke_contour(&d->stroke->line, contour, &begin, &end);
  bool is_dot = end - begin == 1 && is_point(d->stroke, begin);
  cs_dashes_run run = {.contour = (uint32_t)contour,
                       .is_whole = true,
                       .is_dot = is_dot,
                       .is_closed = is_closed && !is_dot};
  return d->desc->dash_count == 0 ? append_part(d, cs_dashes_whole(&d->stroke->line, &run))
                                  : cs_dashes_append(d->context, d->stroke, run, 1);
}

/* The parts of a contour, between two lengths of the line. */
static celspan_status divide_contour(divider *d, size_t contour, bool is_closed, double from,
                                     double to) {
  size_t begin, end;
  cs_stroke_contour(&d->stroke->line, contour, &begin, &end);
  double start = cs_ruler_begin(&d->ruler, begin), stop = d->ends[end - 1];
  bool is_whole = from <= start && to >= stop;
  if (start > to || stop < from || (start < stop && (start == to || stop == from)))
    return CELSPAN_OK;
  if (start == stop || (is_whole && d->desc->dash_count == 0))
    return add_whole(d, contour, is_closed);
  from = fmax(from, start);
  to = fmin(to, stop);
  return d->desc->dash_count == 0
             ? append_part(d, cs_ruler_part(&d->ruler, contour, from, to))
             : cs_dashes_add(d->context, d->stroke, contour, from, to, is_closed && is_whole);
}

static celspan_status divide_contours(divider *d, const cs_outline_closed *closed) {
  double from = fmax(0, d->desc->from), to = fmin(1, d->desc->to);
  size_t next = 0;
  if (!(from < to))
    return CELSPAN_OK;
  if (d->desc->dash_count > 0)
    CS_TRY(check_dashes(d));
  for (size_t i = 0; i < d->stroke->line.contour_count; i++) {
    bool is_closed = next < closed->count && closed->contours[next] == i;
    next += is_closed;
    CS_TRY(divide_contour(d, i, is_closed, from > 0 ? from * d->whole : 0,
                          to < 1 ? to * d->whole : d->whole));
  }
  return CELSPAN_OK;
}

static void measure(divider *d) {
  const cs_stroke *stroke = d->stroke;
  for (size_t piece = 0; piece < stroke->line.piece_count; piece++) {
    cs_bezier line;
    cs_curve_load_line(&stroke->line, piece, 0, 1, &line);
    if (!cs_curve_is_point(&line))
      d->whole += cs_curve_length(&line, 0, 1);
    d->ends[piece] = d->whole;
  }
}

static celspan_status divide(divider *d, const cs_outline_closed *closed) {
  const celspan_stroke_desc *desc = d->desc;
  if (desc->dash_count > 0 || desc->from > 0 || desc->to < 1)
    measure(d);
  else /* at the ends of pieces this does not matter: all pieces are drawn */
    for (size_t i = 0; i < d->stroke->line.piece_count; i++)
      d->ends[i] = d->whole += 1;
  cs_ruler_init(&d->ruler, &d->stroke->line, d->ends, 0);
  return divide_contours(d, closed);
}

celspan_status cs_stroke_divide(celspan_context *context, cs_stroke *stroke,
                                const celspan_stroke_desc *desc, const cs_outline_closed *closed) {
  size_t count = stroke->line.piece_count;
  divider d = {.context = context, .stroke = stroke, .desc = desc};
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_MAKE(context, stroke->dashes.ends, count));
  d.ends = stroke->dashes.ends;
  if (desc->dash_count > 0) { /* the dashes are measured whenever they are read */
    CS_TRY(cs_dashes_set(context, &stroke->dashes, desc));
    return divide(&d, closed);
  }
  celspan_status status = divide(&d, closed);
  CS_ARRAYS_FREE(context->memory, &stroke->dashes, ends, ends);
  return status;
}

/* ---------------------------------------------------------------- line */

#define SETTLED 1e-14 /* a share of the coordinates */

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
 * removed again. */
static celspan_status add_spline(celspan_context *context, cs_outline *line,
                                 const celspan_point *points, size_t count,
                                 const celspan_stroke_desc *desc) {
  size_t most = count > 1 ? count - 1 : 1;
  int degree = (size_t)desc->degree < most ? desc->degree : (int)most;
  if (degree == 1)
    return add_polyline(context, line, points, count, desc->closed);
  const celspan_nurbs_desc spline = {.struct_size = sizeof spline,
                                     .points = points,
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
  celspan_point *widths;
  CS_TRY(CS_MAKE(context, widths, count));
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
  if (desc->contours)
    return cs_outline_contours(context, &raw->line, &raw->closed, desc->contours,
                               desc->contour_count);
  return desc->data ? cs_outline_path_open(context, &raw->line, &raw->closed, desc->data)
                    : add_points(context, raw, desc);
}

void cs_stroke_raw_finish(cs_stroke_raw *raw, cs_memory *memory) {
  cs_outline_finish(&raw->line, memory);
  cs_outline_finish(&raw->widths, memory);
  cs_outline_closed_finish(&raw->closed, memory);
}

/* ---------------------------------------------------------------- pieces */

/* Moves control points onto the end next to them if they differ only by rounding, because this
 * would bend the line there. */
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
  CS_TRY(CS_ARRAY_RESERVE(context, stroke->radii, stroke->radius_count + count));
  CS_TRY(CS_ARRAY_RESERVE(context, stroke->radius_starts, piece + 1));
  CS_TRY(CS_ARRAY_RESERVE(context, stroke->radius_degrees, piece + 1));
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

/* A contour that is one point: its greatest width counts. */
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
