/* Bands of flat art, from its boundaries alone: row after row, through the kernel of the plans or
 * line by line (lines.h).
 *
 *   plan of S --boundaries--> a row of nodes --\                 /--> polyline, where a row of nodes
 *                                               >--> even groups     is a row of pixels,
 *   plan of T --boundaries--> a row of nodes --/                 \--> or every node
 *
 * Only one row of nodes is held at a time, and groups of one colour are neither written nor looked
 * at node by node.
 */
#ifndef CS_DEFOCUS_FLAT_H
#define CS_DEFOCUS_FLAT_H

#include "defocus/edges.h"
#include "row/row.h"
#include "sample/defocused.h"

typedef struct cs_defocus_flat {
  const cs_defocused *grid;
  const cs_plan *plans;          /* one a plane */
  const cs_defocus_edges *edges; /* NULL: the plans have kernels */
} cs_defocus_flat;

/* Fills an empty band with the rows [first, end) of nodes. Errors: NO_MEMORY and those of the rows
 * of the plans. */
CELSPAN_CHECKED celspan_status cs_defocus_flat_fill(const cs_defocus_flat *flat,
                                                    celspan_context *context, int32_t first,
                                                    int32_t end, cs_defocus_band *band);

#endif
