/* By how much the lines of a page lie elsewhere than those of another one, without a turn.
 *
 *   darkness of the spots, at halved sizes --> at the smallest every shift of a twelfth of the page
 *     --> the best one, doubled, and its neighbours at the next larger size --> ... --> pixels
 *
 * INVARIANT: pages of one size; the best shift is where the products of darkness add up to most.
 */
#pragma once

#include "tools/scan/rough.h"

typedef struct cs_rough_shift {
  double x, y;     /* pixels that the page must move */
  double likeness; /* 0..1: of the lines after it */
} cs_rough_shift;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_shift_find(const cs_rough *page, const cs_rough *onto,
                                             cs_rough_shift *out);
