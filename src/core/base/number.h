/* Numbers: checks for numbers from outside, and conversion to integers.
 *
 * Invariant: a number that passed cs_number_is_sane is finite and |x| <= 1e12; a double becomes an
 * integer only through the saturating helpers here (NaN becomes 0).
 */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#define CS_NUMBER_LIMIT 1e12

static inline bool cs_number_is_sane(double x) {
  return x >= -CS_NUMBER_LIMIT && x <= CS_NUMBER_LIMIT;
}

static inline int32_t cs_number_to_int32(double x) {
  return x != x ? 0 : x <= -2147483648.0 ? INT32_MIN : x >= 2147483647.0 ? INT32_MAX : (int32_t)x;
}

static inline int32_t cs_number_floor(double x) { return cs_number_to_int32(floor(x)); }
static inline int32_t cs_number_ceil(double x) { return cs_number_to_int32(ceil(x)); }

/* The first column or row whose centre is at or right of x: ceil(x - 1/2). */
static inline int32_t cs_number_first_centre(double x) { return cs_number_ceil(x - 0.5); }

static inline double cs_number_clamp(double x, double low, double high) {
  return x < low ? low : x > high ? high : x;
}

/* The length of a vector, with the same bits everywhere, which hypot does not promise. */
static inline double cs_number_length(double x, double y) { return sqrt(x * x + y * y); }

/* The lesser and the greater of two numbers without a branch, for places where no branch can be
 * predicted; b where one of them is NaN. */
static inline double cs_number_least(double a, double b) {
#ifdef __SSE2__
  return _mm_cvtsd_f64(_mm_min_sd(_mm_set1_pd(a), _mm_set1_pd(b)));
#else
  return a < b ? a : b;
#endif
}

static inline double cs_number_most(double a, double b) {
#ifdef __SSE2__
  return _mm_cvtsd_f64(_mm_max_sd(_mm_set1_pd(a), _mm_set1_pd(b)));
#else
  return a > b ? a : b;
#endif
}

static inline float cs_number_clampf(float x, float low, float high) {
  return x < low ? low : x > high ? high : x;
}

/* The nearest number of single precision. Compilers must keep the detour: where gcc 12 rounds two
 * numbers at once and widens them again, it takes both steps away, as if nothing was rounded. It
 * compares numbers of lanes and means their bits. */
static inline double cs_number_single(double x) {
  volatile float single = (float)x;
  return (double)single;
}

/* The row of a table at `at`, 0 .. rows, for interpolation between this row and the next one; the
 * table has rows + 1 rows. At the very end it is the last row but one. */
static inline int32_t cs_number_row(double at, int32_t rows) {
  return at < rows ? (int32_t)at : rows - 1;
}
