/* Where a run is cut into lines: at the columns in which a formula of its program bends, or a texel
 * begins. Both ends of the run are among them.
 *
 *     columns                x0                          x1
 *                            |                           |
 *     layer with stops       |      '        '           |
 *     texels of a picture    |  '        '       '       |       the columns of each layer ascend,
 *                            |                           |       and are merged:
 *     ends                   '  '   '    '   '   '       '
 */
#ifndef CS_PAINT_ENDS_H
#define CS_PAINT_ENDS_H

#include "paint/painter.h"
#include "span/row.h"
#include "span/run.h"

/* Columns, ascending, in room of the row's own arena: the scratch arena is used again for every
 * colour. */
typedef struct cs_ends {
  int32_t *columns, *other; /* other: room to merge into */
  size_t count;
} cs_ends;

/* The columns at which a run is cut, ascending, its own two ends among them. The pictures of the
 * program are grids (cs_sampler_is_grid). Errors: NO_MEMORY, and those of making defocused cels. */
CELSPAN_CHECKED celspan_status cs_ends_find(cs_painter *painter, const cs_program *program,
                                            cs_run run, cs_row *row, cs_ends *out);

#endif
