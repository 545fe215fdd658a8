#include "tools/track/patch.h"

#include <math.h>

#include "inside/number.h"

enum { MOST_STEPS = 25, WIDE_SIDE = CS_PATCH_SIDE + 2 };

#define SETTLED 0.002        /* pixels: a step shorter than this is the last one */
#define LONGEST_STEP 3.0     /* pixels */
#define LEAST_DEVIATION 1e-3 /* for values in 0..1; a flatter patch is noise */

/* ---------------------------------------------------------------- sampling */

/* Whether a square of `radius` around the place lies in the picture, including the pixels that are
 * blended in on its right and below it. */
static bool is_inside(const cs_grey *grey, const cs_patch_place *place, int radius) {
  double dx = (fabs(place->a) + fabs(place->b)) * radius;
  double dy = (fabs(place->c) + fabs(place->d)) * radius;
  return place->x - dx >= 0 && place->x + dx < grey->width - 1 && place->y - dy >= 0 &&
         place->y + dy < grey->height - 1;
}

/* The value at a place inside the picture, mixed of four pixels. */
static float sample(const cs_grey *grey, double x, double y) {
  int32_t column = (int32_t)x, row = (int32_t)y;
  float u = (float)(x - column), v = (float)(y - row);
  const float *upper = grey->values + (size_t)row * (size_t)grey->width + column;
  const float *lower = upper + grey->width;
  float above = upper[0] + u * (upper[1] - upper[0]);
  float below = lower[0] + u * (lower[1] - lower[0]);
  return above + v * (below - above);
}

/* A square of pixels at a place inside the picture. */
static void sample_square(const cs_grey *grey, const cs_patch_place *place, int radius,
                          float *out) {
  for (int v = -radius; v <= radius; v++)
    for (int u = -radius; u <= radius; u++)
      *out++ = sample(grey, place->x + place->a * u + place->b * v,
                      place->y + place->c * u + place->d * v);
}

/* Subtracts the mean from the values of a patch; returns their deviation. */
static double centre_values(float *values) {
  double sum = 0, squares = 0;
  for (int i = 0; i < CS_PATCH_COUNT; i++)
    sum += (double)values[i];
  float mean = (float)(sum / CS_PATCH_COUNT);
  for (int i = 0; i < CS_PATCH_COUNT; i++) {
    values[i] -= mean;
    squares += (double)(values[i] * values[i]);
  }
  return sqrt(squares / CS_PATCH_COUNT);
}

/* ---------------------------------------------------------------- a patch */

/* wide: the patch with a border of one pixel. */
static void take_values(const float *wide, cs_patch *out) {
  for (int v = 0; v < CS_PATCH_SIDE; v++)
    for (int u = 0; u < CS_PATCH_SIDE; u++) {
      const float *at = wide + (v + 1) * WIDE_SIDE + u + 1;
      int i = v * CS_PATCH_SIDE + u;
      out->value[i] = at[0];
      out->slope_x[i] = (at[1] - at[-1]) / 2;
      out->slope_y[i] = (at[WIDE_SIDE] - at[-WIDE_SIDE]) / 2;
    }
}

/* False if all slopes have the same direction, so that the patch would slide along it. */
static bool invert_slopes(cs_patch *patch) {
  double xx = 0, xy = 0, yy = 0;
  for (int i = 0; i < CS_PATCH_COUNT; i++) {
    double x = (double)patch->slope_x[i], y = (double)patch->slope_y[i];
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  double determinant = xx * yy - xy * xy, trace = xx + yy;
  if (!(determinant > 1e-4 * trace * trace) || trace < 1e-6)
    return false;
  patch->inverse[0] = yy / determinant;
  patch->inverse[1] = -xy / determinant;
  patch->inverse[2] = xx / determinant;
  return true;
}

bool cs_patch_take(const cs_grey *grey, const cs_patch_place *place, cs_patch *out) {
  float wide[WIDE_SIDE * WIDE_SIDE];
  if (!is_inside(grey, place, CS_PATCH_RADIUS + 1))
    return false;
  sample_square(grey, place, CS_PATCH_RADIUS + 1, wide);
  take_values(wide, out);
  out->deviation = centre_values(out->value);
  return out->deviation > LEAST_DEVIATION && invert_slopes(out);
}

/* ---------------------------------------------------------------- finding it */

/* The step that makes the pixels more similar, in pixels of the patch. gain: the factor from the
 * contrast of the picture at this place to that of the patch. */
static void find_step(const cs_patch *patch, const float *there, double gain, double step[2]) {
  double x = 0, y = 0;
  for (int i = 0; i < CS_PATCH_COUNT; i++) {
    double error = gain * (double)there[i] - (double)patch->value[i];
    x += (double)patch->slope_x[i] * error;
    y += (double)patch->slope_y[i] * error;
  }
  step[0] = patch->inverse[0] * x + patch->inverse[1] * y;
  step[1] = patch->inverse[1] * x + patch->inverse[2] * y;
  double length = cs_number_length(step[0], step[1]);
  if (length > LONGEST_STEP) {
    step[0] *= LONGEST_STEP / length;
    step[1] *= LONGEST_STEP / length;
  }
}

static double correlation(const cs_patch *patch, const float *there, double deviation) {
  double sum = 0;
  for (int i = 0; i < CS_PATCH_COUNT; i++)
    sum += (double)(patch->value[i] * there[i]);
  return sum / (CS_PATCH_COUNT * patch->deviation * deviation);
}

bool cs_patch_find(const cs_patch *patch, const cs_grey *grey, cs_patch_place *place,
                   double *likeness) {
  float there[CS_PATCH_COUNT];
  for (int i = 0; i < MOST_STEPS; i++) {
    if (!is_inside(grey, place, CS_PATCH_RADIUS))
      return false;
    sample_square(grey, place, CS_PATCH_RADIUS, there);
    double deviation = centre_values(there), step[2];
    if (deviation < LEAST_DEVIATION)
      return false;
    *likeness = correlation(patch, there, deviation);
    find_step(patch, there, patch->deviation / deviation, step);
    place->x -= place->a * step[0] + place->b * step[1];
    place->y -= place->c * step[0] + place->d * step[1];
    if (cs_number_length(step[0], step[1]) < SETTLED)
      return true;
  }
  return *likeness > 0.9; /* it oscillates around the place by less than matters */
}

/* The similarity of a patch and the pixels at a place; -1 if the place is not in the picture, or
 * its pixels are flat. */
static double likeness_at(const cs_patch *patch, const cs_grey *grey, const cs_patch_place *place) {
  float there[CS_PATCH_COUNT];
  if (!is_inside(grey, place, CS_PATCH_RADIUS))
    return -1;
  sample_square(grey, place, CS_PATCH_RADIUS, there);
  double deviation = centre_values(there);
  return deviation < LEAST_DEVIATION ? -1 : correlation(patch, there, deviation);
}

void cs_patch_search(const cs_patch *patch, const cs_grey *grey, int radius, cs_patch_place *place,
                     double *likeness) {
  const cs_patch_place middle = *place;
  *likeness = -1;
  for (int dy = -radius; dy <= radius; dy++)
    for (int dx = -radius; dx <= radius; dx++) {
      cs_patch_place at = middle;
      at.x += dx;
      at.y += dy;
      double alike = likeness_at(patch, grey, &at);
      if (alike > *likeness) {
        *likeness = alike;
        *place = at;
      }
    }
}
