/* From a cell's program to spans: samples of the leaves that vary, folded at every pixel where a
 * picture shows, else at as few columns as a piecewise linear row needs.
 */
#include "compose/composer.h"

#include "base/number.h"
#include "compose/blend.h"
#include "compose/shade.h"

#include <math.h>
#include <stdlib.h>

/* A chord is accepted when it is this near the curve at its quarters: half of what is promised. */
#define CHORD_TOLERANCE (0.5f / 1023)

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
  celspan_matrix to_picture = {
      {info.width / box->width, 0, -box->x * info.width / box->width, 0, info.height / box->height,
       -box->y * info.height / box->height, 0, 0, 1}};
  seen->sampler = (cs_sampler){.picture = texture->picture,
                               .inverse = celspan_matrix_then(slide->inverse, to_picture),
                               .width = info.width,
                               .height = info.height,
                               .sampling = texture->sampling,
                               .wrap = slide->wrap,
                               .isa = composer->isa};
  cs_sampler_prepare(&seen->sampler);
  seen->is_opaque = !info.has_alpha && texture->use == CELSPAN_PICTURE_PAINT &&
                    slide->wrap != CELSPAN_WRAP_CLEAR;
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

/* What leaves that vary paint in a batch of pixels. */
typedef struct samples {
  float rgba[CS_BLEND_BATCH][4];                     /* pictures */
  float s[CS_BLEND_BATCH][4], t[CS_BLEND_BATCH][4]; /* all others; s is not lit */
} samples;

static void put_paint(samples *out, int32_t k, cs_paint paint) {
  cs_v4_store(out->s[k], (cs_v4){paint.s[0], paint.s[1], paint.s[2], 0});
  cs_v4_store(out->t[k], (cs_v4){paint.t[0], paint.t[1], paint.t[2], 0});
}

static celspan_status blend_picture(cs_composer *composer, cs_blend *blend, const cs_leaf *leaf,
                                    int32_t x0, double y, samples *room) {
  const cs_seen_slide *slide;
  CS_TRY(cs_composer_slide(composer, leaf->detail, &slide));
  CS_TRY(cs_sampler_run(composer->texels, &slide->sampler, x0, blend->count, y, room->rgba));
  cs_blend_picture(blend, leaf, composer->stack->slides[leaf->detail].texture->use,
                   (const float(*)[4])room->rgba);
  return CELSPAN_OK;
}

static celspan_status blend_soft(cs_composer *composer, cs_blend *blend, const cs_leaf *leaf,
                                 int32_t x0, double y, samples *room) {
  const cs_soft *soft = composer->stack->softs[leaf->detail];
  cs_seen_soft *seen = &composer->softs[leaf->detail];
  CS_TRY(cs_soft_stand(soft, composer->context, seen, y));
  for (int32_t k = 0; k < blend->count; k++) {
    cs_v4 s, t;
    cs_soft_paint(soft, seen, x0 + k + 0.5, &s, &t);
    cs_v4_store(room->s[k], s);
    cs_v4_store(room->t[k], t);
  }
  cs_blend_paints(blend, leaf, (const float(*)[4])room->s, (const float(*)[4])room->t);
  return CELSPAN_OK;
}

static celspan_status blend_item(cs_composer *composer, cs_blend *blend, const cs_strip *strips,
                                 cs_item item, int32_t x0, double y, samples *room) {
  const cs_stack *stack = composer->stack;
  const cs_leaf *leaf = &stack->leaves[item.leaf];
  if (leaf->kind == CS_LEAF_FLAT) {
    cs_blend_flat(blend, leaf);
    return CELSPAN_OK;
  }
  if (leaf->kind == CS_LEAF_PICTURE)
    return blend_picture(composer, blend, leaf, x0, y, room);
  if (leaf->kind == CS_LEAF_SOFT)
    return blend_soft(composer, blend, leaf, x0, y, room);
  for (int32_t k = 0; k < blend->count; k++)
    put_paint(room, k,
              leaf->kind == CS_LEAF_SHADED
                  ? cs_shade_paint(&stack->shades[leaf->detail], x0 + k + 0.5, y)
                  : strip_paint(&strips[item.strip], x0 + k + 0.5));
  cs_blend_paints(blend, leaf, (const float(*)[4])room->s, (const float(*)[4])room->t);
  return CELSPAN_OK;
}

static celspan_status colours_batch(cs_composer *composer, const cs_program *program, int32_t x0,
                                    int32_t count, double y, samples *room, float (*rgba)[4]) {
  celspan_context *context = composer->context;
  cs_blend blend;
  CS_TRY(cs_blend_begin(context, &composer->scratch, composer->stack, composer->isa, count,
                        &blend));
  for (uint32_t i = 0; i < program->length; i++) {
    CS_TRY(cs_blend_reach(context, &composer->scratch, &blend, program->items[i].leaf));
    CS_TRY(blend_item(composer, &blend, program->strips, program->items[i], x0, y, room));
  }
  cs_blend_end(&blend, rgba);
  composer->evaluations += (uint64_t)count;
  return CELSPAN_OK;
}

celspan_status cs_composer_program_colours(cs_composer *composer, const cs_program *program,
                                           int32_t x0, int32_t x1, double y, float (*rgba)[4]) {
  for (int32_t x = x0; x < x1; x += CS_BLEND_BATCH) {
    int32_t count = x1 - x < CS_BLEND_BATCH ? x1 - x : CS_BLEND_BATCH;
    cs_arena_reset(&composer->scratch);
    samples *room = cs_arena_take(composer->context, &composer->scratch, sizeof *room);
    if (!room)
      return CELSPAN_NO_MEMORY;
    CS_TRY(colours_batch(composer, program, x, count, y, room, rgba + (x - x0)));
  }
  return CELSPAN_OK;
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

/* ---------------------------------------------------------------- ramps */

typedef struct ramp {
  cs_composer *composer;
  const cs_program *program;
  double y;
  cs_row *row;
} ramp;

static celspan_status ramp_colour(const ramp *r, int32_t x, cs_v4 *out) {
  float rgba[1][4];
  CS_TRY(cs_composer_program_colours(r->composer, r->program, x, x + 1, r->y, rgba));
  *out = cs_v4_load(rgba[0]);
  return CELSPAN_OK;
}

static bool is_near(cs_v4 a, cs_v4 b) {
  for (int c = 0; c < 4; c++)
    if (!(fabsf(a[c] - b[c]) <= CHORD_TOLERANCE))
      return false;
  return true;
}

/* Whether the line from `first` at x0 to `last` at x1 - 1 is near the colour at three columns. */
static celspan_status ramp_is_straight(const ramp *r, int32_t x0, int32_t x1, cs_v4 first,
                                       cs_v4 last, bool *out) {
  *out = true;
  int32_t length = x1 - 1 - x0;
  for (int quarter = 1; quarter <= 3 && *out; quarter++) {
    int32_t x = x0 + (int32_t)((int64_t)length * quarter / 4);
    float u = (float)(x - x0) / (float)length;
    cs_v4 colour;
    CS_TRY(ramp_colour(r, x, &colour));
    *out = is_near(colour, first + u * (last - first));
  }
  return CELSPAN_OK;
}

/* Appends [x0, x1) as straight pieces, halving until each is; `first`, `last`: the colours of its
 * end columns. A piece of two columns is always straight, so the depth is at most log2(width). */
static celspan_status ramp_append(const ramp *r, int32_t x0, int32_t x1, cs_v4 first, cs_v4 last) {
  bool is_straight = true;
  if (x1 - x0 > 2)
    CS_TRY(ramp_is_straight(r, x0, x1, first, last, &is_straight));
  if (is_straight) {
    float steps = x1 - x0 > 1 ? (float)(x1 - 1 - x0) : 1;
    return cs_row_gradient(r->composer->context, r->row, x0, x1, first, (last - first) / steps);
  }
  int32_t middle = x0 + (x1 - x0) / 2;
  cs_v4 before, after;
  CS_TRY(ramp_colour(r, middle - 1, &before));
  CS_TRY(ramp_colour(r, middle, &after));
  CS_TRY(ramp_append(r, x0, middle, first, before));
  return ramp_append(r, middle, x1, after, last);
}

static celspan_status ramp_piece(const ramp *r, int32_t x0, int32_t x1) {
  cs_v4 first, last;
  CS_TRY(ramp_colour(r, x0, &first));
  CS_TRY(ramp_colour(r, x1 - 1, &last));
  return ramp_append(r, x0, x1, first, last);
}

/* ---------------------------------------------------------------- runs */

static int compare_columns(const void *a, const void *b) {
  int32_t p = *(const int32_t *)a, q = *(const int32_t *)b;
  return (p > q) - (p < q);
}

static size_t strip_break_limit(const cs_strip *strip) { return strip->paint_count; }

static size_t strip_breaks(const cs_strip *strip, double x0, double x1, double *out) {
  size_t count = 0;
  for (size_t i = 1; i + 1 < strip->paint_count; i++) {
    double u = (double)i / (double)(strip->paint_count - 1);
    double x = strip->x0 + u * (strip->x1 - strip->x0);
    if (x > x0 && x < x1)
      out[count++] = x;
  }
  return count;
}

static size_t item_break_limit(const cs_composer *composer, const cs_strip *strips,
                               cs_item item) {
  const cs_stack *stack = composer->stack;
  const cs_leaf *leaf = &stack->leaves[item.leaf];
  return leaf->kind == CS_LEAF_SHADED     ? cs_shade_break_limit(&stack->shades[leaf->detail])
         : leaf->kind == CS_LEAF_SCANLINE ? strip_break_limit(&strips[item.strip])
         : leaf->kind == CS_LEAF_SOFT     ? cs_soft_break_limit(stack->softs[leaf->detail])
                                          : 0;
}

static celspan_status item_breaks(cs_composer *composer, const cs_strip *strips, cs_item item,
                                  double y, double x0, double x1, double *out, size_t *count) {
  const cs_stack *stack = composer->stack;
  const cs_leaf *leaf = &stack->leaves[item.leaf];
  *count = 0;
  if (leaf->kind == CS_LEAF_SHADED) {
    *count = cs_shade_breaks(&stack->shades[leaf->detail], y, x0, x1, out);
  } else if (leaf->kind == CS_LEAF_SCANLINE) {
    *count = strip_breaks(&strips[item.strip], x0, x1, out);
  } else if (leaf->kind == CS_LEAF_SOFT) {
    const cs_soft *soft = stack->softs[leaf->detail];
    cs_seen_soft *seen = &composer->softs[leaf->detail];
    CS_TRY(cs_soft_stand(soft, composer->context, seen, y));
    *count = cs_soft_breaks(soft, seen, x0, x1, out);
  }
  return CELSPAN_OK;
}

/* The columns strictly inside [x0, x1) at which a formula of the program changes, sorted, in room
 * of the row's own arena (the scratch arena is used anew for every colour). */
static celspan_status run_breaks(cs_composer *composer, const cs_program *program, int32_t x0,
                                 int32_t x1, double y, cs_row *row, int32_t **columns,
                                 size_t *column_count) {
  size_t limit = 0, count = 0;
  for (uint32_t i = 0; i < program->length; i++)
    limit += item_break_limit(composer, program->strips, program->items[i]);
  double *breaks = cs_arena_take(composer->context, &row->colours, limit * sizeof *breaks);
  *columns = cs_arena_take(composer->context, &row->colours, limit * sizeof **columns);
  if (!breaks || !*columns)
    return CELSPAN_NO_MEMORY;
  for (uint32_t i = 0; i < program->length; i++) {
    size_t more;
    CS_TRY(item_breaks(composer, program->strips, program->items[i], y, x0, x1, breaks + count,
                       &more));
    count += more;
  }
  for (size_t i = 0; i < count; i++)
    (*columns)[i] = cs_number_first_centre(breaks[i]);
  qsort(*columns, count, sizeof **columns, compare_columns);
  *column_count = count;
  return CELSPAN_OK;
}

static celspan_status run_ramps(cs_composer *composer, const cs_program *program, int32_t x0,
                                int32_t x1, double y, cs_row *row) {
  int32_t *columns;
  size_t count;
  ramp r = {composer, program, y, row};
  CS_TRY(run_breaks(composer, program, x0, x1, y, row, &columns, &count));
  int32_t from = x0;
  for (size_t i = 0; i < count; i++) {
    if (columns[i] <= from || columns[i] >= x1)
      continue;
    CS_TRY(ramp_piece(&r, from, columns[i]));
    from = columns[i];
  }
  return ramp_piece(&r, from, x1);
}

static bool has_picture(const cs_composer *composer, const cs_program *program) {
  for (uint32_t i = 0; i < program->length; i++)
    if (composer->stack->leaves[program->items[i].leaf].kind == CS_LEAF_PICTURE)
      return true;
  return false;
}

celspan_status cs_composer_run_program(cs_composer *composer, const cs_program *program,
                                       int32_t x0, int32_t x1, double y, cs_row *row) {
  if (x1 <= x0)
    return CELSPAN_OK;
  if (!has_picture(composer, program))
    return run_ramps(composer, program, x0, x1, y, row);
  float *colours;
  CS_TRY(cs_row_array(composer->context, row, x0, x1, &colours));
  return cs_composer_program_colours(composer, program, x0, x1, y, (float(*)[4])colours);
}

celspan_status cs_composer_run(cs_composer *composer, const cs_cell *cell, int32_t x0, int32_t x1,
                               double y, cs_row *row) {
  if (cell->length == 0)
    return cs_row_single(composer->context, row, x0, x1, cell->colour);
  cs_program program = cs_composer_program(composer, cell);
  return cs_composer_run_program(composer, &program, x0, x1, y, row);
}
