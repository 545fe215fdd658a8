#include "frames/render/census.h"

#include <math.h>

#include "model/scene/primitive_data.h"
#include "model/scene/texture.h"

typedef struct counting {
  cs_census census;
  double width, height; /* of the frame */
} counting;

/* How much of [middle - half, middle + half] lies in [0, end]. */
static double length_inside(double middle, double half, double end) {
  return fmax(fmin(middle + half, end) - fmax(middle - half, 0), 0);
}

static bool varies(const cs_primitive_data *data) {
  return !data->texture || data->texture->kind != CS_TEXTURE_FLAT;
}

/* may_hide: nothing around the shape fades it or cuts it away. */
static void count_shape(counting *c, const cs_primitive_data *data, const celspan_matrix *matrix,
                        bool may_hide) {
  const celspan_box *box = &data->bounds;
  const double *m = matrix->m;
  double x = box->x + box->width / 2, y = box->y + box->height / 2;
  double w = fabs(m[6] * x + m[7] * y + m[8]);
  double half_width = (fabs(m[0]) * box->width + fabs(m[1]) * box->height) / 2;
  double half_height = (fabs(m[3]) * box->width + fabs(m[4]) * box->height) / 2;
  double across = length_inside((m[0] * x + m[1] * y + m[2]) / w, half_width / w, c->width);
  double down = length_inside((m[3] * x + m[4] * y + m[5]) / w, half_height / w, c->height);
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
  bool cuts = boolean->op == CELSPAN_DIFFERENCE;
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
