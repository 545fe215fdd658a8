/* Cover: the area right of a straight line in a pixel of a row, in doubles. The line crosses the
 * whole height of the row; for a shorter line, the area is smaller in proportion to its height.
 *
 *      low              high         low, high: its least and greatest x
 *       |                |
 *   +---`.--+-------+----|--+        first    area in a column that it leaves on the right side
 *   |   |#`.|#######|####|##|        last     area in a column that it enters on the left side
 *   |   |###|`.#####|####|##|        within   area in the only column that it crosses
 *   |   |###|##`.###|####|##|        passed   area in all columns up to some x
 *   |   |###|####`.#|####|##|
 *   |   |###|######`|.###|##|        by_twice: 1 / twice its width
 *   +---|---+-------+-`--|--+
 *     first            last
 *
 * Areas are rounded to multiples of 2^-28, as the heights of lines are, so sums of them are exact.
 * The areas left and right of the lines in a pixel sum to the whole pixel. So a pixel that two
 * black shapes with a common edge cover is black, and not nearly black.
 *
 * Invariants: the bits are the same whichever instructions compute them. All ways to the area of
 * one pixel differ by no more than rounding.
 */
#pragma once

#include "base/number.h"

/* Rounds to the nearest multiple of 2^-28, for |x| < 2^22: sums of such multiples are exact. */
static inline double cs_cover_round(double x) {
  const double bias = 0x1.8p24;
  return (x + bias) - bias;
}

/* As `by_twice`, for a line that may be upright: such a line counts as very thin. */
static inline double cs_cover_by_twice(double low, double high) {
  const double thin = 0x1p-100;
  return 0.5 / cs_number_most(high - low, thin);
}

/* The area in the column that ends at `end` > low, for a line that ends to the right of this
 * column. */
static inline double cs_cover_first(double low, double end, double by_twice) {
  return (end - low) * (end - low) * by_twice;
}

/* The area in the column that ends at `end`, for a line that lies within this column. */
static inline double cs_cover_within(double low, double high, double end) {
  return end - 0.5 * (low + high);
}

/* The area in the column that begins at `begin` <= high, for a line that begins left of this
 * column. */
static inline double cs_cover_last(double high, double begin, double by_twice) {
  return 1 - (high - begin) * (high - begin) * by_twice;
}

/* The area in all columns up to x. */
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
