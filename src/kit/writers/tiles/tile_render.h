/* Rendering a pyramid: all tiles of some jobs that the record does not contain yet.
 *
 *   scene --one pass of rows a level--> rows of spans --cut--> tiles --equal ones linked--> files
 *
 * A level is rendered in as few passes as possible. Each pass compiles the scene and sweeps whole
 * rows, once for all tiles of a row; tiles that were rendered one by one would repeat this work.
 */
#pragma once

#include "writers/tiles/log.h"

/* A level from which all levels of at most a few hundred pixels a side are made: each of their
 * pixels is the mean over the area of this base that it covers, in linear light and premultiplied.
 * Rendered from the scene, each of these few pixels would have to process every boundary of the
 * scene. */
typedef struct cs_tile_means {
  int32_t width, height;
  float *pixels; /* RGBA; NULL: not rendered yet */
} cs_tile_means;

/* Tiles of one level. */
typedef struct cs_tile_job {
  int32_t level;
  cs_pyramid_box tiles;
} cs_tile_job;

typedef struct cs_tile_render {
  /* Set by the caller. */
  celspan_context *context;
  const celspan_frame_desc *frame; /* the whole frame */
  const cs_pyramid *pyramid;
  const cs_tile_job *jobs; /* by level, coarse to fine */
  size_t job_count;
  cs_tile_log *log;    /* open */
  int32_t workers;     /* 0: one for each processor */
  bool skips_empty;    /* omits tiles that show only the background */
  bool is_sparse;      /* omits tiles of one colour, in a coarser tile of that colour */
  float background[4]; /* linear, premultiplied */
  /* Renders the frame, or another size or crop of it, into a sink. */
  celspan_status (*draw)(void *user, const celspan_frame_desc *frame, const celspan_sink *sink);
  void (*finished)(void *user, cs_tile_row row); /* called after its tiles are written */
  bool (*tick)(void *user);                      /* called regularly; false: the run stops */
  void *user;
  /* Set by the run. */
  cs_tile_output output;
  cs_tile_means means;
  int threads; /* writing tiles */
} cs_tile_render;

/* The number of rows of tiles that must still be made. */
size_t cs_tile_render_row_count(const cs_tile_render *render);
/* Errors: those of rendering and writing; CANCELLED. The record contains all finished rows, also
 * after a failure. */
CELSPAN_CHECKED celspan_status cs_tile_render_run(cs_tile_render *render);
