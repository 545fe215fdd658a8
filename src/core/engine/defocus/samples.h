/* Rows of samples under the nodes that are filled together, read tile by tile.
 *
 *            low               high
 *    row 0    |.................|               a row of samples is a row of spans; under a tile it
 *    row 1    |.................|.......        is spread into one colour for each sample
 *             |<- under a tile ->
 *
 * Where all rows under a tile are one same colour (plain), so are its nodes, to the bit, and
 * nothing needs to be spread or summed.
 */
#pragma once

#include "engine/row/row.h"

typedef struct cs_defocus_samples {
  CS_ARRAY(cs_row, rows);
  CS_ARRAY(size_t, from); /* by row: the first span that may meet the tile */
  CS_ARRAY(cs_v4, room);  /* for what is made of them: zeros at first */
  int32_t count;
  int32_t low, high; /* the samples under the tile; tiles come from left to right */
} cs_defocus_samples;

/* Makes `count` rows, from row `first` of the maker on, and room for `room` values. Must be
 * finished after a failure too. Errors: NO_MEMORY, and those of the maker's rows. */
CELSPAN_CHECKED celspan_status cs_defocus_samples_begin(cs_row_maker *maker, int32_t first,
                                                        int32_t count, size_t room,
                                                        cs_defocus_samples *out);
void cs_defocus_samples_finish(cs_defocus_samples *samples, cs_memory *memory);
/* Whether row k has one colour under the tile; *out: the first colour of the row there. */
bool cs_defocus_samples_are_one(const cs_defocus_samples *samples, int32_t k, cs_v4 *out);
/* Nodes that are summed from samples, tile by tile. Node x of a row lies over the samples from
 * x * factor on, with `extent` of them on either side. */
typedef struct cs_defocus_tiles {
  int32_t columns, rows; /* the columns and rows of nodes */
  int32_t width;         /* the width of a tile, in nodes, at most */
  int32_t factor, extent;
  bool has_function; /* a plain tile has nodes of another colour, which must be made, too */
  void (*take_row)(void *user, int32_t k); /* row k of the samples under the tile */
  /* Row y of the tile's nodes, `count` of them, when all rows of samples have been taken. */
  void (*sum_nodes)(void *user, int32_t y, int32_t count, float (*nodes)[4]);
  void *user;
} cs_defocus_tiles;

/* Sums all nodes; the nodes of a plain tile get its colour. nodes: columns times rows. */
void cs_defocus_samples_sum(cs_defocus_samples *samples, const cs_defocus_tiles *tiles,
                            float (*nodes)[4]);
/* Row k under the tile, sample by sample. */
void cs_defocus_samples_spread(const cs_defocus_samples *samples, int32_t k, cs_v4 *out);
