/* Antialias "area": the exact mean of a row over each of its pixels.
 *
 *   active boundaries, cells --> edges --> lone boundaries --+--> target --> spans, or
 *                            \-> intervals -> local sweeps --+              retained edges
 *
 * Invariant: the mean is of composed colour (composite first, integrate after), and depends on the
 * plan and the row's number alone.
 */
#ifndef CS_AREA_AREA_H
#define CS_AREA_AREA_H

#include "area/commit.h"
#include "area/dense.h"
#include "area/edges.h"
#include "area/local_sweep.h"
#include "area/row_tools.h"

typedef struct cs_area {
  cs_row_tools tools; /* borrowed */
  cs_edges edges;     /* of the row being made */
  cs_target target;   /* receives the segments of the row */
  cs_local_sweep sweep;
  cs_dense dense;
  cs_commit commit; /* the order and cells that the row leaves for the next one */
} cs_area;

void cs_area_init(cs_area *area, const cs_row_tools *tools);
void cs_area_finish(cs_area *area, cs_memory *memory);
/* Row y. The boundaries and cells are at its top; they have reached its foot when it returns, and
 * are in the order that they have there as far as that is known. out: is empty, gets [0, width).
 * Errors: NO_MEMORY, CALLBACK; what composing meets is in composer->failure too. */
CELSPAN_CHECKED celspan_status cs_area_row(cs_area *area, int32_t y, cs_row *out);
/* The same, but the visible edges of the row are kept in `retained`, which is begun and sealed, and
 * no pixels are made. y: may lie beyond the frame. */
CELSPAN_CHECKED celspan_status cs_area_retain(cs_area *area, int32_t y, cs_retained_row *retained);

#endif
