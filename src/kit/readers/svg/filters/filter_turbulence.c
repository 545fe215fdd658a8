/* The noise of feTurbulence. Source: Filter Effects Module Level 1, 9.22, whose program gives all
 * numbers. */
#include "readers/svg/filters/filter_turbulence.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "inside/number.h"
#include "readers/svg/document/objects.h"
#include "readers/svg/draw/image.h"

#define TABLE 256
#define FAR 4096                        /* is added to coordinates, so that they are positive */
#define SIDE_MOST 8192                  /* texels; larger boxes have coarser texels */
#define TEXELS_MOST ((double)(1 << 24)) /* times octaves: a second of work */
/* Further octaves are lost in the rounding of numbers. */
#define OCTAVES_MOST 24

/* Where an octave of a stitched noise begins again. */
typedef struct stitch {
  double size[2], wrap[2];
} stitch;

typedef struct noise {
  const cs_svg_turbulence *given;
  int lattice[2 * TABLE + 2];
  double gradient[4][2 * TABLE + 2][2];
  double frequency[2]; /* adjusted where it is stitched */
  stitch seam;         /* the seam of its first octave */
  double step[2];      /* user units a texel */
} noise;

/* ---------------------------------------------------------------- tables */

/* Park and Miller, "Random number generators", 1988. */
static int32_t next_random(int32_t seed) {
  enum { FACTOR = 16807, WHOLE = 2147483647, QUOTIENT = 127773, REST = 2836 };
  int32_t result = FACTOR * (seed % QUOTIENT) - REST * (seed / QUOTIENT);
  return result <= 0 ? result + WHOLE : result;
}

static int32_t first_random(int seed) {
  enum { MOST = 2147483646 };
  if (seed <= 0)
    seed = -(seed % MOST) + 1;
  return seed > MOST ? MOST : seed;
}

static void fill_gradients(noise *n, int channel, int32_t *random) {
  for (int i = 0; i < TABLE; i++) {
    double *g = n->gradient[channel][i];
    for (int j = 0; j < 2; j++) {
      *random = next_random(*random);
      g[j] = (double)(*random % (2 * TABLE) - TABLE) / TABLE;
    }
    double length = sqrt(g[0] * g[0] + g[1] * g[1]);
    for (int j = 0; j < 2; j++)
      g[j] = length > 0 ? g[j] / length : 0;
  }
}

static void fill_tables(noise *n) {
  int32_t random = first_random(n->given->seed);
  for (int channel = 0; channel < 4; channel++)
    fill_gradients(n, channel, &random);
  for (int i = 0; i < TABLE; i++)
    n->lattice[i] = i;
  for (int i = TABLE - 1; i > 0; i--) {
    random = next_random(random);
    int j = random % TABLE, kept = n->lattice[i];
    n->lattice[i] = n->lattice[j];
    n->lattice[j] = kept;
  }
  for (int i = 0; i < TABLE + 2; i++) {
    n->lattice[TABLE + i] = n->lattice[i];
    for (int channel = 0; channel < 4; channel++)
      for (int j = 0; j < 2; j++)
        n->gradient[channel][TABLE + i][j] = n->gradient[channel][i][j];
  }
}

/* ---------------------------------------------------------------- values */

/* One coordinate: the two corners beside it, and the ways from them. */
typedef struct ends {
  int low, high;
  double from_low, from_high, share;
} ends;

static ends ends_of(double at, const stitch *seam, int axis) {
  double place = at + FAR, low = floor(place), high = low + 1, way = place - low;
  if (seam) {
    low -= low >= seam->wrap[axis] ? seam->size[axis] : 0;
    high -= high >= seam->wrap[axis] ? seam->size[axis] : 0;
  }
  low -= floor(low / TABLE) * TABLE;
  high -= floor(high / TABLE) * TABLE;
  return (ends){(int)low, (int)high, way, way - 1, way * way * (3 - 2 * way)};
}

/* The value of a channel between four corners, whose gradients have these indices. */
static double between(const double (*gradient)[2], const int corners[4], const ends *h,
                      const ends *v) {
  const double *g[4];
  for (int i = 0; i < 4; i++)
    g[i] = gradient[corners[i]];
  double above = g[0][0] * h->from_low + g[0][1] * v->from_low;
  double below = g[2][0] * h->from_low + g[2][1] * v->from_high;
  above += h->share * (g[1][0] * h->from_high + g[1][1] * v->from_low - above);
  below += h->share * (g[3][0] * h->from_high + g[3][1] * v->from_high - below);
  return above + v->share * (below - above);
}

/* One octave of all channels at a point of its own units. */
static void noise_at(const noise *n, double x, double y, const stitch *seam, double out[4]) {
  const ends h = ends_of(x, seam, 0), v = ends_of(y, seam, 1);
  int left = n->lattice[h.low], right = n->lattice[h.high];
  const int corners[4] = {n->lattice[left + v.low], n->lattice[right + v.low],
                          n->lattice[left + v.high], n->lattice[right + v.high]};
  for (int channel = 0; channel < 4; channel++)
    out[channel] = between(n->gradient[channel], corners, &h, &v);
}

/* The seam of the first octave. */
static stitch first_seam(const noise *n) {
  const celspan_box *box = &n->given->box;
  const double size[2] = {box->width, box->height}, from[2] = {box->x, box->y};
  stitch seam;
  for (int axis = 0; axis < 2; axis++) {
    seam.size[axis] = floor(size[axis] * n->frequency[axis] + 0.5);
    seam.wrap[axis] = floor(from[axis] * n->frequency[axis]) + FAR + seam.size[axis];
  }
  return seam;
}

static void move_seam(stitch *seam) {
  for (int axis = 0; axis < 2; axis++) {
    seam->size[axis] *= 2;
    seam->wrap[axis] = 2 * seam->wrap[axis] - FAR;
  }
}

/* The values of the channels at a point of user units, 0 to 1. */
static void values_at(const noise *n, double x, double y, double out[4]) {
  const bool is_fractal = n->given->is_fractal, is_stitched = n->given->is_stitched;
  stitch seam = n->seam;
  double ratio = 1, octave[4];
  memset(out, 0, 4 * sizeof *out);
  for (int i = 0; i < n->given->octaves && i < OCTAVES_MOST; i++, ratio *= 2) {
    noise_at(n, x * n->frequency[0] * ratio, y * n->frequency[1] * ratio,
             is_stitched ? &seam : NULL, octave);
    for (int c = 0; c < 4; c++)
      out[c] += (is_fractal ? octave[c] : fabs(octave[c])) / ratio;
    if (is_stitched)
      move_seam(&seam);
  }
  for (int c = 0; c < 4; c++)
    out[c] = cs_number_clamp(is_fractal ? (out[c] + 1) / 2 : out[c], 0, 1);
}

/* A frequency of a stitched noise: the box has a whole number of its waves. */
static double stitched(double frequency, double size) {
  double low = floor(size * frequency) / size, high = ceil(size * frequency) / size;
  if (!(frequency > 0))
    return frequency;
  return low > 0 && frequency / low < high / frequency ? low : high;
}

/* ---------------------------------------------------------------- texels */

/* The texels around the box: those whose middles are the middles of the drawing's pixels, unless
 * there would be too many. */
static celspan_box around(noise *n, int32_t size[2]) {
  const celspan_box *box = &n->given->box;
  const double *m = n->given->matrix.m;
  const double from[2] = {box->x, box->y}, length[2] = {box->width, box->height};
  double begin[2];
  const int32_t octaves = n->given->octaves < OCTAVES_MOST ? n->given->octaves : OCTAVES_MOST;
  const double most = sqrt(TEXELS_MOST / (octaves > 1 ? octaves : 1));
  for (int axis = 0; axis < 2; axis++) {
    double scale = sqrt(m[axis] * m[axis] + m[3 + axis] * m[3 + axis]);
    scale = fmin(scale, fmin(SIDE_MOST - 2, most) / length[axis]);
    double move = m[2 + 3 * axis];
    begin[axis] = floor(from[axis] * scale + move) - move;
    size[axis] = cs_number_to_int32(ceil((from[axis] + length[axis]) * scale - begin[axis]));
    size[axis] = size[axis] < 1 ? 1 : size[axis];
    n->step[axis] = 1 / scale;
  }
  return (celspan_box){begin[0] * n->step[0], begin[1] * n->step[1], size[0] * n->step[0],
                       size[1] * n->step[1]};
}

/* Whether texels have places that are numbers; in a drawing that is smaller than 1e-12 they lie too
 * far away. */
static bool is_near(const celspan_box *box) {
  return cs_number_is_sane(box->x) && cs_number_is_sane(box->y) && cs_number_is_sane(box->width) &&
         cs_number_is_sane(box->height);
}

/* A texel has the noise of its lower right corner, as in Chromium: coordinates began with 1 there.
 * Other programs take the upper left one. */
static void fill_texels(const noise *n, const celspan_box *box, const int32_t size[2],
                        uint16_t *out) {
  for (int32_t row = 0; row < size[1]; row++)
    for (int32_t column = 0; column < size[0]; column++) {
      double values[4];
      values_at(n, box->x + (column + 1) * n->step[0], box->y + (row + 1) * n->step[1], values);
      for (int channel = 0; channel < 4; channel++)
        *out++ = (uint16_t)(values[channel] * 65535 + 0.5);
    }
}

static celspan_status show(cs_svg_reading *reading, const noise *n, const celspan_box *box,
                           celspan_surface *surface, celspan_object **out) {
  celspan_picture_desc desc = CELSPAN_PICTURE_DESC;
  celspan_texture *texture;
  desc.surface = surface;
  desc.colour = n->given->is_coded ? "srgb" : "linear";
  desc.has_box = true;
  desc.box = *box;
  CS_TRY(celspan_texture_create_picture(reading->context, &desc, &texture));
  celspan_status status = cs_svg_object_fill(reading->context, &n->given->box, texture, out);
  celspan_texture_unref(texture);
  return status;
}

static celspan_status draw(cs_svg_reading *reading, const cs_svg_node *node, noise *n,
                           celspan_object **out) {
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  int32_t size[2];
  const celspan_box box = around(n, size);
  if (!is_near(&box))
    return CELSPAN_OK;
  size_t count = 4 * (size_t)size[0] * (size_t)size[1];
  celspan_surface *surface = NULL;
  uint16_t *texels;
  CS_TRY(cs_svg_image_count(reading, node, count * sizeof *texels));
  CS_TRY(CS_MAKE(reading->context, texels, count));
  fill_texels(n, &box, size, texels);
  desc.width = size[0];
  desc.height = size[1];
  desc.format = CELSPAN_SURFACE_RGBA16;
  desc.pixels = texels;
  celspan_status status = celspan_surface_create(reading->context, &desc, &surface);
  cs_mem_free(reading->context->memory, texels, count * sizeof *texels);
  CS_TRY(status);
  status = show(reading, n, &box, surface, out);
  celspan_surface_unref(surface);
  return status;
}

celspan_status cs_svg_turbulence_make(cs_svg_reading *reading, const cs_svg_node *node,
                                      const cs_svg_turbulence *given, celspan_object **out) {
  noise *n;
  *out = NULL;
  if (!(given->box.width > 0 && given->box.height > 0))
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(reading->context, n, 1));
  n->given = given;
  n->frequency[0] = given->frequency[0];
  n->frequency[1] = given->frequency[1];
  if (given->is_stitched) {
    n->frequency[0] = stitched(given->frequency[0], given->box.width);
    n->frequency[1] = stitched(given->frequency[1], given->box.height);
    n->seam = first_seam(n);
  }
  fill_tables(n);
  celspan_status status = draw(reading, node, n, out);
  cs_mem_free(reading->context->memory, n, sizeof *n);
  return status;
}
