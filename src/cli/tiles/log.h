/* The record of a pyramid: which rows of tiles are finished, and what they were made of.
 *
 *   celspan tiles 1 DIGEST
 *   row LEVEL ROW FIRST END      columns of tiles, half-open
 *
 * INVARIANT  A line is added when all its tiles are on the disk. A line that was cut off by a crash
 * is ignored, so its tiles are made again.
 */
#ifndef CS_CLI_TILES_LOG_H
#define CS_CLI_TILES_LOG_H

#include "base/hash.h"
#include "cli/tiles/rows.h"

typedef struct cs_tile_log {
  char path[4096];
  cs_hash digest;
  cs_tile_row *rows;
  size_t count, capacity;
  size_t written; /* rows that have their line */
  double synced;  /* seconds of cs_progress_clock */
  int descriptor; /* -1: closed */
} cs_tile_log;

typedef enum cs_tile_log_state {
  CS_TILE_LOG_NEW = 0, /* nothing is there */
  CS_TILE_LOG_SAME,
  CS_TILE_LOG_OTHER,  /* of another scene or other options */
  CS_TILE_LOG_FOREIGN /* a folder where the tiles would go, without a record */
} cs_tile_log_state;

/* Reads the record of a pyramid, when there is one. log: zeroed; new, to be closed. */
CELSPAN_CHECKED celspan_status cs_tile_log_read(celspan_context *context, const cs_pyramid *pyramid,
                                                cs_hash digest, cs_tile_log *log,
                                                cs_tile_log_state *state);
/* Removes record and tiles, where no other process is at work on them. */
CELSPAN_CHECKED celspan_status cs_tile_log_clear(celspan_context *context,
                                                 const cs_pyramid *pyramid, cs_tile_log *log);
/* Opens the record for more lines, for one process at a time. Its folder is made; a new record gets
 * its first line. */
CELSPAN_CHECKED celspan_status cs_tile_log_open(celspan_context *context, cs_tile_log *log);
bool cs_tile_log_has(const cs_tile_log *log, cs_tile_row row);
/* Adds a finished row. Its line is written by a later flush, at most a few seconds from now. */
CELSPAN_CHECKED celspan_status cs_tile_log_add(celspan_context *context, cs_tile_log *log,
                                               cs_tile_row row);
/* Waits until all tiles are on the disk, then adds the lines of all finished rows. */
CELSPAN_CHECKED celspan_status cs_tile_log_flush(celspan_context *context, cs_tile_log *log);
void cs_tile_log_close(celspan_context *context, cs_tile_log *log);

#endif
