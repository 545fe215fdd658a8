/* A picture of the random shapes into a span file: `spanfile COUNT SIDE FILE [RUNS]`.
 *
 * One worker. Prints, without and with antialiasing, the least time of the runs: by the processor's
 * clock (engine, coding, packing, checksums, handing bytes to the system) and by the wall's, which
 * has in it the wait until they are on the disk; and bytes, spans a second and peak memory.
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
  int count = argc > 1 ? atoi(argv[1]) : 100, side = argc > 2 ? atoi(argv[2]) : 1000000;
  int runs = argc > 4 ? atoi(argv[4]) : 3;
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
    desc.workers = 1;
    celspan_file_desc file = CELSPAN_FILE_DESC;
    file.format = "span";
    celspan_statistics statistics;
    double processor = 1e30, wall = 1e30;
    for (int run = 0; run < runs; run++) {
      double processor_begun = seconds(CLOCK_PROCESS_CPUTIME_ID);
      double wall_begun = seconds(CLOCK_MONOTONIC);
      check(context, celspan_frame_write(context, &desc, argv[3], &file, &statistics));
      processor = least(processor, seconds(CLOCK_PROCESS_CPUTIME_ID) - processor_begun);
      wall = least(wall, seconds(CLOCK_MONOTONIC) - wall_begun);
    }
    struct stat there;
    if (stat(argv[3], &there) != 0)
      return 1;
    printf("%d shapes, %d x %d, %s to a span file  processor %.3f s  wall %.3f s  bytes %lld  "
           "spans %llu  million spans a second %.1f  peak %.1f MiB\n",
           count, side, side, names[way], processor, wall, (long long)there.st_size,
           (unsigned long long)statistics.spans, (double)statistics.spans / processor / 1e6,
           (double)statistics.peak_bytes / 1048576);
  }
  celspan_rostrum_unref(rostrum);
  celspan_context_destroy(context);
  return 0;
}
