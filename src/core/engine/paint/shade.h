/* Textures given by a formula: the three-paint triangle, linear, radial and conic gradients,
 * and noise.
 *
 *     TRIANGLE: a plane through the       LINEAR: one plane, 0 at      RADIAL: two planes, the legs
 *     values at the corners, a channel    one end and 1 at the other   of the distance from the
 *     each                                                             centre
 *          . * c2                          \       \                         . - ~ - .
 *       . '  /                             0 \ ----> \ 1                   '       * '
 *     * c0  /                                 \       \                   |      / |  |
 *       ` . *  c1                              \       \                  |    o---+  |
 *                                          at = a x + b y + c              ' centre  '
 *                                                                            ` - . - `
 *
 * A radial gradient with a focus has circles whose centres move from the focus to the centre while
 * they grow from 0 to the radius. With p along the way from focus to centre, q across it, and e the
 * focus's distance from the centre as a share of the radius,
 *   at = sqrt(P^2 + Q^2) - e P    where P = p / (radius (1 - e^2)), Q = q / (radius sqrt(1 - e^2)),
 * which solves |(p - at e radius, q)| = at radius. Without a focus e is 0. On a row `at` is convex.
 *
 * A conic gradient is the angle about its centre, in turns. On a row it is an arc tangent, which
 * bends where the row is nearest to the centre, and jumps where the row crosses the direction of 0.
 *
 * Noise lies along its stops, too, but is found pixel by pixel: noise.h.
 *
 * Invariant: except for noise, between the places that cs_shade_breaks finds the paint is a smooth
 * function of x on a row, so it may be cut into lines by comparing a few points.
 */
#pragma once

#include "base/wide.h"
#include "engine/compose/layer.h"
#include "engine/paint/shade_stretch.h"
#include "engine/span/run.h"

#include <math.h>

/* Fills the planes, from texture and inverse. */
void cs_shade_prepare(cs_shade *shade);
/* The planes of a linear or radial texture on one row. */
typedef struct cs_shade_row {
  double step, base, across_step, across_base, eccentricity;
} cs_shade_row;

static inline cs_shade_row cs_shade_row_of(const cs_shade *shade, double y) {
  const double *p = shade->plane[0], *q = shade->plane[1];
  return (cs_shade_row){p[0], p[1] * y + p[2], q[0], q[1] * y + q[2], shade->eccentricity};
}

/* Where a point of the row lies along the stops, if the shade is affine; else that times its w.
 * is_radial, has_focus: of the shade; they are parameters, so that they are constants in loops. */
static inline double cs_shade_row_at(const cs_shade_row *row, double x, bool is_radial,
                                     bool has_focus) {
  double at = row->step * x + row->base, v = row->across_step * x + row->across_base;
  return is_radial ? sqrt(at * at + v * v) - (has_focus ? row->eccentricity * at : 0) : at;
}

/* Where a point of the frame lies along the stops of a conic texture, whose planes 0 and 1 are the
 * ways along and across the direction of 0. */
double cs_shade_conic_at(const cs_shade *shade, double x, double y);

/* The same for a texture of noise, whose planes are its coordinates in cells: noise.h. */
double cs_shade_noise_at(const cs_shade *shade, double x, double y);

/* Where a point of the frame lies along the stops. Not a number behind the horizon. */
static inline double cs_shade_at(const cs_shade *shade, double x, double y) {
  if (shade->texture->kind == CS_TEXTURE_CONIC)
    return cs_shade_conic_at(shade, x, y);
  if (shade->texture->kind == CS_TEXTURE_NOISE)
    return cs_shade_noise_at(shade, x, y);
  const cs_shade_row row = cs_shade_row_of(shade, y);
  double at =
      cs_shade_row_at(&row, x, shade->texture->kind == CS_TEXTURE_RADIAL, shade->eccentricity > 0);
  if (shade->is_affine)
    return at;
  const double *m = shade->inverse.m;
  double w = m[6] * x + (m[7] * y + m[8]);
  return w > 0 ? at / w : NAN;
}

/* The same for up to CS_SHADE_PLACES places of a row. */
#define CS_SHADE_PLACES 256
void cs_shade_find(const cs_shade *shade, const double *x, int32_t count, double y, double *at);

/* In vector code, shade_wide.c: as cs_shade_find, for all but noise; and the paints of those of at
 * most CS_SHADE_PLACES places that lie in the stretch of the first one, up to the first one that
 * does not, or their effect as a layer on light gathered (e) and transmission (t). Return how
 * many. */
CS_WIDE_DECLARE(void, cs_shade_places,
                (const cs_shade *shade, const double *x, int32_t count, double y, double *at));
CS_WIDE_DECLARE(int32_t, cs_shade_blend,
                (const cs_shade_stretch *part, const double *at, int32_t count, float (*s)[4],
                 float (*t)[4]));
CS_WIDE_DECLARE(int32_t, cs_shade_add,
                (const cs_shade_stretch *part, const cs_layer *layer, const double *at,
                 int32_t count, bool is_first, float (*e)[4], float (*t)[4]));

/* The paint at a point of the frame, pixels; clear behind the horizon. */
cs_shade_lanes cs_shade_paint(const cs_shade *shade, double x, double y);
/* The same at several places of a row, t unless that is NULL. Quickest where neighbours are near
 * each other. */
void cs_shade_paints(const cs_shade *shade, const double *x, int32_t count, double y, float (*s)[4],
                     float (*t)[4]);
/* Light gathered and transmission of pixels. is_first: nothing has been added yet, and they have no
 * contents. */
typedef struct cs_shade_state {
  float (*e)[4], (*t)[4];
  bool is_first;
} cs_shade_state;
/* Adds the paints there, lit and faded as in a layer, behind what has been added. */
void cs_shade_fold(const cs_shade *shade, const cs_layer *layer, const double *x, int32_t count,
                   double y, const cs_shade_state *state);
/* The places x inside a run at which the formula bends, in no order; at most as many as the limit
 * says. Returns how many. */
size_t cs_shade_breaks(const cs_shade *shade, cs_run run, double *breaks);
size_t cs_shade_break_limit(const cs_shade *shade);
