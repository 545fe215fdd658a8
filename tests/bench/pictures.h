/* The raster jobs: a picture laid over another, at 3840 x 2160.
 *
 * INVARIANT: pixels are 8-bit RGBA; a job's own are premultiplied, those of the files straight.
 */
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  BENCH_FRAME_WIDTH = 3840,
  BENCH_FRAME_HEIGHT = 2160,
  BENCH_OVERLAY_WIDTH = 2048,
  BENCH_OVERLAY_HEIGHT = 1536
};

typedef enum bench_job_kind { BENCH_AFFINE, BENCH_PERSPECTIVE, BENCH_SHIFT } bench_job_kind;

typedef struct bench_job {
  bench_job_kind kind;
  uint8_t *ground, *overlay; /* premultiplied */
  double matrix[9];          /* row by row, overlay pixel to frame pixel, columns (x, y, 1) */
  double inverse[9];
  double corners[4][2]; /* where the overlay's corners go, from the upper left clockwise */
} bench_job;

/* name: affine, perspective or shift; channels in the order RGBA, or BGRA. */
bench_job bench_job_make(const char *name, int is_bgra);
void bench_job_free(bench_job *job);

/* Writes FOLDER/ground.tga and FOLDER/overlay.tga. */
void bench_pictures_write(const char *folder);

#ifdef __cplusplus
}
#endif
