/* Programs that vary as formulas, cut into lines: gradients, procedures, defocused cels,
 * and pictures enlarged so far that a texel is some pixels wide.
 *
 *     colour
 *       |             ___________
 *       |           /:           :`-._          a run is cut where a formula bends or a texel
 *       |         /  :           :    `-._      begins (ends.h); between two cuts it becomes one
 *       |  _____/    :           :        |     span if it is straight enough, else it is halved
 *       |  |    :    :           :        |     (halving.h)
 *       +--+----+----+-----------+--------+---> column
 *          x0  cut  cut         cut       x1
 */
#pragma once

#include "engine/paint/painter.h"
#include "engine/span/row.h"
#include "engine/span/run.h"

/* As cs_painter_run_program, where no picture shows pixel by pixel. */
CELSPAN_CHECKED celspan_status cs_lines_run(cs_painter *painter, const cs_program *program,
                                            cs_run run, cs_row *row);
