/* A sink that cuts the rows of one level into tiles.
 *
 * Rows are kept as spans until a row of tiles is complete, so that memory is proportional to the
 * spans of that many rows. A row whose pixels need less memory than its spans is kept as pixels. A
 * complete row of tiles is written by several threads at once.
 */
#ifndef CS_CLI_TILES_ROWS_H
#define CS_CLI_TILES_ROWS_H

#include "cli/tiles/writer.h"
#include "span/row_queue.h"

/* One row of tiles: columns half-open. */
typedef struct cs_tile_row {
  int32_t level, row, first, end;
} cs_tile_row;

typedef struct cs_tile_rows {
  cs_tile_output *output;
  int32_t level;
  cs_pyramid_box tiles;  /* to be made */
  cs_pyramid_box pixels; /* of those tiles; these are rendered */
  int32_t next;          /* row of tiles */
  int workers;
  /* After each finished row of tiles. */
  celspan_status (*finished)(void *user, celspan_context *context, cs_tile_row row);
  void *user;
  cs_row_queue *ring; /* row y of the level is the one row of y % ring_count */
  int32_t ring_count;
  cs_tile_writer *writers;
} cs_tile_rows;

/* rows: its first six fields are set, and `next` is tiles.y0; kept by the sink as long as it is
 * used. Renders pixels.x0 ... pixels.y1 of the level. */
celspan_sink cs_tile_rows_sink(cs_tile_rows *rows);

#endif
