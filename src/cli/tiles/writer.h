/* Tiles to files: a tile whose pixels were written before is linked, not written again.
 *
 *   rows of spans --cut--> rows of a tile --hash--> known?  yes: link   no: write, remember
 *
 * INVARIANT  A tile appears under its name whole or not at all.
 */
#ifndef CS_CLI_TILES_WRITER_H
#define CS_CLI_TILES_WRITER_H

#include <stdatomic.h>

#include "cli/tiles/known.h"
#include "cli/tiles/pyramid.h"

/* What all writers of a pyramid share. */
typedef struct cs_tile_output {
  celspan_context *context;
  const cs_pyramid *pyramid;
  celspan_file_desc file; /* of every tile; its coding is resolved */
  bool skips_empty;
  unsigned char empty[16]; /* the coded pixel of an empty tile */
  cs_tile_known known;
  atomic_uint_fast64_t written, linked, skipped; /* tiles */
} cs_tile_output;

/* Rows of spans in which a tile is one part. */
typedef struct cs_tile_source {
  const celspan_span *(*row)(const void *user, int32_t y, size_t *count); /* y: of the level */
  const void *user;
  int32_t left; /* the level's column where the rows begin */
} cs_tile_source;

/* What one thread needs to write tiles. */
typedef struct cs_tile_writer {
  celspan_context context; /* a branch */
  cs_tile_output *output;
  cs_tile_source source;
  size_t *starts; /* for each row: the first span that overlaps the tile */
  size_t start_capacity;
  celspan_span *spans; /* one row, cut to the tile */
  size_t span_capacity;
  unsigned char *pixels; /* one row */
  size_t pixel_capacity;
} cs_tile_writer;

void cs_tile_output_init(cs_tile_output *output, celspan_context *context,
                         const cs_pyramid *pyramid, const celspan_file_desc *file);
void cs_tile_output_finish(cs_tile_output *output);
/* From now on, tiles that are wholly of this colour (linear, premultiplied) are left out. */
void cs_tile_output_skip(cs_tile_output *output, const float rgba[4]);

void cs_tile_writer_init(cs_tile_writer *writer, cs_tile_output *output, cs_tile_source source);
void cs_tile_writer_finish(cs_tile_writer *writer);
/* Called before tiles of a row are written from left to right. rows: of pixels, in the tiles. */
CELSPAN_CHECKED celspan_status cs_tile_writer_begin(cs_tile_writer *writer, int32_t rows);
CELSPAN_CHECKED celspan_status cs_tile_writer_put(cs_tile_writer *writer, int32_t level,
                                                  int32_t column, int32_t row);

#endif
