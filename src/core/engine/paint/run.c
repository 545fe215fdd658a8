#include "engine/paint/run.h"

#include "engine/paint/colours.h"
#include "engine/paint/over_row.h"
#include "engine/paint/painter.h"
#include "engine/paint/shown.h"
#include "engine/span/row.h"
#include "engine/span/run.h"

/* ---------------------------------------------------------------- one defocused layer */

/* Runs of one defocused layer among flat ones, which is the usual defocused cel: its row is a
 * polyline already (engine/sample/defocused.h), so every line becomes a span without evaluating the
 * program column by column.
 *
 *     value        v-----------v
 *       |        . :           :` .
 *       |      v'  :           :    ` . v ...     v: vertices of the row's polyline; their colours
 *       |      :   :           :        :         are seen through the flat layers before and
 *       +------+---+-----------+--------+---> x   behind, and each line between two of them
 *     spans    | 1 |     2     |    3   |         becomes a span: 1 and 3 gradients, 2 a single
 */

/* Light through flat layers is affine in what the defocused one scatters (s) and lets through (t),
 * channel by channel, unless it is a source. */
typedef struct light {
  cs_v4 base, s, t;
  cs_v4 clear;    /* where the defocused layer is clear */
  float matte[3]; /* the share of each channel of t in alpha */
} light;

typedef struct drawing {
  cs_painter *painter;
  const cs_program *program;
  const cs_defocused *defocused;
  const cs_defocused_view *view;
  light light;
} drawing;

/* Whether the program has defocused layers, and modes or mattes: a line of the row would need more
 * colours than it has pixels. */
static bool is_blended(const cs_stack *stack, const cs_program *program) {
  bool is_defocused = false, is_blended = false;
  bool may_be = stack->has_sources && stack->defocused_count > 0;
  for (uint32_t i = 0; may_be && i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    is_defocused |= layer->kind == CS_LAYER_DEFOCUSED;
    is_blended |= layer->group != CS_STACK_NONE && stack->groups[layer->group].is_source;
  }
  return is_defocused && is_blended;
}

/* Whether a program has one defocused layer and else flat ones; *item: which. */
static bool fits_defocused(const cs_stack *stack, const cs_program *program, uint32_t *item) {
  uint32_t found = 0;
  if (stack->defocused_count == 0 || cs_program_curves(stack, program) ||
      is_blended(stack, program))
    return false;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    if (layer->kind == CS_LAYER_FLAT)
      continue;
    if (layer->kind != CS_LAYER_DEFOCUSED || cs_shown_is_pixels(stack, layer) || found++ > 0)
      return false;
    *item = i;
  }
  return found == 1;
}

/* ---------------------------------------------------------------- colours */

/* Trial paints of the defocused layer: none, all light scattered, clear, and each channel let
 * through by itself. */
enum { NONE, SCATTERED, CLEAR, RED, GREEN, BLUE, TRIALS };
#define READ 8 /* trials that may be read: whole registers */

typedef struct trials {
  float s[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4], rgba[CS_OVER_ROW_BATCH][4];
} trials;

/* The colours of the trials, through the layers before and behind. */
static celspan_status try_paints(drawing *w, trials *room) {
  cs_painter *painter = w->painter;
  celspan_context *context = painter->context;
  cs_arena *scratch = &painter->scratch;
  cs_over_row over;
  CS_TRY(cs_over_row_begin(context, scratch, painter->stack, painter->isa, TRIALS, &over));
  for (uint32_t i = 0; i < w->program->length; i++)
    CS_TRY(cs_over_row_layer(&over, w->program->items[i].layer, (const float(*)[4])room->s,
                             (const float(*)[4])room->t));
  cs_over_row_end(&over, room->rgba);
  return CELSPAN_OK;
}

static celspan_status find_light(drawing *w) {
  cs_arena *scratch = &w->painter->scratch;
  cs_arena_reset(scratch);
  trials *room = cs_arena_take(w->painter->context, scratch, sizeof *room);
  if (!room)
    return CELSPAN_NO_MEMORY;
  memset(room->s, 0, READ * sizeof *room->s);
  memset(room->t, 0, READ * sizeof *room->t);
  for (int c = 0; c < 3; c++)
    room->s[SCATTERED][c] = room->t[CLEAR][c] = room->t[RED + c][c] = 1;
  CS_TRY(try_paints(w, room));
  light *l = &w->light;
  l->base = cs_v4_load(room->rgba[NONE]);
  l->s = cs_v4_load(room->rgba[SCATTERED]) - l->base;
  l->s[3] = 0;
  l->clear = cs_v4_load(room->rgba[CLEAR]);
  l->t = l->clear - l->base;
  for (int c = 0; c < 3; c++)
    l->matte[c] = room->rgba[RED + c][3] - l->base[3];
  return CELSPAN_OK;
}

static inline cs_v4 vertex_colour(const drawing *w, size_t k) {
  const light *l = &w->light;
  cs_v4 s = cs_defocused_value(w->defocused, w->view, k, 0);
  if (w->defocused->planes == 1)
    return l->base + l->s * s + l->t * (1 - s[3]);
  cs_v4 t = cs_defocused_value(w->defocused, w->view, k, 1), colour = l->base + l->s * s + l->t * t;
  colour[3] = l->base[3] + (l->matte[0] * t[0] + l->matte[1] * t[1] + l->matte[2] * t[2]);
  return colour;
}

static bool is_constant(const drawing *w, size_t k) {
  for (int plane = 0; plane < w->defocused->planes; plane++)
    if (!cs_v4_same(cs_defocused_value(w->defocused, w->view, k, plane),
                    cs_defocused_value(w->defocused, w->view, k + 1, plane)))
      return false;
  return true;
}

/* The colour of a constant line. Where the layer is clear, it is the colour without the layer, to
 * the bit. */
static cs_v4 constant_colour(const drawing *w, size_t k) {
  cs_v4 s = cs_defocused_value(w->defocused, w->view, k, 0);
  bool is_clear = cs_v4_same(s, cs_v4_all(0));
  if (is_clear && w->defocused->planes == 2) {
    cs_v4 t = cs_defocused_value(w->defocused, w->view, k, 1);
    is_clear = t[0] == 1 && t[1] == 1 && t[2] == 1;
  }
  return is_clear ? w->light.clear : vertex_colour(w, k);
}

/* ---------------------------------------------------------------- lines */

/* The first column after vertex k, at most x1. */
static int32_t column_after(const drawing *w, size_t k, int32_t x1) {
  double x = (w->view->at[k] + w->defocused->left) * w->defocused->pitch_x - 0.5;
  int32_t column = x < 0 ? 0 : (int32_t)x + 1;
  return k + 1 >= w->view->count || column > x1 ? x1 : column;
}

/* Whether column x, the last column of this line, belongs to the next line, because the vertex
 * where the next line begins lies in this column. */
static bool belongs_to_next(const drawing *w, size_t k, int32_t x) {
  const int32_t *at = w->view->at;
  return w->defocused->pitch_x == 1 && at[k + 1] == at[k] + 1 && k + 2 < w->view->count &&
         !is_constant(w, k + 1) && cs_defocused_at(w->defocused, x + 0.5) > at[k];
}

static celspan_status put_lines(drawing *w, cs_run run, cs_row *row) {
  celspan_context *context = w->painter->context;
  const int32_t *at = w->view->at;
  size_t k = cs_defocused_find(w->view, cs_defocused_at(w->defocused, run.x0 + 0.5), 0);
  cs_v4 left = vertex_colour(w, k);
  for (int32_t x = run.x0, to; x < run.x1; x = to, k++) {
    cs_v4 right = vertex_colour(w, k + 1);
    to = belongs_to_next(w, k, x) ? x : column_after(w, k + 1, run.x1);
    if (to > x && is_constant(w, k)) {
      CS_TRY(cs_row_single(context, row, x, to, constant_colour(w, k)));
    } else if (to > x) {
      cs_v4 slope = (right - left) * (1 / (float)(at[k + 1] - at[k]));
      cs_v4 start = left + (float)(cs_defocused_at(w->defocused, x + 0.5) - at[k]) * slope;
      CS_TRY(
          cs_row_gradient(context, row, x, to, start, slope * (float)(1 / w->defocused->pitch_x)));
    }
    w->painter->evaluations++;
    left = right;
  }
  return CELSPAN_OK;
}

/* As cs_painter_run_program. */
static CELSPAN_CHECKED celspan_status defocused_run(cs_painter *painter, const cs_program *program,
                                                    uint32_t item, cs_run run, cs_row *row) {
  uint32_t index = painter->stack->layers[program->items[item].layer].index;
  drawing w = {.painter = painter, .program = program};
  w.defocused = painter->stack->defocused[index];
  w.view = &painter->defocused[index];
  CS_TRY(cs_defocused_move(w.defocused, painter->context, &painter->defocused[index], run.y));
  CS_TRY(find_light(&w));
  return put_lines(&w, run, row);
}

/* ---------------------------------------------------------------- programs without hidden items */

/* Whether the program shows pixel by pixel, as pictures, noise and rows of pixels do. */
static celspan_status needs_array(cs_painter *painter, const cs_program *program, bool *out) {
  *out = is_blended(painter->stack, program);
  for (uint32_t i = 0; i < program->length && !*out; i++) {
    const cs_layer *layer = &painter->stack->layers[program->items[i].layer];
    const cs_image_view *view;
    *out = cs_shown_is_pixels(painter->stack, layer) ||
           (layer->kind == CS_LAYER_SHADED &&
            painter->stack->shades[layer->index].texture->kind == CS_TEXTURE_NOISE);
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

/* A program of the visible items alone. ends_opaque: nothing shines through it. */
static celspan_status run_shown(cs_painter *painter, const cs_program *shown, bool ends_opaque,
                                cs_run run, cs_row *row) {
  bool is_array;
  uint32_t item;
  if (row->takes_codes && is_copy(painter, shown, ends_opaque))
    return run_copy(painter, shown, run, row);
  if (fits_defocused(painter->stack, shown, &item))
    return defocused_run(painter, shown, item, run, row);
  CS_TRY(needs_array(painter, shown, &is_array));
  if (!is_array)
    return cs_lines_run(painter, shown, run, row);
  return cs_painter_pixels(painter, shown, run, row);
}

/* ---------------------------------------------------------------- columns that show the same */

#define STRIDES 8 /* examined together first, since often one answer holds for all */

/* The visible items from run.x0 on, and *end, up to which they are known. Strides are counted from
 * the left edge of the frame, since the result must not depend on where a run begins. Many are
 * examined at once if the run covers them: mostly the answer is the same for all. */
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
  cs_shown_kept *kept;
  CS_TRY(cs_shown_keep(painter, program, &kept));
  int32_t begun = run.x0, stride = kept->stride, left = run.x0 / stride * stride;
  if (run.x1 - left <= stride) { /* mostly a window of this cell has asked already */
    CS_TRY(cs_shown_again(painter, kept, cs_run_between(run, left, left + stride)));
    return run_stretch(painter, program, &kept->shown, run, row);
  }
  cs_shown *current = &painter->shown[0], *next = &painter->shown[1];
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

/* A run of copied pictures: codes where they can be copied or mixed at once. */
static celspan_status run_copies(cs_painter *painter, const cs_program *program, cs_run run,
                                 cs_row *row) {
  const cs_copies_plan *plan;
  while (run.x0 < run.x1) {
    CS_TRY(cs_copies_find(painter, program, run, &plan));
    size_t end = 0; /* where the pieces end whose codes are known */
    while (end < plan->count && plan->pieces[end].kind != CS_COPIES_OTHER)
      end++;
    CS_TRY(cs_copies_put(painter, plan, end, run, row));
    run.x0 = end > 0 ? plan->pieces[end - 1].x1 : run.x0;
    if (end == plan->count)
      break;
    int32_t x = plan->pieces[end].x1;
    CS_TRY(run_stretches(painter, program, cs_run_between(run, run.x0, x), row));
    run.x0 = x;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- runs */

celspan_status cs_painter_run_program(cs_painter *painter, const cs_program *program, cs_run run,
                                      cs_row *row) {
  bool are_copies = false;
  if (run.x1 <= run.x0)
    return CELSPAN_OK;
  if (row->takes_codes && painter->copies)
    CS_TRY(cs_copies_fit(painter, program, &are_copies));
  if (are_copies)
    return run_copies(painter, program, run, row);
  return cs_shown_varies(painter->stack, program) ? run_stretches(painter, program, run, row)
                                                  : run_shown(painter, program, false, run, row);
}

celspan_status cs_painter_run(cs_painter *painter, const cs_cell *cell, cs_run run, cs_row *row) {
  if (cell->length == 0)
    return cs_row_single(painter->context, row, run.x0, run.x1, cell->colour);
  cs_program program = cs_composer_program(painter->composer, cell);
  return cs_painter_run_program(painter, &program, run, row);
}
