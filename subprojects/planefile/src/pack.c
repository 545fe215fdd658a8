#include "pack.h"

/* ---------------------------------------------------------------- code of cells */

/* What happens to chains at one height. */
typedef struct group {
  uint32_t size;
  const pf_change *changes;
  pf_sides before[PF_GROUP];
} group;

static void add_fresh(pf_packer *p, uint32_t cell) {
  p->cells[cell] = ++p->cell_count;
  p->fresh[p->fresh_count++] = cell;
}

/* NULL: a cell has a program, or comes after the one that is being coded. */
static const planefile_cell *known_cell(const pf_packer *p, uint32_t cell, uint32_t latest) {
  return p->cells[cell] <= p->cells[latest] ? pf_pack_flat(p, cell) : NULL;
}

/* What a member of a group knows of a cell. */
static bool guess(const pf_packer *p, const group *g, uint32_t member, uint32_t cell,
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
static bool put_origin(pf_packer *p, const group *g, uint32_t cell, planefile_cell *out) {
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
static void put_channels(pf_packer *p, pf_number numbers[4], const planefile_cell *origin,
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

static void put_content(pf_packer *p, const group *g, uint32_t cell) {
  const planefile_cell *of = &p->plane->cells[cell];
  planefile_cell origin;
  if (p->programs) {
    pf_put_symbol(p->out, p->programs->models.varies, 1, !pf_pack_flat(p, cell));
    if (!pf_pack_flat(p, cell)) {
      pf_put_program(p->out, p->programs, p->plane, p->plane->programs[cell]);
      return;
    }
  }
  bool guessed = put_origin(p, g, cell, &origin);
  put_channels(p, p->models.channels[guessed], &origin, of);
  p->colour = *of;
}

static void put_contents(pf_packer *p, const group *g) {
  for (uint32_t i = 0; i < p->fresh_count; i++)
    put_content(p, g, p->fresh[i]);
  p->fresh_count = 0;
}

/* Cells are numbers of the plane here, in candidates, too. */
static void put_cell(pf_packer *p, const pf_near *near, unsigned context, uint32_t left,
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

static void put_sides(pf_packer *p, const pf_near *near, unsigned context, pf_sides sides) {
  put_cell(p, near, context, 0, sides.left);
  put_cell(p, near, context + 1, sides.left, sides.right);
}

/* ---------------------------------------------------------------- code of curves */

static void put_weight(pf_packer *p, uint32_t weight) {
  pf_put_signed(p->out, &p->models.weight, (int64_t)weight - PLANEFILE_WEIGHT);
}

/* Whether a move is coded as one that continues in the direction of the latest one. */
static bool is_smooth(const pf_packer *p, const pf_way *way) {
  enum { NEAR = 8 }; /* three bits less than the move itself, or that many units */
  int axis = pf_main_axis(&p->way);
  int64_t along = way->by[axis] * pf_direction(p->way.by[axis]);
  int64_t off = way->by[!axis] - pf_go_on(&p->way, axis, along);
  return along > 0 && (pf_size(off) < NEAR || pf_size(off) < pf_size(way->by[!axis]) / NEAR);
}

static void put_smooth(pf_packer *p, const pf_way *way) {
  int axis = pf_main_axis(&p->way);
  int64_t along = way->by[axis] * pf_direction(p->way.by[axis]);
  pf_put_number(p->out, &p->models.ahead, (uint32_t)along);
  pf_put_signed(p->out, &p->models.aside, way->by[!axis] - pf_go_on(&p->way, axis, along));
}

/* Differences of places, in steps: across, and down. */
static int64_t across(const pf_packer *p, int32_t to, int32_t from) {
  uint16_t columns = p->part->grid.columns;
  return planefile_step_at(to, columns) - planefile_step_at(from, columns);
}
static int64_t down(const pf_packer *p, int32_t to, int32_t from) {
  uint16_t rows = p->part->grid.rows;
  return planefile_step_at(to, rows) - planefile_step_at(from, rows);
}

static void put_move(pf_packer *p, int degree, int point, planefile_point from,
                     planefile_point to) {
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

static void put_form(pf_packer *p, uint32_t form) {
  pf_put_symbol(p->out, p->models.forms[p->form], 3, form);
  p->form = form;
}

/* is_known: where it ends is. */
static void put_piece(pf_packer *p, uint32_t piece, bool is_known) {
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
static void put_pieces(pf_packer *p, const pf_shown *c, bool is_known) {
  uint32_t border = 0;
  p->way = (pf_way){{0, 0}};
  for (uint32_t i = c->piece; i < c->end;) {
    const planefile_point *from = pf_pack_first(p, i), *to = pf_pack_pass(p, c, &i, &border);
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
static void put_top(pf_packer *p, size_t index, pf_sides own) {
  const pf_shown *c = &p->chains[index];
  const pf_near near = {own, index > 1 ? c[-2].sides : (pf_sides){0, 0},
                        index > 0 ? c[-1].sides : (pf_sides){0, 0}};
  const group none = {0};
  put_sides(p, &near, PF_AT_TOP, c->sides);
  put_contents(p, &none);
  pf_put_signed(p->out, &p->models.slope, c->slope);
}

static bool is_same(planefile_point a, planefile_point b) { return a.x == b.x && a.y == b.y; }

/* How many chains before another one begins, or ends, at the same point; 0: none that is near. */
static uint32_t find_joint(const pf_packer *p, size_t index, bool is_foot) {
  enum { NEAR = 256 };
  const pf_shown *c = &p->chains[index];
  for (size_t back = 1; back <= index && back <= NEAR; back++)
    if (is_foot ? is_same(c[-(ptrdiff_t)back].end_at, c->end_at)
                : is_same(c[-(ptrdiff_t)back].start, c->start))
      return (uint32_t)back;
  return 0;
}

/* What a cell of the base is in the plane. */
static uint32_t plane_cell(const pf_packer *p, uint32_t cell) { return p->match.plane_cells[cell]; }

/* Where a chain begins and, if another one ends there, where it ends; between them is what is put
 * there by the caller. */
static void put_start(pf_packer *p, size_t index, const planefile_point *from) {
  const pf_shown *c = &p->chains[index];
  uint32_t top = find_joint(p, index, false);
  pf_put_number(p->out, &p->models.from_top, top);
  if (top > 0)
    return;
  pf_put_signed(p->out, &p->models.start[0], across(p, c->start.x, from->x));
  pf_put_signed(p->out, &p->models.start[1], down(p, c->start.y, from->y));
}

static void put_new_chain(pf_packer *p, size_t index, const planefile_point *from) {
  const pf_shown *c = &p->chains[index];
  uint32_t pieces = pf_pack_count(p, c), foot = find_joint(p, index, true);
  put_start(p, index, from);
  pf_put_number(p->out, &p->models.pieces, pieces - 1);
  pf_put_number(p->out, &p->models.to_foot, foot);
  put_top(p, index, (pf_sides){0, 0});
  put_pieces(p, c, foot > 0);
  p->piece_count += pieces;
}

/* The moves of a piece, by how much they differ from those of one of the base. */
static void put_bent_piece(pf_packer *p, uint32_t piece, uint32_t old, bool is_known) {
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

static void put_which(pf_packer *p, const pf_link *link) {
  pf_put_signed(p->out, &p->models.which, (int64_t)link->chain - p->latest.chain);
  p->latest = *link;
  p->latest.chain++;
}

static void put_bent_chain(pf_packer *p, size_t index, const planefile_point *from) {
  const pf_shown *c = &p->chains[index];
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

static void put_shift(pf_packer *p, pf_move move) {
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

static void put_old_chain(pf_packer *p, size_t index) {
  const pf_shown *c = &p->chains[index];
  const pf_link *link = &c->link;
  put_which(p, link);
  put_shift(p, link->move);
  p->piece_count += c->end - c->piece;
  if (link->origin == PF_KEPT)
    return;
  pf_sides own = pf_base_sides(p->part->base, link->chain);
  put_top(p, index, (pf_sides){plane_cell(p, own.left), plane_cell(p, own.right)});
}

static void put_chains(pf_packer *p) {
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
static size_t group_size(const pf_packer *p, size_t first) {
  size_t end = first + 1;
  while (end < p->change_count && end - first < PF_GROUP &&
         p->changes[end].height == p->changes[first].height)
    end++;
  return end - first;
}

/* Puts two changes in the order in which they were from left to right. */
static void order_pair(pf_packer *p, pf_change *pair) {
  pf_sides a = p->chains[pair[0].chain].sides, b = p->chains[pair[1].chain].sides;
  if (a.right == b.left || b.right != a.left)
    return;
  pf_change first = pair[0];
  pair[0] = pair[1];
  pair[1] = first;
}

static void put_group(pf_packer *p, const pf_change *changes, uint32_t size, uint32_t first,
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

static void put_changes(pf_packer *p) {
  int32_t height = p->top;
  uint32_t first = 0;
  pf_sides latest = {0, 0};
  for (size_t i = 0; i < p->change_count;) {
    pf_change *changes = &p->changes[i];
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

static void store_counts(const pf_packer *p, unsigned char *at) {
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
static size_t find_price(const pf_packer *p) {
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
static bool pay(const pf_packer *p) {
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

static bool make_programs(pf_packer *p) {
  p->programs = pf_make(p->memory, sizeof *p->programs, 1);
  if (!p->programs)
    return false;
  p->programs->shade = p->part->codes ? PLANEFILE_SHADE : 1;
  p->programs->axes = pf_make(p->memory, sizeof *p->programs->axes, p->plane->axis_count);
  return p->programs->axes != NULL;
}

static void free_programs(pf_packer *p) {
  if (p->programs)
    pf_free(p->memory, p->programs->axes, sizeof *p->programs->axes, p->plane->axis_count);
  pf_free(p->memory, p->programs, sizeof *p->programs, 1);
}

/* The cells of the base count as coded, with all that belongs to them. */
static void take_base(pf_packer *p) {
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

static void put_patches(pf_packer *p) {
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
static void put_fate(pf_packer *p, uint32_t theirs) {
  const planefile_band *band = p->part->base->band;
  const group none = {0};
  pf_fate fate = pf_match_fate(&p->match, theirs);
  uint32_t ours = plane_cell(p, theirs);
  pf_put_symbol(p->out, p->models.fates, PF_FATE_BITS, fate);
  if (fate == PF_REPLACED)
    put_content(p, &none, ours);
  else if (fate == PF_RECOLOURED && pf_pack_flat(p, ours))
    put_channels(p, p->models.changed, &band->cells[theirs], &p->plane->cells[ours]);
  else if (fate == PF_RECOLOURED)
    pf_put_recoloured(p->out, p->programs, band, band->programs[theirs], p->plane,
                      p->plane->programs[ours]);
}

static void put_beginning(pf_packer *p) {
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

static bool make_room(pf_packer *p) {
  p->cells = pf_make(p->memory, sizeof *p->cells, p->plane->cell_count);
  return p->cells &&
         (!p->part->base ||
          pf_match_make(p->memory, p->plane, p->part->base, p->part->grid, &p->match)) &&
         (!p->plane->programs || make_programs(p));
}

static bool pack(pf_packer *p) {
  if (!make_room(p) || !pf_pack_find(p))
    return false;
  pf_base_learned(p->part->base, &p->models, p->programs ? &p->programs->models : NULL);
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
  pf_packer *p = pf_make(memory, sizeof *p, 1);
  pf_encoder_begin(out, memory, pf_band_head(plane->programs != NULL));
  if (!p)
    return PLANEFILE_NO_MEMORY;
  *p = (pf_packer){.memory = memory,
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
