/* The grid of a cull: what its steps share.
 *
 *   chains --cull_columns.c--> columns that each touches, row by row of tiles
 *   layers --cull_row.c------> which chains are kept there, and the deferred changes of the others
 *   rows of tiles --cull_create.c---> the cull
 *
 * Every row of tiles is treated by itself, so several threads can.
 */
#pragma once

#include "engine/sweep/cull.h"

/* The columns (tiles of a row) that a chain touches in one row of tiles: low..high. */
typedef struct cs_cull_columns {
  uint8_t low, high;
} cs_cull_columns;

/* A chain in a row of tiles that it crosses. */
typedef struct cs_cull_crossing {
  uint32_t chain, layer;
  size_t place; /* the chain's place in the row: the index in `columns` and `kept` */
} cs_cull_crossing;

typedef struct cs_cull_grid {
  const cs_cull_desc *desc;
  double width, height, margin; /* pixels */
  double columns_a_pixel;
  double slack; /* pixels: how far a chord may be from the curve that it replaces */
  cs_cull *cull;
  /* By chain: its last row of tiles; less than its first one where it is outside the frame. */
  CS_ARRAY(int32_t, last_rows);
  CS_ARRAY(cs_cull_columns, columns); /* indexed as cull->kept */
  /* By row of tiles: the chains that cross it, from the layer nearest the camera to the rear. */
  CS_ARRAY(cs_cull_crossing, crossing);
  CS_ARRAY(uint32_t, crossing_starts); /* tile_rows + 1 */
} cs_cull_grid;

/* One thread culls the rows of tiles first..end - 1. */
typedef struct cs_cull_job {
  celspan_context context; /* a branch */
  celspan_status status;
  int32_t first, end;
  CS_ARRAY(cs_deferred, deferred_list);  /* by row of tiles, then in the order they were found */
  CS_ARRAY(struct cs_cull_veil, veils);  /* scratch: one more than groups may be around a layer */
  CS_ARRAY(cs_cull_presence, presences); /* scratch, of a tree's layers */
  CS_ARRAY(uint64_t, painted);           /* scratch, likewise */
  CS_ARRAY(unsigned char, scratch);      /* the scratch of desc->scratch_size bytes */
  size_t deferred_count;
} cs_cull_job;

static inline double cs_cull_grid_top(const cs_cull_grid *grid, int32_t row) {
  return row == 0 ? -grid->margin : (double)row * grid->cull->tile_height;
}

static inline double cs_cull_grid_foot(const cs_cull_grid *grid, int32_t row) {
  return row == grid->cull->tile_rows - 1 ? grid->height + grid->margin
                                          : (double)(row + 1) * grid->cull->tile_height;
}

static inline uint64_t cs_cull_columns_mask(cs_cull_columns r) {
  return ~(uint64_t)0 >> (63 - r.high) & ~(uint64_t)0 << r.low;
}

/* Finds the columns of a chain in each of its rows of tiles. */
void cs_cull_columns_find(const cs_cull_grid *grid, uint32_t chain, cs_cull_columns *columns);

/* Culls one row of tiles: fills `kept`, appends deferred changes to the job's list, and counts them
 * in cull->deferred_starts[row + 1]. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_cull_row_walk(const cs_cull_grid *grid, cs_cull_job *job,
                                                int32_t row);
/* Room for the scratch of a job. Errors: NO_MEMORY; the job must be freed then, too. */
CELSPAN_CHECKED celspan_status cs_cull_row_begin(const cs_cull_grid *grid, cs_cull_job *job);
