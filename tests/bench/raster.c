/* Pictures onto a frame of 3840 x 2160, timed inside one process: `raster FOLDER [RUNS]`.
 *
 *   affine       a translucent picture of 2048 x 1536, turned by 7 degrees, at 0.8 of its size
 *   perspective  the same in a quadrilateral
 *   shift        the same, moved by whole pixels
 *   multiplane   six translucent pictures that fill the frame, each at a scale of its own
 *   enlarged     a picture of 64 x 64 over the whole frame, nearest and bilinear
 *   figure 14    geometry over one enlarged picture of 1000 x 1000, at growing sides, to spans
 *
 * The first three lie over an opaque picture as large as the frame. Prints the least and the median
 * time of interleaved runs, on one worker, to 8-bit pixels in a reused row. The pictures are written
 * into FOLDER if they are not there, and decoded before the first run.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "output/pixels.h"
#include "output/sink.h"

enum { WIDTH = 3840, HEIGHT = 2160, OVERLAY_WIDTH = 2048, OVERLAY_HEIGHT = 1536, RUNS_LIMIT = 200 };

static celspan_context *context;
static char folder[3000];

static void check(celspan_status status) {
  if (status == CELSPAN_OK)
    return;
  fprintf(stderr, "%s\n", celspan_context_error(context));
  exit(1);
}

/* ---------------------------------------------------------------- pictures */

static float noise(uint32_t x, uint32_t y, uint32_t salt) {
  uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ salt * 0xc2b2ae3du;
  h = (h ^ h >> 15) * 0x2c1b3c6du;
  h = (h ^ h >> 12) * 0x297a2d39u;
  return (float)((h ^ h >> 15) >> 8) * 0x1p-24f;
}

/* Slow waves with some grain. alpha: 1, or from 0.1 to 0.9 over the picture. */
static void paint_row(int32_t width, int32_t height, int32_t y, bool is_opaque, uint32_t salt,
                      float *row) {
  for (int32_t x = 0; x < width; x++) {
    float u = (float)x / (float)width, v = (float)y / (float)height;
    float alpha = is_opaque ? 1 : 0.1f + 0.4f * u + 0.4f * v;
    for (uint32_t c = 0; c < 3; c++) {
      float wave = c == 0 ? u : c == 1 ? v : 0.5f * (u + v);
      float grain = noise((uint32_t)x, (uint32_t)y, salt + c);
      row[4 * x + (int32_t)c] = alpha * (0.1f + 0.7f * wave * wave + 0.2f * grain);
    }
    row[4 * x + 3] = alpha;
  }
}

static const char *make_picture(const char *name, int32_t width, int32_t height, bool is_opaque,
                                uint32_t salt) {
  static char paths[16][4096];
  static int made;
  char *path = paths[made++];
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_sink sink;
  snprintf(path, sizeof paths[0], "%s/%s", folder, name);
  if (access(path, R_OK) == 0)
    return path;
  check(cs_sink_file(context, path, &file, &sink));
  check(sink.begin(sink.user, context, width, height));
  float *row = malloc((size_t)width * 4 * sizeof *row);
  for (int32_t y = 0; y < height; y++) {
    paint_row(width, height, y, is_opaque, salt, row);
    celspan_span span = {.x1 = width, .kind = CELSPAN_SPAN_ARRAY, .array = row};
    check(sink.row(sink.user, context, y, &span, 1));
  }
  free(row);
  check(sink.end(sink.user, context, CELSPAN_OK));
  return path;
}

/* ---------------------------------------------------------------- scenes */

enum { CELS = 8 };

typedef struct scene {
  celspan_cel *cels[CELS];
  size_t count;
} scene;

static void add_object(scene *s, celspan_object *object) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.objects = &object;
  desc.object_count = 1;
  check(celspan_cel_create(context, &desc, &s->cels[s->count++]));
  celspan_object_unref(object);
}

static void add_picture(scene *s, const char *file, double width, double height,
                        celspan_sampling sampling, celspan_matrix placement) {
  celspan_image_desc desc = {.picture = {.file = file, .sampling = sampling},
                             .width = width,
                             .height = height};
  celspan_object *plain, *placed;
  check(celspan_object_create_image(context, &desc, &plain));
  check(celspan_object_transform(context, plain, &placement, &placed));
  celspan_object_unref(plain);
  add_object(s, placed);
}

static celspan_rostrum *finish_scene(scene *s) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  celspan_rostrum *rostrum;
  desc.cels = s->cels;
  desc.cel_count = s->count;
  check(celspan_rostrum_create(context, &desc, &rostrum));
  for (size_t i = 0; i < s->count; i++)
    celspan_cel_unref(s->cels[i]);
  return rostrum;
}

static celspan_rostrum *make_overlay(const char *ground, const char *overlay,
                                     celspan_sampling sampling, celspan_matrix placement) {
  scene s = {0};
  add_picture(&s, ground, WIDTH, HEIGHT, CELSPAN_SAMPLING_AUTO, celspan_matrix_identity());
  add_picture(&s, overlay, OVERLAY_WIDTH, OVERLAY_HEIGHT, sampling, placement);
  return finish_scene(&s);
}

/* 7 degrees, x 0.8, the middle of the picture in the middle of the frame. */
static celspan_matrix affine_placement(void) {
  celspan_matrix m = celspan_matrix_translation(-OVERLAY_WIDTH / 2.0, -OVERLAY_HEIGHT / 2.0);
  m = celspan_matrix_then(m, celspan_matrix_scaling(0.8, 0.8));
  m = celspan_matrix_then(
      m, celspan_matrix_rotation(7 * 3.14159265358979323846 / 180, (celspan_point){0, 0}));
  return celspan_matrix_then(m, celspan_matrix_translation(WIDTH / 2.0, HEIGHT / 2.0));
}

/* A quadrilateral of 2.9 million pixels. */
static celspan_matrix perspective_placement(void) {
  const celspan_point from[4] = {
      {0, 0}, {OVERLAY_WIDTH, 0}, {OVERLAY_WIDTH, OVERLAY_HEIGHT}, {0, OVERLAY_HEIGHT}};
  const celspan_point to[4] = {{1100, 300}, {2700, 420}, {3000, 1900}, {700, 1800}};
  celspan_matrix m = celspan_matrix_identity();
  if (!celspan_matrix_quad(from, to, &m))
    exit(2);
  return m;
}

static celspan_rostrum *make_multiplane(const char *ground, const char *overlay) {
  scene s = {0};
  add_picture(&s, ground, WIDTH, HEIGHT, CELSPAN_SAMPLING_AUTO, celspan_matrix_identity());
  for (int i = 0; i < 6; i++) {
    double scale = 1.9 + 0.13 * i;
    celspan_matrix m = celspan_matrix_scaling(scale, scale);
    m = celspan_matrix_then(m, celspan_matrix_translation(-20.3 - 7.7 * i, -11.9 - 3.3 * i));
    add_picture(&s, overlay, OVERLAY_WIDTH, OVERLAY_HEIGHT, CELSPAN_SAMPLING_AUTO, m);
  }
  return finish_scene(&s);
}

static celspan_rostrum *make_enlarged(const char *file, celspan_sampling sampling) {
  scene s = {0};
  add_picture(&s, file, WIDTH, HEIGHT, sampling, celspan_matrix_identity());
  return finish_scene(&s);
}

/* Discs of all sizes, some translucent, over a picture that fills the film of 1 x 1. */
static celspan_rostrum *make_figure(const char *file, celspan_sampling sampling) {
  scene s = {0};
  celspan_object *discs[60], *all;
  add_picture(&s, file, 1, 1, sampling, celspan_matrix_identity());
  for (uint32_t i = 0; i < 60; i++) {
    celspan_texture *texture;
    celspan_paint paint = celspan_paint_rgb(noise(i, 1, 0), noise(i, 2, 0), noise(i, 3, 0),
                                            i % 3 ? 1 : 0.5f);
    check(celspan_texture_create_paint(context, &paint, &texture));
    double radius = 0.005 + 0.06 * (double)noise(i, 6, 0);
    celspan_ellipse_desc disc = {{(double)noise(i, 4, 0), (double)noise(i, 5, 0)}, radius, radius,
                                 texture};
    check(celspan_object_create_ellipse(context, &disc, &discs[i]));
    celspan_texture_unref(texture);
  }
  check(celspan_object_create_boolean(context, CELSPAN_UNION, discs, 60, &all));
  for (int i = 0; i < 60; i++)
    celspan_object_unref(discs[i]);
  add_object(&s, all);
  return finish_scene(&s);
}

/* ---------------------------------------------------------------- timing */

static celspan_status drop_row(void *user, celspan_context *in, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  (void)user, (void)in, (void)y, (void)spans, (void)span_count;
  return CELSPAN_OK;
}

static celspan_status code_row(void *user, celspan_context *in, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  static const celspan_coding coding = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_SRGB,
                                        CELSPAN_ALPHA_STRAIGHT};
  (void)in, (void)y;
  cs_pixels_row(&coding, spans, span_count, user);
  return CELSPAN_OK;
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now); /* one worker: processor time, free of waiting */
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct job {
  char name[64];
  celspan_rostrum *rostrum;
  double film_width, film_height;
  int32_t width, height;
  bool is_to_spans;
  double times[RUNS_LIMIT];
  celspan_statistics statistics;
} job;

static void run_job(job *j, int run, void *row) {
  celspan_exposure exposure = {j->rostrum, 1};
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  desc.exposures = &exposure;
  desc.exposure_count = 1;
  desc.film_width = j->film_width;
  desc.film_height = j->film_height;
  desc.width = j->width;
  desc.height = j->height;
  desc.workers = 1;
  celspan_sink sink = {
      .user = row, .row = j->is_to_spans ? drop_row : code_row, .takes_codes = !j->is_to_spans};
  double begun = seconds();
  check(celspan_frame_render(context, &desc, &sink, &j->statistics));
  if (run >= 0) /* the first one decodes the pictures */
    j->times[run] = 1e3 * (seconds() - begun);
}

static int compare(const void *p, const void *q) {
  double a = *(const double *)p, b = *(const double *)q;
  return (a > b) - (a < b);
}

static void report(job *j, int runs) {
  const celspan_statistics *s = &j->statistics;
  qsort(j->times, (size_t)runs, sizeof j->times[0], compare);
  printf("%-34s least %9.2f ms  median %9.2f ms  spans %9llu  arrays %8llu  of pixels %9llu\n",
         j->name, j->times[0], j->times[runs / 2], (unsigned long long)s->spans,
         (unsigned long long)s->array, (unsigned long long)s->pixels_in_arrays);
}

static job jobs[24];
static int job_count;

static void add_job(const char *name, celspan_rostrum *rostrum) {
  job *j = &jobs[job_count++];
  snprintf(j->name, sizeof j->name, "%s", name);
  j->rostrum = rostrum;
  j->film_width = j->width = WIDTH;
  j->film_height = j->height = HEIGHT;
}

static void add_figures(const char *picture) {
  static const int32_t sides[] = {1000, 4000, 8000, 16000, 30000};
  for (int k = 0; k < 2; k++)
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
      char name[64];
      snprintf(name, sizeof name, "figure 14, %s, %d", k ? "bilinear" : "nearest", (int)sides[i]);
      add_job(name,
              make_figure(picture, k ? CELSPAN_SAMPLING_BILINEAR : CELSPAN_SAMPLING_NEAREST));
      job *j = &jobs[job_count - 1];
      j->film_width = j->film_height = 1;
      j->width = j->height = sides[i];
      j->is_to_spans = true;
    }
}

static void add_jobs(void) {
  const char *ground = make_picture("ground.png", WIDTH, HEIGHT, true, 1);
  const char *overlay = make_picture("overlay.png", OVERLAY_WIDTH, OVERLAY_HEIGHT, false, 5);
  const char *small = make_picture("small.png", 64, 64, true, 9);
  const celspan_sampling ways[] = {CELSPAN_SAMPLING_BILINEAR, CELSPAN_SAMPLING_AUTO};
  const char *const names[] = {"bilinear", "auto"};
  for (int k = 0; k < 2; k++) {
    char name[64];
    snprintf(name, sizeof name, "affine, %s", names[k]);
    add_job(name, make_overlay(ground, overlay, ways[k], affine_placement()));
    snprintf(name, sizeof name, "perspective, %s", names[k]);
    add_job(name, make_overlay(ground, overlay, ways[k], perspective_placement()));
  }
  add_job("shift", make_overlay(ground, overlay, CELSPAN_SAMPLING_AUTO,
                                celspan_matrix_translation(877, 311)));
  add_job("ground alone", make_enlarged(ground, CELSPAN_SAMPLING_AUTO));
  add_job("multiplane", make_multiplane(ground, overlay));
  add_job("enlarged, nearest", make_enlarged(small, CELSPAN_SAMPLING_NEAREST));
  add_job("enlarged, bilinear", make_enlarged(small, CELSPAN_SAMPLING_BILINEAR));
  add_figures(make_picture("figure.png", 1000, 1000, true, 13));
}

int main(int argc, char **argv) {
  int runs = argc > 2 ? atoi(argv[2]) : 5;
  const char *only = argc > 3 ? argv[3] : "";
  if (argc < 2 || runs < 1 || runs > RUNS_LIMIT ||
      celspan_context_create(NULL, &context) != CELSPAN_OK) {
    fprintf(stderr, "raster FOLDER [RUNS [NAME]]: times the jobs whose names begin with NAME\n");
    return 2;
  }
  snprintf(folder, sizeof folder, "%s", argv[1]);
  add_jobs();
  void *row = calloc(30000, 4);
  for (int run = -1; run < runs; run++)
    for (int i = 0; i < job_count; i++)
      if (strncmp(jobs[i].name, only, strlen(only)) == 0)
        run_job(&jobs[i], run, row);
  for (int i = 0; i < job_count; i++) {
    if (strncmp(jobs[i].name, only, strlen(only)) == 0)
      report(&jobs[i], runs);
    celspan_rostrum_unref(jobs[i].rostrum);
  }
  free(row);
  celspan_context_destroy(context);
  return 0;
}
