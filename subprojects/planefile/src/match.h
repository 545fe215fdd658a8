/* What a frame of a film has in common with a band of another one.
 *
 *   chains   the same pieces, moved
 *   cells    those beside such chains; or the same colour, or the same program, with axes that have
 *            only been moved
 *
 * INVARIANT: a cell of the base stands for one cell of the plane, and an axis for one axis.
 */
#pragma once

#include "band.h"
#include "written.h"

#define PF_NONE UINT32_MAX

typedef struct pf_known pf_known;
typedef struct pf_pair pf_pair;

typedef struct pf_match {
  pf_memory memory;
  const planefile_band *plane;
  const pf_base *base;
  planefile_grid grid; /* the grid of both */
  uint32_t *cells;     /* the cells of each of the plane: that of the base, or NONE */
  uint32_t *axes;
  uint32_t *plane_cells; /* of each of the base: that of the plane, or NONE */
  uint32_t *plane_axes;
  uint32_t *paired; /* the axes of the plane that are, in the order of their pairing */
  uint32_t paired_count;
  pf_known *chains; /* the chains of the base, by their prints */
  pf_known *forms;  /* the forms of the base, by the prints of their forms */
  pf_pair *pairs;   /* what borders say of cells */
  size_t pair_count, pair_capacity;
} pf_match;

/* Finds what chains can be found by. plane, base: borrowed. out: must be freed whatever happens.
 * False: no memory. */
bool pf_match_make(const pf_memory *memory, const planefile_band *plane, const pf_base *base,
                   planefile_grid grid, pf_match *out);
void pf_match_free(pf_match *match);

/* Where a chain of the plane is in the base. */
typedef struct pf_link {
  uint32_t origin; /* PF_NEW: it is not */
  uint32_t chain;
  pf_move move;
} pf_link;

/* Finds a chain by its pieces [piece, end): of several the one that has moved as the latest one, or
 * else one after it. False: no memory. */
bool pf_match_chain(const pf_match *match, uint32_t piece, uint32_t end, const pf_link *latest,
                    pf_link *out);

/* Finds a chain whose pieces have the forms of [piece, end), with the most similar moves, if that
 * is worth it. *out: changed only then. False: no memory. */
bool pf_match_bent(const pf_match *match, uint32_t piece, uint32_t end, const pf_link *latest,
                   pf_link *out);

/* Notes that two cells, of the base and of the plane, are beside one chain. False: no memory. */
bool pf_match_note(pf_match *match, uint32_t theirs, uint32_t ours);

/* Finds the cells, after all notes. False: no memory. */
bool pf_match_cells(pf_match *match);

/* What becomes of a cell of the base. */
pf_fate pf_match_fate(const pf_match *match, uint32_t theirs);
