/* Noise at a point, for the probe: in doubles, corner by corner, with all octaves. */
#include <math.h>

#include "base/number.h"
#include "model/scene/oracle.h"

typedef struct place {
  double x, y, z; /* cells of an octave */
  uint32_t seed;
} place;

/* A whole number of any size, modulo 2^32. */
static uint64_t wrapped(double whole) {
  double rest = whole - floor(whole / 0x1p32) * 0x1p32;
  return (uint64_t)rest;
}

static uint32_t word_at(double x, double y, double z, uint32_t seed) {
  uint64_t word =
      wrapped(x) * 0x9e3779b1 ^ wrapped(y) * 0x85ebca77 ^ wrapped(z) * 0xc2b2ae3d ^ seed;
  uint32_t h = (uint32_t)word;
  h = (h ^ h >> 16) * UINT32_C(0x7feb352d);
  h = (h ^ h >> 15) * UINT32_C(0x846ca68b);
  return h ^ h >> 16;
}

/* The share of the way between two corners. */
static double eased(double t) { return ((6 * t - 15) * t + 10) * t * t * t; }

static double signed_by(uint32_t word, int bit, double value) {
  return word >> bit & 1 ? -value : value;
}

/* From -1 to 1. */
static double number_of(uint32_t word) {
  return (word >= 0x80000000 ? (double)word - 0x1p32 : (double)word) / 0x1p31;
}

/* dx, dy, dz: from the corner to the point. */
static double corner_value(celspan_noise_kind kind, uint32_t word, double dx, double dy,
                           double dz) {
  if (kind == CELSPAN_NOISE_VALUE)
    return number_of(word);
  /* sqrt 2 times the cosine and the sine of half of 45 degrees */
  double longer = sqrt(1 + sqrt(0.5)), shorter = sqrt(1 - sqrt(0.5));
  bool is_steep = word >> 31;
  double along = is_steep ? shorter : longer, across = is_steep ? longer : shorter;
  return signed_by(word, 30, along * dx) + signed_by(word, 29, across * dy) +
         signed_by(word, 28, dz);
}

static double mixed_corners(celspan_noise_kind kind, const place *at) {
  double left = floor(at->x), top = floor(at->y), near = floor(at->z), sum = 0;
  double u = eased(at->x - left), v = eased(at->y - top), w = eased(at->z - near);
  for (int corner = 0; corner < 8; corner++) {
    int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    double weight = (i ? u : 1 - u) * (j ? v : 1 - v) * (k ? w : 1 - w);
    uint32_t word = word_at(left + i, top + j, near + k, at->seed);
    sum += weight * corner_value(kind, word, at->x - left - i, at->y - top - j, at->z - near - k);
  }
  return sum;
}

static double nearest_point(const place *at) {
  double least = 1;
  for (int cell = 0; cell < 27; cell++) {
    double x = floor(at->x) + cell % 3 - 1, y = floor(at->y) + cell / 3 % 3 - 1;
    double z = floor(at->z) + cell / 9 - 1;
    uint32_t word = word_at(x, y, z, at->seed), other = word * UINT32_C(0x9e3779b1);
    double dx = x + (word >> 16) / 65536.0 - at->x, dy = y + (word & 0xffff) / 65536.0 - at->y;
    double dz = z + (other >> 16) / 65536.0 - at->z;
    least = fmin(least, sqrt(dx * dx + dy * dy + dz * dz));
  }
  return least;
}

static double octave_value(celspan_noise_kind kind, const place *at) {
  if (kind == CELSPAN_NOISE_WHITE)
    return number_of(word_at(floor(at->x), floor(at->y), floor(at->z), at->seed));
  return kind == CELSPAN_NOISE_CELLS ? nearest_point(at) : mixed_corners(kind, at);
}

double cs_oracle_noise(const cs_noise *noise, celspan_point point) {
  double sum = 0, gain = 1;
  for (int i = 0; i < noise->octaves; i++, gain *= noise->gain) {
    cs_noise_octave octave = cs_noise_octave_of(noise, i);
    const place at = {point.x / noise->size * octave.scale + octave.shift_x,
                      point.y / noise->size * octave.scale + octave.shift_y,
                      noise->at * octave.scale, octave.seed};
    double value = octave_value(noise->kind, &at);
    sum += gain * (noise->kind == CELSPAN_NOISE_TURBULENCE ? fabs(value) : value);
  }
  bool is_sum = noise->kind == CELSPAN_NOISE_TURBULENCE || noise->kind == CELSPAN_NOISE_CELLS;
  return cs_number_clamp(is_sum ? sum : (1 + sum) / 2, 0, 1);
}
