/* The bands of a layer: rows that are summed together (sample_sums.h, slices.h, neighbours.h),
 * those of means over pixels, of what is read along a shift (shifted.h), or of flat art, which are
 * made one after the other from its boundaries alone, through the kernel of the plans or line by
 * line (swept_lines.h).
 *
 *  plan of S --boundaries--> a row of nodes --\                 /--> polyline, where a row of nodes
 *                                              >--> even groups     is a row of pixels,
 *  plan of T --boundaries--> a row of nodes --/                 \--> or every node
 *
 * Of the latter only one row of nodes is held at a time, and groups of one colour are neither
 * written nor looked at node by node.
 */
#pragma once

#include "engine/defocus/defocus.h"

/* From now on the bands of a layer that has its plans are made when they are asked for, and kept
 * under its key. */
void cs_defocus_fill_bands(cs_defocus *defocus);
