#include "engine/events/course.h"

#include "base/number.h"
#include "model/geometry/polyline.h"

typedef struct maker {
  const cs_boundary_set *set;
  cs_courses *out;
  double height; /* parts above 0 and below this are cut off */
  /* in units: points are made from the last one above the top down to the first one below the
   * foot */
  int32_t top, foot;
  double *x, *y; /* places of the vertices of a piece */
} maker;

/* Rounds to the nearest unit. The place is shifted first, so that cutting off the fraction rounds
 * down. */
static inline int32_t round_to_unit(double place) {
  const int64_t shift = INT64_C(1) << 31;
  return (int32_t)((int64_t)(place * CS_COURSE_UNIT + ((double)shift + 0.5)) - shift);
}

/* Appends a point no higher than the last one of its course, for which there is room. */
static inline void add_point(const maker *m, cs_course_point *points, cs_course *course, double x,
                             double y) {
  cs_course_point *last = points + course->count;
  const cs_course_point *before = last - 1;
  if (course->count > 1 && before->y >= m->foot)
    return;
  *last = (cs_course_point){round_to_unit(x), round_to_unit(y)};
  if (course->count > 0 && last->y < before->y)
    last->y = before->y;
  if (course->count == 1 && (last->y == before->y || last->y <= m->top)) /* or a jump at the top */
    points[0] = *last;
  else if (course->count == 0 || last->x != before->x || last->y != before->y)
    course->count++;
}

static inline double x_between(celspan_point a, celspan_point b, double y) {
  return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
}

/* Adds the part of a chord inside the drawing. */
static void add_chord(const maker *m, cs_course_point *points, cs_course *course,
                      celspan_point from, celspan_point to) {
  if (to.y < 0 || from.y > m->height || to.y == from.y)
    return;
  if (from.y < 0)
    add_point(m, points, course, x_between(from, to, 0), 0);
  if (to.y > m->height)
    add_point(m, points, course, x_between(from, to, m->height), m->height);
  else
    add_point(m, points, course, to.x, to.y);
}

/* Adds the points of a piece below its first point; for a piece above the top, the last point is
 * enough. */
static void add_piece(const maker *m, const cs_boundary_piece *piece, cs_course_point *points,
                      cs_course *course) {
  bool is_inside = piece->y0 >= 0 && piece->y1 <= m->height;
  bool is_above = piece->y1 * CS_COURSE_UNIT < m->top - 1;
  celspan_point last = {piece->x0, piece->y0};
  if (piece->chords > 1 && !is_above)
    cs_polyline_displaced(m->set, piece, m->x, m->y);
  m->x[piece->chords - 1] = piece->x1;
  m->y[piece->chords - 1] = piece->y1;
  for (uint32_t k = is_above ? piece->chords - 1 : 0; k < piece->chords; k++) {
    const celspan_point at = {cs_number_clamp(m->x[k], piece->left, piece->right),
                              cs_number_clamp(m->y[k], last.y, piece->y1)};
    if (is_inside)
      add_point(m, points, course, at.x, at.y);
    else
      add_chord(m, points, course, last, at);
    last = at;
  }
}

/* Leaves out a jump at the foot, and a course without height. */
static void end_course(cs_courses *out, cs_course *course) {
  cs_course_point *points = out->points + course->first;
  while (course->count > 1 && points[course->count - 2].y == points[course->count - 1].y)
    course->count--;
  if (course->count < 2)
    course->count = 0;
  out->point_count += course->count;
}

static inline bool is_beyond(const maker *m, const cs_boundary_chain *chain) {
  return chain->y1 * CS_COURSE_UNIT < m->top - 1 || chain->y0 * CS_COURSE_UNIT > m->foot + 1;
}

static void make_course(const maker *m, const cs_boundary_chain *chain, cs_course *course) {
  cs_course_point *points = m->out->points + m->out->point_count;
  *course = (cs_course){m->out->point_count, 0};
  if (is_beyond(m, chain))
    return;
  if (chain->y0 >= 0 && chain->y0 <= m->height)
    add_point(m, points, course, chain->x0, chain->y0);
  for (uint32_t k = 0; k < chain->piece_count; k++)
    add_piece(m, &m->set->pieces[chain->piece + k], points, course);
  end_course(m->out, course);
}

/* The points of all courses, at most. */
static size_t count_points(const maker *m, size_t *most) {
  size_t count = 1;
  *most = 1;
  for (size_t i = 0; i < m->set->chain_count; i++) {
    const cs_boundary_chain *chain = &m->set->chains[i];
    count += is_beyond(m, chain) ? 0 : 2;
    for (uint32_t k = 0; k < chain->piece_count && !is_beyond(m, chain); k++) {
      size_t chords = m->set->pieces[chain->piece + k].chords;
      count += chords;
      *most = chords > *most ? chords : *most;
    }
  }
  return count;
}

celspan_status cs_courses_make(celspan_context *context, const cs_boundary_set *set, int32_t height,
                               int32_t top, int32_t foot, size_t more, cs_courses *out) {
  maker m = {.set = set, .out = out, .height = height, .top = top, .foot = foot};
  size_t most, count = count_points(&m, &most) + 2 * more;
  *out = (cs_courses){0};
  CS_TRY(CS_ARRAY_RESERVE(context, out->courses, set->chain_count + more + 1));
  out->course_count = set->chain_count;
  CS_TRY(CS_ARRAY_RESERVE(context, out->points, count));
  CS_TRY(CS_MAKE(context, m.x, 2 * most));
  m.y = m.x + most;
  for (size_t i = 0; i < set->chain_count; i++)
    make_course(&m, &set->chains[i], &out->courses[i]);
  cs_mem_free(context->memory, m.x, 2 * most * sizeof *m.x);
  return CELSPAN_OK;
}

void cs_courses_add_upright(cs_courses *courses, double x, int32_t top, int32_t foot) {
  cs_course_point *points = courses->points + courses->point_count;
  courses->courses[courses->course_count++] = (cs_course){courses->point_count, 2};
  courses->point_count += 2;
  points[0] = (cs_course_point){round_to_unit(x), top};
  points[1] = (cs_course_point){round_to_unit(x), foot};
}

void cs_courses_finish(cs_courses *courses, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, courses, courses, points);
  *courses = (cs_courses){0};
}
