/* One file, because its steps share the state of one interval and are inlined into one another. */
#include "engine/area/crowd.h"

#include "base/number.h"
#include "base/sort.h"

#define FEW 192   /* samples if no two layers hide more than 1/16 of each other's light */
#define MORE 1024 /* samples if no two layers hide more than 1/4 of it */
#define FEW_SHARE 0.063f
#define MORE_SHARE 0.255f
#define LATTICES 3
#define ROOM_SIZE (sizeof(cs_crowd_room) + CS_WIDE_LINE)
#define NOBODY UINT32_MAX
#define NEVER INT32_MAX /* a step of winding does not end */
#define STRONG 0.51f    /* a layer that hides more than this is strong */
#define STRONG_EACH 4   /* at most one edge in STRONG_EACH may belong to a strong layer */

/* Generators of the lattices. Lines in all directions divide the samples of a lattice about evenly,
 * because each generator is close to the golden section of their number. */
static const struct {
  int32_t count, generator;
} lattices[LATTICES] = {{FEW, 71}, {MORE, 633}, {CS_CROWD_SAMPLES, 1265}};

void cs_crowd_init(cs_crowd *crowd) { *crowd = (cs_crowd){.isa = cs_isa_best()}; }

void cs_crowd_finish(cs_crowd *crowd, cs_memory *memory) {
  cs_mem_free(memory, crowd->storage, ROOM_SIZE);
  cs_mem_free(memory, crowd->pieces, crowd->piece_capacity * sizeof *crowd->pieces);
  cs_mem_free(memory, crowd->members, crowd->member_capacity * sizeof *crowd->members);
  cs_mem_free(memory, crowd->entering, crowd->entering_capacity * sizeof *crowd->entering);
  cs_mem_free(memory, crowd->live, crowd->live_capacity * sizeof *crowd->live);
  cs_mem_free(memory, crowd->arriving, crowd->arriving_capacity * sizeof *crowd->arriving);
  cs_mem_free(memory, crowd->leaving, crowd->leaving_capacity * sizeof *crowd->leaving);
  cs_mem_free(memory, crowd->lines, crowd->line_capacity * sizeof *crowd->lines);
  *crowd = (cs_crowd){0};
}

/* ---------------------------------------------------------------- what is crowded */

/* The most light that a layer hides. */
static inline float strength(cs_v4 t) {
  float least = t[0] < t[1] ? t[0] : t[1];
  return 1 - (least < t[2] ? least : t[2]);
}

bool cs_crowd_suits(const cs_intervals *intervals, const cs_interval *interval,
                    const cs_composer *composer, int32_t width) {
  const cs_edges *edges = intervals->edges;
  const cs_stack *stack = composer->stack;
  size_t members = interval->high - interval->low, crossed = 0, strong = 0;
  if (members < CS_CROWD_LEAST || !composer->is_flat || stack->tree_count > 0)
    return false;
  for (size_t i = interval->low; i < interval->high; i++) {
    int32_t first = cs_edges_floor(edges->low[i], width),
            end = cs_edges_ceil(edges->high[i], width);
    crossed += (size_t)(end - first);
    strong += strength(stack->layers[intervals->active->crossing[i].layer].t) > STRONG;
  }
  int32_t columns =
      cs_edges_ceil(interval->extent.high, width) - cs_edges_floor(interval->extent.low, width);
  return crossed >= CS_CROWD_A_PIXEL * (size_t)columns && STRONG_EACH * strong <= members;
}

/* ---------------------------------------------------------------- members */

typedef struct drawing {
  cs_crowd *crowd;
  cs_local_sweep *sweep;
  celspan_context *context;
  cs_composer *composer;
  double next;               /* the least x of everything drawn after the interval */
  int32_t width, first, end; /* width: of the frame; first, end: the columns that are drawn */
  bool is_changed;           /* the composer has moved since the last cell was composed */
} drawing;

static celspan_status add_piece(const drawing *d, celspan_point above, celspan_point below) {
  cs_crowd *crowd = d->crowd;
  double y = d->sweep->y0, wide = below.x - above.x, height = below.y - above.y;
  return CS_APPEND(d->context, crowd->pieces, crowd->piece_count, crowd->piece_capacity,
                   (cs_crowd_piece){.xa = above.x,
                                    .xb = below.x,
                                    .top = above.y - y,
                                    .foot = below.y - y,
                                    .by_twice = cs_cover_by_twice(0, fabs(wide)),
                                    .slope = height > 0 ? (float)(wide / height) : 0});
}

/* Adds a member of the sweep. Until members are linked, its first column is in `next`. */
static celspan_status add_member(const drawing *d, const cs_member *member) {
  cs_crowd *crowd = d->crowd;
  const cs_extent extent = cs_member_extent(member);
  const size_t piece = crowd->piece_count;
  for (uint32_t k = 1; k < member->point_count; k++)
    CS_TRY(add_piece(d, member->points[k - 1], member->points[k]));
  return CS_APPEND(d->context, crowd->members, crowd->member_count, crowd->member_capacity,
                   (cs_crowd_member){.layer = member->layer,
                                     .piece = (uint32_t)piece,
                                     .piece_count = (uint32_t)(crowd->piece_count - piece),
                                     .next = (uint32_t)cs_edges_floor(extent.low, d->width),
                                     .direction = member->direction,
                                     .end = cs_edges_ceil(extent.high, d->width),
                                     .top = crowd->pieces[piece].top,
                                     .foot = crowd->pieces[crowd->piece_count - 1].foot});
}

/* Lists the members by the column in which they enter. */
static celspan_status link_members(const drawing *d) {
  cs_crowd *crowd = d->crowd;
  size_t columns = (size_t)(d->end - d->first) + 1;
  CS_TRY(CS_RESERVE(d->context, crowd->entering, crowd->entering_capacity, columns));
  for (size_t k = 0; k < columns; k++)
    crowd->entering[k] = NOBODY;
  for (size_t i = crowd->member_count; i-- > 0;) {
    uint32_t *entering = &crowd->entering[(int32_t)crowd->members[i].next - d->first];
    crowd->members[i].next = *entering;
    *entering = (uint32_t)i;
  }
  return CELSPAN_OK;
}

static celspan_status list_members(const drawing *d) {
  cs_crowd *crowd = d->crowd;
  crowd->piece_count = crowd->member_count = crowd->live_count = crowd->arriving_count = 0;
  for (size_t i = 0; i < d->sweep->count + d->sweep->begin_count; i++)
    CS_TRY(add_member(d, cs_local_sweep_member(d->sweep, i)));
  return link_members(d);
}

/* ---------------------------------------------------------------- entering and leaving columns */

static inline uint64_t key_of(uint32_t layer, size_t member) {
  return (uint64_t)(UINT32_MAX - layer) << 32 | member;
}

static inline uint32_t layer_of(uint64_t key) { return UINT32_MAX - (uint32_t)(key >> 32); }

static inline bool live_is_before(const cs_crowd_live *a, const cs_crowd_live *b) {
  return a->key < b->key;
}

CS_SORT_DEFINE(sort_live, cs_crowd_live, live_is_before)

/* Adds a member to those that arrive in the column. */
static celspan_status arrive(const drawing *d, size_t i) {
  cs_crowd *crowd = d->crowd;
  const cs_crowd_member *member = &crowd->members[i];
  return CS_APPEND(d->context, crowd->arriving, crowd->arriving_count, crowd->arriving_capacity,
                   (cs_crowd_live){key_of(member->layer, i), member->end});
}

/* Merges the arriving members into the live ones, all at once: there may be very many of both. */
static celspan_status merge_arriving(const drawing *d) {
  cs_crowd *crowd = d->crowd;
  size_t i = crowd->live_count, j = crowd->arriving_count, k = i + j;
  CS_TRY(CS_RESERVE(d->context, crowd->live, crowd->live_capacity, k));
  sort_live(crowd->arriving, j);
  while (j > 0)
    crowd->live[--k] = i > 0 && crowd->live[i - 1].key > crowd->arriving[j - 1].key
                           ? crowd->live[--i]
                           : crowd->arriving[--j];
  crowd->live_count += crowd->arriving_count;
  crowd->arriving_count = 0;
  return CELSPAN_OK;
}

/* The index among the live members of the step of winding of a layer at a height; the number of
 * live members if there is no such step. */
static size_t find_step(const cs_crowd *crowd, uint32_t layer, double height) {
  size_t k = 0;
  for (; k < crowd->live_count; k++)
    if (crowd->live[k].end == NEVER && layer_of(crowd->live[k].key) == layer &&
        crowd->members[(uint32_t)crowd->live[k].key].top == height)
      break;
  return k;
}

static celspan_status begin_step(const drawing *d, uint32_t layer, double height,
                                 int32_t direction) {
  cs_crowd *crowd = d->crowd;
  const cs_crowd_member step = {.layer = layer,
                                .piece = (uint32_t)crowd->piece_count,
                                .piece_count = 1,
                                .direction = direction,
                                .end = NEVER,
                                .top = height,
                                .foot = 1};
  CS_TRY(CS_APPEND(d->context, crowd->pieces, crowd->piece_count, crowd->piece_capacity,
                   (cs_crowd_piece){.xa = -1, .xb = -1, .top = height, .foot = 1}));
  CS_TRY(CS_APPEND(d->context, crowd->members, crowd->member_count, crowd->member_capacity, step));
  CS_TRY(arrive(d, crowd->member_count - 1));
  return merge_arriving(d);
}

/* From this column on, the winding of a layer changes below a height. If begins and ends cancel
 * out, no step remains. */
static celspan_status add_step(const drawing *d, uint32_t layer, double height, int32_t direction) {
  cs_crowd *crowd = d->crowd;
  size_t k = find_step(crowd, layer, height);
  if (k == crowd->live_count)
    return begin_step(d, layer, height, direction);
  cs_crowd_member *step = &crowd->members[(uint32_t)crowd->live[k].key];
  step->direction += direction;
  if (step->direction == 0)
    memmove(&crowd->live[k], &crowd->live[k + 1], (--crowd->live_count - k) * sizeof *crowd->live);
  return CELSPAN_OK;
}

/* Called when a member lies left of all columns that follow. */
static celspan_status pass(drawing *d, size_t i) {
  const cs_crowd_member member = d->crowd->members[i];
  d->crowd->members[i].is_passed = d->is_changed = true;
  if (member.top <= 0)
    cs_composer_cross(d->composer, member.layer, member.direction);
  else
    CS_TRY(add_step(d, member.layer, member.top, member.direction));
  return member.foot >= 1 ? CELSPAN_OK : add_step(d, member.layer, member.foot, -member.direction);
}

/* Passes the live members that end left of column p. Passing may add live members, so the members
 * that leave are removed first. */
static celspan_status leave(drawing *d, int32_t p) {
  cs_crowd *crowd = d->crowd;
  size_t kept = 0, leaving = 0;
  CS_TRY(CS_RESERVE(d->context, crowd->leaving, crowd->leaving_capacity, crowd->live_count));
  for (size_t k = 0; k < crowd->live_count; k++) {
    const cs_crowd_live live = crowd->live[k];
    crowd->live[kept] = live;
    kept += live.end > p;
    crowd->leaving[leaving] = (uint32_t)live.key;
    leaving += live.end <= p;
  }
  crowd->live_count = kept;
  for (size_t k = 0; k < leaving; k++)
    CS_TRY(pass(d, crowd->leaving[k]));
  return CELSPAN_OK;
}

/* Brings the live members and the composer to column p. */
static celspan_status enter(drawing *d, int32_t p) {
  const cs_deferred *next = d->sweep->deferred.next;
  CS_TRY(leave(d, p));
  for (uint32_t i = d->crowd->entering[p - d->first]; i != NOBODY; i = d->crowd->members[i].next)
    if (d->crowd->members[i].end <= p)
      CS_TRY(pass(d, i));
  for (uint32_t i = d->crowd->entering[p - d->first]; i != NOBODY; i = d->crowd->members[i].next)
    if (d->crowd->members[i].end > p)
      CS_TRY(arrive(d, i));
  CS_TRY(merge_arriving(d));
  cs_deferred_forward(&d->sweep->deferred, d->composer, p);
  d->is_changed |= d->sweep->deferred.next != next;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a pixel */

/* The fold of a pixel, from the camera backwards. Each sample transmits `through` times `whole`,
 * the transmission of the layers that cover the whole pixel. */
typedef struct fold {
  cs_crowd_room *room;
  const cs_crowd_lattice *lattice;
  int channels; /* how many transmit different shares: 1 or 3 */
  cs_v4 light, whole;
  cs_v4 mean; /* the mean of `through` */
} fold;

static inline bool is_grey(cs_v4 t) { return t[0] == t[1] && t[1] == t[2]; }

/* Begins the fold, with the number of samples that the layers with edges in the pixel need. */
static void begin_fold(const drawing *d, fold *f) {
  const cs_layer *layers = d->composer->stack->layers;
  const cs_crowd *crowd = d->crowd;
  float most = 0, second = 0;
  f->channels = 1;
  for (size_t k = 0; k < crowd->live_count; k++) {
    uint32_t layer = layer_of(crowd->live[k].key);
    if (k > 0 && layer_of(crowd->live[k - 1].key) == layer)
      continue;
    float hides = strength(layers[layer].t);
    second = hides > most ? most : hides > second ? hides : second;
    most = hides > most ? hides : most;
    f->channels = is_grey(layers[layer].t) ? f->channels : 3;
  }
  float share = most * second;
  f->room = crowd->room;
  f->lattice = &f->room->lattices[share <= FEW_SHARE ? 0 : share <= MORE_SHARE ? 1 : 2];
  for (int c = 0; c < f->channels; c++)
    for (int32_t k = 0; k < f->lattice->count; k++)
      f->room->through[c][k] = 1;
  f->light = cs_v4_all(0);
  f->whole = f->mean = cs_v4_all(1);
}

/* Folds a layer that covers a share of every sample. */
static void add_even(fold *f, const cs_layer *layer, float share) {
  f->light += f->whole * f->mean * (share * layer->s);
  f->whole *= (1 - share) + share * layer->t;
}

/* Folds a layer that covers the samples inside it, each with a weight. */
static void add_inside(const drawing *d, fold *f, const cs_layer *layer, float weight) {
  cs_v4 seen = cs_v4_all(0), hides = weight * (1 - layer->t);
  float each = 1.0f / (float)f->lattice->count;
  for (int c = 0; c < f->channels; c++)
    seen[c] = each * CS_WIDE_CHOOSE(d->crowd->isa, cs_crowd_dim)(
                         f->room->through[c], f->room->inside, f->lattice->count, hides[c]);
  if (f->channels == 1)
    seen = cs_v4_all(seen[0]);
  f->light += f->whole * seen * (weight * layer->s);
  f->mean -= seen * hides;
}

/* Adds the area right of a piece that goes through the row, in all columns up to x. */
static inline double passed(const cs_crowd_piece *piece, double x) {
  return cs_cover_passed(cs_number_least(piece->xa, piece->xb),
                         cs_number_most(piece->xa, piece->xb), piece->by_twice, x);
}

/* The lines of live members [first, end), which belong to one layer; and the area right of these
 * lines in the pixel of column p, counted once for each winding of the layer. */
static double find_lines(const drawing *d, int32_t p, size_t first, size_t end, size_t *count) {
  cs_crowd *crowd = d->crowd;
  double area = 0;
  *count = 0;
  for (size_t k = first; k < end; k++) {
    const cs_crowd_member *member = &crowd->members[(uint32_t)crowd->live[k].key];
    for (uint32_t i = 0; i < member->piece_count; i++) {
      const cs_crowd_piece *piece = &crowd->pieces[member->piece + i];
      double right = passed(piece, p + 1) - passed(piece, p);
      area += member->direction * (piece->foot - piece->top) * right;
      crowd->lines[(*count)++] =
          (cs_crowd_line){(float)(piece->xa - p), piece->slope, (float)piece->top,
                          (float)piece->foot, member->direction};
    }
  }
  return area;
}

/* The share of the pixel that lies in a layer. The layer winds `low` or `high` times around the
 * samples, and on the average `winding` times. */
static double share_inside(const cs_crowd_cover *cover, double winding, int32_t mask) {
  int32_t most =
      cover->high > cover->low || winding >= cover->low ? cover->low + 1 : cover->low - 1;
  double share = cs_number_clamp(fabs(winding - cover->low), 0, 1);
  return ((most & mask) != 0 ? share : 0) + ((cover->low & mask) != 0 ? 1 - share : 0);
}

/* x of a member at a height that the member goes through. */
static double x_at(const cs_crowd *crowd, const cs_crowd_member *member, double y) {
  const cs_crowd_piece *piece = &crowd->pieces[member->piece];
  for (uint32_t i = 1; i < member->piece_count && piece->foot < y; i++)
    piece++;
  double height = piece->foot - piece->top;
  return height > 0 ? piece->xa + (piece->xb - piece->xa) * ((y - piece->top) / height) : piece->xa;
}

/* Whether a lies left of b at all heights where the pieces of b begin and end. */
static bool is_left_of(const cs_crowd *crowd, const cs_crowd_member *a, const cs_crowd_member *b) {
  for (uint32_t i = 0; i < b->piece_count; i++) {
    const cs_crowd_piece *piece = &crowd->pieces[b->piece + i];
    if (x_at(crowd, a, piece->top) > piece->xa || x_at(crowd, a, piece->foot) > piece->xb)
      return false;
  }
  return true;
}

/* The same in the other direction: whether a lies right of b at all heights where the pieces of b
 * begin and end. */
static bool is_right_of(const cs_crowd *crowd, const cs_crowd_member *b, const cs_crowd_member *a) {
  for (uint32_t i = 0; i < a->piece_count; i++) {
    const cs_crowd_piece *piece = &crowd->pieces[a->piece + i];
    if (x_at(crowd, b, piece->top) < piece->xa || x_at(crowd, b, piece->foot) < piece->xb)
      return false;
  }
  return true;
}

static inline bool goes_through(const cs_crowd_member *member) {
  return member->top <= 0 && member->foot >= 1;
}

/* Whether a layer can wind in only two ways around the points of a pixel: it has one edge there, or
 * the two sides of one shape. */
static bool is_plain(const cs_crowd *crowd, size_t first, size_t end) {
  if (end - first == 1)
    return true;
  const cs_crowd_member *a = &crowd->members[(uint32_t)crowd->live[first].key];
  const cs_crowd_member *b = &crowd->members[(uint32_t)crowd->live[first + 1].key];
  if (end - first > 2 || a->direction + b->direction != 0 || !goes_through(a) || !goes_through(b))
    return false;
  return (is_left_of(crowd, a, b) && is_right_of(crowd, b, a)) ||
         (is_left_of(crowd, b, a) && is_right_of(crowd, a, b));
}

/* A layer with edges in the pixel. */
typedef struct partial {
  int32_t base, mask; /* as for cs_crowd_find */
  size_t lines;
} partial;

static cs_crowd_cover find_samples(const drawing *d, const cs_crowd_lattice *lattice,
                                   const partial *layer) {
  const cs_crowd *crowd = d->crowd;
  return CS_WIDE_CHOOSE(crowd->isa, cs_crowd_find)(lattice, crowd->lines, layer->lines, layer->base,
                                                   layer->mask, crowd->room->inside);
}

/* Adds the layer of the live members [first, end). If it may wind in three or more ways, as at the
 * joints of strokes, areas do not give the share of the pixel that lies in the layer: the share is
 * counted with very many samples. */
static void add_partial(const drawing *d, fold *f, int32_t p, size_t first, size_t end) {
  uint32_t index = layer_of(d->crowd->live[first].key);
  const cs_presence *presence = &d->composer->presences[index];
  const cs_layer *layer = &d->composer->stack->layers[index];
  const cs_crowd_lattice *finest = &f->room->lattices[LATTICES - 1];
  partial at = {presence->winding, presence->rule.winding_mask, 0};
  double share = 0, winding = at.base + find_lines(d, p, first, end, &at.lines);
  bool plain = is_plain(d->crowd, first, end);
  if (!plain)
    share = (double)find_samples(d, finest, &at).count / finest->count;
  cs_crowd_cover cover = find_samples(d, f->lattice, &at);
  if (plain)
    share = share_inside(&cover, winding, at.mask);
  if (cover.count > 0)
    add_inside(d, f, layer, (float)(share * f->lattice->count / cover.count));
  else
    add_even(f, layer, (float)share);
}

static inline uint32_t live_layer(const cs_crowd *crowd, size_t k) {
  return k < crowd->live_count ? layer_of(crowd->live[k].key) : CS_STACK_NONE;
}

/* Folds the layers of the pixel of column p: layers with edges in it, which are the live members,
 * and layers that cover all of it. */
static void fold_layers(const drawing *d, fold *f, int32_t p) {
  const cs_composer *composer = d->composer;
  const cs_stack *stack = composer->stack;
  uint32_t whole = cs_set_below(composer->set, composer->filled, (uint32_t)stack->layer_count);
  size_t k = 0;
  while (!cs_over_is_opaque(f->whole)) {
    uint32_t edged = live_layer(d->crowd, k);
    if (whole == CS_STACK_NONE && edged == CS_STACK_NONE)
      break;
    if (edged == CS_STACK_NONE || (whole != CS_STACK_NONE && whole > edged)) {
      add_even(f, &stack->layers[whole], 1);
    } else {
      size_t first = k;
      while (live_layer(d->crowd, k) == edged)
        k++;
      add_partial(d, f, p, first, k);
      if (whole != edged)
        continue;
    }
    whole = cs_set_below(composer->set, composer->filled, whole);
  }
}

/* The mean colour of the pixel of column p. */
static cs_v4 colour_of(const drawing *d, int32_t p) {
  fold f;
  cs_over over;
  begin_fold(d, &f);
  fold_layers(d, &f, p);
  cs_over_begin(&over, d->composer->stack, d->composer->outers);
  over.e = f.light;
  over.t = f.whole * f.mean;
  return cs_v4_settled(cs_over_end(&over));
}

/* ---------------------------------------------------------------- the interval */

/* Gives the pixels from column p on the colours of a cell. */
static celspan_status put_cell(const drawing *d, int32_t p, const cs_cell *left,
                               const cs_cell *cell) {
  cs_window *window = &d->sweep->target->window;
  const cs_border border = {{p, d->sweep->y0, p, d->sweep->y1}, left, cell};
  if (p <= d->next) /* edges that are drawn later may change the pixels from there on */
    CS_TRY(cs_window_begin_item(window, p));
  if (!cs_composer_same(d->composer, left, cell))
    CS_TRY(cs_window_add(window, &border));
  cs_window_end_item(window, cell);
  return CELSPAN_OK;
}

static celspan_status draw_column(drawing *d, int32_t p, const cs_cell **left) {
  CS_TRY(enter(d, p));
  if (d->crowd->live_count == 0 && !d->is_changed)
    return CELSPAN_OK;
  cs_cell *cell = cs_arena_take(d->context, d->sweep->arena, sizeof *cell);
  if (!cell)
    return CELSPAN_NO_MEMORY;
  d->is_changed = d->crowd->live_count > 0;
  if (d->is_changed)
    *cell = (cs_cell){.colour = colour_of(d, p)};
  else
    cs_composer_cell(d->composer, cell);
  CS_TRY(put_cell(d, p, *left, cell));
  *left = cell;
  return d->composer->failure;
}

static celspan_status draw_columns(drawing *d, const cs_cell *right) {
  const cs_cell *left = d->sweep->left;
  CS_TRY(CS_RESERVE(d->context, d->crowd->lines, d->crowd->line_capacity,
                    d->crowd->piece_count + 2 * d->crowd->member_count));
  for (int32_t p = d->first; p < d->end; p++)
    CS_TRY(draw_column(d, p, &left));
  return put_cell(d, d->end, left, right);
}

/* Brings the composer back to the left of the interval. */
static void go_back(drawing *d) {
  for (size_t i = 0; i < d->crowd->member_count; i++) {
    const cs_crowd_member *member = &d->crowd->members[i];
    if (member->is_passed && member->top <= 0)
      cs_composer_cross(d->composer, member->layer, -member->direction);
  }
  cs_deferred_to(&d->sweep->deferred, d->composer, -INFINITY);
}

static void make_lattice(cs_crowd_lattice *lattice, int32_t count, int32_t generator) {
  lattice->count = count;
  for (int32_t k = 0; k < count; k++) {
    lattice->x[k] = ((float)(k * generator % count) + 0.5f) / (float)count;
    lattice->y[k] = ((float)k + 0.5f) / (float)count;
  }
}

static celspan_status make_room(const drawing *d) {
  d->crowd->storage = cs_mem_array(d->context->memory, 1, ROOM_SIZE);
  if (!d->crowd->storage)
    return cs_fail_memory(d->context);
  cs_crowd_room *room = cs_wide_align(d->crowd->storage);
  for (size_t k = 0; k < LATTICES; k++)
    make_lattice(&room->lattices[k], lattices[k].count, lattices[k].generator);
  d->crowd->room = room;
  return CELSPAN_OK;
}

celspan_status cs_crowd_draw(cs_crowd *crowd, cs_local_sweep *sweep, cs_extent extent, double next,
                             const cs_cell *right) {
  int32_t width = sweep->target->window.width;
  drawing d = {.crowd = crowd,
               .sweep = sweep,
               .context = sweep->composer->context,
               .composer = sweep->composer,
               .next = next,
               .width = width,
               .first = cs_edges_floor(extent.low, width),
               .end = cs_edges_ceil(extent.high, width)};
  if (!crowd->storage)
    CS_TRY(make_room(&d));
  CS_TRY(list_members(&d));
  celspan_status status = draw_columns(&d, right);
  go_back(&d);
  return status;
}
