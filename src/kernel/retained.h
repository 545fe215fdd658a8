/* Traces: the visible boundaries of a row, kept after the row is left, for filters that reach from
 * row to row.
 *
 * A piece is straight and lies between two looks: flat colours, or programs copied out of the
 * composer. At any height of the row the pieces that cross it lead from look to look, from the one
 * left of the frame (the same on every row) to the rightmost; so what is seen at a point is the sum
 * of the steps of the pieces left of it, in whatever order they are added.
 *
 * Invariant: a trace is a function of the shot and its row's number.
 */
#ifndef CS_KERNEL_RETAINED_H
#define CS_KERNEL_RETAINED_H

#include "base/arena.h"
#include "compose/composer.h"
#include "geometry/segment.h"

/* What is seen on one side of a piece. */
typedef struct cs_retained_side {
  cs_v4 colour;    /* 0 where it varies */
  int32_t program; /* index into the trace's programs; -1: flat */
} cs_retained_side;

typedef struct cs_retained_edge {
  double xa, ya, xb, yb; /* pixels, ya < yb */
  cs_retained_side left, right;
} cs_retained_edge;

typedef struct cs_retained_program {
  cs_program program; /* valid once the trace is sealed */
  size_t item;
  uint32_t length;
} cs_retained_program;

typedef struct cs_retained_row {
  int32_t row;
  bool is_sealed;
  cs_v4 base; /* left of everything */
  cs_retained_edge *pieces;
  cs_retained_program *programs;
  cs_item *items;
  cs_procedure_span *procedure_spans;
  size_t piece_count, piece_capacity;
  size_t program_count, program_capacity;
  size_t item_count, item_capacity;
  size_t procedure_span_capacity;
  cs_arena paints; /* of the strips */
} cs_retained_row;

void cs_retained_finish(cs_retained_row *retained, cs_memory *memory);
void cs_retained_begin(cs_retained_row *retained, int32_t row, cs_v4 base);
CELSPAN_CHECKED celspan_status cs_retained_add(cs_retained_row *retained,
                                               const cs_composer *composer,
                                               const cs_segment *segment, const cs_cell *left,
                                               const cs_cell *right);
/* The row is done: copies what its programs need of the composer. */
CELSPAN_CHECKED celspan_status cs_retained_seal(cs_retained_row *retained,
                                                const cs_composer *composer);

#endif
