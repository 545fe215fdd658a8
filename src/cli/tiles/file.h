/* Tiles to files: pixels that were written before are linked to, not written again.
 *
 * INVARIANT  A tile appears under its name whole or not at all. What is remembered of a tile is the
 * digest of its coded pixels and its name; a tile that only links to another differs from it in
 * nothing but its name.
 */
#ifndef CS_CLI_TILES_FILE_H
#define CS_CLI_TILES_FILE_H

#include <pthread.h>

#include "base/context.h"
#include "base/hash.h"
#include "cli/tiles/pyramid.h"

typedef struct cs_known_tile {
  cs_hash hash; /* 0 0: a free place */
  int32_t level, column, row;
} cs_known_tile;

typedef struct cs_tile_file_counts {
  uint64_t written, linked, skipped;
} cs_tile_file_counts;

typedef struct cs_tile_file {
  celspan_context *context;
  const cs_pyramid *pyramid;
  celspan_file_desc file; /* of every tile; its coding is resolved */
  bool skips_empty;
  unsigned char empty[16]; /* the coded pixel of an empty tile */
  pthread_mutex_t mutex;   /* over all that follows */
  cs_known_tile *known;    /* a table of capacity 2^n, at most half full */
  size_t known_count, known_capacity;
  cs_tile_file_counts counts;
} cs_tile_file;

/* Rows of spans that hold a tile among others. */
typedef struct cs_tile_source {
  const celspan_span *(*row)(const void *user, int32_t y, size_t *count); /* y: of the level */
  const void *user;
  int32_t left; /* the level's column where the rows begin */
} cs_tile_source;

/* What one thread needs to write tiles. */
typedef struct cs_tile_writer {
  celspan_context context; /* a branch */
  cs_tile_file *files;
  cs_tile_source source;
  size_t *starts; /* for each row: the first span that reaches the tile */
  size_t start_capacity;
  celspan_span *spans; /* one row, cut to the tile */
  size_t span_capacity;
  unsigned char *pixels; /* one row */
  size_t pixel_capacity;
} cs_tile_writer;

void cs_tile_file_init(cs_tile_file *files, celspan_context *context, const cs_pyramid *pyramid,
                       const celspan_file_desc *file);
void cs_tile_file_finish(cs_tile_file *files);
/* Tiles that are wholly of this colour (linear, premultiplied) are left out from now on. */
void cs_tile_file_skip(cs_tile_file *files, const float rgba[4]);

void cs_tile_writer_init(cs_tile_writer *writer, cs_tile_file *files, cs_tile_source source);
void cs_tile_writer_finish(cs_tile_writer *writer);
/* Before the tiles of a row are written, from left to right; rows: of the source, at most. */
CELSPAN_CHECKED celspan_status cs_tile_writer_begin(cs_tile_writer *writer, int32_t rows);
CELSPAN_CHECKED celspan_status cs_tile_writer_put(cs_tile_writer *writer, int32_t level,
                                                  int32_t column, int32_t row);

#endif
