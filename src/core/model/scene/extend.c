#include "model/scene/extend.h"

#include <math.h>

#include "base/number.h"

enum { PIECES = 9 };

/* The border, in the form that all pieces need. */
typedef struct frame {
  celspan_matrix placed, back; /* from the objects' units to the border's, and back */
  double sides[2][4]; /* by axis: where the strips and the inside begin and end, ascending */
  double stretch[2];
} frame;

/* The map from the border's units to the same units that gives the art of piece k of three along an
 * axis. */
static void set_axis(celspan_matrix *map, const frame *f, int axis, int k) {
  double side = f->sides[axis][k == 0 ? 1 : 2], stretch = f->stretch[axis];
  map->m[4 * axis] = k == 1 ? 1 : -stretch;
  map->m[3 * axis + 2] = k == 1 ? 0 : side * (1 + stretch);
}

/* The largest factor that keeps numbers in range is enough, except for objects of almost no
 * size. */
static void set_stretch(frame *f, int axis, double reach) {
  const double *side = f->sides[axis];
  double wanted = CS_EXTEND_SHARE * reach / (side[2] - side[1]);
  double most = CS_NUMBER_LIMIT / 4 / (1 + fmax(fabs(side[1]), fabs(side[2])));
  f->stretch[axis] = fmax(CS_EXTEND_STRETCH, fmin(wanted, most));
}

/* The area of a piece, in the objects' units. */
static celspan_status make_area(celspan_context *context, const frame *f, int column, int row,
                                celspan_object **out) {
  const double *x = f->sides[0] + column, *y = f->sides[1] + row;
  const celspan_rect_desc desc = {sizeof desc, x[0], y[0], x[1] - x[0], y[1] - y[0], 0, NULL};
  celspan_object *rect;
  CS_TRY(celspan_object_create_rect(context, &desc, &rect));
  celspan_status status = celspan_object_transform(context, rect, &f->back, out);
  celspan_object_unref(rect);
  return status;
}

static celspan_status make_piece(celspan_context *context, celspan_object *art, const frame *f,
                                 int piece, celspan_object **out) {
  celspan_matrix map = celspan_matrix_identity();
  celspan_object *both[2] = {NULL, NULL};
  set_axis(&map, f, 0, piece % 3);
  set_axis(&map, f, 1, piece / 3);
  map = celspan_matrix_then(celspan_matrix_then(f->placed, map), f->back);
  celspan_status status = celspan_object_transform(context, art, &map, &both[0]);
  if (status == CELSPAN_OK)
    status = make_area(context, f, piece % 3, piece / 3, &both[1]);
  if (status == CELSPAN_OK)
    status = celspan_object_create_boolean(context, CELSPAN_OPERATOR_CLIP, both, 2, out);
  celspan_object_unref(both[0]);
  celspan_object_unref(both[1]);
  return status;
}

static celspan_status make_group(celspan_context *context, celspan_object *const *objects,
                                 size_t count, celspan_object **out) {
  celspan_group_desc desc = CELSPAN_GROUP_DESC;
  desc.objects = objects;
  desc.object_count = count;
  return celspan_object_create_group(context, &desc, out);
}

static celspan_status make_pieces(celspan_context *context, celspan_object *art, const frame *f,
                                  celspan_object **out) {
  celspan_object *pieces[PIECES] = {0};
  celspan_status status = CELSPAN_OK;
  for (int i = 0; i < PIECES && status == CELSPAN_OK; i++)
    status = make_piece(context, art, f, i, &pieces[i]);
  if (status == CELSPAN_OK)
    status = make_group(context, pieces, PIECES, out);
  for (int i = 0; i < PIECES; i++)
    celspan_object_unref(pieces[i]);
  return status;
}

celspan_status cs_extend(celspan_context *context, celspan_object *const *objects, size_t count,
                         const celspan_matrix *placed, const celspan_box *border, double reach,
                         celspan_object **out) {
  frame f = {.placed = *placed,
             .sides = {{border->x - reach, border->x, border->x + border->width,
                        border->x + border->width + reach},
                       {border->y - reach, border->y, border->y + border->height,
                        border->y + border->height + reach}}};
  celspan_object *art;
  set_stretch(&f, 0, reach);
  set_stretch(&f, 1, reach);
  if (!celspan_matrix_inverse(*placed, &f.back))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "extend: the matrix is singular");
  CS_TRY(make_group(context, objects, count, &art));
  celspan_status status = make_pieces(context, art, &f, out);
  celspan_object_unref(art);
  return status;
}
