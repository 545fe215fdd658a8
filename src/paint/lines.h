/* Programs that are straight between some columns: gradients, procedures, soft layers, and pictures
 * enlarged so far that a texel is some pixels wide.
 */
#ifndef CS_PAINT_LINES_H
#define CS_PAINT_LINES_H

#include "paint/painter.h"
#include "span/row.h"
#include "span/run.h"

/* As cs_painter_run_program, where no picture shows pixel by pixel. */
CELSPAN_CHECKED celspan_status cs_lines_run(cs_painter *painter, const cs_program *program,
                                            cs_run run, cs_row *row);

#endif
