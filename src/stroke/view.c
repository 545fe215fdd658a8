#include "stroke/view.h"

#include <math.h>

#include "geometry/matrix.h"

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
    return around.right < frame->left || around.left > frame->right ||
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
  return cs_boundary_around_box(box, &view->matrix, &around) && around.left >= frame->left &&
         around.right <= frame->right && around.top >= fmax(frame->top, view->top) &&
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
