/* A sink that cuts the rows of one level into tiles and writes them to files.
 *
 *   rows of spans --cut--> rows of a tile --hash--> known?  yes: link   no: write, add
 *
 * Rows are kept as spans until a row of tiles is complete, so that memory is proportional to the
 * spans of that many rows. A row whose pixels need less memory than its spans is kept as pixels. A
 * complete row of tiles is written by several threads at once.
 *
 * INVARIANT  A tile appears under its name whole or not at all. Tiles with the same pixels are one
 * file with several names, as far as the file system has links.
 */
#pragma once

#include <pthread.h>
#include <stdatomic.h>

#include "inside/frames.h"
#include "inside/hash.h"
#include "writers/tiles/pyramid.h"

/* The tiles that are written already: a hash of their coded pixels, and their place in the pyramid;
 * of a sparse pyramid also those of one colour, by place and colour. Any thread. */
typedef struct cs_tile_known {
  pthread_mutex_t mutex;
  cs_pyramid_tile *tiles;
  size_t count, capacity;
  cs_hash_table indices; /* from hashes to indices into tiles */
} cs_tile_known;

/* The state that all rows of a pyramid share. */
typedef struct cs_tile_output {
  celspan_context *context;
  const cs_pyramid *pyramid;
  celspan_file_desc file; /* the file of every tile */
  celspan_coding coding;  /* the coding of the file; resolved */
  bool skips_empty, is_sparse;
  unsigned char empty[16]; /* the coded pixel of an empty tile */
  cs_tile_known known;
  atomic_uint_fast64_t written, linked, skipped; /* tiles */
} cs_tile_output;

void cs_tile_output_init(cs_tile_output *output, celspan_context *context,
                         const cs_pyramid *pyramid, const celspan_file_desc *file);
void cs_tile_output_finish(cs_tile_output *output);
/* From now on, tiles that consist of this colour (linear, premultiplied) are omitted. */
void cs_tile_output_skip(cs_tile_output *output, const float rgba[4]);

/* One row of tiles; its columns are half-open. */
typedef struct cs_tile_row {
  int32_t level, row, first, end;
} cs_tile_row;

typedef struct cs_tile_rows {
  cs_tile_output *output;
  int32_t level;
  cs_pyramid_box tiles;  /* to make */
  cs_pyramid_box pixels; /* the pixels of those tiles, which are rendered */
  int32_t next;          /* row of tiles */
  int workers;
  /* Called after each finished row of tiles. */
  celspan_status (*finished)(void *user, celspan_context *context, cs_tile_row row);
  void *user;
  cs_row_queue *ring; /* row y of the level is in entry y % ring_count */
  int32_t ring_count;
  struct cs_tile_writer *writers; /* one for each worker */
} cs_tile_rows;

/* A sink for the given pixels of the level, which fails if it gets a picture of another size. rows:
 * all fields up to `user` are set, and `next` is tiles.y0; it must live as long as the sink. */
celspan_sink cs_tile_rows_sink(cs_tile_rows *rows);
