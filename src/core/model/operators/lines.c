#include "model/operators/lines.h"

#include "model/stroke/curve.h"
#include "model/stroke/dashes.h"

void cs_lines_init(cs_lines *lines, bool is_filled) {
  *lines = (cs_lines){.is_filled = is_filled};
  cs_outline_init(&lines->outline);
}

void cs_lines_finish(cs_lines *lines, cs_memory *memory) {
  cs_outline_finish(&lines->outline, memory);
  cs_outline_closed_finish(&lines->closed, memory);
}

cs_lines_contour cs_lines_contour_at(const cs_lines *lines, size_t contour, size_t *closed_at) {
  cs_lines_contour found = {.is_closed = lines->is_filled};
  cs_stroke_contour(&lines->outline, contour, &found.begin, &found.end);
  const cs_outline_closed *closed = &lines->closed;
  if (*closed_at < closed->count && closed->contours[*closed_at] == contour) {
    found.is_closed = true;
    ++*closed_at;
  }
  return found;
}

/* ---------------------------------------------------------------- writing */

celspan_status cs_lines_begin(celspan_context *context, cs_lines *lines, cs_hpoint at) {
  return lines->is_filled ? cs_outline_move(context, &lines->outline, at)
                          : cs_outline_begin(context, &lines->outline, at);
}

celspan_status cs_lines_add(celspan_context *context, cs_lines *lines, const cs_bezier *piece) {
  return cs_outline_piece(context, &lines->outline, piece->degree, piece->points + 1);
}

/* A contour without pieces is removed. */
celspan_status cs_lines_end(celspan_context *context, cs_lines *lines, bool is_closed) {
  cs_outline *outline = &lines->outline;
  if (!lines->is_filled && !is_closed)
    return CELSPAN_OK;
  CS_TRY(cs_outline_close(context, outline));
  if (lines->is_filled || outline->contour_count == 0)
    return CELSPAN_OK;
  return cs_outline_closed_add(context, &lines->closed, outline->contour_count - 1);
}

void cs_lines_load(const cs_lines *lines, size_t i, cs_bezier *out) {
  cs_curve_load_line(&lines->outline, i, 0, 1, out);
}

/* ---------------------------------------------------------------- reading strokes */

static celspan_status add_part(celspan_context *context, const cs_stroke *stroke,
                               const cs_stroke_part *part, cs_lines *out) {
  cs_bezier piece;
  for (size_t i = 0; i < part->count; i++) {
    cs_curve_load_line(&stroke->line, cs_stroke_piece(stroke, part, i), i == 0 ? part->begin : 0,
                       i + 1 == part->count ? part->end : 1, &piece);
    if (i == 0)
      CS_TRY(cs_lines_begin(context, out, piece.points[0]));
    CS_TRY(cs_lines_add(context, out, &piece));
  }
  return cs_lines_end(context, out, part->is_closed);
}

static bool returns(const cs_stroke *stroke, const cs_stroke_part *part) {
  size_t begin, end;
  cs_stroke_contour(&stroke->line, part->contour, &begin, &end);
  const cs_hpoint *points = stroke->line.points, *first = &points[stroke->line.starts[begin]],
                  *last = &points[stroke->line.starts[end - 1] + stroke->line.degrees[end - 1]];
  return part->count == end - begin && part->begin == 0 && part->end == 1 && first->x == last->x &&
         first->y == last->y;
}

/* The part that the dashes of a run divide. */
static cs_stroke_part undivided(const cs_stroke *stroke, const cs_dashes_run *run) {
  cs_ruler ruler;
  if (run->is_whole)
    return cs_dashes_whole(&stroke->line, run);
  cs_ruler_init(&ruler, &stroke->line, stroke->dashes.ends, 0);
  cs_stroke_part part = cs_ruler_part(&ruler, run->contour, run->from, run->to);
  part.is_closed = returns(stroke, &part);
  return part;
}

celspan_status cs_lines_of_stroke(celspan_context *context, const cs_stroke *stroke,
                                  cs_lines *out) {
  bool is_dashed = stroke->dashes.place_count > 0;
  size_t count = is_dashed ? stroke->dashes.run_count : stroke->part_count;
  for (size_t i = 0; i < count; i++) {
    const cs_stroke_part part =
        is_dashed ? undivided(stroke, &stroke->dashes.runs[i]) : stroke->parts[i];
    CS_TRY(add_part(context, stroke, &part, out));
  }
  return CELSPAN_OK;
}
