#include "paint/run.h"

#include "paint/colours.h"
#include "paint/defocused_run.h"
#include "paint/lines.h"
#include "paint/over_row.h"

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
    *out = !cs_sampler_is_grid(&view->sampler);
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
  return cs_painter_program_colours(painter, shown, run, (float(*)[4])colours);
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

/* ---------------------------------------------------------------- columns with one opacity */

/* A stretch of columns over which the same items of a program are visible: those that are not clear
 * there, up to the first that is opaque. */
typedef struct stretch {
  uint32_t end;      /* of the items */
  uint64_t left_out; /* which of the first 64 items are left out, one bit each */
  bool ends_opaque;
  bool is_sure; /* every item is clear or opaque in all columns, so it is in any of them */
} stretch;

#define STRIDES 8 /* examined together first, since often one answer holds for all */

/* Whether the samples of an item are all clear, so that it can be left out, or all opaque, so that
 * everything behind it can. */
static celspan_status find_opacity(cs_painter *painter, uint32_t index, cs_run run,
                                   cs_picture_opacity *out) {
  const cs_layer *layer = &painter->stack->layers[index];
  const cs_image_view *view;
  *out = CS_PICTURE_MIXED;
  if (layer->kind != CS_LAYER_PICTURE || layer->role != CS_LAYER_PAINT || layer->fade != 1 ||
      layer->group != CS_STACK_NONE)
    return CELSPAN_OK;
  CS_TRY(cs_painter_image(painter, layer->index, &view));
  if (view->is_opaque) {
    *out = CS_PICTURE_OPAQUE;
    return CELSPAN_OK;
  }
  CS_TRY(cs_sampler_opacity(painter->blocks, &view->sampler, run, out));
  if (*out == CS_PICTURE_OPAQUE &&
      painter->stack->images[layer->index].texture->use == CELSPAN_PICTURE_GEL)
    *out = CS_PICTURE_MIXED;
  return CELSPAN_OK;
}

/* Finds which items of a program are visible over the columns of a run. */
static celspan_status find_shown(cs_painter *painter, const cs_program *program, cs_run run,
                                 stretch *out) {
  *out = (stretch){.end = program->length, .is_sure = true};
  for (uint32_t i = 0; i < program->length && i < 64; i++) {
    cs_picture_opacity opacity;
    CS_TRY(find_opacity(painter, program->items[i].layer, run, &opacity));
    if (opacity == CS_PICTURE_MIXED)
      out->is_sure = false;
    if (opacity == CS_PICTURE_CLEAR)
      out->left_out |= (uint64_t)1 << i;
    if (opacity != CS_PICTURE_OPAQUE)
      continue;
    out->ends_opaque = true;
    out->end = i + 1;
    break;
  }
  return CELSPAN_OK;
}

/* The stretch that begins at run.x0, and *end, up to which it is known. Strides are counted from
 * the left edge of the frame. Many are examined at once if the run covers them: mostly the answer
 * is the same for all. */
static celspan_status next_stretch(cs_painter *painter, const cs_program *program, int32_t stride,
                                   cs_run run, stretch *out, int64_t *end) {
  int32_t x = run.x0, left = x / stride * stride;
  int64_t many = (int64_t)STRIDES * stride;
  if (x % many == 0 && x + many <= run.x1) {
    *end = x + many;
    CS_TRY(find_shown(painter, program, cs_run_between(run, x, (int32_t)*end), out));
    if (out->is_sure)
      return CELSPAN_OK;
  }
  *end = ((int64_t)x / stride + 1) * stride;
  return find_shown(painter, program, cs_run_between(run, left, left + stride), out);
}

static bool is_same_stretch(const stretch *a, const stretch *b) {
  return a->end == b->end && a->left_out == b->left_out && a->ends_opaque == b->ends_opaque;
}

static celspan_status run_stretch(cs_painter *painter, const cs_program *program,
                                  const stretch *visible, cs_run run, cs_row *row) {
  cs_program shown = {program->items, program->procedure_spans, visible->end};
  if (run.x1 <= run.x0)
    return CELSPAN_OK;
  if (visible->left_out) {
    cs_item *items = cs_arena_take(painter->context, &row->colours, visible->end * sizeof *items);
    if (!items)
      return CELSPAN_NO_MEMORY;
    shown = (cs_program){items, program->procedure_spans, 0};
    for (uint32_t i = 0; i < visible->end; i++)
      if (i >= 64 || !(visible->left_out >> i & 1))
        items[shown.length++] = program->items[i];
  }
  return run_shown(painter, &shown, visible->ends_opaque, run, row);
}

/* ---------------------------------------------------------------- runs */

static bool has_picture(const cs_stack *stack, const cs_program *program) {
  for (uint32_t i = 0; i < program->length; i++)
    if (stack->layers[program->items[i].layer].kind == CS_LAYER_PICTURE)
      return true;
  return false;
}

/* How many columns are examined at a time: the least number that any picture of the program asks
 * for (opacity_columns). They are counted from the left edge of the frame, since their opacity must
 * not depend on where a run begins. */
static celspan_status find_stride(cs_painter *painter, const cs_program *program, int32_t *out) {
  *out = INT32_MAX;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &painter->stack->layers[program->items[i].layer];
    const cs_image_view *view;
    if (layer->kind != CS_LAYER_PICTURE)
      continue;
    CS_TRY(cs_painter_image(painter, layer->index, &view));
    if (!view->is_opaque && view->sampler.opacity_columns < *out)
      *out = view->sampler.opacity_columns;
  }
  return CELSPAN_OK;
}

static celspan_status run_stretches(cs_painter *painter, const cs_program *program, cs_run run,
                                    cs_row *row) {
  stretch current, next;
  int32_t begun = run.x0, stride;
  int64_t end;
  CS_TRY(find_stride(painter, program, &stride));
  CS_TRY(next_stretch(painter, program, stride, run, &current, &end));
  while (end < run.x1) {
    int32_t x = (int32_t)end;
    CS_TRY(next_stretch(painter, program, stride, cs_run_between(run, x, run.x1), &next, &end));
    if (is_same_stretch(&current, &next))
      continue;
    CS_TRY(run_stretch(painter, program, &current, cs_run_between(run, begun, x), row));
    begun = x;
    current = next;
  }
  return run_stretch(painter, program, &current, cs_run_between(run, begun, run.x1), row);
}

celspan_status cs_painter_run_program(cs_painter *painter, const cs_program *program, cs_run run,
                                      cs_row *row) {
  if (run.x1 <= run.x0)
    return CELSPAN_OK;
  return has_picture(painter->stack, program) ? run_stretches(painter, program, run, row)
                                              : run_shown(painter, program, false, run, row);
}

celspan_status cs_painter_run(cs_painter *painter, const cs_cell *cell, cs_run run, cs_row *row) {
  if (cell->length == 0)
    return cs_row_single(painter->context, row, run.x0, run.x1, cell->colour);
  cs_program program = cs_composer_program(painter->composer, cell);
  return cs_painter_run_program(painter, &program, run, row);
}
