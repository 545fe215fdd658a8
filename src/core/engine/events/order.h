/* The order of the courses that cross a height: a list from left to right, in which neighbours are
 * compared ahead.
 *
 *      y     a     b      c      ahead: where the left of two neighbours comes to lie right of the
 *             \   /       |      other one, down to the foot of the belt, or to the end of either
 *              \ /        |
 *        .......x.........|....  here a and b must change places
 *              / \        |
 *      foot   b   a       c      belt: some rows, for which the extent of each course is known, so
 *                                that most neighbours need no comparison
 *
 * Courses have intersected only when one is beyond the other by more than CS_ORDER_SLACK units: so
 * common boundaries of two shapes, whose points are rounded, do not change places again and again.
 *
 * Invariants
 *   - at one height, of two courses at most one has to be put right of the other, so changes of
 *     places come to an end;
 *   - each belt begins with an order in which nothing is left of the belts above: by x; of those
 *     that lie within the slack, by which is beyond the other first in the belt, or by number. So
 *     what happens in a belt depends on the courses in it alone, and a sweep may begin at any belt.
 */
#pragma once

#include "base/arrays.h"
#include "engine/events/course.h"

#define CS_ORDER_SLACK 2.0 /* units */
#define CS_ORDER_NEVER INT32_MAX
#define CS_ORDER_BELT (8 * CS_COURSE_UNIT)

/* A course that crosses the height, by its number. The last entry is both ends of the list. */
typedef struct cs_order_entry {
  const cs_course_point *at; /* where its segment at the height begins */
  int32_t foot;              /* the height at which the course ends */
  /* the extent of x in the belt, from the place where the course begins in the belt */
  int32_t low, high;
  uint32_t previous, next; /* courses */
  uint32_t left, right;    /* windings on its sides */
  int32_t since;           /* the height from which on these windings have been valid */
  bool is_there;           /* in the list */
  bool is_dirty;           /* for the caller: its windings must be found again */
  bool is_touched;         /* for the caller: it has another right neighbour */
} cs_order_entry;

/* Where a course crossed a height. */
typedef struct cs_order_place {
  double x;
  uint32_t course;
} cs_order_place;

typedef struct cs_order {
  const cs_courses *courses;         /* borrowed */
  CS_ARRAY(cs_order_entry, entries); /* one for each course, and the ends */
  /* courses that crossed an earlier height, from left to right */
  CS_ARRAY(cs_order_place, index);
  uint32_t ends; /* the number of the entry for the ends */
  size_t index_count, count;
  size_t entered; /* courses that were put in after the index was made */
  uint32_t last;  /* the last one of these, or the ends */
  int32_t foot;   /* where the belt ends */
} cs_order;

/* Errors: NO_MEMORY; cs_order_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_order_init(celspan_context *context, const cs_courses *courses,
                                             cs_order *out);
void cs_order_finish(cs_order *order, cs_memory *memory);
/* Removes all courses. */
void cs_order_clear(cs_order *order);
/* Brings the courses that cross y into their order; at y the belt begins that goes down to
 * order->foot. *is_changed: the order has changed. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_order_begin_belt(celspan_context *context, cs_order *order,
                                                   int32_t y, bool *is_changed);
/* Puts in a course that begins at y, or crosses it and has not been in the list until now.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_order_enter(celspan_context *context, cs_order *order,
                                              uint32_t course, int32_t y);
void cs_order_leave(cs_order *order, uint32_t course);
/* Lets a course and its right neighbour change places. */
void cs_order_swap(cs_order *order, uint32_t course);
/* Whether a course has a right neighbour that it may meet in this belt. */
static inline bool cs_order_may_meet(const cs_order *order, uint32_t course) {
  const cs_order_entry *entry = &order->entries[course];
  return course != order->ends && entry->next != order->ends &&
         entry->high > order->entries[entry->next].low;
}

/* The height, from y on, at which a course must change places with its right neighbour, which it
 * may meet; NEVER: not in this belt. */
int32_t cs_order_ahead(const cs_order *order, uint32_t course, int32_t y);
/* x of a course that crosses a height, or of its last point. */
double cs_order_x(const cs_order *order, uint32_t course, int32_t y);
