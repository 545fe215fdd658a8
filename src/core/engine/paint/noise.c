#include "engine/paint/noise.h"

#include "base/number.h"

#include <math.h>

/* How much is shown of an octave. */
typedef struct view {
  double none, whole; /* pixels: octaves with cells of the first size are left out, those of the
                         second are whole */
  /* the mean of their part of the sum, for a whole `at`, and what it has more half way to the next;
     measured with 1e7 points */
  float mean, more;
} view;

/* Absolute values have folds, and so higher frequencies: energy above those that pixels can show is
 * below 1 % of the whole in all kinds. */
static view view_of(celspan_noise_kind kind) {
  return kind == CELSPAN_NOISE_TURBULENCE ? (view){5, 10, 0.2491f, 0.0339f}
         : kind == CELSPAN_NOISE_CELLS    ? (view){3, 6, 0.5295f, -0.0188f}
                                          : (view){2, 4, 0, 0};
}

typedef struct row {
  double u[CS_NOISE_PLACES], v[CS_NOISE_PLACES]; /* cells of the first octave */
  double side[CS_NOISE_PLACES]; /* a cell's side on the film, pixels; below 0 behind the horizon */
  float strength[CS_NOISE_PLACES]; /* the strength of the current octave */
  float values[CS_NOISE_PLACES], sum[CS_NOISE_PLACES];
  cs_noise_places places;
} row;

/* The side of a cell in pixels, by the greatest stretch from pixels to cells; 0 where cells are too
 * small for a number. */
static double side_of(double ux, double uy, double vx, double vy) {
  double xx = ux * ux + vx * vx, yy = uy * uy + vy * vy, xy = ux * uy + vx * vy;
  double side = 1 / sqrt(0.5 * (xx + yy + sqrt((xx - yy) * (xx - yy) + 4 * xy * xy)));
  return side > 0 ? side : 0;
}

static void place_affine(const cs_shade *shade, const double *x, int32_t count, double y,
                         row *out) {
  const double *p = shade->plane[0], *q = shade->plane[1];
  double side = side_of(p[0], p[1], q[0], q[1]);
  for (int32_t k = 0; k < count; k++) {
    out->u[k] = p[0] * x[k] + (p[1] * y + p[2]);
    out->v[k] = q[0] * x[k] + (q[1] * y + q[2]);
    out->side[k] = side;
  }
}

static void place_tilted(const cs_shade *shade, const double *x, int32_t count, double y,
                         row *out) {
  const double *p = shade->plane[0], *q = shade->plane[1], *m = shade->inverse.m + 6;
  for (int32_t k = 0; k < count; k++) {
    double w = m[0] * x[k] + (m[1] * y + m[2]);
    double u = (p[0] * x[k] + (p[1] * y + p[2])) / w, v = (q[0] * x[k] + (q[1] * y + q[2])) / w;
    out->u[k] = w > 0 ? u : 0;
    out->v[k] = w > 0 ? v : 0;
    out->side[k] =
        w > 0 ? w * side_of(p[0] - u * m[0], p[1] - u * m[1], q[0] - v * m[0], q[1] - v * m[1])
              : -1;
  }
}

/* Fills the places after the last one with it, up to a whole register. */
static int32_t fill_up(int32_t count, row *r) {
  int32_t end = count;
  for (; end % CS_NOISE_LANES != 0; end++) {
    r->u[end] = r->u[count - 1];
    r->v[end] = r->v[count - 1];
    r->side[end] = r->side[count - 1];
  }
  return end;
}

/* Sets the strengths of an octave, which are 1 where there is no view; false where it is too fine
 * at all places. */
static bool set_strength(const view *seen, double scale, int32_t count, row *r) {
  float most = 0;
  for (int32_t k = 0; k < count; k++) {
    double share = 1;
    if (seen)
      share = (r->side[k] / scale - seen->none) / (seen->whole - seen->none);
    r->strength[k] = (float)cs_number_most(cs_number_least(share, 1), 0);
    most = r->strength[k] > most ? r->strength[k] : most;
  }
  return most > 0;
}

/* The values of one octave. */
static void find_values(const cs_noise *noise, const cs_noise_octave *octave, int32_t count,
                        row *r) {
  cs_isa isa = cs_isa_best();
  cs_noise_places *to = &r->places;
  double at[CS_NOISE_LANES] = {noise->at};
  int32_t cells[CS_NOISE_LANES];
  float places[CS_NOISE_LANES];
  double scale = octave->scale;
  CS_WIDE_CHOOSE(isa, cs_noise_split)(at, CS_NOISE_LANES, scale, 0, cells, places);
  to->z = cells[0];
  to->w = places[0];
  to->seed = octave->seed;
  CS_WIDE_CHOOSE(isa, cs_noise_split)(r->u, count, scale, octave->shift_x, to->x, to->u);
  CS_WIDE_CHOOSE(isa, cs_noise_split)(r->v, count, scale, octave->shift_y, to->y, to->v);
  CS_WIDE_CHOOSE(isa, cs_noise_values)(noise->kind, to, count, r->values);
}

static void add_octave(const cs_noise *noise, int index, float gain, int32_t count, row *r) {
  const cs_noise_octave octave = cs_noise_octave_of(noise, index);
  const view seen = view_of(noise->kind);
  double place = noise->at * octave.scale;
  float off = (float)fabs(2 * (place - floor(place)) - 1), mean = seen.mean + seen.more * (1 - off);
  bool is_seen = set_strength(noise->fades ? &seen : NULL, octave.scale, count, r);
  if (is_seen)
    find_values(noise, &octave, count, r);
  for (int32_t k = 0; k < count; k++) {
    float value = is_seen ? r->values[k] : mean;
    value = seen.mean > 0 ? fabsf(value) : value;
    r->sum[k] += gain * (mean + r->strength[k] * (value - mean));
  }
}

/* count: at most CS_NOISE_PLACES. */
static void find(const cs_shade *shade, const double *x, int32_t count, double y, double *at) {
  const cs_noise *noise = &shade->texture->variation->noise;
  bool is_sum = view_of(noise->kind).mean > 0;
  double gain = 1;
  row r;
  if (shade->is_affine)
    place_affine(shade, x, count, y, &r);
  else
    place_tilted(shade, x, count, y, &r);
  int32_t filled = fill_up(count, &r);
  memset(r.sum, 0, sizeof r.sum);
  for (int i = 0; i < noise->octaves; i++, gain *= noise->gain)
    add_octave(noise, i, (float)gain, filled, &r);
  for (int32_t k = 0; k < count; k++) {
    double sum = is_sum ? (double)r.sum[k] : 0.5 + 0.5 * (double)r.sum[k];
    at[k] = r.side[k] >= 0 ? cs_number_clamp(sum, 0, 1) : NAN;
  }
}

void cs_noise_at(const cs_shade *shade, const double *x, int32_t count, double y, double *at) {
  for (int32_t k = 0; k < count; k += CS_NOISE_PLACES) {
    const int32_t left = count - k;
    find(shade, x + k, left < CS_NOISE_PLACES ? left : CS_NOISE_PLACES, y, at + k);
  }
}
