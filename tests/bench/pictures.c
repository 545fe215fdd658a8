#include "pictures.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure.h"

/* Something of every frequency, so that neither compression nor prediction of branches helps. */
static uint8_t grain(uint32_t x, uint32_t y, uint32_t channel) {
  uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ channel * 0xc2b2ae3du;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  return (uint8_t)(h >> 27);
}

static uint8_t tone(int x, int y, int channel) {
  double wave = sin(0.004 * x + channel) + sin(0.006 * y - 0.7 * channel) + sin(0.0003 * x * y / 7);
  return (uint8_t)(100 + 40 * wave + grain((uint32_t)x, (uint32_t)y, (uint32_t)channel));
}

/* Opaque in the middle, fading over the last fifth of the way to each side. */
static uint8_t matte(int x, int y) {
  double u = fmin(x + 0.5, BENCH_OVERLAY_WIDTH - x - 0.5) / (0.2 * BENCH_OVERLAY_WIDTH);
  double v = fmin(y + 0.5, BENCH_OVERLAY_HEIGHT - y - 0.5) / (0.2 * BENCH_OVERLAY_HEIGHT);
  return (uint8_t)(255 * fmin(1, fmin(u, v)) + 0.5);
}

static void paint(uint8_t *pixels, int width, int height, bool is_overlay, bool is_premultiplied,
                  bool is_bgra) {
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) {
      uint8_t *pixel = pixels + 4 * ((size_t)y * (size_t)width + (size_t)x);
      unsigned alpha = is_overlay ? matte(x, y) : 255;
      for (int c = 0; c < 3; c++) {
        unsigned value = tone(is_overlay ? x + 900 : x, is_overlay ? 3 * y : y, c);
        pixel[is_bgra ? 2 - c : c] =
            (uint8_t)(is_premultiplied ? (value * alpha + 127) / 255 : value);
      }
      pixel[3] = (uint8_t)alpha;
    }
}

static uint8_t *allocate(int width, int height) {
  uint8_t *pixels = malloc(4 * (size_t)width * (size_t)height);
  if (!pixels)
    bench_stop("out of memory");
  return pixels;
}

/* ---------------------------------------------------------------- matrices */

static void invert(const double m[9], double out[9]) {
  double determinant = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
                       m[2] * (m[3] * m[7] - m[4] * m[6]);
  const double adjugate[9] = {
      m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
      m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
      m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
  for (int i = 0; i < 9; i++)
    out[i] = adjugate[i] / determinant;
}

/* The unit square to a quadrilateral, the corners clockwise (Heckbert). */
static void from_square(const double q[4][2], double m[9]) {
  double dx1 = q[1][0] - q[2][0], dy1 = q[1][1] - q[2][1];
  double dx2 = q[3][0] - q[2][0], dy2 = q[3][1] - q[2][1];
  double sx = q[0][0] - q[1][0] + q[2][0] - q[3][0], sy = q[0][1] - q[1][1] + q[2][1] - q[3][1];
  double across = dx1 * dy2 - dx2 * dy1;
  double g = (sx * dy2 - dx2 * sy) / across, h = (dx1 * sy - sx * dy1) / across;
  const double made[9] = {q[1][0] - q[0][0] + g * q[1][0],
                          q[3][0] - q[0][0] + h * q[3][0],
                          q[0][0],
                          q[1][1] - q[0][1] + g * q[1][1],
                          q[3][1] - q[0][1] + h * q[3][1],
                          q[0][1],
                          g,
                          h,
                          1};
  memcpy(m, made, sizeof made);
}

static void place(bench_job *job) {
  const double w = BENCH_OVERLAY_WIDTH, h = BENCH_OVERLAY_HEIGHT, turn = 7 * 3.14159265358979 / 180;
  const double c = 0.8 * cos(turn), s = 0.8 * sin(turn);
  const double middle_x = BENCH_FRAME_WIDTH / 2.0, middle_y = BENCH_FRAME_HEIGHT / 2.0;
  const double affine[9] = {
      c, -s, middle_x - c * w / 2 + s * h / 2, s, c, middle_y - s * w / 2 - c * h / 2, 0, 0, 1};
  const double shift[9] = {1, 0, 512, 0, 1, 256, 0, 0, 1};
  const double quad[4][2] = {{900, 420}, {2900, 260}, {3080, 1800}, {760, 1640}};
  if (job->kind == BENCH_PERSPECTIVE) {
    from_square(quad, job->matrix);
    for (int row = 0; row < 3; row++) {
      job->matrix[3 * row] /= w;
      job->matrix[3 * row + 1] /= h;
    }
  } else
    memcpy(job->matrix, job->kind == BENCH_AFFINE ? affine : shift, sizeof affine);
  invert(job->matrix, job->inverse);
}

static void find_corners(bench_job *job) {
  static const double at[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const double *m = job->matrix;
  for (int i = 0; i < 4; i++) {
    double x = at[i][0] * BENCH_OVERLAY_WIDTH, y = at[i][1] * BENCH_OVERLAY_HEIGHT;
    double depth = m[6] * x + m[7] * y + m[8];
    job->corners[i][0] = (m[0] * x + m[1] * y + m[2]) / depth;
    job->corners[i][1] = (m[3] * x + m[4] * y + m[5]) / depth;
  }
}

bench_job bench_job_make(const char *name, int is_bgra) {
  static const char *const names[3] = {"affine", "perspective", "shift"};
  bench_job job = {.kind = BENCH_AFFINE};
  while (job.kind < 3 && strcmp(name, names[job.kind]) != 0)
    job.kind++;
  if (job.kind == 3)
    bench_stop("the raster jobs are affine, perspective and shift, not '%s'", name);
  job.ground = allocate(BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT);
  job.overlay = allocate(BENCH_OVERLAY_WIDTH, BENCH_OVERLAY_HEIGHT);
  paint(job.ground, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT, false, true, is_bgra);
  paint(job.overlay, BENCH_OVERLAY_WIDTH, BENCH_OVERLAY_HEIGHT, true, true, is_bgra);
  place(&job);
  find_corners(&job);
  return job;
}

void bench_job_free(bench_job *job) {
  free(job->ground);
  free(job->overlay);
}

/* ---------------------------------------------------------------- files */

/* Uncompressed Targa, 32 bits, from the upper left. */
static void write_targa(const char *folder, const char *name, int width, int height,
                        bool is_overlay) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  const uint8_t head[18] = {0,
                            0,
                            2,
                            0,
                            0,
                            0,
                            0,
                            0,
                            0,
                            0,
                            0,
                            0,
                            (uint8_t)(width & 255),
                            (uint8_t)(width >> 8),
                            (uint8_t)(height & 255),
                            (uint8_t)(height >> 8),
                            32,
                            0x28};
  size_t size = 4 * (size_t)width * (size_t)height;
  uint8_t *pixels = allocate(width, height);
  paint(pixels, width, height, is_overlay, false, true);
  FILE *file = fopen(path, "wb");
  if (!file || fwrite(head, sizeof head, 1, file) != 1 || fwrite(pixels, size, 1, file) != 1 ||
      fclose(file) != 0)
    bench_stop("%s could not be written", path);
  free(pixels);
}

void bench_pictures_write(const char *folder) {
  write_targa(folder, "ground.tga", BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT, false);
  write_targa(folder, "overlay.tga", BENCH_OVERLAY_WIDTH, BENCH_OVERLAY_HEIGHT, true);
}
