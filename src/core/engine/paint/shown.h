/* The visible items of a program over some columns of a row.
 *
 *     columns        | 0 .. 63   64 .. 127   128 .. 191   192 .. 255 |
 *     picture A      |   clear     mixed       opaque       mixed    |   by the blocks under them
 *     picture B, 0.9 |   opaque    opaque      opaque       clear    |   of a cel faded to 0.9
 *     gradient       |         lets through at most 0.00001          |
 *     picture C      |  not asked, and so not read                   |
 *
 *     shown          |   B, grad   A, B, grad  A            A, grad  |
 *
 * The items are visited in the order in which the composer visited them when it made the program,
 * group by group, with bounds that hold in these columns instead of anywhere in the frame. So items
 * that are hidden or clear only in these columns are left out too.
 *
 * Invariant: the result is a function of the program, the columns and the row.
 */
#pragma once

#include "engine/paint/painter.h"
#include "engine/span/run.h"

/* Whether more may be known of a program in some columns than everywhere. */
bool cs_shown_varies(const cs_stack *stack, const cs_program *program);
/* How many columns are worth asking for at a time, counted from the left edge of the frame: the
 * least that any picture of the program asks for (opacity_columns). A picture whose header cannot
 * be read does not count here: it is an error only where it can be seen. */
int32_t cs_shown_stride(cs_painter *painter, const cs_program *program);
/* Fills `out`, whose room is kept. Errors: NO_MEMORY, and those of reading the visible pictures and
 * making the visible defocused cels. */
CELSPAN_CHECKED celspan_status cs_shown_find(cs_painter *painter, const cs_program *program,
                                             cs_run run, cs_shown *out);
/* What is kept of a program, until one takes its place that is kept there too: its stride, and what
 * the columns show for which it was asked last. So it is found once a cell and stride of a row, and
 * not in each window of it. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_shown_keep(cs_painter *painter, const cs_program *program,
                                             cs_shown_kept **out);
/* Fills kept->shown, unless it is of these columns already. Errors: as of cs_shown_find. */
CELSPAN_CHECKED celspan_status cs_shown_again(cs_painter *painter, cs_shown_kept *kept, cs_run run);
/* Whether both show the same items. */
bool cs_shown_same(const cs_shown *a, const cs_shown *b);
/* Whether a layer is a defocused cel whose nodes are pixels: its rows are known to be clear outside
 * some columns. */
static inline bool cs_shown_is_pixels(const cs_stack *stack, const cs_layer *layer) {
  return layer->kind == CS_LAYER_DEFOCUSED && stack->defocused[layer->index]->are_pixels;
}
