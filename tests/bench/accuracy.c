/* How exact celspan's area antialiasing is, over all pixels of a frame.
 *
 *   accuracy drawing DRAWING SIDE K WAY   against the mean of pixel centres in each pixel
 *   accuracy fans|bars ROUNDS             light between shapes that abut: see leaks.h
 *
 * WAY, of the judged frame: swept, or mapped (scene.h).
 *
 * The reference is the same scene rendered K times as large without antialiasing. Only every
 * COARSE-th row of it is read; all rows are read for a row of pixels in which those find an error
 * above SUSPICIOUS. With a K of 512 these are 128 rows, which come within 1/255 of the truth at a
 * horizontal edge, so that no such pixel with an error above 2/255 is missed. Light is linear and
 * its differences are printed in 255ths: `worst`, `rms` over the red, green and blue of all pixels,
 * the number of pixels `over_two`, and the position of the worst.
 *
 *      a row of pixels         rows of centres, as spans
 *     |      |      |          |..............|......|  >---+  added up by pixel,
 *     |  .3  |  .8  |  <--->   |.........|...........|  >---+  divided by their number
 *     |      |      |          |....|................|  >---+
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "leaks.h"
#include "measure.h"
#include "scene.h"

#define CODES 255.0
#define SUSPICIOUS 1.0     /* of 255 */
#define FRAME_MOST 1048576 /* pixels a side that a frame may have */

enum { COARSE = 4, CHANNELS = 3 }; /* alpha is 1 over white */

typedef struct comparison {
  celspan_context *context;
  celspan_rows *judged;
  celspan_rows *coarse, *fine; /* the large frame for each: rows are cheapest in ascending order */
  int side, k;
  const char *way;
  double *values; /* of one row of pixels, CHANNELS each: sums of centres, then differences */
  double worst, square;
  int worst_x, worst_y;
  size_t over_two;
} comparison;

/* ---------------------------------------------------------------- the reference */

/* Columns [x0, x1) of a span, all in one pixel. */
static void add_piece(double *sums, const celspan_span *span, int32_t x0, int32_t x1) {
  double middle = 0.5 * ((double)x0 + x1 - 1) - span->origin;
  for (int c = 0; c < CHANNELS; c++)
    switch (span->kind) {
    case CELSPAN_SPAN_SINGLE:
      sums[c] += (x1 - x0) * (double)span->colour[c];
      break;
    case CELSPAN_SPAN_GRADIENT:
      sums[c] += (x1 - x0) * (span->colour[c] + span->slope[c] * middle);
      break;
    case CELSPAN_SPAN_ARRAY:
      for (int32_t x = x0; x < x1; x++)
        sums[c] += (double)span->array[4 * (size_t)(x - span->x0) + (size_t)c];
    }
}

static void add_span(const comparison *job, const celspan_span *span) {
  int32_t x = span->x0, pixel = x / job->k;
  for (; x < span->x1; pixel++) {
    int32_t end = (pixel + 1) * job->k, stop = end < span->x1 ? end : span->x1;
    add_piece(job->values + (size_t)CHANNELS * (size_t)pixel, span, x, stop);
    x = stop;
  }
}

static void add_rows(const comparison *job, celspan_rows *large, int y, int step) {
  const celspan_span *spans;
  size_t count;
  memset(job->values, 0, (size_t)job->side * CHANNELS * sizeof *job->values);
  for (int row = step / 2; row < job->k; row += step) {
    bench_check(job->context, celspan_rows_get(large, y * job->k + row, &spans, &count));
    for (size_t i = 0; i < count; i++)
      add_span(job, &spans[i]);
  }
}

/* ---------------------------------------------------------------- the judgement */

/* Makes differences of sums; returns the greatest. */
static double find_differences(const comparison *job, int y, int step) {
  double share = step / ((double)job->k * job->k), most = 0, *value = job->values;
  const celspan_span *spans;
  size_t count;
  float seen[4];
  bench_check(job->context, celspan_rows_get(job->judged, y, &spans, &count));
  for (size_t i = 0; i < count; i++)
    for (int32_t x = spans[i].x0; x < spans[i].x1; x++) {
      celspan_span_colour(&spans[i], x, seen);
      for (int c = 0; c < CHANNELS; c++, value++) {
        *value = CODES * (seen[c] - *value * share);
        most = fmax(most, fabs(*value));
      }
    }
  return most;
}

static void count_pixel(comparison *job, const double off[CHANNELS], int x, int y) {
  double most = 0;
  for (int c = 0; c < CHANNELS; c++) {
    most = fmax(most, fabs(off[c]));
    job->square += off[c] * off[c];
  }
  job->over_two += most > 2;
  if (most > job->worst) {
    job->worst = most;
    job->worst_x = x;
    job->worst_y = y;
  }
}

static void judge_row(comparison *job, int y) {
  add_rows(job, job->coarse, y, COARSE);
  if (find_differences(job, y, COARSE) > SUSPICIOUS) {
    add_rows(job, job->fine, y, 1);
    find_differences(job, y, 1);
  }
  for (int x = 0; x < job->side; x++)
    count_pixel(job, job->values + CHANNELS * (size_t)x, x, y);
}

static celspan_rows *open_rows(celspan_context *context, celspan_rostrum *rostrum, int side,
                               celspan_antialias_mode mode, const char *way) {
  const celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = bench_frame(&exposure, side, side, &mode);
  bench_choose_way(context, &desc, way);
  celspan_rows *rows;
  bench_check(context, celspan_rows_create(context, &desc, &rows));
  return rows;
}

static void judge_scene(comparison *job, celspan_rostrum *rostrum) {
  int large = job->side * job->k;
  job->values = malloc((size_t)job->side * CHANNELS * sizeof *job->values);
  if (!job->values)
    bench_stop("no memory for a row");
  job->judged = open_rows(job->context, rostrum, job->side, CELSPAN_ANTIALIAS_AREA, job->way);
  job->coarse = open_rows(job->context, rostrum, large, CELSPAN_ANTIALIAS_NONE, "swept");
  job->fine = open_rows(job->context, rostrum, large, CELSPAN_ANTIALIAS_NONE, "swept");
  for (int y = 0; y < job->side; y++)
    judge_row(job, y);
  celspan_rows_destroy(job->judged);
  celspan_rows_destroy(job->coarse);
  celspan_rows_destroy(job->fine);
  free(job->values);
}

static void judge_drawing(celspan_context *context, char **words) {
  bench_drawing drawing = bench_drawing_read(words[0]);
  comparison job = {
      .context = context, .side = atoi(words[1]), .k = atoi(words[2]), .way = words[3]};
  if (job.side < 1 || job.k % COARSE || job.k < COARSE || job.k > FRAME_MOST / job.side)
    bench_stop("K is a multiple of %d, and SIDE times K at most %d", COARSE, FRAME_MOST);
  celspan_rostrum *rostrum = bench_scene(context, &drawing, NULL);
  double begun = bench_wall();
  judge_scene(&job, rostrum);
  bench_tell("wall", bench_wall() - begun);
  bench_tell("worst", job.worst);
  bench_tell("rms", sqrt(job.square / ((double)CHANNELS * job.side * job.side)));
  bench_tell("over_two", (double)job.over_two);
  bench_tell("at_x", job.worst_x);
  bench_tell("at_y", job.worst_y);
  celspan_rostrum_unref(rostrum);
  bench_drawing_free(&drawing);
}

int main(int argc, char **argv) {
  celspan_context *context;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 2;
  if (argc == 6 && strcmp(argv[1], "drawing") == 0)
    judge_drawing(context, argv + 2);
  else if (argc == 3 && strcmp(argv[1], "fans") == 0)
    bench_tell_leaks(context, BENCH_FANS, atoi(argv[2]));
  else if (argc == 3 && strcmp(argv[1], "bars") == 0)
    bench_tell_leaks(context, BENCH_BARS, atoi(argv[2]));
  else
    bench_stop("usage: accuracy drawing DRAWING SIDE K WAY | fans ROUNDS | bars ROUNDS");
  bench_line_end();
  celspan_context_destroy(context);
  return 0;
}
