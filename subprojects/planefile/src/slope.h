/* Guesses of new cells, from what their neighbours were before.
 *
 * Right of a chain that bounds something translucent lies what is left of it, seen through that:
 * in each channel, right = slope x left + something. The slope is the same all along the chain. So
 * where another chain crosses, and one of the two cells beside it is known, the other one is, too:
 *
 *       L | R          R' = R + slope (L' - L)
 *     ----+----
 *      L' | R'
 *
 * A slope is in 1/65536; one below 0 leads from right to left: left = -slope x right + something.
 */
#pragma once

#include "layout.h"

enum { PF_SLOPE = 65536, PF_GUESSES = 3 /* of a cell, at most */ };

/* The cells beside a chain, before and after a change; NULL: it is not known, or has a program. */
typedef struct pf_beside {
  const planefile_cell *before[2], *after[2]; /* left, right */
  int32_t slope;                              /* 0: there is none */
} pf_beside;

/* Rounded down. divisor: above 0. */
int64_t pf_divide(int64_t number, int64_t divisor);
/* Guesses a cell that is on one side after the change; false: there is no guess. */
bool pf_guess(const pf_beside *beside, const planefile_cell *cell, planefile_cell *out);
/* The slope by which the most bits are saved in changes of one chain; 0: there is none that is
 * worth it. The slopes of the changes are not used. */
int32_t pf_slope_find(const pf_beside *changes, size_t count);
