/* From a cell's program to spans: samples of the leaves that vary, folded at every pixel where a
 * picture shows in them, else at as few columns as a piecewise linear row needs (ramps.c).
 */
#include "compose/composer.h"

#include "base/number.h"
#include "colour/srgb8.h"
#include "compose/blend.h"
#include "compose/palette.h"
#include "compose/ramps.h"
#include "compose/shade.h"
#include "compose/soft_run.h"

#include <math.h>

/* ---------------------------------------------------------------- samples */

celspan_status cs_composer_slide(cs_composer *composer, uint32_t detail,
                                 const cs_seen_slide **out) {
  cs_seen_slide *seen = &composer->slides[detail];
  *out = seen;
  if (seen->is_ready)
    return CELSPAN_OK;
  const cs_slide *slide = &composer->stack->slides[detail];
  const celspan_texture *texture = slide->texture;
  celspan_picture_info info;
  CS_TRY(cs_picture_info(composer->context, texture->picture, &info));
  const celspan_box *box = &slide->box;
  celspan_matrix to_picture = {{info.width / box->width, 0, -box->x * info.width / box->width, 0,
                                info.height / box->height, -box->y * info.height / box->height, 0,
                                0, 1}};
  seen->sampler = (cs_sampler){.picture = texture->picture,
                               .inverse = celspan_matrix_then(slide->inverse, to_picture),
                               .width = info.width,
                               .height = info.height,
                               .sampling = texture->sampling,
                               .wrap = slide->wrap,
                               .isa = composer->isa};
  cs_sampler_prepare(&seen->sampler);
  seen->is_opaque =
      !info.has_alpha && texture->use == CELSPAN_PICTURE_PAINT && slide->wrap != CELSPAN_WRAP_CLEAR;
  seen->is_ready = true;
  return CELSPAN_OK;
}

/* The paint of a strip at x: one is flat, two or more are evenly spaced over it. */
static cs_paint strip_paint(const cs_strip *strip, double x) {
  if (strip->paint_count == 1)
    return strip->paints[0];
  double last = (double)(strip->paint_count - 1);
  double at = cs_number_clamp((x - strip->x0) / (strip->x1 - strip->x0), 0, 1) * last;
  size_t i = (size_t)cs_number_clamp(floor(at), 0, last - 1);
  return cs_paint_mix(&strip->paints[i], &strip->paints[i + 1], (float)(at - (double)i));
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
  float rgba[CS_BLEND_BATCH][4];                    /* pictures */
  float s[CS_BLEND_BATCH][4], t[CS_BLEND_BATCH][4]; /* all others; s is not lit */
} samples;

static void shade_samples(const cs_shade *shade, const batch *b, samples *out) {
  for (int32_t k = 0; k < b->count; k++) {
    cs_shade_lanes paint = cs_shade_paint(shade, centre(b, k), b->y);
    cs_v4_store(out->s[k], paint.s);
    cs_v4_store(out->t[k], paint.t);
  }
}

static void strip_samples(const cs_strip *strip, const batch *b, samples *out) {
  for (int32_t k = 0; k < b->count; k++) {
    cs_paint paint = strip_paint(strip, centre(b, k));
    cs_v4_store(out->s[k], (cs_v4){paint.s[0], paint.s[1], paint.s[2], 0});
    cs_v4_store(out->t[k], (cs_v4){paint.t[0], paint.t[1], paint.t[2], 0});
  }
}

static celspan_status sample_picture(cs_composer *composer, const cs_leaf *leaf, const batch *b,
                                     float (*rgba)[4]) {
  const cs_seen_slide *slide;
  CS_TRY(cs_composer_slide(composer, leaf->detail, &slide));
  return b->columns
             ? cs_sampler_at(composer->texels, &slide->sampler, b->columns, b->count, b->y, rgba)
             : cs_sampler_run(composer->texels, &slide->sampler, b->x0, b->count, b->y, rgba);
}

static celspan_status blend_picture(cs_composer *composer, cs_blend *blend, const cs_leaf *leaf,
                                    const batch *b, samples *room) {
  CS_TRY(sample_picture(composer, leaf, b, room->rgba));
  cs_blend_picture(blend, leaf, composer->stack->slides[leaf->detail].texture->use,
                   (const float(*)[4])room->rgba);
  return CELSPAN_OK;
}

static celspan_status blend_soft(cs_composer *composer, cs_blend *blend, const cs_leaf *leaf,
                                 const batch *b, samples *room) {
  const cs_soft *soft = composer->stack->softs[leaf->detail];
  cs_seen_soft *seen = &composer->softs[leaf->detail];
  CS_TRY(cs_soft_stand(soft, composer->context, seen, b->y));
  size_t piece = 0;
  for (int32_t k = 0; k < b->count; k++) {
    cs_v4 s, t;
    cs_soft_paint(soft, seen, centre(b, k), &piece, &s, &t);
    cs_v4_store(room->s[k], s);
    cs_v4_store(room->t[k], t);
  }
  cs_blend_paints(blend, leaf, (const float(*)[4])room->s, (const float(*)[4])room->t);
  return CELSPAN_OK;
}

static celspan_status blend_item(cs_composer *composer, cs_blend *blend, const cs_strip *strips,
                                 cs_item item, const batch *b, samples *room) {
  const cs_stack *stack = composer->stack;
  const cs_leaf *leaf = &stack->leaves[item.leaf];
  if (leaf->kind == CS_LEAF_FLAT) {
    cs_blend_flat(blend, leaf);
    return CELSPAN_OK;
  }
  if (leaf->kind == CS_LEAF_PICTURE)
    return blend_picture(composer, blend, leaf, b, room);
  if (leaf->kind == CS_LEAF_SOFT)
    return blend_soft(composer, blend, leaf, b, room);
  if (leaf->kind == CS_LEAF_SHADED)
    shade_samples(&stack->shades[leaf->detail], b, room);
  else
    strip_samples(&strips[item.strip], b, room);
  cs_blend_paints(blend, leaf, (const float(*)[4])room->s, (const float(*)[4])room->t);
  return CELSPAN_OK;
}

/* Whether a picture's samples pass through its leaf unchanged: no light but white is on it. */
static bool is_bare(const cs_leaf *leaf) {
  return leaf->kind == CS_LEAF_PICTURE && leaf->group == CS_STACK_NONE && leaf->fade == 1 &&
         leaf->front[0] == 1 && leaf->front[1] == 1 && leaf->front[2] == 1;
}

/* Whether the item is reached before any back light is met. */
static bool is_before_lights(const cs_stack *stack, cs_item item) {
  return stack->light_count == 0 || stack->lights[0].below <= item.leaf;
}

static bool is_all_bare(const cs_stack *stack, const cs_program *program) {
  bool bare = program->length > 0 && stack->light_count <= 1;
  for (uint32_t i = 0; i < program->length && bare; i++) {
    const cs_leaf *leaf = &stack->leaves[program->items[i].leaf];
    bare = is_bare(leaf) && stack->slides[leaf->detail].texture->use == CELSPAN_PICTURE_PAINT &&
           is_before_lights(stack, program->items[i]);
  }
  return bare;
}

/* Pictures alone: of each only the pixels are sampled that shine through those before it. */
static celspan_status fold_bare(cs_composer *composer, const cs_program *program, const batch *b,
                                cs_blend_layers *out) {
  cs_blend_part *shown = &out->part;
  uint32_t i = 0;
  *shown = (cs_blend_part){0, b->count};
  out->count = b->count;
  while (shown->first < shown->end) {
    const cs_leaf *leaf = &composer->stack->leaves[program->items[i].leaf];
    batch part = {b->columns ? b->columns + shown->first : NULL, b->x0 + shown->first,
                  shown->end - shown->first, b->y};
    CS_TRY(sample_picture(composer, leaf, &part, out->rgba + shown->first));
    if (i + 1 == program->length)
      break;
    *shown =
        cs_blend_bare(composer->isa, i == 0, (const float(*)[4])out->rgba, *shown, out->folded);
    i++;
  }
  out->is_first = i == 0;
  return CELSPAN_OK;
}

static celspan_status colours_batch(cs_composer *composer, const cs_program *program,
                                    const batch *b, float (*rgba)[4]) {
  celspan_context *context = composer->context;
  cs_arena *scratch = &composer->scratch;
  cs_blend blend;
  const cs_palette *palette;
  composer->evaluations += (uint64_t)b->count;
  CS_TRY(cs_palette_find(composer, program, &palette));
  if (palette) {
    for (int32_t k = 0; k < b->count; k++)
      cs_v4_store(rgba[k], cs_palette_colour(palette, centre(b, k), b->y));
    return CELSPAN_OK;
  }
  cs_arena_reset(scratch);
  if (is_all_bare(composer->stack, program)) {
    cs_blend_layers layers;
    CS_TRY(fold_bare(composer, program, b, &layers));
    cs_blend_bare_end(composer->isa, composer->stack, &layers, rgba);
    return CELSPAN_OK;
  }
  samples *room = cs_arena_take(context, scratch, sizeof *room);
  if (!room)
    return CELSPAN_NO_MEMORY;
  CS_TRY(cs_blend_begin(context, scratch, composer->stack, composer->isa, b->count, &blend));
  for (uint32_t i = 0; i < program->length; i++) {
    CS_TRY(cs_blend_reach(context, scratch, &blend, program->items[i].leaf));
    CS_TRY(blend_item(composer, &blend, program->strips, program->items[i], b, room));
  }
  cs_blend_end(&blend, rgba);
  return CELSPAN_OK;
}

celspan_status cs_composer_program_colours(cs_composer *composer, const cs_program *program,
                                           int32_t x0, int32_t x1, double y, float (*rgba)[4]) {
  for (int32_t x = x0; x < x1; x += CS_BLEND_BATCH) {
    int32_t count = x1 - x < CS_BLEND_BATCH ? x1 - x : CS_BLEND_BATCH;
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
  return (cs_program){&composer->items[cell->program], composer->strips, cell->length};
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
    const cs_leaf *leaf = &composer->stack->leaves[program->items[i].leaf];
    const cs_seen_slide *slide;
    if (leaf->kind != CS_LEAF_PICTURE)
      continue;
    CS_TRY(cs_composer_slide(composer, leaf->detail, &slide));
    *out = !cs_sampler_is_grid(&slide->sampler);
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
  const cs_leaf *leaf = &stack->leaves[shown->items[0].leaf];
  return is_bare(leaf) && is_before_lights(stack, shown->items[0]) &&
         composer->slides[leaf->detail].sampler.way == CS_SAMPLER_COPY;
}

static celspan_status run_copy(cs_composer *composer, const cs_program *shown, int32_t x0,
                               int32_t x1, double y, cs_row *row) {
  const cs_leaf *leaf = &composer->stack->leaves[shown->items[0].leaf];
  unsigned char *codes;
  CS_TRY(cs_row_codes(composer->context, row, x0, x1, &codes));
  return cs_sampler_codes(composer->texels, &composer->slides[leaf->detail].sampler, x0, x1 - x0, y,
                          codes);
}

static celspan_status codes_batch(cs_composer *composer, const cs_program *shown, const batch *b,
                                  unsigned char *codes) {
  if (is_all_bare(composer->stack, shown)) {
    cs_blend_layers layers;
    composer->evaluations += (uint64_t)b->count;
    CS_TRY(fold_bare(composer, shown, b, &layers));
    cs_blend_bare_codes(composer->isa, composer->stack, &layers, codes);
    return CELSPAN_OK;
  }
  float rgba[CS_BLEND_BATCH][4];
  CS_TRY(colours_batch(composer, shown, b, rgba));
  cs_srgb8_choose(composer->isa)(rgba[0], (size_t)b->count, codes);
  return CELSPAN_OK;
}

/* Pixels coded while they are in the cache. */
static celspan_status run_codes(cs_composer *composer, const cs_program *shown, int32_t x0,
                                int32_t x1, double y, cs_row *row) {
  unsigned char *codes;
  CS_TRY(cs_row_codes(composer->context, row, x0, x1, &codes));
  for (int32_t x = x0; x < x1; x += CS_BLEND_BATCH) {
    int32_t count = x1 - x < CS_BLEND_BATCH ? x1 - x : CS_BLEND_BATCH;
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
  if (cs_soft_run_fits(composer, shown, &item))
    return cs_soft_run(composer, shown, item, x0, x1, y, row);
  CS_TRY(needs_array(composer, shown, &is_array));
  if (!is_array)
    return cs_ramps_run(composer, shown, x0, x1, y, row);
  if (row->takes_codes)
    return run_codes(composer, shown, x0, x1, y, row);
  CS_TRY(cs_row_array(composer->context, row, x0, x1, &colours));
  return cs_composer_program_colours(composer, shown, x0, x1, y, (float(*)[4])colours);
}

/* ---------------------------------------------------------------- runs cut into segments */

/* What samples of an item have in common that lets it, or all behind it, be left out. */
static celspan_status look_at_item(cs_composer *composer, uint32_t index, int32_t x0, int32_t x1,
                                   double y, cs_picture_look *out) {
  const cs_leaf *leaf = &composer->stack->leaves[index];
  const cs_seen_slide *slide;
  *out = CS_PICTURE_MIXED;
  if (leaf->kind != CS_LEAF_PICTURE || leaf->fade != 1 || leaf->group != CS_STACK_NONE)
    return CELSPAN_OK;
  CS_TRY(cs_composer_slide(composer, leaf->detail, &slide));
  if (slide->is_opaque) {
    *out = CS_PICTURE_OPAQUE;
    return CELSPAN_OK;
  }
  CS_TRY(cs_sampler_look(composer->texels, &slide->sampler, x0, x1, y, out));
  if (*out == CS_PICTURE_OPAQUE &&
      composer->stack->slides[leaf->detail].texture->use == CELSPAN_PICTURE_GEL)
    *out = CS_PICTURE_MIXED;
  return CELSPAN_OK;
}

/* What shows over the `step` columns around x; out->is_sure: and over each part of them. */
static celspan_status cut_segment(cs_composer *composer, const cs_program *program, int32_t step,
                                  int32_t x, double y, segment *out) {
  int32_t left = x / step * step;
  *out = (segment){.end = program->length, .is_sure = true};
  for (uint32_t i = 0; i < program->length && i < 64; i++) {
    cs_picture_look look;
    CS_TRY(look_at_item(composer, program->items[i].leaf, left, left + step, y, &look));
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
  cs_program shown = {program->items, program->strips, part->end};
  if (x1 <= x0)
    return CELSPAN_OK;
  if (part->left_out) {
    cs_item *items = cs_arena_take(composer->context, &row->colours, part->end * sizeof *items);
    if (!items)
      return CELSPAN_NO_MEMORY;
    shown = (cs_program){items, program->strips, 0};
    for (uint32_t i = 0; i < part->end; i++)
      if (i >= 64 || !(part->left_out >> i & 1))
        items[shown.length++] = program->items[i];
  }
  return run_shown(composer, &shown, part->ends_opaque, x0, x1, y, row);
}

static bool has_picture(const cs_composer *composer, const cs_program *program) {
  for (uint32_t i = 0; i < program->length; i++)
    if (composer->stack->leaves[program->items[i].leaf].kind == CS_LEAF_PICTURE)
      return true;
  return false;
}

/* Columns looked at at a time, from the left edge of the frame on, since what is known of them must
 * not depend on where a run begins: those of the picture that asks for fewest. */
static celspan_status find_step(cs_composer *composer, const cs_program *program, int32_t *out) {
  *out = INT32_MAX;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_leaf *leaf = &composer->stack->leaves[program->items[i].leaf];
    const cs_seen_slide *slide;
    if (leaf->kind != CS_LEAF_PICTURE)
      continue;
    CS_TRY(cs_composer_slide(composer, leaf->detail, &slide));
    if (!slide->is_opaque && slide->sampler.look_columns < *out)
      *out = slide->sampler.look_columns;
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
