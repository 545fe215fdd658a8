#include "frames/render/census.h"

#include <math.h>

#include "model/geometry/boundary.h"
#include "model/geometry/matrix.h"
#include "model/scene/primitive_data.h"
#include "model/scene/texture.h"

typedef struct counting {
  cs_census census;
  double width, height; /* of the frame */
} counting;

/* How much of [low, high] lies in [0, end]. */
static double length_inside(double low, double high, double end) {
  return fmax(fmin(high, end) - fmax(low, 0), 0);
}

static bool varies(const cs_primitive_data *data) {
  return !data->texture || data->texture->kind != CS_TEXTURE_FLAT;
}

/* may_hide: nothing around the shape fades it or cuts it away. */
static void count_shape(counting *c, const cs_primitive_data *data, const celspan_matrix *matrix,
                        bool may_hide) {
  const celspan_matrix facing = cs_matrix_facing(matrix);
  cs_boundary_frame box;
  (void)cs_boundary_around_box(&data->bounds, &facing, &box);
  double across = length_inside(box.left, box.right, c->width);
  double down = length_inside(box.top, box.bottom, c->height);
  c->census.shapes++;
  if (!data->is_box && data->outline) {
    c->census.pieces += data->outline->piece_count;
    c->census.points += data->outline->point_count;
  }
  c->census.may_have_dashes |=
      data->stroke ? data->stroke->dashes.place_count > 0 : data->kind != CS_PRIMITIVE_DATA_OUTLINE;
  c->census.hiding += may_hide && data->mixing == CS_MIXING_OPAQUE;
  if (!(across > 0 && down > 0))
    return;
  c->census.inside++;
  c->census.heights += down;
  *(varies(data) ? &c->census.varied : &c->census.flat) += across * down;
}

static void count_object(counting *c, const celspan_object *object, const celspan_matrix *around,
                         bool may_hide) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix matrix = celspan_matrix_then(*object->matrix, *around);
  may_hide = may_hide && object->fade == 1;
  c->census.may_have_dashes |= c->census.shapes >= CS_CENSUS_MOST;
  if (data->is_empty || c->census.shapes >= CS_CENSUS_MOST)
    return;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN) {
    count_shape(c, data, &matrix, may_hide);
    return;
  }
  const cs_boolean *boolean = data->boolean;
  bool cuts = boolean->op == CELSPAN_OPERATOR_DIFFERENCE;
  for (size_t i = 0; i < boolean->operand_count; i++)
    count_object(c, boolean->operands[i], &matrix, may_hide && !(cuts && i > 0));
}

cs_census cs_census_take(celspan_object *const *objects, size_t count, const celspan_matrix *matrix,
                         int32_t width, int32_t height) {
  counting c = {.width = width, .height = height};
  for (size_t i = 0; i < count; i++)
    count_object(&c, objects[i], matrix, true);
  return c.census;
}
