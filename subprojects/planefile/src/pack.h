/* A band to its code.
 *
 *   borders --by chain--> chains of the band --by x--> numbered --> code of curves
 *                                      \--their changes, by height, in groups--> code of changes
 *
 * Pieces of a chain of which nothing can be seen are left out, or one line where they are between
 * others; but not in a band that other frames may be made from, because they see other pieces.
 *
 * find.c finds the chains and their changes, and pack.c codes them. pack.c is one file, because it
 * is one walk along one code, in the order in which unpack.c reads.
 */
#pragma once

#include "match.h"

/* A chain of the band: its borders are neighbours in the list of all. */
typedef struct pf_shown {
  const planefile_border *borders;
  uint32_t count;
  uint32_t piece, end; /* of its pieces that is needed, and after the last one */
  int64_t place;       /* twice its mean x */
  planefile_point start, end_at;
  pf_sides sides;
  int32_t top, foot; /* of what is kept of it */
  int32_t slope;
  bool is_whole; /* no piece is left out */
  pf_link link;
} pf_shown;

/* From a height on a chain has other cells. */
typedef struct pf_change {
  int32_t height;
  uint32_t chain; /* the chain of the band */
  pf_sides sides; /* the sides of the plane */
} pf_change;

typedef struct pf_packer {
  const pf_memory *memory;
  const planefile_band *plane;
  const pf_part *part;
  int32_t top, foot;
  pf_match match; /* with the base, if there is one */
  pf_link latest; /* of the latest chain that has one */
  pf_moves moves; /* that were coded */
  planefile_border *borders;
  pf_shown *chains;
  pf_change *changes;
  uint32_t *cells; /* of each cell of the plane: its number in the band plus 1; 0: none yet */
  size_t border_count, chain_count, change_count, change_capacity;
  uint32_t piece_count, cell_count;
  uint32_t fresh[2 * PF_GROUP], fresh_count; /* cells that are new in the current group */
  uint32_t form;
  pf_way way;            /* the latest move of the chain, in steps */
  planefile_cell colour; /* the colour of the latest cell */
  pf_models models;
  pf_program_coding *programs; /* NULL: nothing varies */
  pf_encoder *out;
} pf_packer;

/* Finds the chains of the band, and what happens to them. False: no memory. */
bool pf_pack_find(pf_packer *p);
/* Goes on to the first piece that is needed; returns where the ones before it end, or NULL. */
const planefile_point *pf_pack_pass(const pf_packer *p, const pf_shown *c, uint32_t *piece,
                                    uint32_t *border);
/* How many pieces a chain has, of which some stand for several ones that are hidden. */
uint32_t pf_pack_count(const pf_packer *p, const pf_shown *c);
/* Where a piece begins. */
static inline const planefile_point *pf_pack_first(const pf_packer *p, uint32_t piece) {
  return &p->plane->points[p->plane->pieces[piece].point];
}
/* NULL: a cell has a program. */
static inline const planefile_cell *pf_pack_flat(const pf_packer *p, uint32_t cell) {
  bool is_flat = !p->plane->programs || p->plane->programs[cell].step_count == 0;
  return is_flat ? &p->plane->cells[cell] : NULL;
}
