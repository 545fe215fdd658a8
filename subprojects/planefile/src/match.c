#include "match.h"

enum { TRIED = 32 }; /* chains of one print, at most */

struct pf_known {
  pf_print print;
  uint32_t number; /* of a cell or a chain of the base */
};

/* ---------------------------------------------------------------- prints */

/* Something to be compared, as bytes. */
typedef struct key {
  const pf_memory *memory;
  unsigned char *bytes;
  size_t count, capacity;
  bool failed;
} key;

static void add(key *k, const void *bytes, size_t size) {
  unsigned char *room = pf_grow(k->memory, k->bytes, 1, &k->capacity, k->count + size);
  k->failed |= room == NULL;
  if (!room)
    return;
  k->bytes = room;
  memcpy(room + k->count, bytes, size);
  k->count += size;
}

static void add_number(key *k, uint32_t number) { add(k, &number, sizeof number); }

static pf_print take_print(key *k) {
  pf_print print = pf_print_of(k->bytes, k->count, 0);
  k->count = 0;
  return print;
}

/* The pieces of a chain, as moves from its first point. */
static pf_print print_chain(key *k, const planefile_band *band, uint32_t piece, uint32_t end) {
  const planefile_point *start = &band->points[band->pieces[piece].point];
  for (uint32_t i = piece; i < end; i++) {
    const planefile_piece *of = &band->pieces[i];
    add_number(k, of->degree | (of->is_rational ? PF_RATIONAL : 0));
    for (uint32_t at = of->point; at <= of->point + of->degree; at++) {
      add_number(k, (uint32_t)band->points[at].x - (uint32_t)start->x);
      add_number(k, (uint32_t)band->points[at].y - (uint32_t)start->y);
      if (of->is_rational)
        add_number(k, band->points[at].w);
    }
  }
  return take_print(k);
}

/* An axis wherever it has been moved to. */
static void add_axis(key *k, const planefile_axis *axis) {
  uint32_t kind = axis->kind | (uint32_t)pf_axis_is_affine(axis) << 8 | (uint32_t)axis->wrap << 16 |
                  (uint32_t)axis->filter << 24;
  add_number(k, kind);
  add(k, axis->p, 2 * sizeof *axis->p);
  add(k, axis->q, 2 * sizeof *axis->q);
  add(k, axis->w, 2 * sizeof *axis->w);
  add(k, &axis->focus, sizeof axis->focus);
  add(k, &axis->picture, sizeof axis->picture);
}

static void add_step(key *k, const planefile_band *band, const planefile_step *step) {
  add_number(k, step->kind | (uint32_t)step->how << 8);
  add(k, step->colour.colour, sizeof step->colour.colour);
  if (step->kind != PLANEFILE_RAMP)
    return;
  add_number(k, step->stop_count);
  add_axis(k, &band->axes[step->axis]);
  for (uint32_t i = step->stop; i < step->stop + step->stop_count; i++) {
    add(k, &band->stops[i].at, sizeof band->stops[i].at);
    add(k, band->stops[i].colour.colour, sizeof band->stops[i].colour.colour);
  }
}

static planefile_program program_of(const planefile_band *band, uint32_t cell) {
  return band->programs ? band->programs[cell] : (planefile_program){0, 0};
}

static pf_print print_cell(key *k, const planefile_band *band, uint32_t cell) {
  planefile_program program = program_of(band, cell);
  add_number(k, program.step_count);
  add(k, band->cells[cell].colour, sizeof band->cells[cell].colour);
  for (uint32_t i = program.step; i < program.step + program.step_count; i++)
    add_step(k, band, &band->steps[i]);
  return take_print(k);
}

/* ---------------------------------------------------------------- order */

static int compare_prints(const pf_print *a, const pf_print *b) { return memcmp(a, b, sizeof *a); }

static int compare_known(const void *first, const void *second) {
  const pf_known *a = first, *b = second;
  int by_print = compare_prints(&a->print, &b->print);
  return by_print ? by_print : (a->number > b->number) - (a->number < b->number);
}

static void sort_known(pf_known *known, uint32_t count) {
  if (count > 0)
    qsort(known, count, sizeof *known, compare_known);
}

/* The first one with a print, or where it would be. */
static uint32_t find_known(const pf_known *known, uint32_t count, const pf_print *print) {
  uint32_t low = 0;
  while (low < count) {
    uint32_t middle = low + (count - low) / 2;
    if (compare_prints(&known[middle].print, print) < 0)
      low = middle + 1;
    else
      count = middle;
  }
  return low;
}

/* ---------------------------------------------------------------- cells */

static bool can_be_axis(const pf_match *m, uint32_t theirs, uint32_t ours) {
  return m->plane_axes[theirs] == ours ||
         (m->plane_axes[theirs] == PF_NONE && m->axes[ours] == PF_NONE);
}

/* Whether a cell of the base can stand for one with the same print. */
static bool can_be(const pf_match *m, uint32_t theirs, uint32_t ours) {
  planefile_program a = program_of(m->base->band, theirs), b = program_of(m->plane, ours);
  bool is_good = m->plane_cells[theirs] == PF_NONE;
  for (uint32_t i = 0; is_good && i < a.step_count; i++) {
    const planefile_step *step = &m->base->band->steps[a.step + i];
    if (step->kind == PLANEFILE_RAMP)
      is_good = can_be_axis(m, step->axis, m->plane->steps[b.step + i].axis);
  }
  return is_good;
}

static void pair_cells(pf_match *m, uint32_t theirs, uint32_t ours) {
  planefile_program a = program_of(m->base->band, theirs), b = program_of(m->plane, ours);
  m->cells[ours] = theirs;
  m->plane_cells[theirs] = ours;
  for (uint32_t i = 0; i < a.step_count; i++) {
    const planefile_step *step = &m->base->band->steps[a.step + i];
    uint32_t axis = m->plane->steps[b.step + i].axis;
    if (step->kind != PLANEFILE_RAMP)
      continue;
    m->axes[axis] = step->axis;
    m->plane_axes[step->axis] = axis;
  }
}

static void match_cell(pf_match *m, const pf_known *known, const pf_print *print, uint32_t cell) {
  uint32_t count = m->base->band->cell_count, at = find_known(known, count, print);
  for (uint32_t i = at; i < count && i - at < TRIED; i++) {
    if (compare_prints(&known[i].print, print) != 0)
      return;
    if (can_be(m, known[i].number, cell)) {
      pair_cells(m, known[i].number, cell);
      return;
    }
  }
}

/* Cell 0 comes first, and of the base's equal ones it gets cell 0. */
static void match_cells(pf_match *m, const pf_known *known, key *k) {
  for (uint32_t i = 0; i < m->plane->cell_count && !k->failed; i++) {
    pf_print print = print_cell(k, m->plane, i);
    match_cell(m, known, &print, i);
  }
}

static bool find_cells(pf_match *m, key *k) {
  const planefile_band *band = m->base->band;
  pf_known *known = pf_make(&m->memory, sizeof *known, band->cell_count);
  if (!known)
    return false;
  for (uint32_t i = 0; i < band->cell_count && !k->failed; i++)
    known[i] = (pf_known){print_cell(k, band, i), i};
  sort_known(known, band->cell_count);
  match_cells(m, known, k);
  pf_free(&m->memory, known, sizeof *known, band->cell_count);
  return !k->failed;
}

/* ---------------------------------------------------------------- chains */

static bool find_chains(pf_match *m, key *k) {
  const planefile_band *band = m->base->band;
  m->chains = pf_make(&m->memory, sizeof *m->chains, band->chain_count);
  for (uint32_t i = 0; m->chains && i < band->chain_count && !k->failed; i++) {
    const planefile_chain *chain = &band->chains[i];
    pf_print print = print_chain(k, band, chain->piece, chain->piece + chain->piece_count);
    m->chains[i] = (pf_known){print, i};
  }
  if (!m->chains || k->failed)
    return false;
  sort_known(m->chains, band->chain_count);
  return true;
}

static pf_move find_move(const pf_match *m, uint32_t chain, const planefile_point *to) {
  const planefile_band *band = m->base->band;
  const planefile_point *from = &band->points[band->pieces[band->chains[chain].piece].point];
  return (pf_move){to->x - from->x, to->y - from->y};
}

/* Whether a chain of the base is better than what has been found. */
static bool is_better(const pf_link *found, const pf_link *latest, uint32_t chain, pf_move move) {
  bool is_alike = move.x == latest->move.x && move.y == latest->move.y;
  return found->origin == PF_NEW || is_alike ||
         (found->chain <= latest->chain && chain > latest->chain);
}

static void choose_chain(const pf_match *m, const pf_print *print, const planefile_point *to,
                         const pf_link *latest, pf_link *out) {
  uint32_t count = m->base->band->chain_count, at = find_known(m->chains, count, print);
  for (uint32_t i = at; i < count && i - at < TRIED; i++) {
    if (compare_prints(&m->chains[i].print, print) != 0)
      return;
    pf_move move = find_move(m, m->chains[i].number, to);
    if (is_better(out, latest, m->chains[i].number, move))
      *out = (pf_link){PF_MOVED, m->chains[i].number, move};
    if (out->move.x == latest->move.x && out->move.y == latest->move.y)
      return;
  }
}

bool pf_match_chain(const pf_match *m, uint32_t piece, uint32_t end, const pf_link *latest,
                    pf_link *out) {
  key k = {.memory = &m->memory};
  pf_print print = print_chain(&k, m->plane, piece, end);
  pf_free(&m->memory, k.bytes, 1, k.capacity);
  *out = (pf_link){PF_NEW, 0, {0, 0}};
  if (k.failed)
    return false;
  choose_chain(m, &print, &m->plane->points[m->plane->pieces[piece].point], latest, out);
  return true;
}

/* ---------------------------------------------------------------- life */

static uint32_t *make_empty(const pf_memory *memory, size_t count) {
  uint32_t *out = pf_make(memory, sizeof *out, count);
  for (size_t i = 0; out && i < count; i++)
    out[i] = PF_NONE;
  return out;
}

bool pf_match_make(const pf_memory *memory, const planefile_band *plane, const pf_base *base,
                   pf_match *out) {
  *out = (pf_match){.memory = *memory, .plane = plane, .base = base};
  out->cells = make_empty(memory, plane->cell_count);
  out->axes = make_empty(memory, plane->axis_count);
  out->plane_cells = make_empty(memory, base->band->cell_count);
  out->plane_axes = make_empty(memory, base->band->axis_count);
  key k = {.memory = &out->memory};
  bool is_made = out->cells && out->axes && out->plane_cells && out->plane_axes &&
                 find_cells(out, &k) && find_chains(out, &k);
  pf_free(memory, k.bytes, 1, k.capacity);
  return is_made;
}

void pf_match_free(pf_match *m) {
  if (!m->base)
    return;
  const planefile_band *band = m->base->band;
  pf_free(&m->memory, m->cells, sizeof *m->cells, m->plane->cell_count);
  pf_free(&m->memory, m->axes, sizeof *m->axes, m->plane->axis_count);
  pf_free(&m->memory, m->plane_cells, sizeof *m->plane_cells, band->cell_count);
  pf_free(&m->memory, m->plane_axes, sizeof *m->plane_axes, band->axis_count);
  pf_free(&m->memory, m->chains, sizeof *m->chains, band->chain_count);
}
