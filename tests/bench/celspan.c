/* The jobs of celspan itself:
 *
 *   celspan shapes DRAWING SIDE area|none OUTPUT WORKERS [FILE]      OUTPUT: see frames.h
 *   celspan look DRAWING SIDE               the picture's cells, blended as coded values
 *   celspan digest DRAWING SIDE             of the pixels, to compare with what readers decode
 *   celspan soft DRAWING SIDE RADIUS KERNEL spans|row    RADIUS in pixels
 *   celspan picture|backed|planes ...       see picture_jobs.c
 */
#include <stdlib.h>
#include <string.h>

#include "drawing.h"
#include "frames.h"
#include "measure.h"
#include "picture_jobs.h"
#include "scene.h"

static void measure_shapes(bench_frame_job *job, int count, char **words) {
  if (count < 5)
    bench_stop("shapes DRAWING SIDE area|none OUTPUT WORKERS [FILE]");
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
    bench_stop("soft DRAWING SIDE RADIUS KERNEL spans|row");
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

/* ---------------------------------------------------------------- digests */

typedef struct digest_row {
  unsigned char *pixels;
  uint64_t digest;
} digest_row;

static celspan_status take_row(void *user, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  digest_row *row = user;
  (void)context, (void)y;
  celspan_spans_code(&bench_coded, spans, span_count, row->pixels);
  row->digest = bench_digest(row->digest, row->pixels, (size_t)spans[span_count - 1].x1, 4);
  return CELSPAN_OK;
}

static void tell_digest(bench_frame_job *job, int count, char **words) {
  if (count != 2)
    bench_stop("digest DRAWING SIDE");
  bench_drawing drawing = bench_drawing_read(words[0]);
  int side = atoi(words[1]);
  job->rostrum = bench_scene(job->context, &drawing, NULL);
  bench_job_open(job, side, side, "area", "row", 1);
  digest_row row = {malloc(4 * (size_t)side), BENCH_DIGEST_BEGIN};
  const celspan_sink sink = {.user = &row, .row = take_row};
  bench_check(job->context, celspan_frame_render(job->context, &job->desc, &sink, NULL));
  bench_tell_digest(row.digest);
  free(row.pixels);
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
    {"planes", bench_planes},
};

int main(int argc, char **argv) {
  bench_frame_job job = {0};
  size_t verb = 0, count = sizeof verbs / sizeof *verbs;
  while (argc > 1 && verb < count && strcmp(argv[1], verbs[verb].name) != 0)
    verb++;
  if (argc < 2 || verb == count)
    bench_stop("usage: %s shapes|look|digest|soft|picture|backed|planes ...", argv[0]);
  celspan_context_desc desc = {.struct_size = sizeof desc};
  if (verbs[verb].run == measure_soft)
    desc.defocus_bytes = 1; /* nothing is kept from run to run */
  if (celspan_context_create(&desc, &job.context) != CELSPAN_OK)
    return 2;
  verbs[verb].run(&job, argc - 2, argv + 2);
  bench_line_end();
  bench_job_close(&job);
  celspan_context_destroy(job.context);
  return 0;
}
