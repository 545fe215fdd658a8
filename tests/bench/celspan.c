/* The jobs of celspan itself. ANTIALIAS and OUTPUT: see frames.h.
 *
 *   celspan shapes DRAWING SIDE ANTIALIAS OUTPUT WORKERS [FILE]
 *   celspan look DRAWING SIDE               the picture's cells, blended as coded values
 *   celspan digest DRAWING SIDE [ANTIALIAS] of the pixels, to compare with what readers decode, and
 *                                           of the spans
 *   celspan soft DRAWING SIDE RADIUS KERNEL OUTPUT       RADIUS in pixels
 *   celspan picture|backed|planes ...       see picture_jobs.c
 *   celspan film ...                        see film_jobs.h
 *   celspan plane ...                       see plane_jobs.h
 */
#include <stdlib.h>
#include <string.h>

#include "drawing.h"
#include "film_jobs.h"
#include "frames.h"
#include "measure.h"
#include "picture_jobs.h"
#include "plane_jobs.h"
#include "scene.h"

static void measure_shapes(bench_frame_job *job, int count, char **words) {
  if (count < 5)
    bench_stop("shapes DRAWING SIDE ANTIALIAS OUTPUT WORKERS [FILE]");
  bench_drawing drawing = bench_drawing_read(words[0]);
  int side = atoi(words[1]);
  job->rostrum = bench_scene(job->context, &drawing, NULL);
  bench_job_open(job, side, side, words[2], words[3], atoi(words[4]));
  job->file = count > 5 ? words[5] : NULL;
  bench_job_measure(job);
  bench_tell("crossings", drawing.crossings * side);
  if (job->file)
    bench_tell_file(job->file);
  bench_drawing_free(&drawing);
}

static void look(bench_frame_job *job, int count, char **words) {
  if (count != 2)
    bench_stop("look DRAWING SIDE");
  bench_drawing drawing = bench_drawing_read(words[0]);
  int side = atoi(words[1]);
  job->rostrum = bench_scene(job->context, &drawing, NULL);
  bench_job_open(job, side, side, "area", "whole", 1);
  bench_job_look(job);
  bench_drawing_free(&drawing);
}

static void measure_soft(bench_frame_job *job, int count, char **words) {
  static const char *const kernels[] = {"gaussian", "box", "disc"};
  if (count != 5)
    bench_stop("soft DRAWING SIDE RADIUS KERNEL OUTPUT");
  bench_drawing drawing = bench_drawing_read(words[0]);
  int side = atoi(words[1]), kernel = 0;
  while (kernel < 2 && strcmp(words[3], kernels[kernel]) != 0)
    kernel++;
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.defocus_radius = atof(words[2]) / side;
  cel.defocus_kernel = (celspan_defocus_kernel)kernel;
  job->rostrum = bench_scene(job->context, &drawing, &cel);
  bench_job_open(job, side, side, "area", words[4], 1);
  bench_job_measure(job);
  bench_drawing_free(&drawing);
}

static void tell_digest(bench_frame_job *job, int count, char **words) {
  if (count < 2)
    bench_stop("digest DRAWING SIDE [ANTIALIAS]");
  bench_drawing drawing = bench_drawing_read(words[0]);
  int side = atoi(words[1]);
  job->rostrum = bench_scene(job->context, &drawing, NULL);
  bench_job_open(job, side, side, count > 2 ? words[2] : "area", "digest", 1);
  bench_job_measure(job);
  bench_drawing_free(&drawing);
}

/* ---------------------------------------------------------------- the program */

static const struct {
  const char *name;
  void (*run)(bench_frame_job *job, int count, char **words);
} verbs[] = {
    {"shapes", measure_shapes}, {"look", look},
    {"digest", tell_digest},    {"soft", measure_soft},
    {"picture", bench_picture}, {"backed", bench_backed},
    {"planes", bench_planes},   {"film", bench_film},
    {"plane", bench_plane},
};

int main(int argc, char **argv) {
  bench_frame_job job = {0};
  size_t verb = 0, count = sizeof verbs / sizeof *verbs;
  while (argc > 1 && verb < count && strcmp(argv[1], verbs[verb].name) != 0)
    verb++;
  if (argc < 2 || verb == count)
    bench_stop("usage: %s shapes|look|digest|soft|picture|backed|planes|film|plane ...", argv[0]);
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  if (verbs[verb].run == measure_soft)
    desc.defocus_bytes = 1; /* nothing is kept between runs */
  if (celspan_context_create(&desc, &job.context) != CELSPAN_OK)
    return 2;
  verbs[verb].run(&job, argc - 2, argv + 2);
  bench_line_end();
  bench_job_close(&job);
  celspan_context_destroy(job.context);
  return 0;
}
