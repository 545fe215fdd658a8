/* Finding the intervals of a row: inversion groups first, then begins and ends, then both merged.
 * The file is long because every row calls it, and its steps are inlined into one. */
#include "engine/area/intervals.h"

#include "base/sort.h"
#include "engine/sweep/pieces.h"

static void *allocate(const cs_intervals *b, size_t count, size_t size) {
  return cs_arena_take(b->context, b->arena, count * size);
}

/* Makes a chain a member, at the top of its points. */
static void set_member(cs_member *member, const cs_active *active, uint32_t chain,
                       const celspan_point *points, uint32_t count) {
  const cs_boundary_chain *c = &active->set->chains[chain];
  member->points = points;
  member->point_count = count;
  member->at = 1;
  member->layer = c->layer;
  member->span = UINT32_MAX;
  member->order = chain;
  member->direction = c->direction;
  member->x = member->foot = points[0].x;
  member->y = points[0].y;
  member->right = NULL;
}

celspan_status cs_intervals_member(const cs_intervals *b, size_t i, cs_member *member) {
  const cs_active *active = b->active;
  const cs_bend *bend = cs_active_bend(active, i);
  uint32_t inner = bend ? bend->vertex_count : 0;
  celspan_point *points = allocate(b, inner + 2, sizeof *points), *last = points;
  if (!points)
    return CELSPAN_NO_MEMORY;
  *last++ = (celspan_point){active->x[i], b->y0};
  for (uint32_t k = 0; k < inner; k++)
    *last++ = active->vertices[bend->vertex + k];
  if (!bend || !bend->ends_above)
    *last++ = (celspan_point){active->x_next[i], b->y1};
  set_member(member, active, active->walks[active->slot[i]].chain, points,
             (uint32_t)(last - points));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- extents */

/* The extent of boundary i inside the row. */
static inline cs_extent boundary_extent(const cs_intervals *b, size_t i) {
  const cs_edges *edges = b->edges;
  return (cs_extent){edges->low[i], edges->high[i]};
}

static celspan_status add_interval(cs_intervals *b, cs_interval interval) {
  cs_interval *intervals =
      cs_arena_grow(b->context, b->arena, b->intervals, b->count, &b->capacity, sizeof interval);
  if (!intervals)
    return CELSPAN_NO_MEMORY;
  intervals[b->count++] = interval;
  b->intervals = intervals;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- disorder
 *
 * The order at the top of the row holds at every height if and only if no two neighbours cross.
 * That is examined only where the foot is out of order or a neighbour bends. */

/* x of boundary i at a height of the row; a boundary that has ended continues straight down. */
static double boundary_x(const cs_intervals *b, size_t i, double y) {
  cs_pieces p = cs_pieces_of(b->active, i, cs_active_bend(b->active, i));
  while (cs_pieces_next(&p) && p.below.y < y)
    continue;
  if (y >= p.below.y)
    return p.below.x;
  return p.above.x + (p.below.x - p.above.x) * ((y - p.above.y) / (p.below.y - p.above.y));
}

/* Whether a vertex of a bent boundary lies beyond a neighbour: side -1 is the left neighbour, +1
 * the right one. */
static bool passes(const cs_intervals *b, const cs_bend *bend, size_t neighbour, int side) {
  const cs_active *active = b->active;
  cs_extent r = boundary_extent(b, neighbour);
  if (side > 0 ? bend->high <= r.low : bend->low >= r.high)
    return false;
  for (uint32_t k = 0; k < bend->vertex_count; k++) {
    celspan_point vertex = active->vertices[bend->vertex + k];
    double x = boundary_x(b, neighbour, vertex.y);
    if (side > 0 ? vertex.x > x : vertex.x < x)
      return true;
  }
  return false;
}

/* Neighbours that cross and must be replayed together, while further ones are being searched
 * for. */
typedef struct inversion_group {
  size_t low, high;
  /* extent: of the group's boundaries in the row; foot: at the foot of the row */
  cs_extent extent, foot;
  bool is_bent;
} inversion_group;

static inline inversion_group group_of(const cs_intervals *b, size_t i) {
  double foot = b->active->x_next[i];
  return (inversion_group){i, i + 1, boundary_extent(b, i), {foot, foot}, b->edges->is_bent[i]};
}

static void join_groups(inversion_group *k, const inversion_group *other) {
  k->low = other->low < k->low ? other->low : k->low;
  k->high = other->high > k->high ? other->high : k->high;
  k->extent = cs_extent_join(k->extent, other->extent);
  k->foot = cs_extent_join(k->foot, other->foot);
  k->is_bent |= other->is_bent;
}

/* Straight boundaries cross if and only if the row changes their order; bent ones may cross
 * wherever their extents overlap. */
static bool may_cross(const inversion_group *left, const inversion_group *right) {
  return left->foot.high > right->foot.low ||
         ((left->is_bent || right->is_bent) && left->extent.high > right->extent.low);
}

/* Adds neighbours until the group cannot cross any further neighbour. */
static void grow_group(const cs_intervals *b, inversion_group *k) {
  const cs_active *active = b->active;
  bool grows = true;
  while (grows) {
    inversion_group next;
    grows = false;
    while (k->low > 0 && (next = group_of(b, k->low - 1), may_cross(&next, k))) {
      join_groups(k, &next);
      grows = true;
    }
    while (k->high < active->count && (next = group_of(b, k->high), may_cross(k, &next))) {
      join_groups(k, &next);
      grows = true;
    }
  }
}

/* The groups found so far, from left to right. In a dense row there are few of them for very many
 * boundaries, so their room grows with them. */
typedef struct group_list {
  inversion_group *groups;
  size_t count, capacity;
} group_list;

/* Puts boundaries i and i + 1 into one group. */
static celspan_status group_pair(const cs_intervals *b, size_t i, group_list *list) {
  if (list->count > 0 && list->groups[list->count - 1].high >= i + 2)
    return CELSPAN_OK;
  list->groups = cs_arena_grow(b->context, b->arena, list->groups, list->count, &list->capacity,
                               sizeof *list->groups);
  if (!list->groups)
    return CELSPAN_NO_MEMORY;
  inversion_group *k = &list->groups[list->count], other = group_of(b, i + 1);
  *k = group_of(b, i);
  join_groups(k, &other);
  grow_group(b, k);
  for (; list->count > 0; --list->count, k--) {
    inversion_group *last = k - 1;
    if (last->high < k->low || (last->high == k->low && !may_cross(last, k)))
      break;
    join_groups(last, k);
    grow_group(b, last);
  }
  ++list->count;
  return CELSPAN_OK;
}

/* Groups the bent boundaries below place `end` with the neighbours that they pass, from left to
 * right.
 */
static celspan_status group_bends(const cs_intervals *b, size_t end, size_t *bend,
                                  group_list *list) {
  const cs_active *active = b->active;
  for (; *bend < active->bend_count && active->bends[*bend].boundary < end; ++*bend) {
    const cs_bend *at = &active->bends[*bend];
    size_t i = at->boundary;
    if (at->vertex_count == 0)
      continue;
    if (i > 0 && passes(b, at, i - 1, -1))
      CS_TRY(group_pair(b, i - 1, list));
    if (i + 1 < active->count && passes(b, at, i + 1, 1))
      CS_TRY(group_pair(b, i, list));
  }
  return CELSPAN_OK;
}

static celspan_status add_groups(cs_intervals *b) {
  const cs_active *active = b->active;
  const double *foot = active->x_next;
  size_t bend = 0;
  group_list list = {0};
  for (size_t i = 1; i < active->count; i++)
    if (foot[i - 1] > foot[i]) {
      CS_TRY(group_bends(b, i, &bend, &list));
      CS_TRY(group_pair(b, i - 1, &list));
    }
  CS_TRY(group_bends(b, active->count, &bend, &list));
  for (size_t k = 0; k < list.count; k++) {
    const inversion_group *group = &list.groups[k];
    CS_TRY(add_interval(b, (cs_interval){group->low, group->high, group->low, cs_extent_nowhere(),
                                         group->extent, false}));
  }
  b->group_count = list.count;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- begins and ends at one height */

static inline bool event_is_before(const cs_interval_event *a, const cs_interval_event *b) {
  if (a->y != b->y)
    return a->y < b->y;
  if (a->layer != b->layer)
    return a->layer < b->layer;
  return a->begin != b->begin ? a->begin < b->begin : a->is_end < b->is_end;
}

CS_SORT_DEFINE(sort_events, cs_interval_event, event_is_before)

/* The first boundary whose x at the top of the row is greater than `x`. */
static size_t find_place(const cs_active *active, double x) {
  size_t low = 0, high = active->count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (active->x[middle] <= x)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* The group that boundary i is in, or NULL. */
static const cs_interval *find_group(const cs_intervals *b, size_t i) {
  size_t low = 0, high = b->group_count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (b->intervals[middle].high <= i)
      low = middle + 1;
    else
      high = middle;
  }
  return low < b->group_count && b->intervals[low].low <= i ? &b->intervals[low] : NULL;
}

/* A unit that keeps its order through the row: boundary i, or the group that contains it. */
static cs_interval unit_at(const cs_intervals *b, size_t i) {
  const cs_interval *group = find_group(b, i);
  return group ? *group
               : (cs_interval){i, i + 1, i, cs_extent_nowhere(), boundary_extent(b, i), false};
}

/* Adds the interval of the boundaries whose extents meet the extent of some events, or the place
 * between two boundaries. Units do not cross, so their extents rise with their places. */
static celspan_status add_extent_interval(cs_intervals *b, cs_extent r, cs_interval *out) {
  const cs_active *active = b->active;
  size_t place = find_place(active, r.low), first = place, end = place;
  cs_extent extent = r;
  for (cs_interval u; first > 0 && (u = unit_at(b, first - 1), u.extent.high >= r.low);
       first = u.low) {
    end = u.high > end ? u.high : end;
    extent = cs_extent_join(extent, u.extent);
  }
  for (cs_interval u; end < active->count && (u = unit_at(b, end), u.extent.low <= r.high);
       end = u.high) {
    first = u.low < first ? u.low : first;
    extent = cs_extent_join(extent, u.extent);
  }
  *out = (cs_interval){first, end, first, r, extent, false};
  return add_interval(b, *out);
}

/* A chain that begins and ends inside the row joins the intervals of both events. */
static celspan_status join_ends(cs_intervals *b, const cs_interval_event *events, size_t count,
                                cs_interval at) {
  for (size_t i = 0; i < count; i++) {
    if (events[i].begin < 0)
      continue;
    cs_interval *begin = &b->begin_intervals[events[i].begin];
    if (!events[i].is_end) {
      *begin = at;
      continue;
    }
    size_t low = begin->low < at.low ? begin->low : at.low;
    size_t high = begin->high > at.high ? begin->high : at.high;
    cs_extent extent = cs_extent_join(begin->extent, at.extent);
    CS_TRY(add_interval(b, (cs_interval){low, high, low, cs_extent_nowhere(), extent, false}));
  }
  return CELSPAN_OK;
}

/* Adds the intervals of begins and ends: one interval for all events of a layer at one height. */
static celspan_status add_events(cs_intervals *b) {
  sort_events(b->events, b->event_count);
  for (size_t first = 0, end; first < b->event_count; first = end) {
    const cs_interval_event *e = &b->events[first];
    cs_extent r = e->extent;
    for (end = first + 1; end < b->event_count; end++) {
      const cs_interval_event *next = &b->events[end];
      if (next->y != e->y || next->layer != e->layer)
        break;
      r = cs_extent_join(r, next->extent);
    }
    cs_interval at;
    CS_TRY(add_extent_interval(b, r, &at));
    CS_TRY(join_ends(b, e, end - first, at));
  }
  return CELSPAN_OK;
}

static inline bool interval_is_before(const cs_interval *a, const cs_interval *b) {
  if (a->low != b->low)
    return a->low < b->low;
  return a->high != b->high ? a->high < b->high : a->last_low < b->last_low;
}

CS_SORT_DEFINE(sort_intervals, cs_interval, interval_is_before)

static bool belong_together(const cs_interval *last, const cs_interval *next) {
  if (next->low < last->high || next->events.low <= last->events.high)
    return true;
  return next->low == last->high && (next->low == next->high || last->last_low == last->high);
}

static void join(cs_interval *last, const cs_interval *next) {
  last->high = next->high > last->high ? next->high : last->high;
  last->last_low = next->last_low;
  last->events = cs_extent_join(next->events, last->events);
  last->extent = cs_extent_join(next->extent, last->extent);
}

/* Joins intervals that share a boundary or an x at which something begins, and adds places that
 * touch an interval. An interval that has grown in this way may reach the previous interval. */
static void merge_intervals(cs_intervals *b) {
  size_t kept = 0;
  sort_intervals(b->intervals, b->count);
  for (size_t i = 0; i < b->count; i++) {
    b->intervals[kept++] = b->intervals[i];
    while (kept > 1 && belong_together(&b->intervals[kept - 2], &b->intervals[kept - 1])) {
      join(&b->intervals[kept - 2], &b->intervals[kept - 1]);
      kept--;
    }
  }
  b->count = kept;
}

/* ---------------------------------------------------------------- begins and ends */

enum { FEW_POINTS = 12 }; /* most of these polylines have no more */

typedef struct point_list {
  celspan_point *items;
  size_t count, capacity;
} point_list;

static celspan_status append_point(cs_intervals *b, point_list *list, double x, double y) {
  list->items = cs_arena_grow(b->context, b->arena, list->items, list->count, &list->capacity,
                              sizeof *list->items);
  if (!list->items)
    return CELSPAN_NO_MEMORY;
  list->items[list->count++] = (celspan_point){x, y};
  return CELSPAN_OK;
}

/* The polyline of a chain that begins inside the row, down to its end or the foot of the row. */
static celspan_status chain_points(cs_intervals *b, uint32_t chain, point_list *out) {
  const cs_boundary_set *set = b->active->set;
  double top = set->chains[chain].y0;
  bool more = true;
  cs_boundary_walk walk;
  *out = (point_list){allocate(b, FEW_POINTS, sizeof *out->items), 0, FEW_POINTS};
  cs_boundary_start(set, chain, top, &walk);
  CS_TRY(append_point(b, out, cs_boundary_x(&walk, top), top));
  for (; more && walk.y1 < b->y1; more = cs_boundary_next(set, &walk))
    if (walk.y1 > out->items[out->count - 1].y)
      CS_TRY(append_point(b, out, walk.x1, walk.y1));
  return more ? append_point(b, out, cs_boundary_x(&walk, b->y1), b->y1) : CELSPAN_OK;
}

size_t cs_intervals_count_begins(const cs_active *active, double y1) {
  size_t end = active->next;
  while (end < active->set->chain_count && active->set->chains[end].y0 < y1)
    end++;
  return end - active->next;
}

static celspan_status find_begins(cs_intervals *b) {
  const cs_active *active = b->active;
  b->chain_count = cs_intervals_count_begins(active, b->y1);
  b->begin_count = b->chain_count + b->procedure_edge_count;
  b->begins = allocate(b, b->begin_count, sizeof *b->begins);
  b->begin_intervals = allocate(b, b->begin_count, sizeof *b->begin_intervals);
  if (!b->begins || !b->begin_intervals)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < b->chain_count; k++) {
    uint32_t chain = (uint32_t)(active->next + k);
    point_list points;
    CS_TRY(chain_points(b, chain, &points));
    set_member(&b->begins[k], active, chain, points.items, (uint32_t)points.count);
  }
  if (b->procedure_edge_count > 0)
    memcpy(b->begins + b->chain_count, b->procedure_edges,
           b->procedure_edge_count * sizeof *b->procedure_edges);
  return CELSPAN_OK;
}

static void note_event(cs_intervals *b, double y, cs_extent r, uint32_t layer, int32_t begin,
                       bool is_end) {
  b->events[b->event_count++] = (cs_interval_event){y, r, layer, begin, is_end};
}

static celspan_status find_events(cs_intervals *b) {
  const cs_active *active = b->active;
  b->events = allocate(b, 2 * b->chain_count + active->bend_count, sizeof *b->events);
  if (!b->events)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < b->chain_count; k++) {
    const cs_member *member = &b->begins[k];
    cs_extent r = cs_member_extent(member);
    double end = member->points[member->point_count - 1].y;
    note_event(b, member->points[0].y, r, member->layer, (int32_t)k, false);
    if (end < b->y1)
      note_event(b, end, r, member->layer, (int32_t)k, true);
  }
  for (size_t k = 0; k < active->bend_count; k++) {
    const cs_bend *bend = &active->bends[k];
    if (!bend->ends_above)
      continue;
    celspan_point end = active->vertices[bend->vertex + bend->vertex_count - 1];
    note_event(b, end.y, (cs_extent){end.x, end.x}, cs_active_chain(active, bend->boundary)->layer,
               -1, true);
  }
  return CELSPAN_OK;
}

/* Adds the interval of all procedures: their edges begin and end at every height of the row. */
static celspan_status add_procedures(cs_intervals *b) {
  cs_interval at;
  if (b->procedure_edge_count == 0)
    return CELSPAN_OK;
  CS_TRY(add_extent_interval(b, b->procedures, &at));
  for (size_t k = b->chain_count; k < b->begin_count; k++)
    b->begin_intervals[k] = at;
  return CELSPAN_OK;
}

static inline bool begin_is_before(const cs_interval_begin *a, const cs_interval_begin *b) {
  return a->low != b->low ? a->low < b->low : a->begin < b->begin;
}

CS_SORT_DEFINE(sort_begins, cs_interval_begin, begin_is_before)

/* Lists the begins from left to right: the walk along the row needs them in this order. */
static celspan_status order_begins(cs_intervals *b) {
  b->begin_order = allocate(b, b->begin_count, sizeof *b->begin_order);
  if (!b->begin_order)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < b->begin_count; k++)
    b->begin_order[k] = (cs_interval_begin){b->begin_intervals[k].low, k};
  sort_begins(b->begin_order, b->begin_count);
  return CELSPAN_OK;
}

celspan_status cs_intervals_find(cs_intervals *b) {
  const cs_active *active = b->active;
  size_t begins = cs_intervals_count_begins(active, b->y1) + b->procedure_edge_count;
  if (begins + active->bend_count == 0 && active->rises)
    return CELSPAN_OK;
  CS_TRY(add_groups(b));
  if (begins > 0)
    CS_TRY(find_begins(b));
  CS_TRY(find_events(b));
  CS_TRY(add_events(b));
  CS_TRY(add_procedures(b));
  merge_intervals(b);
  return begins > 0 ? order_begins(b) : CELSPAN_OK;
}

static inline bool member_is_before(const cs_member *a, const cs_member *b) {
  if (a->points[0].y != b->points[0].y)
    return a->points[0].y < b->points[0].y;
  return a->points[0].x != b->points[0].x ? a->points[0].x < b->points[0].x : a->order < b->order;
}

CS_SORT_DEFINE(sort_members, cs_member, member_is_before)

celspan_status cs_intervals_pick_begins(cs_intervals *b, const cs_interval *interval,
                                        cs_member **begins, size_t *count) {
  size_t first = b->picked;
  while (b->picked < b->begin_count && b->begin_order[b->picked].low <= interval->last_low)
    b->picked++;
  *count = b->picked - first;
  *begins = NULL;
  if (*count == 0)
    return CELSPAN_OK;
  *begins = allocate(b, *count, sizeof **begins);
  if (!*begins)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < *count; k++)
    (*begins)[k] = b->begins[b->begin_order[first + k].begin];
  sort_members(*begins, *count);
  return CELSPAN_OK;
}
