/* The order of boundaries at a height, from left to right: by x; of those that meet in a point, by
 * slope; of those with the same slope too, by the number of the chain. All that a row shows depends
 * on this rule and on nothing else, so it is the same for every strip, crop and worker.
 *
 *        a  b        a left of b: its x is less
 *         \ |
 *     -----*------   they meet: a comes from the left and has the greater slope dx/dy, so below
 *          |\        this height a is right of b
 *          b a
 */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* Whether a is right of b, where both have the same x. Callers compare x first: slopes are rarely
 * needed, and cost more. */
static inline bool cs_order_is_right(double slope_a, uint32_t chain_a, double slope_b,
                                     uint32_t chain_b) {
  return slope_a != slope_b ? slope_a > slope_b : chain_a > chain_b;
}
