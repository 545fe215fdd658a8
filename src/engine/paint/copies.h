/* Runs of pictures that are all copied, at whole pixels and scale 1, to codes.
 *
 *     blocks of A   |  clear  |  mixed  | opaque  |  mixed  |
 *     blocks of B   |       opaque      |(not read)|  clear |      B is behind A
 *     pieces        |    B    | A over B|    A    |  folded |
 *
 * Where one picture alone shows and is opaque, its codes go straight through. Where one lies over
 * an opaque one, they do for all groups of pixels that are clear or opaque in front, and only the
 * others are decoded, folded and coded. All other pieces are painted as everywhere (run.h).
 *
 * The pieces of a run are the same as long as its rows lie on the same blocks: they are kept, with
 * the addresses of the codes, until another block is fetched.
 *
 * Invariant: the codes are those of the run's colours, to the bit.
 */
#pragma once

#include "engine/paint/painter.h"
#include "engine/span/row.h"

/* Whether a program consists of such pictures, shown unchanged and mixed as light. Errors: those of
 * reading the headers of pictures. */
CELSPAN_CHECKED celspan_status cs_copies_fit(cs_painter *painter, const cs_program *program,
                                             bool *fit);
/* The pieces of a run, valid until the next call. Errors: NO_MEMORY, and those of reading pictures.
 */
CELSPAN_CHECKED celspan_status cs_copies_find(cs_painter *painter, const cs_program *program,
                                              cs_run run, const cs_copies_plan **out);
/* Appends the codes of the first pieces of a run, none of kind OTHER. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_copies_put(cs_painter *painter, const cs_copies_plan *plan,
                                             size_t count, cs_run run, cs_row *row);
