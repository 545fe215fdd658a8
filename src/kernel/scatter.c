#include "kernel/scatter.h"

/* ---------------------------------------------------------------- columns */

void cs_scatter_touch(cs_convolve *convolve, int32_t p) {
  uint64_t bit = (uint64_t)1 << (p % 64), *word = &convolve->touched[p / 64];
  if (*word & bit)
    return;
  *word |= bit;
  memset(convolve->changes[p], 0, sizeof convolve->changes[p]);
  if (convolve->slopes)
    memset(convolve->slopes[p], 0, sizeof convolve->slopes[p]);
  convolve->values[p] = cs_v4_all(0);
  convolve->shifts_at[p] = 0;
  if (convolve->kernel->is_signed) {
    convolve->passages_at[p] = 0;
    convolve->near[p] = cs_convolve_nothing();
  }
}

static celspan_status shift_look(cs_scatter *g, int32_t p, int32_t program, double weight) {
  cs_convolve *convolve = g->convolve;
  if (program < 0)
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(g->context, (void **)&convolve->shifts, &convolve->shift_capacity,
                        convolve->shift_count + 1, sizeof *convolve->shifts));
  convolve->shifts[convolve->shift_count++] =
      (cs_convolve_shift){convolve->shifts_at[p], (uint32_t)g->looks[program], weight};
  convolve->shifts_at[p] = (uint32_t)convolve->shift_count;
  return CELSPAN_OK;
}

celspan_status cs_scatter_shift(cs_scatter *g, const cs_retained_edge *piece, int32_t p,
                                double weight) {
  CS_TRY(shift_look(g, p, piece->left.program, -weight));
  return shift_look(g, p, piece->right.program, weight);
}

void cs_scatter_step(cs_scatter *g, const cs_retained_edge *piece, int32_t p, double weight) {
  double *sum = g->convolve->changes[p];
  for (int c = 0; c < 4; c++)
    sum[c] += weight * ((double)piece->right.colour[c] - (double)piece->left.colour[c]);
}

/* ---------------------------------------------------------------- pieces */

bool cs_scatter_cut(const cs_retained_edge *piece, double top, double foot, cs_retained_edge *out) {
  double slope = (piece->xb - piece->xa) / (piece->yb - piece->ya);
  *out = *piece;
  if (piece->yb <= top || piece->ya >= foot)
    return false;
  if (piece->ya < top) {
    out->ya = top;
    out->xa = piece->xa + (top - piece->ya) * slope;
  }
  if (piece->yb > foot) {
    out->yb = foot;
    out->xb = piece->xa + (foot - piece->ya) * slope;
  }
  return true;
}

/* ---------------------------------------------------------------- looks */

static bool are_alike(const cs_painter *painter, const cs_program *a, const cs_program *b) {
  if (a->length != b->length || memcmp(a->items, b->items, a->length * sizeof *a->items) != 0)
    return false;
  for (uint32_t i = 0; a->procedure_spans != b->procedure_spans && i < a->length; i++)
    if (painter->stack->layers[a->items[i].layer].kind == CS_LAYER_SCANLINE)
      return false; /* strips are named row by row */
  return true;
}

static celspan_status find_look(cs_scatter *g, const cs_painter *painter, const cs_program *program,
                                int32_t *out) {
  cs_convolve *convolve = g->convolve;
  for (size_t i = convolve->look_count; i-- > 0;)
    if (are_alike(painter, convolve->looks[i].program, program)) {
      *out = (int32_t)i;
      return CELSPAN_OK;
    }
  CS_TRY(cs_mem_reserve(g->context, (void **)&convolve->looks, &convolve->look_capacity,
                        convolve->look_count + 1, sizeof *convolve->looks));
  convolve->looks[convolve->look_count] = (cs_convolve_term){.program = program};
  *out = (int32_t)convolve->look_count++;
  return CELSPAN_OK;
}

static celspan_status add_trace(cs_scatter *g, cs_painter *painter) {
  const cs_retained_row *retained = g->retained;
  g->looks = NULL;
  if (retained->program_count > 0) {
    cs_arena_reset(&painter->scratch);
    g->looks =
        cs_arena_take(g->context, &painter->scratch, retained->program_count * sizeof *g->looks);
    if (!g->looks)
      return CELSPAN_NO_MEMORY;
  }
  for (size_t i = 0; i < retained->program_count; i++)
    CS_TRY(find_look(g, painter, &retained->programs[i].program, &g->looks[i]));
  for (size_t i = 0; i < retained->piece_count; i++)
    CS_TRY(g->convolve->kernel->shape == CS_KERNEL_SEPARABLE
               ? cs_scatter_separable(g, &retained->pieces[i])
               : cs_scatter_even(g, &retained->pieces[i]));
  return CELSPAN_OK;
}

celspan_status cs_scatter_rows(cs_convolve *convolve, cs_painter *painter,
                               const cs_retained_row *const *retained_rows, size_t count,
                               int32_t y) {
  cs_scatter g = {.convolve = convolve, .context = painter->context, .centre = y + 0.5};
  convolve->look_count = convolve->shift_count = convolve->passage_count = 0;
  memset(convolve->touched, 0, cs_convolve_words(convolve->width) * sizeof *convolve->touched);
  cs_scatter_touch(convolve, 0);
  for (size_t i = 0; i < count; i++) {
    g.retained = retained_rows[i];
    g.row = (uint32_t)i;
    CS_TRY(add_trace(&g, painter));
  }
  return CELSPAN_OK;
}
