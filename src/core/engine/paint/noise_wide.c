/* The values of noise, a register of places at a time: see noise.h. */
#include "engine/paint/noise.h"

/* Added to a number and taken away, it leaves the nearest whole number, which is in the lower bits
 * of the sum. */
#define ROUNDING 0x1.8p52

typedef uint32_t words __attribute__((vector_size(4 * CS_WIDE_LANES)));

void CS_WIDE(cs_noise_split)(const double *restrict at, int32_t count, double scale, double shift,
                             int32_t *restrict cells, float *restrict places) {
#pragma omp simd
  for (int32_t k = 0; k < count; k++) {
    double x = at[k] * scale + shift;
    x = !(x > -CS_NOISE_FARTHEST) ? -CS_NOISE_FARTHEST
        : x > CS_NOISE_FARTHEST   ? CS_NOISE_FARTHEST
                                  : x;
    double sum = x + ROUNDING;
    float rest = (float)(x - (sum - ROUNDING));
    int64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    cells[k] = (int32_t)((uint32_t)bits - (rest < 0));
    places[k] = rest < 0 ? rest + 1 : rest;
  }
}

/* ---------------------------------------------------------------- words */

static inline words load_words(const int32_t *from) {
  words v;
  memcpy(&v, from, sizeof v);
  return v;
}

/* Mixes the bits of a word (Wellons, "Prospecting for hash functions", 2018: lowbias32). */
static inline words mix(words h) {
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  return h ^ h >> 16;
}

/* The sign of x where the bit `bit` of a word is set, counted from the left, turned round. */
static inline cs_wide turn(words h, int bit, cs_wide x) {
  return (cs_wide)((words)x ^ (h << bit & 0x80000000u));
}

static inline cs_wide fade(cs_wide t) { return t * t * t * (t * (t * 6 - 15) + 10); }

static inline cs_wide blend(cs_wide a, cs_wide b, cs_wide share) { return a + share * (b - a); }

/* ---------------------------------------------------------------- corners */

/* A word as a number from -1 to 1. */
static inline cs_wide number_of(words h) {
  return __builtin_convertvector((cs_wide_int)h, cs_wide) * 0x1p-31f;
}

/* The value at a corner of which the point is (x, y, z) away. */
static inline cs_wide corner(celspan_noise_kind kind, words h, cs_wide x, cs_wide y, float z) {
  h = mix(h);
  if (kind == CELSPAN_NOISE_VALUE)
    return number_of(h);
  cs_wide_int is_steep = (cs_wide_int)h < 0;
  cs_wide along = cs_wide_choose(is_steep, cs_wide_all((float)CS_NOISE_SHORT),
                                 cs_wide_all((float)CS_NOISE_LONG));
  cs_wide across = cs_wide_choose(is_steep, cs_wide_all((float)CS_NOISE_LONG),
                                  cs_wide_all((float)CS_NOISE_SHORT));
  return turn(h, 1, along * x) + turn(h, 2, across * y) + turn(h, 3, cs_wide_all(z));
}

/* The place of a register of points among the corners of their cells. */
typedef struct corners {
  words left, right, top, bottom; /* parts of the corners' words */
  cs_wide u, v, share_x, share_y;
} corners;

/* In the plane of corners with this z. */
static inline cs_wide plane(celspan_noise_kind kind, const corners *c, uint32_t z, float w) {
  cs_wide u = c->u, v = c->v;
  cs_wide above = blend(corner(kind, c->left ^ c->top ^ z, u, v, w),
                        corner(kind, c->right ^ c->top ^ z, u - 1, v, w), c->share_x);
  cs_wide below = blend(corner(kind, c->left ^ c->bottom ^ z, u, v - 1, w),
                        corner(kind, c->right ^ c->bottom ^ z, u - 1, v - 1, w), c->share_x);
  return blend(above, below, c->share_y);
}

/* For a whole `at` only one plane counts. kind: a constant of each caller. */
static inline void mix_corners(celspan_noise_kind kind, const cs_noise_places *in, int32_t count,
                               float *out) {
  uint32_t z = (uint32_t)in->z * CS_NOISE_Z, z_near = z ^ in->seed,
           z_far = (z + CS_NOISE_Z) ^ in->seed;
  float w = in->w;
  cs_wide share_z = fade(cs_wide_all(w));
  for (int32_t k = 0; k < count; k += CS_WIDE_LANES) {
    words x = load_words(in->x + k) * CS_NOISE_X, y = load_words(in->y + k) * CS_NOISE_Y;
    cs_wide u = cs_wide_load(in->u + k), v = cs_wide_load(in->v + k);
    corners c = {x, x + CS_NOISE_X, y, y + CS_NOISE_Y, u, v, fade(u), fade(v)};
    cs_wide value = plane(kind, &c, z_near, w);
    if (w != 0)
      value = blend(value, plane(kind, &c, z_far, w - 1), share_z);
    cs_wide_store(out + k, value);
  }
}

/* ---------------------------------------------------------------- points in cells */

/* The lesser of the squares `least` and that of the distance from a cell's point. dx, dy, dz: from
 * the place to the cell's corner. */
static inline cs_wide nearer(cs_wide least, words h, cs_wide dx, cs_wide dy, float dz) {
  h = mix(h);
  words other = h * CS_NOISE_X;
  cs_wide x = __builtin_convertvector((cs_wide_int)(h >> 16), cs_wide) * 0x1p-16f + dx;
  cs_wide y = __builtin_convertvector((cs_wide_int)(h & 0xffffu), cs_wide) * 0x1p-16f + dy;
  cs_wide z = __builtin_convertvector((cs_wide_int)(other >> 16), cs_wide) * 0x1p-16f + dz;
  return cs_wide_min(x * x + y * y + z * z, least);
}

/* Points beyond the cells around are at a distance of 1 or more. */
static inline void find_nearest(const cs_noise_places *in, int32_t count, float *out) {
  for (int32_t k = 0; k < count; k += CS_WIDE_LANES) {
    words x = load_words(in->x + k), y = load_words(in->y + k);
    cs_wide u = cs_wide_load(in->u + k), v = cs_wide_load(in->v + k), least = cs_wide_all(1);
    for (int i = 0; i < 27; i++) {
      int dx = i % 3 - 1, dy = i / 3 % 3 - 1, dz = i / 9 - 1;
      uint32_t z = ((uint32_t)in->z + (uint32_t)dz) * CS_NOISE_Z ^ in->seed;
      words h = ((x + (uint32_t)dx) * CS_NOISE_X) ^ ((y + (uint32_t)dy) * CS_NOISE_Y) ^ z;
      least = nearer(least, h, (float)dx - u, (float)dy - v, (float)dz - in->w);
    }
    cs_wide_store(out + k, cs_wide_sqrt(least));
  }
}

/* ---------------------------------------------------------------- one value for each cell */

static inline void read_cells(const cs_noise_places *in, int32_t count, float *out) {
  const uint32_t z = (uint32_t)in->z * CS_NOISE_Z ^ in->seed;
  for (int32_t k = 0; k < count; k += CS_WIDE_LANES) {
    words x = load_words(in->x + k) * CS_NOISE_X, y = load_words(in->y + k) * CS_NOISE_Y;
    cs_wide_store(out + k, number_of(mix(x ^ y ^ z)));
  }
}

void CS_WIDE(cs_noise_values)(celspan_noise_kind kind, const cs_noise_places *in, int32_t count,
                              float *out) {
  if (kind == CELSPAN_NOISE_CELLS)
    find_nearest(in, count, out);
  else if (kind == CELSPAN_NOISE_WHITE)
    read_cells(in, count, out);
  else if (kind == CELSPAN_NOISE_VALUE)
    mix_corners(CELSPAN_NOISE_VALUE, in, count, out);
  else
    mix_corners(CELSPAN_NOISE_PERLIN, in, count, out);
}
