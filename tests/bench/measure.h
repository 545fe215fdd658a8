/* What the programs of the benchmark share: repeating a job, and printing its results as a line.
 *
 * A job is first run once unmeasured if that is cheap, then until the seconds of the environment's
 * BENCH_SECONDS are spent or the limit of runs is reached. The line consists of `KEY VALUE` pairs
 * on standard output.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Ends the program with this sentence on standard error. */
#ifdef __GNUC__
__attribute__((format(printf, 1, 2), noreturn))
#endif
void bench_stop(const char *format, ...);

double bench_wall(void);
double bench_processor(void); /* of all threads of the process */

/* What the process has spent so far; instructions are NAN without a counter. */
typedef struct bench_cost {
  double wall, processor, instructions;
} bench_cost;
bench_cost bench_spent(void);
bench_cost bench_since(bench_cost before);

/* Runs job(user) as described above and prints wall and processor seconds, each median and least,
 * the median of instructions if they are counted, the number of runs, and the peak of memory in
 * KiB. The line is left open for more pairs. */
void bench_measure(void (*job)(void *user), void *user);

/* A job that does a part of the work as a sample of the whole: the share `fixed` of its cost occurs
 * once in the whole too, the rest is multiplied by `scale`. */
typedef struct bench_part {
  double scale;
  bench_cost fixed;
} bench_part;
/* Prints the same for a cost that was measured once, scaled likewise. */
void bench_tell_cost(bench_cost cost, bench_part part);
void bench_measure_part(void (*job)(void *user), void *user, bench_part part);

/* Adds a pair to the line. */
void bench_tell(const char *key, double value);
/* Adds the file's size as `bytes`. */
void bench_tell_file(const char *path);
/* Adds the means of 64 x 64 cells of a picture, in hexadecimal: for agreement of renderers. */
void bench_tell_picture(const uint8_t *rgba, size_t width, size_t height);
void bench_line_end(void);

/* A digest of pixels of 3 or 4 bytes, row after row; of 3, alpha is 255. */
#define BENCH_DIGEST_BEGIN 0xcbf29ce484222325u
uint64_t bench_digest(uint64_t digest, const uint8_t *pixels, size_t count, size_t channels);
void bench_tell_digest(uint64_t digest);

#ifdef __cplusplus
}
#endif
