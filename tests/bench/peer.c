/* The program around a peer:
 *
 *   PEER shapes DRAWING SIDE area|none BAND STRIDE    BAND rows at a time (0: one whole image),
 *                                                     every STRIDEth band; times are scaled up
 *   PEER picture affine|perspective|shift
 *   PEER look DRAWING SIDE                            the picture's cells, for agreement
 *   PEER film SHEET MIDDLE FRONT SIDE STEP            a frame of film.h, the mean of every STEPth
 */
#include "peer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure.h"

typedef struct shapes_job {
  bench_drawing drawing;
  uint8_t *band;
  int side, rows, stride;
  bool is_antialiased;
} shapes_job;

static void draw_shapes(void *user) {
  const shapes_job *job = user;
  const bench_peer *peer = &bench_peer_here;
  void *frame = peer->begin(&job->drawing, job->side, job->is_antialiased);
  for (int y = 0; y < job->side; y += job->rows * job->stride) {
    int rows = job->side - y < job->rows ? job->side - y : job->rows;
    peer->band(frame, job->band, job->side, rows, y);
  }
  peer->end(frame);
}

/* The share of rows that a run draws, turned over. */
static double scale_of(const shapes_job *job) {
  int drawn = 0;
  for (int y = 0; y < job->side; y += job->rows * job->stride)
    drawn += job->side - y < job->rows ? job->side - y : job->rows;
  return (double)job->side / drawn;
}

/* The cost of building the paths, which is needed in full even for a part of the bands. */
static bench_cost build_cost(const shapes_job *job) {
  bench_cost begun = bench_spent();
  bench_peer_here.end(bench_peer_here.begin(&job->drawing, job->side, job->is_antialiased));
  return bench_since(begun);
}

static shapes_job open_shapes(const char *path, int side, bool is_antialiased, int rows,
                              int stride) {
  shapes_job job = {.side = side, .stride = stride, .is_antialiased = is_antialiased};
  job.drawing = bench_drawing_read(path);
  job.rows = rows ? rows : side;
  job.band = calloc((size_t)side * (size_t)job.rows, 4);
  if (!job.band)
    bench_stop("no memory for a band of %d rows", job.rows);
  return job;
}

static void close_shapes(shapes_job *job) {
  free(job->band);
  bench_drawing_free(&job->drawing);
}

static void measure_shapes(char **words) {
  shapes_job job = open_shapes(words[0], atoi(words[1]), strcmp(words[2], "area") == 0,
                               atoi(words[3]), atoi(words[4]));
  bench_measure_part(draw_shapes, &job, (bench_part){scale_of(&job), build_cost(&job)});
  bench_tell("crossings", job.drawing.crossings * job.side);
  bench_line_end();
  close_shapes(&job);
}

static void swap_channels(uint8_t *pixels, size_t count) {
  for (size_t i = 0; i < count; i++, pixels += 4) {
    uint8_t blue = pixels[0];
    pixels[0] = pixels[2];
    pixels[2] = blue;
  }
}

static void tell_frame(uint8_t *pixels, int width, int height) {
  if (bench_peer_here.is_bgra)
    swap_channels(pixels, (size_t)width * (size_t)height);
  bench_tell_picture(pixels, (size_t)width, (size_t)height);
}

static void look(char **words) {
  shapes_job job = open_shapes(words[0], atoi(words[1]), true, 0, 1);
  draw_shapes(&job);
  tell_frame(job.band, job.side, job.side);
  bench_line_end();
  close_shapes(&job);
}

/* ---------------------------------------------------------------- pictures */

typedef struct picture_job {
  bench_job job;
  uint8_t *frame;
} picture_job;

static void draw_picture(void *user) {
  const picture_job *job = user;
  bench_peer_here.picture(&job->job, job->frame);
}

static void measure_picture(const char *name) {
  if (!bench_peer_here.picture ||
      (strcmp(name, "perspective") == 0 && !bench_peer_here.has_perspective))
    bench_stop("this peer has no such job");
  picture_job job = {.job = bench_job_make(name, bench_peer_here.is_bgra)};
  job.frame = calloc((size_t)BENCH_FRAME_WIDTH * BENCH_FRAME_HEIGHT, 4);
  bench_measure(draw_picture, &job);
  tell_frame(job.frame, BENCH_FRAME_WIDTH, BENCH_FRAME_HEIGHT);
  bench_line_end();
  free(job.frame);
  bench_job_free(&job.job);
}

/* ---------------------------------------------------------------- films */

typedef struct film_job {
  bench_drawing drawings[BENCH_FILM_CELS];
  void *cels[BENCH_FILM_CELS]; /* their paths */
  uint8_t *frame;
  int side, step;
} film_job;

static void draw_frame(const film_job *job, int number) {
  memset(job->frame, 0xff, 4 * (size_t)job->side * (size_t)job->side); /* white */
  for (int i = 0; i < BENCH_FILM_CELS; i++)
    bench_peer_here.place(job->cels[i], job->frame, job->side, bench_film_place(number, i));
}

static void draw_film(void *user) {
  const film_job *job = user;
  for (int number = 0; number < BENCH_FILM_FRAMES; number += job->step)
    draw_frame(job, number);
}

/* The job stays where it is: the cels refer to its drawings. */
static void open_film(film_job *job, char **words) {
  *job = (film_job){.side = atoi(words[3]), .step = atoi(words[4])};
  job->frame = malloc(4 * (size_t)job->side * (size_t)job->side);
  if (!job->frame || job->step < 1)
    bench_stop("no such film");
  for (int i = 0; i < BENCH_FILM_CELS; i++) {
    job->drawings[i] = bench_drawing_read(words[i]);
    job->cels[i] = bench_peer_here.begin(&job->drawings[i], job->side, true);
  }
}

static void close_film(film_job *job) {
  for (int i = 0; i < BENCH_FILM_CELS; i++) {
    bench_peer_here.end(job->cels[i]);
    bench_drawing_free(&job->drawings[i]);
  }
  free(job->frame);
}

static void measure_film(char **words) {
  film_job job;
  open_film(&job, words);
  int count = (BENCH_FILM_FRAMES + job.step - 1) / job.step;
  draw_frame(&job, 0); /* what is done once in a process */
  bench_measure_part(draw_film, &job, (bench_part){.scale = 1.0 / count});
  draw_frame(&job, BENCH_FILM_FRAMES / 2);
  tell_frame(job.frame, job.side, job.side);
  bench_line_end();
  close_film(&job);
}

int main(int argc, char **argv) {
  if (argc == 7 && strcmp(argv[1], "shapes") == 0)
    measure_shapes(argv + 2);
  else if (argc == 4 && strcmp(argv[1], "look") == 0)
    look(argv + 2);
  else if (argc == 3 && strcmp(argv[1], "picture") == 0)
    measure_picture(argv[2]);
  else if (argc == 7 && strcmp(argv[1], "film") == 0)
    measure_film(argv + 2);
  else
    bench_stop("usage: %s shapes|look|picture|film ...", argv[0]);
  return 0;
}
