/* The axes of gradients and pictures. */
#include <float.h>
#include <math.h>

#include "inside/number.h"
#include "writers/record/pictures.h"
#include "writers/record/places.h"
#include "writers/record/programs.h"

/* The shares of the second and the third corner. */
static void place_corners(const cs_shade *shade, planefile_axis *out) {
  const celspan_point *p = shade->texture->variation->points;
  double ux = p[1].x - p[0].x, uy = p[1].y - p[0].y;
  double vx = p[2].x - p[0].x, vy = p[2].y - p[0].y, area = ux * vy - uy * vx;
  cs_place_own(&shade->inverse,
               (double[3]){vy / area, -vx / area, (p[0].y * vx - p[0].x * vy) / area}, out->p);
  cs_place_own(&shade->inverse,
               (double[3]){-uy / area, ux / area, (p[0].x * uy - p[0].y * ux) / area}, out->q);
  cs_place_own(&shade->inverse, (double[3]){0, 0, 1}, out->w);
}

static planefile_axis axis_of(const cs_shade *shade) {
  planefile_axis axis = {.kind = PLANEFILE_LINEAR, .w = {0, 0, 1}};
  if (shade->texture->kind == CS_TEXTURE_TRIANGLE) {
    axis.kind = PLANEFILE_TRIANGLE;
    place_corners(shade, &axis);
    return axis;
  }
  cs_place_plane(shade->plane[0], axis.p);
  if (shade->texture->kind == CS_TEXTURE_RADIAL) {
    axis.kind = PLANEFILE_RADIAL;
    axis.focus = shade->eccentricity;
    cs_place_plane(shade->plane[1], axis.q);
  }
  if (!shade->is_affine)
    cs_place_own(&shade->inverse, (double[3]){0, 0, 1}, axis.w);
  return axis;
}

/* The place of the axis of a layer, if it is known already; otherwise *out: the axis. */
static celspan_status make_axis(const cs_record_source *source, cs_recording *record,
                                const cs_layer *layer, uint32_t **known, planefile_axis *out) {
  const cs_stack *stack = source->stack;
  celspan_context *context = source->context;
  *known = source->axes + layer->index;
  if (layer->kind != CS_LAYER_SHADED)
    *known += stack->shade_count;
  if (layer->kind == CS_LAYER_DEFOCUSED)
    *known += stack->image_count;
  if (**known > 0)
    return CELSPAN_OK;
  if (layer->kind == CS_LAYER_PICTURE)
    return cs_record_image(context, &stack->images[layer->index], record, out);
  if (layer->kind == CS_LAYER_DEFOCUSED)
    return cs_record_defocused(context, source->defocus[layer->index], record, out);
  cs_texture_kind kind = stack->shades[layer->index].texture->kind;
  if (kind == CS_TEXTURE_CONIC || kind == CS_TEXTURE_NOISE)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "plane: %s is in view; a plane keeps linear, radial and triangle "
                   "gradients",
                   kind == CS_TEXTURE_NOISE ? "noise" : "a conic gradient");
  *out = axis_of(&stack->shades[layer->index]);
  return CELSPAN_OK;
}

static cs_hash hash_axis(const planefile_axis *axis) {
  cs_hash hash = cs_hash_begin(0x61786973u);
  cs_hash_word(&hash, axis->kind | (uint64_t)axis->wrap << 8 | (uint64_t)axis->filter << 16 |
                          (uint64_t)axis->picture << 32);
  for (int i = 0; i < 3; i++) {
    cs_hash_number(&hash, axis->p[i]);
    cs_hash_number(&hash, axis->q[i]);
    cs_hash_number(&hash, axis->w[i]);
  }
  cs_hash_number(&hash, axis->focus);
  return cs_hash_end(hash);
}

/* A number that 24 bits hold. */
static double shorten(double number) { return fabs(number) < FLT_MAX ? (float)number : number; }

/* Rounds the numbers of an axis, which changes no colour by a tenth of an 8-bit code, except where
 * two stops are at one place: that place moves by 2^-24 of the axis. */
static void round_axis(planefile_axis *axis) {
  for (int i = 0; i < 3; i++) {
    axis->p[i] = shorten(axis->p[i]);
    axis->q[i] = shorten(axis->q[i]);
    axis->w[i] = shorten(axis->w[i]);
  }
  axis->focus = shorten(axis->focus);
}

/* *out: the number of an axis in the record, plus 1. Two layers may have the same one. */
static celspan_status add_axis(const cs_record_source *source, cs_recording *record,
                               const planefile_axis *axis, uint32_t *out) {
  celspan_context *context = source->context;
  cs_hash key = hash_axis(axis);
  size_t number = record->axis_count;
  if (!cs_hash_table_find(source->known, key, &number)) {
    CS_TRY(CS_ARRAY_APPEND(context, record->axes, record->axis_count, *axis));
    CS_TRY(cs_hash_table_add(source->known, context, key, number));
  }
  *out = (uint32_t)number + 1;
  return CELSPAN_OK;
}

celspan_status cs_record_axis(const cs_record_source *source, cs_recording *record,
                              const cs_layer *layer, uint32_t *out) {
  planefile_axis axis;
  uint32_t *known;
  CS_TRY(make_axis(source, record, layer, &known, &axis));
  if (*known == 0 && source->is_coded && axis.kind != PLANEFILE_PICTURE)
    round_axis(&axis);
  if (*known == 0)
    CS_TRY(add_axis(source, record, &axis, known));
  *out = *known - 1;
  return CELSPAN_OK;
}
