/* The self-check of a row: see the invariant in engine/span/row.h. */
#include "engine/span/row.h"

/* Whether a span may follow another: it begins where the other ends, and the two could not be
 * joined into one single. */
static bool follows(const celspan_span *span, const celspan_span *before) {
  if (span->x0 != before->x1)
    return false;
  return span->kind != CELSPAN_SPAN_SINGLE || before->kind != CELSPAN_SPAN_SINGLE ||
         !cs_v4_same(cs_v4_load(span->colour), cs_v4_load(before->colour));
}

bool cs_row_is_whole(const cs_row *row, int32_t width) {
  cs_varied varied = {0};
  if (row->count == 0 || row->spans[0].x0 != 0 || row->spans[row->count - 1].x1 != width)
    return width == 0 && row->count == 0;
  for (size_t i = 0; i < row->count; i++) {
    const celspan_span *span = &row->spans[i];
    if (span->x1 <= span->x0 || (i > 0 && !follows(span, span - 1)))
      return false;
    cs_varied_count(&varied, span->kind);
  }
  return varied.gradients == row->varied.gradients && varied.arrays == row->varied.arrays;
}
