/* The colours of pictures at pixels of the frame. */
#include "picture.h"

#include <math.h>

#define SAME 1e-6 /* texels: places nearer to each other are one */

/* Texels of a level across the shorter side of a footprint, at least, and across the longer one, at
 * most: of exact means, and of taps. */
enum { BOX_TEXELS = 4, BOX_MOST = 64, TAP_TEXELS = 2, TAPS_MOST = 16 };

/* ---------------------------------------------------------------- levels */

static int32_t size_of(uint32_t size, int level) {
  return (int32_t)((size + ((uint32_t)1 << level) - 1) >> level);
}

bool pf_picture_make(const pf_memory *memory, pf_picture *picture) {
  int32_t wide, high;
  do {
    int level = picture->level_count++;
    wide = size_of(picture->width, level);
    high = size_of(picture->height, level);
    picture->starts[level] = picture->texel_count;
    picture->texel_count += (size_t)wide * (size_t)high;
  } while (wide > 1 || high > 1);
  picture->texels = pf_make(memory, sizeof *picture->texels, picture->texel_count);
  return picture->texels != NULL;
}

/* Two neighbours of a level, of which the second one is not there at the end of an odd row, and its
 * weight in their mean: each counts by its pixels. */
typedef struct pair {
  int32_t first, second;
  float share;
} pair;

static pair find_pair(uint32_t size, int level, int32_t at) {
  int32_t count = size_of(size, level), first = 2 * at;
  double side = (double)(1 << level), left = (double)size - (first + 1) * side;
  left = left < side ? left : side;
  return first + 1 < count ? (pair){first, first + 1, (float)(left / (side + left))}
                           : (pair){first, first, 0};
}

static void fill_texel(const pf_picture *picture, int level, int32_t x, int32_t y, pf_texel *out) {
  const pf_texel *from = picture->texels + picture->starts[level - 1];
  int32_t wide = size_of(picture->width, level - 1);
  pair across = find_pair(picture->width, level - 1, x);
  pair down = find_pair(picture->height, level - 1, y);
  for (int c = 0; c < 4; c++) {
    float rows[2];
    for (int i = 0; i < 2; i++) {
      const pf_texel *row = from + (size_t)wide * (size_t)(i == 0 ? down.first : down.second);
      float left = row[across.first].light[c];
      rows[i] = left + across.share * (row[across.second].light[c] - left);
    }
    out->light[c] = rows[0] + down.share * (rows[1] - rows[0]);
  }
}

void pf_picture_fill(pf_picture *picture) {
  for (int level = 1; level < picture->level_count; level++) {
    pf_texel *out = picture->texels + picture->starts[level];
    for (int32_t y = 0; y < size_of(picture->height, level); y++)
      for (int32_t x = 0; x < size_of(picture->width, level); x++)
        fill_texel(picture, level, x, y, out++);
  }
}

/* ---------------------------------------------------------------- kernels */

typedef enum kernel { NEAREST, LINEAR, CUBIC, BOX } kernel;

/* What a sample is made of, along one axis: texels of a level and their weights. */
typedef struct extent {
  int32_t first, count;
  float weights[BOX_MOST + 2];
} extent;

typedef struct sampler {
  const pf_picture *picture;
  uint8_t wrap, filter;
  bool is_affine;
  kernel kernel;
  int level;
} sampler;

static double smaller(double a, double b) { return a < b ? a : b; }
static double bigger(double a, double b) { return a > b ? a : b; }

/* Of Catmull and Rom. */
static void lay_cubic(extent *e, float t) {
  float t2 = t * t, t3 = t2 * t;
  e->first--;
  e->count = 4;
  e->weights[0] = 0.5f * (2 * t2 - t3 - t);
  e->weights[1] = 0.5f * (3 * t3 - 5 * t2 + 2);
  e->weights[2] = 0.5f * (4 * t2 - 3 * t3 + t);
  e->weights[3] = 0.5f * (t3 - t2);
}

/* The texels that [low, high) has parts of; of a box inside the picture, unless it repeats. */
static void lay_box(extent *e, double low, double high, double texel) {
  e->first = (int32_t)floor((low + SAME) / texel);
  e->count = (int32_t)bigger(ceil((high - SAME) / texel) - e->first, 1);
  for (int32_t i = 0; i < e->count; i++) {
    double left = i > 0 ? (e->first + i) * texel : low;
    double right = i + 1 < e->count ? (e->first + i + 1) * texel : high;
    e->weights[i] = right > left ? (float)(right - left) : 1;
  }
}

/* Lays the kernel about a place. width: of a box. */
static void lay(const sampler *s, double at, double width, uint32_t size, extent *e) {
  double texel = (double)(1 << s->level);
  if (s->wrap == PLANEFILE_WRAP_REPEAT)
    at -= floor(at / size) * size;
  at = bigger(smaller(at, 1e9), -1e9);
  if (s->kernel == BOX) {
    double low = at - 0.5 * width, high = low + width;
    bool ends = s->wrap != PLANEFILE_WRAP_REPEAT;
    lay_box(e, ends ? bigger(smaller(low, size), 0) : low,
            ends ? bigger(smaller(high, size), 0) : high, texel);
    return;
  }
  at = s->kernel == NEAREST ? at : at / texel - 0.5;
  double first = floor(at + SAME);
  float share = at - first > SAME ? (float)(at - first) : 0;
  *e = (extent){(int32_t)first, s->kernel == NEAREST ? 1 : 2, {1 - share, share}};
  if (s->kernel == CUBIC)
    lay_cubic(e, share);
}

static const float *find_texel(const sampler *s, int32_t x, int32_t y) {
  int32_t at[2] = {x, y}, sizes[2];
  for (int i = 0; i < 2; i++) {
    sizes[i] = size_of(i == 0 ? s->picture->width : s->picture->height, s->level);
    if (s->wrap == PLANEFILE_WRAP_REPEAT)
      at[i] = (at[i] %= sizes[i]) < 0 ? at[i] + sizes[i] : at[i];
    at[i] = at[i] < 0 ? 0 : at[i] < sizes[i] ? at[i] : sizes[i] - 1;
  }
  size_t start = s->picture->starts[s->level];
  return s->picture->texels[start + (size_t)at[1] * (size_t)sizes[0] + (size_t)at[0]].light;
}

/* The mean of texels by weight, within what they are: of differences to one of them, so that a
 * colour stays what it is. */
static void mix(const sampler *s, const extent *across, const extent *down, float out[4]) {
  float first[4], low[4], high[4], sum[4] = {0}, total = 0;
  memcpy(first, find_texel(s, across->first, down->first), sizeof first);
  memcpy(low, first, sizeof low);
  memcpy(high, first, sizeof high);
  for (int32_t j = 0; j < down->count; j++)
    for (int32_t i = 0; i < across->count; i++) {
      float weight = across->weights[i] * down->weights[j];
      const float *texel = find_texel(s, across->first + i, down->first + j);
      total += weight;
      for (int c = 0; c < 4; c++) {
        sum[c] += weight * (texel[c] - first[c]);
        low[c] = texel[c] < low[c] ? texel[c] : low[c];
        high[c] = texel[c] > high[c] ? texel[c] : high[c];
      }
    }
  for (int c = 0; c < 4; c++) {
    float mean = first[c] + sum[c] / total;
    mean = mean > low[c] ? mean : low[c];
    out[c] = mean < high[c] ? mean : high[c];
  }
}

/* ---------------------------------------------------------------- samples */

/* The place of a pixel on the picture, and its footprint there: how it moves from pixel to pixel,
 * to the right and down. */
typedef struct place {
  double at[2], right[2], down[2];
} place;

static void sample_at(const sampler *s, double u, double v, const double box[2], float out[4]) {
  extent across, down;
  lay(s, u, box[0], s->picture->width, &across);
  lay(s, v, box[1], s->picture->height, &down);
  mix(s, &across, &down, out);
}

static void find_level(sampler *s, double shorter, double longer, double texels, double most) {
  for (s->level = 0;
       s->level + 1 < s->picture->level_count && (shorter >= 2 * texels || longer > most);
       s->level++, shorter *= 0.5)
    longer *= 0.5;
}

/* The mean of a footprint with its sides along those of the picture. */
static void sample_box(sampler *s, const place *at, double wide, double high, float out[4]) {
  wide = bigger(wide, 1);
  high = bigger(high, 1);
  find_level(s, smaller(wide, high), bigger(wide, high), BOX_TEXELS, BOX_MOST);
  double most = (double)BOX_MOST * (1 << s->level);
  s->kernel = BOX;
  sample_at(s, at->at[0], at->at[1], (double[2]){smaller(wide, most), smaller(high, most)}, out);
}

static int count_taps(const sampler *s, double length) {
  double taps = ceil(length / (double)(1 << s->level) - SAME);
  return (int)bigger(smaller(taps, TAPS_MOST), 1);
}

static void sample_taps(sampler *s, const place *at, float out[4]) {
  double right = sqrt(at->right[0] * at->right[0] + at->right[1] * at->right[1]);
  double below = sqrt(at->down[0] * at->down[0] + at->down[1] * at->down[1]);
  float tap[4], sum[4] = {0};
  find_level(s, smaller(right, below), bigger(right, below), TAP_TEXELS, TAPS_MOST);
  int columns = count_taps(s, right), rows = count_taps(s, below), taps = columns * rows;
  for (int k = 0; k < taps; k++) {
    double x = (k % columns + 0.5) / columns - 0.5, y = (k / columns + 0.5) / rows - 0.5;
    sample_at(s, at->at[0] + (x * at->right[0] + y * at->down[0]),
              at->at[1] + (x * at->right[1] + y * at->down[1]), at->at, tap);
    if (k == 0)
      memcpy(out, tap, sizeof tap);
    for (int c = 0; c < 4; c++)
      sum[c] += tap[c] - out[c];
  }
  for (int c = 0; c < 4; c++)
    out[c] += sum[c] / (float)taps;
}

static void sample(sampler *s, const place *at, float out[4]) {
  double ux = fabs(at->right[0]), vx = fabs(at->right[1]), uy = fabs(at->down[0]);
  double vy = fabs(at->down[1]), kept = ux + vy, crossed = vx + uy;
  const double most = 1 + SAME;
  bool is_enlarged = (ux + uy <= most && vx + vy <= most) ||
                     (s->is_affine && ux * ux + vx * vx <= most && uy * uy + vy * vy <= most);
  s->level = 0;
  s->kernel = s->filter == PLANEFILE_FILTER_NEAREST                ? NEAREST
              : s->filter == PLANEFILE_FILTER_CUBIC && is_enlarged ? CUBIC
                                                                   : LINEAR;
  if (is_enlarged || s->kernel == NEAREST || s->filter == PLANEFILE_FILTER_LINEAR)
    sample_at(s, at->at[0], at->at[1], at->at, out);
  else if (s->is_affine && smaller(kept, crossed) <= 1e-12 * bigger(kept, crossed))
    sample_box(s, at, ux + uy, vx + vy, out);
  else
    sample_taps(s, at, out);
}

/* ---------------------------------------------------------------- pixels */

/* False: it shows nothing. */
static bool find_place(const sampler *s, const planefile_axis *axis, const pf_pixels *pixels,
                       uint32_t k, place *out) {
  const double *planes[2] = {axis->p, axis->q}, width = pixels->width, height = pixels->height;
  double x = ((double)pixels->x + k + 0.5) / width, y = (pixels->y + 0.5) / height;
  double w = axis->w[0] * x + (axis->w[1] * y + axis->w[2]), near = 1 / w;
  bool is_there = w > 0;
  for (int i = 0; i < 2; i++) {
    uint32_t size = i == 0 ? s->picture->width : s->picture->height;
    double at = (planes[i][0] * x + (planes[i][1] * y + planes[i][2])) * near;
    out->at[i] = at;
    out->right[i] = (planes[i][0] - at * axis->w[0]) / width * near;
    out->down[i] = (planes[i][1] - at * axis->w[1]) / height * near;
    is_there &= s->wrap == PLANEFILE_WRAP_CLEAR ? at >= -SAME && at < size - SAME : fabs(at) < 1e15;
  }
  return is_there;
}

void pf_picture_colours(const pf_picture *picture, const planefile_axis *axis,
                        const pf_pixels *pixels, pf_colours *out) {
  sampler s = {.picture = picture,
               .wrap = axis->wrap,
               .filter = axis->filter,
               .is_affine = pf_axis_is_affine(axis)};
  for (uint32_t k = 0; k < pixels->count; k++) {
    float colour[4] = {0};
    place at;
    if (find_place(&s, axis, pixels, k, &at))
      sample(&s, &at, colour);
    for (int c = 0; c < 4; c++)
      out->channels[c][k] = colour[c];
  }
}
