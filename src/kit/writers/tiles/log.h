/* The record of a pyramid: its finished rows of tiles, and a digest of their inputs.
 *
 *   celspan tiles 2 DIGEST
 *   row LEVEL ROW FIRST END CHECK      columns of tiles, half-open
 *
 * CHECK, of 16 hexadecimal digits, is made from this line and all lines above it.
 *
 * INVARIANT  A line is appended when all its tiles are on the disk. The first line that was cut off
 * or altered, and all lines after it, are removed before more are appended; their tiles are made
 * again.
 */
#pragma once

#include "inside/hash.h"
#include "writers/tiles/rows.h"

/* The inputs of a pyramid: a run with equal inputs makes equal tiles. */
typedef struct cs_tile_inputs {
  const celspan_frame_desc *frame; /* the whole frame */
  const char *file;                /* a script, or a picture */
  bool is_script;
  cs_hash given; /* what the script was given: its arguments, and the values of its parameters */
  bool skips_empty, is_sparse; /* tiles */
} cs_tile_inputs;

typedef struct cs_tile_log {
  char path[4096];
  cs_hash digest;
  cs_hash check; /* a hash of all lines so far, without their end */
  CS_ARRAY(cs_tile_row, rows);
  size_t count;
  size_t written; /* rows whose line is written */
  double synced;  /* time of the last flush, by cs_clock_seconds */
  int descriptor; /* -1: closed */
} cs_tile_log;

typedef enum cs_tile_log_state {
  CS_TILE_LOG_NEW = 0, /* there are no tiles */
  CS_TILE_LOG_SAME,
  CS_TILE_LOG_OTHER,  /* the tiles are of another scene or other options */
  CS_TILE_LOG_FOREIGN /* the folder of the tiles exists, without a record */
} cs_tile_log_state;

/* Finds the record of a pyramid, if there is one. log: all zero; must be closed. */
CELSPAN_CHECKED celspan_status cs_tile_log_find(celspan_context *context, const cs_pyramid *pyramid,
                                                const cs_tile_inputs *inputs, cs_tile_log *log,
                                                cs_tile_log_state *state);
/* Removes the record and the tiles, unless another process is writing them. */
CELSPAN_CHECKED celspan_status cs_tile_log_clear(celspan_context *context,
                                                 const cs_pyramid *pyramid, cs_tile_log *log);
/* Opens the record for one process at a time, and reads its rows. Creates its folder and the first
 * line of a new record, and removes the temporary files that a killed run has left. */
CELSPAN_CHECKED celspan_status cs_tile_log_open(celspan_context *context, const cs_pyramid *pyramid,
                                                cs_tile_log *log);
bool cs_tile_log_has(const cs_tile_log *log, cs_tile_row row);
/* Adds a finished row. A flush in at most a few seconds writes its line. */
CELSPAN_CHECKED celspan_status cs_tile_log_add(celspan_context *context, cs_tile_log *log,
                                               cs_tile_row row);
/* Waits until all tiles are on the disk, then appends the lines of all finished rows. */
CELSPAN_CHECKED celspan_status cs_tile_log_flush(celspan_context *context, cs_tile_log *log);
void cs_tile_log_close(celspan_context *context, cs_tile_log *log);
