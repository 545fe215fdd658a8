/* Cels that are swept, as one sheet among those that are drawn from maps.
 *
 *   plan of the cels --sweep--> visible edges of each row of a swath --cells--> map of the swath
 *
 * The edges of a row are borders of that row, between the cells that the sweep has composed, so
 * the swath is summed (sums.h) like that of any drawing, its broken pixels are known, and those
 * that other drawings share are solved with the edges of all (exact.h). Lights are in the plan.
 *
 * Invariant: the map of a swath is a function of the plan and of the swath's first row.
 */
#pragma once

#include "engine/map/cells.h"
#include "engine/map/sums.h"
#include "engine/row/row.h"

/* The structure must not be moved. */
typedef struct cs_map_swept {
  const cs_plan *plan; /* borrowed; NULL: the sheet is drawn from a map */
  cs_row_maker maker;
  cs_retained_row retained;
  cs_map map; /* the map of the swath; it has the stack of the drawing */
  cs_map_cells cells;
  CS_ARRAY(uint32_t, numbers); /* the numbers in the map of the cells of the retained row */
  cs_map_drawing drawing;      /* the map on the frame's pixels */
} cs_map_swept;

/* Errors: NO_MEMORY; cs_map_swept_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_map_swept_init(cs_map_swept *swept, celspan_context *context,
                                                 const cs_plan *plan);
void cs_map_swept_finish(cs_map_swept *swept);
/* Makes the map of the swath that begins with a row. Errors: NO_MEMORY, and those of composing. */
CELSPAN_CHECKED celspan_status cs_map_swept_sweep(cs_map_swept *swept, int32_t row);
