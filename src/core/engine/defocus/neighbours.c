#include "engine/defocus/neighbours.h"

#include <math.h>

#include "base/elementary.h"
#include "base/number.h"
#include "engine/defocus/samples.h"
#include "model/colour/space.h"
#include "model/geometry/boundary.h"

#define TILE 64            /* nodes of a row that are made together */
#define NEAR 1e-6          /* samples: a side of the box that lies so near to one lies on it */
#define LEAST (1 / 510.0F) /* the least alpha that counts */
#define RIM 0.016          /* how softly the cone of a spot ends, as a difference of cosines */

/* ---------------------------------------------------------------- life */

void cs_defocus_neighbours_init(cs_defocus_neighbours *neighbours, cs_nearby *rule) {
  *neighbours = (cs_defocus_neighbours){.rule = cs_nearby_ref(rule)};
  for (int axis = 0; axis < 2; axis++) {
    int32_t before = rule->target[axis], after = rule->size[axis] - 1 - before;
    neighbours->extent[axis] = rule->kind == CS_NEARBY_LIGHT     ? 1
                               : rule->kind == CS_NEARBY_WEIGHTS ? (before > after ? before : after)
                                                                 : 0;
  }
}

void cs_defocus_neighbours_finish(cs_defocus_neighbours *neighbours) {
  cs_nearby_unref(neighbours->rule);
  *neighbours = (cs_defocus_neighbours){0};
}

celspan_status cs_defocus_neighbours_place(celspan_context *context,
                                           cs_defocus_neighbours *neighbours,
                                           const celspan_matrix *to_samples, celspan_space space) {
  const cs_nearby *rule = neighbours->rule;
  const double *m = to_samples->m;
  cs_boundary_frame box;
  float colour[4] = {(float)rule->light.colour[0], (float)rule->light.colour[1],
                     (float)rule->light.colour[2], 1};
  if (!celspan_matrix_inverse(*to_samples, &neighbours->to_units) ||
      !cs_boundary_around_box(&rule->box, to_samples, &box))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "filter: it has no area on the frame");
  neighbours->first[0] = cs_number_floor(box.left + NEAR);
  neighbours->first[1] = cs_number_floor(box.top + NEAR);
  neighbours->end[0] = cs_number_ceil(box.right - NEAR);
  neighbours->end[1] = cs_number_ceil(box.bottom - NEAR);
  for (int k = 0; k < 4; k++)
    neighbours->slope[k / 2][k % 2] = m[3 * (k / 2) + k % 2];
  if (space == CELSPAN_SPACE_SRGB)
    cs_space_encode(space, colour);
  memcpy(neighbours->colour, colour, sizeof neighbours->colour);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- samples */

/* The samples under the nodes that are being made, a tile at a time: rows of `width` of them. */
typedef struct filling {
  const cs_defocus_neighbours *neighbours;
  const cs_nearby *rule;
  cs_defocus_samples samples;
  int32_t top; /* the row of the first samples */
  size_t width;
} filling;

/* The nearest of the samples of the box. */
static inline int32_t held(const filling *f, int axis, int32_t at) {
  const cs_defocus_neighbours *n = f->neighbours;
  return at < n->first[axis] ? n->first[axis] : at >= n->end[axis] ? n->end[axis] - 1 : at;
}

static inline bool is_inside(const filling *f, int32_t column, int32_t row) {
  return column == held(f, 0, column) && row == held(f, 1, row);
}

static inline const cs_v4 *line_of(const filling *f, int32_t row) {
  return f->samples.room + (size_t)(row - f->top) * f->width;
}

static inline cs_v4 sample_at(const filling *f, int32_t column, int32_t row) {
  return line_of(f, row)[column - f->samples.low];
}

static inline cs_v4 straight(cs_v4 v) {
  cs_v4 colour = v[3] > 0 ? v / v[3] : cs_v4_all(0);
  colour[3] = v[3];
  return colour;
}

static void take_row(void *user, int32_t k) {
  filling *f = user;
  cs_v4 *row = f->samples.room + (size_t)k * f->width;
  int32_t count = f->samples.high - f->samples.low;
  cs_defocus_samples_spread(&f->samples, k, row);
  for (int32_t x = 0; f->rule->keeps_alpha && x < count; x++)
    row[x] = straight(row[x]);
}

/* ---------------------------------------------------------------- weights */

static cs_v4 weighed(const filling *f, int32_t column, int32_t row) {
  const cs_nearby *rule = f->rule;
  const float *weight = rule->numbers;
  cs_v4 sum = cs_v4_all((float)rule->bias);
  for (int32_t j = 0; j < rule->size[1]; j++) {
    int32_t y = row + j - rule->target[1], left = column - rule->target[0];
    const cs_v4 *line = line_of(f, rule->continues ? held(f, 1, y) : y);
    for (int32_t i = 0; i < rule->size[0]; i++) {
      int32_t at = rule->continues ? held(f, 0, left + i) : left + i;
      sum += *weight++ * line[at - f->samples.low];
    }
  }
  return sum;
}

static cs_v4 weights_at(const filling *f, int32_t column, int32_t row) {
  cs_v4 sum = weighed(f, column, row);
  if (!f->rule->keeps_alpha) {
    const float alpha = cs_v4_min(cs_v4_max(sum, cs_v4_all(0)), cs_v4_all(1))[3];
    return cs_v4_min(cs_v4_max(sum, cs_v4_all(0)), cs_v4_all(alpha));
  }
  const float alpha = sample_at(f, column, row)[3];
  sum = alpha * cs_v4_min(cs_v4_max(sum, cs_v4_all(0)), cs_v4_all(1));
  sum[3] = alpha;
  return sum;
}

/* ---------------------------------------------------------------- functions of alpha */

/* A sample with another alpha. The colour of what is less than half an 8-bit code, such as the tail
 * of a Gaussian, does not count. */
static cs_v4 alpha_at(const filling *f, int32_t column, int32_t row) {
  const cs_nearby *rule = f->rule;
  const cs_v4 v = sample_at(f, column, row);
  const double *ground = rule->ground;
  /* what is not a number is clear */
  float at = (v[3] > 0 ? v[3] < 1 ? v[3] : 1 : 0) * (float)(rule->count - 1);
  size_t k = (size_t)at < rule->count - 1 ? (size_t)at : rule->count - 2;
  float share = at - (float)k;
  float alpha = rule->numbers[k] + share * (rule->numbers[k + 1] - rule->numbers[k]);
  cs_v4 out = v[3] >= LEAST
                  ? alpha / v[3] * v
                  : alpha * (cs_v4){(float)ground[0], (float)ground[1], (float)ground[2], 0};
  out[3] = alpha;
  return out;
}

/* ---------------------------------------------------------------- light */

typedef struct vector {
  double x, y, z;
} vector;

static double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* In the same direction, with a length of 1. */
static vector unit(vector a) {
  double length = sqrt(dot(a, a));
  return length > 0 ? (vector){a.x / length, a.y / length, a.z / length} : (vector){0, 0, 0};
}

/* Twice the change of alpha from a sample to the next one along an axis: Sobel's operator, with the
 * samples that the box has. Source: Filter Effects Module Level 1, 9.12. */
static double change_at(const filling *f, const int32_t at[2], int axis) {
  const int other = 1 - axis;
  int32_t low[2], high[2];
  double sum = 0, weight = 0;
  for (int k = -1; k <= 1; k++) {
    if (held(f, other, at[other] + k) != at[other] + k)
      continue;
    low[axis] = held(f, axis, at[axis] - 1);
    high[axis] = held(f, axis, at[axis] + 1);
    low[other] = high[other] = at[other] + k;
    const double share = k == 0 ? 2 : 1;
    sum += share * (double)(sample_at(f, high[0], high[1])[3] - sample_at(f, low[0], low[1])[3]);
    weight += share;
  }
  const int32_t way = high[axis] - low[axis];
  return way > 0 ? 2 * sum / (weight * way) : 0;
}

static vector normal_at(const filling *f, const int32_t at[2]) {
  const double(*slope)[2] = f->neighbours->slope;
  const double across = change_at(f, at, 0), down = change_at(f, at, 1);
  const double height = f->rule->light.height;
  return unit((vector){-height * (across * slope[0][0] + down * slope[1][0]),
                       -height * (across * slope[0][1] + down * slope[1][1]), 1});
}

/* The share of a spot's light that goes in a direction. */
static double spot_share(const cs_nearby_light *light, vector to_light) {
  const double *from = light->from, *to = light->towards;
  const vector axis = unit((vector){to[0] - from[0], to[1] - from[1], to[2] - from[2]});
  const double cosine = -dot(to_light, axis);
  if (!(cosine > 0) || cosine < light->cone)
    return 0;
  return cs_elementary_pow(cosine, light->focus) *
         cs_number_clamp((cosine - light->cone) / RIM, 0, 1);
}

/* The direction to the light from a sample, and the share of its colour that arrives. */
static vector direction_at(const filling *f, const int32_t at[2], double *share) {
  const cs_nearby_light *light = &f->rule->light;
  const double *m = f->neighbours->to_units.m, x = at[0] + 0.5, y = at[1] + 0.5;
  const double height = light->height * (double)sample_at(f, at[0], at[1])[3];
  const vector from = {light->from[0], light->from[1], light->from[2]};
  *share = 1;
  if (light->source == CS_NEARBY_DISTANT)
    return from;
  const vector to_light = unit((vector){from.x - (m[0] * x + m[1] * y + m[2]),
                                        from.y - (m[3] * x + m[4] * y + m[5]), from.z - height});
  if (light->source == CS_NEARBY_SPOT)
    *share = spot_share(light, to_light);
  return to_light;
}

static cs_v4 light_at(const filling *f, int32_t column, int32_t row) {
  const int32_t at[2] = {column, row};
  const cs_nearby_light *light = &f->rule->light;
  const float *colour = f->neighbours->colour;
  double share;
  const vector normal = normal_at(f, at), to_light = direction_at(f, at, &share);
  const vector half = unit((vector){to_light.x, to_light.y, to_light.z + 1});
  double bright = dot(normal, light->is_specular ? half : to_light);
  if (light->is_specular)
    bright = bright > 0 ? cs_elementary_pow(bright, light->exponent) : 0;
  const float factor = (float)(light->constant * fmax(0, bright) * share);
  cs_v4 out = factor * (cs_v4){colour[0], colour[1], colour[2], 0};
  out = cs_v4_min(cs_v4_max(out, cs_v4_all(0)), cs_v4_all(1));
  out[3] = light->is_specular ? fmaxf(out[0], fmaxf(out[1], out[2])) : 1;
  return out;
}

/* ---------------------------------------------------------------- nodes */

static cs_v4 node_at(const filling *f, int32_t column, int32_t row) {
  if (f->rule->kind == CS_NEARBY_ALPHA)
    return alpha_at(f, column, row);
  if (!is_inside(f, column, row))
    return cs_v4_all(0);
  return f->rule->kind == CS_NEARBY_LIGHT ? light_at(f, column, row) : weights_at(f, column, row);
}

static void make_nodes(void *user, int32_t y, int32_t count, float (*nodes)[4]) {
  const filling *f = user;
  const int32_t *extent = f->neighbours->extent;
  for (int32_t x = 0; x < count; x++)
    cs_v4_store(nodes[x], node_at(f, f->samples.low + extent[0] + x, f->top + extent[1] + y));
}

celspan_status cs_defocus_neighbours_fill(const cs_defocus_neighbours *neighbours,
                                          cs_row_maker *maker, int32_t columns, int32_t first,
                                          int32_t end, float (*nodes)[4]) {
  const int32_t *extent = neighbours->extent;
  filling f = {.neighbours = neighbours,
               .rule = neighbours->rule,
               .top = first,
               .width = (size_t)(TILE + 2 * extent[0])};
  const cs_defocus_tiles tiles = {.columns = columns,
                                  .rows = end - first,
                                  .width = TILE,
                                  .factor = 1,
                                  .extent = extent[0],
                                  .has_function = true,
                                  .take_row = take_row,
                                  .sum_nodes = make_nodes,
                                  .user = &f};
  const int32_t rows = end - first + 2 * extent[1];
  celspan_status status =
      cs_defocus_samples_begin(maker, first, rows, (size_t)rows * f.width, &f.samples);
  if (status == CELSPAN_OK)
    cs_defocus_samples_sum(&f.samples, &tiles, nodes);
  cs_defocus_samples_finish(&f.samples, maker->context->memory);
  return status;
}
