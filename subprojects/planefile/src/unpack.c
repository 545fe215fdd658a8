/* A band from its code.
 *
 * INVARIANT: nothing in the code is trusted. Memory is allocated only for what its bytes pay for,
 * and every number is checked before it is used.
 *
 * One file, because it is one walk along one code: each function reads on where the one before has
 * ended, in the order in which pack.c has written.
 */
#include "band.h"

/* What is happening to a chain. */
typedef struct state {
  pf_sides sides;
  int32_t since; /* the height from which on it has them */
  int32_t slope;
} state;

/* What happens to chains at one height. */
typedef struct group {
  uint32_t size, chains[PF_GROUP];
  pf_sides before[PF_GROUP];
} group;

typedef struct unpacker {
  const pf_memory *memory;
  pf_decoder decoder;
  pf_models models;
  pf_band *out;
  const pf_base *base;   /* NULL: there is none */
  const pf_codes *codes; /* NULL: cells are not codes */
  planefile_point *points;
  planefile_piece *pieces;
  planefile_chain *chains;
  planefile_border *borders;
  planefile_cell *cells;
  planefile_program *programs;
  pf_program_room room;
  pf_program_coding *coding; /* the coding of programs; NULL: nothing varies */
  state *states;             /* the states of the chains */
  uint32_t chain_count, piece_count, cell_count, border_count; /* that there must be in the end */
  uint32_t change_count;
  uint32_t form; /* the form of the latest piece */
  pf_way way;    /* the latest move of the chain, in steps */
  planefile_grid grid;
  planefile_cell flat; /* the latest one that does not vary */
  planefile_point start;
  uint32_t next;      /* the chain of the base after the latest one that was taken */
  pf_moves moves;     /* of those that were taken */
  const char *reason; /* NULL: nothing is wrong */
} unpacker;

static bool refuse(unpacker *u, const char *reason) {
  u->reason = u->reason ? u->reason : reason;
  return false;
}

/* ---------------------------------------------------------------- room */

/* code: its bytes, with those of the base. */
static bool load_counts(unpacker *u, const unsigned char *payload, size_t code) {
  planefile_band *band = &u->out->band;
  size_t paid = PF_PAID * code;
  band->top = (int32_t)pf_load_32(payload);
  band->foot = (int32_t)pf_load_32(payload + 4);
  u->chain_count = pf_load_32(payload + 8);
  u->piece_count = pf_load_32(payload + 12);
  u->cell_count = pf_load_32(payload + 16);
  u->change_count = pf_load_32(payload + 20);
  u->border_count = pf_load_32(payload + 24);
  if (band->top < 0 || band->top >= band->foot || band->foot > PLANEFILE_SIDE)
    return refuse(u, "its heights are not in the frame");
  if (u->chain_count > paid || u->piece_count > paid || u->cell_count > paid ||
      u->change_count > paid || u->border_count > paid)
    return refuse(u, "it claims more than its bytes can hold");
  if (u->cell_count == 0)
    return refuse(u, "it has no cell");
  return true;
}

static bool load_varied_counts(unpacker *u, const unsigned char *payload, size_t code) {
  size_t paid = code / PF_VARIED_PAID;
  u->room.step_count = pf_load_32(payload + PF_BAND_BYTES);
  u->room.axis_count = pf_load_32(payload + PF_BAND_BYTES + 4);
  u->room.stop_count = pf_load_32(payload + PF_BAND_BYTES + 8);
  return (u->room.step_count <= paid && u->room.axis_count <= paid && u->room.stop_count <= paid) ||
         refuse(u, "it claims more than its bytes can hold");
}

/* Room for all programs. */
static bool make_varied_room(unpacker *u) {
  pf_band *out = u->out;
  pf_program_room *room = &u->room;
  out->program_capacity = u->cell_count;
  out->step_capacity = room->step_count;
  out->axis_capacity = room->axis_count;
  out->stop_capacity = room->stop_count;
  out->band.programs = u->programs = pf_make(u->memory, sizeof *u->programs, u->cell_count);
  out->band.steps = room->steps = pf_make(u->memory, sizeof *room->steps, room->step_count);
  out->band.axes = room->axes = pf_make(u->memory, sizeof *room->axes, room->axis_count);
  out->band.stops = room->stops = pf_make(u->memory, sizeof *room->stops, room->stop_count);
  u->coding = pf_make(u->memory, sizeof *u->coding, 1);
  if (u->coding)
    u->coding->shade = u->codes ? PLANEFILE_SHADE : 1;
  return u->programs && room->steps && room->axes && room->stops && u->coding;
}

/* Room for all else that is claimed. */
static bool make_room(unpacker *u) {
  pf_band *out = u->out;
  out->point_capacity = (size_t)4 * u->piece_count;
  out->piece_capacity = u->piece_count;
  out->chain_capacity = u->chain_count;
  out->border_capacity = u->border_count;
  out->cell_capacity = u->cell_count;
  out->band.points = u->points = pf_make(u->memory, sizeof *u->points, out->point_capacity);
  out->band.pieces = u->pieces = pf_make(u->memory, sizeof *u->pieces, out->piece_capacity);
  out->band.chains = u->chains = pf_make(u->memory, sizeof *u->chains, out->chain_capacity);
  out->band.borders = u->borders = pf_make(u->memory, sizeof *u->borders, out->border_capacity);
  out->band.cells = u->cells = pf_make(u->memory, sizeof *u->cells, out->cell_capacity);
  u->states = pf_make(u->memory, sizeof *u->states, u->chain_count);
  return u->points && u->pieces && u->chains && u->borders && u->cells && u->states;
}

/* ---------------------------------------------------------------- cells */

static bool get_program(unpacker *u, uint32_t cell) {
  const char *reason = pf_get_program(&u->decoder, u->coding, &u->room, &u->programs[cell]);
  planefile_band *band = &u->out->band;
  band->step_count = u->coding->step_count;
  band->axis_count = u->coding->axis_count;
  band->stop_count = u->coding->stop_count;
  return cell == 0 ? refuse(u, "cell 0 varies") : !reason || refuse(u, reason);
}

/* The next cell, of which nothing is known yet. */
static bool add_cell(unpacker *u, uint32_t *out) {
  planefile_band *band = &u->out->band;
  if (band->cell_count == u->cell_count)
    return refuse(u, "it has more than it claims");
  *out = band->cell_count++;
  return true;
}

/* NULL: a cell has a program, or comes after the one that is being decoded. */
static const planefile_cell *flat_cell(const unpacker *u, uint32_t cell, uint32_t latest) {
  bool is_known = cell <= latest && !(u->coding && u->programs[cell].step_count > 0);
  return is_known ? &u->cells[cell] : NULL;
}

/* What a member of a group knows of a cell. */
static bool guess(const unpacker *u, const group *g, uint32_t member, uint32_t cell,
                  planefile_cell *out) {
  const state *s = &u->states[g->chains[member]];
  const pf_sides *was = &g->before[member];
  const pf_beside beside = {{flat_cell(u, was->left, cell), flat_cell(u, was->right, cell)},
                            {flat_cell(u, s->sides.left, cell), flat_cell(u, s->sides.right, cell)},
                            s->slope};
  return pf_guess(&beside, &u->cells[cell], out);
}

/* What the channels of a cell differ from. *guessed: whether that is a guess. */
static bool get_origin(unpacker *u, const group *g, uint32_t cell, bool *guessed,
                       planefile_cell *out) {
  planefile_cell guesses[PF_GUESSES + 1] = {u->flat};
  uint32_t count = 1, number = 0;
  for (uint32_t i = 0; i < g->size && count <= PF_GUESSES; i++)
    count += guess(u, g, i, cell, &guesses[count]);
  if (count > 1)
    number = pf_get_symbol(&u->decoder, u->models.guesses, 2);
  if (number >= count)
    return refuse(u, "there is no such guess");
  *out = guesses[number];
  *guessed = number > 0;
  return true;
}

/* The channels of a cell, or their codes, by how much they differ from those it has. */
static bool get_channels(unpacker *u, pf_number channels[4], planefile_cell *cell) {
  int32_t least = u->codes ? 0 : -PLANEFILE_BRIGHT, most = u->codes ? 255 : PLANEFILE_BRIGHT;
  int32_t straight[4], *at = cell->colour;
  if (u->codes) {
    pf_codes_of(u->codes, cell, straight);
    at = straight;
  }
  for (int c = 0; c < 4; c++) {
    int64_t channel = at[c] + pf_get_signed(&u->decoder, &channels[c]);
    if (channel < least || channel > most)
      return refuse(u, "a colour is too bright");
    at[c] = (int32_t)channel;
  }
  if (u->codes)
    *cell = pf_codes_cell(u->codes, straight);
  return true;
}

/* What a new cell is: a program, or channels that differ from those of the flat one before, or from
 * a guess of the group in which it is new. */
static bool get_content(unpacker *u, const group *g, uint32_t index) {
  planefile_cell cell;
  bool guessed;
  if (u->coding && pf_get_symbol(&u->decoder, u->coding->models.varies, 1))
    return get_program(u, index);
  if (!get_origin(u, g, index, &guessed, &cell))
    return false;
  pf_number *channels = u->models.channels[guessed];
  if (!get_channels(u, channels, &cell))
    return false;
  u->cells[index] = u->flat = cell;
  return true;
}

/* The cells that are new from one on. */
static bool get_contents(unpacker *u, const group *g, uint32_t first) {
  for (uint32_t i = first; i < u->out->band.cell_count; i++)
    if (!get_content(u, g, i))
      return false;
  return true;
}

static bool get_cell(unpacker *u, const pf_near *near, unsigned context, uint32_t left,
                     uint32_t *out) {
  uint32_t symbol = pf_get_symbol(&u->decoder, u->models.cells[context], PF_SYMBOL_BITS);
  if (symbol == PF_FRESH)
    return add_cell(u, out);
  *out = pf_candidate(near, context & 1, left, symbol);
  if (symbol == PF_OLDER) {
    uint32_t back = pf_get_number(&u->decoder, &u->models.older);
    if (back >= u->out->band.cell_count)
      return refuse(u, "there is no such cell");
    *out = u->out->band.cell_count - 1 - back;
  }
  return true;
}

static bool get_sides(unpacker *u, const pf_near *near, unsigned context, pf_sides *out) {
  return get_cell(u, near, context, 0, &out->left) &&
         get_cell(u, near, context + 1, out->left, &out->right);
}

/* ---------------------------------------------------------------- curves */

/* Moves a coordinate by some steps of one of the grid's sides, if it stays near enough. */
static bool move_by(unpacker *u, uint16_t side, int64_t move, int32_t *at) {
  int64_t to = planefile_place_of(planefile_step_at(*at, side) + move, side);
  if (to < -PLANEFILE_FAR || to > PLANEFILE_FAR)
    return refuse(u, "a point is too far away");
  *at = (int32_t)to;
  return true;
}

/* The steps from one coordinate to another. */
static int64_t steps(uint16_t side, int32_t to, int32_t from) {
  return planefile_step_at(to, side) - planefile_step_at(from, side);
}

static bool get_point(unpacker *u, pf_number models[2], int32_t *x, int32_t *y) {
  return move_by(u, u->grid.columns, pf_get_signed(&u->decoder, &models[0]), x) &&
         move_by(u, u->grid.rows, pf_get_signed(&u->decoder, &models[1]), y);
}

/* The move of a smooth joint. */
static void get_smooth(unpacker *u, pf_way *out) {
  int axis = pf_main_axis(&u->way);
  int64_t along = pf_get_number(&u->decoder, &u->models.ahead);
  out->by[axis] = along * pf_direction(u->way.by[axis]);
  out->by[!axis] = pf_go_on(&u->way, axis, along) + pf_get_signed(&u->decoder, &u->models.aside);
}

static bool get_move_of(unpacker *u, int degree, int point, planefile_point *at) {
  bool may_be = point == 0 && pf_leads_on(&u->way);
  pf_way way;
  if (may_be && pf_get_symbol(&u->decoder, u->models.is_smooth, 1))
    get_smooth(u, &way);
  else
    for (int axis = 0; axis < 2; axis++)
      way.by[axis] = pf_get_signed(&u->decoder, &u->models.moves[axis][degree - 1][point]) *
                     pf_direction(u->way.by[axis]);
  u->way = way;
  return move_by(u, u->grid.columns, way.by[0], &at->x) &&
         move_by(u, u->grid.rows, way.by[1], &at->y);
}

static bool get_weight(unpacker *u, uint32_t *out) {
  int64_t weight = PLANEFILE_WEIGHT + pf_get_signed(&u->decoder, &u->models.weight);
  if (weight < PLANEFILE_WEIGHT / 16 || weight > UINT32_MAX)
    return refuse(u, "a weight is not allowed");
  *out = (uint32_t)weight;
  return true;
}

/* A piece that begins at `at`, which becomes its end; NULL: where it ends is not known. */
static bool get_piece(unpacker *u, planefile_point *at, const planefile_point *end) {
  planefile_band *band = &u->out->band;
  u->form = pf_get_symbol(&u->decoder, u->models.forms[u->form], 3);
  uint8_t degree = u->form & 3;
  bool is_rational = u->form & PF_RATIONAL;
  int32_t top = at->y;
  if (degree == 0 || (is_rational && degree == 1))
    return refuse(u, "there is no such form of a piece");
  u->pieces[band->piece_count++] = (planefile_piece){band->point_count, degree, is_rational};
  at->w = PLANEFILE_WEIGHT;
  if (is_rational && !get_weight(u, &at->w))
    return false;
  u->points[band->point_count++] = *at;
  for (int i = 0; i < degree; i++) {
    if (end && i + 1 == degree)
      *at = *end;
    else if (!get_move_of(u, degree, i, at))
      return false;
    at->w = PLANEFILE_WEIGHT;
    if (is_rational && !get_weight(u, &at->w))
      return false;
    u->points[band->point_count++] = *at;
  }
  return at->y >= top || refuse(u, "a piece ends above its beginning");
}

static void add_border(unpacker *u, uint32_t chain, int32_t foot) {
  planefile_band *band = &u->out->band;
  const state *s = &u->states[chain];
  if (s->sides.left == s->sides.right)
    return;
  if (band->border_count < u->border_count)
    u->borders[band->border_count] =
        (planefile_border){chain, s->since, foot, s->sides.left, s->sides.right};
  band->border_count++;
}

static const planefile_point *end_of(const unpacker *u, uint32_t chain) {
  const planefile_chain *c = &u->chains[chain];
  const planefile_piece *last = &u->pieces[c->piece + c->piece_count - 1];
  return &u->points[last->point + last->degree];
}

/* The lowest height of a chain in the band. */
static int32_t foot_of(const unpacker *u, uint32_t chain) {
  int32_t foot = end_of(u, chain)->y;
  return foot < u->out->band.foot ? foot : u->out->band.foot;
}

/* The cells at the top of a chain. own: what it had in the base. */
static bool get_top(unpacker *u, uint32_t index, pf_sides own) {
  const pf_near near = {own, index > 1 ? u->states[index - 2].sides : (pf_sides){0, 0},
                        index > 0 ? u->states[index - 1].sides : (pf_sides){0, 0}};
  const group none = {0};
  uint32_t first = u->out->band.cell_count;
  state *s = &u->states[index];
  s->since = u->start.y > u->out->band.top ? u->start.y : u->out->band.top;
  if (!get_sides(u, &near, PF_AT_TOP, &s->sides) || !get_contents(u, &none, first))
    return false;
  int64_t slope = pf_get_signed(&u->decoder, &u->models.slope);
  s->slope = (int32_t)slope;
  return (slope >= -PF_SLOPE && slope <= PF_SLOPE) || refuse(u, "there is no such slope");
}

/* Where a chain begins, in `at`, after the one before. */
static bool get_start(unpacker *u, uint32_t index, planefile_point *at) {
  uint32_t back = pf_get_number(&u->decoder, &u->models.from_top);
  if (back > index)
    return refuse(u, "there is no such chain");
  if (back > 0)
    *at = u->points[u->pieces[u->chains[index - back].piece].point];
  return back > 0 || get_point(u, u->models.start, &at->x, &at->y);
}

/* Begins a chain of some pieces: what comes before them. *end: where it ends, or NULL. own: the
 * cells that it had in the base. */
static bool begin_chain(unpacker *u, uint32_t index, uint32_t pieces, pf_sides own,
                        const planefile_point **end) {
  planefile_band *band = &u->out->band;
  if (pieces > u->piece_count - band->piece_count)
    return refuse(u, "it has more than it claims");
  uint32_t back = pf_get_number(&u->decoder, &u->models.to_foot);
  if (back > index)
    return refuse(u, "there is no such chain");
  *end = back > 0 ? end_of(u, index - back) : NULL;
  u->chains[band->chain_count++] = (planefile_chain){band->piece_count, pieces};
  return get_top(u, index, own);
}

static bool get_new_chain(unpacker *u, uint32_t index) {
  planefile_point at = u->start;
  const planefile_point *end;
  u->way = (pf_way){{0, 0}};
  if (!get_start(u, index, &at))
    return false;
  u->start = at;
  uint32_t pieces = pf_get_number(&u->decoder, &u->models.pieces);
  if (pieces >= u->piece_count || !begin_chain(u, index, pieces + 1, (pf_sides){0, 0}, &end))
    return refuse(u, "it has more than it claims");
  for (uint32_t i = 0; i <= pieces; i++)
    if (u->decoder.is_beyond || !get_piece(u, &at, i == pieces ? end : NULL))
      return refuse(u, "its code does not end where it should");
  return true;
}

/* ---------------------------------------------------------------- chains of the base */

/* The number of the next one in the base. */
static bool get_which(unpacker *u, uint32_t *out) {
  int64_t chain = (int64_t)u->next + pf_get_signed(&u->decoder, &u->models.which);
  if (chain < 0 || chain >= u->base->band->chain_count)
    return refuse(u, "there is no such chain");
  *out = (uint32_t)chain;
  u->next = *out + 1;
  return true;
}

/* A piece like one of the base, with other moves, as of get_piece. */
static bool get_bent_piece(unpacker *u, const planefile_piece *of, planefile_point *at,
                           const planefile_point *end) {
  planefile_band *band = &u->out->band;
  const planefile_point *from = &u->base->band->points[of->point];
  planefile_piece piece = *of;
  int32_t top = at->y;
  piece.point = band->point_count;
  u->pieces[band->piece_count++] = piece;
  at->w = from->w;
  u->points[band->point_count++] = *at;
  for (int i = 0; i < piece.degree; i++) {
    int64_t x = steps(u->grid.columns, from[i + 1].x, from[i].x);
    int64_t y = steps(u->grid.rows, from[i + 1].y, from[i].y);
    bool is_known = end && i + 1 == piece.degree;
    if (is_known)
      *at = *end;
    else if (!move_by(u, u->grid.columns, x + pf_get_signed(&u->decoder, &u->models.bent[0]),
                      &at->x) ||
             !move_by(u, u->grid.rows, y + pf_get_signed(&u->decoder, &u->models.bent[1]), &at->y))
      return false;
    at->w = from[i + 1].w;
    u->points[band->point_count++] = *at;
  }
  return at->y >= top || refuse(u, "a piece ends above its beginning");
}

static bool get_bent_chain(unpacker *u, uint32_t index) {
  planefile_point at = u->start;
  const planefile_point *end;
  uint32_t chain;
  if (!get_which(u, &chain) || !get_start(u, index, &at))
    return false;
  const planefile_chain *of = &u->base->band->chains[chain];
  u->start = at;
  if (!begin_chain(u, index, of->piece_count, pf_base_sides(u->base, chain), &end))
    return false;
  for (uint32_t i = 0; i < of->piece_count; i++)
    if (u->decoder.is_beyond || !get_bent_piece(u, &u->base->band->pieces[of->piece + i], &at,
                                                i + 1 == of->piece_count ? end : NULL))
      return refuse(u, "its code does not end where it should");
  return true;
}

static bool move_point(unpacker *u, planefile_point point) {
  const pf_move *by = u->moves.latest;
  bool is_near =
      move_by(u, u->grid.columns, by->x, &point.x) && move_by(u, u->grid.rows, by->y, &point.y);
  u->points[u->out->band.point_count++] = point;
  return is_near;
}

static bool move_chain(unpacker *u, uint32_t chain) {
  const planefile_band *from = u->base->band;
  planefile_band *band = &u->out->band;
  const planefile_chain *of = &from->chains[chain];
  if (of->piece_count > u->piece_count - band->piece_count)
    return refuse(u, "it has more than it claims");
  uint32_t first = band->point_count;
  u->chains[band->chain_count++] = (planefile_chain){band->piece_count, of->piece_count};
  for (uint32_t i = 0; i < of->piece_count; i++) {
    planefile_piece piece = from->pieces[of->piece + i];
    const planefile_point *points = &from->points[piece.point];
    piece.point = band->point_count;
    u->pieces[band->piece_count++] = piece;
    for (int k = 0; k <= piece.degree; k++)
      if (!move_point(u, points[k]))
        return false;
  }
  u->start = u->points[first];
  return true;
}

static bool get_shift(unpacker *u, pf_move *move) {
  int64_t x = move->x + pf_get_signed(&u->decoder, &u->models.shift[0]);
  int64_t y = move->y + pf_get_signed(&u->decoder, &u->models.shift[1]);
  if (x < -2 * PLANEFILE_FAR || x > 2 * PLANEFILE_FAR || y < -2 * PLANEFILE_FAR ||
      y > 2 * PLANEFILE_FAR)
    return refuse(u, "a point is too far away");
  *move = (pf_move){(int32_t)x, (int32_t)y};
  return true;
}

static bool get_move(unpacker *u) {
  uint32_t number = pf_get_symbol(&u->decoder, u->models.moved, PF_MOVE_BITS);
  pf_move move = u->moves.latest[number < PF_MOVES ? number : 0];
  bool is_good = number < PF_MOVES || get_shift(u, &move);
  pf_moves_use(&u->moves, number, move);
  return is_good;
}

/* All borders that a chain of the base has, moved; they do not change. */
static bool keep_borders(unpacker *u, uint32_t index, uint32_t chain) {
  planefile_band *band = &u->out->band;
  planefile_border moved;
  u->states[index] = (state){{0, 0}, INT32_MAX, 0};
  for (uint32_t i = u->base->first[chain]; i < u->base->first[chain + 1]; i++) {
    if (!pf_move_border(&u->base->band->borders[i], u->moves.latest->y, u->grid.rows, band, &moved))
      continue;
    moved.chain = index;
    if (band->border_count == u->border_count)
      return refuse(u, "it has more than it claims");
    u->borders[band->border_count++] = moved;
  }
  return true;
}

static bool get_old_chain(unpacker *u, uint32_t index, bool is_kept) {
  uint32_t chain;
  if (!get_which(u, &chain) || !get_move(u) || !move_chain(u, chain))
    return false;
  return is_kept ? keep_borders(u, index, chain) : get_top(u, index, pf_base_sides(u->base, chain));
}

static bool get_chain(unpacker *u, uint32_t index) {
  uint32_t origin = PF_NEW;
  if (u->base)
    origin = pf_get_symbol(&u->decoder, u->models.origin, PF_ORIGIN_BITS);
  if (u->decoder.is_beyond)
    return refuse(u, "its code does not end where it should");
  if (origin == PF_KEPT)
    return get_old_chain(u, index, true);
  return (origin == PF_NEW    ? get_new_chain(u, index)
          : origin == PF_BENT ? get_bent_chain(u, index)
                              : get_old_chain(u, index, false)) &&
         (u->states[index].since < foot_of(u, index) || refuse(u, "a chain is not in it"));
}

/* ---------------------------------------------------------------- changes */

static bool get_members(unpacker *u, int32_t height, uint32_t *first, group *g) {
  for (uint32_t i = 0; i < g->size; i++) {
    pf_number *model = i == 0 ? &u->models.first : &u->models.next;
    int64_t chain = pf_get_signed(&u->decoder, model) + (i == 0 ? *first : g->chains[i - 1]);
    if (chain < 0 || chain >= u->chain_count)
      return refuse(u, "there is no such chain");
    g->chains[i] = (uint32_t)chain;
    g->before[i] = u->states[chain].sides;
    if (height <= u->states[chain].since || height >= foot_of(u, g->chains[i]))
      return refuse(u, "a change is not on its chain");
  }
  *first = g->chains[0];
  return true;
}

static bool apply(unpacker *u, const group *g, int32_t height, pf_sides *latest) {
  uint32_t first = u->out->band.cell_count;
  for (uint32_t i = 0; i < g->size; i++) {
    const pf_near near = {g->before[i], g->before[pf_other(g->size, i)], *latest};
    state *s = &u->states[g->chains[i]];
    if (height <= s->since)
      return refuse(u, "a change is not on its chain");
    add_border(u, g->chains[i], height);
    if (!get_sides(u, &near, pf_context(g->size, i), &s->sides))
      return false;
    s->since = height;
    *latest = s->sides;
  }
  return get_contents(u, g, first);
}

static bool get_changes(unpacker *u) {
  int64_t height, step = planefile_step_at(u->out->band.top, u->grid.rows);
  uint32_t left = u->change_count, first = 0;
  pf_sides latest = {0, 0};
  while (left > 0) {
    group g = {0};
    step += pf_get_number(&u->decoder, &u->models.height);
    height = planefile_place_of(step, u->grid.rows);
    g.size = pf_get_number(&u->decoder, &u->models.size) + 1;
    if (g.size == 0 || g.size > left || g.size > PF_GROUP)
      return refuse(u, "a group is too large");
    if (height >= u->out->band.foot || u->decoder.is_beyond)
      return refuse(u, "a change is below it");
    if (!get_members(u, (int32_t)height, &first, &g) || !apply(u, &g, (int32_t)height, &latest))
      return false;
    left -= g.size;
  }
  return true;
}

/* ---------------------------------------------------------------- order */

/* Puts borders that follow each other by chains, those of each in their order. */
static bool sort_borders(unpacker *u) {
  uint32_t count = u->border_count, chains = u->chain_count;
  planefile_border *found = pf_make(u->memory, sizeof *found, count);
  uint32_t *places = pf_make(u->memory, sizeof *places, (size_t)chains + 1);
  for (uint32_t i = 0; found && places && i < count; i++)
    places[u->borders[i].chain + 1]++;
  for (uint32_t i = 0; places && i < chains; i++)
    places[i + 1] += places[i];
  for (uint32_t i = 0; found && places && i < count; i++)
    found[places[u->borders[i].chain]++] = u->borders[i];
  if (found && places)
    memcpy(u->borders, found, count * sizeof *found);
  bool is_done = found && places;
  pf_free(u->memory, found, sizeof *found, count);
  pf_free(u->memory, places, sizeof *places, (size_t)chains + 1);
  return is_done;
}

/* ---------------------------------------------------------------- the band */

static bool get_chains(unpacker *u) {
  for (uint32_t i = 0; i < u->chain_count; i++)
    if (!get_chain(u, i))
      return false;
  return true;
}

static bool check_end(unpacker *u) {
  planefile_band *band = &u->out->band;
  for (uint32_t i = 0; i < u->chain_count; i++)
    add_border(u, i, foot_of(u, i));
  if (!pf_decoder_is_whole(&u->decoder))
    return refuse(u, "its code does not end where it should");
  if (band->piece_count != u->piece_count || band->cell_count != u->cell_count ||
      band->border_count != u->border_count || band->step_count != u->room.step_count ||
      band->axis_count != u->room.axis_count || band->stop_count != u->room.stop_count)
    return refuse(u, "it has less than it claims");
  return pf_is_moderate(u->cells, u->borders, u->border_count) ||
         refuse(u, "its borders are too bright together");
}

/* What the band has from its base from the beginning: cells with all that belongs to them. */
static bool take_base(unpacker *u) {
  const planefile_band *from = u->base->band;
  planefile_band *band = &u->out->band;
  if (from->cell_count > u->cell_count || from->step_count > u->room.step_count ||
      from->axis_count > u->room.axis_count || from->stop_count > u->room.stop_count)
    return refuse(u, "it has less than it claims");
  band->cell_count = from->cell_count;
  memcpy(u->cells, from->cells, from->cell_count * sizeof *u->cells);
  if (!u->coding)
    return true;
  memcpy(u->programs, from->programs, from->cell_count * sizeof *u->programs);
  memcpy(u->room.steps, from->steps, from->step_count * sizeof *from->steps);
  memcpy(u->room.axes, from->axes, from->axis_count * sizeof *from->axes);
  memcpy(u->room.stops, from->stops, from->stop_count * sizeof *from->stops);
  u->coding->step_count = band->step_count = from->step_count;
  u->coding->axis_count = band->axis_count = from->axis_count;
  u->coding->stop_count = band->stop_count = from->stop_count;
  return true;
}

/* Axes of the base that lie elsewhere. */
static bool get_patches(unpacker *u) {
  for (uint32_t i = 0; u->coding && i < u->base->band->axis_count; i++)
    if (pf_get_symbol(&u->decoder, u->models.is_patched, 1) &&
        !pf_get_patch(&u->decoder, u->coding, &u->room.axes[i]))
      return refuse(u, "an axis is not allowed");
  return true;
}

/* A cell of the base becomes what it is here. */
static bool get_fate(unpacker *u, uint32_t cell) {
  const group none = {0};
  uint32_t fate = pf_get_symbol(&u->decoder, u->models.fates, PF_FATE_BITS);
  bool varies = u->coding && u->programs[cell].step_count > 0;
  if (fate == PF_SAME)
    return true;
  if (fate == PF_RECOLOURED && !varies)
    return get_channels(u, u->models.changed, &u->cells[cell]);
  if (fate == PF_RECOLOURED) {
    const char *reason = pf_get_recoloured(&u->decoder, u->coding, &u->room, u->programs[cell]);
    return !reason || refuse(u, reason);
  }
  if (fate != PF_REPLACED)
    return refuse(u, "a cell has no such fate");
  u->cells[cell] = (planefile_cell){{0}};
  if (varies)
    u->programs[cell] = (planefile_program){0, 0};
  return get_content(u, &none, cell);
}

static bool get_fates(unpacker *u) {
  for (uint32_t i = 0; i < u->base->band->cell_count; i++)
    if (u->decoder.is_beyond || !get_fate(u, i))
      return refuse(u, "its code does not end where it should");
  return true;
}

/* The cells from which it begins. */
static bool get_beginning(unpacker *u) {
  const group none = {0};
  uint32_t cell;
  return u->base ? take_base(u) && get_patches(u) && get_fates(u)
                 : add_cell(u, &cell) && get_content(u, &none, cell);
}

static void teach(const unpacker *u, pf_learned *out) {
  out->models = u->models;
  if (u->coding)
    out->programs = u->coding->models;
}

/* False without a reason: no memory. */
static bool unpack(unpacker *u, const pf_payload *payload) {
  bool varies = payload->varies;
  size_t head = pf_band_head(varies);
  u->base = payload->base;
  u->codes = payload->codes;
  u->grid = payload->grid;
  u->out->band.picture_count = u->room.picture_count = payload->picture_count;
  if (payload->size < head)
    return refuse(u, "it is too short");
  size_t code = payload->size - head, paid = code + (u->base ? u->base->code : 0);
  if (!load_counts(u, payload->bytes, paid) ||
      (varies && !load_varied_counts(u, payload->bytes, paid)) || !make_room(u) ||
      (varies && !make_varied_room(u)))
    return false;
  pf_base_learned(u->base, &u->models, u->coding ? &u->coding->models : NULL);
  pf_decoder_begin(&u->decoder, payload->bytes + head, code);
  return get_beginning(u) && get_chains(u) && get_changes(u) && check_end(u) && sort_borders(u);
}

planefile_status pf_band_decode(const pf_memory *memory, const pf_payload *payload, pf_band *out,
                                const char **reason) {
  unpacker *u = pf_make(memory, sizeof *u, 1);
  *reason = "no memory";
  if (!u)
    return PLANEFILE_NO_MEMORY;
  u->memory = memory;
  u->out = out;
  bool is_good = unpack(u, payload);
  if (is_good && payload->learned)
    teach(u, payload->learned);
  if (u->reason)
    *reason = u->reason;
  planefile_status status = is_good     ? PLANEFILE_OK
                            : u->reason ? PLANEFILE_BAD_FILE
                                        : PLANEFILE_NO_MEMORY;
  if (out->band.border_count > u->border_count) /* it is counted beyond its room */
    out->band.border_count = u->border_count;
  pf_free(memory, u->coding, sizeof *u->coding, 1);
  pf_free(memory, u->states, sizeof *u->states, u->chain_count);
  pf_free(memory, u, sizeof *u, 1);
  return status == PLANEFILE_OK && !pf_band_make_runs(memory, out) ? PLANEFILE_NO_MEMORY : status;
}
