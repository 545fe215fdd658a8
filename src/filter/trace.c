#include "filter/trace.h"

void cs_trace_finish(cs_trace *trace, cs_memory *memory) {
  cs_mem_free(memory, trace->pieces, trace->piece_capacity * sizeof *trace->pieces);
  cs_mem_free(memory, trace->programs, trace->program_capacity * sizeof *trace->programs);
  cs_mem_free(memory, trace->items, trace->item_capacity * sizeof *trace->items);
  cs_mem_free(memory, trace->strips, trace->strip_capacity * sizeof *trace->strips);
  cs_arena_finish(&trace->paints, memory);
  *trace = (cs_trace){0};
}

void cs_trace_begin(cs_trace *trace, int32_t row, cs_v4 base) {
  trace->row = row;
  trace->base = base;
  trace->is_sealed = false;
  trace->piece_count = trace->program_count = trace->item_count = 0;
  cs_arena_reset(&trace->paints);
}

static bool is_program(const cs_trace *trace, const cs_trace_program *known,
                       const cs_program *program) {
  return known->length == program->length && memcmp(&trace->items[known->item], program->items,
                                                    program->length * sizeof *program->items) == 0;
}

/* A copy of a cell's program; neighbours share theirs. */
static celspan_status keep_program(cs_trace *trace, const cs_composer *composer,
                                   const cs_cell *cell, int32_t *out) {
  cs_program program = cs_composer_program(composer, cell);
  for (size_t i = trace->program_count; i-- > 0 && i + 4 >= trace->program_count;)
    if (is_program(trace, &trace->programs[i], &program)) {
      *out = (int32_t)i;
      return CELSPAN_OK;
    }
  celspan_context *context = composer->context;
  CS_TRY(cs_mem_reserve(context, (void **)&trace->programs, &trace->program_capacity,
                        trace->program_count + 1, sizeof *trace->programs));
  CS_TRY(cs_mem_reserve(context, (void **)&trace->items, &trace->item_capacity,
                        trace->item_count + program.length, sizeof *trace->items));
  memcpy(&trace->items[trace->item_count], program.items, program.length * sizeof *program.items);
  trace->programs[trace->program_count] =
      (cs_trace_program){.item = trace->item_count, .length = program.length};
  trace->item_count += program.length;
  *out = (int32_t)trace->program_count++;
  return CELSPAN_OK;
}

static celspan_status take_look(cs_trace *trace, const cs_composer *composer, const cs_cell *cell,
                                cs_trace_look *out) {
  *out = (cs_trace_look){cs_v4_all(0), -1};
  if (cell->length > 0)
    return keep_program(trace, composer, cell, &out->program);
  out->colour = cell->colour;
  return CELSPAN_OK;
}

celspan_status cs_trace_add(cs_trace *trace, const cs_composer *composer, double xa, double ya,
                            double xb, double yb, const cs_cell *left, const cs_cell *right) {
  CS_TRY(cs_mem_reserve(composer->context, (void **)&trace->pieces, &trace->piece_capacity,
                        trace->piece_count + 1, sizeof *trace->pieces));
  cs_trace_piece *piece = &trace->pieces[trace->piece_count++];
  piece->xa = xa;
  piece->ya = ya;
  piece->xb = xb;
  piece->yb = yb;
  CS_TRY(take_look(trace, composer, left, &piece->left));
  return take_look(trace, composer, right, &piece->right);
}

static bool uses_strips(const cs_trace *trace, const cs_composer *composer) {
  for (size_t i = 0; i < trace->item_count; i++)
    if (composer->stack->leaves[trace->items[i].leaf].kind == CS_LEAF_SCANLINE)
      return true;
  return false;
}

static celspan_status copy_strips(cs_trace *trace, const cs_composer *composer) {
  celspan_context *context = composer->context;
  CS_TRY(cs_mem_reserve(context, (void **)&trace->strips, &trace->strip_capacity,
                        composer->strip_count, sizeof *trace->strips));
  for (size_t i = 0; i < composer->strip_count; i++) {
    cs_strip strip = composer->strips[i];
    size_t size = strip.paint_count * sizeof *strip.paints;
    cs_paint *paints = cs_arena_take(context, &trace->paints, size);
    if (!paints)
      return CELSPAN_NO_MEMORY;
    strip.paints = memcpy(paints, strip.paints, size);
    trace->strips[i] = strip;
  }
  return CELSPAN_OK;
}

celspan_status cs_trace_seal(cs_trace *trace, const cs_composer *composer) {
  if (uses_strips(trace, composer))
    CS_TRY(copy_strips(trace, composer));
  for (size_t i = 0; i < trace->program_count; i++) {
    cs_trace_program *program = &trace->programs[i];
    program->program = (cs_program){&trace->items[program->item], trace->strips, program->length};
  }
  trace->is_sealed = true;
  return CELSPAN_OK;
}
