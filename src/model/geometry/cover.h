/* Cover: the area right of a straight line in a pixel of a row, in doubles, for a line over a whole
 * row; that of a shorter one is as much less as it is.
 *
 *      low              high         low, high: its least and greatest x
 *       |                |
 *   +---`.--+-------+----|--+        first    the column on whose right side it goes on
 *   |   |#`.|#######|####|##|        last     the column that it has entered from the left
 *   |   |###|`.#####|####|##|        within   the same where it does not leave the column
 *   |   |###|##`.###|####|##|        passed   of all the columns up to some x, whichever they are
 *   |   |###|####`.#|####|##|
 *   |   |###|######`|.###|##|        by_twice: 1 / twice its width
 *   +---|---+-------+-`--|--+
 *     first            last
 *
 * Areas are rounded to multiples of 2^-28, as the heights of lines are, so sums of them are exact:
 * what lies left and right of lines in a pixel sums to the pixel, and one that abutting black
 * shapes cover together is black, not nearly so.
 *
 * Invariants: the bits are the same whichever instructions compute them. All ways to the area of
 * one pixel differ by no more than rounding.
 */
#pragma once

#include "base/number.h"

/* To the nearest multiple of 2^-28, for |x| < 2^22: sums of such numbers are exact. */
static inline double cs_cover_round(double x) {
  const double bias = 0x1.8p24;
  return (x + bias) - bias;
}

/* As `by_twice`, for a line that may be upright: an upright line counts as very thin. */
static inline double cs_cover_by_twice(double low, double high) {
  const double thin = 0x1p-100;
  return 0.5 / cs_number_most(high - low, thin);
}

/* In the column that ends at `end` > low, where the line ends beyond it. */
static inline double cs_cover_first(double low, double end, double by_twice) {
  return (end - low) * (end - low) * by_twice;
}

/* In the column that ends at `end`, where the line is within it. */
static inline double cs_cover_within(double low, double high, double end) {
  return end - 0.5 * (low + high);
}

/* In the column that begins at `begin` <= high, where the line begins before it. */
static inline double cs_cover_last(double high, double begin, double by_twice) {
  return 1 - (high - begin) * (high - begin) * by_twice;
}

/* In all columns up to x. */
static inline double cs_cover_passed(double low, double high, double by_twice, double x) {
  double until = cs_number_most(cs_number_least(x, high) - low, 0);
  return until * until * by_twice + cs_number_most(x - high, 0);
}

/* The area right of a line from xa to xb over a height, in the pixel of column p: 0..height,
 * rounded. */
static inline double cs_cover_of(double xa, double xb, double height, int32_t p) {
  double low = cs_number_least(xa, xb), high = cs_number_most(xa, xb);
  double by_twice = cs_cover_by_twice(low, high);
  return cs_cover_round(height * (cs_cover_passed(low, high, by_twice, p + 1) -
                                  cs_cover_passed(low, high, by_twice, p)));
}
