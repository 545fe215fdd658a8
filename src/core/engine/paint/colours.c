#include "engine/paint/colours.h"

#include "base/number.h"
#include "engine/paint/gradient_table.h"
#include "engine/paint/over_bare.h"
#include "engine/paint/over_channels.h"
#include "engine/paint/over_row.h"
#include "engine/paint/shade.h"
#include "engine/paint/shown.h"
#include "model/colour/srgb8_lanes.h"

#include <math.h>

/* ---------------------------------------------------------------- samples */

/* The paint of a procedure span at x: one is flat, two or more are evenly spaced over it. */
static cs_paint procedure_paint(const cs_procedure_span *span, double x) {
  if (span->paint_count == 1)
    return span->paints[0];
  double last = (double)(span->paint_count - 1);
  double at = cs_number_clamp((x - span->x0) / (span->x1 - span->x0), 0, 1) * last;
  size_t i = (size_t)cs_number_clamp(floor(at), 0, last - 1);
  return cs_paint_mix(&span->paints[i], &span->paints[i + 1], (float)(at - (double)i));
}

/* The samples and paints of one layer that varies, in a batch of pixels. */
typedef struct samples {
  float rgba[CS_OVER_ROW_BATCH][4];                       /* pictures */
  float s[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4]; /* all others; s is not lit */
} samples;

static void sample_procedure(const cs_procedure_span *span, const cs_batch *batch, samples *out) {
  for (int32_t k = 0; k < batch->count; k++) {
    cs_paint paint = procedure_paint(span, cs_batch_centre(batch, k));
    cs_v4_store(out->s[k], (cs_v4){paint.s[0], paint.s[1], paint.s[2], 0});
    cs_v4_store(out->t[k], (cs_v4){paint.t[0], paint.t[1], paint.t[2], 0});
  }
}

static celspan_status sample(cs_painter *painter, const cs_sampler *sampler, const cs_batch *batch,
                             float (*rgba)[4]) {
  if (batch->columns)
    return cs_sampler_at(painter->blocks, sampler, batch->columns, batch->count, batch->y, rgba);
  cs_run run = {batch->x0, batch->x0 + batch->count, batch->y};
  return cs_sampler_run(painter->blocks, sampler, run, rgba);
}

/* Samples of a picture used as paint, as numbers of the layer's space. */
static void code_samples(const cs_painter *painter, const cs_image_layer *image, int32_t count,
                         float (*rgba)[4]) {
  float alphas[CS_OVER_ROW_BATCH][4];
  if (image->texture->variation->use != CELSPAN_PICTURE_PAINT || image->space != CELSPAN_SPACE_SRGB)
    return;
  for (int32_t k = 0; k < count; k++)
    cs_v4_store(alphas[k], cs_v4_all(rgba[k][3]));
  CS_WIDE_CHOOSE(painter->isa, cs_space_pixels)
  (image->space, alphas[0], count, rgba[0]);
}

static celspan_status sample_picture(cs_painter *painter, const cs_layer *layer,
                                     const cs_batch *batch, float (*rgba)[4]) {
  const cs_image_view *view;
  CS_TRY(cs_painter_image(painter, layer->index, &view));
  CS_TRY(sample(painter, &view->sampler, batch, rgba));
  code_samples(painter, &painter->stack->images[layer->index], batch->count, rgba);
  return CELSPAN_OK;
}

/* The same for a picture with a medium of its own: its two paints. */
static celspan_status sample_media(cs_painter *painter, const cs_layer *layer,
                                   const cs_batch *batch, samples *out) {
  const cs_image_view *view;
  CS_TRY(cs_painter_image(painter, layer->index, &view));
  CS_TRY(sample(painter, &view->sampler, batch, out->s));
  CS_TRY(sample(painter, &view->medium, batch, out->rgba));
  code_samples(painter, &painter->stack->images[layer->index], batch->count, out->s);
  for (int32_t k = 0; k < batch->count; k++) {
    cs_paint paint = cs_paint_from_picture(out->rgba[k], CELSPAN_PICTURE_GEL);
    out->s[k][3] = 0;
    cs_v4_store(out->t[k], (cs_v4){paint.t[0], paint.t[1], paint.t[2], 0});
  }
  return CELSPAN_OK;
}

/* The same for pictures that are shown unchanged. */
static celspan_status sample_bare(cs_painter *painter, const cs_layer *layer, const cs_batch *batch,
                                  cs_samples *out) {
  const cs_image_view *view;
  cs_run run = {batch->x0, batch->x0 + batch->count, batch->y};
  CS_TRY(cs_painter_image(painter, layer->index, &view));
  if (!batch->columns)
    return cs_sampler_samples(painter->blocks, &view->sampler, run, out);
  out->are_planes = false;
  return sample_picture(painter, layer, batch, out->rgba);
}

/* ---------------------------------------------------------------- one over the other */

static celspan_status add_defocused(cs_painter *painter, cs_over_row *over, const cs_layer *layer,
                                    const cs_batch *batch, samples *room) {
  const cs_defocused *defocused = painter->stack->defocused[layer->index];
  cs_defocused_view *view = &painter->defocused[layer->index];
  CS_TRY(cs_defocused_move(defocused, painter->context, view, batch->y));
  const float(*rgba)[4] =
      batch->columns ? NULL : cs_defocused_samples(defocused, view, batch->x0, batch->count);
  if (rgba && layer->role == CS_LAYER_PAINT)
    return cs_over_row_add_samples(over, layer, CELSPAN_PICTURE_PAINT, rgba);
  const cs_defocused_places places = {batch->columns, batch->x0, batch->count};
  cs_defocused_paints(defocused, view, &places, room->s, room->t);
  return cs_over_row_add_paint(over, layer, (const float(*)[4])room->s, (const float(*)[4])room->t);
}

static celspan_status add_shade(cs_painter *painter, cs_over_row *over, const cs_layer *layer,
                                const cs_batch *batch) {
  double x[CS_OVER_ROW_BATCH];
  if (painter->stack->shades[layer->index].is_steady && layer->role == CS_LAYER_PAINT) {
    const cs_over_pair lit = cs_painter_lit_steady(painter, layer, batch->y);
    cs_over_row_add_lit(over, &lit);
    return CELSPAN_OK;
  }
  cs_batch_centres(batch, x);
  return cs_over_row_add_shade(over, layer, x, batch->y);
}

static celspan_status add_item(cs_painter *painter, cs_over_row *over,
                               const cs_procedure_span *procedure_spans, cs_item item,
                               const cs_batch *batch, samples *room) {
  const cs_stack *stack = painter->stack;
  const cs_layer *layer = &stack->layers[item.layer];
  if (layer->kind == CS_LAYER_FLAT) {
    cs_over_row_add_layer(over, layer);
    return CELSPAN_OK;
  }
  if (layer->kind == CS_LAYER_PICTURE && !stack->images[layer->index].texture->variation->medium) {
    CS_TRY(sample_picture(painter, layer, batch, room->rgba));
    return cs_over_row_add_samples(over, layer, stack->images[layer->index].texture->variation->use,
                                   (const float(*)[4])room->rgba);
  }
  if (layer->kind == CS_LAYER_DEFOCUSED)
    return add_defocused(painter, over, layer, batch, room);
  if (layer->kind == CS_LAYER_SHADED)
    return add_shade(painter, over, layer, batch);
  if (layer->kind == CS_LAYER_PICTURE)
    CS_TRY(sample_media(painter, layer, batch, room));
  else
    sample_procedure(&procedure_spans[item.procedure_span], batch, room);
  return cs_over_row_add_paint(over, layer, (const float(*)[4])room->s, (const float(*)[4])room->t);
}

static celspan_status fold_items(cs_painter *painter, const cs_program *program,
                                 const cs_batch *batch, float (*rgba)[4]) {
  celspan_context *context = painter->context;
  cs_arena *scratch = &painter->scratch;
  cs_over_row over;
  samples room;
  CS_TRY(cs_over_row_begin(context, scratch, painter->stack, painter->isa, batch->count, &over));
  for (uint32_t i = 0; i < program->length; i++) {
    CS_TRY(cs_over_row_move(&over, program->items[i].layer));
    CS_TRY(add_item(painter, &over, program->procedure_spans, program->items[i], batch, &room));
  }
  cs_over_row_end(&over, rgba);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pictures as they are */

bool cs_painter_is_bare(const cs_painter *painter, cs_item item) {
  const cs_stack *stack = painter->stack;
  const cs_layer *layer = &stack->layers[item.layer];
  return layer->kind == CS_LAYER_PICTURE && layer->role == CS_LAYER_PAINT &&
         !stack->images[layer->index].texture->variation->medium && layer->group == CS_STACK_NONE &&
         layer->fade == 1 && layer->front[0] == 1 && layer->front[1] == 1 && layer->front[2] == 1 &&
         (stack->light_count == 0 || stack->lights[0].below <= item.layer);
}

bool cs_painter_are_bare(const cs_painter *painter, const cs_program *program) {
  const cs_stack *stack = painter->stack;
  bool bare = program->length > 0 && stack->light_count <= 1;
  for (uint32_t i = 0; i < program->length && bare; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    bare = cs_painter_is_bare(painter, program->items[i]) &&
           stack->images[layer->index].space != CELSPAN_SPACE_SRGB &&
           stack->images[layer->index].texture->variation->use == CELSPAN_PICTURE_PAINT;
  }
  return bare;
}

/* Programs of pictures alone: each picture is sampled only where it shines through the pictures in
 * front of it. */
static celspan_status fold_bare(cs_painter *painter, const cs_program *program,
                                const cs_batch *batch, cs_over_bare *out) {
  const cs_over_bare_range *shown = &out->shown;
  cs_over_bare_begin(out, batch->count);
  for (uint32_t i = 0; shown->first < shown->end; i++) {
    const cs_layer *layer = &painter->stack->layers[program->items[i].layer];
    cs_batch part = {batch->columns ? batch->columns + shown->first : NULL,
                     batch->x0 + shown->first, shown->end - shown->first, batch->y};
    CS_TRY(sample_bare(painter, layer, &part, &out->last));
    if (i + 1 == program->length)
      break;
    cs_over_bare_add(painter->isa, out);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- batches */

/* Whether any pixels have been folded ahead: in many frames no program is folded so. */
static inline bool is_ahead(const cs_painter *painter) {
  return painter->ahead && painter->ahead->length > 0;
}

celspan_status cs_painter_batch_colours(cs_painter *painter, const cs_program *program,
                                        const cs_batch *batch, float (*rgba)[4]) {
  const cs_gradient_table *table;
  if (is_ahead(painter) && cs_over_channels_ready(painter, program, batch, rgba))
    return CELSPAN_OK;
  CS_TRY(cs_gradient_table_find(painter->gradients, program, &table));
  if (!table && cs_over_channels_colours(painter, program, batch, rgba))
    return CELSPAN_OK;
  painter->evaluations += (uint64_t)batch->count;
  if (table) {
    cs_gradient_table_colours(table, batch, rgba);
    return CELSPAN_OK;
  }
  cs_arena_reset(&painter->scratch);
  if (!cs_painter_are_bare(painter, program))
    return fold_items(painter, program, batch, rgba);
  cs_over_bare over;
  CS_TRY(fold_bare(painter, program, batch, &over));
  cs_over_bare_end(painter->isa, painter->stack, &over, rgba);
  return CELSPAN_OK;
}

celspan_status cs_painter_batch_codes(cs_painter *painter, const cs_program *program,
                                      const cs_batch *batch, unsigned char *codes) {
  if (cs_painter_are_bare(painter, program)) {
    cs_over_bare over;
    painter->evaluations += (uint64_t)batch->count;
    CS_TRY(fold_bare(painter, program, batch, &over));
    cs_over_bare_codes(painter->isa, painter->stack, &over, codes);
    return CELSPAN_OK;
  }
  if (cs_over_channels_codes(painter, program, batch, codes))
    return CELSPAN_OK;
  float rgba[CS_OVER_ROW_BATCH][4];
  CS_TRY(cs_painter_batch_colours(painter, program, batch, rgba));
  cs_srgb8_choose(painter->isa)(rgba[0], (size_t)batch->count, codes);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- runs */

celspan_status cs_painter_shown_colours(cs_painter *painter, const cs_program *program, cs_run run,
                                        float (*rgba)[4]) {
  for (int32_t x = run.x0; x < run.x1; x += CS_OVER_ROW_BATCH) {
    int32_t count = run.x1 - x < CS_OVER_ROW_BATCH ? run.x1 - x : CS_OVER_ROW_BATCH;
    cs_batch batch = {NULL, x, count, run.y};
    CS_TRY(cs_painter_batch_colours(painter, program, &batch, rgba + (x - run.x0)));
  }
  return CELSPAN_OK;
}

/* Pixels coded while they are in the cache. */
static celspan_status run_codes(cs_painter *painter, const cs_program *program, cs_run run,
                                cs_row *row) {
  unsigned char *codes;
  CS_TRY(cs_row_codes(painter->context, row, run.x0, run.x1, &codes));
  for (int32_t x = run.x0; x < run.x1; x += CS_OVER_ROW_BATCH) {
    int32_t count = run.x1 - x < CS_OVER_ROW_BATCH ? run.x1 - x : CS_OVER_ROW_BATCH;
    cs_batch batch = {NULL, x, count, run.y};
    CS_TRY(cs_painter_batch_codes(painter, program, &batch, codes + 4 * (size_t)(x - run.x0)));
  }
  return CELSPAN_OK;
}

celspan_status cs_painter_pixels(cs_painter *painter, const cs_program *program, cs_run run,
                                 cs_row *row) {
  float *colours;
  if (row->takes_codes && painter->stack->space != CELSPAN_SPACE_SRGB)
    return run_codes(painter, program, run, row);
  CS_TRY(cs_row_array(painter->context, row, run.x0, run.x1, &colours));
  return cs_painter_shown_colours(painter, program, run, (float(*)[4])colours);
}

/* Finds the visible items from run.x0 on: in as many strides of the run as show the same items, or
 * in one stride where this is not known. *end: the column after these strides. */
static celspan_status find_shown(cs_painter *painter, cs_shown_kept *kept, cs_run run,
                                 int32_t *end) {
  int32_t stride = kept->stride, left = run.x0 / stride * stride;
  if (run.x1 - left > stride) {
    *end = (run.x1 + stride - 1) / stride * stride;
    CS_TRY(cs_shown_again(painter, kept, cs_run_between(run, left, *end)));
    if (kept->shown.is_sure)
      return CELSPAN_OK;
  }
  *end = left + stride;
  return cs_shown_again(painter, kept, cs_run_between(run, left, *end));
}

celspan_status cs_painter_program_colours(cs_painter *painter, const cs_program *program,
                                          cs_run run, float (*rgba)[4]) {
  if (!cs_shown_varies(painter->stack, program))
    return cs_painter_shown_colours(painter, program, run, rgba);
  cs_shown_kept *kept;
  CS_TRY(cs_shown_keep(painter, program, &kept));
  for (int32_t x = run.x0, end; x < run.x1; rgba += end - x, x = end) {
    CS_TRY(find_shown(painter, kept, cs_run_between(run, x, run.x1), &end));
    end = end < run.x1 ? end : run.x1;
    const cs_program visible = {kept->shown.items, program->procedure_spans, kept->shown.length};
    CS_TRY(cs_painter_shown_colours(painter, &visible, cs_run_between(run, x, end), rgba));
  }
  return CELSPAN_OK;
}

void cs_painter_ahead(cs_painter *painter, const cs_cell *cell, cs_run run) {
  const cs_program program = cs_composer_program(painter->composer, cell);
  if (painter->ahead)
    cs_over_channels_prepare(painter, &program, run);
}

celspan_status cs_painter_colours(cs_painter *painter, const cs_cell *cell, cs_run run,
                                  float (*rgba)[4]) {
  if (cell->length > 0) {
    cs_program program = cs_composer_program(painter->composer, cell);
    return cs_painter_program_colours(painter, &program, run, rgba);
  }
  for (int32_t x = run.x0; x < run.x1; x++)
    cs_v4_store(rgba[x - run.x0], cell->colour);
  return CELSPAN_OK;
}
