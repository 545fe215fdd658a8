#include "match.h"

enum { TRIED = 32 }; /* chains of one print, at most */

/* Two cells, and how many borders are between them and others. */
struct pf_pair {
  uint32_t theirs, ours, count;
  bool is_same; /* in all but where axes lie */
};

struct pf_known {
  pf_print print;
  uint32_t number; /* the number of a cell or a chain of the base */
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

/* The steps of the grid from one point to another. */
static int64_t across(planefile_grid grid, int32_t to, int32_t from) {
  return planefile_step_at(to, grid.columns) - planefile_step_at(from, grid.columns);
}
static int64_t down(planefile_grid grid, int32_t to, int32_t from) {
  return planefile_step_at(to, grid.rows) - planefile_step_at(from, grid.rows);
}

/* The pieces of a chain, as moves from its first point. */
static pf_print print_chain(key *k, planefile_grid grid, const planefile_band *band, uint32_t piece,
                            uint32_t end) {
  const planefile_point *start = &band->points[band->pieces[piece].point];
  for (uint32_t i = piece; i < end; i++) {
    const planefile_piece *of = &band->pieces[i];
    add_number(k, of->degree | (of->is_rational ? PF_RATIONAL : 0));
    for (uint32_t at = of->point; at <= of->point + of->degree; at++) {
      add_number(k, (uint32_t)across(grid, band->points[at].x, start->x));
      add_number(k, (uint32_t)down(grid, band->points[at].y, start->y));
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

/* Takes back pairs of axes, the latest `count` of them. */
static void part_axes(pf_match *m, uint32_t count) {
  for (; count > 0; count--) {
    uint32_t ours = m->paired[--m->paired_count];
    m->plane_axes[m->axes[ours]] = PF_NONE;
    m->axes[ours] = PF_NONE;
  }
}

/* Pairs the axes of two programs of the same form. False: an axis of one of them would stand for
 * two axes of the other; then no axis is paired. */
static bool pair_axes(pf_match *m, planefile_program theirs, planefile_program ours) {
  uint32_t before = m->paired_count;
  for (uint32_t i = 0; i < theirs.step_count; i++) {
    const planefile_step *step = &m->base->band->steps[theirs.step + i];
    uint32_t axis = m->plane->steps[ours.step + i].axis;
    if (step->kind != PLANEFILE_RAMP || m->axes[axis] == step->axis)
      continue;
    if (m->axes[axis] != PF_NONE || m->plane_axes[step->axis] != PF_NONE) {
      part_axes(m, m->paired_count - before);
      return false;
    }
    m->axes[axis] = step->axis;
    m->plane_axes[step->axis] = axis;
    m->paired[m->paired_count++] = axis;
  }
  return true;
}

/* Pairs a cell of the base with one of the same form, if it can stand for it. */
static bool pair_cells(pf_match *m, uint32_t theirs, uint32_t ours) {
  if (m->plane_cells[theirs] != PF_NONE ||
      !pair_axes(m, program_of(m->base->band, theirs), program_of(m->plane, ours)))
    return false;
  m->cells[ours] = theirs;
  m->plane_cells[theirs] = ours;
  return true;
}

static void match_cell(pf_match *m, const pf_known *known, const pf_print *print, uint32_t cell) {
  uint32_t count = m->base->band->cell_count, at = find_known(known, count, print);
  for (uint32_t i = at; i < count && i - at < TRIED; i++)
    if (compare_prints(&known[i].print, print) != 0 || pair_cells(m, known[i].number, cell))
      return;
}

static bool find_same(pf_match *m, key *k) {
  const planefile_band *band = m->base->band;
  pf_known *known = pf_make(&m->memory, sizeof *known, band->cell_count);
  if (!known)
    return false;
  for (uint32_t i = 0; i < band->cell_count && !k->failed; i++)
    known[i] = (pf_known){print_cell(k, band, i), i};
  sort_known(known, band->cell_count);
  for (uint32_t i = 0; i < m->plane->cell_count && !k->failed; i++) {
    pf_print print = print_cell(k, m->plane, i);
    if (m->cells[i] == PF_NONE)
      match_cell(m, known, &print, i);
  }
  pf_free(&m->memory, known, sizeof *known, band->cell_count);
  return !k->failed;
}

/* ---------------------------------------------------------------- cells beside chains */

/* Whether an axis can become another one by a patch. */
static bool can_become(const planefile_axis *from, const planefile_axis *to) {
  return from->kind == to->kind && from->wrap == to->wrap && from->filter == to->filter &&
         from->picture == to->picture && from->focus == to->focus &&
         memcmp(from->p, to->p, 2 * sizeof *to->p) == 0 &&
         memcmp(from->q, to->q, 2 * sizeof *to->q) == 0 &&
         memcmp(from->w, to->w, 2 * sizeof *to->w) == 0 &&
         pf_axis_is_affine(from) == pf_axis_is_affine(to);
}

/* Whether steps differ in colours alone. */
static bool are_alike(const pf_match *m, const planefile_step *a, const planefile_step *b) {
  if (a->kind != b->kind || a->how != b->how || a->kind != PLANEFILE_RAMP)
    return a->kind == b->kind && a->how == b->how;
  bool is_good = a->stop_count == b->stop_count &&
                 can_become(&m->base->band->axes[a->axis], &m->plane->axes[b->axis]);
  for (uint32_t i = 0; is_good && i < a->stop_count; i++)
    is_good = m->base->band->stops[a->stop + i].at == m->plane->stops[b->stop + i].at;
  return is_good;
}

/* Whether the program of one cell becomes that of another one when its colours change and its axes
 * move. */
static bool can_recolour(const pf_match *m, uint32_t theirs, uint32_t ours) {
  planefile_program a = program_of(m->base->band, theirs), b = program_of(m->plane, ours);
  bool is_good = a.step_count == b.step_count;
  for (uint32_t i = 0; is_good && i < a.step_count; i++)
    is_good = are_alike(m, &m->base->band->steps[a.step + i], &m->plane->steps[b.step + i]);
  return is_good;
}

static bool is_same_colour(const planefile_cell *a, const planefile_cell *b) {
  return memcmp(a, b, sizeof *a) == 0;
}

/* Whether steps that are alike have the same colours. */
static bool are_same(const pf_match *m, const planefile_step *a, const planefile_step *b) {
  bool is_same = a->kind == PLANEFILE_RAMP || is_same_colour(&a->colour, &b->colour);
  for (uint32_t i = 0; a->kind == PLANEFILE_RAMP && is_same && i < a->stop_count; i++)
    is_same = is_same_colour(&m->base->band->stops[a->stop + i].colour,
                             &m->plane->stops[b->stop + i].colour);
  return is_same;
}

/* Of cells, one of which can be the other one with other colours. */
static bool have_same_colours(const pf_match *m, uint32_t theirs, uint32_t ours) {
  planefile_program a = program_of(m->base->band, theirs), b = program_of(m->plane, ours);
  bool is_same = is_same_colour(&m->base->band->cells[theirs], &m->plane->cells[ours]);
  for (uint32_t i = 0; is_same && i < a.step_count; i++)
    is_same = are_same(m, &m->base->band->steps[a.step + i], &m->plane->steps[b.step + i]);
  return is_same;
}

/* Whether the axes of a program of the base stand for those of another one of the same form. */
static bool have_axes(const pf_match *m, uint32_t theirs, uint32_t ours) {
  planefile_program a = program_of(m->base->band, theirs), b = program_of(m->plane, ours);
  bool is_good = true;
  for (uint32_t i = 0; is_good && i < a.step_count; i++) {
    const planefile_step *step = &m->base->band->steps[a.step + i];
    is_good =
        step->kind != PLANEFILE_RAMP || m->axes[m->plane->steps[b.step + i].axis] == step->axis;
  }
  return is_good;
}

pf_fate pf_match_fate(const pf_match *m, uint32_t theirs) {
  uint32_t ours = m->plane_cells[theirs];
  if (ours == PF_NONE)
    return PF_SAME;
  if (!can_recolour(m, theirs, ours) || !have_axes(m, theirs, ours))
    return PF_REPLACED;
  return have_same_colours(m, theirs, ours) ? PF_SAME : PF_RECOLOURED;
}

bool pf_match_note(pf_match *m, uint32_t theirs, uint32_t ours) {
  pf_pair *pairs =
      pf_grow(&m->memory, m->pairs, sizeof *pairs, &m->pair_capacity, m->pair_count + 1);
  if (!pairs)
    return false;
  m->pairs = pairs;
  pairs[m->pair_count++] = (pf_pair){theirs, ours, 1, false};
  return true;
}

static int compare_pairs(const void *first, const void *second) {
  const pf_pair *a = first, *b = second;
  int by_theirs = pf_order(a->theirs, b->theirs);
  return by_theirs ? by_theirs : pf_order(a->ours, b->ours);
}

/* Those that are the same come first, then those that are noted most. */
static int compare_worth(const void *first, const void *second) {
  const pf_pair *a = first, *b = second;
  if (a->is_same != b->is_same)
    return a->is_same ? -1 : 1;
  return a->count != b->count ? pf_order(b->count, a->count) : compare_pairs(a, b);
}

/* Leaves each pair once. */
static void join_pairs(pf_match *m) {
  size_t count = 0;
  for (size_t i = 0; i < m->pair_count; i++)
    if (count > 0 && compare_pairs(&m->pairs[count - 1], &m->pairs[i]) == 0)
      m->pairs[count - 1].count++;
    else
      m->pairs[count++] = m->pairs[i];
  m->pair_count = count;
}

/* Pairs cells, and their axes where one becomes the other by that. */
static void pair_noted(pf_match *m, const pf_pair *pair) {
  if (m->plane_cells[pair->theirs] != PF_NONE || m->cells[pair->ours] != PF_NONE)
    return;
  if (can_recolour(m, pair->theirs, pair->ours) && pair_cells(m, pair->theirs, pair->ours))
    return;
  m->cells[pair->ours] = pair->theirs;
  m->plane_cells[pair->theirs] = pair->ours;
}

bool pf_match_cells(pf_match *m) {
  key k = {.memory = &m->memory};
  m->cells[0] = m->plane_cells[0] = 0;
  if (m->pair_count > 0)
    qsort(m->pairs, m->pair_count, sizeof *m->pairs, compare_pairs);
  join_pairs(m);
  for (size_t i = 0; i < m->pair_count; i++) {
    pf_pair *pair = &m->pairs[i];
    pair->is_same =
        can_recolour(m, pair->theirs, pair->ours) && have_same_colours(m, pair->theirs, pair->ours);
  }
  if (m->pair_count > 0)
    qsort(m->pairs, m->pair_count, sizeof *m->pairs, compare_worth);
  for (size_t i = 0; i < m->pair_count; i++)
    pair_noted(m, &m->pairs[i]);
  bool is_done = find_same(m, &k);
  pf_free(&m->memory, k.bytes, 1, k.capacity);
  return is_done;
}

/* ---------------------------------------------------------------- chains */

/* The forms of the pieces of a chain, with their weights. */
static pf_print print_forms(key *k, const planefile_band *band, uint32_t piece, uint32_t end) {
  for (uint32_t i = piece; i < end; i++) {
    const planefile_piece *of = &band->pieces[i];
    add_number(k, of->degree | (of->is_rational ? PF_RATIONAL : 0));
    for (uint32_t at = of->point; of->is_rational && at <= of->point + of->degree; at++)
      add_number(k, band->points[at].w);
  }
  return take_print(k);
}

static bool find_chains(pf_match *m, key *k) {
  const planefile_band *band = m->base->band;
  m->chains = pf_make(&m->memory, sizeof *m->chains, band->chain_count);
  m->forms = pf_make(&m->memory, sizeof *m->forms, band->chain_count);
  for (uint32_t i = 0; m->chains && m->forms && i < band->chain_count && !k->failed; i++) {
    uint32_t piece = band->chains[i].piece, end = piece + band->chains[i].piece_count;
    m->chains[i] = (pf_known){print_chain(k, m->grid, band, piece, end), i};
    m->forms[i] = (pf_known){print_forms(k, band, piece, end), i};
  }
  if (!m->chains || !m->forms || k->failed)
    return false;
  sort_known(m->chains, band->chain_count);
  sort_known(m->forms, band->chain_count);
  return true;
}

/* About the bits of a number. */
static uint32_t bits_of(int64_t number) {
  return 2 + pf_class_of((uint32_t)(number < 0 ? -number : number));
}

/* About the bits of the moves of some pieces, as they are, or from those of a chain of the base. */
static uint32_t price(const pf_match *m, uint32_t piece, uint32_t end,
                      const planefile_chain *from) {
  const planefile_band *plane = m->plane, *base = m->base->band;
  uint32_t bits = 0;
  for (uint32_t i = piece; i < end; i++) {
    const planefile_point *to = &plane->points[plane->pieces[i].point], *old = NULL;
    if (from)
      old = &base->points[base->pieces[from->piece + i - piece].point];
    for (int k = 0; k < plane->pieces[i].degree; k++) {
      int64_t x = across(m->grid, to[k + 1].x, to[k].x), y = down(m->grid, to[k + 1].y, to[k].y);
      if (old) {
        x -= across(m->grid, old[k + 1].x, old[k].x);
        y -= down(m->grid, old[k + 1].y, old[k].y);
      }
      bits += bits_of(x) + bits_of(y);
    }
  }
  return bits;
}

bool pf_match_bent(const pf_match *m, uint32_t piece, uint32_t end, const pf_link *latest,
                   pf_link *out) {
  enum { TRIED_FORMS = 256, WORTH = 16 }; /* bits */
  key k = {.memory = &m->memory};
  pf_print print = print_forms(&k, m->plane, piece, end);
  pf_free(&m->memory, k.bytes, 1, k.capacity);
  uint32_t count = m->base->band->chain_count, at = find_known(m->forms, count, &print);
  uint32_t least = price(m, piece, end, NULL);
  least = least > WORTH ? least - WORTH : 0;
  for (uint32_t i = at; i < count && i - at < TRIED_FORMS && !k.failed; i++) {
    if (compare_prints(&m->forms[i].print, &print) != 0)
      break;
    uint32_t number = m->forms[i].number;
    uint32_t bits = price(m, piece, end, &m->base->band->chains[number]) +
                    bits_of((int64_t)number - latest->chain);
    if (bits >= least)
      continue;
    least = bits;
    *out = (pf_link){PF_BENT, number, {0, 0}};
  }
  return !k.failed;
}

static pf_move find_move(const pf_match *m, uint32_t chain, const planefile_point *to) {
  const planefile_band *band = m->base->band;
  const planefile_point *from = &band->points[band->pieces[band->chains[chain].piece].point];
  return (pf_move){(int32_t)across(m->grid, to->x, from->x),
                   (int32_t)down(m->grid, to->y, from->y)};
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
  pf_print print = print_chain(&k, m->grid, m->plane, piece, end);
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
                   planefile_grid grid, pf_match *out) {
  *out = (pf_match){.memory = *memory, .plane = plane, .base = base, .grid = grid};
  out->cells = make_empty(memory, plane->cell_count);
  out->axes = make_empty(memory, plane->axis_count);
  out->plane_cells = make_empty(memory, base->band->cell_count);
  out->plane_axes = make_empty(memory, base->band->axis_count);
  out->paired = pf_make(memory, sizeof *out->paired, plane->axis_count);
  key k = {.memory = &out->memory};
  bool is_made = out->cells && out->axes && out->plane_cells && out->plane_axes && out->paired &&
                 find_chains(out, &k);
  pf_free(memory, k.bytes, 1, k.capacity);
  return is_made;
}

void pf_match_free(pf_match *m) {
  if (!m->base)
    return;
  const planefile_band *band = m->base->band;
  pf_free(&m->memory, m->cells, sizeof *m->cells, m->plane->cell_count);
  pf_free(&m->memory, m->axes, sizeof *m->axes, m->plane->axis_count);
  pf_free(&m->memory, m->paired, sizeof *m->paired, m->plane->axis_count);
  pf_free(&m->memory, m->plane_cells, sizeof *m->plane_cells, band->cell_count);
  pf_free(&m->memory, m->plane_axes, sizeof *m->plane_axes, band->axis_count);
  pf_free(&m->memory, m->chains, sizeof *m->chains, band->chain_count);
  pf_free(&m->memory, m->forms, sizeof *m->forms, band->chain_count);
  pf_free(&m->memory, m->pairs, sizeof *m->pairs, m->pair_capacity);
}
