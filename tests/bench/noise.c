/* `bench_noise [WIDTH HEIGHT]`: the cost of noise, compared with a plain Perlin noise in C.
 *
 * Both find all pixels of a frame, one octave and the sum of four, turn by turn. A line of the
 * output gives the milliseconds of a frame for each of the two, medians of FRAMES by one thread,
 * and their ratio, which is promised to be 1.3 at most.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "celspan/celspan.h"
#include "engine/paint/noise.h"
#include "engine/paint/shade.h"
#include "measure.h"
#include "model/geometry/matrix.h"

#define FRAMES 11
#define SIZE 60.0 /* pixels */

/* ---------------------------------------------------------------- the plain noise */

static int corners[512];

/* A permutation of 0 to 255, twice. */
static void shuffle(void) {
  unsigned state = 1;
  for (int i = 0; i < 256; i++)
    corners[i] = i;
  for (int i = 255; i > 0; i--) {
    state = state * 1664525 + 1013904223;
    int j = (int)(state >> 8) % (i + 1), kept = corners[i];
    corners[i] = corners[j];
    corners[j] = kept;
  }
  for (int i = 0; i < 256; i++)
    corners[256 + i] = corners[i];
}

static double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

static double mix(double t, double a, double b) { return a + t * (b - a); }

static double slope(int hash, double x, double y) {
  double u = hash & 4 ? y : x, v = hash & 4 ? x : y;
  return (hash & 1 ? -u : u) + (hash & 2 ? -v : v) * 0.5;
}

/* Perlin, "Improving noise", 2002, in the plane. */
static double perlin(double x, double y) {
  int column = (int)floor(x) & 255, row = (int)floor(y) & 255;
  x -= floor(x);
  y -= floor(y);
  double u = fade(x), v = fade(y);
  int a = corners[column] + row, b = corners[column + 1] + row;
  return mix(v, mix(u, slope(corners[a], x, y), slope(corners[b], x - 1, y)),
             mix(u, slope(corners[a + 1], x, y - 1), slope(corners[b + 1], x - 1, y - 1)));
}

/* ---------------------------------------------------------------- frames */

typedef struct frame {
  int width, height, octaves;
  cs_shade shade;
  double *row;
} frame;

static void draw_plain(frame *f) {
  for (int y = 0; y < f->height; y++)
    for (int x = 0; x < f->width; x++) {
      double sum = 0, gain = 1, scale = 1 / SIZE;
      for (int i = 0; i < f->octaves; i++, gain *= 0.5, scale *= 2)
        sum += gain * perlin((x + 0.5) * scale, (y + 0.5) * scale);
      f->row[x] = fmin(fmax(0.5 + 0.5 * sum, 0), 1);
    }
}

static void draw_ours(frame *f) {
  for (int y = 0; y < f->height; y++)
    for (int x = 0; x < f->width; x += CS_NOISE_PLACES) {
      double places[CS_NOISE_PLACES];
      int count = f->width - x < CS_NOISE_PLACES ? f->width - x : CS_NOISE_PLACES;
      for (int k = 0; k < count; k++)
        places[k] = x + k + 0.5;
      cs_noise_at(&f->shade, places, count, y + 0.5, f->row + x);
    }
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double milliseconds(void (*draw)(frame *f), frame *f) {
  double before = bench_processor();
  draw(f);
  return 1e3 * (bench_processor() - before);
}

static void measure(frame *f) {
  double plain[FRAMES], ours[FRAMES];
  for (int i = 0; i < FRAMES; i++) {
    plain[i] = milliseconds(draw_plain, f);
    ours[i] = milliseconds(draw_ours, f);
  }
  qsort(plain, FRAMES, sizeof *plain, compare);
  qsort(ours, FRAMES, sizeof *ours, compare);
  double a = ours[FRAMES / 2], b = plain[FRAMES / 2];
  printf("%d octaves: celspan %8.2f ms, plain %8.2f ms, ratio %.2f\n", f->octaves, a, b, a / b);
}

int main(int argc, char **argv) {
  celspan_context *context;
  frame f = {.width = argc > 2 ? atoi(argv[1]) : 1920, .height = argc > 2 ? atoi(argv[2]) : 1080};
  if (f.width < 1 || f.height < 1 || celspan_context_create(NULL, &context) != CELSPAN_OK)
    bench_stop("usage: bench_noise [WIDTH HEIGHT]");
  shuffle();
  f.row = malloc((size_t)f.width * sizeof *f.row);
  for (f.octaves = 1; f.row && f.octaves <= 4; f.octaves += 3) {
    celspan_noise_desc desc = CELSPAN_NOISE_DESC;
    celspan_texture *texture;
    desc.kind = CELSPAN_NOISE_FRACTAL;
    desc.size = SIZE;
    desc.octaves = f.octaves;
    if (celspan_texture_create_noise(context, &desc, &texture) != CELSPAN_OK)
      bench_stop("%s", celspan_context_error(context));
    f.shade = (cs_shade){.texture = texture, .inverse = celspan_matrix_identity()};
    cs_shade_prepare(&f.shade);
    measure(&f);
    celspan_texture_unref(texture);
  }
  free(f.row);
  celspan_context_destroy(context);
  return 0;
}
