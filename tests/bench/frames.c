#include "frames.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure.h"
#include "scene.h"

const celspan_coding bench_coded = {.struct_size = sizeof bench_coded,
                                    .depth = CELSPAN_DEPTH_8,
                                    .transfer = CELSPAN_TRANSFER_SRGB,
                                    .alpha = CELSPAN_ALPHA_STRAIGHT};
const celspan_coding bench_uncoded = {.struct_size = sizeof bench_uncoded,
                                      .depth = CELSPAN_DEPTH_8,
                                      .transfer = CELSPAN_TRANSFER_LINEAR,
                                      .alpha = CELSPAN_ALPHA_STRAIGHT};

static void choose_antialias(bench_frame_job *job, const char *antialias) {
  static const char *const kernels[] = {"box", "gaussian", "mitchell", "lanczos"};
  static const celspan_kernel numbers[] = {CELSPAN_KERNEL_BOX, CELSPAN_KERNEL_GAUSSIAN,
                                           CELSPAN_KERNEL_MITCHELL, CELSPAN_KERNEL_LANCZOS};
  job->mode = strcmp(antialias, "none") == 0 ? CELSPAN_ANTIALIAS_NONE : CELSPAN_ANTIALIAS_AREA;
  bench_choose_way(job->context, &job->desc, antialias);
  for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++)
    if (strcmp(antialias, kernels[i]) == 0) {
      job->mode = CELSPAN_ANTIALIAS_FILTER;
      job->filter = CELSPAN_FILTER_DESC;
      job->filter.kernel = numbers[i];
      job->desc.filter = &job->filter;
    }
}

/* 16 rows from the middle, as a host asks for that needs no more. */
static void choose_strip(celspan_frame_desc *desc) {
  enum { rows = 16 };
  desc->crop_y = (desc->height - rows) / 2;
  desc->crop_width = desc->width;
  desc->crop_height = rows;
}

void bench_job_open(bench_frame_job *job, int width, int height, const char *antialias,
                    const char *output, int workers) {
  job->exposure = (celspan_exposure){job->rostrum, 1};
  job->desc = bench_frame(&job->exposure, width, height, &job->mode);
  choose_antialias(job, antialias);
  if (strcmp(output, "strip") == 0)
    choose_strip(&job->desc);
  job->desc.workers = workers;
  job->output = output;
  job->pixels = NULL;
  if (strcmp(output, "whole") == 0 && !(job->pixels = calloc(4 * (size_t)width, (size_t)height)))
    bench_stop("no memory for the pixels");
}

void bench_job_render(void *user) {
  bench_frame_job *job = user;
  const celspan_sink nowhere = {.struct_size = sizeof nowhere, .row = NULL};
  celspan_context *context = job->context;
  celspan_statistics *statistics = &job->statistics;
  size_t stride = 4 * (size_t)job->desc.width;
  celspan_status status;
  *statistics = CELSPAN_STATISTICS;
  if (strcmp(job->output, "file") == 0)
    status = celspan_frame_write(context, &job->desc, job->file, NULL, statistics);
  else if (strcmp(job->output, "spans") == 0)
    status = celspan_frame_render(context, &job->desc, &nowhere, statistics);
  else
    status =
        celspan_frame_pixels(context, &job->desc, &bench_coded, job->pixels, stride, statistics);
  bench_check(context, status);
}

/* ---------------------------------------------------------------- digests */

typedef struct frame_digests {
  unsigned char *pixels; /* one row */
  uint64_t of_pixels;    /* 8 bits, as the benchmark codes them */
  uint64_t of_spans;     /* the ends of spans, and every bit of their values */
} frame_digests;

static celspan_status take_pixels(void *user, celspan_context *context, int32_t y,
                                  const celspan_span *spans, size_t count) {
  frame_digests *digests = user;
  (void)context, (void)y;
  celspan_spans_code(&bench_coded, spans, count, digests->pixels);
  digests->of_pixels =
      bench_digest(digests->of_pixels, digests->pixels, (size_t)spans[count - 1].x1, 4);
  return CELSPAN_OK;
}

static celspan_status take_spans(void *user, celspan_context *context, int32_t y,
                                 const celspan_span *spans, size_t count) {
  frame_digests *digests = user;
  uint64_t digest = digests->of_spans;
  for (size_t i = 0; i < count; i++) {
    const celspan_span *span = &spans[i];
    const int32_t head[] = {span->x0, span->x1, (int32_t)span->kind};
    digest = bench_digest(digest, (const uint8_t *)head, 3, 4);
    if (span->kind == CELSPAN_SPAN_ARRAY) {
      size_t values = 4 * (size_t)(span->x1 - span->x0);
      digest = bench_digest(digest, (const uint8_t *)span->array, values, 4);
      continue;
    }
    digest = bench_digest(digest, (const uint8_t *)span->colour, 4, 4);
    if (span->kind == CELSPAN_SPAN_GRADIENT) {
      digest = bench_digest(digest, (const uint8_t *)&span->origin, 1, 4);
      digest = bench_digest(digest, (const uint8_t *)span->slope, 4, 4);
    }
  }
  digests->of_spans = digest;
  return take_pixels(user, context, y, spans, count);
}

static void tell_digests(bench_frame_job *job) {
  frame_digests digests = {malloc(4 * (size_t)job->desc.width), BENCH_DIGEST_BEGIN,
                           BENCH_DIGEST_BEGIN};
  celspan_sink sink = {.struct_size = sizeof sink, .user = &digests, .row = take_spans};
  bench_check(job->context, celspan_frame_render(job->context, &job->desc, &sink, NULL));
  bench_tell_digest(digests.of_pixels);
  printf("span_digest %016llx ", (unsigned long long)digests.of_spans);
  digests.of_pixels = BENCH_DIGEST_BEGIN;
  sink = (celspan_sink){.struct_size = sizeof(celspan_sink),
                        .user = &digests,
                        .row = take_pixels,
                        .takes_codes = true};
  bench_check(job->context, celspan_frame_render(job->context, &job->desc, &sink, NULL));
  printf("code_digest %016llx ", (unsigned long long)digests.of_pixels);
  free(digests.pixels);
}

/* ---------------------------------------------------------------- measuring */

void bench_job_measure(bench_frame_job *job) {
  if (strcmp(job->output, "digest") == 0) {
    tell_digests(job);
    return;
  }
  if (job->desc.repeats)
    bench_job_render(job); /* makes the maps */
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
