#include "area/local_sweep.h"

#include <math.h>

/* ---------------------------------------------------------------- fragments */

static const cs_cell *left_of(const cs_local_sweep *sweep, size_t j) {
  return j > 0 ? sweep->members[j - 1]->right : sweep->left;
}

/* A boundary at some height, between two cells. */
typedef struct stay {
  const cs_member *member;
  double x, y;
  uint32_t at; /* a segment that y is on */
} stay;

/* Gives the window what a boundary draws from there down to (x, y). */
static celspan_status draw_to(cs_row_maker *maker, const stay *from, double x, double y,
                              const cs_cell *left, const cs_cell *right) {
  const celspan_point *points = from->member->points;
  if (!(y > from->y) || cs_composer_same(&maker->composer, left, right))
    return CELSPAN_OK;
  celspan_point above = {from->x, from->y};
  for (uint32_t at = from->at; points[at].y < y; at++)
    if (points[at].y > above.y) {
      CS_TRY(
          cs_window_add(&maker->window, above.x, above.y, points[at].x, points[at].y, left, right));
      above = points[at];
    }
  return cs_window_add(&maker->window, above.x, above.y, x, y, left, right);
}

/* The same for member j since its last event, between the cells it stands between. */
static celspan_status flush(cs_local_sweep *sweep, size_t j, double x, double y) {
  cs_member *member = sweep->members[j];
  const stay from = {member, member->x, member->y, member->at};
  CS_TRY(draw_to(sweep->maker, &from, x, y, left_of(sweep, j), member->right));
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

static void cross(cs_composer *composer, const cs_member *member, int32_t sign) {
  if (member->span == UINT32_MAX)
    cs_composer_cross(composer, member->layer, sign * member->direction);
  else
    cs_composer_cross_span(composer, member->layer, member->span, sign * member->direction);
}

/* Walks the composer to just right of the first `place` members. */
static void stand(cs_local_sweep *sweep, size_t place) {
  cs_composer *composer = &sweep->maker->composer;
  for (; sweep->stood < place; sweep->stood++)
    cross(composer, sweep->members[sweep->stood], 1);
  for (; sweep->stood > place; sweep->stood--)
    cross(composer, sweep->members[sweep->stood - 1], -1);
}

/* And past the toggles at or left of x. */
static void stand_toggles(cs_local_sweep *sweep, double x) {
  cs_composer *composer = &sweep->maker->composer;
  sweep->passed = cs_cells_defer(composer, sweep->passed, sweep->deferred_end, x);
  for (; sweep->passed > sweep->deferred && sweep->passed[-1].x > x; sweep->passed--)
    cs_composer_cross(composer, sweep->passed[-1].layer, -sweep->passed[-1].direction);
}

/* The cell at the composer's place; `known` when it is the same. */
static const cs_cell *find_cell(cs_row_maker *maker, const cs_cell *known) {
  if (known && cs_set_hash_same(known->hash, maker->composer.hash))
    return known;
  cs_cell *cell = cs_arena_take(maker->context, &maker->arena, sizeof *cell);
  if (!cell)
    maker->composer.failure = CELSPAN_NO_MEMORY;
  else
    cs_composer_cell(&maker->composer, cell);
  return cell;
}

/* Brings the cells right of members first..last up to date. */
static celspan_status refresh(cs_local_sweep *sweep, size_t first, size_t last) {
  for (size_t j = first; j <= last; j++) {
    cs_member *member = sweep->members[j];
    stand(sweep, j + 1);
    stand_toggles(sweep, member->x);
    member->right = find_cell(sweep->maker, member->right);
    CS_TRY(sweep->maker->composer.failure);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- bands */

/* The height of the next begin or end. */
static double next_height(const cs_local_sweep *sweep) {
  double next = sweep->begin_count > 0 ? sweep->begins[0].points[0].y : sweep->y1;
  for (size_t j = 0; j < sweep->count; j++) {
    const cs_member *member = sweep->members[j];
    double end = member->points[member->point_count - 1].y;
    next = end < next ? end : next;
  }
  return next;
}

static inline cs_intersection *meeting_at(const cs_local_sweep *sweep, uint32_t index) {
  return index == CS_MEETINGS_NONE ? NULL : &sweep->maker->intersections.intersections[index];
}

/* Composes what is seen right of place j after each of the meetings there. */
static celspan_status compose_place(cs_local_sweep *sweep, size_t j) {
  cs_composer *composer = &sweep->maker->composer;
  cs_member *const *members = sweep->members;
  cs_intersection *first = meeting_at(sweep, sweep->maker->intersections.first[j]);
  if (!first)
    return CELSPAN_OK;
  const cs_intersection *stays =
      first->left == j ? first : NULL; /* it leaves before it is crossed */
  stand(sweep, stays ? j : j + 1);
  for (cs_intersection *intersection = first; intersection;
       intersection = meeting_at(sweep, intersection->next)) {
    if (intersection != stays)
      cross(composer, members[intersection->left], -1);
    cross(composer, members[intersection->right], 1);
    stand_toggles(sweep, intersection->right_x);
    intersection->cell = find_cell(sweep->maker, NULL);
    CS_TRY(composer->failure);
  }
  for (cs_intersection *intersection = first; intersection;
       intersection = meeting_at(sweep, intersection->next)) {
    cross(composer, members[intersection->right], -1);
    if (intersection != stays)
      cross(composer, members[intersection->left], 1);
  }
  return CELSPAN_OK;
}

/* Follows place j down the band: whoever stands there draws, from one meeting with a neighbour to
 * the next. left: the cell left of the place at the top. */
static celspan_status draw_place(cs_local_sweep *sweep, size_t j, const cs_cell *left) {
  cs_member *const *members = sweep->members;
  const cs_intersections *intersections = &sweep->maker->intersections;
  const cs_cell *right = members[j]->right;
  const cs_intersection *before = j > 0 ? meeting_at(sweep, intersections->first[j - 1]) : NULL;
  const cs_intersection *after = meeting_at(sweep, intersections->first[j]);
  stay s = {members[j], members[j]->x, members[j]->y, members[j]->at};
  while (before || after) {
    bool is_after = !before || (after && after < before); /* as they happened */
    const cs_intersection *intersection = is_after ? after : before;
    double y = intersection->y, left_x = intersection->left_x, right_x = intersection->right_x;
    CS_TRY(draw_to(sweep->maker, &s, is_after ? left_x : right_x, y, left, right));
    s.member = members[is_after ? intersection->right : intersection->left];
    s.x = is_after ? right_x : left_x;
    s.y = y;
    s.at = is_after ? intersection->right_at : intersection->left_at;
    if (is_after) {
      right = intersection->cell;
      after = meeting_at(sweep, intersection->next);
    } else {
      left = intersection->cell;
      before = meeting_at(sweep, intersection->next);
    }
  }
  sweep->seen[j] = right;
  return CELSPAN_OK;
}

/* Puts the members where they are at the foot of a band. */
static void take_places(cs_local_sweep *sweep) {
  const cs_intersections *intersections = &sweep->maker->intersections;
  cs_member **members = sweep->spare;
  for (size_t j = 0; j < sweep->count; j++) {
    const cs_active_edge *mover = &intersections->movers[intersections->order[j]];
    cs_member *member = members[j] = sweep->members[intersections->order[j]];
    member->x = mover->last_x;
    member->y = mover->last_y;
    member->at = mover->last_at;
    member->right = sweep->seen[j];
  }
  sweep->spare = sweep->members;
  sweep->members = members;
}

/* Draws the meetings of a band, and leaves the members as they are at its foot. */
static celspan_status draw_meetings(cs_local_sweep *sweep) {
  const cs_cell *left = sweep->left;
  for (size_t j = 0; j < sweep->count; j++) {
    CS_TRY(compose_place(sweep, j));
    CS_TRY(draw_place(sweep, j, left));
    left = sweep->members[j]->right;
  }
  stand(sweep, 0);
  take_places(sweep);
  return CELSPAN_OK;
}

/* The same for a band with one meeting, as most are. */
static celspan_status draw_meeting(cs_local_sweep *sweep, const cs_intersection *intersection) {
  size_t j = intersection->left; /* nobody has left his place before */
  cs_member *a = sweep->members[j], *b = sweep->members[j + 1];
  const cs_cell *right = b->right;
  CS_TRY(flush(sweep, j, intersection->left_x, intersection->y));
  CS_TRY(flush(sweep, j + 1, intersection->right_x, intersection->y));
  if (sweep->stood > j)
    stand(sweep, j);
  sweep->members[j] = b;
  sweep->members[j + 1] = a;
  a->right = right; /* cells belong to places */
  return refresh(sweep, j, j);
}

/* Runs the members from y0 down to y1, where the next of them begins or ends. */
static celspan_status run_band(cs_local_sweep *sweep, double y0, double y1) {
  cs_row_maker *maker = sweep->maker;
  cs_intersections *intersections = &maker->intersections;
  for (size_t j = 0; j < sweep->count; j++) {
    const cs_member *member = sweep->members[j];
    cs_active_edge *mover = &intersections->movers[j];
    mover->points = member->points;
    mover->at = mover->last_at = member->at;
    mover->last_x = member->x;
    mover->last_y = member->y;
    intersections->foot[j] = member->foot;
  }
  CS_TRY(cs_intersections_find(intersections, maker->context, sweep->count, y0, y1));
  if (intersections->count == 1)
    CS_TRY(draw_meeting(sweep, &intersections->intersections[0]));
  else if (intersections->count > 1)
    CS_TRY(draw_meetings(sweep));
  for (size_t j = 0; j < sweep->count; j++)
    sweep->members[j]->foot = intersections->foot[j];
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- between bands */

/* Slope below a height, for settling equal x. */
static double slope_below(const cs_member *member, double y) {
  uint32_t at = member->at;
  while (member->points[at].y <= y && at + 1 < member->point_count)
    at++;
  const celspan_point *a = &member->points[at - 1], *b = &member->points[at];
  return b->y > a->y ? (b->x - a->x) / (b->y - a->y) : 0;
}

/* Whether a belongs right of b at the height that both have reached. */
static bool is_right(const cs_member *a, const cs_member *b, double y) {
  if (a->foot != b->foot)
    return a->foot > b->foot;
  double slope_a = slope_below(a, y), slope_b = slope_below(b, y);
  return slope_a != slope_b ? slope_a > slope_b : a->order > b->order;
}

/* Where a height changes what is present: between these two x. Outside, windings balance, so the
 * cells stay as they are. */
typedef struct turning {
  double low, high; /* low > high: nowhere */
} turning;

static void widen(turning *t, double x) {
  t->low = x < t->low ? x : t->low;
  t->high = x > t->high ? x : t->high;
}

static bool has_ended(const cs_member *member) { return member->at == member->point_count; }

/* Draws the members that end at y. */
static celspan_status end_members(cs_local_sweep *sweep, double y, turning *t) {
  for (size_t j = 0; j < sweep->count; j++) {
    cs_member *member = sweep->members[j];
    if (member->points[member->point_count - 1].y > y)
      continue;
    CS_TRY(flush(sweep, j, member->foot, y));
    member->at = member->point_count;
    widen(t, member->foot);
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

/* Lets the members that begin at y in, at the end of the order. */
static void begin_members(cs_local_sweep *sweep, double y) {
  for (; sweep->begin_count > 0 && sweep->begins->points[0].y <= y; sweep->begin_count--) {
    cs_member *member = sweep->begins++;
    member->y = y;
    sweep->members[sweep->count++] = member;
  }
}

/* Members that meet in a point and part in another order. */
static void note_disorder(const cs_local_sweep *sweep, double y, turning *t) {
  const cs_member *last = NULL;
  for (size_t j = 0; j < sweep->count; j++) {
    const cs_member *member = sweep->members[j];
    if (has_ended(member))
      continue;
    if (last && is_right(last, member, y)) {
      widen(t, last->foot);
      widen(t, member->foot);
    }
    last = member;
  }
}

static void note_begins(const cs_local_sweep *sweep, double y, turning *t) {
  for (size_t k = 0; k < sweep->begin_count && sweep->begins[k].points[0].y <= y; k++)
    widen(t, sweep->begins[k].points[0].x);
}

static void sort(cs_local_sweep *sweep, double y) {
  for (size_t i = 1; i < sweep->count; i++)
    for (size_t j = i; j > 0 && is_right(sweep->members[j - 1], sweep->members[j], y); j--) {
      cs_member *member = sweep->members[j];
      sweep->members[j] = sweep->members[j - 1];
      sweep->members[j - 1] = member;
    }
}

static bool is_inside(const turning *t, const cs_member *member) {
  return member->foot >= t->low && member->foot <= t->high;
}

static celspan_status flush_inside(cs_local_sweep *sweep, const turning *t, double y) {
  for (size_t j = 0; j < sweep->count; j++)
    if (!has_ended(sweep->members[j]) && is_inside(t, sweep->members[j]))
      CS_TRY(flush(sweep, j, sweep->members[j]->foot, y));
  return CELSPAN_OK;
}

static celspan_status refresh_inside(cs_local_sweep *sweep, const turning *t) {
  size_t first = 0, end = sweep->count;
  while (first < end && !is_inside(t, sweep->members[first]))
    first++;
  while (end > first && !is_inside(t, sweep->members[end - 1]))
    end--;
  return first < end ? refresh(sweep, first, end - 1) : CELSPAN_OK;
}

/* The events at height y, at the foot of the band just run. */
static celspan_status turn(cs_local_sweep *sweep, double y) {
  turning t = {INFINITY, -INFINITY};
  CS_TRY(end_members(sweep, y, &t));
  note_begins(sweep, y, &t);
  note_disorder(sweep, y, &t);
  CS_TRY(flush_inside(sweep, &t, y));
  stand(sweep, 0);
  drop_ended(sweep);
  begin_members(sweep, y);
  sort(sweep, y);
  return refresh_inside(sweep, &t);
}

celspan_status cs_local_sweep_replay(cs_local_sweep *sweep) {
  double y = sweep->y0;
  CS_TRY(cs_intersections_reserve(&sweep->maker->intersections, sweep->maker->context,
                                  sweep->count + sweep->begin_count));
  sweep->stood = 0;
  sweep->passed = sweep->deferred;
  for (;;) {
    double next = next_height(sweep);
    if (next > y)
      CS_TRY(run_band(sweep, y, next));
    if (next >= sweep->y1) {
      stand(sweep, 0);
      stand_toggles(sweep, -INFINITY);
      return flush_all(sweep, sweep->y1);
    }
    y = next;
    CS_TRY(turn(sweep, y));
  }
}

/* ---------------------------------------------------------------- pairs */

static celspan_status draw(cs_row_maker *maker, celspan_point above, celspan_point below,
                           const cs_cell *left, const cs_cell *right) {
  if (!(below.y > above.y) || cs_composer_same(&maker->composer, left, right))
    return CELSPAN_OK;
  return cs_window_add(&maker->window, above.x, above.y, below.x, below.y, left, right);
}

/* The cell that boundary i + 1 opens when it is crossed first, at x. */
static celspan_status cell_between(cs_row_maker *maker, size_t i, double x, const cs_cell **out) {
  const cs_deferred *deferred = maker->cells.deferred;
  cs_composer *composer = &maker->composer;
  cs_crossing second = maker->active.crossing[i + 1];
  cs_cell *cell = cs_arena_take(maker->context, &maker->arena, sizeof *cell);
  if (!cell)
    return CELSPAN_NO_MEMORY;
  cs_composer_cross(composer, second.layer, second.direction);
  const cs_deferred *passed = cs_cells_defer(composer, deferred, maker->cells.deferred_end, x);
  cs_composer_cell(composer, cell);
  *out = cell;
  cs_composer_cross(composer, second.layer, -second.direction);
  for (; passed > deferred; passed--)
    cs_composer_cross(composer, passed[-1].layer, -passed[-1].direction);
  return composer->failure;
}

celspan_status cs_local_sweep_pair(cs_row_maker *maker, const cs_cell *left, size_t i,
                                   const cs_cell **between) {
  const cs_active *active = &maker->active;
  celspan_point a = {active->x[i], active->y}, b = {active->x[i + 1], active->y};
  celspan_point a_foot = {active->x_next[i], active->y_next};
  celspan_point b_foot = {active->x_next[i + 1], active->y_next};
  double top = b.x - a.x, foot = a_foot.x - b_foot.x, u = top / (top + foot);
  double y = a.y + (a_foot.y - a.y) * u;
  celspan_point a_meets = {a.x + (a_foot.x - a.x) * u, y};
  celspan_point b_meets = {b.x + (b_foot.x - b.x) * u, y};
  const cs_cell *right = left + 2;
  CS_TRY(draw(maker, a, a_meets, left, left + 1));
  CS_TRY(draw(maker, b, b_meets, left + 1, right));
  CS_TRY(cell_between(maker, i, b_meets.x, between));
  CS_TRY(draw(maker, b_meets, b_foot, left, *between));
  return draw(maker, a_meets, a_foot, *between, right);
}
