/* Cells and programs: what the composer says about the space between two boundaries.
 *
 * A cell has one colour everywhere, or a program: the layers that show in it, front to back, of
 * which at least one varies along a row. Its colours are computed by paint/.
 *
 * Invariant: a cell depends on its set of layers alone, and on the procedure spans it lies in.
 */
#pragma once

#include "engine/compose/set.h"
#include "engine/compose/stack.h"

/* One layer of a program. */
typedef struct cs_item {
  uint32_t layer;
  /* SCANLINE: the number of one of the row's procedure spans; otherwise 0 */
  uint32_t procedure_span;
} cs_item;

typedef struct cs_cell {
  cs_v4 colour;     /* where length == 0: premultiplied RGBA */
  cs_set_hash hash; /* the hash of the layers present */
  uint32_t program; /* index of the first item among the composer's */
  uint32_t length;  /* items; 0: one colour everywhere */
} cs_cell;

/* A span of a scan-line primitive on the current row (or sub-row), in frame pixels. */
typedef struct cs_procedure_span {
  double x0, x1;
  const cs_paint *paints; /* evenly spaced from x0 to x1; a single paint is the same everywhere */
  size_t paint_count;
} cs_procedure_span;

/* A program that can be kept without the composer. */
typedef struct cs_program {
  const cs_item *items;                     /* front to back */
  const cs_procedure_span *procedure_spans; /* the spans to which items of SCANLINE layers refer */
  uint32_t length;                          /* 0: nothing is visible except back lights */
} cs_program;

/* Whether the colours of a program are not an affine function of each of its paints. */
static inline bool cs_program_curves(const cs_stack *stack, const cs_program *program) {
  bool curves = false;
  for (uint32_t i = 0; stack->has_curves && i < program->length && !curves; i++) {
    uint32_t group = stack->layers[program->items[i].layer].group;
    curves = group != CS_STACK_NONE && stack->groups[group].curves;
  }
  return curves;
}
