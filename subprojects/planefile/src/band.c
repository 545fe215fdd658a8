/* Bands that were read: what they are as bases of others, and the runs of their borders. */
#include "band.h"

void pf_band_free(const pf_memory *memory, pf_band *band) {
  planefile_band *b = &band->band;
  pf_free(memory, (void *)b->points, sizeof *b->points, band->point_capacity);
  pf_free(memory, (void *)b->pieces, sizeof *b->pieces, band->piece_capacity);
  pf_free(memory, (void *)b->chains, sizeof *b->chains, band->chain_capacity);
  pf_free(memory, (void *)b->borders, sizeof *b->borders, band->border_capacity);
  pf_free(memory, (void *)b->cells, sizeof *b->cells, band->cell_capacity);
  pf_free(memory, (void *)b->programs, sizeof *b->programs, band->program_capacity);
  pf_free(memory, (void *)b->steps, sizeof *b->steps, band->step_capacity);
  pf_free(memory, (void *)b->axes, sizeof *b->axes, band->axis_capacity);
  pf_free(memory, (void *)b->stops, sizeof *b->stops, band->stop_capacity);
  pf_free(memory, band->runs, sizeof *band->runs, band->run_capacity);
}

/* ---------------------------------------------------------------- bases */

bool pf_base_begin(const pf_memory *memory, pf_base *out) {
  *out = (pf_base){.memory = *memory, .learned = pf_make(memory, sizeof *out->learned, 1)};
  return out->learned != NULL;
}

bool pf_base_complete(const planefile_band *band, size_t code, pf_base *base) {
  size_t chains = band->chain_count;
  base->band = band;
  base->code = code;
  base->first = pf_make(&base->memory, sizeof *base->first, chains + 1);
  if (!base->first)
    return false;
  for (uint32_t i = 0; i < band->border_count; i++)
    base->first[band->borders[i].chain + 1]++;
  for (size_t i = 0; i < chains; i++)
    base->first[i + 1] += base->first[i];
  return true;
}

void pf_base_free(pf_base *base) {
  if (base->band)
    pf_free(&base->memory, base->first, sizeof *base->first, (size_t)base->band->chain_count + 1);
  if (base->learned)
    pf_free(&base->memory, base->learned, sizeof *base->learned, 1);
  *base = (pf_base){0};
}

void pf_base_learned(const pf_base *base, pf_models *models, pf_program_models *programs) {
  const pf_learned *learned = base ? base->learned : NULL;
  if (learned)
    *models = learned->models;
  else
    pf_models_begin(models, sizeof *models);
  if (programs && learned)
    *programs = learned->programs;
  else if (programs)
    pf_models_begin(programs, sizeof *programs);
}

/* ---------------------------------------------------------------- runs */

/* The limits of a chain, across. */
static void find_sides(const planefile_band *band, const planefile_chain *chain, pf_run *run) {
  const planefile_piece *first = &band->pieces[chain->piece];
  const planefile_piece *last = first + chain->piece_count - 1;
  run->low = run->high = band->points[first->point].x;
  for (uint32_t i = first->point; i <= last->point + last->degree; i++) {
    int32_t x = band->points[i].x;
    run->low = x < run->low ? x : run->low;
    run->high = x > run->high ? x : run->high;
  }
}

/* The runs of borders, which are by their chains. */
static void find_runs(pf_band *out, pf_run *runs) {
  const planefile_band *band = &out->band;
  for (uint32_t i = 0, end; i < band->border_count; i = end) {
    pf_run *run = &runs[out->run_count++];
    for (end = i + 1;
         end < band->border_count && band->borders[end].chain == band->borders[i].chain;)
      end++;
    *run = (pf_run){.top = band->borders[i].top, .foot = band->borders[end - 1].foot, .border = i};
    find_sides(band, &band->chains[band->borders[i].chain], run);
  }
}

enum { DIGIT = 9, DIGITS = 1 << DIGIT };

/* Sorts by one digit of the tops; equal ones keep their order. */
static void sort_digit(const pf_run *from, pf_run *to, uint32_t count, int shift) {
  uint32_t places[DIGITS + 1] = {0};
  for (uint32_t i = 0; i < count; i++)
    places[((uint32_t)from[i].top >> shift & (DIGITS - 1)) + 1]++;
  for (int i = 0; i < DIGITS; i++)
    places[i + 1] += places[i];
  for (uint32_t i = 0; i < count; i++)
    to[places[(uint32_t)from[i].top >> shift & (DIGITS - 1)]++] = from[i];
}

bool pf_band_make_runs(const pf_memory *memory, pf_band *out) {
  uint32_t chains = out->band.chain_count;
  pf_run *runs = pf_make(memory, sizeof *runs, chains);
  out->runs = pf_make(memory, sizeof *out->runs, chains);
  out->run_capacity = chains;
  if (runs && out->runs) {
    find_runs(out, runs);
    sort_digit(runs, out->runs, out->run_count, 0);
    sort_digit(out->runs, runs, out->run_count, DIGIT);
    sort_digit(runs, out->runs, out->run_count, 2 * DIGIT);
  }
  bool is_done = runs && out->runs;
  pf_free(memory, runs, sizeof *runs, chains);
  return is_done;
}
