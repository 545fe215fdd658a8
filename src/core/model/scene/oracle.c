#include "model/scene/oracle.h"

#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/number.h"
#include "model/pictures/load.h"
#include "model/scene/scanline.h"

const cs_oracle_paint cs_oracle_clear = {{0, 0, 0}, {1, 1, 1}, 0};

/* ---------------------------------------------------------------- algebra */

cs_oracle_paint cs_oracle_mix(const cs_oracle_paint *p, const cs_oracle_paint *q, double u) {
  cs_oracle_paint result = {.beta = (1 - u) * p->beta + u * q->beta};
  for (int c = 0; c < 3; c++) {
    result.s[c] = (1 - u) * p->s[c] + u * q->s[c];
    result.t[c] = (1 - u) * p->t[c] + u * q->t[c];
  }
  return result;
}

/* The paint with its pigment as a number of a space. */
static cs_oracle_paint widen(const cs_paint *paint, celspan_space space) {
  cs_oracle_paint wide = {{(double)paint->s[0], (double)paint->s[1], (double)paint->s[2]},
                          {(double)paint->t[0], (double)paint->t[1], (double)paint->t[2]},
                          (double)paint->beta};
  for (int c = 0; c < 3 && space == CELSPAN_SPACE_SRGB; c++)
    wide.s[c] = cs_oracle_convert(space, wide.s[c], wide.beta);
  return wide;
}

/* ---------------------------------------------------------------- gradients */

static double cross(celspan_point origin, celspan_point a, celspan_point b) {
  return (a.x - origin.x) * (b.y - origin.y) - (b.x - origin.x) * (a.y - origin.y);
}

static double blend(const double weights[3], double a, double b, double c) {
  return weights[0] * a + weights[1] * b + weights[2] * c;
}

static cs_oracle_paint shade_triangle(const celspan_texture *texture, celspan_point at,
                                      celspan_space space) {
  const celspan_point *p = texture->variation->points;
  const cs_paint *corners = texture->variation->corners;
  const cs_oracle_paint q[3] = {widen(&corners[0], space), widen(&corners[1], space),
                                widen(&corners[2], space)};
  double area = cross(p[0], p[1], p[2]);
  double weights[3] = {cross(p[1], p[2], at) / area, cross(p[2], p[0], at) / area,
                       cross(p[0], p[1], at) / area};
  cs_oracle_paint shade = {
      .beta = cs_number_clamp(blend(weights, q[0].beta, q[1].beta, q[2].beta), 0, 1)};
  for (int c = 0; c < 3; c++) {
    double s = blend(weights, q[0].s[c], q[1].s[c], q[2].s[c]);
    double t = blend(weights, q[0].t[c], q[1].t[c], q[2].t[c]);
    shade.s[c] = cs_number_clamp(s, 0, shade.beta);
    shade.t[c] = cs_number_clamp(t, 0, 1 - shade.beta);
  }
  return shade;
}

static cs_oracle_paint shade_stops(const celspan_texture *texture, double at, celspan_space space) {
  const cs_stop *stops = texture->variation->stops;
  size_t next = 0;
  while (next < texture->variation->stop_count && stops[next].at <= at)
    next++;
  if (next == 0)
    return widen(&stops[0].paint, space);
  cs_oracle_paint before = widen(&stops[next - 1].paint, space);
  if (next == texture->variation->stop_count)
    return before;
  cs_oracle_paint after = widen(&stops[next].paint, space);
  return cs_oracle_mix(&before, &after,
                       (at - stops[next - 1].at) / (stops[next].at - stops[next - 1].at));
}

static double linear_parameter(const celspan_texture *texture, celspan_point at) {
  celspan_point from = texture->variation->points[0], to = texture->variation->points[1];
  double dx = to.x - from.x, dy = to.y - from.y;
  return ((at.x - from.x) * dx + (at.y - from.y) * dy) / (dx * dx + dy * dy);
}

/* Circles of the radius t r about focus + t (centre - focus): the greater t for which the circle
 * goes through the point; it solves (r^2 - d^2) t^2 + 2 (p d) t - p^2 = 0. */
static double radial_parameter(const celspan_texture *texture, celspan_point at) {
  celspan_point centre = texture->variation->points[0], offset = texture->variation->points[1];
  double px = at.x - centre.x - offset.x, py = at.y - centre.y - offset.y,
         r = texture->variation->radius;
  double rest = r * r - offset.x * offset.x - offset.y * offset.y;
  double half = -(px * offset.x + py * offset.y);
  return (sqrt(half * half + rest * (px * px + py * py)) - half) / rest;
}

/* The angle from the direction of 0, as the difference of two angles from up. */
static double conic_parameter(const celspan_texture *texture, celspan_point at) {
  celspan_point centre = texture->variation->points[0], ahead = texture->variation->points[1];
  double turned = cs_elementary_atan2(at.x - centre.x, centre.y - at.y) -
                  cs_elementary_atan2(ahead.x, -ahead.y);
  double turns = turned / 6.283185307179586;
  return turns - floor(turns);
}

/* ---------------------------------------------------------------- pictures */

static int32_t wrap_texel(double texel, int32_t size, celspan_wrap wrap) {
  if (wrap == CELSPAN_WRAP_REPEAT)
    texel -= floor(texel / size) * size;
  return cs_number_to_int32(cs_number_clamp(texel, 0, size - 1));
}

static celspan_status add_texel(celspan_context *context, const cs_picture *picture, int32_t x,
                                int32_t y, double weight, double rgba[4]) {
  cs_picture_block *block;
  CS_TRY(cs_load_block(context, picture, 0, x / CS_PICTURE_BLOCK, y / CS_PICTURE_BLOCK, &block));
  size_t texel = (size_t)(y % CS_PICTURE_BLOCK) * CS_PICTURE_BLOCK + (size_t)(x % CS_PICTURE_BLOCK);
  for (size_t c = 0; c < 4; c++)
    rgba[c] += weight * (double)block->texels[4 * texel + c];
  cs_store_release(block);
  return CELSPAN_OK;
}

/* u, v: picture pixels. Beyond the centres of the outermost texels their colours continue, unless
 * the picture repeats: the edge of a picture is not blurred. */
/* u, v: from 0 to 1 over the picture. */
static celspan_status read_bilinear(celspan_context *context, const cs_picture *picture,
                                    celspan_wrap wrap, double u, double v, float out[4]) {
  celspan_picture_info info;
  CS_TRY(cs_store_info(context, picture, &info));
  double left = floor(u * info.width - 0.5), top = floor(v * info.height - 0.5);
  double share_x = u * info.width - 0.5 - left, share_y = v * info.height - 0.5 - top;
  double rgba[4] = {0, 0, 0, 0};
  for (int corner = 0; corner < 4; corner++) {
    int dx = corner % 2, dy = corner / 2;
    double weight = (dx ? share_x : 1 - share_x) * (dy ? share_y : 1 - share_y);
    if (weight == 0)
      continue;
    CS_TRY(add_texel(context, picture, wrap_texel(left + dx, info.width, wrap),
                     wrap_texel(top + dy, info.height, wrap), weight, rgba));
  }
  for (int c = 0; c < 4; c++)
    out[c] = (float)rgba[c];
  return CELSPAN_OK;
}

/* A primitive lies inside its own box, so a picture ends inside the primitive only if the picture
 * was given a box. */
static celspan_status shade_picture(celspan_context *context, const celspan_texture *texture,
                                    const celspan_box *bounds, celspan_point at,
                                    celspan_space space, cs_oracle_paint *out) {
  const cs_texture_variation *variation = texture->variation;
  const celspan_box *box = variation->has_box ? &variation->box : bounds;
  double u = (at.x - box->x) / box->width, v = (at.y - box->y) / box->height;
  *out = cs_oracle_clear;
  if (variation->has_box && variation->wrap == CELSPAN_WRAP_CLEAR &&
      !(u >= 0 && u < 1 && v >= 0 && v < 1))
    return CELSPAN_OK;
  float sample[4];
  CS_TRY(read_bilinear(context, variation->picture, variation->wrap, u, v, sample));
  cs_paint paint = cs_paint_from_picture(sample, variation->use);
  if (variation->medium) {
    CS_TRY(read_bilinear(context, variation->medium, variation->wrap, u, v, sample));
    const cs_paint medium = cs_paint_from_picture(sample, CELSPAN_PICTURE_GEL);
    memcpy(paint.t, medium.t, sizeof paint.t);
  }
  *out = widen(&paint, space);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- procedures */

static cs_oracle_paint shade_span(const cs_scanline_span *span, const cs_paint *paints, double x,
                                  celspan_space space) {
  const cs_paint *own = paints + span->first_paint;
  size_t last = span->paint_count - 1;
  double along = (x - span->paint_x0) / (span->paint_x1 - span->paint_x0) * (double)last;
  double before = cs_number_clamp(floor(along), 0, last > 0 ? (double)last - 1 : 0);
  size_t index = (size_t)before;
  cs_oracle_paint p = widen(&own[index], space);
  cs_oracle_paint q = widen(&own[index < last ? index + 1 : last], space);
  return cs_oracle_mix(&p, &q, along - before);
}

static celspan_status shade_procedure(celspan_context *context, const cs_primitive_data *data,
                                      celspan_point at, celspan_space space, bool *is_there,
                                      cs_oracle_paint *out) {
  const celspan_box *bounds = &data->scanline->bounds;
  celspan_scanline_row row = {bounds->x, bounds->x + bounds->width, 1};
  celspan_scanline_output output;
  cs_scanline_init(&output);
  celspan_status status = cs_scanline_collect(context, data->scanline, at.y, &row, &output);
  *is_there = false;
  for (size_t i = 0; status == CELSPAN_OK && i < output.span_count; i++) {
    const cs_scanline_span *span = &output.spans[i];
    if (!(at.x >= span->x0 && at.x < span->x1))
      continue;
    *is_there = true;
    *out = shade_span(span, output.paints, at.x, space);
  }
  cs_scanline_finish(&output, context->memory);
  return status;
}

/* The place in the period from 0 to 1 that corresponds to a place beyond the ends. */
static double fold(celspan_spread spread, double at) {
  if (spread == CELSPAN_SPREAD_HOLD)
    return at;
  double period = floor(at), rest = at - period;
  bool is_turned = spread == CELSPAN_SPREAD_REFLECT && fmod(fabs(period), 2) == 1;
  return is_turned ? 1 - rest : rest;
}

/* A gradient or noise at a point of its own units, computed from the texture that was given, not
 * from the unrolled texture. */
static cs_oracle_paint shade_gradient(const celspan_texture *given, celspan_point point,
                                      celspan_space space) {
  double at = given->kind == CS_TEXTURE_LINEAR   ? linear_parameter(given, point)
              : given->kind == CS_TEXTURE_RADIAL ? radial_parameter(given, point)
              : given->kind == CS_TEXTURE_CONIC  ? conic_parameter(given, point)
                                                 : cs_oracle_noise(&given->variation->noise, point);
  return shade_stops(given, fold(given->variation->spread, at), space);
}

/* Takes a point to the texture's own units; false behind the horizon of its matrix. */
static bool is_visible(const celspan_texture *texture, celspan_point *point) {
  const double *m = texture->variation->inverse.m;
  if (!texture->variation->has_matrix)
    return true;
  double w = m[6] * point->x + m[7] * point->y + m[8];
  *point = (celspan_point){(m[0] * point->x + m[1] * point->y + m[2]) / w,
                           (m[3] * point->x + m[4] * point->y + m[5]) / w};
  return w > 0;
}

celspan_status cs_oracle_texture(celspan_context *context, const celspan_texture *texture,
                                 const celspan_box *bounds, celspan_point point,
                                 celspan_space space, cs_oracle_paint *out) {
  if (texture->variation->origin)
    texture = texture->variation->origin;
  *out = cs_oracle_clear;
  if (!is_visible(texture, &point))
    return CELSPAN_OK;
  switch (texture->kind) {
  case CS_TEXTURE_FLAT:
    *out = widen(&texture->flat, space);
    return CELSPAN_OK;
  case CS_TEXTURE_TRIANGLE:
    *out = shade_triangle(texture, point, space);
    return CELSPAN_OK;
  case CS_TEXTURE_LINEAR:
  case CS_TEXTURE_RADIAL:
  case CS_TEXTURE_CONIC:
  case CS_TEXTURE_NOISE:
    *out = shade_gradient(texture, point, space);
    return CELSPAN_OK;
  case CS_TEXTURE_PICTURE:
  case CS_TEXTURE_PATTERN: /* this texture is on no primitive */
    break;
  }
  return shade_picture(context, texture, bounds, point, space, out);
}

celspan_status cs_oracle_primitive(celspan_context *context, const cs_primitive_data *data,
                                   celspan_point point, celspan_space space, bool *is_there,
                                   cs_oracle_paint *out) {
  *is_there = true;
  if (data->kind == CS_PRIMITIVE_DATA_SCANLINE)
    return shade_procedure(context, data, point, space, is_there, out);
  return cs_oracle_texture(context, data->texture, &data->bounds, point, space, out);
}
