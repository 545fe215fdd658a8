/* Rendering a pyramid: every rectangle of tiles in the plan that the record does not have yet.
 *
 *   scene --one pass of rows a level--> rows of spans --cut--> tiles --equal ones linked--> files
 *
 * A level is rendered whole, or in as few passes as the tiles that are wanted of it allow: a pass
 * costs the compilation of the scene and the sweep of whole rows, and both are paid once for all
 * tiles of a row, where a tile rendered alone would pay for them again.
 */
#ifndef CS_CLI_TILES_RENDER_H
#define CS_CLI_TILES_RENDER_H

#include "cli/progress.h"
#include "cli/tiles/log.h"
#include "cli/tiles/means.h"
#include "cli/tiles/plan.h"
#include "cli/tiles/subject.h"

typedef struct cs_tile_render {
  /* Set by the caller. */
  celspan_context *context;
  const cs_request *request;
  const cs_tile_subject *subject;
  const cs_pyramid *pyramid;
  const cs_tile_plan *plan;
  cs_tile_log *log;    /* open */
  float background[4]; /* linear, premultiplied */
  /* Set by the run. */
  cs_tile_output output;
  cs_tile_means means;
  cs_progress progress;
  int workers;
} cs_tile_render;

/* Starts the progress, which the caller ends. Errors: those of rendering and writing; CANCELLED. The record has what was finished even so. */
CELSPAN_CHECKED celspan_status cs_tile_render_run(cs_tile_render *render);

#endif
