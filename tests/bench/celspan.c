/* The jobs of celspan itself:
 *
 *   celspan shapes DRAWING SIDE area|none OUTPUT WORKERS [FILE]
 *       OUTPUT: spans, row (8-bit pixels into one row that is used again), whole (an image in
 *       memory), file (FILE, by its ending)
 *   celspan look DRAWING SIDE               the picture's cells, blended as coded values
 *   celspan digest DRAWING SIDE             of the pixels, to compare with what readers decode
 *   celspan picture JOB FOLDER row|whole|spans
 *   celspan soft DRAWING SIDE RADIUS KERNEL spans|row    RADIUS in pixels
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "celspan/celspan.h"
#include "drawing.h"
#include "measure.h"
#include "pictures.h"
#include "scene.h"

static const celspan_coding coded = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_SRGB,
                                     CELSPAN_ALPHA_STRAIGHT};

/* Values 0..1 as they are, which is what the peers blend. */
static const celspan_coding uncoded = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_LINEAR,
                                       CELSPAN_ALPHA_STRAIGHT};

typedef struct frame_job {
  celspan_context *context;
  celspan_rostrum *rostrum;
  celspan_exposure exposure;
  celspan_antialias_mode mode;
  celspan_frame_desc desc;
  celspan_statistics statistics;
  const char *output, *file;
  uint8_t *pixels;
} frame_job;

/* ---------------------------------------------------------------- frames */

static void open_frame(frame_job *job, int width, int height, const char *antialias,
                       const char *output, int workers) {
  job->exposure = (celspan_exposure){job->rostrum, 1};
  job->mode = strcmp(antialias, "none") == 0 ? CELSPAN_ANTIALIAS_NONE : CELSPAN_ANTIALIAS_AREA;
  job->desc = bench_frame(&job->exposure, width, height, &job->mode);
  job->desc.workers = workers;
  job->output = output;
  job->pixels = calloc(4 * (size_t)width, strcmp(output, "whole") == 0 ? (size_t)height : 1);
  if (!job->pixels)
    bench_stop("no memory for the pixels");
}

static void render(void *user) {
  frame_job *job = user;
  const celspan_sink nowhere = {.row = NULL};
  celspan_context *context = job->context;
  celspan_statistics *statistics = &job->statistics;
  if (strcmp(job->output, "file") == 0)
    bench_check(context, celspan_frame_write(context, &job->desc, job->file, NULL, statistics));
  else if (strcmp(job->output, "whole") == 0)
    bench_check(context, celspan_frame_pixels(context, &job->desc, &coded, job->pixels,
                                              4 * (size_t)job->desc.width, statistics));
  else if (strcmp(job->output, "row") == 0)
    bench_check(context, celspan_frame_pixels(context, &job->desc, &coded, NULL, 0, statistics));
  else
    bench_check(context, celspan_frame_render(context, &job->desc, &nowhere, statistics));
}

static void tell_statistics(const celspan_statistics *s) {
  bench_tell("spans", (double)s->spans);
  bench_tell("colours", (double)s->colour_evaluations);
  bench_tell("frame_bytes", (double)s->peak_bytes);
  bench_tell("array_pixels", (double)s->pixels_in_arrays);
}

static void close_frame(frame_job *job) {
  celspan_rostrum_unref(job->rostrum);
  free(job->pixels);
}

static void measure_shapes(frame_job *job, int argc, char **words) {
  bench_drawing drawing = bench_drawing_read(words[0]);
  int side = atoi(words[1]);
  job->rostrum = bench_scene(job->context, &drawing, NULL);
  open_frame(job, side, side, words[2], words[3], atoi(words[4]));
  job->file = argc > 5 ? words[5] : NULL;
  bench_measure(render, job);
  tell_statistics(&job->statistics);
  bench_tell("crossings", drawing.crossings * side);
  if (job->file)
    bench_tell_file(job->file);
  bench_line_end();
  close_frame(job);
  bench_drawing_free(&drawing);
}

static void look(frame_job *job, char **words) {
  bench_drawing drawing = bench_drawing_read(words[0]);
  int side = atoi(words[1]);
  job->rostrum = bench_scene(job->context, &drawing, NULL);
  open_frame(job, side, side, "area", "whole", 1);
  bench_check(job->context, celspan_frame_pixels(job->context, &job->desc, &uncoded, job->pixels,
                                                 4 * (size_t)side, NULL));
  bench_tell_picture(job->pixels, (size_t)side, (size_t)side);
  bench_line_end();
  close_frame(job);
  bench_drawing_free(&drawing);
}

static void measure_soft(frame_job *job, char **words) {
  static const char *const kernels[] = {"gaussian", "box", "disc"};
  bench_drawing drawing = bench_drawing_read(words[0]);
  int side = atoi(words[1]), kernel = 0;
  while (kernel < 2 && strcmp(words[3], kernels[kernel]) != 0)
    kernel++;
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.defocus_radius = atof(words[2]) / side;
  cel.defocus_kernel = (celspan_defocus_kernel)kernel;
  job->rostrum = bench_scene(job->context, &drawing, &cel);
  open_frame(job, side, side, "area", words[4], 1);
  bench_measure(render, job);
  tell_statistics(&job->statistics);
  bench_line_end();
  close_frame(job);
  bench_drawing_free(&drawing);
}

/* ---------------------------------------------------------------- digests */

typedef struct digest_row {
  uint8_t *pixels;
  uint64_t digest;
} digest_row;

static celspan_status take_row(void *user, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  digest_row *row = user;
  (void)context, (void)y;
  celspan_spans_code(&coded, spans, span_count, row->pixels);
  row->digest = bench_digest(row->digest, row->pixels, (size_t)spans[span_count - 1].x1, 4);
  return CELSPAN_OK;
}

static void tell_digest(frame_job *job, char **words) {
  bench_drawing drawing = bench_drawing_read(words[0]);
  int side = atoi(words[1]);
  job->rostrum = bench_scene(job->context, &drawing, NULL);
  open_frame(job, side, side, "area", "row", 1);
  digest_row row = {job->pixels, BENCH_DIGEST_BEGIN};
  const celspan_sink sink = {.user = &row, .row = take_row};
  bench_check(job->context, celspan_frame_render(job->context, &job->desc, &sink, NULL));
  bench_tell_digest(row.digest);
  bench_line_end();
  close_frame(job);
  bench_drawing_free(&drawing);
}

/* ---------------------------------------------------------------- pictures */

static celspan_object *load(celspan_context *context, const char *folder, const char *name,
                            const char *colour) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  celspan_image_desc desc = {
      .picture = {.file = path, .colour = colour, .sampling = CELSPAN_SAMPLING_BILINEAR}};
  celspan_object *object;
  bench_check(context, celspan_object_create_image(context, &desc, &object));
  return object;
}

/* The ground and the overlay of a raster job on one cel; colour: what their values mean. */
static celspan_rostrum *load_job(celspan_context *context, const char *name, const char *folder,
                                 const char *colour) {
  bench_job asked = bench_job_make(name, 0);
  celspan_object *overlay = load(context, folder, "overlay.tga", colour);
  celspan_object *objects[2] = {load(context, folder, "ground.tga", colour)};
  celspan_matrix matrix;
  memcpy(matrix.m, asked.matrix, sizeof matrix.m);
  bench_check(context, celspan_object_transform(context, overlay, &matrix, &objects[1]));
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.objects = objects;
  cel.object_count = 2;
  celspan_rostrum *rostrum = bench_rostrum(context, &cel);
  celspan_object_unref(overlay);
  for (int i = 0; i < 2; i++)
    celspan_object_unref(objects[i]);
  bench_job_free(&asked);
  return rostrum;
}

static void open_picture(frame_job *job, char **words, const char *colour) {
  job->rostrum = load_job(job->context, words[0], words[1], colour);
  open_frame(job, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT, "area", words[2], 1);
  job->desc.film_width = BENCH_FRAME_WIDTH;
  job->desc.film_height = BENCH_FRAME_HEIGHT;
}

/* Timed in linear light; the cells are those of values blended as the peers blend them. */
static void measure_picture(frame_job *job, char **words) {
  open_picture(job, words, NULL);
  render(job); /* the pictures are in memory, as those of the peers */
  bench_measure(render, job);
  tell_statistics(&job->statistics);
  bool is_whole = strcmp(words[2], "whole") == 0;
  close_frame(job);
  if (is_whole) {
    open_picture(job, words, "linear");
    bench_check(job->context, celspan_frame_pixels(job->context, &job->desc, &uncoded, job->pixels,
                                                   (size_t)4 * BENCH_FRAME_WIDTH, NULL));
    bench_tell_picture(job->pixels, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT);
    close_frame(job);
  }
  bench_line_end();
}

int main(int argc, char **argv) {
  frame_job job = {0};
  const char *verb = argc > 1 ? argv[1] : "";
  celspan_context_desc desc = {.struct_size = sizeof desc};
  if (strcmp(verb, "soft") == 0)
    desc.defocus_bytes = 1; /* nothing is kept from run to run */
  if (celspan_context_create(&desc, &job.context) != CELSPAN_OK)
    return 2;
  if (strcmp(verb, "shapes") == 0 && argc >= 7)
    measure_shapes(&job, argc - 2, argv + 2);
  else if (strcmp(verb, "look") == 0 && argc == 4)
    look(&job, argv + 2);
  else if (strcmp(verb, "digest") == 0 && argc == 4)
    tell_digest(&job, argv + 2);
  else if (strcmp(verb, "soft") == 0 && argc == 7)
    measure_soft(&job, argv + 2);
  else if (strcmp(verb, "picture") == 0 && argc == 5)
    measure_picture(&job, argv + 2);
  else
    bench_stop("usage: %s shapes|look|digest|soft|picture ...", argv[0]);
  celspan_context_destroy(job.context);
  return 0;
}
