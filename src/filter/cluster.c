#include "filter/cluster.h"

#include <math.h>

/* ---------------------------------------------------------------- fragments */

static const cs_cell *left_of(const cs_cluster *cluster, size_t j) {
  return j > 0 ? cluster->members[j - 1].right : cluster->left;
}

/* Gives the window what member j drew since its last event, down to (x, y). */
static celspan_status flush(cs_cluster *cluster, size_t j, double x, double y) {
  cs_member *member = &cluster->members[j];
  const cs_cell *left = left_of(cluster, j);
  if (y > member->y && !cs_composer_same(&cluster->scan->composer, left, member->right))
    CS_TRY(cs_window_add(&cluster->scan->window, member->x, member->y, x, y, left, member->right));
  member->x = x;
  member->y = y;
  return CELSPAN_OK;
}

static celspan_status flush_all(cs_cluster *cluster, double y) {
  for (size_t j = 0; j < cluster->count; j++)
    CS_TRY(flush(cluster, j, cluster->members[j].foot, y));
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
    cross(composer, &cluster->members[cluster->stood], 1);
  for (; cluster->stood > place; cluster->stood--)
    cross(composer, &cluster->members[cluster->stood - 1], -1);
}

/* And past the toggles at or left of x. */
static void stand_toggles(cs_cluster *cluster, double x) {
  cs_composer *composer = &cluster->scan->composer;
  cluster->passed = cs_cells_toggle(composer, cluster->passed, cluster->toggle_end, x);
  for (; cluster->passed > cluster->toggle && cluster->passed[-1].x > x; cluster->passed--)
    cs_composer_cross(composer, cluster->passed[-1].leaf, -cluster->passed[-1].direction);
}

/* Brings the cells right of members first..last up to date. */
static celspan_status refresh(cs_cluster *cluster, size_t first, size_t last) {
  cs_scan *scan = cluster->scan;
  cs_composer *composer = &scan->composer;
  for (size_t j = first; j <= last; j++) {
    cs_member *member = &cluster->members[j];
    stand(cluster, j + 1);
    stand_toggles(cluster, member->x);
    if (member->right && cs_set_hash_same(member->right->hash, composer->hash))
      continue;
    cs_cell *cell = cs_arena_take(scan->context, &scan->arena, sizeof *cell);
    if (!cell)
      return CELSPAN_NO_MEMORY;
    cs_composer_cell(composer, cell);
    member->right = cell;
  }
  return composer->failure;
}

/* ---------------------------------------------------------------- bands */

/* x of a member at a height on the segment it stands on. */
static double member_x(const cs_member *member, double y) {
  const celspan_point *a = &member->points[member->at - 1], *b = &member->points[member->at];
  return y >= b->y ? b->x : a->x + (b->x - a->x) * ((y - a->y) / (b->y - a->y));
}

/* Slope of the segment a member stands on, for settling equal x. */
static double member_slope(const cs_member *member) {
  const celspan_point *a = &member->points[member->at - 1], *b = &member->points[member->at];
  return b->y > a->y ? (b->x - a->x) / (b->y - a->y) : 0;
}

/* The height of the next bend, begin or end below y. */
static double next_height(const cs_cluster *cluster) {
  double next = cluster->begin_count > 0 ? cluster->begins[0].points[0].y : cluster->y1;
  for (size_t j = 0; j < cluster->count; j++) {
    const cs_member *member = &cluster->members[j];
    if (member->points[member->at].y < next)
      next = member->points[member->at].y;
  }
  return next;
}

/* Where in the band member j meets its right neighbour. */
static void find_meeting(cs_cluster *cluster, size_t j) {
  cs_member *a = &cluster->members[j];
  const cs_member *b = a + 1;
  a->meets = INFINITY;
  if (j + 1 >= cluster->count || !(a->foot > b->foot))
    return;
  double foot = a->foot - b->foot, top = b->top > a->top ? b->top - a->top : 0;
  a->meets = top / (top + foot);
}

/* Which neighbours inside the band cross next. */
static bool next_swap(const cs_cluster *cluster, size_t *pair) {
  double least = INFINITY;
  for (size_t j = 0; j < cluster->count; j++)
    if (cluster->members[j].meets < least) {
      least = cluster->members[j].meets;
      *pair = j;
    }
  return least < INFINITY;
}

static celspan_status swap(cs_cluster *cluster, size_t j, double u, double y) {
  cs_member *a = &cluster->members[j], *b = a + 1;
  CS_TRY(flush(cluster, j, a->top + (a->foot - a->top) * u, y));
  CS_TRY(flush(cluster, j + 1, b->top + (b->foot - b->top) * u, y));
  const cs_cell *right = b->right;
  if (cluster->stood > j)
    stand(cluster, j);
  cs_member moved = *a;
  *a = *b;
  *b = moved;
  b->right = right; /* cells belong to places */
  return refresh(cluster, j, j);
}

/* Runs the members from y0 down to y1, all of them straight between. */
static celspan_status run_band(cs_cluster *cluster, double y0, double y1) {
  for (size_t j = 0; j < cluster->count; j++) {
    cs_member *member = &cluster->members[j];
    member->top = member->foot; /* the last band ended at this height, on the same x */
    member->foot = member_x(member, y1);
  }
  for (size_t j = 0; j < cluster->count; j++)
    find_meeting(cluster, j);
  double reached = 0;
  for (size_t j = 0; next_swap(cluster, &j);) {
    double u = cluster->members[j].meets;
    reached = u > reached ? u : reached;
    CS_TRY(swap(cluster, j, reached, y0 + (y1 - y0) * reached));
    find_meeting(cluster, j);
    find_meeting(cluster, j + 1);
    if (j > 0)
      find_meeting(cluster, j - 1);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- between bands */

static bool is_right(const cs_member *a, const cs_member *b) {
  if (a->foot != b->foot)
    return a->foot > b->foot;
  double slope_a = member_slope(a), slope_b = member_slope(b);
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

/* Moves members that bend or end at y on. */
static celspan_status step_members(cs_cluster *cluster, double y, turning *t) {
  for (size_t j = 0; j < cluster->count; j++) {
    cs_member *member = &cluster->members[j];
    if (member->points[member->at].y > y)
      continue;
    CS_TRY(flush(cluster, j, member->foot, y));
    while (member->at < member->point_count && member->points[member->at].y <= y)
      member->at++;
    if (has_ended(member))
      widen(t, member->foot);
  }
  return CELSPAN_OK;
}

static void drop_ended(cs_cluster *cluster) {
  size_t kept = 0;
  for (size_t j = 0; j < cluster->count; j++)
    if (!has_ended(&cluster->members[j]))
      cluster->members[kept++] = cluster->members[j];
  cluster->count = kept;
}

/* Lets the members that begin at y in, at the end of the order. */
static void begin_members(cs_cluster *cluster, double y) {
  size_t begun = 0;
  for (; begun < cluster->begin_count && cluster->begins[begun].points[0].y <= y; begun++) {
    cs_member *member = &cluster->members[cluster->count++];
    *member = cluster->begins[begun];
    member->x = member->foot = member->points[0].x;
    member->y = y;
    member->at = 1;
    member->right = NULL;
  }
  cluster->begins += begun;
  cluster->begin_count -= begun;
}

/* Members that meet in a point and part in another order. */
static void note_disorder(const cs_cluster *cluster, turning *t) {
  const cs_member *last = NULL;
  for (size_t j = 0; j < cluster->count; j++) {
    const cs_member *member = &cluster->members[j];
    if (has_ended(member))
      continue;
    if (last && is_right(last, member)) {
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

static void sort(cs_cluster *cluster) {
  for (size_t i = 1; i < cluster->count; i++)
    for (size_t j = i; j > 0 && is_right(&cluster->members[j - 1], &cluster->members[j]); j--) {
      cs_member member = cluster->members[j];
      cluster->members[j] = cluster->members[j - 1];
      cluster->members[j - 1] = member;
    }
}

static bool is_inside(const turning *t, const cs_member *member) {
  return member->foot >= t->low && member->foot <= t->high;
}

static celspan_status flush_inside(cs_cluster *cluster, const turning *t, double y) {
  for (size_t j = 0; j < cluster->count; j++)
    if (is_inside(t, &cluster->members[j]))
      CS_TRY(flush(cluster, j, cluster->members[j].foot, y));
  return CELSPAN_OK;
}

static celspan_status refresh_inside(cs_cluster *cluster, const turning *t) {
  size_t first = 0, end = cluster->count;
  while (first < end && !is_inside(t, &cluster->members[first]))
    first++;
  while (end > first && !is_inside(t, &cluster->members[end - 1]))
    end--;
  return first < end ? refresh(cluster, first, end - 1) : CELSPAN_OK;
}

/* The events at height y, at the foot of the band just run. */
static celspan_status turn(cs_cluster *cluster, double y) {
  turning t = {INFINITY, -INFINITY};
  CS_TRY(step_members(cluster, y, &t));
  note_begins(cluster, y, &t);
  note_disorder(cluster, &t);
  if (t.low > t.high)
    return CELSPAN_OK;
  CS_TRY(flush_inside(cluster, &t, y));
  stand(cluster, 0);
  drop_ended(cluster);
  begin_members(cluster, y);
  sort(cluster);
  return refresh_inside(cluster, &t);
}

celspan_status cs_cluster_replay(cs_cluster *cluster) {
  double y = cluster->y0;
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
static celspan_status cell_between(cs_scan *scan, size_t i, double x, const cs_toggle *toggle,
                                   const cs_toggle *toggle_end, const cs_cell **out) {
  cs_composer *composer = &scan->composer;
  cs_crossing second = scan->active.crossing[i + 1];
  cs_cell *cell = cs_arena_take(scan->context, &scan->arena, sizeof *cell);
  if (!cell)
    return CELSPAN_NO_MEMORY;
  cs_composer_cross(composer, second.leaf, second.direction);
  const cs_toggle *passed = cs_cells_toggle(composer, toggle, toggle_end, x);
  cs_composer_cell(composer, cell);
  *out = cell;
  cs_composer_cross(composer, second.leaf, -second.direction);
  for (; passed > toggle; passed--)
    cs_composer_cross(composer, passed[-1].leaf, -passed[-1].direction);
  return composer->failure;
}

celspan_status cs_cluster_pair(cs_scan *scan, const cs_cell *left, size_t i,
                               const cs_toggle *toggle, const cs_toggle *toggle_end,
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
  CS_TRY(cell_between(scan, i, b_meets.x, toggle, toggle_end, between));
  CS_TRY(draw(scan, b_meets, b_foot, left, *between));
  return draw(scan, a_meets, a_foot, *between, right);
}
