/* A pixel's sample, by how its footprint lies on the picture:
 *
 *   copy     whole-pixel placement at scale 1: the texels themselves
 *   nearest  asked for: the texel under the pixel's centre
 *   cubic    asked for and not shrunk: Catmull-Rom, held to the range of its sixteen texels
 *   box      rows stay rows or become columns: the exact mean over the footprint, at least one
 *            texel a side, which is linear interpolation when the picture is enlarged
 *   tilted   all else: the mean of taps spread over the pixel, each interpolated
 *
 * All sums are taken about one texel, so a constant picture stays what it is to the bit.
 */
#include "compose/sampler.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "base/vector.h"
#include "compose/texels.h"
#include "scene/picture_levels.h"

/* Of a texel: closer is the same place. Matrices carry rounding, pictures have 2^20 pixels. */
#define SAME_PLACE 1e-6
#define SAME_SCALE 1e-12

/* Texels of the chosen level across the shorter side of a footprint: at least so many, and less
 * than twice that. More are exacter at the edges of a footprint, and slower. */
#define BOX_TEXELS 4
#define TAP_TEXELS 2
#define MOST_BOX 64
#define MOST_TAPS 16

typedef struct footprint {
  double u, v;   /* the centre, in picture pixels */
  double ux, vx; /* what a pixel to the right adds */
  double uy, vy; /* what a pixel down adds */
} footprint;

typedef struct sampler_run {
  const cs_sampler *sampler;
  cs_texels texels;
  int level_count;
} sampler_run;

/* ---------------------------------------------------------------- places */

static int32_t wrap(int32_t i, int32_t size, celspan_wrap mode) {
  if (i >= 0 && i < size)
    return i;
  if (mode != CELSPAN_WRAP_REPEAT)
    return i < 0 ? 0 : size - 1;
  int32_t rest = i % size;
  return rest < 0 ? rest + size : rest;
}

static double bring_axis(double u, int32_t size, celspan_wrap mode) {
  if (u >= 0 && u < size)
    return u;
  return mode == CELSPAN_WRAP_REPEAT ? u - floor(u / size) * size : cs_number_clamp(u, -1e9, 1e9);
}

/* Repeated pictures are sampled near their own origin, so far tiles cost no precision. Afterwards
 * both coordinates fit an int32_t. */
static void bring_home(const cs_sampler *sampler, double *u, double *v) {
  *u = bring_axis(*u, sampler->width, sampler->wrap);
  *v = bring_axis(*v, sampler->height, sampler->wrap);
}

/* floor of what fits, without a call. */
static int32_t floor_near(double x) {
  int32_t whole = (int32_t)x;
  return whole - (x < whole);
}

static bool is_outside(const cs_sampler *sampler, double u, double v) {
  return sampler->wrap == CELSPAN_WRAP_CLEAR &&
         !(u >= -SAME_PLACE && u < sampler->width - SAME_PLACE && v >= -SAME_PLACE &&
           v < sampler->height - SAME_PLACE);
}

/* The texel left of or at u - 1/2 and the share of its right neighbour. */
static int32_t split(double u, float *share) {
  int32_t left = floor_near(u - 0.5 + SAME_PLACE);
  double rest = u - 0.5 - left;
  *share = rest < SAME_PLACE ? 0.0f : (float)rest;
  return left;
}

/* ---------------------------------------------------------------- kernels */

static cs_v4 lerp(cs_v4 a, cs_v4 b, float share) { return a + share * (b - a); }

static void sample_nearest(sampler_run *run, double u, double v, float rgba[4]) {
  const cs_sampler *s = run->sampler;
  int32_t x = wrap(floor_near(u + SAME_PLACE), s->width, s->wrap);
  int32_t y = wrap(floor_near(v + SAME_PLACE), s->height, s->wrap);
  memcpy(rgba, cs_texels_at(&run->texels, 0, x, y), 4 * sizeof(float));
}

/* Four texels of a level, wrapped; most quads lie inside one block. */
static void fetch_quad(sampler_run *run, int level, int32_t x, int32_t y, cs_v4 quad[4]) {
  const cs_sampler *s = run->sampler;
  int32_t width = cs_levels_size(s->width, level), height = cs_levels_size(s->height, level);
  if (x >= 0 && y >= 0 && x + 1 < width && y + 1 < height &&
      x % CS_PICTURE_BLOCK < CS_PICTURE_BLOCK - 1 && y % CS_PICTURE_BLOCK < CS_PICTURE_BLOCK - 1) {
    const float *at = cs_texels_at(&run->texels, level, x, y);
    quad[0] = cs_v4_load(at);
    quad[1] = cs_v4_load(at + 4);
    quad[2] = cs_v4_load(at + 4 * CS_PICTURE_BLOCK);
    quad[3] = cs_v4_load(at + 4 * CS_PICTURE_BLOCK + 4);
    return;
  }
  for (int i = 0; i < 4; i++)
    quad[i] = cs_v4_load(cs_texels_at(&run->texels, level, wrap(x + i % 2, width, s->wrap),
                                      wrap(y + i / 2, height, s->wrap)));
}

static cs_v4 tap_linear(sampler_run *run, int level, double u, double v) {
  float across, down;
  double scale = 1.0 / (double)((int64_t)1 << level);
  int32_t x = split(u * scale, &across), y = split(v * scale, &down);
  cs_v4 quad[4];
  fetch_quad(run, level, x, y, quad);
  return lerp(lerp(quad[0], quad[1], across), lerp(quad[2], quad[3], across), down);
}

/* Catmull-Rom weights: interpolating, so that scale 1 gives the texels back. */
static void cubic_weights(float t, float weights[4]) {
  float t2 = t * t, t3 = t2 * t;
  weights[0] = 0.5f * (2 * t2 - t3 - t);
  weights[1] = 0.5f * (3 * t3 - 5 * t2 + 2);
  weights[2] = 0.5f * (4 * t2 - 3 * t3 + t);
  weights[3] = 0.5f * (t3 - t2);
}

/* Held to the range of the texels under the kernel: its negative lobes make no light or dark of
 * their own. */
static void sample_cubic(sampler_run *run, double u, double v, float rgba[4]) {
  const cs_sampler *s = run->sampler;
  float across, down, wx[4], wy[4];
  int32_t x = split(u, &across), y = split(v, &down);
  cubic_weights(across, wx);
  cubic_weights(down, wy);
  cs_v4 texels[16], sum = {0};
  for (int i = 0; i < 16; i++) {
    texels[i] = cs_v4_load(cs_texels_at(&run->texels, 0, wrap(x - 1 + i % 4, s->width, s->wrap),
                                        wrap(y - 1 + i / 4, s->height, s->wrap)));
    sum += wx[i % 4] * wy[i / 4] * (texels[i] - texels[0]);
  }
  sum += texels[0];
  for (int c = 0; c < 4; c++) {
    float low = texels[0][c], high = low;
    for (int i = 1; i < 16; i++) {
      low = texels[i][c] < low ? texels[i][c] : low;
      high = texels[i][c] > high ? texels[i][c] : high;
    }
    rgba[c] = cs_number_clampf(sum[c], low, high);
  }
}

/* ---------------------------------------------------------------- the box */

/* One axis of a box at a level: texels and how many pixels of each it covers. */
typedef struct extent {
  int32_t first, count;
  float weights[2 * MOST_BOX + 4];
} extent;

static void cut_extent(double centre, double width, int32_t size, int level, bool is_cut,
                       extent *out) {
  double low = centre - 0.5 * width, high = low + width, side = (double)((int64_t)1 << level);
  if (is_cut) {
    low = cs_number_clamp(low, 0, size);
    high = cs_number_clamp(high, 0, size);
  }
  /* Within SAME_PLACE of a texel's edge the neighbour is not touched. */
  int32_t first = floor_near((low + SAME_PLACE) / side);
  int32_t last = -floor_near((SAME_PLACE - high) / side);
  out->first = first;
  out->count = last > first ? last - first : 1;
  for (int32_t i = 0; i < out->count; i++) {
    double left = i ? (first + i) * side : low;
    double right = i + 1 < out->count ? (first + i + 1) * side : high;
    out->weights[i] = right > left ? (float)(right - left) : 1.0f;
  }
}

/* Whether the texels lie inside the picture and in one row or column of blocks. */
static bool is_in_block(const extent *e, int32_t size) {
  int32_t last = e->first + e->count - 1;
  return e->first >= 0 && last < size && e->first / CS_PICTURE_BLOCK == last / CS_PICTURE_BLOCK;
}

typedef struct box_sum {
  cs_v4 first, sum; /* the first texel, and the weighted differences of all from it */
  float total;
} box_sum;

static void sum_block(sampler_run *run, int level, const extent *across, const extent *down,
                      box_sum *box) {
  const float *corner = cs_texels_at(&run->texels, level, across->first, down->first);
  cs_v4 first = cs_v4_load(corner), sum = {0};
  float total = 0;
  for (int32_t j = 0; j < down->count; j++)
    for (int32_t i = 0; i < across->count; i++) {
      float weight = across->weights[i] * down->weights[j];
      sum += weight * (cs_v4_load(corner + 4 * (j * CS_PICTURE_BLOCK + i)) - first);
      total += weight;
    }
  *box = (box_sum){first, sum, total};
}

static void sum_anywhere(sampler_run *run, int level, const extent *across, const extent *down,
                         box_sum *box) {
  const cs_sampler *s = run->sampler;
  int32_t width = cs_levels_size(s->width, level), height = cs_levels_size(s->height, level);
  *box = (box_sum){0};
  for (int32_t j = 0; j < down->count; j++)
    for (int32_t i = 0; i < across->count; i++) {
      cs_v4 texel =
          cs_v4_load(cs_texels_at(&run->texels, level, wrap(across->first + i, width, s->wrap),
                                  wrap(down->first + j, height, s->wrap)));
      float weight = across->weights[i] * down->weights[j];
      if (i == 0 && j == 0)
        box->first = texel;
      box->sum += weight * (texel - box->first);
      box->total += weight;
    }
}

static void average(sampler_run *run, int level, const extent *across, const extent *down,
                    float rgba[4]) {
  const cs_sampler *s = run->sampler;
  box_sum box;
  if (is_in_block(across, cs_levels_size(s->width, level)) &&
      is_in_block(down, cs_levels_size(s->height, level)))
    sum_block(run, level, across, down, &box);
  else
    sum_anywhere(run, level, across, down, &box);
  cs_v4_store(rgba, box.first + box.sum / box.total);
}

/* The level at which `shorter` is `texels` or more, or a higher one if `longer` is too long there.
 */
static int choose_level(const sampler_run *run, double shorter, double longer, double texels,
                        double most) {
  int level = 0;
  while (level + 1 < run->level_count && (shorter >= 2 * texels || longer > most)) {
    level++;
    shorter *= 0.5;
    longer *= 0.5;
  }
  return level;
}

static void sample_box(sampler_run *run, const footprint *f, float rgba[4]) {
  const cs_sampler *s = run->sampler;
  double wide = fabs(f->ux) + fabs(f->uy), high = fabs(f->vx) + fabs(f->vy);
  wide = wide > 1 + SAME_PLACE ? wide : 1;
  high = high > 1 + SAME_PLACE ? high : 1;
  if (wide == 1 && high == 1) {
    cs_v4_store(rgba, tap_linear(run, 0, f->u, f->v));
    return;
  }
  int level =
      choose_level(run, wide < high ? wide : high, wide < high ? high : wide, BOX_TEXELS, MOST_BOX);
  /* A box far larger than the picture is the picture. */
  bool is_cut = s->wrap != CELSPAN_WRAP_REPEAT;
  double most = (double)((int64_t)MOST_BOX << level);
  extent across, down;
  cut_extent(f->u, wide < most ? wide : most, s->width, level, is_cut, &across);
  cut_extent(f->v, high < most ? high : most, s->height, level, is_cut, &down);
  average(run, level, &across, &down, rgba);
}

/* ---------------------------------------------------------------- the tilted footprint */

static int taps_along(double length, int level) {
  double taps = ceil(length / (double)((int64_t)1 << level) - SAME_PLACE);
  return (int)cs_number_clamp(taps, 1, MOST_TAPS);
}

static void sample_tilted(sampler_run *run, const footprint *f, float rgba[4]) {
  double right = sqrt(f->ux * f->ux + f->vx * f->vx), below = sqrt(f->uy * f->uy + f->vy * f->vy);
  int level = choose_level(run, right < below ? right : below, right < below ? below : right,
                           TAP_TEXELS, MOST_TAPS);
  int columns = taps_along(right, level), rows = taps_along(below, level);
  cs_v4 first = {0}, sum = {0};
  for (int j = 0; j < rows; j++)
    for (int i = 0; i < columns; i++) {
      double x = (i + 0.5) / columns - 0.5, y = (j + 0.5) / rows - 0.5;
      double u = f->u + x * f->ux + y * f->uy, v = f->v + x * f->vx + y * f->vy;
      bring_home(run->sampler, &u, &v);
      cs_v4 tap = tap_linear(run, level, u, v);
      if (i == 0 && j == 0)
        first = tap;
      sum += tap - first;
    }
  cs_v4_store(rgba, first + sum / (float)(columns * rows));
}

/* ---------------------------------------------------------------- runs */

/* The footprint of the pixel centred at (x, y); false at or behind the horizon. */
static bool map_pixel(const double m[9], double x, double y, footprint *out) {
  double w = m[6] * x + m[7] * y + m[8];
  if (!(w > 0))
    return false;
  double u = (m[0] * x + m[1] * y + m[2]) / w, v = (m[3] * x + m[4] * y + m[5]) / w;
  out->u = u;
  out->v = v;
  out->ux = (m[0] - u * m[6]) / w;
  out->vx = (m[3] - v * m[6]) / w;
  out->uy = (m[1] - u * m[7]) / w;
  out->vy = (m[4] - v * m[7]) / w;
  double largest =
      fabs(u) + fabs(v) + fabs(out->ux) + fabs(out->vx) + fabs(out->uy) + fabs(out->vy);
  return largest < 1e15;
}

static bool is_enlarged(const footprint *f) {
  double wide = fabs(f->ux) + fabs(f->uy), high = fabs(f->vx) + fabs(f->vy);
  double right = f->ux * f->ux + f->vx * f->vx, below = f->uy * f->uy + f->vy * f->vy;
  const double most = 1 + SAME_PLACE;
  return (wide <= most && high <= most) || (right <= most && below <= most);
}

static bool is_square_on(const footprint *f) {
  double kept = fabs(f->ux) + fabs(f->vy), crossed = fabs(f->vx) + fabs(f->uy);
  return crossed <= SAME_SCALE * kept || kept <= SAME_SCALE * crossed;
}

static void sample_pixel(sampler_run *run, footprint f, float rgba[4]) {
  const cs_sampler *s = run->sampler;
  if (is_outside(s, f.u, f.v)) {
    memset(rgba, 0, 4 * sizeof(float));
    return;
  }
  bring_home(s, &f.u, &f.v);
  if (s->sampling == CELSPAN_SAMPLING_NEAREST)
    sample_nearest(run, f.u, f.v, rgba);
  else if (s->sampling == CELSPAN_SAMPLING_BICUBIC && is_enlarged(&f))
    sample_cubic(run, f.u, f.v, rgba);
  else if (is_square_on(&f))
    sample_box(run, &f, rgba);
  else
    sample_tilted(run, &f, rgba);
}

static bool is_copy(const double m[9]) {
  return fabs(m[0] - 1) <= SAME_SCALE && fabs(m[4] - 1) <= SAME_SCALE && fabs(m[1]) <= SAME_SCALE &&
         fabs(m[3]) <= SAME_SCALE && fabs(m[2] - rint(m[2])) <= SAME_PLACE &&
         fabs(m[5] - rint(m[5])) <= SAME_PLACE && fabs(m[2]) < 1e9 && fabs(m[5]) < 1e9;
}

static int32_t smaller(int32_t a, int32_t b) { return a < b ? a : b; }

/* `count` texels of row v from u on, both wherever. */
static void copy_texels(sampler_run *run, int64_t u, int64_t v, int32_t count, float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  bool is_clear = s->wrap == CELSPAN_WRAP_CLEAR, repeats = s->wrap == CELSPAN_WRAP_REPEAT;
  if (repeats)
    v = ((v % s->height) + s->height) % s->height;
  bool is_row_outside = v < 0 || v >= s->height;
  int32_t y = v < 0 ? 0 : v >= s->height ? s->height - 1 : (int32_t)v;
  for (int32_t done = 0, part; done < count; done += part) {
    int64_t at = u + done;
    if (repeats)
      at = ((at % s->width) + s->width) % s->width;
    bool is_inside = at >= 0 && at < s->width;
    if (is_inside && !(is_clear && is_row_outside)) {
      int32_t x = (int32_t)at, in_block = CS_PICTURE_BLOCK - x % CS_PICTURE_BLOCK;
      part = smaller(smaller(in_block, s->width - x), count - done);
      memcpy(rgba + done, cs_texels_at(&run->texels, 0, x, y), (size_t)part * sizeof *rgba);
      continue;
    }
    part = 1;
    if (is_clear)
      memset(rgba + done, 0, sizeof *rgba);
    else
      memcpy(rgba + done, cs_texels_at(&run->texels, 0, at < 0 ? 0 : s->width - 1, y),
             sizeof *rgba);
  }
}

/* Affine maps: the footprint is the same everywhere, and so is the row's share of the centre. */
static void sample_affine(sampler_run *run, const double m[9], int32_t x0, int32_t count, double y,
                          float (*rgba)[4]) {
  footprint f = {.ux = m[0], .vx = m[3], .uy = m[1], .vy = m[4]};
  double row_u = m[1] * y + m[2], row_v = m[4] * y + m[5];
  bool is_linear = run->sampler->sampling <= CELSPAN_SAMPLING_BILINEAR &&
                   run->sampler->sampling != CELSPAN_SAMPLING_NEAREST && is_enlarged(&f);
  for (int32_t i = 0; i < count; i++) {
    double x = (double)x0 + i + 0.5;
    f.u = m[0] * x + row_u;
    f.v = m[3] * x + row_v;
    if (is_linear && !is_outside(run->sampler, f.u, f.v)) {
      double u = f.u, v = f.v;
      bring_home(run->sampler, &u, &v);
      cs_v4_store(rgba[i], tap_linear(run, 0, u, v));
    } else {
      sample_pixel(run, f, rgba[i]);
    }
  }
}

static void sample_perspective(sampler_run *run, const double m[9], int32_t x0, int32_t count,
                               double y, float (*rgba)[4]) {
  for (int32_t i = 0; i < count; i++) {
    footprint f;
    if (map_pixel(m, (double)x0 + i + 0.5, y, &f))
      sample_pixel(run, f, rgba[i]);
    else
      memset(rgba[i], 0, sizeof *rgba);
  }
}

celspan_status cs_sampler_run(celspan_context *context, const cs_sampler *sampler, int32_t x0,
                              int32_t count, double y, float (*rgba)[4]) {
  sampler_run run = {.sampler = sampler};
  run.level_count = cs_levels_count(sampler->width, sampler->height);
  cs_texels_begin(&run.texels, context, sampler->picture);
  double m[9];
  memcpy(m, sampler->inverse.m, sizeof m);
  bool is_affine = m[6] == 0 && m[7] == 0 && m[8] > 0;
  if (is_affine)
    for (int i = 0; i < 9; i++)
      m[i] /= sampler->inverse.m[8];
  if (is_affine && is_copy(m))
    copy_texels(&run, x0 + (int64_t)rint(m[2]), (int64_t)floor(y + rint(m[5])), count, rgba);
  else if (is_affine)
    sample_affine(&run, m, x0, count, y, rgba);
  else
    sample_perspective(&run, m, x0, count, y, rgba);
  return cs_texels_end(&run.texels);
}
