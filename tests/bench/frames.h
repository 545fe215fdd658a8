/* Frames of celspan as jobs to be measured.
 *
 * INVARIANT: between open and close a job has its pixels if its output asks for them.
 */
#pragma once

#include "celspan/celspan.h"

extern const celspan_coding bench_coded;   /* 8-bit sRGB */
extern const celspan_coding bench_uncoded; /* values 0..1 as they are, which is what peers blend */

typedef struct bench_frame_job {
  celspan_context *context;
  celspan_rostrum *rostrum; /* released by close */
  celspan_exposure exposure;
  celspan_antialias_mode mode;
  celspan_filter_desc filter; /* of the frame, where it has one */
  celspan_frame_desc desc;
  celspan_statistics statistics; /* of the last frame */
  const char *output, *file;
  unsigned char *pixels;
} bench_frame_job;

/* antialias: area, by a way of bench_choose_way, none, or a kernel of its own radius: box,
 * gaussian, mitchell, lanczos.
 * output: spans, row (8-bit pixels into one row that is reused), strip (the same, of 16 rows in the
 * middle alone), whole (an image in memory), file (job->file, by its ending) or digest. The film is
 * 1 x 1; job->rostrum is already set.
 * borrowed */
void bench_job_open(bench_frame_job *job, int width, int height, const char *antialias,
                    const char *output, int workers);
void bench_job_render(void *job);
/* Measures frames and prints their statistics. If the output is digest, nothing is measured: a
 * frame is made once for its spans and once more for its codes, and their digests are printed. */
void bench_job_measure(bench_frame_job *job);
/* Prints the picture's cells; the output is whole. */
void bench_job_look(bench_frame_job *job);
void bench_job_close(bench_frame_job *job);
