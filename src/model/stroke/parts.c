#include "model/stroke/parts.h"

#include <math.h>

#define MANY 50 /* patterns of dashes on one piece */

/* The line, measured. */
typedef struct ruler {
  celspan_context *context;
  cs_stroke *stroke;
  const celspan_stroke_desc *desc;
  double *ends; /* for each piece: the length of the line up to its end */
  double whole;
  double pattern, offset; /* length of the dashes, and where in them a contour begins */
  size_t dash_count;      /* in the pattern: even */
  size_t marked;          /* the piece that the marks are of, or SIZE_MAX */
  double marks[CS_CURVE_MARKS + 1];
} ruler;

/* ---------------------------------------------------------------- places */

static double begin_of(const ruler *r, size_t piece) { return piece > 0 ? r->ends[piece - 1] : 0; }

/* The piece at a length, of those in [begin, end). after: at a joint, the piece that begins
 * there. */
static size_t find(const ruler *r, size_t begin, size_t end, double length, bool after) {
  while (begin + 1 < end) {
    size_t middle = begin + (end - begin) / 2;
    double joint = r->ends[middle - 1];
    if (after ? joint <= length : joint < length)
      begin = middle;
    else
      end = middle;
  }
  return begin;
}

/* Whether a piece has so many dashes that it is worth while to mark it. */
static bool is_marked(ruler *r, size_t piece, const cs_bezier *line, double whole) {
  if (r->marked == piece)
    return true;
  if (cs_curve_is_straight(line) || !(r->pattern > 0) || !(whole > MANY * r->pattern))
    return false;
  cs_curve_mark(line, r->marks);
  r->marked = piece;
  return true;
}

static double parameter_at(ruler *r, size_t piece, double length) {
  cs_bezier line;
  double start = begin_of(r, piece), whole = r->ends[piece] - start;
  if (!(length > start))
    return 0;
  if (!(length < r->ends[piece]))
    return 1;
  cs_curve_load_line(&r->stroke->line, piece, 0, 1, &line);
  return is_marked(r, piece, &line, whole)
             ? cs_curve_marked_parameter(&line, r->marks, length - start)
             : cs_curve_parameter(&line, whole, length - start);
}

static celspan_status append_part(celspan_context *context, cs_stroke *stroke,
                                  cs_stroke_part part) {
  return CS_APPEND(context, stroke->parts, stroke->part_count, stroke->part_capacity, part);
}

/* The part of a contour from one length of the line to another. */
static celspan_status add_part(ruler *r, size_t contour, double from, double to) {
  size_t begin, end;
  cs_stroke_contour(&r->stroke->line, contour, &begin, &end);
  size_t last = find(r, begin, end, to, false);
  size_t first = from < to ? find(r, begin, end, from, true) : last;
  if (first > last) /* a rounding apart, at a joint */
    first = last;
  return append_part(r->context, r->stroke,
                     (cs_stroke_part){.contour = (uint32_t)contour,
                                      .first = (uint32_t)first,
                                      .count = (uint32_t)(last - first + 1),
                                      .begin = parameter_at(r, first, from),
                                      .end = parameter_at(r, last, to)});
}

/* ---------------------------------------------------------------- dashes */

static celspan_status prepare_dashes(ruler *r) {
  const celspan_stroke_desc *desc = r->desc;
  double sum = 0;
  for (size_t i = 0; i < desc->dash_count; i++)
    sum += desc->dashes[i];
  bool is_odd = desc->dash_count % 2 == 1;
  r->dash_count = is_odd ? 2 * desc->dash_count : desc->dash_count;
  r->pattern = is_odd ? 2 * sum : sum;
  r->offset = fmod(desc->dash_offset, r->pattern);
  r->offset += r->offset < 0 ? r->pattern : 0;
  double count = r->whole / r->pattern * (0.5 * (double)r->dash_count);
  if (!(count <= CS_STROKE_DASHES))
    return cs_fail(r->context, CELSPAN_LIMIT,
                   "the line has about %.0f dashes; at most %d are allowed", count,
                   CS_STROKE_DASHES);
  return CELSPAN_OK;
}

/* The parts of one contour's drawn length [from, to], which begins at `start`. */
static celspan_status add_dashes(ruler *r, size_t contour, double start, double from, double to) {
  const celspan_stroke_desc *desc = r->desc;
  double turn = floor((from - start + r->offset) / r->pattern);
  for (double place = start - r->offset + turn * r->pattern; place <= to;
       turn += 1, place = start - r->offset + turn * r->pattern) {
    double at = place;
    for (size_t i = 0; i < r->dash_count && at <= to; i++) {
      double end = at + desc->dashes[i % desc->dash_count];
      bool is_dot = end == at && at >= from;
      double first = fmax(at, from), last = fmin(end, to);
      if (i % 2 == 0 && (is_dot || first < last))
        CS_TRY(add_part(r, contour, first, last));
      at = end;
    }
  }
  return CELSPAN_OK;
}

/* A closed contour's last dash continues in its first: parts from `first_part` on are its own. */
static void join_dashes(ruler *r, size_t contour, size_t first_part) {
  cs_stroke *stroke = r->stroke;
  size_t begin, end, count = stroke->part_count - first_part;
  if (count == 0)
    return;
  cs_stroke_contour(&stroke->line, contour, &begin, &end);
  cs_stroke_part *first = &stroke->parts[first_part];
  cs_stroke_part *last = &stroke->parts[stroke->part_count - 1];
  bool is_dot = first->begin == first->end || last->begin == last->end;
  if (first->first != begin || first->begin != 0 || last->first + last->count != end ||
      last->end != 1 || (is_dot && count > 1))
    return;
  if (count == 1) {
    first->is_closed = true;
    return;
  }
  first->first = last->first;
  first->begin = last->begin;
  first->count += last->count;
  stroke->part_count--;
}

/* ---------------------------------------------------------------- contours */

static bool is_point(const cs_stroke *stroke, size_t piece) {
  cs_bezier line;
  cs_curve_load_line(&stroke->line, piece, 0, 1, &line);
  return cs_curve_is_point(&line);
}

static celspan_status add_whole(ruler *r, size_t contour, bool is_closed) {
  size_t begin, end;
  cs_stroke_contour(&r->stroke->line, contour, &begin, &end);
  bool is_dot = end - begin == 1 && is_point(r->stroke, begin);
  return append_part(r->context, r->stroke,
                     (cs_stroke_part){.contour = (uint32_t)contour,
                                      .first = (uint32_t)begin,
                                      .count = (uint32_t)(end - begin),
                                      .end = is_dot ? 0 : 1,
                                      .is_closed = is_closed && !is_dot});
}

/* The parts of a contour, between two lengths of the line. */
static celspan_status divide_contour(ruler *r, size_t contour, bool is_closed, double from,
                                     double to) {
  size_t begin, end, first_part = r->stroke->part_count;
  cs_stroke_contour(&r->stroke->line, contour, &begin, &end);
  double start = begin_of(r, begin), stop = r->ends[end - 1];
  bool is_whole = from <= start && to >= stop;
  if (start > to || stop < from || (start < stop && (start == to || stop == from)))
    return CELSPAN_OK;
  if (start == stop || (is_whole && r->desc->dash_count == 0))
    return add_whole(r, contour, is_closed);
  from = fmax(from, start);
  to = fmin(to, stop);
  if (r->desc->dash_count == 0)
    return add_part(r, contour, from, to);
  CS_TRY(add_dashes(r, contour, start, from, to));
  if (is_closed && is_whole)
    join_dashes(r, contour, first_part);
  return CELSPAN_OK;
}

static celspan_status divide_contours(ruler *r, const cs_outline_closed *closed) {
  double from = fmax(0, r->desc->from), to = fmin(1, r->desc->to);
  size_t next = 0;
  if (!(from < to))
    return CELSPAN_OK;
  if (r->desc->dash_count > 0)
    CS_TRY(prepare_dashes(r));
  for (size_t i = 0; i < r->stroke->line.contour_count; i++) {
    bool is_closed = next < closed->count && closed->contours[next] == i;
    next += is_closed;
    CS_TRY(divide_contour(r, i, is_closed, from > 0 ? from * r->whole : 0,
                          to < 1 ? to * r->whole : r->whole));
  }
  return CELSPAN_OK;
}

static void measure(ruler *r) {
  const cs_stroke *stroke = r->stroke;
  for (size_t piece = 0; piece < stroke->line.piece_count; piece++) {
    cs_bezier line;
    cs_curve_load_line(&stroke->line, piece, 0, 1, &line);
    if (!cs_curve_is_point(&line))
      r->whole += cs_curve_length(&line, 0, 1);
    r->ends[piece] = r->whole;
  }
}

celspan_status cs_stroke_divide(celspan_context *context, cs_stroke *stroke,
                                const celspan_stroke_desc *desc, const cs_outline_closed *closed) {
  size_t count = stroke->line.piece_count;
  ruler r = {.context = context, .stroke = stroke, .desc = desc, .marked = SIZE_MAX};
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, r.ends, count));
  if (desc->dash_count > 0 || desc->from > 0 || desc->to < 1)
    measure(&r);
  else /* where a piece ends does not matter: all are drawn */
    for (size_t i = 0; i < count; i++)
      r.ends[i] = r.whole += 1;
  celspan_status status = divide_contours(&r, closed);
  cs_mem_free(context->memory, r.ends, count * sizeof *r.ends);
  return status;
}

/* ---------------------------------------------------------------- line */

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
  return desc->data ? cs_outline_path_open(context, &raw->line, &raw->closed, desc->data)
                    : add_points(context, raw, desc);
}

void cs_stroke_raw_finish(cs_stroke_raw *raw, cs_memory *memory) {
  cs_outline_finish(&raw->line, memory);
  cs_outline_finish(&raw->widths, memory);
  cs_outline_closed_finish(&raw->closed, memory);
}

/* ---------------------------------------------------------------- pieces */

/* Control points next to an end that are as good as the end become it: their rounding would bend
 * the line there. */
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
  CS_TRY(CS_RESERVE(context, stroke->radii, stroke->radius_capacity, stroke->radius_count + count));
  CS_TRY(CS_RESERVE(context, stroke->radius_starts, stroke->radius_start_capacity, piece + 1));
  CS_TRY(CS_RESERVE(context, stroke->radius_degrees, stroke->radius_degree_capacity, piece + 1));
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
