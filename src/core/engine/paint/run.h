/* Runs of a cell as spans.
 *
 * Where pictures or defocused cels show in the program, some columns of the frame are examined at a
 * time (shown.h): clear and hidden items are left out. The rest of the program is painted in the
 * cheapest way that is right: as codes of texels, pixel by pixel, or as few linear spans as needed.
 *
 * Invariant: where a program varies as a formula, spans are cut so that they are right within
 * 1/1023; the cuts depend on the run and the program alone.
 */
#pragma once

#include "engine/paint/gradient_table.h"
#include "engine/paint/painter.h"
#include "engine/span/row.h"
#include "engine/span/run.h"

/* Appends the spans of a run: of a cell, and of a program by itself. An empty run has none.
 * Errors: NO_MEMORY, and those of reading pictures and making defocused cels. */
CELSPAN_CHECKED celspan_status cs_painter_run(cs_painter *painter, const cs_cell *cell, cs_run run,
                                              cs_row *row);
CELSPAN_CHECKED celspan_status cs_painter_run_program(cs_painter *painter,
                                                      const cs_program *program, cs_run run,
                                                      cs_row *row);

/* ---- gradient_lines.c */

/* As cs_painter_run_program, where no picture shows pixel by pixel. */
CELSPAN_CHECKED celspan_status cs_lines_run(cs_painter *painter, const cs_program *program,
                                            cs_run run, cs_row *row);

/* ---- copies.c */

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

/* ---- gradient_run.c */

/* Whether the table belongs to such a gradient; false for NULL. */
bool cs_gradient_run_fits(const cs_gradient_table *table);
/* Appends the spans of a run, as cs_lines_run. */
CELSPAN_CHECKED celspan_status cs_gradient_run(cs_painter *painter, const cs_gradient_table *table,
                                               cs_run run, cs_row *row);
