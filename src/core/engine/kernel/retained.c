#include "engine/kernel/retained.h"

void cs_retained_finish(cs_retained_row *retained, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, retained, edges, procedure_spans);
  cs_arena_finish(&retained->paints, memory);
  *retained = (cs_retained_row){0};
}

void cs_retained_begin(cs_retained_row *retained, int32_t row, cs_v4 base) {
  retained->row = row;
  retained->base = base;
  retained->is_sealed = false;
  retained->edge_count = retained->cell_count = retained->item_count = 0;
  cs_arena_reset(&retained->paints);
}

#define LAST 2 /* how many of the last cells are compared with a new one */

/* Whether a cell of the row shows the same as one of the composer. */
static bool is_copy(const cs_retained_row *retained, const cs_composer *composer,
                    const cs_cell *copy, const cs_cell *cell) {
  if (copy->length != cell->length)
    return false;
  return cell->length > 0 ? memcmp(&retained->items[copy->program], &composer->items[cell->program],
                                   cell->length * sizeof(cs_item)) == 0
                          : memcmp(&copy->colour, &cell->colour, sizeof cell->colour) == 0;
}

/* Replaces a cell of the composer by a copy, for which there is room. */
static celspan_status copy_cell(cs_retained_row *retained, const cs_composer *composer,
                                const cs_cell **cell) {
  const cs_cell *of = *cell;
  for (size_t i = retained->cell_count; i-- > 0 && i + LAST >= retained->cell_count;)
    if (is_copy(retained, composer, &retained->cells[i], of)) {
      *cell = &retained->cells[i];
      return CELSPAN_OK;
    }
  CS_TRY(CS_ARRAY_RESERVE(composer->context, retained->items, retained->item_count + of->length));
  if (of->length > 0)
    memcpy(&retained->items[retained->item_count], &composer->items[of->program],
           of->length * sizeof(cs_item));
  cs_cell *copy = &retained->cells[retained->cell_count++];
  *copy = (cs_cell){.colour = of->length > 0 ? cs_v4_all(0) : of->colour,
                    .program = (uint32_t)retained->item_count,
                    .length = of->length};
  retained->item_count += of->length;
  *cell = copy;
  return CELSPAN_OK;
}

static celspan_status copy_cells(cs_retained_row *retained, const cs_composer *composer) {
  CS_TRY(CS_ARRAY_RESERVE(composer->context, retained->cells, 2 * retained->edge_count));
  for (size_t i = 0; i < retained->edge_count; i++) {
    CS_TRY(copy_cell(retained, composer, &retained->edges[i].left));
    CS_TRY(copy_cell(retained, composer, &retained->edges[i].right));
  }
  return CELSPAN_OK;
}

static bool uses_procedures(const cs_retained_row *retained, const cs_composer *composer) {
  for (size_t i = 0; i < retained->item_count; i++)
    if (composer->stack->layers[retained->items[i].layer].kind == CS_LAYER_SCANLINE)
      return true;
  return false;
}

static celspan_status copy_procedure_spans(cs_retained_row *retained, const cs_composer *composer) {
  celspan_context *context = composer->context;
  CS_TRY(CS_ARRAY_RESERVE(context, retained->procedure_spans, composer->procedure_span_count));
  for (size_t i = 0; i < composer->procedure_span_count; i++) {
    cs_procedure_span procedure_span = composer->procedure_spans[i];
    size_t size = procedure_span.paint_count * sizeof *procedure_span.paints;
    cs_paint *paints = cs_arena_take(context, &retained->paints, size);
    if (!paints)
      return CELSPAN_NO_MEMORY;
    procedure_span.paints = memcpy(paints, procedure_span.paints, size);
    retained->procedure_spans[i] = procedure_span;
  }
  return CELSPAN_OK;
}

celspan_status cs_retained_seal(cs_retained_row *retained, const cs_composer *composer) {
  CS_TRY(copy_cells(retained, composer));
  if (uses_procedures(retained, composer))
    CS_TRY(copy_procedure_spans(retained, composer));
  retained->is_sealed = composer->failure == CELSPAN_OK;
  return CELSPAN_OK;
}
