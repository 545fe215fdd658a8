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
    convolve->passed_at[p] = 0;
    convolve->near[p] = cs_convolve_nothing();
  }
}

static celspan_status shift_term(cs_scatter *g, int32_t p, int32_t program, double weight) {
  cs_convolve *convolve = g->convolve;
  if (program < 0)
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(g->context, (void **)&convolve->shifts, &convolve->shift_capacity,
                        convolve->shift_count + 1, sizeof *convolve->shifts));
  convolve->shifts[convolve->shift_count++] =
      (cs_convolve_shift){convolve->shifts_at[p], (uint32_t)g->terms[program], weight};
  convolve->shifts_at[p] = (uint32_t)convolve->shift_count;
  return CELSPAN_OK;
}

celspan_status cs_scatter_shift(cs_scatter *g, const cs_retained_edge *edge, int32_t p,
                                double weight) {
  CS_TRY(shift_term(g, p, edge->left.program, -weight));
  return shift_term(g, p, edge->right.program, weight);
}

void cs_scatter_step(cs_scatter *g, const cs_retained_edge *edge, int32_t p, double weight) {
  double *sum = g->convolve->changes[p];
  for (int c = 0; c < 4; c++)
    sum[c] += weight * ((double)edge->right.colour[c] - (double)edge->left.colour[c]);
}

/* ---------------------------------------------------------------- edges */

bool cs_scatter_cut(const cs_retained_edge *edge, double top, double foot, cs_retained_edge *out) {
  double slope = (edge->xb - edge->xa) / (edge->yb - edge->ya);
  *out = *edge;
  if (edge->yb <= top || edge->ya >= foot)
    return false;
  if (edge->ya < top) {
    out->ya = top;
    out->xa = edge->xa + (top - edge->ya) * slope;
  }
  if (edge->yb > foot) {
    out->yb = foot;
    out->xb = edge->xa + (foot - edge->ya) * slope;
  }
  return true;
}

/* ---------------------------------------------------------------- programs */

static bool are_same(const cs_painter *painter, const cs_program *a, const cs_program *b) {
  if (a->length != b->length || memcmp(a->items, b->items, a->length * sizeof *a->items) != 0)
    return false;
  for (uint32_t i = 0; a->procedure_spans != b->procedure_spans && i < a->length; i++)
    if (painter->stack->layers[a->items[i].layer].kind == CS_LAYER_SCANLINE)
      return false; /* the numbers of procedure spans differ from row to row */
  return true;
}

static celspan_status find_term(cs_scatter *g, const cs_painter *painter, const cs_program *program,
                                int32_t *out) {
  cs_convolve *convolve = g->convolve;
  for (size_t i = convolve->term_count; i-- > 0;)
    if (are_same(painter, convolve->terms[i].program, program)) {
      *out = (int32_t)i;
      return CELSPAN_OK;
    }
  CS_TRY(cs_mem_reserve(g->context, (void **)&convolve->terms, &convolve->term_capacity,
                        convolve->term_count + 1, sizeof *convolve->terms));
  convolve->terms[convolve->term_count] = (cs_convolve_term){.program = program};
  *out = (int32_t)convolve->term_count++;
  return CELSPAN_OK;
}

static celspan_status add_row(cs_scatter *g, cs_painter *painter) {
  const cs_retained_row *retained = g->retained;
  g->terms = NULL;
  if (retained->program_count > 0) {
    cs_arena_reset(&painter->scratch);
    g->terms =
        cs_arena_take(g->context, &painter->scratch, retained->program_count * sizeof *g->terms);
    if (!g->terms)
      return CELSPAN_NO_MEMORY;
  }
  for (size_t i = 0; i < retained->program_count; i++)
    CS_TRY(find_term(g, painter, &retained->programs[i].program, &g->terms[i]));
  for (size_t i = 0; i < retained->edge_count; i++)
    CS_TRY(g->convolve->kernel->shape == CS_KERNEL_SEPARABLE
               ? cs_scatter_separable(g, &retained->edges[i])
               : cs_scatter_even(g, &retained->edges[i]));
  return CELSPAN_OK;
}

celspan_status cs_scatter_rows(cs_convolve *convolve, cs_painter *painter,
                               const cs_retained_row *const *retained_rows, size_t count,
                               int32_t y) {
  cs_scatter g = {.convolve = convolve, .context = painter->context, .centre = y + 0.5};
  convolve->term_count = convolve->shift_count = convolve->passed_count = 0;
  memset(convolve->touched, 0, cs_convolve_words(convolve->width) * sizeof *convolve->touched);
  cs_scatter_touch(convolve, 0);
  for (size_t i = 0; i < count; i++) {
    g.retained = retained_rows[i];
    g.row = (uint32_t)i;
    CS_TRY(add_row(&g, painter));
  }
  return CELSPAN_OK;
}
