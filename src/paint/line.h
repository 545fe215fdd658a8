/* One linear piece of a row: the span between the colours of two columns, and when a curve of
 * colour is near enough to it.
 *
 *     colour
 *       |              . - ' *   last
 *       |        . o '       :
 *       |    . o     - - - - : - -  the line; at three quarters of the way the curve is compared
 *       |  o                 :
 *       | *  first           :
 *       +-+--+-----+-----+---+----> column
 *         x0 1/4  2/4   3/4  x1 - 1
 */
#ifndef CS_PAINT_LINE_H
#define CS_PAINT_LINE_H

#include "span/row.h"
#include "span/run.h"

/* A line is accepted when it is this near the curve at its quarters: half of what is promised. */
#define CS_LINE_TOLERANCE (0.5f / 1023)

/* The last column of a run that is `quarter` quarters on. */
static inline int32_t cs_line_quarter(cs_run run, int quarter) {
  return run.x0 + (int32_t)((int64_t)(run.x1 - 1 - run.x0) * quarter / 4);
}

/* Appends the line between the colours of the first and the last column of a run. */
static inline CELSPAN_CHECKED celspan_status cs_line_put(celspan_context *context, cs_row *row,
                                                         cs_run run, cs_v4 first, cs_v4 last) {
  float steps = run.x1 - run.x0 > 1 ? (float)(run.x1 - 1 - run.x0) : 1;
  return cs_row_gradient(context, row, run.x0, run.x1, first, (last - first) / steps);
}

#endif
