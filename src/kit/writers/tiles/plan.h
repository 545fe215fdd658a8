/* The plan of a run: rectangles of tiles, level by level, and the places that the page links to. */
#pragma once

#include "writers/tiles/pyramid.h"

typedef struct cs_tile_job {
  int32_t level;
  cs_pyramid_box tiles;
} cs_tile_job;

typedef struct cs_tile_place {
  double x, y, width; /* film units: the centre, and the width to show */
  char name[96];
} cs_tile_place;

typedef struct cs_tile_plan {
  cs_tile_job *jobs; /* by level, coarse to fine */
  size_t count, capacity;
  cs_tile_place *places;
  size_t place_count, place_capacity;
} cs_tile_plan;

typedef struct cs_tile_plan_desc {
  const cs_pyramid *pyramid;
  const celspan_frame_desc *frame; /* the film's size, and the crop to make */
  int32_t levels[2];               /* first and last; on later levels, only the places are made */
  const char *places;              /* a file of lines X Y WIDTH NAME; NULL: no places */
} cs_tile_plan_desc;

/* out: all zero; must be freed, also after a failure. Errors: BAD_ARGUMENT, for a line that is not
 * a place; INPUT; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_tile_plan_make(celspan_context *context,
                                                 const cs_tile_plan_desc *desc, cs_tile_plan *out);
/* The number of tiles in the plan. */
int64_t cs_tile_plan_count(const cs_tile_plan *plan);
/* The largest last level for which the levels from desc->levels[0] on have at most `limit` tiles,
 * and their number of tiles; -1: the first level alone has more. */
int32_t cs_tile_plan_last_within(const cs_tile_plan_desc *desc, int64_t limit, int64_t *count);
void cs_tile_plan_free(celspan_context *context, cs_tile_plan *plan);
