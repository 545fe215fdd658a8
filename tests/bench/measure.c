#include "measure.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "instructions.h"

#define RUNS_LIMIT 300
#define DEFAULT_SECONDS 0.2

void bench_stop(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vfprintf(stderr, format, arguments);
  va_end(arguments);
  fputc('\n', stderr);
  exit(1);
}

static double seconds(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double bench_wall(void) { return seconds(CLOCK_MONOTONIC); }
double bench_processor(void) { return seconds(CLOCK_PROCESS_CPUTIME_ID); }

bench_cost bench_spent(void) {
  return (bench_cost){bench_wall(), bench_processor(), bench_instructions()};
}

bench_cost bench_since(bench_cost before) {
  bench_cost now = bench_spent();
  return (bench_cost){now.wall - before.wall, now.processor - before.processor,
                      now.instructions - before.instructions};
}

/* The most memory that was ever resident since the program began, in KiB: rusage would count the
 * program that started this one. */
static long peak_kib(void) {
  char line[256];
  long kib = 0;
  FILE *file = fopen("/proc/self/status", "r");
  while (file && fgets(line, sizeof line, file))
    if (sscanf(line, "VmHWM: %ld", &kib) == 1)
      break;
  if (file)
    fclose(file);
  return kib;
}

static int ascending(const void *p, const void *q) {
  double a = *(const double *)p, b = *(const double *)q;
  return (a > b) - (a < b);
}

/* Figures of the whole, ascending. */
static void make_whole(double *figures, int runs, double scale, double fixed) {
  qsort(figures, (size_t)runs, sizeof *figures, ascending);
  for (int i = 0; i < runs; i++)
    figures[i] = scale * figures[i] + (1 - scale) * fixed;
}

static void tell_times(const char *name, double *times, int runs, double scale, double fixed) {
  make_whole(times, runs, scale, fixed);
  printf("%s %.9g best_%s %.9g ", name, times[runs / 2], name, times[0]);
}

static void tell_instructions(double *counts, int runs, double scale, double fixed) {
  if (isnan(counts[0]))
    return;
  make_whole(counts, runs, scale, fixed);
  bench_tell("instructions", counts[runs / 2]);
}

/* What some runs cost, by one list a kind. */
typedef struct figures {
  double *wall, *processor, *instructions;
} figures;

static void tell_figures(figures of, int runs, bench_part part) {
  tell_times("wall", of.wall, runs, part.scale, part.fixed.wall);
  tell_times("processor", of.processor, runs, part.scale, part.fixed.processor);
  tell_instructions(of.instructions, runs, part.scale, part.fixed.instructions);
  printf("runs %d peak_kib %ld ", runs, peak_kib());
}

void bench_tell_cost(bench_cost cost, bench_part part) {
  tell_figures((figures){&cost.wall, &cost.processor, &cost.instructions}, 1, part);
}

/* The first run warms caches; it counts only if it alone uses up all the time available. */
void bench_measure_part(void (*job)(void *user), void *user, bench_part part) {
  static double wall[RUNS_LIMIT], processor[RUNS_LIMIT], instructions[RUNS_LIMIT];
  const char *told = getenv("BENCH_SECONDS");
  double limit = told ? atof(told) : DEFAULT_SECONDS, spent = 0;
  int runs = 0;
  for (bool is_first = true; runs < RUNS_LIMIT && (is_first || runs == 0 || spent < limit);
       is_first = false) {
    bench_cost begun = bench_spent();
    job(user);
    bench_cost cost = bench_since(begun);
    if (is_first && cost.wall < limit)
      continue;
    wall[runs] = cost.wall;
    processor[runs] = cost.processor;
    instructions[runs++] = cost.instructions;
    spent += cost.wall;
  }
  tell_figures((figures){wall, processor, instructions}, runs, part);
}

void bench_measure(void (*job)(void *user), void *user) {
  bench_measure_part(job, user, (bench_part){.scale = 1});
}

void bench_tell(const char *key, double value) { printf("%s %.12g ", key, value); }

void bench_tell_file(const char *path) {
  struct stat there;
  if (stat(path, &there) != 0)
    bench_stop("%s was not written", path);
  bench_tell("bytes", (double)there.st_size);
}

/* ---------------------------------------------------------------- agreement */

/* FNV-1a, a pixel at a time. */
uint64_t bench_digest(uint64_t digest, const uint8_t *pixels, size_t count, size_t channels) {
  for (size_t i = 0; i < count; i++, pixels += channels) {
    uint32_t alpha = channels == 4 ? pixels[3] : 255;
    uint32_t pixel = pixels[0] | (uint32_t)pixels[1] << 8 | (uint32_t)pixels[2] << 16 | alpha << 24;
    digest = (digest ^ pixel) * 0x100000001b3u;
  }
  return digest;
}

void bench_tell_digest(uint64_t digest) { printf("digest %016llx ", (unsigned long long)digest); }

#define CELLS 64

/* Means of 64 x 64 cells: edges hardly matter, a shape with a wrong place or colour does. */
void bench_tell_picture(const uint8_t *rgba, size_t width, size_t height) {
  fputs("picture ", stdout);
  for (size_t row = 0; row < CELLS; row++)
    for (size_t column = 0; column < CELLS; column++) {
      size_t y0 = row * height / CELLS, y1 = (row + 1) * height / CELLS;
      size_t x0 = column * width / CELLS, x1 = (column + 1) * width / CELLS;
      uint64_t sum[3] = {0}, count = (y1 - y0) * (x1 - x0);
      for (size_t y = y0; y < y1; y++)
        for (size_t x = x0; x < x1; x++)
          for (int c = 0; c < 3; c++)
            sum[c] += rgba[4 * (y * width + x) + (size_t)c];
      for (int c = 0; c < 3; c++)
        printf("%02x", (unsigned)((sum[c] + count / 2) / count));
    }
  putchar(' ');
}

void bench_line_end(void) { putchar('\n'); }
