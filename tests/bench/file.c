/* A picture of the random shapes into a file: `file COUNT SIDE FILE [RUNS] [WORKERS]`.
 *
 * The format is the one of the file's ending. Prints, without and with antialiasing, the least time
 * of the runs by the wall's clock (the wait for the disk included) and by the processor's, the
 * bytes of the file, the spans (also in a second of the processor) and the peak of memory.
 */
#include <sys/stat.h>
#include <time.h>

#include "random_shapes.h"

static double seconds(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double least(double a, double b) { return a < b ? a : b; }

int main(int argc, char **argv) {
  static const char *const names[2] = {"none", "area"};
  int count = argc > 1 ? atoi(argv[1]) : 100, side = argc > 2 ? atoi(argv[2]) : 30000;
  int runs = argc > 4 ? atoi(argv[4]) : 3, workers = argc > 5 ? atoi(argv[5]) : 0;
  celspan_context *context;
  if (argc < 4 || celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 2;
  celspan_rostrum *rostrum = make_scene(context, count);
  celspan_exposure exposure = {rostrum, 1};
  for (int way = 0; way < 2; way++) {
    celspan_antialias_mode mode = way ? CELSPAN_ANTIALIAS_AREA : CELSPAN_ANTIALIAS_NONE;
    celspan_frame_desc desc = CELSPAN_FRAME_DESC;
    desc.exposures = &exposure;
    desc.exposure_count = 1;
    desc.film_width = desc.film_height = 1;
    desc.width = desc.height = side;
    desc.antialias = &mode;
    desc.workers = workers;
    celspan_statistics statistics;
    double processor = 1e30, wall = 1e30;
    for (int run = 0; run < runs; run++) {
      double processor_begun = seconds(CLOCK_PROCESS_CPUTIME_ID);
      double wall_begun = seconds(CLOCK_MONOTONIC);
      check(context, celspan_frame_write(context, &desc, argv[3], NULL, &statistics));
      processor = least(processor, seconds(CLOCK_PROCESS_CPUTIME_ID) - processor_begun);
      wall = least(wall, seconds(CLOCK_MONOTONIC) - wall_begun);
    }
    struct stat there;
    if (stat(argv[3], &there) != 0)
      return 1;
    printf("%d shapes, %d x %d, %s to %s  wall %.1f ms  processor %.1f ms  bytes %lld  "
           "spans %llu, %.1f million a second  peak %.1f MiB\n",
           count, side, side, names[way], argv[3], 1e3 * wall, 1e3 * processor,
           (long long)there.st_size, (unsigned long long)statistics.spans,
           (double)statistics.spans / processor / 1e6,
           (double)statistics.peak_bytes / 1048576);
  }
  celspan_rostrum_unref(rostrum);
  celspan_context_destroy(context);
  return 0;
}
