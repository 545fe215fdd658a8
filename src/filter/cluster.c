#include "filter/cluster.h"

#include <math.h>

/* ---------------------------------------------------------------- fragments */

static const cs_cell *left_of(const cs_cluster *cluster, size_t j) {
  return j > 0 ? cluster->members[j - 1]->right : cluster->left;
}

/* A boundary at some height, between two cells. */
typedef struct stay {
  const cs_member *member;
  double x, y;
  uint32_t at; /* a segment that y is on */
} stay;

/* Gives the window what a boundary draws from there down to (x, y). */
static celspan_status draw_to(cs_scan *scan, const stay *from, double x, double y,
                              const cs_cell *left, const cs_cell *right) {
  const celspan_point *points = from->member->points;
  if (!(y > from->y) || cs_composer_same(&scan->composer, left, right))
    return CELSPAN_OK;
  celspan_point above = {from->x, from->y};
  for (uint32_t at = from->at; points[at].y < y; at++)
    if (points[at].y > above.y) {
      CS_TRY(cs_window_add(&scan->window, above.x, above.y, points[at].x, points[at].y, left,
                           right));
      above = points[at];
    }
  return cs_window_add(&scan->window, above.x, above.y, x, y, left, right);
}

/* The same for member j since its last event, between the cells it stands between. */
static celspan_status flush(cs_cluster *cluster, size_t j, double x, double y) {
  cs_member *member = cluster->members[j];
  const stay from = {member, member->x, member->y, member->at};
  CS_TRY(draw_to(cluster->scan, &from, x, y, left_of(cluster, j), member->right));
  while (member->points[member->at].y < y)
    member->at++;
  member->x = x;
  member->y = y;
  return CELSPAN_OK;
}

static celspan_status flush_all(cs_cluster *cluster, double y) {
  for (size_t j = 0; j < cluster->count; j++)
    CS_TRY(flush(cluster, j, cluster->members[j]->foot, y));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- cells */

static void cross(cs_composer *composer, const cs_member *member, int32_t sign) {
  if (member->strip == UINT32_MAX)
    cs_composer_cross(composer, member->leaf, sign * member->direction);
  else
    cs_composer_cross_strip(composer, member->leaf, member->strip, sign * member->direction);
}

/* Walks the composer to just right of the first `place` members. */
static void stand(cs_cluster *cluster, size_t place) {
  cs_composer *composer = &cluster->scan->composer;
  for (; cluster->stood < place; cluster->stood++)
    cross(composer, cluster->members[cluster->stood], 1);
  for (; cluster->stood > place; cluster->stood--)
    cross(composer, cluster->members[cluster->stood - 1], -1);
}

/* And past the toggles at or left of x. */
static void stand_toggles(cs_cluster *cluster, double x) {
  cs_composer *composer = &cluster->scan->composer;
  cluster->passed = cs_cells_toggle(composer, cluster->passed, cluster->toggle_end, x);
  for (; cluster->passed > cluster->toggle && cluster->passed[-1].x > x; cluster->passed--)
    cs_composer_cross(composer, cluster->passed[-1].leaf, -cluster->passed[-1].direction);
}

/* The cell at the composer's place; `known` when it is the same. */
static const cs_cell *find_cell(cs_scan *scan, const cs_cell *known) {
  if (known && cs_set_hash_same(known->hash, scan->composer.hash))
    return known;
  cs_cell *cell = cs_arena_take(scan->context, &scan->arena, sizeof *cell);
  if (!cell)
    scan->composer.failure = CELSPAN_NO_MEMORY;
  else
    cs_composer_cell(&scan->composer, cell);
  return cell;
}

/* Brings the cells right of members first..last up to date. */
static celspan_status refresh(cs_cluster *cluster, size_t first, size_t last) {
  for (size_t j = first; j <= last; j++) {
    cs_member *member = cluster->members[j];
    stand(cluster, j + 1);
    stand_toggles(cluster, member->x);
    member->right = find_cell(cluster->scan, member->right);
    CS_TRY(cluster->scan->composer.failure);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- bands */

/* The height of the next begin or end. */
static double next_height(const cs_cluster *cluster) {
  double next = cluster->begin_count > 0 ? cluster->begins[0].points[0].y : cluster->y1;
  for (size_t j = 0; j < cluster->count; j++) {
    const cs_member *member = cluster->members[j];
    double end = member->points[member->point_count - 1].y;
    next = end < next ? end : next;
  }
  return next;
}

static inline cs_meeting *meeting_at(const cs_cluster *cluster, uint32_t index) {
  return index == CS_MEETINGS_NONE ? NULL : &cluster->scan->meetings.meetings[index];
}

/* Composes what is seen right of place j after each of the meetings there. */
static celspan_status compose_place(cs_cluster *cluster, size_t j) {
  cs_composer *composer = &cluster->scan->composer;
  cs_member *const *members = cluster->members;
  cs_meeting *first = meeting_at(cluster, cluster->scan->meetings.first[j]);
  if (!first)
    return CELSPAN_OK;
  const cs_meeting *stays = first->left == j ? first : NULL; /* it leaves before it is crossed */
  stand(cluster, stays ? j : j + 1);
  for (cs_meeting *meeting = first; meeting; meeting = meeting_at(cluster, meeting->next)) {
    if (meeting != stays)
      cross(composer, members[meeting->left], -1);
    cross(composer, members[meeting->right], 1);
    stand_toggles(cluster, meeting->right_x);
    meeting->cell = find_cell(cluster->scan, NULL);
    CS_TRY(composer->failure);
  }
  for (cs_meeting *meeting = first; meeting; meeting = meeting_at(cluster, meeting->next)) {
    cross(composer, members[meeting->right], -1);
    if (meeting != stays)
      cross(composer, members[meeting->left], 1);
  }
  return CELSPAN_OK;
}

/* Follows place j down the band: whoever stands there draws, from one meeting with a neighbour to
 * the next. left: the cell left of the place at the top. */
static celspan_status draw_place(cs_cluster *cluster, size_t j, const cs_cell *left) {
  cs_member *const *members = cluster->members;
  const cs_meetings *meetings = &cluster->scan->meetings;
  const cs_cell *right = members[j]->right;
  const cs_meeting *before = j > 0 ? meeting_at(cluster, meetings->first[j - 1]) : NULL;
  const cs_meeting *after = meeting_at(cluster, meetings->first[j]);
  stay s = {members[j], members[j]->x, members[j]->y, members[j]->at};
  while (before || after) {
    bool is_after = !before || (after && after < before); /* as they happened */
    const cs_meeting *meeting = is_after ? after : before;
    double y = meeting->y, left_x = meeting->left_x, right_x = meeting->right_x;
    CS_TRY(draw_to(cluster->scan, &s, is_after ? left_x : right_x, y, left, right));
    s.member = members[is_after ? meeting->right : meeting->left];
    s.x = is_after ? right_x : left_x;
    s.y = y;
    s.at = is_after ? meeting->right_at : meeting->left_at;
    if (is_after) {
      right = meeting->cell;
      after = meeting_at(cluster, meeting->next);
    } else {
      left = meeting->cell;
      before = meeting_at(cluster, meeting->next);
    }
  }
  cluster->seen[j] = right;
  return CELSPAN_OK;
}

/* Puts the members where they are at the foot of a band. */
static void take_places(cs_cluster *cluster) {
  const cs_meetings *meetings = &cluster->scan->meetings;
  cs_member **members = cluster->spare;
  for (size_t j = 0; j < cluster->count; j++) {
    const cs_mover *mover = &meetings->movers[meetings->order[j]];
    cs_member *member = members[j] = cluster->members[meetings->order[j]];
    member->x = mover->last_x;
    member->y = mover->last_y;
    member->at = mover->last_at;
    member->right = cluster->seen[j];
  }
  cluster->spare = cluster->members;
  cluster->members = members;
}

/* Draws the meetings of a band, and leaves the members as they are at its foot. */
static celspan_status draw_meetings(cs_cluster *cluster) {
  const cs_cell *left = cluster->left;
  for (size_t j = 0; j < cluster->count; j++) {
    CS_TRY(compose_place(cluster, j));
    CS_TRY(draw_place(cluster, j, left));
    left = cluster->members[j]->right;
  }
  stand(cluster, 0);
  take_places(cluster);
  return CELSPAN_OK;
}

/* The same for a band with one meeting, as most are. */
static celspan_status draw_meeting(cs_cluster *cluster, const cs_meeting *meeting) {
  size_t j = meeting->left; /* nobody has left his place before */
  cs_member *a = cluster->members[j], *b = cluster->members[j + 1];
  const cs_cell *right = b->right;
  CS_TRY(flush(cluster, j, meeting->left_x, meeting->y));
  CS_TRY(flush(cluster, j + 1, meeting->right_x, meeting->y));
  if (cluster->stood > j)
    stand(cluster, j);
  cluster->members[j] = b;
  cluster->members[j + 1] = a;
  a->right = right; /* cells belong to places */
  return refresh(cluster, j, j);
}

/* Runs the members from y0 down to y1, where the next of them begins or ends. */
static celspan_status run_band(cs_cluster *cluster, double y0, double y1) {
  cs_scan *scan = cluster->scan;
  cs_meetings *meetings = &scan->meetings;
  for (size_t j = 0; j < cluster->count; j++) {
    const cs_member *member = cluster->members[j];
    cs_mover *mover = &meetings->movers[j];
    mover->points = member->points;
    mover->at = mover->last_at = member->at;
    mover->last_x = member->x;
    mover->last_y = member->y;
    meetings->foot[j] = member->foot;
  }
  CS_TRY(cs_meetings_find(meetings, scan->context, cluster->count, y0, y1));
  if (meetings->count == 1)
    CS_TRY(draw_meeting(cluster, &meetings->meetings[0]));
  else if (meetings->count > 1)
    CS_TRY(draw_meetings(cluster));
  for (size_t j = 0; j < cluster->count; j++)
    cluster->members[j]->foot = meetings->foot[j];
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
static celspan_status end_members(cs_cluster *cluster, double y, turning *t) {
  for (size_t j = 0; j < cluster->count; j++) {
    cs_member *member = cluster->members[j];
    if (member->points[member->point_count - 1].y > y)
      continue;
    CS_TRY(flush(cluster, j, member->foot, y));
    member->at = member->point_count;
    widen(t, member->foot);
  }
  return CELSPAN_OK;
}

static void drop_ended(cs_cluster *cluster) {
  size_t kept = 0;
  for (size_t j = 0; j < cluster->count; j++)
    if (!has_ended(cluster->members[j]))
      cluster->members[kept++] = cluster->members[j];
  cluster->count = kept;
}

/* Lets the members that begin at y in, at the end of the order. */
static void begin_members(cs_cluster *cluster, double y) {
  for (; cluster->begin_count > 0 && cluster->begins->points[0].y <= y; cluster->begin_count--) {
    cs_member *member = cluster->begins++;
    member->y = y;
    cluster->members[cluster->count++] = member;
  }
}

/* Members that meet in a point and part in another order. */
static void note_disorder(const cs_cluster *cluster, double y, turning *t) {
  const cs_member *last = NULL;
  for (size_t j = 0; j < cluster->count; j++) {
    const cs_member *member = cluster->members[j];
    if (has_ended(member))
      continue;
    if (last && is_right(last, member, y)) {
      widen(t, last->foot);
      widen(t, member->foot);
    }
    last = member;
  }
}

static void note_begins(const cs_cluster *cluster, double y, turning *t) {
  for (size_t k = 0; k < cluster->begin_count && cluster->begins[k].points[0].y <= y; k++)
    widen(t, cluster->begins[k].points[0].x);
}

static void sort(cs_cluster *cluster, double y) {
  for (size_t i = 1; i < cluster->count; i++)
    for (size_t j = i; j > 0 && is_right(cluster->members[j - 1], cluster->members[j], y); j--) {
      cs_member *member = cluster->members[j];
      cluster->members[j] = cluster->members[j - 1];
      cluster->members[j - 1] = member;
    }
}

static bool is_inside(const turning *t, const cs_member *member) {
  return member->foot >= t->low && member->foot <= t->high;
}

static celspan_status flush_inside(cs_cluster *cluster, const turning *t, double y) {
  for (size_t j = 0; j < cluster->count; j++)
    if (!has_ended(cluster->members[j]) && is_inside(t, cluster->members[j]))
      CS_TRY(flush(cluster, j, cluster->members[j]->foot, y));
  return CELSPAN_OK;
}

static celspan_status refresh_inside(cs_cluster *cluster, const turning *t) {
  size_t first = 0, end = cluster->count;
  while (first < end && !is_inside(t, cluster->members[first]))
    first++;
  while (end > first && !is_inside(t, cluster->members[end - 1]))
    end--;
  return first < end ? refresh(cluster, first, end - 1) : CELSPAN_OK;
}

/* The events at height y, at the foot of the band just run. */
static celspan_status turn(cs_cluster *cluster, double y) {
  turning t = {INFINITY, -INFINITY};
  CS_TRY(end_members(cluster, y, &t));
  note_begins(cluster, y, &t);
  note_disorder(cluster, y, &t);
  CS_TRY(flush_inside(cluster, &t, y));
  stand(cluster, 0);
  drop_ended(cluster);
  begin_members(cluster, y);
  sort(cluster, y);
  return refresh_inside(cluster, &t);
}

celspan_status cs_cluster_replay(cs_cluster *cluster) {
  double y = cluster->y0;
  CS_TRY(cs_meetings_reserve(&cluster->scan->meetings, cluster->scan->context,
                             cluster->count + cluster->begin_count));
  cluster->stood = 0;
  cluster->passed = cluster->toggle;
  for (;;) {
    double next = next_height(cluster);
    if (next > y)
      CS_TRY(run_band(cluster, y, next));
    if (next >= cluster->y1) {
      stand(cluster, 0);
      stand_toggles(cluster, -INFINITY);
      return flush_all(cluster, cluster->y1);
    }
    y = next;
    CS_TRY(turn(cluster, y));
  }
}

/* ---------------------------------------------------------------- pairs */

static celspan_status draw(cs_scan *scan, celspan_point above, celspan_point below,
                           const cs_cell *left, const cs_cell *right) {
  if (!(below.y > above.y) || cs_composer_same(&scan->composer, left, right))
    return CELSPAN_OK;
  return cs_window_add(&scan->window, above.x, above.y, below.x, below.y, left, right);
}

/* The cell that boundary i + 1 opens when it is crossed first, at x. */
static celspan_status cell_between(cs_scan *scan, size_t i, double x, const cs_cell **out) {
  const cs_toggle *toggle = scan->cells.toggle;
  cs_composer *composer = &scan->composer;
  cs_crossing second = scan->active.crossing[i + 1];
  cs_cell *cell = cs_arena_take(scan->context, &scan->arena, sizeof *cell);
  if (!cell)
    return CELSPAN_NO_MEMORY;
  cs_composer_cross(composer, second.leaf, second.direction);
  const cs_toggle *passed = cs_cells_toggle(composer, toggle, scan->cells.toggle_end, x);
  cs_composer_cell(composer, cell);
  *out = cell;
  cs_composer_cross(composer, second.leaf, -second.direction);
  for (; passed > toggle; passed--)
    cs_composer_cross(composer, passed[-1].leaf, -passed[-1].direction);
  return composer->failure;
}

celspan_status cs_cluster_pair(cs_scan *scan, const cs_cell *left, size_t i,
                               const cs_cell **between) {
  const cs_active *active = &scan->active;
  celspan_point a = {active->x[i], active->y}, b = {active->x[i + 1], active->y};
  celspan_point a_foot = {active->x_next[i], active->y_next};
  celspan_point b_foot = {active->x_next[i + 1], active->y_next};
  double top = b.x - a.x, foot = a_foot.x - b_foot.x, u = top / (top + foot);
  double y = a.y + (a_foot.y - a.y) * u;
  celspan_point a_meets = {a.x + (a_foot.x - a.x) * u, y};
  celspan_point b_meets = {b.x + (b_foot.x - b.x) * u, y};
  const cs_cell *right = left + 2;
  CS_TRY(draw(scan, a, a_meets, left, left + 1));
  CS_TRY(draw(scan, b, b_meets, left + 1, right));
  CS_TRY(cell_between(scan, i, b_meets.x, between));
  CS_TRY(draw(scan, b_meets, b_foot, left, *between));
  return draw(scan, a_meets, a_foot, *between, right);
}
