/* Trimming: the parts of contours between two lengths.
 *
 *    a contour, closed        0|-----------------------------|1
 *    from 0.7 to 1.2            ===|                  |=======        one part, over the seam
 *    the same, open             ===                   ========        two parts
 */
#include <math.h>

#include "celspan/operators.h"
#include "model/operators/operate.h"
#include "model/scene/check.h"
#include "model/stroke/curve.h"
#include "model/stroke/dashes.h"

/* Of the whole length: parts that are nearer than this to the end of a contour reach it. */
#define NEAR 1e-12

typedef struct trim {
  cs_operation operation;
  double from, to; /* shares; 0 <= from < 1, from < to <= from + 1 */
  bool is_together, is_measuring;
  double whole, passed; /* together: lengths of all and of what has been trimmed, around */
} trim;

/* A contour with its way: lengths of its own units, from the beginning of the outline. */
typedef struct way {
  const cs_outline *outline;
  cs_ruler ruler;
  size_t contour;
  cs_lines_contour pieces;
  double start, end;
} way;

static celspan_status add_part(celspan_context *context, const way *w, const cs_stroke_part *part,
                               bool does_continue, cs_lines *to) {
  cs_bezier piece;
  for (size_t i = 0; i < part->count; i++) {
    cs_curve_load_line(w->outline, part->first + i, i == 0 ? part->begin : 0,
                       i + 1 == part->count ? part->end : 1, &piece);
    if (i == 0 && !does_continue)
      CS_TRY(cs_lines_begin(context, to, piece.points[0]));
    CS_TRY(cs_lines_add(context, to, &piece));
  }
  return CELSPAN_OK;
}

static celspan_status add_whole(celspan_context *context, const way *w, cs_lines *to) {
  const cs_stroke_part all = {.first = (uint32_t)w->pieces.begin,
                              .count = (uint32_t)(w->pieces.end - w->pieces.begin),
                              .end = 1};
  CS_TRY(add_part(context, w, &all, false, to));
  return cs_lines_end(context, to, w->pieces.is_closed);
}

/* The part between two lengths, of which at least one is inside the contour. */
static celspan_status add_between(celspan_context *context, way *w, double from, double to,
                                  bool does_continue, cs_lines *out) {
  from = fmax(from, w->start);
  to = fmin(to, w->end);
  if (!(from < to))
    return CELSPAN_OK;
  const cs_stroke_part part = cs_ruler_part(&w->ruler, w->contour, from, to);
  return add_part(context, w, &part, does_continue, out);
}

/* low, high: the lengths that the trim keeps, in the contour's units; high may lie one whole length
 * beyond the end. whole: that length. */
static celspan_status trim_contour(celspan_context *context, way *w, double low, double high,
                                   double whole, cs_lines *to) {
  double near = NEAR * whole, length = w->end - w->start;
  bool holds_end = low < w->end && high > w->end - near;
  bool holds_start = low <= w->start && high > w->start;
  bool holds_next = high - whole > w->start; /* the beginning, after going round */
  if ((holds_start && holds_end) || high - whole >= w->end - near ||
      (!(length > 0) && (holds_start || holds_next)))
    return add_whole(context, w, to);
  bool is_joined = w->pieces.is_closed && holds_end && holds_next;
  CS_TRY(add_between(context, w, low, holds_end ? w->end : high, false, to));
  if (low < w->end && high > w->start && !is_joined)
    CS_TRY(cs_lines_end(context, to, false));
  if (!holds_next)
    return CELSPAN_OK;
  CS_TRY(add_between(context, w, w->start, high - whole, is_joined, to));
  return cs_lines_end(context, to, false);
}

static celspan_status trim_contours(trim *t, const cs_lines *from, const double *ends, double scale,
                                    cs_lines *to) {
  way w = {.outline = &from->outline};
  size_t closed_at = 0;
  cs_ruler_init(&w.ruler, &from->outline, ends, 0);
  for (w.contour = 0; w.contour < from->outline.contour_count; w.contour++) {
    w.pieces = cs_lines_contour_at(from, w.contour, &closed_at);
    w.start = cs_ruler_begin(&w.ruler, w.pieces.begin);
    w.end = ends[w.pieces.end - 1];
    double whole = t->is_together ? t->whole / scale : w.end - w.start;
    double origin = t->is_together ? -t->passed / scale : w.start;
    CS_TRY(trim_contour(t->operation.context, &w, origin + t->from * whole, origin + t->to * whole,
                        whole, to));
  }
  return CELSPAN_OK;
}

static celspan_status change(cs_operation *operation, const cs_lines *from,
                             const celspan_matrix *place, double scale, cs_lines *to) {
  (void)place;
  trim *t = (trim *)operation;
  size_t count = from->outline.piece_count;
  double *ends, sum = 0;
  cs_bezier piece;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(operation->context, ends, count));
  for (size_t i = 0; i < count; i++) {
    cs_lines_load(from, i, &piece);
    sum += cs_curve_length(&piece, 0, 1);
    ends[i] = sum;
  }
  celspan_status status = t->is_measuring ? CELSPAN_OK : trim_contours(t, from, ends, scale, to);
  cs_mem_free(operation->context->memory, ends, count * sizeof *ends);
  t->passed += sum * scale;
  return status;
}

static celspan_status measure(trim *t, celspan_object *object) {
  celspan_object *none;
  t->is_measuring = true;
  CS_TRY(cs_operate(&t->operation, object, &none));
  celspan_object_unref(none);
  t->is_measuring = false;
  t->whole = t->passed;
  t->passed = 0;
  return CELSPAN_OK;
}

celspan_status celspan_object_trim(celspan_context *context, celspan_object *object, double from,
                                   double to, double offset, bool together, celspan_object **out) {
  CS_TRY(cs_check_given(context, "trim", "the object", object));
  CS_TRY(cs_check_share(context, "trim", "from", from, &from));
  CS_TRY(cs_check_share(context, "trim", "to", to, &to));
  CS_TRY(cs_check_number(context, "trim", "offset", offset));
  double low = fmin(from, to), length = fmax(from, to) - low;
  if (length >= 1) {
    *out = celspan_object_ref(object);
    return CELSPAN_OK;
  }
  double begin = low + offset;
  begin -= floor(begin);
  trim t = {.operation = {context, "trim", change},
            .from = begin,
            .to = begin + length,
            .is_together = together};
  if (together)
    CS_TRY(measure(&t, object));
  return cs_operate(&t.operation, object, out);
}
