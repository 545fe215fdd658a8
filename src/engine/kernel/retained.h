/* Retained edges of a row: its visible edges, kept after the row is left, for filters that extend
 * from row to row.
 *
 *     base |  side  \  side    |  side      base: the cell left of all edges, the same on every row
 *          |         \         |
 *          |          \        |           an edge is straight and lies between two sides: flat
 *          e0          e1      e2          colours, or programs copied out of the composer
 *
 * At any height of the row the edges that cross it lead from side to side, from the base to the
 * rightmost. So the colour at a point is that of the base plus the colour steps of all edges left
 * of it, in whatever order they are added.
 *
 * Invariant: a retained row is a function of the plan and its row's number.
 */
#pragma once

#include "base/arena.h"
#include "engine/compose/composer.h"
#include "model/geometry/segment.h"

/* What is visible on one side of an edge. */
typedef struct cs_retained_side {
  cs_v4 colour;    /* 0 where it varies */
  int32_t program; /* index into the row's programs; -1: flat */
} cs_retained_side;

typedef struct cs_retained_edge {
  double xa, ya, xb, yb; /* pixels, ya < yb */
  uint32_t chain;        /* as in cs_segment */
  cs_retained_side left, right;
} cs_retained_edge;

typedef struct cs_retained_program {
  cs_program program; /* valid once the row is sealed */
  size_t item;        /* its first one */
  uint32_t length;
} cs_retained_program;

typedef struct cs_retained_row {
  int32_t row;
  bool is_sealed; /* complete: it may be read */
  cs_v4 base;     /* left of everything */
  cs_retained_edge *edges;
  cs_retained_program *programs;
  cs_item *items;
  cs_procedure_span *procedure_spans;
  size_t edge_count, edge_capacity;
  size_t program_count, program_capacity;
  size_t item_count, item_capacity;
  size_t procedure_span_capacity;
  cs_arena paints; /* of the procedure spans */
} cs_retained_row;

void cs_retained_finish(cs_retained_row *retained, cs_memory *memory);
/* Begins a row; base: the cell left of all edges. Its room is kept. */
void cs_retained_begin(cs_retained_row *retained, int32_t row, cs_v4 base);
/* Adds an edge segment between two cells. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_retained_add(cs_retained_row *retained,
                                               const cs_composer *composer,
                                               const cs_segment *segment, const cs_cell *left,
                                               const cs_cell *right);
/* The row is done: copies what its programs need of the composer. It is sealed unless the composer
 * has failed. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_retained_seal(cs_retained_row *retained,
                                                const cs_composer *composer);
