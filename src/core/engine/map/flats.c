/* The flat boundaries of a map, which its rows do not need: they lie between the ends of borders.
 *
 *            above
 *       A  /  A    \  B        at one height, from left to right: what changes from above to below
 *     ----o---------o-----       begins and ends where borders begin and end. From the first end to
 *       A  \  C  /   B           the second one A becomes C, so a flat boundary lies there.
 *            below
 *
 * Invariant: with them each cell is bounded on all sides: the heights of the lines around it, with
 * their signs, add up to 0 however the map is turned.
 */
#include "engine/map/turn.h"

#include "base/sort.h"

/* The end of a border: to the right of it, the cell above is `minus`, and the cell below is
 * `plus`. */
typedef struct change {
  cs_map_point at;
  uint32_t minus, plus, number;
} change;

static inline bool is_before(const change *a, const change *b) {
  return a->at.y != b->at.y   ? a->at.y < b->at.y
         : a->at.x != b->at.x ? a->at.x < b->at.x
                              : a->number < b->number;
}

CS_SORT_DEFINE(sort_changes, change, is_before)

/* The pairs of cells above and below the current place, from left to right. A map without rounding
 * has at most one pair. */
typedef struct finder {
  celspan_context *context;
  cs_map *map;
  CS_ARRAY(change, pairs);
  size_t pair_count;
} finder;

static void list_changes(const cs_map_lines *lines, change *out) {
  for (size_t i = 0; i < lines->border_count; i++) {
    const cs_map_border *f = &lines->borders[i];
    const cs_map_point *points = lines->points + f->first;
    uint32_t number = (uint32_t)(2 * i);
    out[2 * i] = (change){points[0], f->left, f->right, number};
    out[2 * i + 1] = (change){points[f->count - 1], f->right, f->left, number + 1};
  }
}

/* Joins a change to the changes before it: A to B and B to C become A to C. */
static celspan_status join(finder *f, change next) {
  for (size_t i = 0; i < f->pair_count && next.minus != next.plus;) {
    if (f->pairs[i].plus == next.minus)
      next.minus = f->pairs[i].minus;
    else if (f->pairs[i].minus == next.plus)
      next.plus = f->pairs[i].plus;
    else {
      i++;
      continue;
    }
    f->pairs[i] = f->pairs[--f->pair_count];
    i = 0;
  }
  return next.minus == next.plus ? CELSPAN_OK
                                 : CS_ARRAY_APPEND(f->context, f->pairs, f->pair_count, next);
}

/* The boundaries between two places of one height. */
static celspan_status add_flats(finder *f, cs_map_point from, int32_t to) {
  cs_map *map = f->map;
  for (size_t i = 0; i < f->pair_count; i++) {
    const cs_map_flat flat = {f->pairs[i].minus, f->pairs[i].plus, from.y, from.x, to};
    CS_TRY(CS_ARRAY_APPEND(f->context, map->flats, map->flat_count, flat));
  }
  return CELSPAN_OK;
}

static celspan_status visit(finder *f, const change *changes, size_t count) {
  for (size_t i = 0; i < count; i++) {
    if (i > 0 && changes[i].at.y != changes[i - 1].at.y)
      f->pair_count = 0;
    else if (i > 0 && changes[i].at.x > changes[i - 1].at.x)
      CS_TRY(add_flats(f, changes[i - 1].at, changes[i].at.x));
    CS_TRY(join(f, changes[i]));
  }
  return CELSPAN_OK;
}

celspan_status cs_map_find_flats(celspan_context *context, cs_map *map) {
  finder f = {.context = context, .map = map};
  change *changes;
  size_t count = 2 * map->lines.border_count;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, changes, count));
  list_changes(&map->lines, changes);
  sort_changes(changes, count);
  celspan_status status = visit(&f, changes, count);
  CS_ARRAYS_FREE(context->memory, &f, pairs, pairs);
  cs_mem_free(context->memory, changes, count * sizeof *changes);
  return status;
}
