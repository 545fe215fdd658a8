/* Retained rows: the borders of a row, kept after the row is left, for filters that extend from row
 * to row.
 *
 *     base |  cell  \  cell    |  cell     base: the colour left of all edges, as on every row
 *          |         \         |
 *          |          \        |          an edge is a border between cells that are copied out of
 *          e0          e1      e2         the composer, with their programs
 *
 * Neighbours share most cells: a row of n edges has little more than n + 1.
 *
 * Invariant: a retained row is a function of the plan and its row's number.
 */
#pragma once

#include "base/arena.h"
#include "engine/compose/border.h"
#include "engine/compose/composer.h"

typedef struct cs_retained_row {
  int32_t row;
  bool is_sealed; /* complete, so that it may be read */
  cs_v4 base;     /* the colour to the left of all edges */
  /* between cells of the row; until the row is sealed, between cells of the composer */
  CS_ARRAY(cs_border, edges);
  CS_ARRAY(cs_cell, cells); /* in the order of the edges; colours are 0 where they vary */
  CS_ARRAY(cs_item, items); /* the items of their programs */
  CS_ARRAY(cs_procedure_span, procedure_spans);
  size_t edge_count, cell_count, item_count;
  cs_arena paints; /* the paints of the procedure spans */
} cs_retained_row;

void cs_retained_finish(cs_retained_row *retained, cs_memory *memory);
/* Begins a row; base: the cell left of all edges. Its room is kept. */
void cs_retained_begin(cs_retained_row *retained, int32_t row, cs_v4 base);
/* Adds an edge, whose cells last until the row is sealed. Errors: NO_MEMORY. */
static inline CELSPAN_CHECKED celspan_status cs_retained_add(cs_retained_row *retained,
                                                             celspan_context *context,
                                                             const cs_border *edge) {
  return CS_ARRAY_APPEND(context, retained->edges, retained->edge_count, *edge);
}
/* The row is done: copies the data of the composer that its edges need. It is sealed unless the
 * composer has failed. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_retained_seal(cs_retained_row *retained,
                                                const cs_composer *composer);

/* The number of a cell of the row. */
static inline size_t cs_retained_number(const cs_retained_row *retained, const cs_cell *cell) {
  return (size_t)(cell - retained->cells);
}

/* The program of a cell of the row that varies. */
static inline cs_program cs_retained_program(const cs_retained_row *retained, const cs_cell *cell) {
  return (cs_program){&retained->items[cell->program], retained->procedure_spans, cell->length};
}
