#include "frames.h"

#include <stdlib.h>
#include <string.h>

#include "measure.h"
#include "scene.h"

const celspan_coding bench_coded = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_SRGB, CELSPAN_ALPHA_STRAIGHT};
const celspan_coding bench_uncoded = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_LINEAR,
                                      CELSPAN_ALPHA_STRAIGHT};

void bench_job_open(bench_frame_job *job, int width, int height, const char *antialias,
                    const char *output, int workers) {
  job->exposure = (celspan_exposure){job->rostrum, 1};
  job->mode = strcmp(antialias, "none") == 0 ? CELSPAN_ANTIALIAS_NONE : CELSPAN_ANTIALIAS_AREA;
  job->desc = bench_frame(&job->exposure, width, height, &job->mode);
  job->desc.workers = workers;
  job->output = output;
  job->pixels = NULL;
  if (strcmp(output, "whole") == 0 && !(job->pixels = calloc(4 * (size_t)width, (size_t)height)))
    bench_stop("no memory for the pixels");
}

void bench_job_render(void *user) {
  bench_frame_job *job = user;
  const celspan_sink nowhere = {.row = NULL};
  celspan_context *context = job->context;
  celspan_statistics *statistics = &job->statistics;
  size_t stride = 4 * (size_t)job->desc.width;
  celspan_status status;
  if (strcmp(job->output, "file") == 0)
    status = celspan_frame_write(context, &job->desc, job->file, NULL, statistics);
  else if (strcmp(job->output, "spans") == 0)
    status = celspan_frame_render(context, &job->desc, &nowhere, statistics);
  else
    status =
        celspan_frame_pixels(context, &job->desc, &bench_coded, job->pixels, stride, statistics);
  bench_check(context, status);
}

void bench_job_measure(bench_frame_job *job) {
  bench_measure(bench_job_render, job);
  bench_tell("spans", (double)job->statistics.spans);
  bench_tell("colours", (double)job->statistics.colour_evaluations);
  bench_tell("frame_bytes", (double)job->statistics.peak_bytes);
  bench_tell("array_pixels", (double)job->statistics.pixels_in_arrays);
}

void bench_job_look(bench_frame_job *job) {
  size_t width = (size_t)job->desc.width;
  bench_check(job->context, celspan_frame_pixels(job->context, &job->desc, &bench_uncoded,
                                                 job->pixels, 4 * width, NULL));
  bench_tell_picture(job->pixels, width, (size_t)job->desc.height);
}

void bench_job_close(bench_frame_job *job) {
  celspan_rostrum_unref(job->rostrum);
  free(job->pixels);
}
