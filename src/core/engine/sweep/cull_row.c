/* One row of tiles while one layer is culled and then fills it. Layers come from the camera
 * backwards.
 *
 *     tile     0   1   2   3   4   5   6   7
 *            +---+---+---+---+---+---+---+---+  top of the row
 *            | \ |   |   |   |   |   | / |   |  \ /: chords of chains, which meet at o
 *            |  o|   |   |   |   |   |o  |   |  chain A: +1, touches tiles 0 and 1
 *            |   |\  |   |   |   |  /|   |   |  chain B: -1, touches tiles 5 and 6
 *            +---+---+---+---+---+---+---+---+  foot of the row
 *   touched    1   1   0   0   0   1   1   0    by some chord, widened by its slack
 *   winding    1   1   1   1   1   0   0   0    changed in the first tile that a chain touches
 *   inside     0   0   1   1   1   0   0   0    the winding makes the layer present, and no
 *                                               chain touches the tile
 *   live       1   1   1   0   0   1   1   1    inside tiles whose layers now let almost nothing
 *                                               through are dead for the layers behind
 *
 * Where all tiles that a chain touches are dead already, it is not kept in this row of tiles, and a
 * deferred winding change takes its place. A chain that begins or ends inside the row is kept, and
 * no tile between such chains counts as inside, because the winding is not the same at all heights.
 *
 * A group has a veil of its own over the veil of its surroundings. At first all its tiles let
 * everything through, and it has the same live tiles as the surroundings; when it is left, the
 * tiles around it are dimmed by its share. The fold of colours does the same, so where a tile is
 * dead, the fold has stopped.
 *
 * The layers of a boolean tree are placed together first; where one is not certain to be painted it
 * fills nothing. All their deferred changes are kept, because others may be painted by their
 * presence.
 */
#include "engine/sweep/cull_grid.h"

/* The transmission of the tiles in front of the layer that is being culled. */
typedef struct cs_cull_veil {
  double through[CS_CULL_COLUMNS]; /* 1 unless dimmed */
  uint64_t live, dimmed;
  uint32_t group; /* or CS_CULL_NONE */
} veil;

typedef struct walk {
  const cs_cull_grid *grid;
  cs_cull_job *job;
  int32_t row;
  double top, foot;
  veil *veil;   /* the innermost */
  size_t trees; /* the trees that the walk has not passed yet */
} walk;

/* ---------------------------------------------------------------- veils */

/* Reduces the transmission of tiles; tiles below `opaque` become dead. */
static inline void dim(const walk *w, veil *tiles, int index, double through) {
  double *tile = &tiles->through[index];
  *tile *= through;
  if (*tile < w->grid->desc->opaque)
    tiles->live &= ~((uint64_t)1 << index);
}

static void begin_dimming(veil *tiles, uint64_t which) {
  for (uint64_t left = which & ~tiles->dimmed; left; left &= left - 1)
    tiles->through[__builtin_ctzll(left)] = 1;
  tiles->dimmed |= which;
}

static void cover(const walk *w, uint64_t inside, double through) {
  veil *tiles = w->veil;
  inside &= tiles->live;
  begin_dimming(tiles, inside);
  for (uint64_t left = inside; left; left &= left - 1)
    dim(w, tiles, __builtin_ctzll(left), through);
}

static void enter_group(walk *w, uint32_t group) {
  const cs_cull_group *inner = &w->grid->desc->groups[group];
  if (inner->parent != w->veil->group)
    enter_group(w, inner->parent); /* as deep as scenes may be nested */
  uint64_t live = w->veil->live;
  w->veil++;
  w->veil->live = live;
  w->veil->dimmed = 0;
  w->veil->group = group;
}

static void leave_group(walk *w) {
  const veil *inner = w->veil--;
  double fade = w->grid->desc->groups[inner->group].fade;
  uint64_t dimmed = inner->dimmed & w->veil->live;
  begin_dimming(w->veil, dimmed);
  for (uint64_t left = dimmed; left; left &= left - 1) {
    int index = __builtin_ctzll(left);
    dim(w, w->veil, index, (1 - fade) + fade * inner->through[index]);
  }
}

/* Moves back to just in front of a layer. */
static void move_to(walk *w, uint32_t layer) {
  const cs_cull_desc *desc = w->grid->desc;
  while (w->veil->group != CS_CULL_NONE && layer < desc->groups[w->veil->group].first)
    leave_group(w);
  if (desc->layers[layer].group != w->veil->group)
    enter_group(w, desc->layers[layer].group);
}

/* ---------------------------------------------------------------- where a layer is */

/* The chains of one layer in one row of tiles. A chain is partial where it begins or ends inside
 * the row. */
typedef struct footprint {
  uint64_t touched;
  cs_cull_columns partial; /* from the first to the last column of partial chains */
  bool is_partial;
  uint64_t crossed;                 /* columns in which some chain crosses the top of the row */
  int32_t winding[CS_CULL_COLUMNS]; /* the sum of the crossings of a column, where crossed */
} footprint;

static inline bool is_partial(const walk *w, const cs_boundary_chain *chain) {
  return chain->y0 > w->top || chain->y1 < w->foot;
}

static void add_chain(const walk *w, const cs_cull_crossing *crossing, footprint *f) {
  const cs_boundary_chain *ch = &w->grid->desc->set->chains[crossing->chain];
  cs_cull_columns r = w->grid->columns[crossing->place];
  f->touched |= cs_cull_columns_mask(r);
  if (ch->y0 <= w->top && w->top < ch->y1) {
    uint64_t bit = (uint64_t)1 << r.low;
    f->winding[r.low] = (f->crossed & bit ? f->winding[r.low] : 0) + ch->direction;
    f->crossed |= bit;
  }
  if (!is_partial(w, ch))
    return;
  f->partial.low = r.low < f->partial.low ? r.low : f->partial.low;
  f->partial.high = r.high > f->partial.high ? r.high : f->partial.high;
  f->is_partial = true;
}

/* The tiles that the chains [from, end) of one layer make certain to be inside, and those in which
 * it may be present. */
static cs_cull_presence find_presence(const walk *w, uint32_t from, uint32_t end,
                                      int32_t winding_mask) {
  footprint f;
  f.touched = f.crossed = 0;
  f.partial = (cs_cull_columns){CS_CULL_COLUMNS - 1, 0};
  f.is_partial = false;
  for (uint32_t k = from; k < end; k++)
    add_chain(w, &w->grid->crossing[k], &f);
  uint64_t inside = 0;
  int32_t winding = 0;
  for (uint64_t left = f.crossed; left; left &= left - 1) {
    int index = __builtin_ctzll(left);
    bool was_inside = winding & winding_mask;
    winding += f.winding[index];
    if (was_inside != ((winding & winding_mask) != 0))
      inside ^= ~(uint64_t)0 << index; /* from this column on */
  }
  uint64_t unsure = f.touched | (f.is_partial ? cs_cull_columns_mask(f.partial) : 0);
  return (cs_cull_presence){inside & ~unsure, inside | unsure};
}

/* ---------------------------------------------------------------- one layer */

/* Keeps a chain, or defers its winding change, for which there is room. Returns whether it is kept.
 */
static bool keep_or_defer(const walk *w, const cs_cull_crossing *crossing) {
  const cs_cull_grid *grid = w->grid;
  const cs_boundary_chain *ch = &grid->desc->set->chains[crossing->chain];
  cs_cull_columns r = grid->columns[crossing->place];
  if (is_partial(w, ch) || (cs_cull_columns_mask(r) & w->veil->live))
    return grid->cull->kept[crossing->place] = true;
  double x = grid->width * r.low / CS_CULL_COLUMNS;
  w->job->deferred_list[w->job->deferred_count++] = (cs_deferred){x, ch->layer, ch->direction};
  return false;
}

/* Culls the chains [from, end) of a layer. painted: the tiles that the layer paints all over. */
static void cull_layer(walk *w, uint32_t layer, uint32_t from, uint32_t end, uint64_t painted,
                       bool is_in_tree) {
  size_t deferred_before = w->job->deferred_count;
  bool keeps_any = false;
  for (uint32_t k = from; k < end; k++)
    keeps_any |= keep_or_defer(w, &w->grid->crossing[k]);
  if (!keeps_any && !is_in_tree && !(painted & w->veil->live))
    w->job->deferred_count = deferred_before; /* nothing of the layer can be seen in this row */
  if (w->grid->desc->layers[layer].through < 1)
    cover(w, painted, w->grid->desc->layers[layer].through);
}

/* ---------------------------------------------------------------- all layers */

static uint32_t layer_of(const walk *w, uint32_t k) { return w->grid->crossing[k].layer; }

/* The end of the chains from `from` on that are of a layer at or above `least`. */
static uint32_t end_of(const walk *w, uint32_t from, uint32_t least) {
  uint32_t end = from, limit = w->grid->crossing_starts[w->row + 1];
  while (end < limit && layer_of(w, end) >= least)
    end++;
  return end;
}

/* Culls the chains [from, end) of a tree. */
static void cull_tree(walk *w, size_t tree, uint32_t from, uint32_t end) {
  const cs_cull_desc *desc = w->grid->desc;
  uint32_t first = desc->trees[tree].first;
  cs_cull_presence *presences = w->job->presences;
  for (uint32_t layer = first; layer < desc->trees[tree].end; layer++)
    presences[layer - first] =
        (cs_cull_presence){0, desc->layers[layer].is_anywhere ? ~(uint64_t)0 : 0};
  for (uint32_t k = from, next; k < end; k = next) {
    uint32_t layer = layer_of(w, k);
    next = end_of(w, k, layer);
    presences[layer - first] = find_presence(w, k, next, desc->layers[layer].winding_mask);
  }
  desc->resolve(desc->user, tree, presences, w->job->scratch, w->job->painted);
  for (uint32_t k = from, next; k < end; k = next) {
    uint32_t layer = layer_of(w, k);
    next = end_of(w, k, layer);
    move_to(w, layer);
    cull_layer(w, layer, k, next, w->job->painted[layer - first], true);
  }
}

/* Finds the tree that a layer is in; false if it is in none. Trees come in order from the camera,
 * as layers do. */
static bool find_tree(walk *w, uint32_t layer) {
  const cs_cull_tree *trees = w->grid->desc->trees;
  while (w->trees > 0 && layer < trees[w->trees - 1].first)
    w->trees--;
  return w->trees > 0 && layer < trees[w->trees - 1].end;
}

celspan_status cs_cull_row_walk(const cs_cull_grid *grid, cs_cull_job *job, int32_t row) {
  uint32_t from = grid->crossing_starts[row], end = grid->crossing_starts[row + 1];
  walk w = {grid,
            job,
            row,
            cs_cull_grid_top(grid, row),
            cs_cull_grid_foot(grid, row),
            job->veils,
            grid->desc->tree_count};
  size_t before = job->deferred_count;
  w.veil->live = ~(uint64_t)0;
  w.veil->dimmed = 0;
  w.veil->group = CS_CULL_NONE;
  CS_TRY(CS_ARRAY_RESERVE(&job->context, job->deferred_list, before + (end - from)));
  for (uint32_t next; from < end; from = next) {
    uint32_t layer = layer_of(&w, from);
    if (find_tree(&w, layer)) {
      next = end_of(&w, from, grid->desc->trees[w.trees - 1].first);
      cull_tree(&w, w.trees - 1, from, next);
      continue;
    }
    next = end_of(&w, from, layer);
    move_to(&w, layer);
    cs_cull_presence presence =
        find_presence(&w, from, next, grid->desc->layers[layer].winding_mask);
    cull_layer(&w, layer, from, next, presence.certain, false);
  }
  grid->cull->deferred_starts[row + 1] = (uint32_t)(job->deferred_count - before);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- room */

static size_t tree_room(const cs_cull_desc *desc) {
  size_t most = 0;
  for (size_t i = 0; i < desc->tree_count; i++) {
    size_t layers = desc->trees[i].end - desc->trees[i].first;
    most = layers > most ? layers : most;
  }
  return most;
}

/* A group comes after the group around it. */
static size_t veil_room(const cs_cull_desc *desc) {
  size_t most = 0;
  for (size_t i = 0; i < desc->group_count; i++) {
    size_t depth = 1;
    for (uint32_t g = desc->groups[i].parent; g != CS_CULL_NONE; g = desc->groups[g].parent)
      depth++;
    most = depth > most ? depth : most;
  }
  return most + 1;
}

celspan_status cs_cull_row_begin(const cs_cull_grid *grid, cs_cull_job *job) {
  const cs_cull_desc *desc = grid->desc;
  size_t room = tree_room(desc);
  CS_TRY(CS_ARRAY_MAKE(&job->context, job->veils, veil_room(desc)));
  CS_TRY(CS_ARRAY_MAKE(&job->context, job->presences, room));
  CS_TRY(CS_ARRAY_MAKE(&job->context, job->painted, room));
  return CS_ARRAY_MAKE(&job->context, job->scratch, desc->scratch_size);
}
