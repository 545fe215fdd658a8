/* Twisting: points turn about a centre, the less the farther they are from it. Lines are bent as by
 * celspan_object_warp, but a stroke stays a stroke. */
#include <math.h>

#include "base/elementary.h"
#include "base/number.h"
#include "celspan/operators.h"
#include "model/operators/operate.h"
#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/warp/bend.h"

/* Of the longer side of the object: a hundredth of a pixel of an object of 2,600 pixels. */
#define WITHIN 0x1p-18
/* A stretch of an outline over an eighth of this many radians is not examined whole. */
#define SMOOTH 16
#define TURNS_MOST 1000 /* turns of the whole twist */

typedef struct twist {
  cs_operation operation;
  double radians;
  celspan_point centre;
  double radius; /* from the centre to the farthest corner of the bounds */
  double extent; /* the longer side of the bounds */
} twist;

static celspan_status turn(void *user, celspan_context *context, celspan_point from,
                           celspan_point *to) {
  (void)context;
  const twist *t = user;
  double x = from.x - t->centre.x, y = from.y - t->centre.y, sine, cosine;
  double share = 1 - cs_number_length(x, y) / t->radius;
  cs_elementary_sincos(share > 0 ? t->radians * share : 0, &sine, &cosine);
  *to =
      (celspan_point){t->centre.x + (cosine * x - sine * y), t->centre.y + (sine * x + cosine * y)};
  return CELSPAN_OK;
}

/* Copies a contour that has been bent and closed, back into the units of its primitive; an open one
 * without the line that closes it. */
static celspan_status copy_contour(celspan_context *context, const cs_lines *bent,
                                   const celspan_matrix *back, size_t contour, bool is_closed,
                                   bool is_parted, cs_lines *to) {
  cs_bezier piece;
  size_t begin, end;
  cs_stroke_contour(&bent->outline, contour, &begin, &end);
  end -= !is_closed && is_parted;
  for (size_t i = begin; i < end; i++) {
    cs_bezier_load(&bent->outline, i, back, &piece);
    if (i == begin)
      CS_TRY(cs_lines_begin(context, to, piece.points[0]));
    CS_TRY(cs_lines_add(context, to, &piece));
  }
  return cs_lines_end(context, to, is_closed);
}

static bool is_parted(const cs_lines *lines, const cs_lines_contour *contour) {
  cs_bezier first, last;
  cs_lines_load(lines, contour->begin, &first);
  cs_lines_load(lines, contour->end - 1, &last);
  cs_hpoint a = first.points[0], b = last.points[last.degree];
  return a.x != b.x || a.y != b.y || a.w != b.w;
}

static celspan_status copy(celspan_context *context, const cs_lines *from, const cs_lines *bent,
                           const celspan_matrix *back, cs_lines *to) {
  size_t closed_at = 0;
  for (size_t i = 0; i < bent->outline.contour_count; i++) {
    const cs_lines_contour contour = cs_lines_contour_at(from, i, &closed_at);
    CS_TRY(copy_contour(context, bent, back, i, contour.is_closed, is_parted(from, &contour), to));
  }
  return CELSPAN_OK;
}

static celspan_status change(cs_operation *operation, const cs_lines *from,
                             const celspan_matrix *place, double scale, cs_lines *to) {
  celspan_context *context = operation->context;
  twist *t = (twist *)operation;
  celspan_matrix back;
  (void)scale;
  if (!celspan_matrix_inverse(*place, &back))
    return CELSPAN_OK;
  const cs_warp_map map = {.context = context,
                           .call = turn,
                           .user = t,
                           .within = WITHIN * t->extent,
                           .extent = SMOOTH * t->radius / fabs(t->radians)};
  cs_lines bent;
  cs_lines_init(&bent, true);
  celspan_status status = cs_warp_bend(&map, &from->outline, place, &bent.outline);
  if (status == CELSPAN_OK)
    status = copy(context, from, &bent, &back, to);
  cs_lines_finish(&bent, context->memory);
  return status;
}

static double radius_of(const celspan_box *box, celspan_point centre) {
  double across = fmax(fabs(box->x - centre.x), fabs(box->x + box->width - centre.x));
  double down = fmax(fabs(box->y - centre.y), fabs(box->y + box->height - centre.y));
  return cs_number_length(across, down);
}

celspan_status celspan_object_twist(celspan_context *context, celspan_object *object,
                                    double radians, const celspan_point *centre,
                                    celspan_object **out) {
  celspan_box box = {0};
  bool is_there;
  CS_TRY(cs_check_given(context, "twist", "the object", object));
  CS_TRY(cs_check_range(context, "twist", "the angle", radians, -TURNS_MOST * 6.283185307179586,
                        TURNS_MOST * 6.283185307179586));
  if (centre)
    CS_TRY(cs_check_point(context, "twist", "centre", 0, *centre));
  CS_TRY(cs_bounds_object(context, object, &is_there, &box));
  twist t = {.operation = {context, "twist", change},
             .radians = radians,
             .centre =
                 centre ? *centre : (celspan_point){box.x + box.width / 2, box.y + box.height / 2},
             .extent = fmax(box.width, box.height)};
  t.radius = radius_of(&box, t.centre);
  if (is_there && t.extent > 0 && radians != 0)
    return cs_operate(&t.operation, object, out);
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}
