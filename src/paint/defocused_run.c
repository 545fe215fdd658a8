#include "paint/defocused_run.h"

#include "paint/over_row.h"

/* Light through flat layers is affine in what the soft one scatters (s) and lets through (t). */
typedef struct light {
  cs_v4 base, s, t;
  cs_v4 clear;    /* where the soft layer is clear */
  float matte[3]; /* of alpha: what each channel of t adds */
} light;

typedef struct walk {
  cs_painter *painter;
  const cs_program *program;
  const cs_defocused *soft;
  const cs_defocused_view *seen;
  light light;
} walk;

bool cs_defocused_run_fits(const cs_stack *stack, const cs_program *program, uint32_t *item) {
  uint32_t found = 0;
  for (uint32_t i = 0; i < program->length; i++) {
    cs_layer_kind kind = stack->layers[program->items[i].layer].kind;
    if (kind == CS_LAYER_FLAT)
      continue;
    if (kind != CS_LAYER_DEFOCUSED || found++ > 0)
      return false;
    *item = i;
  }
  return found == 1;
}

/* ---------------------------------------------------------------- colours */

/* Paints that the soft layer is tried with: clear, all scattered, and each channel let through. */
enum { NONE, SCATTERED, CLEAR, RED, GREEN, BLUE, TRIALS };

typedef struct trials {
  float s[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4], rgba[CS_OVER_ROW_BATCH][4];
} trials;

/* The colours of the trials, through the layers before and behind. */
static celspan_status try_paints(walk *w, trials *room) {
  cs_painter *painter = w->painter;
  celspan_context *context = painter->context;
  cs_arena *scratch = &painter->scratch;
  cs_over_row over;
  CS_TRY(cs_over_row_begin(context, scratch, painter->stack, painter->isa, TRIALS, &over));
  for (uint32_t i = 0; i < w->program->length; i++)
    CS_TRY(cs_over_row_layer(context, scratch, &over, w->program->items[i].layer,
                             (const float(*)[4])room->s, (const float(*)[4])room->t));
  cs_over_row_end(&over, room->rgba);
  return CELSPAN_OK;
}

static celspan_status find_light(walk *w) {
  cs_arena *scratch = &w->painter->scratch;
  cs_arena_reset(scratch);
  trials *room = cs_arena_take(w->painter->context, scratch, sizeof *room);
  if (!room)
    return CELSPAN_NO_MEMORY;
  memset(room, 0, sizeof *room);
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

static inline cs_v4 knot_colour(const walk *w, size_t k) {
  const light *l = &w->light;
  cs_v4 s = cs_defocused_value(w->soft, w->seen, k, 0);
  if (w->soft->planes == 1)
    return l->base + l->s * s + l->t * (1 - s[3]);
  cs_v4 t = cs_defocused_value(w->soft, w->seen, k, 1), colour = l->base + l->s * s + l->t * t;
  colour[3] = l->base[3] + (l->matte[0] * t[0] + l->matte[1] * t[1] + l->matte[2] * t[2]);
  return colour;
}

static bool is_still(const walk *w, size_t k) {
  size_t planes = (size_t)w->soft->planes;
  const float(*values)[4] = w->seen->values + k * planes;
  return memcmp(values, values + planes, planes * sizeof *values) == 0;
}

/* The colour of a constant piece: where it is clear, exactly what it would be without the layer. */
static cs_v4 still_colour(const walk *w, size_t k) {
  cs_v4 s = cs_defocused_value(w->soft, w->seen, k, 0);
  bool is_clear = cs_v4_same(s, cs_v4_all(0));
  if (is_clear && w->soft->planes == 2) {
    cs_v4 t = cs_defocused_value(w->soft, w->seen, k, 1);
    is_clear = t[0] == 1 && t[1] == 1 && t[2] == 1;
  }
  return is_clear ? w->light.clear : knot_colour(w, k);
}

/* ---------------------------------------------------------------- pieces */

/* The column after those up to knot k, at most x1. */
static int32_t column_after(const walk *w, size_t k, int32_t x1) {
  double x = (w->seen->at[k] - 0.5) * w->soft->pitch_x - 0.5;
  int32_t column = x < 0 ? 0 : (int32_t)x + 1;
  return k + 1 >= w->seen->count || column > x1 ? x1 : column;
}

/* Whether all that is left of a piece at column x is its last knot's column, and the next piece can
 * begin there. */
static bool is_joint(const walk *w, size_t k, int32_t x) {
  const int32_t *at = w->seen->at;
  return w->soft->pitch_x == 1 && at[k + 1] == at[k] + 1 && k + 2 < w->seen->count &&
         !is_still(w, k + 1) && cs_defocused_at(w->soft, x + 0.5) > at[k];
}

static celspan_status walk_pieces(walk *w, cs_run run, cs_row *row) {
  celspan_context *context = w->painter->context;
  const int32_t *at = w->seen->at;
  size_t k = cs_defocused_find(w->seen, cs_defocused_at(w->soft, run.x0 + 0.5), 0);
  cs_v4 left = knot_colour(w, k);
  for (int32_t x = run.x0, to; x < run.x1; x = to, k++) {
    cs_v4 right = knot_colour(w, k + 1);
    to = is_joint(w, k, x) ? x : column_after(w, k + 1, run.x1);
    if (to > x && is_still(w, k)) {
      CS_TRY(cs_row_single(context, row, x, to, still_colour(w, k)));
    } else if (to > x) {
      cs_v4 slope = (right - left) * (1 / (float)(at[k + 1] - at[k]));
      cs_v4 start = left + (float)(cs_defocused_at(w->soft, x + 0.5) - at[k]) * slope;
      CS_TRY(cs_row_gradient(context, row, x, to, start, slope * (float)(1 / w->soft->pitch_x)));
    }
    w->painter->evaluations++;
    left = right;
  }
  return CELSPAN_OK;
}

celspan_status cs_defocused_run(cs_painter *painter, const cs_program *program, uint32_t item,
                                cs_run run, cs_row *row) {
  uint32_t detail = painter->stack->layers[program->items[item].layer].detail;
  walk w = {.painter = painter, .program = program};
  w.soft = painter->stack->defocused[detail];
  w.seen = &painter->defocused[detail];
  CS_TRY(cs_defocused_stand(w.soft, painter->context, &painter->defocused[detail], run.y));
  CS_TRY(find_light(&w));
  return walk_pieces(&w, run, row);
}
