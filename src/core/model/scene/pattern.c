#include "model/scene/pattern.h"

#include <math.h>

#include "base/description.h"
#include "model/geometry/matrix.h"
#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/scene/primitive_data.h"
#include "model/scene/texture.h"

#define NOUN "pattern"

/* ---------------------------------------------------------------- textures */

static celspan_status check(celspan_context *context, const celspan_pattern_desc *desc) {
  celspan_matrix inverse;
  CS_TRY(cs_check_given(context, NOUN, "art", desc->art));
  CS_TRY(cs_check_box(context, NOUN, "box", &desc->box));
  if (!(desc->box.width > 0 && desc->box.height > 0))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "pattern: box is %s x %s; its width and height must be greater than 0",
                   cs_check_number_text(desc->box.width).text,
                   cs_check_number_text(desc->box.height).text);
  if (!desc->has_matrix)
    return CELSPAN_OK;
  if (cs_matrix_is_sane(&desc->matrix) && cs_matrix_is_affine(&desc->matrix) &&
      celspan_matrix_inverse(desc->matrix, &inverse) && cs_matrix_is_sane(&inverse))
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "pattern: the matrix must not be singular, and must not have a perspective");
}

/* One box of the art, with its corner at the origin. */
static celspan_status make_tile(celspan_context *context, const celspan_pattern_desc *desc,
                                celspan_rostrum **out) {
  const celspan_matrix to_corner = celspan_matrix_translation(-desc->box.x, -desc->box.y);
  celspan_cel_desc fields = CELSPAN_CEL_DESC;
  celspan_rostrum_desc frame = CELSPAN_ROSTRUM_DESC;
  celspan_object *art = desc->art;
  celspan_cel *still, *cel;
  fields.objects = &art;
  fields.object_count = 1;
  CS_TRY(celspan_cel_create(context, &fields, &still));
  celspan_status status = celspan_cel_transform(context, still, &to_corner, &cel);
  celspan_cel_unref(still);
  CS_TRY(status);
  frame.cels = &cel;
  frame.cel_count = 1;
  frame.has_size = true;
  frame.width = desc->box.width;
  frame.height = desc->box.height;
  status = celspan_rostrum_create(context, &frame, out);
  celspan_cel_unref(cel);
  return status;
}

/* Checks the nesting depth of a primitive that is filled with the pattern. */
static celspan_status check_depth(celspan_context *context, const celspan_pattern_desc *desc) {
  int depth = desc->art->data->depth + 1;
  if (depth <= CS_SCENE_DEPTH)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_LIMIT, "pattern: nested %d levels deep; the limit is %d", depth,
                 CS_SCENE_DEPTH);
}

/* The code of textures comes before the code of rostrums, and so cannot call it directly. */
static const cs_texture_tile_calls tile_calls = {celspan_rostrum_ref, celspan_rostrum_unref};

celspan_status celspan_texture_create_pattern(celspan_context *context,
                                              const celspan_pattern_desc *desc,
                                              celspan_texture **out) {
  CS_READ(context, NOUN, celspan_pattern_desc, desc);
  celspan_rostrum *tile;
  celspan_texture *texture;
  CS_TRY(check(context, desc));
  CS_TRY(check_depth(context, desc));
  CS_TRY(make_tile(context, desc, &tile));
  celspan_status status = cs_texture_create_kind(context, CS_TEXTURE_PATTERN, &texture);
  if (status != CELSPAN_OK) {
    celspan_rostrum_unref(tile);
    return status;
  }
  cs_texture_variation *variation = cs_texture_own(texture);
  variation->tile = tile;
  variation->tile_hash = tile->hash;
  variation->calls = &tile_calls;
  variation->has_box = true;
  variation->box = desc->box;
  variation->has_matrix = true;
  variation->matrix = desc->has_matrix ? desc->matrix : celspan_matrix_identity();
  (void)celspan_matrix_inverse(variation->matrix, &variation->inverse);
  cs_texture_rehash(texture);
  *out = texture;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- primitives */

static celspan_status fill_plane(celspan_context *context, const cs_repeat *repeat,
                                 celspan_rostrum *tile, const celspan_box *bounds,
                                 cs_primitive_data *plane) {
  CS_TRY(CS_MAKE(context, plane->repeat, 1));
  *plane->repeat = *repeat;
  CS_TRY(cs_primitive_data_fill_rostrum(context, plane, tile, bounds));
  plane->depth--; /* it is on the same level as the clip */
  return CELSPAN_OK;
}

static celspan_status make_plane(celspan_context *context, const cs_repeat *repeat,
                                 celspan_rostrum *tile, const celspan_box *bounds,
                                 celspan_object **out) {
  cs_primitive_data *plane;
  CS_TRY(cs_primitive_data_create(context, CS_PRIMITIVE_DATA_ROSTRUM, NULL, &plane));
  celspan_status status = fill_plane(context, repeat, tile, bounds, plane);
  if (status == CELSPAN_OK)
    status = cs_primitive_data_object(context, plane, out);
  cs_primitive_data_unref(plane);
  return status;
}

static celspan_status plane_of(celspan_context *context, const cs_primitive_data *shape,
                               celspan_object **out) {
  const cs_texture_variation *variation = shape->texture->variation;
  const cs_repeat repeat = {variation->box, variation->matrix, variation->inverse};
  return make_plane(context, &repeat, variation->tile, &shape->bounds, out);
}

/* Removes the pattern from the data, which become the shape. */
static celspan_status make_shape(celspan_context *context, cs_primitive_data *data,
                                 celspan_object **out) {
  celspan_texture *black;
  CS_TRY(cs_texture_or_black(context, NULL, &black));
  celspan_texture_unref(data->texture);
  data->texture = black;
  data->has_uneven = false;
  data->mixing = CS_MIXING_OPAQUE;
  return cs_primitive_data_object(context, data, out);
}

/* Replaces *data by the clip, and releases it. */
static celspan_status fill(celspan_context *context, cs_primitive_data **data) {
  const cs_boolean look = {.op = CELSPAN_OPERATOR_CLIP, .is_filled = true};
  celspan_object *both[2] = {NULL, NULL};
  cs_primitive_data *clip = NULL;
  celspan_status status = (*data)->is_empty ? CELSPAN_OK : plane_of(context, *data, &both[0]);
  if (status == CELSPAN_OK)
    status = make_shape(context, *data, &both[1]);
  if (status == CELSPAN_OK && both[0])
    status = cs_primitive_data_of_operands(context, NOUN, &look, both, 2, &clip);
  celspan_object_unref(both[0]);
  celspan_object_unref(both[1]);
  if (status != CELSPAN_OK || !clip)
    return status;
  cs_primitive_data_unref(*data);
  *data = clip;
  return CELSPAN_OK;
}

celspan_status cs_pattern_wrap(celspan_context *context, cs_primitive_data *data,
                               celspan_status status, celspan_object **out) {
  if (status == CELSPAN_OK && data->texture && data->texture->kind == CS_TEXTURE_PATTERN)
    status = fill(context, &data);
  return cs_primitive_data_wrap(context, data, status, out);
}

const cs_primitive_data *cs_pattern_shape(const cs_primitive_data *data) {
  bool is_filled = data->kind == CS_PRIMITIVE_DATA_BOOLEAN && data->boolean->is_filled;
  return is_filled ? data->boolean->operands[1]->data : data;
}

/* The bounds of an object in the units inside a plane. */
static celspan_status find_inside(celspan_context *context, celspan_object *shape,
                                  const celspan_object *plane, bool *is_there, celspan_box *out) {
  celspan_matrix inverse;
  celspan_object *inside;
  *is_there = false;
  if (!celspan_matrix_inverse(*plane->matrix, &inverse))
    return CELSPAN_OK;
  CS_TRY(celspan_object_transform(context, shape, &inverse, &inside));
  celspan_status status = cs_bounds_object(context, inside, is_there, out);
  celspan_object_unref(inside);
  return status;
}

celspan_status cs_pattern_refill(celspan_context *context, celspan_object *shape,
                                 celspan_object **plane) {
  celspan_box bounds;
  bool is_there;
  celspan_object *wide, *made = NULL;
  CS_TRY(find_inside(context, shape, *plane, &is_there, &bounds));
  if (!is_there)
    return CELSPAN_OK;
  const cs_primitive_data *data = (*plane)->data;
  CS_TRY(make_plane(context, data->repeat, data->rostrum, &bounds, &wide));
  celspan_status status = cs_primitive_data_replace(context, *plane, wide->data, &made);
  celspan_object_unref(wide);
  CS_TRY(status);
  celspan_object_unref(*plane);
  *plane = made;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- points */

static double fold(double at, double from, double size) {
  double rest = at - from - size * floor((at - from) / size);
  return fmin(fmax(rest, 0), nextafter(size, 0));
}

celspan_point cs_pattern_fold(const cs_repeat *repeat, celspan_point point) {
  const double *m = repeat->inverse.m;
  const celspan_box *box = &repeat->box;
  double x = (m[0] * point.x + m[1] * point.y + m[2]) / m[8];
  double y = (m[3] * point.x + m[4] * point.y + m[5]) / m[8];
  return (celspan_point){fold(x, box->x, box->width), fold(y, box->y, box->height)};
}
