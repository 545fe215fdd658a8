/* Noise beside closed forms: its mean, its variance and its spectrum; how much is finer than
 * pixels; and the same bits by all sets of instructions.
 */
#include <math.h>
#include <string.h>

#include "engine/paint/noise.h"
#include "engine/paint/shade.h"
#include "model/geometry/matrix.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

/* MEAN: frequencies that count as the mean of a row. */
enum { LENGTH = 512, HALF = LENGTH / 2, STEPS = 2000, MEAN = 2 };
#define TURN 6.283185307179586

static celspan_context *context;

/* ---------------------------------------------------------------- rows of noise */

/* The shade owns its texture. Its units are pixels. */
static cs_shade shade_of(celspan_noise_desc desc) {
  celspan_texture *texture = NULL;
  CHECK(celspan_texture_create_noise(context, &desc, &texture) == CELSPAN_OK);
  cs_shade shade = {.texture = texture, .inverse = celspan_matrix_identity()};
  cs_shade_prepare(&shade);
  return shade;
}

static void drop(const cs_shade *shade) {
  celspan_texture_unref((celspan_texture *)shade->texture);
}

/* LENGTH values along a row, `step` pixels from each other. */
static void read_row(const cs_shade *shade, double y, double step, double *out) {
  for (int i = 0; i < LENGTH; i += CS_NOISE_PLACES) {
    double x[CS_NOISE_PLACES];
    for (int k = 0; k < CS_NOISE_PLACES; k++)
      x[k] = (i + k) * step;
    cs_noise_at(shade, x, CS_NOISE_PLACES, y, out + i);
  }
}

/* Adds the energy of each frequency of a row, k / LENGTH a step. */
static void add_energies(const double *row, double *energies) {
  double mean = 0, weighed[LENGTH];
  for (int i = 0; i < LENGTH; i++)
    mean += row[i] / LENGTH;
  for (int i = 0; i < LENGTH; i++)
    weighed[i] = (row[i] - mean) * (0.5 - 0.5 * cos(TURN * i / LENGTH));
  for (int f = 0; f < HALF; f++) {
    double re = 0, im = 0;
    for (int i = 0; i < LENGTH; i++) {
      re += weighed[i] * cos(TURN * ((f * i) % LENGTH) / LENGTH);
      im += weighed[i] * sin(TURN * ((f * i) % LENGTH) / LENGTH);
    }
    energies[f] += re * re + im * im;
  }
}

/* The share of the energy at `from` and higher frequencies. */
static double share_from(const double *energies, double from) {
  double all = 0, above = 0;
  for (int f = MEAN; f < HALF; f++) {
    all += energies[f];
    above += f >= from ? energies[f] : 0;
  }
  return all > 0 ? above / all : 0;
}

/* ---------------------------------------------------------------- closed forms */

/* The share of a corner at a distance of -1 to 1 from it. */
static double weight(double t) {
  double a = fabs(t);
  return 1 - a * a * a * (a * (6 * a - 15) + 10);
}

/* The integral over -1..1 of (t^power weight)^2. */
static double integral(int power) {
  double sum = 0;
  for (int i = 0; i < STEPS; i++) {
    double t = 2 * (i + 0.5) / STEPS - 1, value = weight(t) * (power ? t : 1);
    sum += value * value * 2 / STEPS;
  }
  return sum;
}

/* The energy of t^power weight at a frequency, cycles a cell. */
static double transform(int power, double frequency) {
  double re = 0, im = 0;
  for (int i = 0; i < STEPS; i++) {
    double t = 2 * (i + 0.5) / STEPS - 1, value = weight(t) * (power ? t : 1) * 2 / STEPS;
    re += value * cos(TURN * frequency * t);
    im += value * sin(TURN * frequency * t);
  }
  return re * re + im * im;
}

/* Noise is a sum over corners of a random number times a kernel: of its value, whose variance is
 * 1/3, for VALUE; of each part of its gradient, whose variance is 1, for PERLIN. */
static double variance_of(celspan_noise_kind kind) {
  return kind == CELSPAN_NOISE_VALUE ? integral(0) * integral(0) / 3
                                     : 2 * integral(0) * integral(1);
}

/* The energy along a row at a frequency, the means over all rows. */
static double energy_of(celspan_noise_kind kind, double frequency) {
  if (kind == CELSPAN_NOISE_VALUE)
    return transform(0, frequency) * integral(0) / 3;
  return transform(1, frequency) * integral(0) + transform(0, frequency) * integral(1);
}

/* Cells of 16 steps: eight bands of frequencies up to 2 cycles a cell, as shares of the whole. */
static void check_spectrum(celspan_noise_kind kind) {
  enum { BANDS = 8, ROWS = 600, SIDE = 16 };
  double energies[HALF] = {0}, row[LENGTH], mean = 0, square = 0, expected[BANDS] = {0}, all = 0;
  celspan_noise_desc desc = CELSPAN_NOISE_DESC;
  desc.kind = kind;
  desc.size = SIDE;
  for (int i = 0; i < ROWS; i++) {
    desc.seed = i;
    cs_shade shade = shade_of(desc);
    read_row(&shade, 0.37 * SIDE * i + 3.1, 1, row);
    add_energies(row, energies);
    for (int k = 0; k < LENGTH; k++) {
      mean += row[k] / LENGTH / ROWS;
      square += (2 * row[k] - 1) * (2 * row[k] - 1) / LENGTH / ROWS;
    }
    drop(&shade);
  }
  CHECK_NEAR(mean, 0.5, 0.01);
  CHECK_NEAR(square / variance_of(kind), 1, 0.04);
  for (int f = MEAN; f < HALF; f++) {
    double step = (double)SIDE / LENGTH, here = f * step; /* cycles a cell */
    double energy =
        (energy_of(kind, here - step) + 4 * energy_of(kind, here) + energy_of(kind, here + step)) /
        6; /* as the window spreads it */
    all += energy;
    if (here < 2)
      expected[(int)(here / 2 * BANDS)] += energy;
  }
  for (int i = 0; i < BANDS; i++) {
    double from = i * 2.0 / BANDS * LENGTH / SIDE, end = (i + 1) * 2.0 / BANDS * LENGTH / SIDE;
    CHECK_NEAR(share_from(energies, from) - share_from(energies, end), expected[i] / all, 0.015);
  }
}

/* White noise: all values are as frequent, neighbours know nothing of each other, and a cell has
 * one value. */
static void check_white(void) {
  enum { BINS = 10, ROWS = 200, SIDE = 4, COUNT = LENGTH / SIDE };
  double row[LENGTH], before[LENGTH] = {0}, along = 0, down = 0;
  int bins[BINS] = {0};
  celspan_noise_desc desc = CELSPAN_NOISE_DESC;
  desc.kind = CELSPAN_NOISE_WHITE;
  desc.size = SIDE;
  desc.fades = false;
  cs_shade shade = shade_of(desc);
  for (int i = 0; i < ROWS; i++, memcpy(before, row, sizeof row)) {
    read_row(&shade, SIDE * i + 0.5, 1, row);
    for (int k = 0; k < COUNT; k++) {
      const double *cell = row + SIDE * k;
      bins[(int)(cell[0] * (BINS - 1e-9))]++;
      CHECK(cell[1] == cell[0] && cell[SIDE - 1] == cell[0]);
      along += k > 0 ? (cell[0] - 0.5) * (cell[-1] - 0.5) : 0;
      down += i > 0 ? (cell[0] - 0.5) * (before[SIDE * k] - 0.5) : 0;
    }
  }
  drop(&shade);
  for (int i = 0; i < BINS; i++)
    CHECK_NEAR((double)bins[i] / ROWS / COUNT, 1.0 / BINS, 4 * sqrt(0.09 / ROWS / COUNT));
  CHECK_NEAR(along * 12 / ROWS / COUNT, 0, 4 / sqrt(ROWS * COUNT));
  CHECK_NEAR(down * 12 / ROWS / COUNT, 0, 4 / sqrt(ROWS * COUNT));
}

/* ---------------------------------------------------------------- zooming */

/* The noise of a pixel, read at eighths of pixels: the share of energy that pixels cannot show,
 * while its cells shrink from 100 pixels to 1. */
static void check_zoom(celspan_noise_kind kind) {
  for (double side = 100; side >= 1; side /= 1.19) {
    double energies[HALF] = {0}, row[LENGTH];
    celspan_noise_desc desc = CELSPAN_NOISE_DESC;
    desc.kind = kind;
    desc.size = side;
    desc.octaves = 8;
    for (int i = 0; i < 8; i++) {
      desc.seed = i;
      cs_shade shade = shade_of(desc);
      read_row(&shade, 5.3 * i * side, 0.125, row);
      add_energies(row, energies);
      drop(&shade);
    }
    CHECK(share_from(energies, LENGTH / 16.0 + 2) < 0.01);
  }
}

/* Cells of less than a pixel have the mean of large cells. */
static void check_far(celspan_noise_kind kind, double at) {
  celspan_noise_desc desc = CELSPAN_NOISE_DESC;
  double row[LENGTH], mean = 0;
  desc.kind = kind;
  desc.octaves = 1;
  desc.size = 0.9;
  desc.at = at;
  cs_shade shade = shade_of(desc);
  read_row(&shade, 7, 1, row);
  drop(&shade);
  for (int k = 1; k < LENGTH; k++)
    CHECK(row[k] == row[0]);
  desc.size = 20;
  for (int i = 0; i < 200; i++) {
    double near[LENGTH];
    desc.seed = i;
    shade = shade_of(desc);
    read_row(&shade, 3.7 * i, 20.0 * 7 / 32, near);
    for (int k = 0; k < LENGTH; k++)
      mean += near[k] / LENGTH / 200;
    drop(&shade);
  }
  CHECK_NEAR(row[0], mean, 0.012);
}

/* ---------------------------------------------------------------- sets of instructions */

static void check_bits(cs_isa isa, test_random *random) {
  enum { COUNT = CS_NOISE_PLACES };
  cs_noise_places places[2];
  double at[COUNT], scale = random_between(random, 0.5, 9), shift = random_between(random, 0, 1);
  float values[2][COUNT];
  double far = random_below(random, 4) == 0 ? 1e18 : 1000;
  for (int k = 0; k < COUNT; k++)
    at[k] = random_below(random, 9) == 0 ? random_below(random, 5) - 2
                                         : random_between(random, -far, far);
  memset(places, 0, sizeof places);
  for (int i = 0; i < 2; i++) {
    cs_isa with = i == 0 ? CS_ISA_ANY : isa;
    CS_WIDE_CHOOSE(with, cs_noise_split)(at, COUNT, scale, shift, places[i].x, places[i].u);
    CS_WIDE_CHOOSE(with, cs_noise_split)(at, COUNT, 1, 0.5, places[i].y, places[i].v);
    places[i].z = places[0].x[0];
    places[i].w = places[0].u[2] < 0.5f ? 0 : places[0].u[3];
    places[i].seed = (uint32_t)places[0].x[1];
  }
  CHECK(memcmp(&places[0], &places[1], sizeof places[0]) == 0);
  for (int kind = CELSPAN_NOISE_PERLIN; kind <= (int)CELSPAN_NOISE_WHITE; kind++) {
    for (int i = 0; i < 2; i++)
      CS_WIDE_CHOOSE(i == 0 ? CS_ISA_ANY : isa, cs_noise_values)
    ((celspan_noise_kind)kind, &places[0], COUNT, values[i]);
    CHECK(memcmp(values[0], values[1], sizeof values[0]) == 0);
  }
}

/* A pixel does not depend on those that are found with it. */
static void check_alone(void) {
  celspan_noise_desc desc = CELSPAN_NOISE_DESC;
  desc.kind = CELSPAN_NOISE_FRACTAL;
  desc.at = 0.3;
  cs_shade shade = shade_of(desc);
  shade.inverse =
      celspan_matrix_then(shade.inverse, (celspan_matrix){{1, 0, 0, 0, 1, 0, 0.01, 0, 1}});
  for (int tilted = 0; tilted < 2; tilted++) {
    double row[LENGTH], one;
    if (tilted)
      cs_shade_prepare(&shade);
    read_row(&shade, 9.5, 1, row);
    for (int k = 0; k < 99; k++) {
      double x = k;
      cs_noise_at(&shade, &x, 1, 9.5, &one);
      CHECK(one == row[k]);
    }
  }
  drop(&shade);
}

/* Behind the horizon there is no noise, and before it there is. */
static void check_behind(void) {
  const celspan_noise_desc desc = CELSPAN_NOISE_DESC;
  cs_shade shade = shade_of(desc);
  double row[LENGTH];
  shade.inverse =
      celspan_matrix_then(shade.inverse, (celspan_matrix){{1, 0, 0, 0, 1, 0, -0.01, 0, 1}});
  cs_shade_prepare(&shade);
  read_row(&shade, 9.5, 1, row);
  for (int k = 0; k < LENGTH; k++)
    CHECK(k < 100 ? row[k] >= 0 && row[k] <= 1 : isnan(row[k]));
  drop(&shade);
}

/* ---------------------------------------------------------------- what is refused */

static void check_refused(void) {
  const double bad[] = {0, -1, NAN, INFINITY, 1e13};
  celspan_texture *texture = NULL;
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    celspan_noise_desc desc = CELSPAN_NOISE_DESC;
    desc.size = bad[i];
    CHECK(celspan_texture_create_noise(context, &desc, &texture) == CELSPAN_BAD_ARGUMENT);
    desc = CELSPAN_NOISE_DESC;
    desc.gain = bad[i] == 0 ? 1.01 : bad[i];
    CHECK(celspan_texture_create_noise(context, &desc, &texture) == CELSPAN_BAD_ARGUMENT);
    desc = CELSPAN_NOISE_DESC;
    desc.at = bad[i] <= 0 ? NAN : bad[i];
    CHECK(celspan_texture_create_noise(context, &desc, &texture) == CELSPAN_BAD_ARGUMENT);
  }
  celspan_noise_desc desc = CELSPAN_NOISE_DESC;
  desc.octaves = 17;
  CHECK(celspan_texture_create_noise(context, &desc, &texture) == CELSPAN_BAD_ARGUMENT);
  desc.octaves = 0;
  CHECK(celspan_texture_create_noise(context, &desc, &texture) == CELSPAN_BAD_ARGUMENT);
  desc.octaves = 1;
  desc.kind = (celspan_noise_kind)6;
  CHECK(celspan_texture_create_noise(context, &desc, &texture) == CELSPAN_BAD_ARGUMENT);
}

/* The largest and the smallest cells that are allowed, far away and near. */
static void check_extremes(void) {
  const double sizes[] = {1e-300, 1e-9, 1, 1e9, 1e12};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
    for (int kind = CELSPAN_NOISE_PERLIN; kind <= (int)CELSPAN_NOISE_WHITE; kind++) {
      double row[LENGTH];
      celspan_noise_desc desc = CELSPAN_NOISE_DESC;
      desc.kind = (celspan_noise_kind)kind;
      desc.size = sizes[i];
      desc.at = i % 2 ? -1e12 : 0.25;
      desc.octaves = 16;
      cs_shade shade = shade_of(desc);
      read_row(&shade, i % 2 ? 1e11 : -3, 1e9, row);
      for (int k = 0; k < LENGTH; k++)
        CHECK(row[k] >= 0 && row[k] <= 1);
      drop(&shade);
    }
}

int main(void) {
  test_random random = {52};
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  check_spectrum(CELSPAN_NOISE_PERLIN);
  check_spectrum(CELSPAN_NOISE_VALUE);
  for (int kind = CELSPAN_NOISE_PERLIN; kind <= (int)CELSPAN_NOISE_WHITE; kind++) {
    if (kind != CELSPAN_NOISE_WHITE) /* squares have edges */
      check_zoom((celspan_noise_kind)kind);
    check_far((celspan_noise_kind)kind, 0);
    check_far((celspan_noise_kind)kind, 0.5);
    check_far((celspan_noise_kind)kind, -7.2);
  }
  check_white();
  for (int isa = CS_ISA_ANY; isa <= (int)cs_isa_best(); isa++)
    for (int k = 0; k < 300; k++)
      check_bits((cs_isa)isa, &random);
  check_alone();
  check_behind();
  check_refused();
  check_extremes();
  celspan_context_destroy(context);
  return check_done();
}
