#include "engine/paint/shade.h"

#include "base/elementary.h"
#include "base/number.h"
#include "engine/compose/over.h"
#include "engine/paint/noise.h"
#include "model/geometry/matrix.h"

#define PLACES CS_SHADE_PLACES
#define TURN 6.283185307179586

/* ---------------------------------------------------------------- the triangle */

static double corner_value(const cs_paint *paint, int channel) {
  return channel < 3 ? paint->s[channel] : channel < 6 ? paint->t[channel - 3] : paint->beta;
}

/* The plane through the corners' values. Triangles without an area and gradients
 * without a length were made flat when the scene was checked. */
static void prepare_triangle(cs_shade *shade) {
  const celspan_texture *texture = shade->texture;
  const celspan_point *p = texture->variation->points;
  double ux = p[1].x - p[0].x, uy = p[1].y - p[0].y;
  double vx = p[2].x - p[0].x, vy = p[2].y - p[0].y;
  double area = ux * vy - uy * vx;
  for (int channel = 0; channel < 7; channel++) {
    double c0 = corner_value(&texture->variation->corners[0], channel);
    double c1 = corner_value(&texture->variation->corners[1], channel);
    double c2 = corner_value(&texture->variation->corners[2], channel);
    double *plane = shade->plane[channel];
    plane[0] = ((c1 - c0) * vy - (c2 - c0) * uy) / area;
    plane[1] = ((c2 - c0) * ux - (c1 - c0) * vx) / area;
    plane[2] = c0 - plane[0] * p[0].x - plane[1] * p[0].y;
  }
}

static cs_paint triangle_paint(const cs_shade *shade, double u, double v) {
  double value[7];
  for (int channel = 0; channel < 7; channel++) {
    const double *plane = shade->plane[channel];
    value[channel] = plane[0] * u + plane[1] * v + plane[2];
  }
  double beta = cs_number_clamp(value[6], 0, 1);
  cs_paint paint = {.beta = (float)beta};
  for (int c = 0; c < 3; c++) {
    paint.s[c] = (float)cs_number_clamp(value[c], 0, beta);
    paint.t[c] = (float)cs_number_clamp(value[c + 3], 0, 1 - beta);
  }
  return paint;
}

/* ---------------------------------------------------------------- stops */

/* The paint at one place. */
static inline cs_shade_lanes stops_paint(const celspan_texture *texture, double at) {
  const cs_stop *stops = texture->variation->stops;
  size_t next = cs_shade_stretch_stop_after(texture, at);
  cs_shade_lanes paint = cs_shade_stretch_lanes(&stops[next == 0 ? 0 : next - 1].paint);
  if (next == 0 || next == texture->variation->stop_count)
    return paint;
  cs_shade_lanes end = cs_shade_stretch_lanes(&stops[next].paint);
  float u = (float)((at - stops[next - 1].at) / (stops[next].at - stops[next - 1].at));
  return (cs_shade_lanes){paint.s + u * (end.s - paint.s), paint.t + u * (end.t - paint.t)};
}

/* The plane over frame pixels of the function a u + b v + c w in own units. */
static void set_plane(cs_shade *shade, int index, double a, double b, double c) {
  const double *m = shade->inverse.m;
  double scale = shade->is_affine ? 1 / m[8] : 1;
  for (int k = 0; k < 3; k++)
    shade->plane[index][k] = (a * m[k] + b * m[3 + k] + c * m[6 + k]) * scale;
}

/* 0 at `from`, 1 at `to`. */
static void prepare_linear(cs_shade *shade) {
  const celspan_point *from = &shade->texture->variation->points[0],
                      *to = &shade->texture->variation->points[1];
  double dx = to->x - from->x, dy = to->y - from->y, length = dx * dx + dy * dy;
  set_plane(shade, 0, dx / length, dy / length, -(from->x * dx + from->y * dy) / length);
}

/* The legs lie along and across the way from the focus to the centre. */
static void prepare_focal(cs_shade *shade, double distance) {
  const celspan_texture *texture = shade->texture;
  const celspan_point *centre = &texture->variation->points[0],
                      *offset = &texture->variation->points[1];
  double e = distance / texture->variation->radius, rest = 1 - e * e;
  double x = -offset->x / distance, y = -offset->y / distance;
  double focus_x = centre->x + offset->x, focus_y = centre->y + offset->y;
  double along = 1 / (texture->variation->radius * rest),
         across = 1 / (texture->variation->radius * sqrt(rest));
  shade->eccentricity = e;
  set_plane(shade, 0, x * along, y * along, -(focus_x * x + focus_y * y) * along);
  set_plane(shade, 1, -y * across, x * across, (focus_x * y - focus_y * x) * across);
}

static void prepare_radial(cs_shade *shade) {
  const celspan_point *centre = &shade->texture->variation->points[0],
                      *offset = &shade->texture->variation->points[1];
  double distance = sqrt(offset->x * offset->x + offset->y * offset->y);
  shade->eccentricity = 0;
  if (distance > 0) {
    prepare_focal(shade, distance);
    return;
  }
  double share = 1 / shade->texture->variation->radius;
  set_plane(shade, 0, share, 0, -centre->x * share);
  set_plane(shade, 1, 0, share, -centre->y * share);
}

/* The ways along and across the direction of 0. */
static void prepare_conic(cs_shade *shade) {
  const celspan_point *centre = &shade->texture->variation->points[0],
                      *ahead = &shade->texture->variation->points[1];
  set_plane(shade, 0, ahead->x, ahead->y, -(centre->x * ahead->x + centre->y * ahead->y));
  set_plane(shade, 1, -ahead->y, ahead->x, centre->x * ahead->y - centre->y * ahead->x);
}

double cs_shade_conic_at(const cs_shade *shade, double x, double y) {
  const double *p = shade->plane[0], *q = shade->plane[1], *m = shade->inverse.m;
  if (!shade->is_affine && !(m[6] * x + (m[7] * y + m[8]) > 0))
    return NAN;
  double turns =
      cs_elementary_atan2(q[0] * x + (q[1] * y + q[2]), p[0] * x + (p[1] * y + p[2])) / TURN;
  return turns < 0 ? turns + 1 : turns;
}

/* The coordinates in cells. */
static void prepare_noise(cs_shade *shade) {
  double share = 1 / shade->texture->variation->noise.size;
  set_plane(shade, 0, share, 0, 0);
  set_plane(shade, 1, 0, share, 0);
}

void cs_shade_prepare(cs_shade *shade) {
  shade->is_affine = cs_matrix_is_affine(&shade->inverse) && shade->inverse.m[8] > 0;
  if (shade->texture->kind == CS_TEXTURE_TRIANGLE)
    prepare_triangle(shade);
  else if (shade->texture->kind == CS_TEXTURE_LINEAR)
    prepare_linear(shade);
  else if (shade->texture->kind == CS_TEXTURE_CONIC)
    prepare_conic(shade);
  else if (shade->texture->kind == CS_TEXTURE_NOISE)
    prepare_noise(shade);
  else
    prepare_radial(shade);
  shade->is_even =
      shade->texture->kind != CS_TEXTURE_TRIANGLE && cs_texture_is_grey(shade->texture);
  shade->is_steady =
      shade->texture->kind == CS_TEXTURE_LINEAR && shade->is_affine && shade->plane[0][0] == 0;
}

static cs_shade_lanes triangle_at(const cs_shade *shade, double x, double y) {
  cs_hpoint own = cs_matrix_apply(&shade->inverse, (cs_hpoint){x, y, 1});
  cs_paint paint = CS_PAINT_CLEAR;
  if (own.w > 0)
    paint = triangle_paint(shade, own.x / own.w, own.y / own.w);
  return cs_shade_stretch_lanes(&paint);
}

cs_shade_lanes cs_shade_paint(const cs_shade *shade, double x, double y) {
  const cs_paint clear = CS_PAINT_CLEAR;
  if (shade->texture->kind == CS_TEXTURE_TRIANGLE)
    return triangle_at(shade, x, y);
  double at = cs_shade_at(shade, x, y);
  return at == at ? stops_paint(shade->texture, at) : cs_shade_stretch_lanes(&clear);
}

double cs_shade_noise_at(const cs_shade *shade, double x, double y) {
  double at;
  cs_noise_at(shade, &x, 1, y, &at);
  return at;
}

void cs_shade_find(const cs_shade *shade, const double *x, int32_t count, double y, double *at) {
  if (shade->texture->kind == CS_TEXTURE_NOISE)
    cs_noise_at(shade, x, count, y, at);
  else
    CS_WIDE_CHOOSE(cs_isa_best(), cs_shade_places)(shade, x, count, y, at);
}

/* What is done with paints at places along the stops. */
typedef struct fold {
  const cs_layer *layer; /* to which the paints belong; NULL: they are put as they are */
  bool is_first;         /* whether it is the first layer */
} fold;

static void fold_stops(const fold *f, const cs_shade *shade, const double *x, int32_t count,
                       double y, float (*s)[4], float (*t)[4]) {
  const cs_isa isa = cs_isa_best();
  double at[PLACES];
  for (int32_t k = 0, end = 0; k < count;) {
    if (k == end) {
      end = count - k < PLACES ? count : k + PLACES;
      cs_shade_find(shade, x + k, end - k, y, at);
    }
    const double *places = at + k % PLACES;
    const cs_shade_stretch part = cs_shade_stretch_at(shade->texture, *places);
    float(*part_t)[4] = t ? t + k : NULL;
    k += f->layer ? CS_WIDE_CHOOSE(isa, cs_shade_add)(&part, f->layer, places, end - k, f->is_first,
                                                      s + k, part_t)
                  : CS_WIDE_CHOOSE(isa, cs_shade_blend)(&part, places, end - k, s + k, part_t);
  }
}

void cs_shade_paints(const cs_shade *shade, const double *x, int32_t count, double y, float (*s)[4],
                     float (*t)[4]) {
  const fold none = {0};
  if (shade->texture->kind != CS_TEXTURE_TRIANGLE) {
    fold_stops(&none, shade, x, count, y, s, t);
    return;
  }
  for (int32_t k = 0; k < count; k++) {
    cs_shade_lanes paint = triangle_at(shade, x[k], y);
    cs_v4_store(s[k], paint.s);
    if (t)
      cs_v4_store(t[k], paint.t);
  }
}

void cs_shade_fold(const cs_shade *shade, const cs_layer *layer, const double *x, int32_t count,
                   double y, const cs_shade_state *state) {
  const fold f = {layer, state->is_first};
  float(*e)[4] = state->e, (*t)[4] = state->t;
  if (shade->texture->kind != CS_TEXTURE_TRIANGLE) {
    fold_stops(&f, shade, x, count, y, e, t);
    return;
  }
  for (int32_t k = 0; k < count; k++) {
    cs_over_pair front = cs_over_pair_clear;
    if (!state->is_first)
      front = (cs_over_pair){cs_v4_load(e[k]), cs_v4_load(t[k])};
    cs_shade_lanes paint = triangle_at(shade, x[k], y);
    front = cs_over_pair_over(front, cs_over_lit(layer->front, layer->fade, paint.s, paint.t));
    cs_v4_store(e[k], front.e);
    cs_v4_store(t[k], front.t);
  }
}

/* ---------------------------------------------------------------- where a row bends
 *
 * On a row the homogeneous own coordinates are linear in x: (u, v, w) = base + x * step. A plane
 * a u + b v + c w is then linear too, and meets a level L where plane(x) - L w(x) = 0; the distance
 * from a centre meets r L where a quadratic does. */

typedef struct row_map {
  cs_hpoint base, step;
} row_map;

static row_map map_row(const cs_shade *shade, double y) {
  const double *m = shade->inverse.m;
  return (row_map){{m[1] * y + m[2], m[4] * y + m[5], m[7] * y + m[8]}, {m[0], m[3], m[6]}};
}

typedef struct breaks {
  double x0, x1, *out;
  size_t count;
} breaks;

static void add_break(breaks *list, double x) {
  if (x > list->x0 && x < list->x1)
    list->out[list->count++] = x;
}

/* Where a u + b v + c w = 0. */
static void break_plane(breaks *list, const row_map *map, double a, double b, double c) {
  double base = a * map->base.x + b * map->base.y + c * map->base.w;
  double step = a * map->step.x + b * map->step.y + c * map->step.w;
  if (step != 0)
    add_break(list, -base / step);
}

static void break_triangle(breaks *list, const cs_shade *shade, const row_map *map) {
  const double *beta = shade->plane[6];
  break_plane(list, map, beta[0], beta[1], beta[2]);
  break_plane(list, map, beta[0], beta[1], beta[2] - 1);
  for (int channel = 0; channel < 6; channel++) {
    const double *plane = shade->plane[channel];
    break_plane(list, map, plane[0], plane[1], plane[2]);
    break_plane(list, map, plane[0], plane[1], plane[2] - 1);
    double sign = channel < 3 ? -1 : 1, limit = channel < 3 ? 0 : 1;
    break_plane(list, map, plane[0] + sign * beta[0], plane[1] + sign * beta[1],
                plane[2] + sign * beta[2] - limit);
  }
}

static void break_linear(breaks *list, const celspan_texture *texture, const row_map *map) {
  const celspan_point *from = &texture->variation->points[0], *to = &texture->variation->points[1];
  double dx = to->x - from->x, dy = to->y - from->y, length = dx * dx + dy * dy;
  for (size_t i = 0; i < texture->variation->stop_count; i++)
    break_plane(list, map, dx, dy,
                -(dx * from->x + dy * from->y) - texture->variation->stops[i].at * length);
}

/* Where |(u, v) - centre| = radius * at, homogeneously, and where the row is nearest the centre. */
static void break_radial(breaks *list, const celspan_texture *texture, const row_map *map) {
  double cx = texture->variation->points[0].x, cy = texture->variation->points[0].y;
  double bu = map->base.x - cx * map->base.w, su = map->step.x - cx * map->step.w;
  double bv = map->base.y - cy * map->base.w, sv = map->step.y - cy * map->step.w;
  for (size_t i = 0; i < texture->variation->stop_count; i++) {
    double r = texture->variation->stops[i].at * texture->variation->radius;
    double a = su * su + sv * sv - r * r * map->step.w * map->step.w;
    double b = bu * su + bv * sv - r * r * map->base.w * map->step.w;
    double c = bu * bu + bv * bv - r * r * map->base.w * map->base.w;
    double root = b * b - a * c;
    if (a == 0 || root < 0)
      continue;
    add_break(list, (-b - sqrt(root)) / a);
    add_break(list, (-b + sqrt(root)) / a);
  }
  if (su * su + sv * sv > 0)
    add_break(list, -(bu * su + bv * sv) / (su * su + sv * sv));
}

/* The same with a focus: where P^2 + Q^2 = (at W + e P)^2 on planes over the frame, and where the
 * sum is least. */
static void break_focal(breaks *list, const cs_shade *shade, double y) {
  const celspan_texture *texture = shade->texture;
  const double *p = shade->plane[0], *q = shade->plane[1], *m = shade->inverse.m;
  double bp = p[1] * y + p[2], bq = q[1] * y + q[2], bw = m[7] * y + m[8], e = shade->eccentricity;
  double speed = p[0] * p[0] + q[0] * q[0];
  for (size_t i = 0; i < texture->variation->stop_count; i++) {
    double at = texture->variation->stops[i].at;
    double step = (shade->is_affine ? 0 : at * m[6]) + e * p[0];
    double base = at * (shade->is_affine ? 1 : bw) + e * bp;
    double a = speed - step * step, b = bp * p[0] + bq * q[0] - base * step;
    double c = bp * bp + bq * bq - base * base, root = b * b - a * c;
    if (a == 0 || root < 0)
      continue;
    add_break(list, (-b - sqrt(root)) / a);
    add_break(list, (-b + sqrt(root)) / a);
  }
  if (speed > 0)
    add_break(list, -(bp * p[0] + bq * q[0]) / speed);
}

/* Where the row crosses the lines through the centre on which the stops and 0 lie, and where it is
 * nearest to the centre. */
static void break_conic(breaks *list, const cs_shade *shade, double y) {
  const celspan_texture *texture = shade->texture;
  const double *p = shade->plane[0], *q = shade->plane[1];
  double bp = p[1] * y + p[2], bq = q[1] * y + q[2], speed = p[0] * p[0] + q[0] * q[0];
  for (size_t i = 0; i <= texture->variation->stop_count; i++) {
    double sine = 0, cosine = 1;
    if (i > 0)
      cs_elementary_sincos(TURN * texture->variation->stops[i - 1].at, &sine, &cosine);
    double step = q[0] * cosine - p[0] * sine;
    if (step != 0)
      add_break(list, -(bq * cosine - bp * sine) / step);
  }
  if (speed > 0)
    add_break(list, -(bp * p[0] + bq * q[0]) / speed);
}

size_t cs_shade_break_limit(const cs_shade *shade) {
  return shade->texture->kind == CS_TEXTURE_TRIANGLE
             ? 21
             : 2 * shade->texture->variation->stop_count + 2;
}

size_t cs_shade_breaks(const cs_shade *shade, cs_run run, double *out) {
  breaks list = {run.x0, run.x1, out, 0};
  row_map map = map_row(shade, run.y);
  break_plane(&list, &map, 0, 0, 1); /* the horizon */
  if (shade->texture->kind == CS_TEXTURE_TRIANGLE)
    break_triangle(&list, shade, &map);
  else if (shade->texture->kind == CS_TEXTURE_LINEAR)
    break_linear(&list, shade->texture, &map);
  else if (shade->texture->kind == CS_TEXTURE_CONIC)
    break_conic(&list, shade, run.y);
  else if (shade->eccentricity > 0)
    break_focal(&list, shade, run.y);
  else if (shade->texture->kind != CS_TEXTURE_NOISE)
    break_radial(&list, shade->texture, &map);
  return list.count;
}
