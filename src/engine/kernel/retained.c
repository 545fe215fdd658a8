#include "engine/kernel/retained.h"

void cs_retained_finish(cs_retained_row *retained, cs_memory *memory) {
  cs_mem_free(memory, retained->edges, retained->edge_capacity * sizeof *retained->edges);
  cs_mem_free(memory, retained->programs, retained->program_capacity * sizeof *retained->programs);
  cs_mem_free(memory, retained->items, retained->item_capacity * sizeof *retained->items);
  cs_mem_free(memory, retained->procedure_spans,
              retained->procedure_span_capacity * sizeof *retained->procedure_spans);
  cs_arena_finish(&retained->paints, memory);
  *retained = (cs_retained_row){0};
}

void cs_retained_begin(cs_retained_row *retained, int32_t row, cs_v4 base) {
  retained->row = row;
  retained->base = base;
  retained->is_sealed = false;
  retained->edge_count = retained->program_count = retained->item_count = 0;
  cs_arena_reset(&retained->paints);
}

static bool is_program(const cs_retained_row *retained, const cs_retained_program *known,
                       const cs_program *program) {
  return known->length == program->length && memcmp(&retained->items[known->item], program->items,
                                                    program->length * sizeof *program->items) == 0;
}

/* A copy of a cell's program; neighbours share theirs. */
static celspan_status keep_program(cs_retained_row *retained, const cs_composer *composer,
                                   const cs_cell *cell, int32_t *out) {
  cs_program program = cs_composer_program(composer, cell);
  for (size_t i = retained->program_count; i-- > 0 && i + 4 >= retained->program_count;)
    if (is_program(retained, &retained->programs[i], &program)) {
      *out = (int32_t)i;
      return CELSPAN_OK;
    }
  celspan_context *context = composer->context;
  CS_TRY(CS_RESERVE(context, retained->programs, retained->program_capacity,
                    retained->program_count + 1));
  CS_TRY(CS_RESERVE(context, retained->items, retained->item_capacity,
                    retained->item_count + program.length));
  memcpy(&retained->items[retained->item_count], program.items,
         program.length * sizeof *program.items);
  retained->programs[retained->program_count] =
      (cs_retained_program){.item = retained->item_count, .length = program.length};
  retained->item_count += program.length;
  *out = (int32_t)retained->program_count++;
  return CELSPAN_OK;
}

static celspan_status copy_side(cs_retained_row *retained, const cs_composer *composer,
                                const cs_cell *cell, cs_retained_side *out) {
  *out = (cs_retained_side){cs_v4_all(0), -1};
  if (cell->length > 0)
    return keep_program(retained, composer, cell, &out->program);
  out->colour = cell->colour;
  return CELSPAN_OK;
}

celspan_status cs_retained_add(cs_retained_row *retained, const cs_composer *composer,
                               const cs_segment *segment, const cs_cell *left,
                               const cs_cell *right) {
  CS_TRY(CS_RESERVE(composer->context, retained->edges, retained->edge_capacity,
                    retained->edge_count + 1));
  cs_retained_edge *edge = &retained->edges[retained->edge_count++];
  edge->xa = segment->xa;
  edge->ya = segment->ya;
  edge->xb = segment->xb;
  edge->yb = segment->yb;
  edge->chain = segment->chain;
  CS_TRY(copy_side(retained, composer, left, &edge->left));
  return copy_side(retained, composer, right, &edge->right);
}

static bool uses_procedures(const cs_retained_row *retained, const cs_composer *composer) {
  for (size_t i = 0; i < retained->item_count; i++)
    if (composer->stack->layers[retained->items[i].layer].kind == CS_LAYER_SCANLINE)
      return true;
  return false;
}

static celspan_status copy_procedure_spans(cs_retained_row *retained, const cs_composer *composer) {
  celspan_context *context = composer->context;
  CS_TRY(CS_RESERVE(context, retained->procedure_spans, retained->procedure_span_capacity,
                    composer->procedure_span_count));
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
  if (uses_procedures(retained, composer))
    CS_TRY(copy_procedure_spans(retained, composer));
  for (size_t i = 0; i < retained->program_count; i++) {
    cs_retained_program *program = &retained->programs[i];
    program->program =
        (cs_program){&retained->items[program->item], retained->procedure_spans, program->length};
  }
  retained->is_sealed = composer->failure == CELSPAN_OK;
  return CELSPAN_OK;
}
