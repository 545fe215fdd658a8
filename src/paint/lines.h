/* Programs that are straight between some columns: gradients, procedures, soft layers, and pictures
 * enlarged so far that a texel is some pixels wide.
 */
#ifndef CS_PAINT_LINES_H
#define CS_PAINT_LINES_H

#include "compose/composer.h"

/* A chord is accepted when it is this near the curve at its quarters: half of what is promised. */
#define CS_LINES_TOLERANCE (0.5f / 1023)

/* The last column of [x0, x1) that is `quarter` quarters on. */
static inline int32_t cs_lines_quarter(int32_t x0, int32_t x1, int quarter) {
  return x0 + (int32_t)((int64_t)(x1 - 1 - x0) * quarter / 4);
}

/* Appends the line between the colours of the first and the last column of [x0, x1). */
static inline CELSPAN_CHECKED celspan_status cs_lines_line(celspan_context *context, cs_row *row,
                                                           int32_t x0, int32_t x1, cs_v4 first,
                                                           cs_v4 last) {
  float steps = x1 - x0 > 1 ? (float)(x1 - 1 - x0) : 1;
  return cs_row_gradient(context, row, x0, x1, first, (last - first) / steps);
}

/* As cs_composer_run_program, where no picture shows pixel by pixel. */
CELSPAN_CHECKED celspan_status cs_lines_run(cs_composer *composer, const cs_program *program,
                                            int32_t x0, int32_t x1, double y, cs_row *row);

#endif
