/* Courses: the chains of a drawing as polylines in whole units, made at once.
 *
 *        o 0             points from the top of the chain down. Each is rounded to a unit, so all
 *         \              that follows from their order is exact. Chords keep the area left of the
 *          o 1           curve, as in model/geometry/polyline_vertex.h.
 *         /
 *    2 o-o 3             two points at one height: the course jumps there
 *      |
 *      o 4
 *
 * Invariants
 *   - Heights never fall; the first step and the last one are no jumps. A chain that has no height
 *     in units has no points.
 *   - Points that chains share are the same in all their courses: at any height as many chains of a
 *     contour go down as up.
 */
#pragma once

#include "base/arrays.h"
#include "model/geometry/boundary.h"

#define CS_COURSE_UNIT 65536 /* parts of a pixel */

/* A drawing has hundreds of thousands of points, and few are asked for x between two of them: so
 * slopes are not kept. */
typedef struct cs_course_point {
  int32_t x, y;
} cs_course_point;

typedef struct cs_course {
  size_t first;
  uint32_t count; /* 0, or at least 2 */
} cs_course;

/* The courses of chains, by chain; other courses may follow. */
typedef struct cs_courses {
  CS_ARRAY(cs_course, courses);
  CS_ARRAY(cs_course_point, points);
  size_t course_count, point_count;
} cs_courses;

/* The chains must lie within 16384 pixels of the origin sideways. The parts above 0 and below the
 * height, in pixels, at most 16384, are cut off. Between top and foot, in units, a course has all
 * its points: from the last point at or above the top to the first point at or below the foot.
 * more: upright courses for which there will be room. Errors: NO_MEMORY; cs_courses_finish must be
 * called then, too. */
CELSPAN_CHECKED celspan_status cs_courses_make(celspan_context *context, const cs_boundary_set *set,
                                               int32_t height, int32_t top, int32_t foot,
                                               size_t more, cs_courses *out);
/* Appends a course at x, in pixels, between two heights. */
void cs_courses_add_upright(cs_courses *courses, double x, int32_t top, int32_t foot);
void cs_courses_finish(cs_courses *courses, cs_memory *memory);

/* x at a height of the segment that begins at a point and is no jump. */
static inline double cs_course_x(const cs_course_point *from, int32_t y) {
  if (y == from[1].y)
    return from[1].x;
  if (y == from->y)
    return from->x;
  return from->x + (y - from->y) * (((double)from[1].x - from->x) / ((double)from[1].y - from->y));
}
