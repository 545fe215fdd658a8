/* The random-shape scenes, timed inside one process: `shapes COUNT SIDE [RUNS]`.
 *
 * Prints the least and the median time of interleaved runs, to spans and to 8-bit pixels in a
 * reused row, without and with antialiasing.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "output/pixels.h"
#include "random_shapes.h"

#define RUNS_LIMIT 1000

static celspan_status drop_row(void *user, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  (void)user, (void)context, (void)y, (void)spans, (void)span_count;
  return CELSPAN_OK;
}

static celspan_status code_row(void *user, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  static const celspan_coding coding = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_SRGB,
                                        CELSPAN_ALPHA_STRAIGHT};
  (void)context, (void)y;
  cs_pixels_row(&coding, spans, span_count, user);
  return CELSPAN_OK;
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now); /* one worker: processor time, free of waiting */
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int compare(const void *p, const void *q) {
  double a = *(const double *)p, b = *(const double *)q;
  return (a > b) - (a < b);
}

int main(int argc, char **argv) {
  static const char *const names[4] = {"spans none", "spans area", "pixels none", "pixels area"};
  static double times[4][RUNS_LIMIT];
  int count = argc > 1 ? atoi(argv[1]) : 100, side = argc > 2 ? atoi(argv[2]) : 4000;
  int runs = argc > 3 ? atoi(argv[3]) : 5;
  celspan_context *context;
  if (runs < 1 || runs > RUNS_LIMIT || celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 2;
  celspan_rostrum *rostrum = make_scene(context, count);
  celspan_exposure exposure = {rostrum, 1};
  celspan_statistics statistics[4];
  void *row = calloc((size_t)side, 4);
  for (int run = 0; run < runs; run++)
    for (int way = 0; way < 4; way++) {
      celspan_antialias_mode mode = way % 2 ? CELSPAN_ANTIALIAS_AREA : CELSPAN_ANTIALIAS_NONE;
      celspan_frame_desc desc = CELSPAN_FRAME_DESC;
      desc.exposures = &exposure;
      desc.exposure_count = 1;
      desc.film_width = desc.film_height = 1;
      desc.width = desc.height = side;
      desc.antialias = &mode;
      desc.workers = 1;
      celspan_sink sink = {.user = row, .row = way < 2 ? drop_row : code_row};
      double begun = seconds();
      check(context, celspan_frame_render(context, &desc, &sink, &statistics[way]));
      times[way][run] = 1e3 * (seconds() - begun);
    }
  for (int way = 0; way < 4; way++) {
    qsort(times[way], (size_t)runs, sizeof times[way][0], compare);
    printf("%d shapes, %d x %d, %-11s  least %8.2f ms  median %8.2f ms  spans %llu  colours %llu  "
           "peak %llu\n",
           count, side, side, names[way], times[way][0], times[way][runs / 2],
           (unsigned long long)statistics[way].spans,
           (unsigned long long)statistics[way].colour_evaluations,
           (unsigned long long)statistics[way].peak_bytes);
  }
  free(row);
  celspan_rostrum_unref(rostrum);
  celspan_context_destroy(context);
  return 0;
}
