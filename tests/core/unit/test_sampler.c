/* Pictures along rows: exact where they must be, the mean where they shrink, brute force elsewhere.
 * One file, because every way of sampling is compared with the same sums. */
#include "engine/sample/sampler.h"
#include "engine/sample/sampler_codes.h"
#include "engine/sample/sampler_level.h"
#include "engine/sample/sampler_row.h"
#include "engine/sample/sampler_taps.h"
#include "model/colour/srgb8_decode.h"
#include "tests/support/picture.h"
#include "tests/support/random.h"

#define SIDE 200

static celspan_context *context;
static cs_block_cache texels;
static cs_picture *noise_picture, *check_picture, *zone_picture, *coded_picture;
static float noise[SIDE][SIDE][4];

/* ---------------------------------------------------------------- the pictures */

static void paint_noise(int x, int y, float rgba[4]) {
  test_random random = {(uint64_t)(y * SIDE + x)};
  for (int c = 0; c < 4; c++)
    rgba[c] = random_unit(&random);
}

static void paint_check(int x, int y, float rgba[4]) {
  for (int c = 0; c < 4; c++)
    rgba[c] = (x + y) % 2 ? 1 : 0;
  rgba[3] = 1;
}

/* Rings that become finer than a pixel of a shrunk picture can show. */
static void paint_zone(int x, int y, float rgba[4]) {
  double dx = x - 128, dy = y - 128;
  for (int c = 0; c < 3; c++)
    rgba[c] = (float)(0.5 + 0.5 * cos((dx * dx + dy * dy) * 3.14159265 / 256));
  rgba[3] = 1;
}

/* Of 8-bit codes; its right half is opaque. */
static void paint_coded(int x, int y, float rgba[4]) {
  paint_noise(x, y, rgba);
  rgba[3] = x >= SIDE / 2 ? 1 : rgba[3];
  for (int c = 0; c < 3; c++)
    rgba[c] *= rgba[3];
}

static cs_picture *make_picture(const char *name, int width, int height, picture_paint paint) {
  const char *path = picture_path(name);
  celspan_coding coding = {.struct_size = sizeof coding,
                           .depth = paint == paint_coded ? CELSPAN_DEPTH_8 : CELSPAN_DEPTH_FLOAT};
  cs_picture *picture = NULL;
  celspan_picture_info info;
  CHECK(picture_write(context, path, &coding, width, height, paint) == CELSPAN_OK);
  CHECK(picture_open(context, path, &picture, &info) == CELSPAN_OK);
  return picture;
}

static void remove_picture(const char *name, cs_picture *picture) {
  unlink(picture_path(name));
  cs_picture_unref(picture);
}

/* placement: picture pixels to frame pixels. */
static cs_sampler make_sampler(const cs_picture *picture, int width, int height,
                               celspan_matrix placement, celspan_sampling sampling,
                               celspan_wrap wrap) {
  cs_sampler sampler = {
      .picture = picture, .width = width, .height = height, .sampling = sampling, .wrap = wrap};
  const double *m = placement.m;
  /* The adjugate over the determinant. */
  double a[9] = {m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
                 m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
                 m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
  double determinant = m[0] * a[0] + m[1] * a[3] + m[2] * a[6];
  for (int i = 0; i < 9; i++)
    sampler.inverse.m[i] = a[i] / determinant;
  sampler.isa = cs_isa_best();
  cs_sampler_prepare(&sampler);
  return sampler;
}

static celspan_matrix affine(double a, double b, double c, double d, double e, double f) {
  return (celspan_matrix){{a, b, c, d, e, f, 0, 0, 1}};
}

static cs_run run_of(int32_t x0, int32_t count, double y) { return (cs_run){x0, x0 + count, y}; }

static void sample(const cs_sampler *sampler, int x, int y, float rgba[4]) {
  float row[1][4];
  CHECK(cs_sampler_run(&texels, sampler, run_of(x, 1, y + 0.5), row) == CELSPAN_OK);
  memcpy(rgba, row[0], sizeof row[0]);
}

static bool same(const float a[4], const float b[4]) { return memcmp(a, b, 4 * sizeof *a) == 0; }

/* ---------------------------------------------------------------- exact */

static void test_copy(void) {
  static const celspan_sampling samplings[] = {CELSPAN_SAMPLING_AUTO, CELSPAN_SAMPLING_NEAREST,
                                               CELSPAN_SAMPLING_BILINEAR, CELSPAN_SAMPLING_BICUBIC};
  for (int i = 0; i < 4; i++) {
    cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, affine(1, 0, 13, 0, 1, -7), samplings[i],
                                CELSPAN_WRAP_CLEAR);
    float row[SIDE + 40][4];
    int wrong = 0;
    for (int y = -10; y < SIDE; y++) {
      CHECK(cs_sampler_run(&texels, &s, run_of(-5, SIDE + 40, y + 0.5), row) == CELSPAN_OK);
      for (int x = 0; x < SIDE + 40; x++) {
        static const float clear[4];
        int u = x - 5 - 13, v = y + 7;
        bool is_inside = u >= 0 && u < SIDE && v >= 0 && v < SIDE;
        wrong += !same(row[x], is_inside ? noise[v][u] : clear);
      }
    }
    CHECK(wrong == 0);
  }
}

static void test_quarter_turns(void) {
  /* Clockwise by 90, 180, 270 degrees, with the rounding a sine brings. */
  const double o = 6.1e-17;
  const celspan_matrix turns[3] = {affine(o, -1, SIDE, 1, o, 0), affine(-1, -o, SIDE, o, -1, SIDE),
                                   affine(-o, 1, 0, -1, -o, SIDE)};
  for (int t = 0; t < 3; t++) {
    cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, turns[t], CELSPAN_SAMPLING_AUTO,
                                CELSPAN_WRAP_CLEAR);
    int wrong = 0;
    for (int y = 0; y < SIDE; y++) {
      float row[SIDE][4];
      CHECK(cs_sampler_run(&texels, &s, run_of(0, SIDE, y + 0.5), row) == CELSPAN_OK);
      for (int x = 0; x < SIDE; x++) {
        int u = t == 0 ? y : t == 1 ? SIDE - 1 - x : SIDE - 1 - y;
        int v = t == 0 ? SIDE - 1 - x : t == 1 ? SIDE - 1 - y : x;
        wrong += !same(row[x], noise[v][u]);
      }
    }
    CHECK(wrong == 0);
  }
}

static void test_half_pixel(void) {
  cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, affine(1, 0, 0.5, 0, 1, 0),
                              CELSPAN_SAMPLING_BILINEAR, CELSPAN_WRAP_CLEAR);
  for (int x = 1; x < SIDE; x += 7) {
    float rgba[4];
    sample(&s, x, 50, rgba);
    for (int c = 0; c < 4; c++)
      CHECK_NEAR((double)rgba[c], ((double)noise[50][x - 1][c] + (double)noise[50][x][c]) / 2,
                 1e-6);
  }
}

static void test_nearest(void) {
  cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, affine(3, 0, 0, 0, 3, 0),
                              CELSPAN_SAMPLING_NEAREST, CELSPAN_WRAP_CLEAR);
  for (int x = 0; x < 3 * SIDE; x += 5) {
    float rgba[4];
    sample(&s, x, 100, rgba);
    CHECK(same(rgba, noise[100 / 3][x / 3]));
  }
}

/* A run's pixels do not depend on where it begins. */
static void test_runs(void) {
  const celspan_matrix placements[] = {affine(1.7, 0, 3.3, 0, 1.7, -2),
                                       affine(0.3, 0, 3, 0, 0.4, 1),
                                       affine(0.5, 0.6, 9, -0.4, 0.7, 80),
                                       {{0.5, 0.1, 10, 0.05, 0.6, 5, 0.001, 0.002, 1}}};
  for (int p = 0; p < 4; p++)
    for (int y = 0; y < 100; y += 11) {
      cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, placements[p], CELSPAN_SAMPLING_AUTO,
                                  CELSPAN_WRAP_REPEAT);
      float whole[150][4], part[150][4];
      CHECK(cs_sampler_run(&texels, &s, run_of(-20, 150, y + 0.5), whole) == CELSPAN_OK);
      for (int x = 0; x < 150; x += 30)
        CHECK(cs_sampler_run(&texels, &s, run_of(x - 20, 30, y + 0.5), part + x) == CELSPAN_OK);
      CHECK(memcmp(whole, part, sizeof whole) == 0);
    }
}

/* ---------------------------------------------------------------- edges and wrapping */

static void test_borders(void) {
  float rgba[4];
  cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, affine(8, 0, 0, 0, 8, 0),
                              CELSPAN_SAMPLING_BILINEAR, CELSPAN_WRAP_CLEAR);
  sample(&s, 0, 0, rgba); /* without a clear border */
  CHECK(same(rgba, noise[0][0]));
  sample(&s, -1, 0, rgba);
  CHECK(rgba[3] == 0 && rgba[0] == 0);
  sample(&s, 8 * SIDE - 1, 8 * SIDE - 1, rgba);
  CHECK(same(rgba, noise[SIDE - 1][SIDE - 1]));
  sample(&s, 8 * SIDE, 5, rgba);
  CHECK(rgba[3] == 0);
  s.wrap = CELSPAN_WRAP_CLAMP;
  cs_sampler_prepare(&s);
  sample(&s, -1000, 0, rgba);
  CHECK(same(rgba, noise[0][0]));
  s = make_sampler(noise_picture, SIDE, SIDE, affine(1, 0, 0, 0, 1, 0), CELSPAN_SAMPLING_AUTO,
                   CELSPAN_WRAP_CLAMP);
  sample(&s, 3, -9, rgba);
  CHECK(same(rgba, noise[0][3]));
  sample(&s, SIDE + 9, 17, rgba);
  CHECK(same(rgba, noise[17][SIDE - 1]));
}

static void test_repeat(void) {
  const celspan_matrix placements[] = {affine(1, 0, 0, 0, 1, 0), affine(2, 0, 0, 0, 2, 0),
                                       affine(0.5, 0, 0, 0, 0.5, 0)};
  const int periods[] = {SIDE, 2 * SIDE, SIDE / 2};
  for (int p = 0; p < 3; p++) {
    cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, placements[p], CELSPAN_SAMPLING_AUTO,
                                CELSPAN_WRAP_REPEAT);
    for (int x = 0; x < periods[p]; x += 9) {
      float a[4], b[4], c[4];
      sample(&s, x, 3, a);
      sample(&s, x + 7 * periods[p], 3 - periods[p], b);
      sample(&s, x - 4 * periods[p], 3 + periods[p], c);
      CHECK(same(a, b) && same(a, c));
    }
  }
  /* The seam: half of the last column, half of the first. */
  cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, affine(1, 0, 0.5, 0, 1, 0),
                              CELSPAN_SAMPLING_AUTO, CELSPAN_WRAP_REPEAT);
  float rgba[4];
  sample(&s, 0, 20, rgba);
  CHECK_NEAR((double)rgba[1], ((double)noise[20][SIDE - 1][1] + (double)noise[20][0][1]) / 2, 1e-6);
}

/* ---------------------------------------------------------------- shrinking */

/* The exact mean over [u0, u1) x [v0, v1) inside the noise. */
static void mean(double u0, double u1, double v0, double v1, double out[4]) {
  double total = 0;
  memset(out, 0, 4 * sizeof *out);
  for (int v = 0; v < SIDE; v++)
    for (int u = 0; u < SIDE; u++) {
      double wide = fmin(u + 1, u1) - fmax(u, u0), high = fmin(v + 1, v1) - fmax(v, v0);
      if (wide <= 0 || high <= 0)
        continue;
      for (int c = 0; c < 4; c++)
        out[c] += wide * high * (double)noise[v][u][c];
      total += wide * high;
    }
  for (int c = 0; c < 4; c++)
    out[c] /= total;
}

static void check_shrink(double sx, double sy, double dx, double dy, double tolerance) {
  cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, affine(1 / sx, 0, dx, 0, 1 / sy, dy),
                              CELSPAN_SAMPLING_AUTO, CELSPAN_WRAP_CLEAR);
  double worst = 0;
  for (int y = (int)ceil(dy); y + 1 < dy + SIDE / sy; y += 3)
    for (int x = (int)ceil(dx); x + 1 < dx + SIDE / sx; x += 2) {
      float rgba[4];
      double wanted[4];
      sample(&s, x, y, rgba);
      mean((x - dx) * sx, (x + 1 - dx) * sx, (y - dy) * sy, (y + 1 - dy) * sy, wanted);
      for (int c = 0; c < 4; c++)
        worst = fmax(worst, fabs(wanted[c] - (double)rgba[c]));
    }
  CHECK_NEAR(worst, 0, tolerance);
}

static void test_shrink(void) {
  check_shrink(2, 2, 0, 0, 1e-6);
  check_shrink(4, 4, 3, 5, 1e-6);
  check_shrink(8, 8, 0, 0, 1e-6);
  check_shrink(20, 40, 0, 0, 1e-6);
  check_shrink(3, 3, 0, 0, 1e-6);
  check_shrink(1.5, 1.25, 0, 0, 1e-6);
  check_shrink(5.5, 2.75, 0.3, 0.7, 1e-6);
  check_shrink(7.9, 7.9, 0.3, 0.7, 1e-6);
  check_shrink(1, 6, 0, 0, 1e-6);
  check_shrink(12.7, 12.7, 0.3, 0.7, 0.05); /* levels: right inside, nearly so at the edges */
}

static void test_checker(void) {
  const double factors[] = {8, 16, 3.7, 11.3, 64};
  for (int i = 0; i < 5; i++) {
    cs_sampler s =
        make_sampler(check_picture, 256, 256, affine(1 / factors[i], 0, 0, 0, 1 / factors[i], 0),
                     CELSPAN_SAMPLING_AUTO, CELSPAN_WRAP_CLEAR);
    double tolerance = factors[i] == floor(factors[i]) ? 1e-6 : 0.5 / (factors[i] * factors[i]);
    for (int x = 0; x + 1 < 256 / factors[i]; x++) {
      float rgba[4];
      sample(&s, x, x, rgba);
      CHECK_NEAR((double)rgba[0], 0.5, tolerance);
      CHECK(rgba[3] == 1);
    }
  }
  /* Turned and shrunk. */
  cs_sampler s = make_sampler(check_picture, 256, 256, affine(0.08, -0.06, 20, 0.06, 0.08, 0),
                              CELSPAN_SAMPLING_AUTO, CELSPAN_WRAP_CLEAR);
  float rgba[4];
  sample(&s, 21, 17, rgba);
  CHECK_NEAR((double)rgba[0], 0.5, 0.01);
  CHECK(rgba[3] == 1);
}

/* Rings too fine for the shrunk picture become grey, not other rings. */
static void test_zone_plate(void) {
  const celspan_matrix placements[] = {affine(0.25, 0, 0, 0, 0.25, 0),
                                       affine(0.2, -0.15, 40, 0.15, 0.2, 0)};
  for (int p = 0; p < 2; p++) {
    cs_sampler s = make_sampler(zone_picture, 256, 256, placements[p], CELSPAN_SAMPLING_AUTO,
                                CELSPAN_WRAP_CLEAR);
    double worst = 0;
    for (int y = 0; y < 70; y++)
      for (int x = 0; x < 70; x++) {
        const double *m = s.inverse.m;
        double u = m[0] * (x + 0.5) + m[1] * (y + 0.5) + m[2];
        double v = m[3] * (x + 0.5) + m[4] * (y + 0.5) + m[5];
        double r = hypot(u - 128, v - 128);
        /* The period at r is 256 / r pixels; a pixel of the frame covers 4. Stay off the places
         * where the picture itself has wrapped around. */
        if (u < 4 || v < 4 || u > 252 || v > 252 || r < 90)
          continue;
        float rgba[4];
        sample(&s, x, y, rgba);
        worst = fmax(worst, fabs((double)rgba[0] - 0.5));
      }
    CHECK_NEAR(worst, 0, p ? 0.2 : 0.25);
  }
}

/* ---------------------------------------------------------------- perspective and brute force */

/* The mean of many bilinear samples over the pixel. */
static void brute_force(const cs_sampler *s, int x, int y, int taps, double out[4]) {
  const double *m = s->inverse.m;
  memset(out, 0, 4 * sizeof *out);
  for (int i = 0; i < taps * taps; i++) {
    double px = x + (i % taps + 0.5) / taps, py = y + (i / taps + 0.5) / taps;
    double w = m[6] * px + m[7] * py + m[8];
    double u = (m[0] * px + m[1] * py + m[2]) / w - 0.5,
           v = (m[3] * px + m[4] * py + m[5]) / w - 0.5;
    double fu = u - floor(u), fv = v - floor(v);
    int iu = (int)floor(u), iv = (int)floor(v);
    for (int c = 0; c < 4; c++)
      out[c] +=
          ((double)noise[iv][iu][c] * (1 - fu) + (double)noise[iv][iu + 1][c] * fu) * (1 - fv) +
          ((double)noise[iv + 1][iu][c] * (1 - fu) + (double)noise[iv + 1][iu + 1][c] * fu) * fv;
  }
  for (int c = 0; c < 4; c++)
    out[c] /= taps * taps;
}

static double compare_with_force(const cs_sampler *s, int x0, int x1, int y0, int y1, int taps,
                                 double *deviation) {
  double worst = 0, squares = 0, count = 0;
  for (int y = y0; y < y1; y += 2)
    for (int x = x0; x < x1; x += 2, count++) {
      float rgba[4];
      double wanted[4];
      sample(s, x, y, rgba);
      brute_force(s, x, y, taps, wanted);
      double off = fabs(wanted[0] - (double)rgba[0]);
      worst = fmax(worst, off);
      squares += off * off;
    }
  *deviation = sqrt(squares / count);
  return worst;
}

static void test_perspective(void) {
  double deviation;
  /* Enlarged: one interpolated sample at the centre, so one tap is enough. */
  celspan_matrix near = {{3, 0.2, 10, 0.1, 3.5, 20, 0.0004, 0.0006, 1}};
  cs_sampler s =
      make_sampler(noise_picture, SIDE, SIDE, near, CELSPAN_SAMPLING_BILINEAR, CELSPAN_WRAP_CLEAR);
  CHECK_NEAR(compare_with_force(&s, 100, 200, 150, 220, 1, &deviation), 0, 1e-5);
  /* Shrunk, and more along one axis than the other. */
  celspan_matrix far = {{0.6, 0.05, 5, 0.02, 0.25, 3, 0.0008, 0.0012, 1}};
  s = make_sampler(noise_picture, SIDE, SIDE, far, CELSPAN_SAMPLING_AUTO, CELSPAN_WRAP_CLEAR);
  compare_with_force(&s, 30, 70, 12, 32, 16, &deviation);
  CHECK_NEAR(deviation, 0, 0.06);
  celspan_matrix turned = affine(0.3, -0.3, 70, 0.3, 0.3, 2);
  s = make_sampler(noise_picture, SIDE, SIDE, turned, CELSPAN_SAMPLING_AUTO, CELSPAN_WRAP_CLEAR);
  compare_with_force(&s, 60, 80, 40, 70, 16, &deviation);
  CHECK_NEAR(deviation, 0, 0.06);
}

static void test_horizon(void) {
  cs_sampler s = {.picture = noise_picture,
                  .width = SIDE,
                  .height = SIDE,
                  .wrap = CELSPAN_WRAP_REPEAT,
                  .inverse = {{1, 0, 0, 0, 0, 100, 0, 0.1, -1}}}; /* w = 0.1 y - 1 */
  cs_sampler_prepare(&s);
  float rgba[4];
  for (int y = 0; y < 9; y++) {
    sample(&s, 5, y, rgba);
    CHECK(rgba[0] == 0 && rgba[3] == 0);
  }
  sample(&s, 5, 30, rgba);
  CHECK(rgba[3] > 0);
}

static void test_cubic(void) {
  cs_sampler s = make_sampler(noise_picture, SIDE, SIDE, affine(4, 0, 0, 0, 4, 0),
                              CELSPAN_SAMPLING_BICUBIC, CELSPAN_WRAP_CLEAR);
  double low = 1, high = 0;
  for (int y = 0; y < 200; y += 3)
    for (int x = 0; x < 200; x++) {
      float rgba[4];
      sample(&s, x, y, rgba);
      low = fmin(low, (double)rgba[0]);
      high = fmax(high, (double)rgba[0]);
    }
  CHECK(low >= 0 && high <= 1);
  /* Between texels 40 and 41 of row 30, at 5/8 of the way, in the row's 1/8 below its centre:
   * separable weights by hand. */
  float rgba[4];
  sample(&s, 4 * 40 + 3, 4 * 30 + 2, rgba);
  double tx = 0.375, ty = 0.125, wanted = 0, least = 1, most = 0;
  for (int j = -1; j <= 2; j++)
    for (int i = -1; i <= 2; i++) {
      double a[2] = {fabs(i - tx), fabs(j - ty)}, w[2];
      for (int k = 0; k < 2; k++)
        w[k] = a[k] < 1 ? 1.5 * a[k] * a[k] * a[k] - 2.5 * a[k] * a[k] + 1
                        : -0.5 * a[k] * a[k] * a[k] + 2.5 * a[k] * a[k] - 4 * a[k] + 2;
      double texel = (double)noise[30 + j][40 + i][2];
      wanted += w[0] * w[1] * texel;
      least = fmin(least, texel);
      most = fmax(most, texel);
    }
  CHECK_NEAR((double)rgba[2], fmax(least, fmin(most, wanted)), 1e-5);
}

/* ---------------------------------------------------------------- ways that must agree */

static const celspan_matrix all_placements[] = {
    {{1, 0, 13, 0, 1, -7, 0, 0, 1}},                  /* copied */
    {{1.7, 0, 3.3, 0, 1.3, -2, 0, 0, 1}},             /* rows, enlarged */
    {{-5.3, 0, 300.1, 0, 4.1, -2, 0, 0, 1}},          /* mirrored, a grid */
    {{0.3, 0, 3, 0, 0.4, 1, 0, 0, 1}},                /* rows, shrunk */
    {{0, -0.7, 120, 0.6, 0, 3, 0, 0, 1}},             /* a quarter turn, shrunk */
    {{1.5, 0.6, 9, -0.4, 1.7, 80, 0, 0, 1}},          /* tilted, enlarged */
    {{0.2, 0.1, 9, -0.1, 0.15, 30, 0, 0, 1}},         /* tilted, shrunk */
    {{0.5, 0.1, 10, 0.05, 0.6, 5, 0.001, 0.002, 1}}}; /* perspective */

enum { PLACEMENTS = sizeof all_placements / sizeof *all_placements, RUN = 150 };

typedef void (*try_sampler)(cs_sampler *sampler, double y);

/* Every placement, kernel and wrap. */
static void try_all(const cs_picture *picture, try_sampler try) {
  for (int p = 0; p < PLACEMENTS; p++)
    for (int sampling = 0; sampling <= CELSPAN_SAMPLING_BICUBIC; sampling++)
      for (int wrap = 0; wrap <= CELSPAN_WRAP_REPEAT; wrap++)
        for (int y = -4; y < 120; y += 31) {
          cs_sampler s = make_sampler(picture, SIDE, SIDE, all_placements[p],
                                      (celspan_sampling)sampling, (celspan_wrap)wrap);
          try(&s, y + 0.5);
        }
}

static int plane_count; /* runs whose samples came in planes */

static bool same_samples(const cs_sampler *s, cs_run run, const float (*wanted)[4]) {
  static cs_samples made;
  bool are_same = cs_sampler_samples(&texels, s, run, &made) == CELSPAN_OK;
  plane_count += made.are_planes;
  for (int32_t i = 0; i < run.x1 - run.x0; i++)
    for (int32_t c = 0; c < 4; c++) {
      int32_t lane = 4 * (i % 4) + i / 4 % 4, plane = i / CS_SAMPLES_PLANE * CS_SAMPLES_PLANE;
      const float *at =
          (const float *)made.rgba + (made.are_planes ? 4 * plane + 16 * c + lane : 4 * i + c);
      are_same = are_same && memcmp(at, &wanted[i][c], sizeof *at) == 0;
    }
  return are_same;
}

static void try_instructions(cs_sampler *s, double y) {
  float wanted[RUN][4], made[RUN][4];
  s->isa = CS_ISA_ANY;
  s->reads_codes = false;
  CHECK(cs_sampler_run(&texels, s, run_of(-20, RUN, y), wanted) == CELSPAN_OK);
  for (int k = 0; k < 2 * ((int)cs_isa_best() + 1); k++) {
    s->isa = (cs_isa)(k / 2);
    s->reads_codes = k % 2 == 1 && (s->isa != CS_ISA_AVX512 || cs_srgb8_decodes(s->isa));
    CHECK(cs_sampler_run(&texels, s, run_of(-20, RUN, y), made) == CELSPAN_OK);
    CHECK(memcmp(made, wanted, sizeof made) == 0);
    for (int32_t from = 0; from < RUN; from += 49)
      CHECK(same_samples(s, run_of(from - 20, RUN - from, y), (const float(*)[4])wanted + from));
  }
}

static void try_columns(cs_sampler *s, double y) {
  float whole[RUN][4], some[RUN][4];
  int32_t columns[RUN], count = 0;
  for (int32_t x = -20; x < RUN - 20; x += 1 + (x & 3))
    columns[count++] = x;
  CHECK(cs_sampler_run(&texels, s, run_of(-20, RUN, y), whole) == CELSPAN_OK);
  CHECK(cs_sampler_at(&texels, s, columns, count, y, some) == CELSPAN_OK);
  for (int32_t i = 0; i < count; i++)
    CHECK(same(some[i], whole[columns[i] + 20]));
}

/* Between steps a grid is of one colour, or a line. */
static void try_steps(cs_sampler *s, double y) {
  if (!cs_sampler_is_grid(s))
    return;
  enum { WIDE = 1200 };
  static float row[WIDE][4];
  int32_t ends[WIDE + 2] = {-20};
  size_t limit = cs_sampler_texel_edge_limit(s, run_of(-20, WIDE, y));
  size_t count = cs_sampler_texel_edges(s, run_of(-20, WIDE, y), ends + 1);
  CHECK(count <= limit && limit < WIDE / 2);
  ends[count + 1] = WIDE - 20;
  CHECK(cs_sampler_run(&texels, s, run_of(-20, WIDE, y), row) == CELSPAN_OK);
  int wrong = 0;
  for (size_t i = 0; i <= count; i++) {
    wrong += ends[i] >= ends[i + 1];
    int32_t first = ends[i] + 20, last = ends[i + 1] + 19;
    for (int32_t x = first; x <= last; x++)
      for (int c = 0; c < 4; c++) {
        float u = last > first ? (float)(x - first) / (float)(last - first) : 0;
        float line = row[first][c] + u * (row[last][c] - row[first][c]);
        wrong += !(fabsf(line - row[x][c]) <= (s->kernel == CS_SAMPLER_NEAREST ? 0 : 1e-5f));
      }
  }
  CHECK(wrong == 0);
}

static void try_codes(cs_sampler *s, double y) {
  float row[RUN][4];
  unsigned char codes[RUN][4];
  if (s->placement != CS_SAMPLER_COPY)
    return;
  CHECK(cs_sampler_run(&texels, s, run_of(-20, RUN, y), row) == CELSPAN_OK);
  CHECK(cs_sampler_codes(&texels, s, run_of(-20, RUN, y), codes[0]) == CELSPAN_OK);
  int wrong = 0;
  for (int x = 0; x < RUN; x++) {
    uint32_t code = cs_srgb8_pixel(row[x]);
    wrong += memcmp(&code, codes[x], sizeof code) != 0;
  }
  CHECK(wrong == 0);
}

/* ---------------------------------------------------------------- looks */

enum { TILES = 300 };

/* Clear, opaque and mixed in blocks of 100 by 100. */
static void paint_tiles(int x, int y, float rgba[4]) {
  int tile = (x / 100 + y / 100) % 3;
  paint_noise(x, y, rgba);
  rgba[3] = tile == 1 ? 1 : rgba[3];
  for (int c = 0; c < 4 && tile == 0; c++)
    rgba[c] = 0;
}

/* What an opacity says about samples is true of them, and it is not always "mixed". */
static void test_looks(void) {
  cs_picture *tiles = make_picture("tiles.exr", TILES, TILES, paint_tiles);
  int counts[3] = {0}, wrong = 0;
  for (int p = 0; p < PLACEMENTS && tiles; p++)
    for (int wrap = 0; wrap <= CELSPAN_WRAP_REPEAT; wrap++)
      for (int sampling = 0; sampling <= CELSPAN_SAMPLING_BICUBIC; sampling++)
        for (int y = -40; y < 300; y += 7)
          for (int x = -64; x < 320; x += 16) {
            cs_sampler s = make_sampler(tiles, TILES, TILES, all_placements[p],
                                        (celspan_sampling)sampling, (celspan_wrap)wrap);
            float row[16][4];
            cs_picture_opacity opacity;
            CHECK(cs_sampler_opacity(&texels, &s, run_of(x, 16, y + 0.5), &opacity) == CELSPAN_OK);
            counts[opacity]++;
            if (opacity == CS_PICTURE_MIXED)
              continue;
            CHECK(cs_sampler_run(&texels, &s, run_of(x, 16, y + 0.5), row) == CELSPAN_OK);
            for (int i = 0; i < 16; i++)
              wrong += opacity == CS_PICTURE_OPAQUE
                           ? row[i][3] != 1
                           : row[i][0] != 0 || row[i][1] != 0 || row[i][2] != 0 || row[i][3] != 0;
          }
  CHECK(wrong == 0);
  CHECK(counts[CS_PICTURE_OPAQUE] > 1000 && counts[CS_PICTURE_CLEAR] > 1000);
  cs_block_cache_finish(&texels);
  remove_picture("tiles.exr", tiles);
}

/* Blocks of a picture of 8-bit codes contain those codes, with the next texel after each row. */
static void test_coded(void) {
  cs_srgb8_curve curve;
  cs_srgb8_make_curve(&curve);
  for (int column = 0; column <= SIDE / CS_PICTURE_BLOCK; column++) {
    const bool is_last = column == SIDE / CS_PICTURE_BLOCK;
    int wrong = 0, width = is_last ? SIDE % CS_PICTURE_BLOCK : CS_PICTURE_BLOCK + 1;
    cs_picture_block *block, *floats;
    CHECK(cs_load_block(context, coded_picture, 0, column, 1, &block) == CELSPAN_OK);
    CHECK(block->is_coded);
    for (int y = 0; y < CS_PICTURE_BLOCK; y++)
      for (int x = 0; x < width; x++) {
        float light[4], wanted[4];
        cs_srgb8_colour(&curve,
                        (const unsigned char *)block->codes + 4 * (y * CS_PICTURE_CODES_ROW + x),
                        light);
        CHECK(picture_texel(context, coded_picture, 0, column * CS_PICTURE_BLOCK + x,
                            CS_PICTURE_BLOCK + y, wanted) == CELSPAN_OK);
        wrong += memcmp(light, wanted, sizeof light) != 0;
      }
    CHECK(wrong == 0);
    cs_store_release(block);
    CHECK(cs_load_block(context, noise_picture, 0, column, 1, &floats) == CELSPAN_OK);
    CHECK(!floats->is_coded);
    cs_store_release(floats);
  }
}

static void test_errors(void) {
  celspan_picture_desc desc = {.struct_size = sizeof desc, .file = "/nonexistent/picture.png"};
  cs_picture *picture;
  CHECK(cs_picture_create(context, &desc, &picture) == CELSPAN_OK);
  cs_sampler s = make_sampler(picture, 10, 10, affine(1, 0, 0, 0, 1, 0), CELSPAN_SAMPLING_AUTO,
                              CELSPAN_WRAP_CLEAR);
  float row[10][4];
  CHECK(cs_sampler_run(&texels, &s, run_of(0, 10, 0.5), row) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), "/nonexistent/picture.png"));
  cs_picture_unref(picture);
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  if (!picture_module_or_skip(context)) {
    celspan_context_destroy(context);
    return check_done();
  }
  cs_block_cache_init(&texels, context);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      paint_noise(x, y, noise[y][x]);
  noise_picture = make_picture("noise.exr", SIDE, SIDE, paint_noise);
  check_picture = make_picture("check.exr", 256, 256, paint_check);
  zone_picture = make_picture("zone.exr", 256, 256, paint_zone);
  coded_picture = make_picture("coded.png", SIDE, SIDE, paint_coded);
  if (noise_picture && check_picture && zone_picture && coded_picture) {
    test_copy();
    test_quarter_turns();
    test_half_pixel();
    test_nearest();
    test_runs();
    test_borders();
    test_repeat();
    test_shrink();
    test_checker();
    test_zone_plate();
    test_perspective();
    test_horizon();
    test_cubic();
    try_all(noise_picture, try_instructions);
    try_all(coded_picture, try_instructions);
    CHECK(plane_count > 0 || !cs_srgb8_decodes(cs_isa_best()));
    try_all(noise_picture, try_columns);
    try_all(noise_picture, try_steps);
    try_all(noise_picture, try_codes);
    try_all(coded_picture, try_codes);
    test_coded();
    test_looks();
    test_errors();
  }
  cs_block_cache_finish(&texels);
  remove_picture("noise.exr", noise_picture);
  remove_picture("check.exr", check_picture);
  remove_picture("zone.exr", zone_picture);
  remove_picture("coded.png", coded_picture);
  celspan_context_destroy(context);
  return check_done();
}
