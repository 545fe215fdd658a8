#include "paint/run.h"

#include "paint/colours.h"
#include "paint/defocused_run.h"
#include "paint/lines.h"
#include "paint/over_row.h"
#include "paint/shown.h"

/* ---------------------------------------------------------------- programs without hidden items */

/* Whether a picture of the program shows pixel by pixel. */
static celspan_status needs_array(cs_painter *painter, const cs_program *program, bool *out) {
  *out = false;
  for (uint32_t i = 0; i < program->length && !*out; i++) {
    const cs_layer *layer = &painter->stack->layers[program->items[i].layer];
    const cs_image_view *view;
    if (layer->kind != CS_LAYER_PICTURE)
      continue;
    CS_TRY(cs_painter_image(painter, layer->index, &view));
    *out = !cs_sampler_is_grid(&view->sampler) ||
           painter->stack->images[layer->index].texture->variation->medium;
  }
  return CELSPAN_OK;
}

/* Whether the program is one opaque picture whose texels are the pixels. */
static bool is_copy(const cs_painter *painter, const cs_program *shown, bool ends_opaque) {
  if (!ends_opaque || shown->length != 1)
    return false;
  const cs_layer *layer = &painter->stack->layers[shown->items[0].layer];
  return cs_painter_is_bare(painter, shown->items[0]) &&
         painter->images[layer->index].sampler.placement == CS_SAMPLER_COPY;
}

static celspan_status run_copy(cs_painter *painter, const cs_program *shown, cs_run run,
                               cs_row *row) {
  const cs_layer *layer = &painter->stack->layers[shown->items[0].layer];
  unsigned char *codes;
  CS_TRY(cs_row_codes(painter->context, row, run.x0, run.x1, &codes));
  return cs_sampler_codes(painter->blocks, &painter->images[layer->index].sampler, run, codes);
}

/* Pixels coded while they are in the cache. */
static celspan_status run_codes(cs_painter *painter, const cs_program *shown, cs_run run,
                                cs_row *row) {
  unsigned char *codes;
  CS_TRY(cs_row_codes(painter->context, row, run.x0, run.x1, &codes));
  for (int32_t x = run.x0; x < run.x1; x += CS_OVER_ROW_BATCH) {
    int32_t count = run.x1 - x < CS_OVER_ROW_BATCH ? run.x1 - x : CS_OVER_ROW_BATCH;
    cs_batch batch = {NULL, x, count, run.y};
    CS_TRY(cs_painter_batch_codes(painter, shown, &batch, codes + 4 * (size_t)(x - run.x0)));
  }
  return CELSPAN_OK;
}

static celspan_status run_array(cs_painter *painter, const cs_program *shown, cs_run run,
                                cs_row *row) {
  float *colours;
  CS_TRY(cs_row_array(painter->context, row, run.x0, run.x1, &colours));
  return cs_painter_shown_colours(painter, shown, run, (float(*)[4])colours);
}

/* A program of the visible items alone. ends_opaque: nothing shines through it. */
static celspan_status run_shown(cs_painter *painter, const cs_program *shown, bool ends_opaque,
                                cs_run run, cs_row *row) {
  bool is_array;
  uint32_t item;
  if (row->takes_codes && is_copy(painter, shown, ends_opaque))
    return run_copy(painter, shown, run, row);
  if (cs_defocused_run_fits(painter->stack, shown, &item))
    return cs_defocused_run(painter, shown, item, run, row);
  CS_TRY(needs_array(painter, shown, &is_array));
  if (!is_array)
    return cs_lines_run(painter, shown, run, row);
  return row->takes_codes ? run_codes(painter, shown, run, row)
                          : run_array(painter, shown, run, row);
}

/* ---------------------------------------------------------------- columns that show the same */

#define STRIDES 8 /* examined together first, since often one answer holds for all */

/* What shows from run.x0 on, and *end, up to which it is known. Strides are counted from the left
 * edge of the frame, since what shows must not depend on where a run begins. Many are examined at
 * once if the run covers them: mostly the answer is the same for all. */
static celspan_status next_shown(cs_painter *painter, const cs_program *program, int32_t stride,
                                 cs_run run, cs_shown *out, int64_t *end) {
  int32_t x = run.x0, left = x / stride * stride;
  int64_t many = (int64_t)STRIDES * stride;
  if (x % many == 0 && x + many <= run.x1) {
    *end = x + many;
    CS_TRY(cs_shown_find(painter, program, cs_run_between(run, x, (int32_t)*end), out));
    if (out->is_sure)
      return CELSPAN_OK;
  }
  *end = ((int64_t)x / stride + 1) * stride;
  return cs_shown_find(painter, program, cs_run_between(run, left, left + stride), out);
}

static celspan_status run_stretch(cs_painter *painter, const cs_program *program,
                                  const cs_shown *visible, cs_run run, cs_row *row) {
  if (run.x1 <= run.x0)
    return CELSPAN_OK;
  const cs_program shown = {visible->items, program->procedure_spans, visible->length};
  return run_shown(painter, &shown, visible->ends_opaque, run, row);
}

static celspan_status run_stretches(cs_painter *painter, const cs_program *program, cs_run run,
                                    cs_row *row) {
  cs_shown *current = &painter->shown[0], *next = &painter->shown[1];
  int32_t begun = run.x0, stride = cs_shown_stride(painter, program);
  int64_t end;
  CS_TRY(next_shown(painter, program, stride, run, current, &end));
  while (end < run.x1) {
    int32_t x = (int32_t)end;
    CS_TRY(next_shown(painter, program, stride, cs_run_between(run, x, run.x1), next, &end));
    if (cs_shown_same(current, next))
      continue;
    CS_TRY(run_stretch(painter, program, current, cs_run_between(run, begun, x), row));
    begun = x;
    cs_shown *done = current;
    current = next;
    next = done;
  }
  return run_stretch(painter, program, current, cs_run_between(run, begun, run.x1), row);
}

/* ---------------------------------------------------------------- runs */

celspan_status cs_painter_run_program(cs_painter *painter, const cs_program *program, cs_run run,
                                      cs_row *row) {
  if (run.x1 <= run.x0)
    return CELSPAN_OK;
  return cs_shown_varies(painter->stack, program) ? run_stretches(painter, program, run, row)
                                                  : run_shown(painter, program, false, run, row);
}

celspan_status cs_painter_run(cs_painter *painter, const cs_cell *cell, cs_run run, cs_row *row) {
  if (cell->length == 0)
    return cs_row_single(painter->context, row, run.x0, run.x1, cell->colour);
  cs_program program = cs_composer_program(painter->composer, cell);
  return cs_painter_run_program(painter, &program, run, row);
}
