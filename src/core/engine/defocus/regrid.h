/* From a cel's own grid to a row of a frame: each node of the row is a cubic through the four rows
 * and the four columns of nodes that are nearest to it.
 *
 *     o    o    o    o     o  nodes of the cel's own grid
 *     o    o    o    o     x  a node of the row: first every column is mixed from four
 *     o    o  x o    o        rows, then the node from four columns
 *     o    o    o    o
 *
 * The mixed values are differences from the nearest node before the place. So equal nodes keep
 * their bits: where the artwork is clear or has one colour, the frame is the same. Beyond the
 * nodes, the last nodes are used.
 */
#pragma once

#include "base/wide.h"
#include "engine/sample/defocused.h"

/* One axis of a mapping from pixels of the frame to pixels of the cel's own grid. */
typedef struct cs_regrid_axis {
  double scale, offset;
} cs_regrid_axis;

typedef struct cs_regrid {
  const cs_defocused *from; /* the cel's own grid; its bands are nodes */
  cs_regrid_axis axes[2];
} cs_regrid;

/* A column of the frame's grid: the first of its four columns in a mixed row, and the weights of
 * the first, the third and the fourth. */
typedef struct cs_regrid_column {
  int32_t first;
  float weights[3];
} cs_regrid_column;

/* How a view reads the cel's own nodes. */
typedef struct cs_regrid_rows {
  const cs_regrid *map;
  const cs_defocused *to;
  celspan_context *context;
  cs_isa isa;
  cs_defocus_band *bands[2]; /* acquired: one with an even, one with an odd number; NULL: none */
  int32_t numbers[2];
  CS_ARRAY(cs_regrid_column, columns);
  /* a row of the cel's own nodes, at the height of the row being made; its first node is there
   * twice, its last one three times */
  CS_ARRAY(float[4], mixed);
} cs_regrid_rows;

/* As `mix` and `forget` of cs_defocused: mixes a row of nodes at a height of the frame, as far as
 * something is visible in it. Nodes that are not visible are not written. Errors: NO_MEMORY, and
 * those of the bands of the cel's own grid. */
CELSPAN_CHECKED celspan_status cs_regrid_row(const cs_regrid *map, const cs_defocused *to,
                                             celspan_context *context, cs_defocused_view *view,
                                             double y);
void cs_regrid_forget(celspan_context *context, cs_defocused_view *view);

/* ---- regrid_wide.c */

/* Mixes `count` floats of four rows; at least 16. */
CS_WIDE_DECLARE(void, cs_regrid_mix,
                (const float *const rows[4], const float weights[3], size_t count, float *out));
/* The nodes within a range from the first one that is not clear to the last. */
CS_WIDE_DECLARE(cs_defocused_range, cs_regrid_visible,
                (const float (*nodes)[4], cs_defocused_range within));
/* Mixes `count` nodes from the columns of a mixed row. */
CS_WIDE_DECLARE(void, cs_regrid_across,
                (const cs_regrid_column *columns, int32_t count, const float (*nodes)[4],
                 float (*out)[4]));
