#include "engine/sweep/active.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/sort.h"
#include "engine/sweep/order.h"

/* Up to this number, chains that begin together are inserted one by one. Boundaries that have
 * changed places are inserted one by one, too, while not more than MOVED_EACH others are moved for
 * each of them. Beyond these numbers all boundaries are sorted at once. */
#define MANY_BEGIN 64
#define MOVED_EACH 16

/* The arrays that are kept in order, one item a boundary. Whoever adds such an array to cs_active
 * adds it here. x_next is not listed, because every row computes it again. */
#define EACH_ORDERED(DO)                                                                           \
  DO(active->x)                                                                                    \
  DO(active->segments.x0)                                                                          \
  DO(active->segments.y0)                                                                          \
  DO(active->segments.slope)                                                                       \
  DO(active->segments.curve)                                                                       \
  DO(active->segments.y1)                                                                          \
  DO(active->crossing)                                                                             \
  DO(active->slot)

/* All arrays in the storage, wider items first, so that each is aligned. */
#define EACH_ARRAY(DO)                                                                             \
  DO(active->walks)                                                                                \
  DO(active->x_next)                                                                               \
  EACH_ORDERED(DO)                                                                                 \
  DO(active->store.free_slots)                                                                     \
  DO(active->bend_of)                                                                              \
  DO(active->ended)

/* The bytes of the storage for `capacity` boundaries, including those that aligning it may cost. */
static size_t storage_size(const cs_active *active, size_t capacity) {
#define ITEM_SIZE(array) +sizeof *(array)
  (void)active;
  return capacity > 0 ? capacity * (EACH_ARRAY(ITEM_SIZE)) + CS_WIDE_LINE : 0;
#undef ITEM_SIZE
}

void cs_active_init(cs_active *active, const cs_boundary_set *set, const cs_cull *cull,
                    bool notes_bends) {
  *active = (cs_active){.set = set, .cull = cull, .isa = cs_isa_best(), .notes_bends = notes_bends};
}

void cs_active_finish(cs_active *active, cs_memory *memory) {
  cs_mem_free(memory, active->store.storage, storage_size(active, active->store.capacity));
  CS_ARRAYS_FREE(memory, active, bends, vertices);
  *active = (cs_active){0};
}

/* ---------------------------------------------------------------- room */

static void *carve(unsigned char **at, const void *old, size_t old_count, size_t new_count,
                   size_t item_size) {
  void *array = *at;
  if (old_count > 0)
    memcpy(array, old, old_count * item_size);
  *at += new_count * item_size;
  return array;
}

/* The storage is zeroed, because vector code goes beyond the count. Zeros are quick there, whereas
 * fresh memory may contain denormal numbers, which are slow. */
static celspan_status grow(celspan_context *context, cs_active *active) {
  cs_active_store *store = &active->store;
  size_t old = store->capacity, wanted = old ? 2 * old : 64;
  void *storage;
  CS_TRY(cs_mem_make(context, &storage, 1, storage_size(active, wanted)));
  unsigned char *at = cs_wide_align(storage);
#define CARVE(array) array = carve(&at, array, old, wanted, sizeof *(array));
  EACH_ARRAY(CARVE)
#undef CARVE
  cs_mem_free(context->memory, store->storage, storage_size(active, old));
  store->storage = storage;
  store->capacity = wanted;
  for (size_t slot = wanted; slot-- > old;)
    store->free_slots[store->free_count++] = (uint32_t)slot;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one boundary */

/* Copies the walk's current segment into the arrays. */
static void copy_segment(cs_active *active, size_t i) {
  const cs_boundary_walk *walk = &active->walks[active->slot[i]];
  active->segments.x0[i] = walk->x0;
  active->segments.y0[i] = walk->y0;
  active->segments.slope[i] = walk->slope;
  active->segments.curve[i] = walk->curve;
  active->segments.y1[i] = walk->y1;
}

static void free_slot(cs_active *active, size_t i) {
  active->store.free_slots[active->store.free_count++] = active->slot[i];
}

static celspan_status append(celspan_context *context, cs_active *active, uint32_t chain,
                             double y) {
  if (active->count + CS_ADVANCE_BATCH >= active->store.capacity)
    CS_TRY(grow(context, active));
  uint32_t slot = active->store.free_slots[--active->store.free_count];
  const cs_boundary_chain *c = &active->set->chains[chain];
  size_t i = active->count++;
  active->slot[i] = slot;
  active->crossing[i] = (cs_crossing){c->layer, c->direction};
  cs_boundary_start(active->set, chain, y, &active->walks[slot]);
  copy_segment(active, i);
  active->x[i] = cs_boundary_x(&active->walks[slot], y);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- moving */

/* Moves boundaries [from, from + count) to `to`. */
static void move_boundaries(cs_active *active, size_t to, size_t from, size_t count) {
#define MOVE(array) memmove((array) + to, (array) + from, count * sizeof *(array));
  EACH_ORDERED(MOVE)
#undef MOVE
}

/* Moves item `from` left to index `to`; the items between move right by one. */
static inline void rotate_items(void *array, size_t size, size_t to, size_t from) {
  unsigned char *items = array, moved[sizeof(uint64_t)];
  memcpy(moved, items + from * size, size);
  if (from == to + 1) /* mostly; then no function is called */
    memcpy(items + from * size, items + to * size, size);
  else
    memmove(items + (to + 1) * size, items + to * size, (from - to) * size);
  memcpy(items + to * size, moved, size);
}

/* Inserts a boundary in the same way. */
static void insert_boundary(cs_active *active, size_t to, size_t from) {
#define ROTATE(array)                                                                              \
  static_assert(sizeof *(array) <= sizeof(uint64_t), "");                                          \
  rotate_items(array, sizeof *(array), to, from);
  EACH_ORDERED(ROTATE)
#undef ROTATE
}

static inline void permute_items(void *array, size_t size, size_t count, const uint32_t *places,
                                 uint64_t *room) {
  unsigned char *items = array;
  for (size_t k = 0; k < count; k++)
    memcpy(&room[k], items + places[k] * size, size);
  for (size_t k = 0; k < count; k++)
    memcpy(items + k * size, &room[k], size);
}

/* Moves boundary places[k] to index k. room: for as many numbers as there are boundaries. */
static void permute_boundaries(cs_active *active, const uint32_t *places, uint64_t *room) {
#define PERMUTE(array) permute_items(array, sizeof *(array), active->count, places, room);
  EACH_ORDERED(PERMUTE)
#undef PERMUTE
}

/* ---------------------------------------------------------------- order */

/* dx/dy at the current height. */
static inline double slope_at(const cs_active *active, size_t i) {
  return active->segments.slope[i] +
         2 * active->segments.curve[i] * (active->y - active->segments.y0[i]);
}

/* Whether boundary i belongs to the right of boundary j. */
static inline bool is_right(const cs_active *active, size_t i, size_t j) {
  if (active->x[i] != active->x[j])
    return active->x[i] > active->x[j];
  return cs_order_is_right(slope_at(active, i), active->walks[active->slot[i]].chain,
                           slope_at(active, j), active->walks[active->slot[j]].chain);
}

/* The index where boundary i belongs among 0..count-1, which are in order. The search goes left in
 * doubling strides and then by halves: quick for a boundary that is almost in its place. */
static size_t find_place(const cs_active *active, size_t i, size_t count) {
  size_t high = count, step = 1;
  while (high >= step && is_right(active, high - step, i)) {
    high -= step;
    step *= 2;
  }
  size_t low = high >= step ? high - step + 1 : 0;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (is_right(active, middle, i))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/* A boundary with the values that determine its place in the order. */
typedef struct key {
  double x, slope;
  uint32_t chain, index;
} key;

static inline bool key_is_before(const key *a, const key *b) {
  return a->x != b->x ? a->x < b->x : cs_order_is_right(b->slope, b->chain, a->slope, a->chain);
}

CS_SORT_DEFINE(sort_keys, key, key_is_before)

static void find_keys(const cs_active *active, key *keys) {
  for (size_t i = 0; i < active->count; i++)
    keys[i] =
        (key){active->x[i], slope_at(active, i), active->walks[active->slot[i]].chain, (uint32_t)i};
}

/* Sorts the order at the current height, wherever the boundaries are in it. */
static celspan_status sort_all(celspan_context *context, cs_active *active, cs_change *change) {
  size_t count = active->count, size = sizeof(key) + sizeof(uint64_t) + sizeof(uint32_t);
  key *keys = count < 2 ? NULL : cs_mem_array(context->memory, count, size);
  *change = cs_change_all;
  if (count < 2)
    return CELSPAN_OK;
  if (!keys)
    return cs_fail_memory(context);
  uint64_t *room = (uint64_t *)(keys + count);
  uint32_t *places = (uint32_t *)(room + count);
  find_keys(active, keys);
  sort_keys(keys, count);
  for (size_t i = 0; i < count; i++)
    places[i] = keys[i].index;
  permute_boundaries(active, places, room);
  cs_mem_free(context->memory, keys, count * size);
  return CELSPAN_OK;
}

/* Sorts the order at the current height, which is nearly sorted: by insertion, as long as that
 * moves few boundaries. */
static celspan_status sort(celspan_context *context, cs_active *active, cs_change *change) {
  const double *x = active->x;
  size_t moved = 0, most = MOVED_EACH * active->count;
  if (CS_WIDE_CHOOSE(active->isa, cs_advance_rises)(x, active->count))
    return CELSPAN_OK;
  for (size_t i = 1; i < active->count; i++) {
    if (x[i - 1] < x[i]) /* where x is equal, slopes and chains decide */
      continue;
    size_t to = find_place(active, i, i);
    if (to == i)
      continue;
    if ((moved += i - to) > most)
      return sort_all(context, active, change);
    insert_boundary(active, to, i);
    *change = cs_change_join(*change, (cs_change){to, active->count - (i + 1)});
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- heights */

/* The height above which no chain begins and no other row of tiles begins. */
static double find_calm(const cs_active *active) {
  const cs_cull *cull = active->cull;
  const cs_boundary_set *set = active->set;
  double begin = active->next < set->chain_count ? set->chains[active->next].y0 : INFINITY;
  if (active->tile_row + 1 >= cull->tile_rows)
    return begin;
  double rounding = 1 - 0x1p-40, foot = (active->tile_row + 1) * cull->tile_height * rounding;
  return begin < foot ? begin : foot;
}

static int32_t tile_row_of(const cs_active *active, double y) {
  return active->cull->tile_rows > 0 ? cs_cull_row(active->cull, y) : 0;
}

/* Whether so many chains begin at or above y that they are not inserted one by one. */
static bool do_many_begin(const cs_active *active, double y) {
  size_t last = active->next + MANY_BEGIN;
  return last < active->set->chain_count && active->set->chains[last].y0 <= y;
}

/* Boundaries that have been appended to those in order, and are merged with them in one pass:
 *
 *     old      a  b  c  d  e                  places[k]: before which of them the k-th one belongs,
 *     new                     q  p            items[k]   from left to right
 *     merged   a  p  b  c  q  d  e
 */
typedef struct begun {
  size_t old, count;
  uint32_t items[MANY_BEGIN], places[MANY_BEGIN];
} begun;

static inline void merge_items(void *array, size_t size, const begun *b) {
  unsigned char *items = array;
  uint64_t room[MANY_BEGIN];
  for (size_t k = 0; k < b->count; k++)
    memcpy(&room[k], items + b->items[k] * size, size);
  for (size_t k = b->count, end = b->old; k-- > 0; end = b->places[k]) {
    size_t place = b->places[k];
    memmove(items + (place + k + 1) * size, items + place * size, (end - place) * size);
    memcpy(items + (place + k) * size, &room[k], size);
  }
}

/* Merges boundaries old..count-1, of which there are at most MANY_BEGIN, with those before. */
static void merge_begun(cs_active *active, size_t old, cs_change *change) {
  begun b; /* not all of it is needed */
  b.old = old;
  b.count = 0;
  for (size_t i = old; i < active->count; i++) {
    size_t k = b.count++;
    for (; k > 0 && is_right(active, b.items[k - 1], i); k--)
      b.items[k] = b.items[k - 1];
    b.items[k] = (uint32_t)i;
  }
  for (size_t k = 0; k < b.count; k++)
    b.places[k] = (uint32_t)find_place(active, b.items[k], old);
#define MERGE(array) merge_items(array, sizeof *(array), &b);
  EACH_ORDERED(MERGE)
#undef MERGE
  if (b.count > 0)
    *change = cs_change_join(*change, (cs_change){b.places[0], old - b.places[b.count - 1]});
}

/* Takes in the chains that begin at or above y. */
static celspan_status begin_chains(celspan_context *context, cs_active *active, double y,
                                   cs_change *change) {
  const cs_boundary_chain *chains = active->set->chains;
  bool many = do_many_begin(active, y);
  size_t old = active->count;
  for (; active->next < active->set->chain_count && chains[active->next].y0 <= y; active->next++) {
    uint32_t chain = (uint32_t)active->next;
    if (y < chains[chain].y1 && cs_cull_keeps(active->cull, chain, active->tile_row))
      CS_TRY(append(context, active, chain, y));
  }
  if (many)
    return sort_all(context, active, change);
  merge_begun(active, old, change);
  return CELSPAN_OK;
}

celspan_status cs_active_start(celspan_context *context, cs_active *active, double y) {
  cs_change change = cs_change_none; /* the caller does not need it */
  for (size_t i = 0; i < active->count; i++)
    free_slot(active, i);
  active->count = 0;
  active->next = 0;
  active->y = active->y_next = y;
  active->bend_count = active->vertex_count = 0;
  active->tile_row = tile_row_of(active, y);
  CS_TRY(begin_chains(context, active, y, &change));
  active->calm_until = find_calm(active);
  return CELSPAN_OK;
}

static celspan_status note_vertex(celspan_context *context, cs_active *active, double x, double y) {
  return CS_ARRAY_APPEND(context, active->vertices, active->vertex_count, (celspan_point){x, y});
}

static void widen(cs_bend *noted, double x) {
  noted->low = x < noted->low ? x : noted->low;
  noted->high = x > noted->high ? x : noted->high;
}

static celspan_status note_bend(celspan_context *context, cs_active *active, const cs_bend *noted) {
  CS_TRY(CS_ARRAY_RESERVE(context, active->bends, active->bend_count + 1));
  active->bend_of[noted->boundary] = (uint32_t)active->bend_count;
  active->bends[active->bend_count++] = *noted;
  return CELSPAN_OK;
}

/* Advances boundary i until its segment contains y or its chain ends. */
static celspan_status step(celspan_context *context, cs_active *active, size_t i, double y) {
  cs_boundary_walk *walk = &active->walks[active->slot[i]];
  bool goes_on = true;
  while (walk->y1 <= y && goes_on)
    goes_on = cs_boundary_next(active->set, walk);
  copy_segment(active, i);
  active->x_next[i] = goes_on ? cs_boundary_x(walk, y) : walk->x1;
  return goes_on ? CELSPAN_OK
                 : note_bend(context, active, &(cs_bend){.boundary = (uint32_t)i, .ends = true});
}

/* The same, noting the vertices on the way. A displaced vertex may lie a little above the previous
 * one; such vertices are not noted. */
static celspan_status bend(celspan_context *context, cs_active *active, size_t i, double y) {
  cs_boundary_walk *walk = &active->walks[active->slot[i]];
  cs_bend noted = {.boundary = (uint32_t)i, .vertex = (uint32_t)active->vertex_count};
  double above = active->y;
  noted.low = noted.high = active->x[i];
  while (walk->y1 <= y && !noted.ends) {
    active->x_next[i] = walk->x1;
    if (walk->y1 > above && walk->y1 < y) {
      CS_TRY(note_vertex(context, active, walk->x1, above = walk->y1));
      widen(&noted, walk->x1);
    }
    noted.ends = !cs_boundary_next(active->set, walk);
  }
  noted.ends_above = noted.ends && walk->y1 < y;
  noted.vertex_count = (uint32_t)active->vertex_count - noted.vertex;
  copy_segment(active, i);
  if (!noted.ends)
    active->x_next[i] = cs_boundary_x(walk, y);
  widen(&noted, active->x_next[i]);
  if (noted.vertex_count == 0 && !noted.ends) /* the two segments join at y itself */
    return CELSPAN_OK;
  return note_bend(context, active, &noted);
}

/* How many neighbours of boundary i are out of order with it at y_next. */
static size_t count_falls(const cs_active *active, size_t i) {
  const double *x = active->x_next;
  return (i > 0 && !(x[i - 1] < x[i])) + (i + 1 < active->count && !(x[i] < x[i + 1]));
}

celspan_status cs_active_advance(celspan_context *context, cs_active *active, double y) {
  active->y_next = y;
  active->bend_count = active->vertex_count = 0;
  cs_advanced found = CS_WIDE_CHOOSE(active->isa, cs_advance_to)(&active->segments, active->count,
                                                                 y, active->x_next, active->ended);
  for (size_t k = 0; k < found.ended; k++) {
    size_t i = active->ended[k];
    found.falls -= count_falls(active, i);
    CS_TRY(active->notes_bends ? bend(context, active, i, y) : step(context, active, i, y));
    found.falls += count_falls(active, i);
  }
  active->rises = found.falls == 0;
  return CELSPAN_OK;
}

/* Removes the chains that have ended. */
static void drop_ended(cs_active *active, cs_change *change) {
  size_t kept = 0, from = 0, old_count = active->count;
  for (size_t k = 0; k < active->bend_count; k++) {
    size_t i = active->bends[k].boundary;
    if (!active->bends[k].ends)
      continue;
    free_slot(active, i);
    if (kept < from)
      move_boundaries(active, kept, from, i - from);
    kept += i - from;
    *change = cs_change_join(*change, (cs_change){kept, old_count - (i + 1)});
    from = i + 1;
  }
  if (kept < from)
    move_boundaries(active, kept, from, old_count - from);
  active->count = kept + (old_count - from);
}

/* Removes the chains that the new row of tiles does not keep, and appends those that the row of
 * tiles before did not keep. */
static celspan_status change_tile_row(celspan_context *context, cs_active *active) {
  const cs_cull *cull = active->cull;
  size_t kept = 0;
  for (size_t i = 0; i < active->count; i++) {
    uint32_t chain = active->walks[active->slot[i]].chain;
    if (!cs_cull_keeps(cull, chain, active->tile_row))
      free_slot(active, i);
    else
      move_boundaries(active, kept++, i, 1);
  }
  active->count = kept;
  for (uint32_t k = cull->enter_starts[active->tile_row];
       k < cull->enter_starts[active->tile_row + 1]; k++)
    if (active->y < active->set->chains[cull->enters[k]].y1)
      CS_TRY(append(context, active, cull->enters[k], active->y));
  return CELSPAN_OK;
}

/* Makes y_next the current height. */
static void move_to_next(cs_active *active) {
  double *left_behind = active->x;
  active->x = active->x_next;
  active->x_next = left_behind;
  active->y = active->y_next;
}

/* Removes, sorts and inserts boundaries, as the new height requires. */
static celspan_status settle_events(celspan_context *context, cs_active *active,
                                    cs_change *change) {
  int32_t tile_row = tile_row_of(active, active->y_next);
  *change = cs_change_all;
  if (tile_row > active->tile_row + 1)
    return cs_active_start(context, active, active->y_next);
  move_to_next(active);
  *change = cs_change_none;
  if (active->bend_count > 0)
    drop_ended(active, change);
  active->bend_count = active->vertex_count = 0;
  if (tile_row != active->tile_row) {
    active->tile_row = tile_row;
    CS_TRY(change_tile_row(context, active));
    *change = cs_change_all;
    active->rises = false;
  }
  if (!active->rises)
    CS_TRY(sort(context, active, change));
  CS_TRY(begin_chains(context, active, active->y, change));
  active->calm_until = find_calm(active);
  return CELSPAN_OK;
}

celspan_status cs_active_settle(celspan_context *context, cs_active *active, cs_change *change) {
  if (!active->rises || active->bend_count > 0 || active->y_next >= active->calm_until)
    return settle_events(context, active, change);
  move_to_next(active);
  *change = cs_change_none;
  return CELSPAN_OK;
}
