#include "model/stroke/stroke.h"

#include <math.h>

#include "model/geometry/matrix.h"

void cs_stroke_contour(const cs_outline *line, size_t contour, size_t *begin, size_t *end) {
  *begin = line->contours[contour];
  *end = contour + 1 < line->contour_count ? line->contours[contour + 1] : line->piece_count;
}

size_t cs_stroke_piece(const cs_stroke *stroke, const cs_stroke_part *part, size_t i) {
  size_t begin, end, piece = part->first + i;
  cs_stroke_contour(&stroke->line, part->contour, &begin, &end);
  return piece < end ? piece : begin + (piece - end);
}

double cs_stroke_extent_of_caps(const cs_stroke *stroke) {
  return stroke->cap == CELSPAN_STROKE_CAP_SQUARE ? sqrt(2) : 1;
}

bool cs_stroke_is_plain(const cs_stroke *stroke) {
  if (stroke->dashes.place_count > 0 || stroke->part_count != stroke->line.contour_count)
    return false;
  for (size_t i = 0; i < stroke->part_count; i++) {
    const cs_stroke_part *part = &stroke->parts[i];
    size_t begin, end;
    cs_stroke_contour(&stroke->line, part->contour, &begin, &end);
    if (part->contour != i || part->count != end - begin || part->begin != 0 || part->end != 1)
      return false;
  }
  for (size_t i = 0; i < stroke->radius_count; i++)
    if (stroke->radii[i] != stroke->largest)
      return false;
  return stroke->line.contour_count > 0;
}

double cs_stroke_extent(const cs_stroke *stroke) {
  double extent = cs_stroke_extent_of_caps(stroke);
  return stroke->join == CELSPAN_STROKE_JOIN_MITER ? fmax(extent, stroke->miter) : extent;
}

void cs_stroke_finish(cs_stroke *stroke, cs_memory *memory) {
  cs_outline_finish(&stroke->line, memory);
  CS_ARRAYS_FREE(memory, stroke, radii, parts);
  CS_ARRAYS_FREE(memory, &stroke->dashes, places, runs);
}

/* ---------------------------------------------------------------- view */

#define LARGE 2 /* frames */

double cs_stroke_view_allowance(const cs_stroke_view *view, const celspan_box *box) {
  const cs_boundary_frame *frame = &view->frame;
  cs_boundary_frame around;
  if (!cs_boundary_around_box(box, &view->matrix, &around))
    return view->tolerance;
  double beside = fmax(frame->left - around.right, around.left - frame->right);
  double above = fmax(frame->top - around.bottom, around.top - frame->bottom);
  return fmax(view->tolerance, 0.25 * fmax(beside, above));
}

double cs_stroke_view_error(const cs_stroke_view *view, celspan_point is, celspan_point ought) {
  cs_hpoint a = cs_matrix_apply(&view->matrix, (cs_hpoint){is.x, is.y, 1});
  cs_hpoint b = cs_matrix_apply(&view->matrix, (cs_hpoint){ought.x, ought.y, 1});
  if (!(a.w > 0) || !(b.w > 0))
    return 0;
  double dx = a.x / a.w - b.x / b.w, dy = a.y / a.w - b.y / b.w;
  return sqrt(dx * dx + dy * dy);
}

bool cs_stroke_view_hides(const cs_stroke_view *view, const celspan_box *box) {
  const cs_boundary_frame *frame = &view->frame;
  cs_boundary_frame around;
  if (cs_boundary_around_box(box, &view->matrix, &around))
    return around.right < fmax(frame->left, view->left) ||
           around.left > fmin(frame->right, view->right) ||
           around.bottom < fmax(frame->top, view->top) ||
           around.top > fmin(frame->bottom, view->bottom);
  for (int corner = 0; corner < 4; corner++) {
    cs_hpoint own = {box->x + (corner & 1 ? box->width : 0),
                     box->y + (corner & 2 ? box->height : 0), 1};
    if (cs_matrix_apply(&view->matrix, own).w > 0)
      return false;
  }
  return true;
}

bool cs_stroke_view_holds(const cs_stroke_view *view, const celspan_box *box) {
  const cs_boundary_frame *frame = &view->frame;
  cs_boundary_frame around;
  return cs_boundary_around_box(box, &view->matrix, &around) &&
         around.left >= fmax(frame->left, view->left) &&
         around.right <= fmin(frame->right, view->right) &&
         around.top >= fmax(frame->top, view->top) &&
         around.bottom <= fmin(frame->bottom, view->bottom);
}

bool cs_stroke_view_is_exceeded(const cs_stroke_view *view, const celspan_box *box) {
  const cs_boundary_frame *frame = &view->frame;
  cs_boundary_frame around;
  if (!cs_boundary_around_box(box, &view->matrix, &around))
    return true;
  return around.right - around.left > LARGE * (frame->right - frame->left) ||
         around.bottom - around.top > LARGE * (frame->bottom - frame->top);
}
