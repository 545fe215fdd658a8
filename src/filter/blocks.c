#include "filter/blocks.h"

#include <math.h>
#include <stdlib.h>

static void *take(cs_blocks *b, size_t count, size_t size) {
  return cs_arena_take(b->scan->context, &b->scan->arena, count * size);
}

const cs_bend *cs_blocks_bend(const cs_active *active, size_t i) {
  size_t low = 0, high = active->bend_count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (active->bends[middle].boundary < i)
      low = middle + 1;
    else
      high = middle;
  }
  return low < active->bend_count && active->bends[low].boundary == i ? &active->bends[low] : NULL;
}

cs_member cs_blocks_member(const cs_active *active, uint32_t chain, const celspan_point *points,
                           uint32_t count) {
  const cs_boundary_chain *c = &active->set->chains[chain];
  return (cs_member){.points = points,
                     .point_count = count,
                     .at = 1,
                     .leaf = c->leaf,
                     .strip = UINT32_MAX,
                     .order = chain,
                     .direction = c->direction,
                     .x = points[0].x,
                     .y = points[0].y,
                     .foot = points[0].x};
}

/* ---------------------------------------------------------------- x-ranges */

typedef struct range {
  double low, high;
} range;

/* Where boundary i is inside the row. */
static range boundary_range(const cs_active *active, size_t i) {
  double top = active->x[i], foot = active->x_next[i];
  range r = {top < foot ? top : foot, top < foot ? foot : top};
  const cs_bend *bend = active->bend_count > 0 ? cs_blocks_bend(active, i) : NULL;
  for (uint32_t k = 0; bend && k < bend->vertex_count; k++) {
    double x = active->vertices[bend->vertex + k].x;
    r.low = x < r.low ? x : r.low;
    r.high = x > r.high ? x : r.high;
  }
  return r;
}

/* ---------------------------------------------------------------- blocks */

static const range nothing = {INFINITY, -INFINITY};

/* r: of what begins or ends in the block. */
static celspan_status add_block(cs_blocks *b, size_t low, size_t high, range r) {
  if (b->count == b->capacity) {
    size_t wanted = b->capacity ? 2 * b->capacity : 64;
    cs_block *grown = take(b, wanted, sizeof *grown);
    if (!grown)
      return CELSPAN_NO_MEMORY;
    if (b->count > 0)
      memcpy(grown, b->blocks, b->count * sizeof *grown);
    b->blocks = grown;
    b->capacity = wanted;
  }
  b->blocks[b->count++] = (cs_block){low, high, low, r.low, r.high};
  return CELSPAN_OK;
}

static bool is_sorted(const double *x, size_t count) {
  int falls = 0;
  for (size_t i = 1; i < count; i++)
    falls |= x[i - 1] > x[i];
  return !falls;
}

/* Blocks that the order at the foot permutes: back from each boundary that is overtaken, to the
 * first one at or left of which nothing ends up right of it. */
static celspan_status add_swaps(cs_blocks *b) {
  const cs_active *active = &b->scan->active;
  const double *foot = active->x_next;
  if (is_sorted(foot, active->count))
    return CELSPAN_OK;
  double *greatest = take(b, active->count, sizeof *greatest);
  if (!greatest)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < active->count; i++) {
    greatest[i] = i > 0 && greatest[i - 1] > foot[i] ? greatest[i - 1] : foot[i];
    size_t low = i;
    while (low > 0 && greatest[low - 1] > foot[i])
      low--;
    if (low < i)
      CS_TRY(add_block(b, low, i + 1, nothing));
  }
  return CELSPAN_OK;
}

/* The x-ranges of all boundaries, and how far left and right something reaches from each place on:
 * where the row permutes boundaries their ranges are in no order. */
typedef struct ranges {
  range *own;
  double *high_upto; /* the greatest high of 0..i */
  double *low_from;  /* the least low of i.. */
} ranges;

static celspan_status measure_ranges(cs_blocks *b, ranges *out) {
  const cs_active *active = &b->scan->active;
  size_t count = active->count;
  ranges r = {take(b, count, sizeof *r.own), take(b, count, sizeof *r.high_upto),
              take(b, count, sizeof *r.low_from)};
  if (!r.own || !r.high_upto || !r.low_from)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < count; i++) {
    double top = active->x[i], foot = active->x_next[i];
    r.own[i] = (range){top < foot ? top : foot, top < foot ? foot : top};
  }
  for (size_t k = 0; k < active->bend_count; k++)
    r.own[active->bends[k].boundary] = boundary_range(active, active->bends[k].boundary);
  for (size_t i = 0; i < count; i++)
    r.high_upto[i] = i > 0 && r.high_upto[i - 1] > r.own[i].high ? r.high_upto[i - 1] : r.own[i].high;
  for (size_t i = count; i-- > 0;)
    r.low_from[i] =
        i + 1 < count && r.low_from[i + 1] < r.own[i].low ? r.low_from[i + 1] : r.own[i].low;
  *out = r;
  return CELSPAN_OK;
}

/* Blocks of bent boundaries with all that they may touch; the row also permutes boundaries. */
static celspan_status add_bends_far(cs_blocks *b, const ranges *r) {
  const cs_active *active = &b->scan->active;
  for (size_t k = 0; k < active->bend_count; k++) {
    size_t i = active->bends[k].boundary, low = i, high = i + 1;
    if (active->bends[k].vertex_count == 0)
      continue;
    while (low > 0 && r->high_upto[low - 1] > r->own[i].low)
      low--;
    while (high < active->count && r->low_from[high] < r->own[i].high)
      high++;
    if (high - low > 1)
      CS_TRY(add_block(b, low, high, nothing));
  }
  return CELSPAN_OK;
}

/* The same in a row that keeps its order, where what a boundary touches are its neighbours. */
static celspan_status add_bends_near(cs_blocks *b) {
  const cs_active *active = &b->scan->active;
  for (size_t k = 0; k < active->bend_count; k++) {
    size_t i = active->bends[k].boundary, low = i, high = i + 1;
    if (active->bends[k].vertex_count == 0)
      continue;
    range own = boundary_range(active, i);
    while (low > 0 && boundary_range(active, low - 1).high > own.low)
      low--;
    while (high < active->count && boundary_range(active, high).low < own.high)
      high++;
    if (high - low > 1)
      CS_TRY(add_block(b, low, high, nothing));
  }
  return CELSPAN_OK;
}

static int compare_events(const void *p, const void *q) {
  const cs_row_event *a = p, *b = q;
  if (a->y != b->y)
    return a->y < b->y ? -1 : 1;
  if (a->leaf != b->leaf)
    return a->leaf < b->leaf ? -1 : 1;
  if (a->begin != b->begin)
    return a->begin < b->begin ? -1 : 1;
  return a->is_end - b->is_end;
}

/* The block of the boundaries whose x-range meets [low, high], or the place between two. */
static celspan_status add_range(cs_blocks *b, const range *own, double low, double high,
                                cs_block *out) {
  const cs_active *active = &b->scan->active;
  size_t first = active->count, end = 0, place = 0;
  for (size_t i = 0; i < active->count; i++) {
    place += active->x[i] <= low;
    if (own[i].high < low || own[i].low > high)
      continue;
    first = i < first ? i : first;
    end = i + 1;
  }
  *out = first < end ? (cs_block){first, end, first, low, high}
                     : (cs_block){place, place, place, low, high};
  return add_block(b, out->low, out->high, (range){low, high});
}

/* A chain that begins and ends inside the row ties the blocks of both events together. */
static celspan_status tie_ends(cs_blocks *b, const cs_row_event *events, size_t count,
                               cs_block at) {
  for (size_t i = 0; i < count; i++) {
    if (events[i].begin < 0)
      continue;
    cs_block *begin = &b->begin_blocks[events[i].begin];
    if (!events[i].is_end) {
      *begin = at;
      continue;
    }
    CS_TRY(add_block(b, begin->low < at.low ? begin->low : at.low,
                     begin->high > at.high ? begin->high : at.high, nothing));
  }
  return CELSPAN_OK;
}

/* Blocks of begins and ends: one for all of a leaf at one height. */
static celspan_status add_events(cs_blocks *b, const range *own) {
  if (b->event_count > 1)
    qsort(b->events, b->event_count, sizeof *b->events, compare_events);
  for (size_t first = 0, end; first < b->event_count; first = end) {
    const cs_row_event *e = &b->events[first];
    range r = {e->low, e->high};
    for (end = first + 1;
         end < b->event_count && b->events[end].y == e->y && b->events[end].leaf == e->leaf; end++) {
      r.low = b->events[end].low < r.low ? b->events[end].low : r.low;
      r.high = b->events[end].high > r.high ? b->events[end].high : r.high;
    }
    cs_block at;
    CS_TRY(add_range(b, own, r.low, r.high, &at));
    CS_TRY(tie_ends(b, e, end - first, at));
  }
  return CELSPAN_OK;
}

static int compare_blocks(const void *p, const void *q) {
  const cs_block *a = p, *b = q;
  if (a->low != b->low)
    return a->low < b->low ? -1 : 1;
  return (a->high > b->high) - (a->high < b->high);
}

static bool belong_together(const cs_block *last, const cs_block *next) {
  if (next->low < last->high || next->low_x <= last->high_x)
    return true;
  return next->low == last->high && (next->low == next->high || last->last_low == last->high);
}

static void join(cs_block *last, const cs_block *next) {
  last->high = next->high > last->high ? next->high : last->high;
  last->last_low = next->last_low;
  last->low_x = next->low_x < last->low_x ? next->low_x : last->low_x;
  last->high_x = next->high_x > last->high_x ? next->high_x : last->high_x;
}

/* Joins blocks that share a boundary or an x at which something begins, and places that touch a
 * block; a block that grew may reach the one before it. */
static void merge_blocks(cs_blocks *b) {
  size_t kept = 0;
  if (b->count > 1)
    qsort(b->blocks, b->count, sizeof *b->blocks, compare_blocks);
  for (size_t i = 0; i < b->count; i++) {
    b->blocks[kept++] = b->blocks[i];
    while (kept > 1 && belong_together(&b->blocks[kept - 2], &b->blocks[kept - 1])) {
      join(&b->blocks[kept - 2], &b->blocks[kept - 1]);
      kept--;
    }
  }
  b->count = kept;
}

/* ---------------------------------------------------------------- begins and ends */

/* The polyline of a chain that begins inside the row, down to its end or the foot of the row. */
static celspan_status chain_points(cs_blocks *b, uint32_t chain, const celspan_point **points,
                                   uint32_t *count) {
  const cs_boundary_set *set = b->scan->active.set;
  double top = set->chains[chain].y0;
  cs_boundary_walk walk;
  size_t room = 3;
  cs_boundary_start(set, chain, top, &walk);
  for (cs_boundary_walk ahead = walk; ahead.y1 < b->y1 && cs_boundary_next(set, &ahead);)
    room++;
  celspan_point *p = take(b, room, sizeof *p), *last = p;
  if (!p)
    return CELSPAN_NO_MEMORY;
  *points = p;
  *p++ = (celspan_point){cs_boundary_x(&walk, top), top};
  bool more = true;
  while (more && walk.y1 < b->y1) {
    if (walk.y1 > last->y) {
      last = p;
      *p++ = (celspan_point){walk.x1, walk.y1};
    }
    more = cs_boundary_next(set, &walk);
  }
  if (more)
    *p++ = (celspan_point){cs_boundary_x(&walk, b->y1), b->y1};
  *count = (uint32_t)(p - *points);
  return CELSPAN_OK;
}

size_t cs_blocks_count_begins(const cs_active *active, double y1) {
  size_t end = active->next;
  while (end < active->set->chain_count && active->set->chains[end].y0 < y1)
    end++;
  return end - active->next;
}

static celspan_status find_begins(cs_blocks *b) {
  const cs_active *active = &b->scan->active;
  b->chain_count = cs_blocks_count_begins(active, b->y1);
  b->begin_count = b->chain_count + b->strip_count;
  b->begins = take(b, b->begin_count, sizeof *b->begins);
  b->begin_blocks = take(b, b->begin_count, sizeof *b->begin_blocks);
  if (!b->begins || !b->begin_blocks)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < b->chain_count; k++) {
    uint32_t chain = (uint32_t)(active->next + k), count;
    const celspan_point *points;
    CS_TRY(chain_points(b, chain, &points, &count));
    b->begins[k] = cs_blocks_member(active, chain, points, count);
  }
  if (b->strip_count > 0)
    memcpy(b->begins + b->chain_count, b->strips, b->strip_count * sizeof *b->strips);
  return CELSPAN_OK;
}

static void note_event(cs_blocks *b, double y, range r, uint32_t leaf, int32_t begin,
                       bool is_end) {
  b->events[b->event_count++] = (cs_row_event){y, r.low, r.high, leaf, begin, is_end};
}

static range member_range(const cs_member *member) {
  range r = {member->points[0].x, member->points[0].x};
  for (uint32_t k = 1; k < member->point_count; k++) {
    r.low = member->points[k].x < r.low ? member->points[k].x : r.low;
    r.high = member->points[k].x > r.high ? member->points[k].x : r.high;
  }
  return r;
}

static celspan_status find_events(cs_blocks *b) {
  const cs_active *active = &b->scan->active;
  b->events = take(b, 2 * b->chain_count + active->bend_count, sizeof *b->events);
  if (!b->events)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < b->chain_count; k++) {
    const cs_member *member = &b->begins[k];
    range r = member_range(member);
    double end = member->points[member->point_count - 1].y;
    note_event(b, member->points[0].y, r, member->leaf, (int32_t)k, false);
    if (end < b->y1)
      note_event(b, end, r, member->leaf, (int32_t)k, true);
  }
  for (size_t k = 0; k < active->bend_count; k++) {
    const cs_bend *bend = &active->bends[k];
    if (!bend->ends_above)
      continue;
    celspan_point end = active->vertices[bend->vertex + bend->vertex_count - 1];
    note_event(b, end.y, (range){end.x, end.x}, cs_active_chain(active, bend->boundary)->leaf, -1,
               true);
  }
  return CELSPAN_OK;
}

/* The block of all strips: their edges begin and end at every height of the row. */
static celspan_status add_strips(cs_blocks *b, const range *own) {
  cs_block at;
  if (b->strip_count == 0)
    return CELSPAN_OK;
  CS_TRY(add_range(b, own, b->strips_low, b->strips_high, &at));
  for (size_t k = b->chain_count; k < b->begin_count; k++)
    b->begin_blocks[k] = at;
  return CELSPAN_OK;
}

celspan_status cs_blocks_find(cs_blocks *b) {
  const cs_active *active = &b->scan->active;
  CS_TRY(add_swaps(b));
  if (b->strip_count > 0 || cs_blocks_count_begins(active, b->y1) > 0)
    CS_TRY(find_begins(b));
  if (b->begin_count > 0 || active->bend_count > 0)
    CS_TRY(find_events(b));
  if (b->event_count > 0 || b->strip_count > 0 || (b->count > 0 && active->bend_count > 0)) {
    ranges r;
    CS_TRY(measure_ranges(b, &r));
    CS_TRY(add_bends_far(b, &r));
    CS_TRY(add_events(b, r.own));
    CS_TRY(add_strips(b, r.own));
  } else {
    CS_TRY(add_bends_near(b));
  }
  merge_blocks(b);
  return CELSPAN_OK;
}
