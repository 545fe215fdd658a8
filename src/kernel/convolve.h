/* Rows through a filter kernel: the retained edges of the rows around a row, each weighted by the
 * share of the kernel that lies right of it.
 *
 *   rows y - 1 .. y + 1     |     /          retained edges
 *                     ______|____/_____
 *   kernel of pixel p  (    |   / )          the edges divide it: so much of it is left of them
 *                     ------|--/-------
 *   row y   [ flat ][ changes ][ flat ]      changes by column --sum--> spans
 *
 * An edge at x with the colour step d adds d times its height's share of the kernel to every pixel
 * right of it, and to those within the radius the share of that which lies right of x. So the cost
 * follows the edges, and stretches that no edge comes near remain one span.
 *
 * Layers that vary along a row are not filtered: a program is one more colour with some weight,
 * sampled at the centre of the pixel that is made.
 *
 * Invariant: a row is a function of the retained rows around it, added in order of their rows.
 */
#ifndef CS_KERNEL_CONVOLVE_H
#define CS_KERNEL_CONVOLVE_H

#include "kernel/convolve_parts.h"

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_convolve_init(cs_convolve *convolve, celspan_context *context,
                                                const cs_kernel *kernel, int32_t width);
void cs_convolve_finish(cs_convolve *convolve, cs_memory *memory);
/* Row y from `count` retained rows, sealed, from the topmost under its kernel to the lowest.
 * Errors: NO_MEMORY and what painting meets. */
CELSPAN_CHECKED celspan_status cs_convolve_row(cs_convolve *convolve, cs_painter *painter,
                                               const cs_retained_row *const *retained_rows,
                                               size_t count, int32_t y, cs_row *out);

#endif
