#include "engine/compose/procedures.h"

#include "base/number.h"
#include "base/sort.h"
#include "model/colour/space.h"

void cs_procedures_init(cs_procedures *procedures, cs_composer *composer, cs_arena *arena,
                        int32_t width, int32_t margin) {
  *procedures =
      (cs_procedures){.composer = composer, .arena = arena, .width = width, .margin = margin};
  cs_scanline_init(&procedures->output);
}

void cs_procedures_finish(cs_procedures *procedures, cs_memory *memory) {
  cs_scanline_finish(&procedures->output, memory);
}

static bool procedure_meets(const cs_procedure *procedure, double y0, double y1) {
  const celspan_box *box = &procedure->desc->bounds;
  double a = box->y * procedure->scale_y + procedure->shift_y;
  double b = (box->y + box->height) * procedure->scale_y + procedure->shift_y;
  return a < b ? a < y1 && b > y0 : b < y1 && a > y0;
}

bool cs_procedures_meet(const cs_procedures *procedures, int32_t y) {
  const cs_stack *stack = procedures->composer->stack;
  for (size_t i = 0; i < stack->procedure_count; i++)
    if (procedure_meets(&stack->procedures[i], y, y + 1.0))
      return true;
  return false;
}

/* The part of the frame and its margin in which a procedure can be visible, in its own units. */
static celspan_scanline_row visible_row(const cs_procedures *procedures,
                                        const cs_procedure *procedure) {
  const celspan_box *box = &procedure->desc->bounds;
  double a = (-procedures->margin - procedure->shift_x) / procedure->scale_x;
  double b =
      ((double)procedures->width + procedures->margin - procedure->shift_x) / procedure->scale_x;
  double low = a < b ? a : b, high = a < b ? b : a;
  double pixel = procedure->scale_x < 0 ? -1 / procedure->scale_x : 1 / procedure->scale_x;
  return (celspan_scanline_row){cs_number_clamp(low, box->x, box->x + box->width),
                                cs_number_clamp(high, box->x, box->x + box->width), pixel};
}

static celspan_status add_edge(cs_procedures *procedures, cs_procedure_edges *list,
                               cs_procedure_edge edge) {
  cs_procedure_edge *edges = cs_arena_grow(procedures->composer->context, procedures->arena,
                                           list->edges, list->count, &list->capacity, sizeof edge);
  if (!edges)
    return CELSPAN_NO_MEMORY;
  edges[list->count++] = edge;
  list->edges = edges;
  return CELSPAN_OK;
}

/* Adds one span of a procedure to the row, with its two edges. */
static celspan_status add_span(cs_procedures *procedures, const cs_procedure *procedure,
                               const cs_scanline_span *span, const cs_paint *paints,
                               cs_procedure_edges *edges) {
  cs_composer *composer = procedures->composer;
  double scale = procedure->scale_x, shift = procedure->shift_x;
  double left = -procedures->margin, right = (double)procedures->width + procedures->margin;
  double a = cs_number_clamp(span->x0 * scale + shift, left, right);
  double b = cs_number_clamp(span->x1 * scale + shift, left, right);
  if (a == b)
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_RESERVE(procedures->composer->context, composer->procedure_spans,
                          composer->procedure_span_count + 1));
  uint32_t number = (uint32_t)composer->procedure_span_count++;
  composer->procedure_spans[number] = (cs_procedure_span){
      span->paint_x0 * scale + shift, span->paint_x1 * scale + shift, paints, span->paint_count};
  CS_TRY(
      add_edge(procedures, edges, (cs_procedure_edge){a < b ? a : b, procedure->layer, number, 1}));
  return add_edge(procedures, edges,
                  (cs_procedure_edge){a < b ? b : a, procedure->layer, number, -1});
}

static celspan_status add_spans(cs_procedures *procedures, const cs_procedure *procedure,
                                const celspan_scanline_output *output, cs_procedure_edges *edges) {
  cs_paint *paints = cs_arena_take(procedures->composer->context, procedures->arena,
                                   output->paint_count * sizeof *paints);
  if (!paints)
    return CELSPAN_NO_MEMORY;
  if (output->paint_count > 0)
    memcpy(paints, output->paints, output->paint_count * sizeof *paints);
  for (size_t i = 0; i < output->paint_count && procedure->space == CELSPAN_SPACE_SRGB; i++)
    paints[i] = cs_space_paint(procedure->space, paints[i]);
  for (size_t i = 0; i < output->span_count; i++)
    CS_TRY(add_span(procedures, procedure, &output->spans[i], paints + output->spans[i].first_paint,
                    edges));
  return CELSPAN_OK;
}

celspan_status cs_procedures_collect(cs_procedures *procedures, double height,
                                     cs_procedure_edges *edges) {
  const cs_stack *stack = procedures->composer->stack;
  for (size_t i = 0; i < stack->procedure_count; i++) {
    const cs_procedure *procedure = &stack->procedures[i];
    celspan_scanline_row row = visible_row(procedures, procedure);
    if (!procedure_meets(procedure, height, height) || !(row.x0 < row.x1))
      continue;
    double y = (height - procedure->shift_y) / procedure->scale_y;
    CS_TRY(cs_scanline_collect(procedures->composer->context, procedure->desc, y, &row,
                               &procedures->output));
    CS_TRY(add_spans(procedures, procedure, &procedures->output, edges));
  }
  return CELSPAN_OK;
}

static inline bool edge_is_before(const cs_procedure_edge *a, const cs_procedure_edge *b) {
  if (a->x != b->x)
    return a->x < b->x;
  /* where one span ends and the next begins: end first */
  return a->direction != b->direction ? a->direction < b->direction : a->span < b->span;
}

CS_SORT_DEFINE(sort_edges, cs_procedure_edge, edge_is_before)

void cs_procedures_sort(cs_procedure_edges *edges) { sort_edges(edges->edges, edges->count); }
