#include "engine/area/local_sweep.h"

#include <math.h>

#include "engine/area/extent.h"
#include "engine/sweep/order.h"

/* ---------------------------------------------------------------- life */

void cs_local_sweep_init(cs_local_sweep *sweep, cs_composer *composer, cs_arena *arena,
                         cs_target *target) {
  *sweep = (cs_local_sweep){.composer = composer, .arena = arena, .target = target};
}

void cs_local_sweep_finish(cs_local_sweep *sweep, cs_memory *memory) {
  cs_intersections_finish(&sweep->intersections, memory);
  CS_ARRAYS_FREE(memory, sweep, entering, lists);
}

celspan_status cs_local_sweep_begin(cs_local_sweep *sweep, size_t count) {
  celspan_context *context = sweep->composer->context;
  size_t most = count + sweep->begin_count;
  CS_TRY(CS_ARRAY_RESERVE(context, sweep->entering, most));
  CS_TRY(CS_ARRAY_RESERVE(context, sweep->lists, 3 * most));
  sweep->members = (cs_member **)sweep->lists;
  sweep->spare = sweep->members + most;
  sweep->cells_below = (const cs_cell **)(sweep->lists + 2 * most);
  sweep->count = count;
  for (size_t j = 0; j < count; j++)
    sweep->members[j] = &sweep->entering[j];
  return CELSPAN_OK;
}

cs_extent cs_local_sweep_extent(const cs_local_sweep *sweep) {
  cs_extent extent = cs_extent_nowhere();
  for (size_t i = 0; i < sweep->count + sweep->begin_count; i++)
    extent = cs_extent_join(extent, cs_member_extent(cs_local_sweep_member(sweep, i)));
  return extent;
}

/* ---------------------------------------------------------------- borders */

static const cs_cell *left_of(const cs_local_sweep *sweep, size_t j) {
  return j > 0 ? sweep->members[j - 1]->right : sweep->left;
}

/* A boundary at some height. */
typedef struct position {
  const cs_member *member;
  double x, y;
  uint32_t at; /* the segment that contains y ends at points[at] */
} position;

/* Draws a boundary from a position down to (x, y), between two cells. */
static celspan_status draw_to(cs_local_sweep *sweep, const position *from, double x, double y,
                              const cs_cell *left, const cs_cell *right) {
  const celspan_point *points = from->member->points;
  if (!(y > from->y) || cs_composer_same(sweep->composer, left, right))
    return CELSPAN_OK;
  celspan_point above = {from->x, from->y};
  for (uint32_t at = from->at; points[at].y < y; at++)
    if (points[at].y > above.y) {
      const cs_border border = {{above.x, above.y, points[at].x, points[at].y}, left, right};
      CS_TRY(cs_target_add(sweep->target, &border));
      above = points[at];
    }
  const cs_border last = {{above.x, above.y, x, y}, left, right};
  return cs_target_add(sweep->target, &last);
}

/* Draws member j from its last event down to (x, y), between the cells on both sides of the
 * member. */
static celspan_status flush(cs_local_sweep *sweep, size_t j, double x, double y) {
  cs_member *member = sweep->members[j];
  const position from = {member, member->x, member->y, member->at};
  CS_TRY(draw_to(sweep, &from, x, y, left_of(sweep, j), member->right));
  while (member->points[member->at].y < y)
    member->at++;
  member->x = x;
  member->y = y;
  return CELSPAN_OK;
}

static celspan_status flush_all(cs_local_sweep *sweep, double y) {
  for (size_t j = 0; j < sweep->count; j++)
    CS_TRY(flush(sweep, j, sweep->members[j]->foot, y));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- cells */

static inline const cs_member *member_at(const cs_local_sweep *sweep, size_t place) {
  return sweep->members[sweep->is_low ? sweep->intersections.order[place] : place];
}

/* Moves the composer to just right of the first `place` members. */
static void cross_to(cs_local_sweep *sweep, size_t place) {
  cs_composer *composer = sweep->composer;
  for (; sweep->crossed < place; sweep->crossed++)
    cs_member_cross(member_at(sweep, sweep->crossed), composer, 1);
  for (; sweep->crossed > place; sweep->crossed--)
    cs_member_cross(member_at(sweep, sweep->crossed - 1), composer, -1);
}

/* The cell at the composer's place. known: NULL, or a cell that is returned if it has the same set
 * of layers. */
static const cs_cell *find_cell(cs_local_sweep *sweep, const cs_cell *known) {
  if (known && cs_set_hash_same(known->hash, sweep->composer->hash))
    return known;
  cs_cell *cell = cs_arena_take(sweep->composer->context, sweep->arena, sizeof *cell);
  if (!cell)
    sweep->composer->failure = CELSPAN_NO_MEMORY;
  else
    cs_composer_cell(sweep->composer, cell);
  return cell;
}

/* Brings the cells right of members first..last up to date. */
static celspan_status refresh(cs_local_sweep *sweep, size_t first, size_t last) {
  for (size_t j = first; j <= last; j++) {
    cs_member *member = sweep->members[j];
    cross_to(sweep, j + 1);
    cs_deferred_to(&sweep->deferred, sweep->composer, member->x);
    member->right = find_cell(sweep, member->right);
    CS_TRY(sweep->composer->failure);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- slabs */

/* The height at which the next member begins or ends. */
static double next_height(const cs_local_sweep *sweep) {
  double next = sweep->begin_count > 0 ? sweep->begins[0].points[0].y : sweep->y1;
  for (size_t j = 0; j < sweep->count; j++) {
    const cs_member *member = sweep->members[j];
    double end = member->points[member->point_count - 1].y;
    next = end < next ? end : next;
  }
  return next;
}

static inline cs_intersection *intersection_at(const cs_local_sweep *sweep, uint32_t index) {
  return index == CS_INTERSECTIONS_NONE ? NULL : &sweep->intersections.intersections[index];
}

/* Composes the cell below an intersection, at the composer's place. */
static celspan_status compose_below(cs_local_sweep *sweep, cs_intersection *intersection) {
  cs_deferred_to(&sweep->deferred, sweep->composer, intersection->right_x);
  intersection->cell = find_cell(sweep, NULL);
  return sweep->composer->failure;
}

/* Composes the cells right of place j below each of its intersections, from the first one down. */
static celspan_status compose_down(cs_local_sweep *sweep, size_t j) {
  cs_composer *composer = sweep->composer;
  cs_member *const *members = sweep->members;
  cs_intersection *first = intersection_at(sweep, sweep->intersections.first[j]);
  const cs_intersection *leaves =
      first->left == j ? first : NULL; /* member j leaves its place: no member crosses it before */
  cross_to(sweep, leaves ? j : j + 1);
  for (cs_intersection *intersection = first; intersection;
       intersection = intersection_at(sweep, intersection->next)) {
    if (intersection != leaves)
      cs_member_cross(members[intersection->left], composer, -1);
    cs_member_cross(members[intersection->right], composer, 1);
    CS_TRY(compose_below(sweep, intersection));
  }
  sweep->crossed = j + 1;
  sweep->is_low = true;
  return CELSPAN_OK;
}

/* The same in the other order, from the last intersection up. */
static celspan_status compose_up(cs_local_sweep *sweep, size_t j) {
  cs_member *const *members = sweep->members;
  cross_to(sweep, j + 1);
  for (cs_intersection *intersection = intersection_at(sweep, sweep->intersections.last[j]);
       intersection; intersection = intersection_at(sweep, intersection->previous)) {
    CS_TRY(compose_below(sweep, intersection));
    cs_member_cross(members[intersection->right], sweep->composer, -1);
    cs_member_cross(members[intersection->left], sweep->composer, 1);
  }
  sweep->crossed = j + 1;
  sweep->is_low = false;
  return CELSPAN_OK;
}

/* Composes the cells right of place j, alternately downwards and upwards, so that few layers change
 * from cell to cell, and no place is visited twice. */
static celspan_status compose_place(cs_local_sweep *sweep, size_t j) {
  if (sweep->intersections.first[j] == CS_INTERSECTIONS_NONE)
    return CELSPAN_OK;
  return sweep->is_low ? compose_up(sweep, j) : compose_down(sweep, j);
}

/* Follows place j down the slab: draws the member at the place from one intersection with a
 * neighbour to the next. left: the cell left of the place at the top. */
static celspan_status draw_place(cs_local_sweep *sweep, size_t j, const cs_cell *left) {
  cs_member *const *members = sweep->members;
  const cs_intersections *intersections = &sweep->intersections;
  const cs_cell *right = members[j]->right;
  const cs_intersection *before =
      j > 0 ? intersection_at(sweep, intersections->first[j - 1]) : NULL;
  const cs_intersection *after = intersection_at(sweep, intersections->first[j]);
  position s = {members[j], members[j]->x, members[j]->y, members[j]->at};
  while (before || after) {
    /* the intersection that comes first in the list is higher */
    bool is_after = !before || (after && after < before);
    const cs_intersection *intersection = is_after ? after : before;
    double y = intersection->y, left_x = intersection->left_x, right_x = intersection->right_x;
    CS_TRY(draw_to(sweep, &s, is_after ? left_x : right_x, y, left, right));
    s.member = members[is_after ? intersection->right : intersection->left];
    s.x = is_after ? right_x : left_x;
    s.y = y;
    s.at = is_after ? intersection->right_at : intersection->left_at;
    if (is_after) {
      right = intersection->cell;
      after = intersection_at(sweep, intersection->next);
    } else {
      left = intersection->cell;
      before = intersection_at(sweep, intersection->next);
    }
  }
  sweep->cells_below[j] = right;
  return CELSPAN_OK;
}

/* Puts the members in their order at the foot of a slab. */
static void commit_places(cs_local_sweep *sweep) {
  const cs_intersections *intersections = &sweep->intersections;
  cs_member **members = sweep->spare;
  for (size_t j = 0; j < sweep->count; j++) {
    const cs_active_edge *edge = &intersections->edges[intersections->order[j]];
    cs_member *member = members[j] = sweep->members[intersections->order[j]];
    member->x = edge->last_x;
    member->y = edge->last_y;
    member->at = edge->last_at;
    member->right = sweep->cells_below[j];
  }
  sweep->spare = sweep->members;
  sweep->members = members;
}

/* Draws the intersections of a slab, and leaves the members in their order at its foot. */
static celspan_status draw_intersections(cs_local_sweep *sweep) {
  const cs_cell *left = sweep->left;
  for (size_t j = 0; j < sweep->count; j++) {
    CS_TRY(compose_place(sweep, j));
    CS_TRY(draw_place(sweep, j, left));
    left = sweep->members[j]->right;
  }
  cross_to(sweep, 0);
  sweep->is_low = false;
  commit_places(sweep);
  return CELSPAN_OK;
}

/* Follows the members from y0 down to y1, the next height at which a member begins or ends. */
static celspan_status run_slab(cs_local_sweep *sweep, double y0, double y1) {
  cs_intersections *intersections = &sweep->intersections;
  for (size_t j = 0; j < sweep->count; j++) {
    const cs_member *member = sweep->members[j];
    cs_active_edge *edge = &intersections->edges[j];
    edge->points = member->points;
    edge->at = edge->last_at = member->at;
    edge->last_x = member->x;
    edge->last_y = member->y;
    intersections->foot[j] = member->foot;
  }
  CS_TRY(cs_intersections_find(intersections, sweep->composer->context, sweep->count, y0, y1));
  if (intersections->count > 0)
    CS_TRY(draw_intersections(sweep));
  for (size_t j = 0; j < sweep->count; j++)
    sweep->members[j]->foot = intersections->foot[j];
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- between slabs */

/* dx/dy just below a height. */
static double slope_below(const cs_member *member, double y) {
  uint32_t at = member->at;
  while (member->points[at].y <= y && at + 1 < member->point_count)
    at++;
  const celspan_point *a = &member->points[at - 1], *b = &member->points[at];
  return b->y > a->y ? (b->x - a->x) / (b->y - a->y) : 0;
}

/* Whether a belongs to the right of b at the height y, which both members cross. */
static bool is_right(const cs_member *a, const cs_member *b, double y) {
  if (a->foot != b->foot)
    return a->foot > b->foot;
  return cs_order_is_right(slope_below(a, y), a->order, slope_below(b, y), b->order);
}

static bool has_ended(const cs_member *member) { return member->at == member->point_count; }

/* Draws the members that end at y. */
static celspan_status end_members(cs_local_sweep *sweep, double y, cs_extent *changed) {
  for (size_t j = 0; j < sweep->count; j++) {
    cs_member *member = sweep->members[j];
    if (member->points[member->point_count - 1].y > y)
      continue;
    CS_TRY(flush(sweep, j, member->foot, y));
    member->at = member->point_count;
    cs_extent_add(changed, member->foot);
  }
  return CELSPAN_OK;
}

static void drop_ended(cs_local_sweep *sweep) {
  size_t kept = 0;
  for (size_t j = 0; j < sweep->count; j++)
    if (!has_ended(sweep->members[j]))
      sweep->members[kept++] = sweep->members[j];
  sweep->count = kept;
}

/* Appends the members that begin at y to the order. */
static void begin_members(cs_local_sweep *sweep, double y) {
  for (; sweep->begin_count > 0 && sweep->begins->points[0].y <= y; sweep->begin_count--) {
    cs_member *member = sweep->begins++;
    member->y = y;
    sweep->members[sweep->count++] = member;
  }
}

/* Notes the members that meet in one point and leave it in a different order. */
static void note_disorder(const cs_local_sweep *sweep, double y, cs_extent *changed) {
  const cs_member *last = NULL;
  for (size_t j = 0; j < sweep->count; j++) {
    const cs_member *member = sweep->members[j];
    if (has_ended(member))
      continue;
    if (last && is_right(last, member, y)) {
      cs_extent_add(changed, last->foot);
      cs_extent_add(changed, member->foot);
    }
    last = member;
  }
}

static void note_begins(const cs_local_sweep *sweep, double y, cs_extent *changed) {
  for (size_t k = 0; k < sweep->begin_count && sweep->begins[k].points[0].y <= y; k++)
    cs_extent_add(changed, sweep->begins[k].points[0].x);
}

static void sort(cs_local_sweep *sweep, double y) {
  for (size_t i = 1; i < sweep->count; i++)
    for (size_t j = i; j > 0 && is_right(sweep->members[j - 1], sweep->members[j], y); j--) {
      cs_member *member = sweep->members[j];
      sweep->members[j] = sweep->members[j - 1];
      sweep->members[j - 1] = member;
    }
}

static bool is_inside(const cs_extent *changed, const cs_member *member) {
  return cs_extent_has(*changed, member->foot);
}

static celspan_status flush_inside(cs_local_sweep *sweep, const cs_extent *changed, double y) {
  for (size_t j = 0; j < sweep->count; j++)
    if (!has_ended(sweep->members[j]) && is_inside(changed, sweep->members[j]))
      CS_TRY(flush(sweep, j, sweep->members[j]->foot, y));
  return CELSPAN_OK;
}

static celspan_status refresh_inside(cs_local_sweep *sweep, const cs_extent *changed) {
  size_t first = 0, end = sweep->count;
  while (first < end && !is_inside(changed, sweep->members[first]))
    first++;
  while (end > first && !is_inside(changed, sweep->members[end - 1]))
    end--;
  return first < end ? refresh(sweep, first, end - 1) : CELSPAN_OK;
}

/* Applies the events at height y, the foot of a slab. The sets of layers change only between the
 * least and the greatest x of these events: outside of these, begins and ends cancel out, so the
 * cells there are kept. */
static celspan_status change_members(cs_local_sweep *sweep, double y) {
  cs_extent changed = cs_extent_nowhere();
  CS_TRY(end_members(sweep, y, &changed));
  note_begins(sweep, y, &changed);
  note_disorder(sweep, y, &changed);
  CS_TRY(flush_inside(sweep, &changed, y));
  cross_to(sweep, 0);
  drop_ended(sweep);
  begin_members(sweep, y);
  sort(sweep, y);
  return refresh_inside(sweep, &changed);
}

celspan_status cs_local_sweep_replay(cs_local_sweep *sweep) {
  double y = sweep->y0;
  CS_TRY(cs_intersections_reserve(&sweep->intersections, sweep->composer->context,
                                  sweep->count + sweep->begin_count));
  sweep->crossed = 0;
  sweep->is_low = false;
  for (;;) {
    double next = next_height(sweep);
    if (next > y)
      CS_TRY(run_slab(sweep, y, next));
    if (next >= sweep->y1) {
      cross_to(sweep, 0);
      cs_deferred_to(&sweep->deferred, sweep->composer, -INFINITY);
      return flush_all(sweep, sweep->y1);
    }
    y = next;
    CS_TRY(change_members(sweep, y));
  }
}
