/* Checks for unit tests: a plain main calls them and ends with `return check_done();`. A failed
 * check is printed with its place and the test continues.
 */
#pragma once

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int check_count, check_failures, check_skips;

static inline int check_record(int passed, const char *file, int line, const char *what) {
  check_count++;
  if (!passed && ++check_failures <= 20)
    fprintf(stderr, "%s:%d: failed: %s\n", file, line, what);
  return passed;
}

static inline int check_near(double a, double b, double tolerance, const char *file, int line,
                             const char *what) {
  char text[256];
  snprintf(text, sizeof text, "%s (%.17g against %.17g)", what, a, b);
  return check_record(fabs(a - b) <= tolerance, file, line, text);
}

static inline int check_text(const char *a, const char *b, const char *file, int line,
                             const char *what) {
  char text[16384]; /* two paths and more */
  snprintf(text, sizeof text, "%s (\"%s\" against \"%s\")", what, a ? a : "(null)",
           b ? b : "(null)");
  return check_record(a && b && strcmp(a, b) == 0, file, line, text);
}

/* Whether the case of this number, from 0 on, is tried here: if the environment variable is N, one
 * case in N is tried, beginning with the one that CELSPAN_SEED selects. */
static inline int check_is_drawn_by(const char *variable, int number) {
  const char *share = getenv(variable), *seed = getenv("CELSPAN_SEED");
  unsigned long one_in = share ? strtoul(share, NULL, 10) : 1;
  unsigned long first = seed ? strtoul(seed, NULL, 10) : 1;
  return one_in < 2 || ((unsigned long)number + first) % one_in == 0;
}

/* Builds with sanitizers try a part of the cases that a plain build tries. */
static inline int check_is_drawn(int number) { return check_is_drawn_by("CELSPAN_TESTS", number); }

/* Whether the thread sanitizer is active. It makes a test ten times as slow, and finds nothing in
 * code that runs on one thread: long tests leave such code to the other builds. */
static inline int check_is_for_threads(void) {
#if defined(__SANITIZE_THREAD__)
  return 1;
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
  return 1;
#else
  return 0;
#endif
#else
  return 0;
#endif
}

/* Each is 1 if the check passed, 0 if it failed. */
#define CHECK(condition) check_record(!!(condition), __FILE__, __LINE__, #condition)
#define CHECK_NEAR(a, b, tolerance)                                                                \
  check_near((a), (b), (tolerance), __FILE__, __LINE__, #a " near " #b)
#define CHECK_TEXT(a, b) check_text((a), (b), __FILE__, __LINE__, #a " is " #b)

/* Checks that cannot be made, with what they need. This is printed, and counted as skipped. */
static inline void check_skip(const char *what) {
  check_skips++;
  printf("skipped: %s\n", what);
}

static inline int check_done(void) {
  if (check_failures)
    printf("%d of %d checks failed\n", check_failures, check_count);
  else
    printf("%d checks passed\n", check_count);
  if (check_skips)
    printf("%d checks skipped\n", check_skips);
  return check_failures != 0;
}
