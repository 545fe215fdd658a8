/* Antialias "area": the exact mean of a row over each of its pixels.
 *
 *   active boundaries, cells --> edges --> lone boundaries --+--> target --> spans, or
 *                            \-> intervals -> local sweeps --+              retained edges
 *
 * Invariant: the mean is of composed colour (composite first, integrate after), and depends on the
 * plan and the row's number alone.
 */
#pragma once

#include "engine/area/crowd.h"
#include "engine/area/dense.h"
#include "engine/area/edges.h"
#include "engine/area/local_sweep.h"
#include "engine/area/row_tools.h"

typedef struct cs_area {
  cs_row_tools tools; /* borrowed */
  cs_edges edges;     /* the edges of the row being made */
  cs_target target;   /* receives the borders of the row */
  cs_local_sweep sweep;
  cs_dense dense;
  cs_crowd crowd;
} cs_area;

void cs_area_init(cs_area *area, const cs_row_tools *tools);
void cs_area_finish(cs_area *area, cs_memory *memory);
/* Row y. The boundaries are at its top; change: where the boundaries differ from those at the last
 * update of the cells. The order of both is not changed, and the boundaries have been advanced to
 * the foot of the row when the function returns. out: is empty, gets [0, width). Errors: NO_MEMORY,
 * CALLBACK; a failure of composing is in composer->failure too. */
CELSPAN_CHECKED celspan_status cs_area_row(cs_area *area, int32_t y, cs_change change, cs_row *out);
/* The same, but the visible edges of the row are kept in `retained`, which is begun and sealed, and
 * no pixels are made. y: may lie beyond the frame. */
CELSPAN_CHECKED celspan_status cs_area_retain(cs_area *area, int32_t y, cs_change change,
                                              cs_retained_row *retained);
