/* libvips: the raster jobs, and the Gaussian blur of a drawing that celspan drew.
 *
 *   vips picture affine|perspective|shift
 *   vips blur PICTURE RADIUS           sigma is half the radius, as celspan's is
 *   vips read PICTURE                  the digest of its 8-bit pixels, row by row
 */
#include <stdlib.h>
#include <string.h>
#include <vips/vips.h>

#include "measure.h"
#include "pictures.h"

typedef struct vips_job {
  VipsImage *ground, *overlay, *map;
  bench_job_kind kind;
  double matrix[9], sigma;
  uint8_t *out;
} vips_job;

static void check(int status) {
  if (status != 0)
    bench_stop("%s", vips_error_buffer());
}

/* Wraps 8-bit RGBA, borrowed. */
static VipsImage *wrap(uint8_t *pixels, int width, int height) {
  VipsImage *image = vips_image_new_from_memory(pixels, (size_t)width * (size_t)height * 4, width,
                                                height, 4, VIPS_FORMAT_UCHAR);
  image->Type = VIPS_INTERPRETATION_sRGB;
  return image;
}

/* A picture of this size that gives the source position of each of its pixels. */
static VipsImage *make_map(const double m[9]) {
  size_t count = (size_t)BENCH_FRAME_WIDTH * BENCH_FRAME_HEIGHT;
  float *at = malloc(count * 2 * sizeof *at);
  for (size_t i = 0; i < count; i++) {
    double x = (double)(i % BENCH_FRAME_WIDTH) + 0.5, y = (double)(i / BENCH_FRAME_WIDTH) + 0.5;
    double depth = m[6] * x + m[7] * y + m[8];
    at[2 * i] = (float)((m[0] * x + m[1] * y + m[2]) / depth - 0.5);
    at[2 * i + 1] = (float)((m[3] * x + m[4] * y + m[5]) / depth - 0.5);
  }
  VipsImage *map = vips_image_new_from_memory_copy(at, count * 2 * sizeof *at, BENCH_FRAME_WIDTH,
                                                   BENCH_FRAME_HEIGHT, 2, VIPS_FORMAT_FLOAT);
  free(at);
  return map;
}

static VipsImage *place(const vips_job *job) {
  VipsImage *placed = NULL;
  VipsInterpolate *bilinear = vips_interpolate_new("bilinear");
  VipsArrayInt *area = vips_array_int_newv(4, 0, 0, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT);
  const double *m = job->matrix;
  if (job->kind == BENCH_AFFINE)
    check(vips_affine(job->overlay, &placed, m[0], m[1], m[3], m[4], "odx", m[2], "ody", m[5],
                      "oarea", area, "interpolate", bilinear, NULL));
  else if (job->kind == BENCH_PERSPECTIVE)
    check(vips_mapim(job->overlay, &placed, job->map, "interpolate", bilinear, NULL));
  else
    check(vips_embed(job->overlay, &placed, (int)m[2], (int)m[5], BENCH_FRAME_WIDTH,
                     BENCH_FRAME_HEIGHT, NULL));
  vips_area_unref(VIPS_AREA(area));
  g_object_unref(bilinear);
  return placed;
}

/* Into existing memory. */
static void write_out(VipsImage *image, uint8_t *out) {
  size_t size = VIPS_IMAGE_SIZEOF_IMAGE(image);
  VipsImage *target = vips_image_new_from_memory(out, size, image->Xsize, image->Ysize,
                                                 image->Bands, image->BandFmt);
  check(vips_image_write(image, target));
  g_object_unref(target);
}

static void draw_picture(void *user) {
  const vips_job *job = user;
  VipsImage *placed = place(job), *over, *bytes;
  check(vips_composite2(job->ground, placed, &over, VIPS_BLEND_MODE_OVER, "premultiplied", TRUE,
                        NULL));
  check(vips_cast_uchar(over, &bytes, NULL));
  write_out(bytes, job->out);
  g_object_unref(bytes);
  g_object_unref(over);
  g_object_unref(placed);
}

static void measure_picture(const char *name) {
  bench_job asked = bench_job_make(name, 0);
  vips_job job = {.ground = wrap(asked.ground, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT),
                  .overlay = wrap(asked.overlay, BENCH_OVERLAY_WIDTH, BENCH_OVERLAY_HEIGHT),
                  .kind = asked.kind};
  memcpy(job.matrix, asked.matrix, sizeof job.matrix);
  if (job.kind == BENCH_PERSPECTIVE)
    job.map = make_map(asked.inverse);
  job.out = calloc((size_t)BENCH_FRAME_WIDTH * BENCH_FRAME_HEIGHT, 4);
  bench_measure(draw_picture, &job);
  bench_tell_picture(job.out, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT);
  bench_line_end();
  bench_job_free(&asked);
}

static void blur(void *user) {
  const vips_job *job = user;
  VipsImage *soft;
  check(vips_gaussblur(job->ground, &soft, job->sigma, NULL));
  write_out(soft, job->out);
  g_object_unref(soft);
}

static void measure_blur(char **words) {
  VipsImage *file = vips_image_new_from_file(words[0], NULL);
  if (!file)
    check(-1);
  vips_job job = {.ground = vips_image_copy_memory(file), .sigma = atof(words[1]) / 2};
  job.out = malloc(VIPS_IMAGE_SIZEOF_IMAGE(job.ground));
  bench_measure(blur, &job);
  bench_line_end();
}

static void read_picture(const char *path) {
  VipsImage *image = vips_image_new_from_file(path, "access", VIPS_ACCESS_SEQUENTIAL, NULL);
  if (!image)
    check(-1);
  VipsRegion *region = vips_region_new(image);
  uint64_t digest = BENCH_DIGEST_BEGIN;
  for (int y = 0; y < image->Ysize; y++) {
    const VipsRect row = {0, y, image->Xsize, 1};
    check(vips_region_prepare(region, &row));
    digest = bench_digest(digest, VIPS_REGION_ADDR(region, 0, y), (size_t)image->Xsize,
                          (size_t)image->Bands);
  }
  bench_tell_digest(digest);
  bench_line_end();
}

int main(int argc, char **argv) {
  if (argc < 3 || VIPS_INIT(argv[0]) != 0)
    bench_stop("usage: vips picture|blur|read ...");
  vips_concurrency_set(1);
  vips_cache_set_max(0); /* each run computes */
  if (strcmp(argv[1], "picture") == 0)
    measure_picture(argv[2]);
  else if (strcmp(argv[1], "blur") == 0 && argc == 4)
    measure_blur(argv + 2);
  else
    read_picture(argv[2]);
  return 0;
}
