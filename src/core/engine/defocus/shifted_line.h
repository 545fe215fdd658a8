/* The mean along a line that is the same for all pixels.
 *
 *     . . . . . . + +       a tap mixes the four nodes around it; all taps together are weights
 *     . . . . + + + .       of the nodes along the line: of pairs of them that are equally far from
 *     . . + + o + + . .     the middle one (o)
 *     . + + + . . . .
 *     + + . . . . . .       rows are copied, continued by their ends on both sides, no farther
 *                           than a whole row of the frame
 *
 * Differences from the middle node are summed (sample_sums.h), so that equal nodes keep their bits.
 */
#pragma once

#include "engine/defocus/sample_sums.h"
#include "engine/defocus/shifted_source.h"

/* A node from the middle one, and the weight of it and of the opposite one. */
typedef struct cs_shifted_weight {
  int32_t x, y;
  float weight;
} cs_shifted_weight;

typedef struct cs_shifted_line {
  CS_ARRAY(cs_shifted_weight, weights);
  size_t count;
  int32_t extent[2]; /* nodes from the middle one, at most */
} cs_shifted_line;

typedef struct cs_shifted_line_rows {
  const cs_shifted_line *line;
  cs_shifted_source *from;
  int32_t left;           /* the node under the first column */
  int32_t count;          /* columns that are summed, with some beyond the last one */
  int32_t low, width;     /* the nodes of a row that are copied, beyond the grid, too */
  int32_t height;         /* rows: row j of the nodes is row j % height */
  int32_t next;           /* the first row of nodes that has not been copied */
  CS_ARRAY(float, nodes); /* plane after plane */
  CS_ARRAY(cs_defocus_pair, pairs);
  CS_ARRAY(float, sums);
} cs_shifted_line_rows;

/* end: of the line, nodes from its middle. Must be finished after a failure too. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_shifted_line_init(celspan_context *context, const double end[2],
                                                    size_t taps, cs_shifted_line *out);
void cs_shifted_line_finish(cs_shifted_line *line, cs_memory *memory);

/* left: as above. Must be ended after a failure too. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_shifted_line_begin(celspan_context *context,
                                                     const cs_shifted_line *line,
                                                     cs_shifted_source *from, int32_t left,
                                                     int32_t count, cs_shifted_line_rows *out);
/* The means around the nodes of row j, not settled, of one plane; rows come from top to bottom, and
 * plane 0 first. They stay until the next call. Errors: those of the bands. */
CELSPAN_CHECKED celspan_status cs_shifted_line_row(celspan_context *context, cs_isa isa,
                                                   cs_shifted_line_rows *rows, int plane, int32_t j,
                                                   const float **out);
