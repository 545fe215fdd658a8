/* A band to its code.
 *
 *   borders --by chain--> chains of the band --by x--> numbered --> code of curves
 *                                      \--their changes, by height, in groups--> code of changes
 *
 * Pieces of a chain of which nothing can be seen are left out, or one line where they are between
 * others; but not in a band that other frames may be made from, because they see other pieces.
 *
 * One file, because every step reads the chains and cells of the one packer.
 */
#include "match.h"

/* A chain of the band: its borders are neighbours in the list of all. */
typedef struct shown {
  const planefile_border *borders;
  uint32_t count;
  uint32_t piece, end; /* of its pieces that is needed, and after the last one */
  int64_t place;       /* twice its mean x */
  planefile_point start, end_at;
  pf_sides sides;
  int32_t top, foot; /* of what is kept of it */
  int32_t slope;
  bool is_whole; /* no piece is left out */
  pf_link link;
} shown;

/* From a height on a chain has other cells. */
typedef struct change {
  int32_t height;
  uint32_t chain; /* the chain of the band */
  pf_sides sides; /* the sides of the plane */
} change;

typedef struct packer {
  const pf_memory *memory;
  const planefile_band *plane;
  const pf_part *part;
  int32_t top, foot;
  pf_match match; /* with the base, if there is one */
  pf_link latest; /* of the latest chain that has one */
  pf_moves moves; /* that were coded */
  planefile_border *borders;
  shown *chains;
  change *changes;
  uint32_t *cells; /* of each cell of the plane: its number in the band plus 1; 0: none yet */
  size_t border_count, chain_count, change_count, change_capacity;
  uint32_t piece_count, cell_count;
  uint32_t fresh[2 * PF_GROUP], fresh_count; /* cells that are new in the current group */
  uint32_t form;
  pf_way way;            /* the latest move of the chain, in steps */
  planefile_cell colour; /* the colour of the latest cell */
  pf_models models;
  pf_program_coding *programs; /* NULL: nothing varies */
  pf_encoder *out;
} packer;

/* ---------------------------------------------------------------- order */

static int order_of(int64_t a, int64_t b) { return (a > b) - (a < b); }

static int compare_borders(const void *first, const void *second) {
  const planefile_border *a = first, *b = second;
  int by_chain = order_of(a->chain, b->chain);
  return by_chain ? by_chain : order_of(a->top, b->top);
}

static int compare_chains(const void *first, const void *second) {
  const shown *a = first, *b = second;
  int by_place = order_of(a->place, b->place);
  return by_place ? by_place : order_of(a->borders->chain, b->borders->chain);
}

static int compare_changes(const void *first, const void *second) {
  const change *a = first, *b = second;
  int by_height = order_of(a->height, b->height);
  return by_height ? by_height : order_of(a->chain, b->chain);
}

/* ---------------------------------------------------------------- chains */

static const planefile_point *first_of(const packer *p, uint32_t piece) {
  return &p->plane->points[p->plane->pieces[piece].point];
}
static const planefile_point *last_of(const packer *p, uint32_t piece) {
  const planefile_piece *of = &p->plane->pieces[piece];
  return &p->plane->points[of->point + of->degree];
}

/* Whether a piece has a part of the heights of one of a chain's borders; *from: that border, or one
 * before it. */
static bool is_needed(const packer *p, const shown *c, uint32_t piece, uint32_t *from) {
  int32_t top = first_of(p, piece)->y, foot = last_of(p, piece)->y;
  while (*from < c->count && c->borders[*from].foot <= top)
    ++*from;
  return *from < c->count && c->borders[*from].top < foot && top < foot;
}

/* Whether a piece has a part of the heights of the band, or of those outside the frame. */
static bool is_near(const packer *p, uint32_t piece) {
  return (p->foot == PLANEFILE_SIDE || first_of(p, piece)->y < p->foot) &&
         (p->top == 0 || last_of(p, piece)->y >= p->top);
}

/* Finds which pieces of a chain are kept. */
static void trim(const packer *p, shown *c) {
  const planefile_chain *chain = &p->plane->chains[c->borders->chain];
  uint32_t end = chain->piece + chain->piece_count, border = 0;
  c->piece = c->end = end;
  for (uint32_t i = chain->piece; i < end; i++)
    if (c->is_whole ? is_near(p, i) : is_needed(p, c, i, &border)) {
      c->piece = c->piece < i ? c->piece : i;
      c->end = i + 1;
    }
  const planefile_point *first = first_of(p, c->piece), *last = last_of(p, c->end - 1);
  c->top = first->y > p->top ? first->y : p->top;
  c->foot = last->y < p->foot ? last->y : p->foot;
  c->place = (int64_t)first->x + last->x;
  c->start = *first;
  c->end_at = *last;
}

/* Goes on to the first piece that is needed; returns where the ones before it end, or NULL. */
static const planefile_point *pass_hidden(const packer *p, const shown *c, uint32_t *piece,
                                          uint32_t *border) {
  const planefile_point *end = NULL;
  for (; !c->is_whole && !is_needed(p, c, *piece, border); ++*piece)
    end = last_of(p, *piece);
  return end;
}

/* How many pieces a chain has, of which some stand for several ones that are hidden. */
static uint32_t count_pieces(const packer *p, const shown *c) {
  uint32_t count = 0, border = 0;
  for (uint32_t i = c->piece; i < c->end; count++)
    i += pass_hidden(p, c, &i, &border) == NULL;
  return count;
}

/* Finds what a chain has in common with one of the base, to which all of its pieces count. */
static bool link_chain(packer *p, shown *c) {
  c->is_whole = true;
  trim(p, c);
  if (p->part->is_whole)
    return true;
  if (!pf_match_chain(&p->match, c->piece, c->end, &p->latest, &c->link))
    return false;
  if (c->link.origin != PF_NEW) {
    p->latest = c->link;
    return true;
  }
  c->is_whole = false;
  trim(p, c);
  return count_pieces(p, c) < c->end - c->piece ||
         pf_match_bent(&p->match, c->piece, c->end, &p->latest, &c->link);
}

/* Clips the borders to the band and finds its chains. */
static bool find_chains(packer *p, const planefile_border *borders, size_t count) {
  p->borders = pf_make(p->memory, sizeof *p->borders, count);
  p->chains = pf_make(p->memory, sizeof *p->chains, count);
  p->border_count = count;
  if (!p->borders || !p->chains)
    return false;
  for (size_t i = 0; i < count; i++) {
    planefile_border *b = &p->borders[i];
    *b = borders[i];
    b->top = b->top > p->top ? b->top : p->top;
    b->foot = b->foot < p->foot ? b->foot : p->foot;
  }
  qsort(p->borders, count, sizeof *p->borders, compare_borders);
  for (size_t i = 0; i < count; i++) {
    if (i == 0 || p->borders[i].chain != p->borders[i - 1].chain)
      p->chains[p->chain_count++] = (shown){.borders = &p->borders[i]};
    p->chains[p->chain_count - 1].count++;
  }
  for (size_t i = 0; i < p->chain_count; i++)
    if (!p->part->is_whole && !p->part->base)
      trim(p, &p->chains[i]);
    else if (!link_chain(p, &p->chains[i]))
      return false;
  qsort(p->chains, p->chain_count, sizeof *p->chains, compare_chains);
  return true;
}

static bool is_moved(const pf_link *link) {
  return link->origin == PF_MOVED || link->origin == PF_KEPT;
}

/* Notes which cells are where those of a chain of the base are. */
static bool note_cells(packer *p, const shown *c) {
  const pf_base *base = p->part->base;
  const planefile_band heights = {.top = p->top, .foot = p->foot};
  planefile_border moved;
  bool is_done = true;
  for (uint32_t i = base->first[c->link.chain], k = 0; i < base->first[c->link.chain + 1]; i++) {
    if (!pf_move_border(&base->band->borders[i], c->link.move.y, p->part->grid.rows, &heights,
                        &moved))
      continue;
    while (k < c->count && c->borders[k].foot <= moved.top)
      k++;
    for (; k < c->count && c->borders[k].top < moved.foot; k++)
      is_done = is_done && pf_match_note(&p->match, moved.left, c->borders[k].left) &&
                pf_match_note(&p->match, moved.right, c->borders[k].right);
    k -= k > 0 && c->borders[k - 1].foot > moved.foot;
  }
  return is_done;
}

static bool match_cells(packer *p) {
  for (size_t i = 0; i < p->chain_count; i++)
    if (is_moved(&p->chains[i].link) && !note_cells(p, &p->chains[i]))
      return false;
  return pf_match_cells(&p->match);
}

/* Whether a chain's borders are those of the base, moved. */
static bool keeps_borders(const packer *p, const shown *c) {
  const pf_base *base = p->part->base;
  const planefile_band heights = {.top = p->top, .foot = p->foot};
  planefile_border moved;
  uint32_t k = 0;
  for (uint32_t i = base->first[c->link.chain]; i < base->first[c->link.chain + 1]; i++) {
    if (!pf_move_border(&base->band->borders[i], c->link.move.y, p->part->grid.rows, &heights,
                        &moved))
      continue;
    const planefile_border *b = &c->borders[k];
    if (k++ == c->count || b->top != moved.top || b->foot != moved.foot ||
        p->match.cells[b->left] != moved.left || p->match.cells[b->right] != moved.right)
      return false;
  }
  return k == c->count;
}

/* ---------------------------------------------------------------- changes */

static bool add_change(packer *p, int32_t height, size_t chain, pf_sides sides) {
  change *changes =
      pf_grow(p->memory, p->changes, sizeof *changes, &p->change_capacity, p->change_count + 1);
  if (!changes)
    return false;
  p->changes = changes;
  p->changes[p->change_count++] = (change){height, (uint32_t)chain, sides};
  return true;
}

/* NULL: a cell has a program. */
static const planefile_cell *flat_cell(const packer *p, uint32_t cell) {
  bool is_flat = !p->plane->programs || p->plane->programs[cell].step_count == 0;
  return is_flat ? &p->plane->cells[cell] : NULL;
}

/* Finds the slope of a chain, of which the changes from one on are. */
static void find_slope(const packer *p, shown *c, size_t first) {
  enum { MOST = 32 };
  pf_beside list[MOST];
  size_t count = 0;
  pf_sides before = c->sides;
  for (size_t i = first; i < p->change_count && count < MOST; before = p->changes[i++].sides) {
    pf_sides after = p->changes[i].sides;
    list[count++] = (pf_beside){{flat_cell(p, before.left), flat_cell(p, before.right)},
                                {flat_cell(p, after.left), flat_cell(p, after.right)},
                                0};
  }
  c->slope = pf_slope_find(list, count);
}

/* Finds what a chain begins with, and all that happens to it. */
static bool find_changes(packer *p, size_t index) {
  shown *c = &p->chains[index];
  size_t first = p->change_count;
  int32_t height = c->top;
  c->sides = (pf_sides){0, 0};
  if (c->link.origin == PF_MOVED && keeps_borders(p, c))
    c->link.origin = PF_KEPT;
  if (c->link.origin == PF_KEPT)
    return true;
  for (uint32_t i = 0; i < c->count; i++) {
    const planefile_border *b = &c->borders[i];
    pf_sides sides = {b->left, b->right};
    if (b->top > height && i > 0 &&
        !add_change(p, height, index, (pf_sides){c->borders[i - 1].left, c->borders[i - 1].left}))
      return false;
    if (b->top == c->top)
      c->sides = sides;
    else if (!add_change(p, b->top, index, sides))
      return false;
    height = b->foot;
  }
  const planefile_border *last = &c->borders[c->count - 1];
  if (height < c->foot && !add_change(p, height, index, (pf_sides){last->left, last->left}))
    return false;
  find_slope(p, c, first);
  return true;
}

/* ---------------------------------------------------------------- code of cells */

/* What happens to chains at one height. */
typedef struct group {
  uint32_t size;
  const change *changes;
  pf_sides before[PF_GROUP];
} group;

static void add_fresh(packer *p, uint32_t cell) {
  p->cells[cell] = ++p->cell_count;
  p->fresh[p->fresh_count++] = cell;
}

/* NULL: a cell has a program, or comes after the one that is being coded. */
static const planefile_cell *known_cell(const packer *p, uint32_t cell, uint32_t latest) {
  return p->cells[cell] <= p->cells[latest] ? flat_cell(p, cell) : NULL;
}

/* What a member of a group knows of a cell. */
static bool guess(const packer *p, const group *g, uint32_t member, uint32_t cell,
                  planefile_cell *out) {
  const pf_sides *was = &g->before[member], *is = &g->changes[member].sides;
  const pf_beside beside = {{known_cell(p, was->left, cell), known_cell(p, was->right, cell)},
                            {known_cell(p, is->left, cell), known_cell(p, is->right, cell)},
                            p->chains[g->changes[member].chain].slope};
  return pf_guess(&beside, &p->plane->cells[cell], out);
}

static int64_t distance(const planefile_cell *a, const planefile_cell *b) {
  int64_t out = 0;
  for (int c = 0; c < 4; c++) {
    int64_t way = (int64_t)a->colour[c] - b->colour[c];
    out += way < 0 ? -way : way;
  }
  return out;
}

/* Chooses what the channels of a cell differ from; returns whether that is a guess. */
static bool put_origin(packer *p, const group *g, uint32_t cell, planefile_cell *out) {
  const planefile_cell *of = &p->plane->cells[cell];
  planefile_cell guesses[PF_GUESSES + 1] = {p->colour};
  uint32_t count = 1, best = 0;
  for (uint32_t i = 0; i < g->size && count <= PF_GUESSES; i++)
    count += guess(p, g, i, cell, &guesses[count]);
  for (uint32_t i = 1; i < count; i++)
    if (distance(&guesses[i], of) < distance(&guesses[best], of))
      best = i;
  if (count > 1)
    pf_put_symbol(p->out, p->models.guesses, 2, best);
  *out = guesses[best];
  return best > 0;
}

/* The channels of a cell, or their codes, by how much they differ from those of another one. */
static void put_channels(packer *p, pf_number numbers[4], const planefile_cell *origin,
                         const planefile_cell *cell) {
  int32_t from[4], to[4];
  memcpy(from, origin->colour, sizeof from);
  memcpy(to, cell->colour, sizeof to);
  if (p->part->codes) {
    pf_codes_of(p->part->codes, origin, from);
    pf_codes_of(p->part->codes, cell, to);
  }
  for (int c = 0; c < 4; c++)
    pf_put_signed(p->out, &numbers[c], (int64_t)to[c] - from[c]);
}

static void put_content(packer *p, const group *g, uint32_t cell) {
  const planefile_cell *of = &p->plane->cells[cell];
  planefile_cell origin;
  if (p->programs) {
    pf_put_symbol(p->out, p->programs->models.varies, 1, !flat_cell(p, cell));
    if (!flat_cell(p, cell)) {
      pf_put_program(p->out, p->programs, p->plane, p->plane->programs[cell]);
      return;
    }
  }
  bool guessed = put_origin(p, g, cell, &origin);
  put_channels(p, p->models.channels[guessed], &origin, of);
  p->colour = *of;
}

static void put_contents(packer *p, const group *g) {
  for (uint32_t i = 0; i < p->fresh_count; i++)
    put_content(p, g, p->fresh[i]);
  p->fresh_count = 0;
}

/* Cells are numbers of the plane here, in candidates, too. */
static void put_cell(packer *p, const pf_near *near, unsigned context, uint32_t left,
                     uint32_t cell) {
  uint16_t *tree = p->models.cells[context];
  uint32_t symbol = PF_CANDIDATES, number = p->cells[cell];
  while (symbol < PF_SYMBOLS && pf_candidate(near, context & 1, left, symbol) != cell)
    symbol++;
  if (number == 0)
    symbol = PF_FRESH;
  else if (symbol == PF_SYMBOLS)
    symbol = PF_OLDER;
  pf_put_symbol(p->out, tree, PF_SYMBOL_BITS, symbol);
  if (symbol == PF_FRESH)
    add_fresh(p, cell);
  else if (symbol == PF_OLDER)
    pf_put_number(p->out, &p->models.older, p->cell_count - number);
}

static void put_sides(packer *p, const pf_near *near, unsigned context, pf_sides sides) {
  put_cell(p, near, context, 0, sides.left);
  put_cell(p, near, context + 1, sides.left, sides.right);
}

/* ---------------------------------------------------------------- code of curves */

static void put_weight(packer *p, uint32_t weight) {
  pf_put_signed(p->out, &p->models.weight, (int64_t)weight - PLANEFILE_WEIGHT);
}

/* Whether a move is coded as one that continues in the direction of the latest one. */
static bool is_smooth(const packer *p, const pf_way *way) {
  enum { NEAR = 8 }; /* three bits less than the move itself, or that many units */
  int axis = pf_main_axis(&p->way);
  int64_t along = way->by[axis] * pf_direction(p->way.by[axis]);
  int64_t off = way->by[!axis] - pf_go_on(&p->way, axis, along);
  return along > 0 && (pf_size(off) < NEAR || pf_size(off) < pf_size(way->by[!axis]) / NEAR);
}

static void put_smooth(packer *p, const pf_way *way) {
  int axis = pf_main_axis(&p->way);
  int64_t along = way->by[axis] * pf_direction(p->way.by[axis]);
  pf_put_number(p->out, &p->models.ahead, (uint32_t)along);
  pf_put_signed(p->out, &p->models.aside, way->by[!axis] - pf_go_on(&p->way, axis, along));
}

/* Differences of places, in steps: across, and down. */
static int64_t across(const packer *p, int32_t to, int32_t from) {
  uint16_t columns = p->part->grid.columns;
  return planefile_step_at(to, columns) - planefile_step_at(from, columns);
}
static int64_t down(const packer *p, int32_t to, int32_t from) {
  uint16_t rows = p->part->grid.rows;
  return planefile_step_at(to, rows) - planefile_step_at(from, rows);
}

static void put_move(packer *p, int degree, int point, planefile_point from, planefile_point to) {
  const pf_way way = {{across(p, to.x, from.x), down(p, to.y, from.y)}};
  bool may_be = point == 0 && pf_leads_on(&p->way), is = may_be && is_smooth(p, &way);
  if (may_be)
    pf_put_symbol(p->out, p->models.is_smooth, 1, is);
  if (is)
    put_smooth(p, &way);
  for (int axis = 0; axis < 2 && !is; axis++)
    pf_put_signed(p->out, &p->models.moves[axis][degree - 1][point],
                  way.by[axis] * pf_direction(p->way.by[axis]));
  p->way = way;
}

static void put_form(packer *p, uint32_t form) {
  pf_put_symbol(p->out, p->models.forms[p->form], 3, form);
  p->form = form;
}

/* is_known: where it ends is. */
static void put_piece(packer *p, uint32_t piece, bool is_known) {
  const planefile_piece *of = &p->plane->pieces[piece];
  const planefile_point *points = &p->plane->points[of->point];
  put_form(p, of->degree | (of->is_rational ? PF_RATIONAL : 0));
  if (of->is_rational)
    put_weight(p, points[0].w);
  for (int i = 0; i < of->degree; i++) {
    if (!is_known || i + 1 < of->degree)
      put_move(p, of->degree, i, points[i], points[i + 1]);
    if (of->is_rational)
      put_weight(p, points[i + 1].w);
  }
}

/* is_known: where the chain ends is. */
static void put_pieces(packer *p, const shown *c, bool is_known) {
  uint32_t border = 0;
  p->way = (pf_way){{0, 0}};
  for (uint32_t i = c->piece; i < c->end;) {
    const planefile_point *from = first_of(p, i), *to = pass_hidden(p, c, &i, &border);
    if (to) {
      put_form(p, 1);
      put_move(p, 1, 0, *from, *to);
    } else {
      put_piece(p, i, is_known && i + 1 == c->end);
      i++;
    }
  }
}

/* The cells at the top of a chain. own: what it had in the base. */
static void put_top(packer *p, size_t index, pf_sides own) {
  const shown *c = &p->chains[index];
  const pf_near near = {own, index > 1 ? c[-2].sides : (pf_sides){0, 0},
                        index > 0 ? c[-1].sides : (pf_sides){0, 0}};
  const group none = {0};
  put_sides(p, &near, PF_AT_TOP, c->sides);
  put_contents(p, &none);
  pf_put_signed(p->out, &p->models.slope, c->slope);
}

static bool is_same(planefile_point a, planefile_point b) { return a.x == b.x && a.y == b.y; }

/* How many chains before another one begins, or ends, at the same point; 0: none that is near. */
static uint32_t find_joint(const packer *p, size_t index, bool is_foot) {
  enum { NEAR = 256 };
  const shown *c = &p->chains[index];
  for (size_t back = 1; back <= index && back <= NEAR; back++)
    if (is_foot ? is_same(c[-(ptrdiff_t)back].end_at, c->end_at)
                : is_same(c[-(ptrdiff_t)back].start, c->start))
      return (uint32_t)back;
  return 0;
}

/* What a cell of the base is in the plane. */
static uint32_t plane_cell(const packer *p, uint32_t cell) { return p->match.plane_cells[cell]; }

/* Where a chain begins and, if another one ends there, where it ends; between them is what is put
 * there by the caller. */
static void put_start(packer *p, size_t index, const planefile_point *from) {
  const shown *c = &p->chains[index];
  uint32_t top = find_joint(p, index, false);
  pf_put_number(p->out, &p->models.from_top, top);
  if (top > 0)
    return;
  pf_put_signed(p->out, &p->models.start[0], across(p, c->start.x, from->x));
  pf_put_signed(p->out, &p->models.start[1], down(p, c->start.y, from->y));
}

static void put_new_chain(packer *p, size_t index, const planefile_point *from) {
  const shown *c = &p->chains[index];
  uint32_t pieces = count_pieces(p, c), foot = find_joint(p, index, true);
  put_start(p, index, from);
  pf_put_number(p->out, &p->models.pieces, pieces - 1);
  pf_put_number(p->out, &p->models.to_foot, foot);
  put_top(p, index, (pf_sides){0, 0});
  put_pieces(p, c, foot > 0);
  p->piece_count += pieces;
}

/* The moves of a piece, by how much they differ from those of one of the base. */
static void put_bent_piece(packer *p, uint32_t piece, uint32_t old, bool is_known) {
  const planefile_band *base = p->part->base->band;
  const planefile_point *to = &p->plane->points[p->plane->pieces[piece].point];
  const planefile_point *from = &base->points[base->pieces[old].point];
  for (int i = 0; i + is_known < p->plane->pieces[piece].degree; i++) {
    pf_put_signed(p->out, &p->models.bent[0],
                  across(p, to[i + 1].x, to[i].x) - across(p, from[i + 1].x, from[i].x));
    pf_put_signed(p->out, &p->models.bent[1],
                  down(p, to[i + 1].y, to[i].y) - down(p, from[i + 1].y, from[i].y));
  }
}

static void put_which(packer *p, const pf_link *link) {
  pf_put_signed(p->out, &p->models.which, (int64_t)link->chain - p->latest.chain);
  p->latest = *link;
  p->latest.chain++;
}

static void put_bent_chain(packer *p, size_t index, const planefile_point *from) {
  const shown *c = &p->chains[index];
  uint32_t first = p->part->base->band->chains[c->link.chain].piece;
  uint32_t foot = find_joint(p, index, true);
  pf_sides own = pf_base_sides(p->part->base, c->link.chain);
  put_which(p, &c->link);
  put_start(p, index, from);
  pf_put_number(p->out, &p->models.to_foot, foot);
  put_top(p, index, (pf_sides){plane_cell(p, own.left), plane_cell(p, own.right)});
  for (uint32_t i = c->piece; i < c->end; i++)
    put_bent_piece(p, i, first + i - c->piece, foot > 0 && i + 1 == c->end);
  p->piece_count += c->end - c->piece;
}

static bool is_same_move(pf_move a, pf_move b) { return a.x == b.x && a.y == b.y; }

static void put_shift(packer *p, pf_move move) {
  const pf_move *latest = p->moves.latest;
  uint32_t number = 0;
  while (number < PF_MOVES && !is_same_move(latest[number], move))
    number++;
  pf_put_symbol(p->out, p->models.moved, PF_MOVE_BITS, number);
  if (number == PF_MOVES) {
    pf_put_signed(p->out, &p->models.shift[0], (int64_t)move.x - latest->x);
    pf_put_signed(p->out, &p->models.shift[1], (int64_t)move.y - latest->y);
  }
  pf_moves_use(&p->moves, number, move);
}

static void put_old_chain(packer *p, size_t index) {
  const shown *c = &p->chains[index];
  const pf_link *link = &c->link;
  put_which(p, link);
  put_shift(p, link->move);
  p->piece_count += c->end - c->piece;
  if (link->origin == PF_KEPT)
    return;
  pf_sides own = pf_base_sides(p->part->base, link->chain);
  put_top(p, index, (pf_sides){plane_cell(p, own.left), plane_cell(p, own.right)});
}

static void put_chains(packer *p) {
  planefile_point from = {0, 0, PLANEFILE_WEIGHT};
  p->latest = (pf_link){PF_NEW, 0, {0, 0}};
  for (size_t i = 0; i < p->chain_count; i++) {
    uint32_t origin = p->chains[i].link.origin;
    if (p->part->base)
      pf_put_symbol(p->out, p->models.origin, PF_ORIGIN_BITS, origin);
    if (origin == PF_NEW)
      put_new_chain(p, i, &from);
    else if (origin == PF_BENT)
      put_bent_chain(p, i, &from);
    else
      put_old_chain(p, i);
    from = p->chains[i].start;
  }
}

/* ---------------------------------------------------------------- code of changes */

/* The changes of a group, which are neighbours in the list. */
static size_t group_size(const packer *p, size_t first) {
  size_t end = first + 1;
  while (end < p->change_count && end - first < PF_GROUP &&
         p->changes[end].height == p->changes[first].height)
    end++;
  return end - first;
}

/* Puts two changes in the order in which they were from left to right. */
static void order_pair(packer *p, change *pair) {
  pf_sides a = p->chains[pair[0].chain].sides, b = p->chains[pair[1].chain].sides;
  if (a.right == b.left || b.right != a.left)
    return;
  change first = pair[0];
  pair[0] = pair[1];
  pair[1] = first;
}

static void put_group(packer *p, const change *changes, uint32_t size, uint32_t first,
                      pf_sides *latest) {
  group g = {.size = size, .changes = changes};
  for (uint32_t i = 0; i < size; i++) {
    pf_number *model = i == 0 ? &p->models.first : &p->models.next;
    uint32_t from = i == 0 ? first : changes[i - 1].chain;
    pf_put_signed(p->out, model, (int64_t)changes[i].chain - from);
    g.before[i] = p->chains[changes[i].chain].sides;
  }
  for (uint32_t i = 0; i < size; i++) {
    const pf_near near = {g.before[i], g.before[pf_other(size, i)], *latest};
    put_sides(p, &near, pf_context(size, i), changes[i].sides);
    *latest = p->chains[changes[i].chain].sides = changes[i].sides;
  }
  put_contents(p, &g);
}

static void put_changes(packer *p) {
  int32_t height = p->top;
  uint32_t first = 0;
  pf_sides latest = {0, 0};
  for (size_t i = 0; i < p->change_count;) {
    change *changes = &p->changes[i];
    size_t size = group_size(p, i);
    if (size == 2)
      order_pair(p, changes);
    pf_put_number(p->out, &p->models.height, (uint32_t)down(p, changes->height, height));
    pf_put_number(p->out, &p->models.size, (uint32_t)size - 1);
    put_group(p, changes, (uint32_t)size, first, &latest);
    height = changes->height;
    first = changes->chain;
    i += size;
  }
}

/* ---------------------------------------------------------------- the band */

static void store_counts(const packer *p, unsigned char *at) {
  pf_store_32(at, (uint32_t)p->top);
  pf_store_32(at + 4, (uint32_t)p->foot);
  pf_store_32(at + 8, (uint32_t)p->chain_count);
  pf_store_32(at + 12, p->piece_count);
  pf_store_32(at + 16, p->cell_count);
  pf_store_32(at + 20, (uint32_t)p->change_count);
  pf_store_32(at + 24, (uint32_t)p->border_count);
  if (p->programs) {
    pf_store_32(at + PF_BAND_BYTES, p->programs->step_count);
    pf_store_32(at + PF_BAND_BYTES + 4, p->programs->axis_count);
    pf_store_32(at + PF_BAND_BYTES + 8, p->programs->stop_count);
  }
}

static uint32_t larger(uint32_t a, uint32_t b) { return a > b ? a : b; }

/* The bytes that pay for all that the band claims. */
static size_t find_price(const packer *p) {
  uint32_t most = larger(larger(p->piece_count, p->cell_count),
                         larger((uint32_t)p->change_count, (uint32_t)p->border_count));
  size_t price = ((size_t)most + PF_PAID - 1) / PF_PAID;
  if (p->programs) {
    uint32_t varied = larger(p->programs->step_count, p->programs->stop_count);
    size_t other = PF_VARIED_PAID * (size_t)larger(varied, p->programs->axis_count);
    price = other > price ? other : price;
  }
  return price;
}

/* Zeros after the code, so that its bytes, and those of the base, pay for all that it claims. */
static bool pay(const packer *p) {
  size_t price = find_price(p), base = p->part->base ? p->part->base->code : 0;
  size_t wanted = pf_band_head(p->programs != NULL) + (price > base ? price - base : 0);
  pf_encoder *out = p->out;
  unsigned char *bytes = pf_grow(p->memory, out->bytes, 1, &out->capacity, wanted);
  if (!bytes)
    return false;
  out->bytes = bytes;
  for (; out->count < wanted; out->count++)
    bytes[out->count] = 0;
  return true;
}

static bool make_programs(packer *p) {
  p->programs = pf_make(p->memory, sizeof *p->programs, 1);
  if (!p->programs)
    return false;
  p->programs->shade = p->part->codes ? PLANEFILE_SHADE : 1;
  p->programs->axes = pf_make(p->memory, sizeof *p->programs->axes, p->plane->axis_count);
  return p->programs->axes != NULL;
}

static void free_programs(packer *p) {
  if (p->programs)
    pf_free(p->memory, p->programs->axes, sizeof *p->programs->axes, p->plane->axis_count);
  pf_free(p->memory, p->programs, sizeof *p->programs, 1);
}

/* The cells of the base count as coded, with all that belongs to them. */
static void take_base(packer *p) {
  const planefile_band *band = p->part->base->band;
  p->cell_count = band->cell_count;
  for (uint32_t i = 0; i < p->plane->cell_count; i++)
    p->cells[i] = p->match.cells[i] + 1; /* none is 0 */
  if (!p->programs)
    return;
  p->programs->step_count = band->step_count;
  p->programs->axis_count = band->axis_count;
  p->programs->stop_count = band->stop_count;
  for (uint32_t i = 0; i < p->plane->axis_count; i++)
    p->programs->axes[i] = p->match.axes[i] + 1;
}

static void put_patches(packer *p) {
  const planefile_band *band = p->part->base->band;
  for (uint32_t i = 0; p->programs && i < band->axis_count; i++) {
    uint32_t number = p->match.plane_axes[i];
    const planefile_axis *axis = number == PF_NONE ? NULL : &p->plane->axes[number];
    bool is_patched =
        axis && (axis->p[2] != band->axes[i].p[2] || axis->q[2] != band->axes[i].q[2] ||
                 axis->w[2] != band->axes[i].w[2]);
    pf_put_symbol(p->out, p->models.is_patched, 1, is_patched);
    if (is_patched)
      pf_put_patch(p->out, p->programs, axis);
  }
}

/* What a cell of the base becomes. */
static void put_fate(packer *p, uint32_t theirs) {
  const planefile_band *band = p->part->base->band;
  const group none = {0};
  pf_fate fate = pf_match_fate(&p->match, theirs);
  uint32_t ours = plane_cell(p, theirs);
  pf_put_symbol(p->out, p->models.fates, PF_FATE_BITS, fate);
  if (fate == PF_REPLACED)
    put_content(p, &none, ours);
  else if (fate == PF_RECOLOURED && flat_cell(p, ours))
    put_channels(p, p->models.changed, &band->cells[theirs], &p->plane->cells[ours]);
  else if (fate == PF_RECOLOURED)
    pf_put_recoloured(p->out, p->programs, band, band->programs[theirs], p->plane,
                      p->plane->programs[ours]);
}

static void put_beginning(packer *p) {
  if (!p->part->base) {
    const group none = {0};
    add_fresh(p, 0);
    put_contents(p, &none);
    return;
  }
  take_base(p);
  put_patches(p);
  for (uint32_t i = 0; i < p->part->base->band->cell_count; i++)
    put_fate(p, i);
}

static void begin_models(packer *p) {
  const pf_learned *learned = p->part->base ? p->part->base->learned : NULL;
  if (learned)
    p->models = learned->models;
  else
    pf_models_begin(&p->models, sizeof p->models);
  if (p->programs && learned)
    p->programs->models = learned->programs;
  else if (p->programs)
    pf_models_begin(&p->programs->models, sizeof p->programs->models);
}

static bool make_room(packer *p) {
  p->cells = pf_make(p->memory, sizeof *p->cells, p->plane->cell_count);
  return p->cells &&
         (!p->part->base ||
          pf_match_make(p->memory, p->plane, p->part->base, p->part->grid, &p->match)) &&
         (!p->plane->programs || make_programs(p));
}

static bool pack(packer *p) {
  if (!make_room(p) || !find_chains(p, p->part->borders, p->part->count) ||
      (p->part->base && !match_cells(p)))
    return false;
  for (size_t i = 0; i < p->chain_count; i++)
    if (!find_changes(p, i))
      return false;
  if (p->change_count > 0)
    qsort(p->changes, p->change_count, sizeof *p->changes, compare_changes);
  begin_models(p);
  put_beginning(p);
  put_chains(p);
  put_changes(p);
  pf_encoder_end(p->out);
  if (p->out->failed || !pay(p))
    return false;
  store_counts(p, p->out->bytes);
  return true;
}

planefile_status pf_band_encode(const pf_memory *memory, const pf_part *part, pf_encoder *out) {
  const planefile_band *plane = part->plane;
  packer *p = pf_make(memory, sizeof *p, 1);
  pf_encoder_begin(out, memory, pf_band_head(plane->programs != NULL));
  if (!p)
    return PLANEFILE_NO_MEMORY;
  *p = (packer){.memory = memory,
                .plane = plane,
                .part = part,
                .top = part->top,
                .foot = part->foot,
                .out = out};
  bool is_done = pack(p);
  free_programs(p);
  pf_match_free(&p->match);
  pf_free(memory, p->borders, sizeof *p->borders, part->count);
  pf_free(memory, p->chains, sizeof *p->chains, part->count);
  pf_free(memory, p->changes, sizeof *p->changes, p->change_capacity);
  pf_free(memory, p->cells, sizeof *p->cells, plane->cell_count);
  pf_free(memory, p, sizeof *p, 1);
  return is_done ? PLANEFILE_OK : PLANEFILE_NO_MEMORY;
}
