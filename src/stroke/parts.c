#include "stroke/parts.h"

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

/* The piece at a length, of those in [begin, end). after: at a joint, the piece that begins there. */
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
  CS_TRY(cs_mem_reserve(context, (void **)&stroke->parts, &stroke->part_capacity,
                        stroke->part_count + 1, sizeof *stroke->parts));
  stroke->parts[stroke->part_count++] = part;
  return CELSPAN_OK;
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

/* A closed contour's last dash goes on in its first: parts from `first_part` on are its own. */
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
  r.ends = cs_mem_array(context->memory, count, sizeof *r.ends);
  if (!r.ends)
    return cs_fail_memory(context);
  if (desc->dash_count > 0 || desc->from > 0 || desc->to < 1)
    measure(&r);
  else /* where a piece ends does not matter: all are drawn */
    for (size_t i = 0; i < count; i++)
      r.ends[i] = r.whole += 1;
  celspan_status status = divide_contours(&r, closed);
  cs_mem_free(context->memory, r.ends, count * sizeof *r.ends);
  return status;
}
