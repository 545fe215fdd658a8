#include "row/procedures.h"

#include "base/number.h"
#include "paint/run.h"

#include <math.h>
#include <stdlib.h>

/* ---------------------------------------------------------------- calling */

static bool procedure_meets(const cs_procedure *procedure, double y0, double y1) {
  const celspan_box *box = &procedure->desc->bounds;
  double a = box->y * procedure->scale_y + procedure->shift_y;
  double b = (box->y + box->height) * procedure->scale_y + procedure->shift_y;
  return a < b ? a < y1 && b > y0 : b < y1 && a > y0;
}

bool cs_procedures_meet(const cs_row_maker *maker, int32_t y) {
  const cs_stack *stack = &maker->plan->stack;
  for (size_t i = 0; i < stack->procedure_count; i++)
    if (procedure_meets(&stack->procedures[i], y, y + 1.0))
      return true;
  return false;
}

/* The part of the frame, and of its margin, a procedure can be seen in, in its own units. */
static celspan_scanline_row visible_row(const cs_procedure *procedure, const cs_plan *plan) {
  const celspan_box *box = &procedure->desc->bounds;
  double a = (-plan->margin - procedure->shift_x) / procedure->scale_x;
  double b = ((double)plan->width + plan->margin - procedure->shift_x) / procedure->scale_x;
  double low = a < b ? a : b, high = a < b ? b : a;
  double pixel = procedure->scale_x < 0 ? -1 / procedure->scale_x : 1 / procedure->scale_x;
  return (celspan_scanline_row){cs_number_clamp(low, box->x, box->x + box->width),
                                cs_number_clamp(high, box->x, box->x + box->width), pixel};
}

static celspan_status add_edge(cs_row_maker *maker, cs_procedure_edges *list,
                               cs_procedure_edge edge) {
  if (list->count == list->capacity) {
    size_t wanted = list->capacity ? 2 * list->capacity : 64;
    cs_procedure_edge *grown = cs_arena_take(maker->context, &maker->arena, wanted * sizeof *grown);
    if (!grown)
      return CELSPAN_NO_MEMORY;
    if (list->count > 0)
      memcpy(grown, list->edges, list->count * sizeof *grown);
    list->edges = grown;
    list->capacity = wanted;
  }
  list->edges[list->count++] = edge;
  return CELSPAN_OK;
}

/* One span of a procedure as a strip of the row with its two edges. */
static celspan_status add_procedures(cs_row_maker *maker, const cs_procedure *procedure,
                                     const cs_scanline_span *span, const cs_paint *paints,
                                     cs_procedure_edges *edges) {
  cs_composer *composer = &maker->composer;
  double scale = procedure->scale_x, shift = procedure->shift_x;
  double left = -maker->plan->margin, right = (double)maker->plan->width + maker->plan->margin;
  double a = cs_number_clamp(span->x0 * scale + shift, left, right);
  double b = cs_number_clamp(span->x1 * scale + shift, left, right);
  if (a == b)
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(maker->context, (void **)&composer->procedure_spans,
                        &composer->procedure_span_capacity, composer->procedure_span_count + 1,
                        sizeof *composer->procedure_spans));
  uint32_t number = (uint32_t)composer->procedure_span_count++;
  composer->procedure_spans[number] = (cs_procedure_span){
      span->paint_x0 * scale + shift, span->paint_x1 * scale + shift, paints, span->paint_count};
  CS_TRY(add_edge(maker, edges, (cs_procedure_edge){a < b ? a : b, procedure->layer, number, 1}));
  return add_edge(maker, edges, (cs_procedure_edge){a < b ? b : a, procedure->layer, number, -1});
}

static celspan_status add_spans(cs_row_maker *maker, const cs_procedure *procedure,
                                const celspan_scanline_output *output, cs_procedure_edges *edges) {
  cs_paint *paints =
      cs_arena_take(maker->context, &maker->arena, output->paint_count * sizeof *paints);
  if (!paints)
    return CELSPAN_NO_MEMORY;
  if (output->paint_count > 0)
    memcpy(paints, output->paints, output->paint_count * sizeof *paints);
  for (size_t i = 0; i < output->span_count; i++)
    CS_TRY(add_procedures(maker, procedure, &output->spans[i],
                          paints + output->spans[i].first_paint, edges));
  return CELSPAN_OK;
}

celspan_status cs_procedures_collect(cs_row_maker *maker, double height,
                                     cs_procedure_edges *edges) {
  const cs_stack *stack = &maker->plan->stack;
  for (size_t i = 0; i < stack->procedure_count; i++) {
    const cs_procedure *procedure = &stack->procedures[i];
    celspan_scanline_row row = visible_row(procedure, maker->plan);
    if (!procedure_meets(procedure, height, height) || !(row.x0 < row.x1))
      continue;
    double y = (height - procedure->shift_y) / procedure->scale_y;
    CS_TRY(cs_scanline_collect(maker->context, procedure->desc, y, &row, &maker->output));
    CS_TRY(add_spans(maker, procedure, &maker->output, edges));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pixel centres */

static int compare_edges(const void *p, const void *q) {
  const cs_procedure_edge *a = p, *b = q;
  if (a->x != b->x)
    return a->x < b->x ? -1 : 1;
  if (a->direction != b->direction) /* where one span ends and the next begins: end first */
    return a->direction < b->direction ? -1 : 1;
  return (a->span > b->span) - (a->span < b->span);
}

/* Crosses the next boundary or edge of the merged order. */
static void cross_next(cs_row_maker *maker, const cs_procedure_edges *edges, size_t *boundary,
                       size_t *edge) {
  const cs_active *active = &maker->active;
  if (*edge == edges->count ||
      (*boundary < active->count && active->x[*boundary] <= edges->edges[*edge].x)) {
    const cs_crossing *crossing = &active->crossing[(*boundary)++];
    cs_composer_cross(&maker->composer, crossing->layer, crossing->direction);
    return;
  }
  const cs_procedure_edge *e = &edges->edges[(*edge)++];
  cs_composer_cross_span(&maker->composer, e->layer, e->span, e->direction);
}

static double peek_next(const cs_row_maker *maker, const cs_procedure_edges *edges, size_t boundary,
                        size_t edge) {
  double x = maker->plan->width;
  if (boundary < maker->active.count && maker->active.x[boundary] < x)
    x = maker->active.x[boundary];
  if (edge < edges->count && edges->edges[edge].x < x)
    x = edges->edges[edge].x;
  return x;
}

celspan_status cs_procedures_centre_row(cs_row_maker *maker, int32_t y, cs_row *out) {
  cs_composer *composer = &maker->composer;
  cs_procedure_edges edges = {0};
  CS_TRY(cs_procedures_collect(maker, y + 0.5, &edges));
  if (edges.count > 0)
    qsort(edges.edges, edges.count, sizeof *edges.edges, compare_edges);
  cs_cells_home(&maker->cells, composer);
  size_t boundary = 0, edge = 0, total = maker->active.count + edges.count;
  int32_t from = 0, at = 0, width = maker->plan->width; /* the run being gathered: [from, at) */
  cs_cell run = {.colour = cs_v4_all(0)};
  double at_x = 0; /* where the cell now composed begins */
  const cs_deferred *deferred_end, *deferred = cs_active_deferred(&maker->active, &deferred_end);
  for (;;) {
    int32_t to = cs_number_first_centre(peek_next(maker, &edges, boundary, edge));
    to = boundary + edge == total || to > width ? width : to;
    deferred = cs_cells_defer(composer, deferred, deferred_end, at_x);
    if (to > at) {
      cs_cell cell;
      cs_composer_cell(composer, &cell);
      CS_TRY(composer->failure);
      if (!cs_composer_same(composer, &cell, &run)) {
        CS_TRY(cs_painter_run(&maker->painter, &run, (cs_run){from, at, y + 0.5}, out));
        from = at;
        run = cell;
      }
      at = to;
    }
    if (boundary + edge == total)
      break;
    at_x = peek_next(maker, &edges, boundary, edge);
    cross_next(maker, &edges, &boundary, &edge);
  }
  cs_cells_defer(composer, deferred, deferred_end, INFINITY);
  return cs_painter_run(&maker->painter, &run, (cs_run){from, width, y + 0.5}, out);
}
