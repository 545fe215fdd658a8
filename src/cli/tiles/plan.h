/* What a run of `celspan tiles` makes: rectangles of tiles, level by level, and the places that the
 * page links to.
 */
#ifndef CS_CLI_TILES_PLAN_H
#define CS_CLI_TILES_PLAN_H

#include "cli/request.h"
#include "cli/tiles/pyramid.h"

typedef struct cs_tile_job {
  int32_t level;
  cs_pyramid_box tiles;
} cs_tile_job;

typedef struct cs_tile_place {
  double x, y, width; /* film units: the middle, and how much of it to show */
  char name[96];
} cs_tile_place;

typedef struct cs_tile_plan {
  cs_tile_job *jobs; /* by level, coarse to fine */
  size_t count, capacity;
  cs_tile_place *places;
  size_t place_count, place_capacity;
} cs_tile_plan;

/* frame: its film size and crop. out: all zero; has to be freed, also after a failure. OK, or
 * reported: USAGE, INPUT, LIMIT. */
cs_exit cs_tile_plan_make(celspan_context *context, const cs_request *request,
                          const cs_pyramid *pyramid, const celspan_frame_desc *frame,
                          cs_tile_plan *out);
void cs_tile_plan_free(celspan_context *context, cs_tile_plan *plan);

#endif
