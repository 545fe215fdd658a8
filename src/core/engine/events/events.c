#include "engine/events/events.h"

#include "base/keys.h"
#include "engine/events/order.h"

/* Two courses that must change places, if they are still neighbours then. */
typedef struct intersection {
  int32_t y;
  uint32_t left, right;
} intersection;

typedef struct sweep {
  celspan_context *context;
  const cs_boundary_set *set;
  const cs_cull *cull;
  int32_t tile_row; /* -1: above the first one */
  cs_events *events;
  cs_order order;
  CS_ARRAY(intersection, intersections); /* a heap, the highest one first */
  CS_ARRAY(uint64_t, ends);              /* keys of all chains by where they end */
  CS_ARRAY(uint64_t, dirty);             /* by x, courses whose windings must be found again */
  CS_ARRAY(uint32_t, touched);           /* courses that have another right neighbour */
  size_t intersection_count, end_count, dirty_count, touched_count, next_end, next_begin;
  int32_t zone_height, zone; /* in units; zone: the number of the current zone plus 1 */
  cs_events_limits limits;
  size_t met, entered; /* windings and courses in the zone */
  size_t zone_parts;   /* parts that ended above the zone */
} sweep;

/* ---------------------------------------------------------------- intersections */

/* Adds an intersection to the heap. */
static celspan_status push(sweep *s, intersection added) {
  CS_TRY(CS_ARRAY_APPEND(s->context, s->intersections, s->intersection_count, added));
  size_t at = s->intersection_count - 1;
  for (size_t parent; at > 0 && s->intersections[parent = (at - 1) / 2].y > added.y; at = parent)
    s->intersections[at] = s->intersections[parent];
  s->intersections[at] = added;
  return CELSPAN_OK;
}

/* Removes the highest intersection and returns it. */
static intersection pop(sweep *s) {
  intersection first = s->intersections[0], moved = s->intersections[--s->intersection_count];
  size_t at = 0, count = s->intersection_count;
  for (size_t child; (child = 2 * at + 1) < count; at = child) {
    child += child + 1 < count && s->intersections[child + 1].y < s->intersections[child].y;
    if (s->intersections[child].y >= moved.y)
      break;
    s->intersections[at] = s->intersections[child];
  }
  s->intersections[at] = moved;
  return first;
}

/* Compares a course with its right neighbour, from a height downwards. */
static celspan_status compare_ahead(sweep *s, uint32_t course, int32_t y) {
  if (!cs_order_may_meet(&s->order, course))
    return CELSPAN_OK;
  int32_t height = cs_order_ahead(&s->order, course, y);
  if (height == CS_ORDER_NEVER)
    return CELSPAN_OK;
  return push(s, (intersection){height, course, s->order.entries[course].next});
}

/* ---------------------------------------------------------------- windings */

/* Counts the windings that are met in the zone. */
static void meet(sweep *s, uint32_t windings) {
  cs_windings_entry *entry = &s->events->windings.entries[windings];
  s->met += entry->zone != s->zone;
  entry->zone = s->zone;
}

static celspan_status cross(sweep *s, uint32_t course, uint32_t from, uint32_t *out) {
  cs_windings_hash change = {0, 0};
  if (course < s->set->chain_count)
    change =
        cs_windings_add(change, s->set->chains[course].layer, s->set->chains[course].direction);
  else
    change = s->events->bundles.bundles[course - s->set->chain_count].change;
  CS_TRY(cs_windings_cross(s->context, &s->events->windings, from, course, change, out));
  meet(s, *out);
  return CELSPAN_OK;
}

/* Ends the part of a course at a height. */
static celspan_status close(sweep *s, uint32_t course, int32_t y) {
  cs_order_entry *entry = &s->order.entries[course];
  cs_events *events = s->events;
  const cs_events_part part = {course, entry->since, y, entry->left, entry->right};
  entry->since = y;
  if (part.top >= y)
    return CELSPAN_OK;
  return CS_ARRAY_APPEND(s->context, events->parts, events->part_count, part);
}

static celspan_status mark_dirty(sweep *s, uint32_t course, int32_t y) {
  cs_order_entry *entry = &s->order.entries[course];
  if (course == s->order.ends || entry->is_dirty)
    return CELSPAN_OK;
  entry->is_dirty = true;
  const uint64_t key = cs_key((int32_t)cs_order_x(&s->order, course, y), course);
  return CS_ARRAY_APPEND(s->context, s->dirty, s->dirty_count, key);
}

/* Finds the windings right of a course, given those on its left. */
static celspan_status settle(sweep *s, uint32_t course, uint32_t left, int32_t y) {
  cs_order_entry *entry = &s->order.entries[course];
  uint32_t right;
  CS_TRY(cross(s, course, left, &right));
  CS_TRY(close(s, course, y));
  entry->left = left;
  entry->right = right;
  entry->is_dirty = false;
  return CELSPAN_OK;
}

/* Finds the windings from a course on to the right, until they are known. */
static celspan_status find_windings(sweep *s, uint32_t course, int32_t y) {
  const cs_order_entry *entries = s->order.entries;
  while (entries[entries[course].previous].is_dirty)
    course = entries[course].previous;
  uint32_t left = entries[entries[course].previous].right;
  for (; course != s->order.ends; course = entries[course].next) {
    if (!entries[course].is_dirty && entries[course].left == left)
      return CELSPAN_OK;
    CS_TRY(settle(s, course, left, y));
    left = entries[course].right;
  }
  return CELSPAN_OK;
}

/* Finds the windings of all courses, after any changes. */
static celspan_status find_all_windings(sweep *s, int32_t y) {
  const cs_order_entry *entries = s->order.entries;
  uint32_t left = 0;
  s->dirty_count = 0;
  for (uint32_t i = entries[s->order.ends].next; i != s->order.ends; i = entries[i].next) {
    if (entries[i].is_dirty || entries[i].left != left)
      CS_TRY(settle(s, i, left, y));
    left = entries[i].right;
  }
  return CELSPAN_OK;
}

static celspan_status settle_dirty(sweep *s, int32_t y) {
  CS_TRY(cs_keys_sort(s->context, s->dirty, s->dirty_count));
  for (size_t i = 0; i < s->dirty_count; i++) {
    uint32_t course = cs_key_number(s->dirty[i]);
    const cs_order_entry *entry = &s->order.entries[course];
    if (entry->is_there && entry->is_dirty)
      CS_TRY(find_windings(s, course, y));
  }
  s->dirty_count = 0;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- begins and ends */

static celspan_status touch(sweep *s, uint32_t course) {
  cs_order_entry *entry = &s->order.entries[course];
  if (entry->is_touched)
    return CELSPAN_OK;
  entry->is_touched = true;
  return CS_ARRAY_APPEND(s->context, s->touched, s->touched_count, course);
}

static celspan_status enter(sweep *s, uint32_t course, int32_t y) {
  s->entered++;
  CS_TRY(cs_order_enter(s->context, &s->order, course, y));
  const cs_order_entry *entry = &s->order.entries[course];
  CS_TRY(touch(s, course));
  CS_TRY(touch(s, entry->previous));
  CS_TRY(mark_dirty(s, course, y));
  return mark_dirty(s, entry->next, y);
}

static celspan_status leave(sweep *s, uint32_t course, int32_t y) {
  const cs_order_entry *entry = &s->order.entries[course];
  if (!entry->is_there)
    return CELSPAN_OK;
  CS_TRY(close(s, course, y));
  cs_order_leave(&s->order, course);
  CS_TRY(touch(s, entry->previous));
  return mark_dirty(s, entry->next, y);
}

/* Where the next chain ends; NEVER: all have ended. */
static inline int32_t next_end(const sweep *s) {
  return s->next_end < s->end_count ? cs_key_by(s->ends[s->next_end]) : CS_ORDER_NEVER;
}

static celspan_status end_courses(sweep *s, int32_t y) {
  for (; next_end(s) == y; s->next_end++)
    CS_TRY(leave(s, cs_key_number(s->ends[s->next_end]), y));
  return CELSPAN_OK;
}

/* The next chain that begins, or NULL. */
static const cs_course_point *next_begin(sweep *s) {
  const cs_courses *courses = &s->events->courses;
  while (s->next_begin < s->set->chain_count && courses->courses[s->next_begin].count == 0)
    s->next_begin++;
  return s->next_begin < s->set->chain_count
             ? courses->points + courses->courses[s->next_begin].first
             : NULL;
}

/* Whether a chain has a course that ends below a height. */
static inline bool ends_below(const sweep *s, uint32_t chain, int32_t y) {
  const cs_course *course = &s->events->courses.courses[chain];
  return course->count > 0 && s->events->courses.points[course->first + course->count - 1].y > y;
}

static celspan_status begin_courses(sweep *s, int32_t y) {
  for (const cs_course_point *at; (at = next_begin(s)) && at->y == y; s->next_begin++)
    if (cs_cull_keeps(s->cull, (uint32_t)s->next_begin, s->tile_row))
      CS_TRY(enter(s, (uint32_t)s->next_begin, y));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows of tiles */

/* Removes the chains that are culled in this row of tiles, and the bundles of the row before. */
static celspan_status leave_culled(sweep *s, int32_t y) {
  const cs_order *order = &s->order;
  for (uint32_t i = order->entries[order->ends].next, next; i != order->ends; i = next) {
    next = order->entries[i].next;
    if (i >= s->set->chain_count || !cs_cull_keeps(s->cull, i, s->tile_row))
      CS_TRY(leave(s, i, y));
  }
  return CELSPAN_OK;
}

static celspan_status enter_bundles(sweep *s, int32_t y) {
  const uint32_t *starts = s->events->bundles.starts + s->tile_row;
  for (uint32_t k = starts[0]; k < starts[1]; k++)
    CS_TRY(enter(s, (uint32_t)s->set->chain_count + k, y));
  return CELSPAN_OK;
}

static celspan_status enter_kept(sweep *s, int32_t y) {
  const cs_cull *cull = s->cull;
  for (uint32_t k = cull->enter_starts[s->tile_row]; k < cull->enter_starts[s->tile_row + 1]; k++) {
    const cs_courses *courses = &s->events->courses;
    if (ends_below(s, cull->enters[k], y) &&
        courses->points[courses->courses[cull->enters[k]].first].y < y)
      CS_TRY(enter(s, cull->enters[k], y));
  }
  return enter_bundles(s, y);
}

/* The top of the next row of tiles; NEVER: there is none. */
static int32_t next_tiles(const sweep *s) {
  return s->tile_row + 1 < s->cull->tile_rows ? cs_bundle_top(s->cull, s->tile_row + 1)
                                              : CS_ORDER_NEVER;
}

/* ---------------------------------------------------------------- belts */

/* Lets neighbours change places. */
static celspan_status intersect(sweep *s, intersection m) {
  cs_order_entry *a = &s->order.entries[m.left], *b = &s->order.entries[m.right];
  uint32_t left = a->left, right = b->right;
  if (!a->is_there || !b->is_there || a->next != m.right)
    return CELSPAN_OK;
  CS_TRY(close(s, m.left, m.y));
  CS_TRY(close(s, m.right, m.y));
  cs_order_swap(&s->order, m.left);
  b->left = left;
  CS_TRY(cross(s, m.right, left, &b->right));
  a->left = b->right;
  a->right = right;
  s->events->intersections++;
  CS_TRY(compare_ahead(s, b->previous, m.y));
  CS_TRY(compare_ahead(s, m.right, m.y));
  return compare_ahead(s, m.left, m.y);
}

static celspan_status intersect_until(sweep *s, int32_t y) {
  while (s->intersection_count > 0 && s->intersections[0].y <= y)
    CS_TRY(intersect(s, pop(s)));
  return CELSPAN_OK;
}

static inline bool has_too_many(const sweep *s) {
  return s->met > s->limits.most ||
         (s->met > s->limits.few && s->met > s->limits.each * s->entered);
}

/* Begins the belt below y: all courses that cross y are brought into order, and compared. */
static celspan_status begin_belt(sweep *s, int32_t y) {
  const cs_order *order = &s->order;
  const int32_t zone = y / s->zone_height + 1;
  bool is_changed, is_zone = zone != s->zone;
  if (is_zone) {
    s->met = 0;
    s->entered = order->count;
    s->zone_parts = s->events->part_count;
  }
  s->zone = zone;
  CS_TRY(cs_order_begin_belt(s->context, &s->order, y, &is_changed));
  if (is_changed || s->touched_count > 0)
    CS_TRY(find_all_windings(s, y));
  for (uint32_t i = order->entries[order->ends].next; is_zone && i != order->ends;
       i = order->entries[i].next)
    meet(s, order->entries[i].right);
  for (size_t i = 0; i < s->touched_count; i++)
    order->entries[s->touched[i]].is_touched = false;
  s->touched_count = 0;
  for (uint32_t i = order->entries[order->ends].next; i != order->ends; i = order->entries[i].next)
    CS_TRY(compare_ahead(s, i, y));
  return CELSPAN_OK;
}

/* The top of a belt, at or above a height. */
static inline int32_t belt_above(int32_t y) { return y - y % CS_ORDER_BELT; }

/* Goes through the belts above a height. */
static celspan_status go_to(sweep *s, int32_t y) {
  cs_order *order = &s->order;
  if (order->count == 0 && order->foot < y) /* there are no courses in these belts */
    order->foot = belt_above(y);
  while (order->foot < y) {
    int32_t top = order->foot;
    CS_TRY(intersect_until(s, top));
    if (has_too_many(s))
      return CELSPAN_OK;
    order->foot += CS_ORDER_BELT;
    CS_TRY(begin_belt(s, top));
  }
  return intersect_until(s, y);
}

/* ---------------------------------------------------------------- all changes at a height */

static celspan_status compare_touched(sweep *s, int32_t y) {
  for (size_t i = 0; i < s->touched_count; i++) {
    cs_order_entry *entry = &s->order.entries[s->touched[i]];
    entry->is_touched = false;
    if (entry->is_there)
      CS_TRY(compare_ahead(s, s->touched[i], y));
  }
  s->touched_count = 0;
  return CELSPAN_OK;
}

static celspan_status change_courses(sweep *s, int32_t y) {
  bool is_tile = y == next_tiles(s), is_belt = y == s->order.foot;
  CS_TRY(end_courses(s, y));
  s->order.foot += is_belt ? CS_ORDER_BELT : 0;
  if (is_tile) {
    s->tile_row++;
    CS_TRY(leave_culled(s, y));
    CS_TRY(enter_kept(s, y));
  }
  CS_TRY(begin_courses(s, y));
  if (is_belt)
    return begin_belt(s, y);
  CS_TRY(is_tile ? find_all_windings(s, y) : settle_dirty(s, y));
  return compare_touched(s, y);
}

/* ---------------------------------------------------------------- the sweep */

static inline int32_t lesser(int32_t a, int32_t b) { return a < b ? a : b; }

/* Begins at the top of a belt, with the courses that cross this height or begin there. */
static celspan_status begin(sweep *s, int32_t top) {
  cs_order_clear(&s->order);
  s->intersection_count = s->dirty_count = s->touched_count = s->next_begin = s->met = 0;
  s->order.foot = top;
  if (s->cull->tile_rows > 0 && top > 0) {
    s->tile_row = cs_cull_row(s->cull, top / CS_COURSE_UNIT);
    CS_TRY(enter_bundles(s, top));
  }
  for (const cs_course_point *at; top > 0 && (at = next_begin(s)) && at->y <= top; s->next_begin++)
    if (ends_below(s, (uint32_t)s->next_begin, top) &&
        cs_cull_keeps(s->cull, (uint32_t)s->next_begin, s->tile_row))
      CS_TRY(enter(s, (uint32_t)s->next_begin, top));
  while (next_end(s) <= top)
    s->next_end++;
  return CELSPAN_OK;
}

/* Ends all parts at a height inside a zone, or at its top. Parts found below that height are
 * dropped. */
static celspan_status end_parts(sweep *s, int32_t foot) {
  const cs_order *order = &s->order;
  cs_events *events = s->events;
  size_t count = s->zone_parts;
  for (uint32_t i = order->entries[order->ends].next; i != order->ends; i = order->entries[i].next)
    CS_TRY(close(s, i, foot));
  for (size_t i = count; i < events->part_count; i++) {
    cs_events_part part = events->parts[i];
    part.foot = lesser(part.foot, foot);
    if (part.top < part.foot)
      events->parts[count++] = part;
  }
  events->part_count = count;
  return CELSPAN_OK;
}

/* Goes down to a foot. *next: the foot, or the end of a zone that has too many windings. */
static celspan_status go_down(sweep *s, int32_t top, int32_t foot, int32_t *next) {
  CS_TRY(begin(s, top));
  for (int32_t y = top; y < foot && !has_too_many(s);) {
    CS_TRY(change_courses(s, y));
    const cs_course_point *begin = next_begin(s);
    y = lesser(next_tiles(s), next_end(s));
    y = lesser(begin ? begin->y : foot, lesser(y, foot));
    CS_TRY(go_to(s, y));
  }
  *next = foot;
  if (!has_too_many(s))
    return end_parts(s, foot);
  *next = s->zone * s->zone_height;
  s->events->missing |= UINT64_C(1) << (s->zone - 1);
  return end_parts(s, *next - s->zone_height);
}

/* Lists where the chains end. */
static celspan_status list_ends(sweep *s) {
  const cs_courses *courses = &s->events->courses;
  CS_TRY(CS_ARRAY_MAKE(s->context, s->ends, s->set->chain_count + 1));
  for (size_t i = 0; i < s->set->chain_count; i++) {
    const cs_course *course = &courses->courses[i];
    const cs_course_point *last = courses->points + course->first + course->count - 1;
    if (course->count > 0)
      s->ends[s->end_count++] = cs_key(last->y, i);
  }
  return cs_keys_sort(s->context, s->ends, s->end_count);
}

celspan_status cs_events_find(celspan_context *context, const cs_boundary_set *set,
                              const cs_cull *cull, cs_events_rows rows, cs_events_limits limits,
                              cs_events *out) {
  sweep s = {.context = context, .set = set, .cull = cull, .events = out, .tile_row = -1};
  s.zone_height = rows.zone * CS_COURSE_UNIT;
  s.limits = limits;
  int32_t top = belt_above(rows.first * CS_COURSE_UNIT), foot = rows.end * CS_COURSE_UNIT;
  const int32_t last = belt_above(foot + CS_ORDER_BELT - 1);
  *out = (cs_events){0};
  CS_TRY(
      cs_courses_make(context, set, rows.height, top, last, cull->deferred_count, &out->courses));
  CS_TRY(cs_bundles_make(context, cull, &out->courses, &out->bundles));
  CS_TRY(cs_windings_init(context, &out->windings));
  CS_TRY(CS_ARRAY_RESERVE(context, out->parts, 4 * out->courses.course_count));
  celspan_status status = list_ends(&s);
  if (status == CELSPAN_OK)
    status = cs_order_init(context, &out->courses, &s.order);
  while (top < foot && status == CELSPAN_OK)
    status = go_down(&s, top, foot, &top);
  cs_order_finish(&s.order, context->memory);
  CS_ARRAYS_FREE(context->memory, &s, intersections, touched);
  return status;
}

void cs_events_finish(cs_events *events, cs_memory *memory) {
  cs_courses_finish(&events->courses, memory);
  cs_bundles_finish(&events->bundles, memory);
  cs_windings_finish(&events->windings, memory);
  CS_ARRAYS_FREE(memory, events, parts, parts);
  *events = (cs_events){0};
}
