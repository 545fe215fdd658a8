/* From a cell's program to spans: samples of the leaves that vary, folded at every pixel where a
 * picture shows in them, else at as few columns as a piecewise linear row needs (ramps.c).
 */
#include "compose/composer.h"

#include "base/number.h"
#include "colour/srgb8.h"
#include "paint/defocused_run.h"
#include "paint/gradient_table.h"
#include "paint/lines.h"
#include "paint/over_row.h"
#include "paint/shade.h"

#include <math.h>

/* ---------------------------------------------------------------- samples */

celspan_status cs_composer_image(cs_composer *composer, uint32_t detail,
                                 const cs_image_view **out) {
  cs_image_view *seen = &composer->images[detail];
  *out = seen;
  if (seen->is_ready)
    return CELSPAN_OK;
  const cs_image_layer *image = &composer->stack->images[detail];
  const celspan_texture *texture = image->texture;
  celspan_picture_info info;
  CS_TRY(cs_picture_info(composer->context, texture->picture, &info));
  const celspan_box *box = &image->box;
  celspan_matrix to_picture = {{info.width / box->width, 0, -box->x * info.width / box->width, 0,
                                info.height / box->height, -box->y * info.height / box->height, 0,
                                0, 1}};
  seen->sampler = (cs_sampler){.picture = texture->picture,
                               .inverse = celspan_matrix_then(image->inverse, to_picture),
                               .width = info.width,
                               .height = info.height,
                               .sampling = texture->sampling,
                               .wrap = image->wrap,
                               .isa = composer->isa};
  cs_sampler_prepare(&seen->sampler);
  seen->is_opaque =
      !info.has_alpha && texture->use == CELSPAN_PICTURE_PAINT && image->wrap != CELSPAN_WRAP_CLEAR;
  seen->is_ready = true;
  return CELSPAN_OK;
}

/* The paint of a strip at x: one is flat, two or more are evenly spaced over it. */
static cs_paint strip_paint(const cs_procedure_span *procedure_span, double x) {
  if (procedure_span->paint_count == 1)
    return procedure_span->paints[0];
  double last = (double)(procedure_span->paint_count - 1);
  double at =
      cs_number_clamp((x - procedure_span->x0) / (procedure_span->x1 - procedure_span->x0), 0, 1) *
      last;
  size_t i = (size_t)cs_number_clamp(floor(at), 0, last - 1);
  return cs_paint_mix(&procedure_span->paints[i], &procedure_span->paints[i + 1],
                      (float)(at - (double)i));
}

/* Pixels of one row, ascending: `count` from x0 on, or those listed. */
typedef struct batch {
  const int32_t *columns; /* or NULL */
  int32_t x0, count;
  double y;
} batch;

static double centre(const batch *b, int32_t k) {
  return (b->columns ? b->columns[k] : b->x0 + k) + 0.5;
}

/* What leaves that vary paint in a batch of pixels. */
typedef struct samples {
  float rgba[CS_OVER_ROW_BATCH][4];                       /* pictures */
  float s[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4]; /* all others; s is not lit */
} samples;

static void shade_samples(const cs_shade *shade, const batch *b, samples *out) {
  for (int32_t k = 0; k < b->count; k++) {
    cs_shade_lanes paint = cs_shade_paint(shade, centre(b, k), b->y);
    cs_v4_store(out->s[k], paint.s);
    cs_v4_store(out->t[k], paint.t);
  }
}

static void strip_samples(const cs_procedure_span *procedure_span, const batch *b, samples *out) {
  for (int32_t k = 0; k < b->count; k++) {
    cs_paint paint = strip_paint(procedure_span, centre(b, k));
    cs_v4_store(out->s[k], (cs_v4){paint.s[0], paint.s[1], paint.s[2], 0});
    cs_v4_store(out->t[k], (cs_v4){paint.t[0], paint.t[1], paint.t[2], 0});
  }
}

static celspan_status sample_picture(cs_composer *composer, const cs_layer *layer, const batch *b,
                                     float (*rgba)[4]) {
  const cs_image_view *image;
  CS_TRY(cs_composer_image(composer, layer->detail, &image));
  return b->columns
             ? cs_sampler_at(composer->texels, &image->sampler, b->columns, b->count, b->y, rgba)
             : cs_sampler_run(composer->texels, &image->sampler, b->x0, b->count, b->y, rgba);
}

static celspan_status blend_picture(cs_composer *composer, cs_over_row *blend,
                                    const cs_layer *layer, const batch *b, samples *room) {
  CS_TRY(sample_picture(composer, layer, b, room->rgba));
  cs_over_row_picture(blend, layer, composer->stack->images[layer->detail].texture->use,
                      (const float(*)[4])room->rgba);
  return CELSPAN_OK;
}

static celspan_status blend_soft(cs_composer *composer, cs_over_row *blend, const cs_layer *layer,
                                 const batch *b, samples *room) {
  const cs_defocused *soft = composer->stack->defocused[layer->detail];
  cs_defocused_view *seen = &composer->defocused[layer->detail];
  CS_TRY(cs_defocused_stand(soft, composer->context, seen, b->y));
  size_t piece = 0;
  for (int32_t k = 0; k < b->count; k++) {
    cs_v4 s, t;
    cs_defocused_paint(soft, seen, centre(b, k), &piece, &s, &t);
    cs_v4_store(room->s[k], s);
    cs_v4_store(room->t[k], t);
  }
  cs_over_row_paints(blend, layer, (const float(*)[4])room->s, (const float(*)[4])room->t);
  return CELSPAN_OK;
}

static celspan_status blend_item(cs_composer *composer, cs_over_row *blend,
                                 const cs_procedure_span *procedure_spans, cs_item item,
                                 const batch *b, samples *room) {
  const cs_stack *stack = composer->stack;
  const cs_layer *layer = &stack->layers[item.layer];
  if (layer->kind == CS_LAYER_FLAT) {
    cs_over_row_flat(blend, layer);
    return CELSPAN_OK;
  }
  if (layer->kind == CS_LAYER_PICTURE)
    return blend_picture(composer, blend, layer, b, room);
  if (layer->kind == CS_LAYER_DEFOCUSED)
    return blend_soft(composer, blend, layer, b, room);
  if (layer->kind == CS_LAYER_SHADED)
    shade_samples(&stack->shades[layer->detail], b, room);
  else
    strip_samples(&procedure_spans[item.procedure_span], b, room);
  cs_over_row_paints(blend, layer, (const float(*)[4])room->s, (const float(*)[4])room->t);
  return CELSPAN_OK;
}

/* Whether a picture's samples pass through its leaf unchanged: no light but white is on it. */
static bool is_bare(const cs_layer *layer) {
  return layer->kind == CS_LAYER_PICTURE && layer->group == CS_STACK_NONE && layer->fade == 1 &&
         layer->front[0] == 1 && layer->front[1] == 1 && layer->front[2] == 1;
}

/* Whether the item is reached before any back light is met. */
static bool is_before_lights(const cs_stack *stack, cs_item item) {
  return stack->light_count == 0 || stack->lights[0].below <= item.layer;
}

static bool is_all_bare(const cs_stack *stack, const cs_program *program) {
  bool bare = program->length > 0 && stack->light_count <= 1;
  for (uint32_t i = 0; i < program->length && bare; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    bare = is_bare(layer) && stack->images[layer->detail].texture->use == CELSPAN_PICTURE_PAINT &&
           is_before_lights(stack, program->items[i]);
  }
  return bare;
}

/* Pictures alone: of each only the pixels are sampled that shine through those before it. */
static celspan_status fold_bare(cs_composer *composer, const cs_program *program, const batch *b,
                                cs_over_row_layers *out) {
  cs_over_row_part *shown = &out->part;
  uint32_t i = 0;
  *shown = (cs_over_row_part){0, b->count};
  out->count = b->count;
  while (shown->first < shown->end) {
    const cs_layer *layer = &composer->stack->layers[program->items[i].layer];
    batch part = {b->columns ? b->columns + shown->first : NULL, b->x0 + shown->first,
                  shown->end - shown->first, b->y};
    CS_TRY(sample_picture(composer, layer, &part, out->rgba + shown->first));
    if (i + 1 == program->length)
      break;
    *shown =
        cs_over_row_bare(composer->isa, i == 0, (const float(*)[4])out->rgba, *shown, out->folded);
    i++;
  }
  out->is_first = i == 0;
  return CELSPAN_OK;
}

static celspan_status colours_batch(cs_composer *composer, const cs_program *program,
                                    const batch *b, float (*rgba)[4]) {
  celspan_context *context = composer->context;
  cs_arena *scratch = &composer->scratch;
  cs_over_row blend;
  const cs_gradient_table *palette;
  composer->evaluations += (uint64_t)b->count;
  CS_TRY(cs_gradient_table_find(composer, program, &palette));
  if (palette) {
    for (int32_t k = 0; k < b->count; k++)
      cs_v4_store(rgba[k], cs_gradient_table_colour(palette, centre(b, k), b->y));
    return CELSPAN_OK;
  }
  cs_arena_reset(scratch);
  if (is_all_bare(composer->stack, program)) {
    cs_over_row_layers layers;
    CS_TRY(fold_bare(composer, program, b, &layers));
    cs_over_row_bare_end(composer->isa, composer->stack, &layers, rgba);
    return CELSPAN_OK;
  }
  samples *room = cs_arena_take(context, scratch, sizeof *room);
  if (!room)
    return CELSPAN_NO_MEMORY;
  CS_TRY(cs_over_row_begin(context, scratch, composer->stack, composer->isa, b->count, &blend));
  for (uint32_t i = 0; i < program->length; i++) {
    CS_TRY(cs_over_row_reach(context, scratch, &blend, program->items[i].layer));
    CS_TRY(blend_item(composer, &blend, program->procedure_spans, program->items[i], b, room));
  }
  cs_over_row_end(&blend, rgba);
  return CELSPAN_OK;
}

celspan_status cs_composer_program_colours(cs_composer *composer, const cs_program *program,
                                           int32_t x0, int32_t x1, double y, float (*rgba)[4]) {
  for (int32_t x = x0; x < x1; x += CS_OVER_ROW_BATCH) {
    int32_t count = x1 - x < CS_OVER_ROW_BATCH ? x1 - x : CS_OVER_ROW_BATCH;
    CS_TRY(colours_batch(composer, program, &(batch){NULL, x, count, y}, rgba + (x - x0)));
  }
  return CELSPAN_OK;
}

celspan_status cs_composer_colours_at(cs_composer *composer, const cs_program *program,
                                      const int32_t *columns, int32_t count, double y,
                                      float (*rgba)[4]) {
  return colours_batch(composer, program, &(batch){columns, 0, count, y}, rgba);
}

cs_program cs_composer_program(const cs_composer *composer, const cs_cell *cell) {
  return (cs_program){&composer->items[cell->program], composer->procedure_spans, cell->length};
}

celspan_status cs_composer_colours(cs_composer *composer, const cs_cell *cell, int32_t x0,
                                   int32_t x1, double y, float (*rgba)[4]) {
  if (cell->length > 0) {
    cs_program program = cs_composer_program(composer, cell);
    return cs_composer_program_colours(composer, &program, x0, x1, y, rgba);
  }
  for (int32_t x = x0; x < x1; x++)
    cs_v4_store(rgba[x - x0], cell->colour);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- runs of one program */

/* Whether a picture of the program shows pixel by pixel. */
static celspan_status needs_array(cs_composer *composer, const cs_program *program, bool *out) {
  *out = false;
  for (uint32_t i = 0; i < program->length && !*out; i++) {
    const cs_layer *layer = &composer->stack->layers[program->items[i].layer];
    const cs_image_view *image;
    if (layer->kind != CS_LAYER_PICTURE)
      continue;
    CS_TRY(cs_composer_image(composer, layer->detail, &image));
    *out = !cs_sampler_is_grid(&image->sampler);
  }
  return CELSPAN_OK;
}

/* What shows over some columns: the items of a program without those that are clear there, up to
 * the first that is opaque. */
typedef struct segment {
  uint32_t end;      /* of the items */
  uint64_t left_out; /* a bit each, of the first 64 */
  bool ends_opaque, is_sure;
} segment;

#define STEPS 8 /* looked at at once, in the hope of one answer */

/* Whether all that shows is one opaque picture, texel by pixel. */
static bool is_copy(const cs_composer *composer, const cs_program *shown, bool ends_opaque) {
  if (!ends_opaque || shown->length != 1)
    return false;
  const cs_stack *stack = composer->stack;
  const cs_layer *layer = &stack->layers[shown->items[0].layer];
  return is_bare(layer) && is_before_lights(stack, shown->items[0]) &&
         composer->images[layer->detail].sampler.way == CS_SAMPLER_COPY;
}

static celspan_status run_copy(cs_composer *composer, const cs_program *shown, int32_t x0,
                               int32_t x1, double y, cs_row *row) {
  const cs_layer *layer = &composer->stack->layers[shown->items[0].layer];
  unsigned char *codes;
  CS_TRY(cs_row_codes(composer->context, row, x0, x1, &codes));
  return cs_sampler_codes(composer->texels, &composer->images[layer->detail].sampler, x0, x1 - x0,
                          y, codes);
}

static celspan_status codes_batch(cs_composer *composer, const cs_program *shown, const batch *b,
                                  unsigned char *codes) {
  if (is_all_bare(composer->stack, shown)) {
    cs_over_row_layers layers;
    composer->evaluations += (uint64_t)b->count;
    CS_TRY(fold_bare(composer, shown, b, &layers));
    cs_over_row_bare_codes(composer->isa, composer->stack, &layers, codes);
    return CELSPAN_OK;
  }
  float rgba[CS_OVER_ROW_BATCH][4];
  CS_TRY(colours_batch(composer, shown, b, rgba));
  cs_srgb8_choose(composer->isa)(rgba[0], (size_t)b->count, codes);
  return CELSPAN_OK;
}

/* Pixels coded while they are in the cache. */
static celspan_status run_codes(cs_composer *composer, const cs_program *shown, int32_t x0,
                                int32_t x1, double y, cs_row *row) {
  unsigned char *codes;
  CS_TRY(cs_row_codes(composer->context, row, x0, x1, &codes));
  for (int32_t x = x0; x < x1; x += CS_OVER_ROW_BATCH) {
    int32_t count = x1 - x < CS_OVER_ROW_BATCH ? x1 - x : CS_OVER_ROW_BATCH;
    CS_TRY(codes_batch(composer, shown, &(batch){NULL, x, count, y}, codes + 4 * (size_t)(x - x0)));
  }
  return CELSPAN_OK;
}

/* A program of what shows, and nothing else. */
static celspan_status run_shown(cs_composer *composer, const cs_program *shown, bool ends_opaque,
                                int32_t x0, int32_t x1, double y, cs_row *row) {
  bool is_array;
  float *colours;
  uint32_t item;
  if (row->takes_codes && is_copy(composer, shown, ends_opaque))
    return run_copy(composer, shown, x0, x1, y, row);
  if (cs_defocused_run_fits(composer, shown, &item))
    return cs_defocused_run(composer, shown, item, x0, x1, y, row);
  CS_TRY(needs_array(composer, shown, &is_array));
  if (!is_array)
    return cs_lines_run(composer, shown, x0, x1, y, row);
  if (row->takes_codes)
    return run_codes(composer, shown, x0, x1, y, row);
  CS_TRY(cs_row_array(composer->context, row, x0, x1, &colours));
  return cs_composer_program_colours(composer, shown, x0, x1, y, (float(*)[4])colours);
}

/* ---------------------------------------------------------------- runs cut into segments */

/* What samples of an item have in common that lets it, or all behind it, be left out. */
static celspan_status look_at_item(cs_composer *composer, uint32_t index, int32_t x0, int32_t x1,
                                   double y, cs_picture_opacity *out) {
  const cs_layer *layer = &composer->stack->layers[index];
  const cs_image_view *image;
  *out = CS_PICTURE_MIXED;
  if (layer->kind != CS_LAYER_PICTURE || layer->fade != 1 || layer->group != CS_STACK_NONE)
    return CELSPAN_OK;
  CS_TRY(cs_composer_image(composer, layer->detail, &image));
  if (image->is_opaque) {
    *out = CS_PICTURE_OPAQUE;
    return CELSPAN_OK;
  }
  CS_TRY(cs_sampler_look(composer->texels, &image->sampler, x0, x1, y, out));
  if (*out == CS_PICTURE_OPAQUE &&
      composer->stack->images[layer->detail].texture->use == CELSPAN_PICTURE_GEL)
    *out = CS_PICTURE_MIXED;
  return CELSPAN_OK;
}

/* What shows over the `step` columns around x; out->is_sure: and over each part of them. */
static celspan_status cut_segment(cs_composer *composer, const cs_program *program, int32_t step,
                                  int32_t x, double y, segment *out) {
  int32_t left = x / step * step;
  *out = (segment){.end = program->length, .is_sure = true};
  for (uint32_t i = 0; i < program->length && i < 64; i++) {
    cs_picture_opacity look;
    CS_TRY(look_at_item(composer, program->items[i].layer, left, left + step, y, &look));
    if (look == CS_PICTURE_MIXED)
      out->is_sure = false;
    if (look == CS_PICTURE_CLEAR)
      out->left_out |= (uint64_t)1 << i;
    if (look != CS_PICTURE_OPAQUE)
      continue;
    out->ends_opaque = true;
    out->end = i + 1;
    break;
  }
  return CELSPAN_OK;
}

/* What shows from x on, and where that is told up to: many steps at once, if the run covers them
 * and they have one answer, as they mostly have. */
static celspan_status cut_next(cs_composer *composer, const cs_program *program, int32_t step,
                               int32_t x, int32_t x1, double y, segment *out, int64_t *end) {
  int64_t many = (int64_t)STEPS * step;
  if (x % many == 0 && x + many <= x1) {
    *end = x + many;
    CS_TRY(cut_segment(composer, program, (int32_t)many, x, y, out));
    if (out->is_sure)
      return CELSPAN_OK;
  }
  *end = ((int64_t)x / step + 1) * step;
  return cut_segment(composer, program, step, x, y, out);
}

static bool is_same_segment(const segment *a, const segment *b) {
  return a->end == b->end && a->left_out == b->left_out && a->ends_opaque == b->ends_opaque;
}

static celspan_status run_segment(cs_composer *composer, const cs_program *program,
                                  const segment *part, int32_t x0, int32_t x1, double y,
                                  cs_row *row) {
  cs_program shown = {program->items, program->procedure_spans, part->end};
  if (x1 <= x0)
    return CELSPAN_OK;
  if (part->left_out) {
    cs_item *items = cs_arena_take(composer->context, &row->colours, part->end * sizeof *items);
    if (!items)
      return CELSPAN_NO_MEMORY;
    shown = (cs_program){items, program->procedure_spans, 0};
    for (uint32_t i = 0; i < part->end; i++)
      if (i >= 64 || !(part->left_out >> i & 1))
        items[shown.length++] = program->items[i];
  }
  return run_shown(composer, &shown, part->ends_opaque, x0, x1, y, row);
}

static bool has_picture(const cs_composer *composer, const cs_program *program) {
  for (uint32_t i = 0; i < program->length; i++)
    if (composer->stack->layers[program->items[i].layer].kind == CS_LAYER_PICTURE)
      return true;
  return false;
}

/* Columns looked at at a time, from the left edge of the frame on, since what is known of them must
 * not depend on where a run begins: those of the picture that asks for fewest. */
static celspan_status find_step(cs_composer *composer, const cs_program *program, int32_t *out) {
  *out = INT32_MAX;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &composer->stack->layers[program->items[i].layer];
    const cs_image_view *image;
    if (layer->kind != CS_LAYER_PICTURE)
      continue;
    CS_TRY(cs_composer_image(composer, layer->detail, &image));
    if (!image->is_opaque && image->sampler.look_columns < *out)
      *out = image->sampler.look_columns;
  }
  return CELSPAN_OK;
}

celspan_status cs_composer_run_program(cs_composer *composer, const cs_program *program, int32_t x0,
                                       int32_t x1, double y, cs_row *row) {
  segment current, next;
  int32_t begun = x0, step;
  int64_t end;
  if (x1 <= x0)
    return CELSPAN_OK;
  if (!has_picture(composer, program))
    return run_shown(composer, program, false, x0, x1, y, row);
  CS_TRY(find_step(composer, program, &step));
  CS_TRY(cut_next(composer, program, step, x0, x1, y, &current, &end));
  while (end < x1) {
    int32_t x = (int32_t)end;
    CS_TRY(cut_next(composer, program, step, x, x1, y, &next, &end));
    if (is_same_segment(&current, &next))
      continue;
    CS_TRY(run_segment(composer, program, &current, begun, x, y, row));
    begun = x;
    current = next;
  }
  return run_segment(composer, program, &current, begun, x1, y, row);
}

celspan_status cs_composer_run(cs_composer *composer, const cs_cell *cell, int32_t x0, int32_t x1,
                               double y, cs_row *row) {
  if (cell->length == 0)
    return cs_row_single(composer->context, row, x0, x1, cell->colour);
  cs_program program = cs_composer_program(composer, cell);
  return cs_composer_run_program(composer, &program, x0, x1, y, row);
}
