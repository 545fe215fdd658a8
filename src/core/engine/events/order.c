#include "engine/events/order.h"

#include <math.h>

/* ---------------------------------------------------------------- life */

celspan_status cs_order_init(celspan_context *context, const cs_courses *courses, cs_order *out) {
  *out = (cs_order){.courses = courses, .ends = (uint32_t)courses->course_count};
  CS_TRY(CS_ARRAY_MAKE(context, out->entries, courses->course_count + 1));
  out->entries[out->ends].previous = out->entries[out->ends].next = out->last = out->ends;
  return CELSPAN_OK;
}

void cs_order_clear(cs_order *order) {
  cs_order_entry *entries = order->entries;
  for (uint32_t i = entries[order->ends].next; i != order->ends; i = entries[i].next)
    entries[i].is_there = false;
  entries[order->ends] = (cs_order_entry){.previous = order->ends, .next = order->ends};
  order->last = order->ends;
  order->index_count = order->entered = order->count = 0;
}

void cs_order_finish(cs_order *order, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, order, entries, index);
  *order = (cs_order){0};
}

/* ---------------------------------------------------------------- along courses */

/* The segment on which a course continues below a height above its foot. */
static inline const cs_course_point *segment_below(const cs_course_point *at, int32_t y) {
  while (at[1].y <= y)
    at++;
  return at;
}

double cs_order_x(const cs_order *order, uint32_t course, int32_t y) {
  const cs_course *of = &order->courses->courses[course];
  cs_order_entry *entry = &order->entries[course];
  if (y >= entry->foot)
    return order->courses->points[of->first + of->count - 1].x;
  entry->at = segment_below(entry->at, y);
  return cs_course_x(entry->at, y);
}

static inline int32_t lesser(int32_t a, int32_t b) { return a < b ? a : b; }
static inline int32_t greater(int32_t a, int32_t b) { return a > b ? a : b; }

/* On which side of a course q the course p lies where they first differ, from a height down to a
 * limit; neither ends above the limit. 1: p is right of q; -1: p is left of q; 0: they are the
 * same. */
static int compare(const cs_course_point *p, const cs_course_point *q, int32_t y, int32_t limit) {
  double above = cs_course_x(p, y) - cs_course_x(q, y);
  for (int32_t top = y;; above = cs_course_x(p, top) - cs_course_x(q, top)) {
    if (fabs(above) > CS_ORDER_SLACK)
      return above > 0 ? 1 : -1;
    if (top >= limit)
      return 0;
    top = lesser(lesser(p[1].y, q[1].y), limit);
    double below = cs_course_x(p, top) - cs_course_x(q, top);
    if (fabs(below) > CS_ORDER_SLACK)
      return below > 0 ? 1 : -1;
    if (top >= limit)
      return 0;
    p = segment_below(p, top);
    q = segment_below(q, top);
  }
}

/* The first whole height between two heights at which a course is no longer left of another one:
 * above it they would have to change places back. */
static int32_t intersection_height(int32_t top, int32_t foot, double above, double below) {
  if (above >= 0)
    return top;
  double height = ceil(((double)foot - top) * (above / (above - below)));
  return lesser(top + (int32_t)height, foot);
}

/* cs_order_ahead mostly goes along: with clip art a comparison passes seven points. Measured, and
 * not faster: x at the top of a segment kept from the one before, whole-number products in place of
 * divisions, selections in place of branches, belts of half the height. */

/* Whether a whole segment lies left of another one. */
static inline bool is_beside(const cs_course_point *p, const cs_course_point *q) {
  return greater(p->x, p[1].x) <= lesser(q->x, q[1].x);
}

int32_t cs_order_ahead(const cs_order *order, uint32_t course, int32_t y) {
  cs_order_entry *a = &order->entries[course], *b = &order->entries[a->next];
  int32_t limit = lesser(order->foot, lesser(a->foot, b->foot));
  if (y >= limit)
    return CS_ORDER_NEVER;
  const cs_course_point *p = a->at = segment_below(a->at, y);
  const cs_course_point *q = b->at = segment_below(b->at, y);
  for (int32_t top = y, foot;; top = foot) {
    foot = lesser(lesser(p[1].y, q[1].y), limit);
    if (!is_beside(p, q)) {
      double above = cs_course_x(p, top) - cs_course_x(q, top);
      double below = cs_course_x(p, foot) - cs_course_x(q, foot);
      if (above > CS_ORDER_SLACK)
        return top;
      if (below > CS_ORDER_SLACK)
        return intersection_height(top, foot, above, below);
    }
    if (foot == limit)
      return CS_ORDER_NEVER;
    p = segment_below(p, foot);
    q = segment_below(q, foot);
  }
}

/* ---------------------------------------------------------------- changes */

static inline void link_after(cs_order *order, uint32_t left, uint32_t course) {
  cs_order_entry *entries = order->entries;
  entries[course].previous = left;
  entries[course].next = entries[left].next;
  entries[entries[left].next].previous = course;
  entries[left].next = course;
}

static inline void unlink_entry(cs_order *order, uint32_t course) {
  cs_order_entry *entries = order->entries;
  entries[entries[course].previous].next = entries[course].next;
  entries[entries[course].next].previous = entries[course].previous;
}

/* Whether one of two courses that both cross y, or begin there, belongs left of the other one. The
 * course on the left at the first height, from y down, at which they differ is the left one; of two
 * equal courses, the one with the lower number. */
static bool is_left(const cs_order *order, uint32_t left, uint32_t right, int32_t y) {
  cs_order_entry *a = &order->entries[left], *b = &order->entries[right];
  int32_t limit = lesser(order->foot, lesser(a->foot, b->foot));
  a->at = segment_below(a->at, y);
  b->at = segment_below(b->at, y);
  int side = compare(a->at, b->at, y, limit);
  return side != 0 ? side < 0 : left < right;
}

/* ---------------------------------------------------------------- belts */

static inline void add_to_extent(cs_order_entry *entry, int32_t low, int32_t high) {
  entry->low = lesser(low, entry->low);
  entry->high = greater(high, entry->high);
}

/* The whole units on both sides of x, which is cut off towards 0. */
static inline void add_place(cs_order_entry *entry, double x) {
  int32_t unit = (int32_t)x;
  add_to_extent(entry, unit - (x < unit), unit + (x > unit));
}

/* Finds the extent of a course from a height down to the foot of the belt. Returns x at the height.
 */
static double find_extent(const cs_order *order, uint32_t course, int32_t y) {
  cs_order_entry *entry = &order->entries[course];
  int32_t end = lesser(order->foot, entry->foot);
  const cs_course_point *p = entry->at = segment_below(entry->at, y);
  double x = cs_course_x(p, y);
  entry->low = INT32_MAX;
  entry->high = INT32_MIN;
  add_place(entry, x);
  for (; p[1].y < end; p++)
    add_to_extent(entry, p[1].x, p[1].x);
  add_place(entry, cs_course_x(p, end));
  return x;
}

/* Lists the courses from left to right, with their places at a height. x_at: cs_order_x, or
 * find_extent, where a belt begins. */
static celspan_status make_index(celspan_context *context, cs_order *order, int32_t y,
                                 double (*x_at)(const cs_order *, uint32_t, int32_t)) {
  CS_TRY(CS_ARRAY_RESERVE(context, order->index, order->count));
  order->index_count = order->entered = 0;
  for (uint32_t i = order->entries[order->ends].next; i != order->ends; i = order->entries[i].next)
    order->index[order->index_count++] = (cs_order_place){x_at(order, i, y), i};
  return CELSPAN_OK;
}

static inline bool is_right(cs_order_place a, cs_order_place b) {
  return a.x != b.x ? a.x > b.x : a.course > b.course;
}

/* Sorts the places by x; most are in order. */
static void sort_places(cs_order_place *places, size_t count) {
  for (size_t i = 1; i < count; i++) {
    cs_order_place moved = places[i];
    size_t at = i;
    for (; at > 0 && is_right(places[at - 1], moved); at--)
      places[at] = places[at - 1];
    places[at] = moved;
  }
}

/* Brings courses that are closer than the slack into the order that they have further down. */
static void sort_near(const cs_order *order, int32_t y) {
  cs_order_place *places = order->index;
  for (size_t i = 1; i < order->index_count; i++) {
    cs_order_place moved = places[i];
    size_t at = i;
    for (; at > 0 && fabs(moved.x - places[at - 1].x) <= CS_ORDER_SLACK; at--) {
      if (is_left(order, places[at - 1].course, moved.course, y))
        break;
      places[at] = places[at - 1];
    }
    places[at] = moved;
  }
}

/* Links the courses in the order of the list. Returns whether that changes anything. */
static bool link_places(cs_order *order) {
  bool is_changed = false;
  uint32_t left = order->ends;
  for (size_t i = 0; i < order->index_count; i++) {
    uint32_t course = order->index[i].course;
    is_changed |= order->entries[left].next != course;
    order->entries[left].next = course;
    order->entries[course].previous = left;
    left = course;
  }
  order->entries[left].next = order->ends;
  order->entries[order->ends].previous = left;
  return is_changed;
}

celspan_status cs_order_begin_belt(celspan_context *context, cs_order *order, int32_t y,
                                   bool *is_changed) {
  CS_TRY(make_index(context, order, y, find_extent));
  order->last = order->ends;
  sort_places(order->index, order->index_count);
  sort_near(order, y);
  *is_changed = link_places(order);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- begins and ends */

/* A course at or left of the place where another one begins. It is found by the index, which may be
 * old: courses may have changed places since. */
static uint32_t find_near(const cs_order *order, double x, int32_t y) {
  size_t low = 0, high = order->index_count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (cs_order_x(order, order->index[middle].course, y) <= x)
      low = middle + 1;
    else
      high = middle;
  }
  while (low > 0 && !order->entries[order->index[low - 1].course].is_there)
    low--;
  return low > 0 ? order->index[low - 1].course : order->ends;
}

/* Whether the course that was put in last begins at the same point. Mostly this is so for a contour
 * that has its top there. */
static bool begins_at_last(const cs_order *order, const cs_course_point *points, int32_t y) {
  const cs_order_entry *last = &order->entries[order->last];
  return last->is_there && last->since == y && last->at->y == y && points[0].y == y &&
         last->at->x == points[0].x;
}

celspan_status cs_order_enter(celspan_context *context, cs_order *order, uint32_t course,
                              int32_t y) {
  const cs_course *of = &order->courses->courses[course];
  const cs_course_point *points = order->courses->points + of->first;
  cs_order_entry *entries = order->entries, *entry = &entries[course];
  *entry =
      (cs_order_entry){.at = segment_below(points, y), .foot = points[of->count - 1].y, .since = y};
  (void)find_extent(order, course, y);
  if (order->entered > 64 && 4 * order->entered > order->index_count)
    CS_TRY(make_index(context, order, y, cs_order_x));
  uint32_t left = begins_at_last(order, points, y) ? order->last
                                                   : find_near(order, cs_course_x(entry->at, y), y);
  while (entries[left].next != order->ends && is_left(order, entries[left].next, course, y))
    left = entries[left].next;
  while (left != order->ends && !is_left(order, left, course, y))
    left = entries[left].previous;
  link_after(order, left, course);
  entry->is_there = true;
  order->last = course;
  order->entered++;
  order->count++;
  return CELSPAN_OK;
}

void cs_order_leave(cs_order *order, uint32_t course) {
  unlink_entry(order, course);
  order->entries[course].is_there = false;
  order->count--;
}

void cs_order_swap(cs_order *order, uint32_t course) {
  uint32_t next = order->entries[course].next;
  unlink_entry(order, course);
  link_after(order, next, course);
}
