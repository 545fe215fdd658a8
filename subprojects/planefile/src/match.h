/* What a frame of a film has in common with a band of another one.
 *
 *   cells    the same colour; or the same program, with axes that have only been moved
 *   chains   the same pieces, moved
 *
 * INVARIANT: a cell of the base stands for one cell of the plane, and an axis for one axis.
 */
#ifndef PF_MATCH_H
#define PF_MATCH_H

#include "band.h"
#include "written.h"

#define PF_NONE UINT32_MAX

typedef struct pf_known pf_known;

typedef struct pf_match {
  pf_memory memory;
  const planefile_band *plane;
  const pf_base *base;
  uint32_t *cells; /* of each of the plane: that of the base, or NONE */
  uint32_t *axes;
  uint32_t *plane_cells; /* of each of the base: that of the plane, or NONE */
  uint32_t *plane_axes;
  pf_known *chains; /* of the base, by their prints */
} pf_match;

/* plane, base: borrowed. out: must be freed whatever happens. False: no memory. */
bool pf_match_make(const pf_memory *memory, const planefile_band *plane, const pf_base *base,
                   pf_match *out);
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

#endif
