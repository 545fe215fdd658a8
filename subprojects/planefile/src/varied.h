/* What cells that vary cover, and the pixels that they are seen in.
 *
 *      entries of a row         column 3: + cell 7, - cell 2       column 9: - cell 7, + cell 5
 *                                       |                                  |
 *      shares from there on     2: 1    | 7: 0.4, 2: 0.6 (in one pixel)    | 7: 0.2, 5: 0.8
 *
 * A border adds to the share of the cell on its right what it takes from that on its left, as it
 * does with colours. A pixel is the sum of the colours of the cells there, at its middle, times
 * their shares.
 *
 * INVARIANT: shares are sums of integers, so that they do not depend on any order. Between two
 * columns with entries they do not change.
 */
#pragma once

#include "plane.h"

enum { PF_ROWS = 16 }; /* summed together, at most */

/* The share of a cell changes at a column of a row. */
typedef struct pf_entry {
  uint32_t cell; /* the cell of all bands */
  uint32_t next; /* of its column, plus 1; 0: none */
  int64_t share; /* the share of a pixel: in PF_HEIGHTths */
} pf_entry;

typedef struct pf_varied {
  const planefile_plane *plane;
  uint32_t columns;
  uint32_t *first;           /* of each band: its first cell; and after the last one */
  pf_entry *entries, *start; /* of the rows being made; of every row, at its beginning */
  size_t entry_count, entry_capacity, start_count, start_capacity;
  uint32_t *heads; /* of `rows` rows of columns + 1 each: the first entry, plus 1 */
  uint32_t rows;
  int64_t *shares;  /* the shares of the row being read, by cell */
  uint32_t *places; /* the places of cells that have a share: among the active ones */
  uint32_t *active; /* such cells */
  uint32_t active_count;
  pf_colours *room;
  bool failed; /* no memory */
} pf_varied;

/* False: no memory; it must be finished whatever happens. */
bool pf_varied_init(pf_varied *varied, const planefile_plane *plane, uint32_t columns,
                    uint32_t rows);
void pf_varied_finish(pf_varied *varied);

/* Before rows are made: forgets their entries. */
void pf_varied_begin(pf_varied *varied);
/* The share of a cell changes: of one row, or of every row at column 0. */
void pf_varied_add(pf_varied *varied, uint32_t row, uint32_t column, uint32_t cell, int64_t share);
void pf_varied_add_start(pf_varied *varied, uint32_t cell, int64_t share);

/* Reading a row: begins it; takes the entries of a column, from the left; and appends the pixels
 * from a column on, each a span. flat: the sums of colours there. */
void pf_varied_begin_row(pf_varied *varied);
void pf_varied_take(pf_varied *varied, uint32_t row, uint32_t column);
void pf_varied_paint(pf_varied *varied, const pf_pixels *pixels, const double flat[4],
                     planefile_span *out);
