/* Contours as arrays of points: what is made of them, and how they are drawn point by point. */
#include "base/context.h"
#include "model/geometry/outline.h"

/* ---------------------------------------------------------------- reading */

static bool is_same(celspan_point a, celspan_point b) { return a.x == b.x && a.y == b.y; }

/* p: the current point, and the three of the piece. */
static celspan_status add_piece(celspan_context *context, cs_outline *outline,
                                const celspan_point *p) {
  const cs_hpoint piece[3] = {cs_hpoint_of(p[1]), cs_hpoint_of(p[2]), cs_hpoint_of(p[3])};
  if (is_same(p[0], p[1]) && is_same(p[2], p[3]))
    return cs_outline_line(context, outline, piece[2]);
  return cs_outline_piece(context, outline, 3, piece);
}

static celspan_status close_line(celspan_context *context, cs_outline *outline,
                                 cs_outline_closed *closed, const celspan_contour *contour) {
  const celspan_point *points = contour->points;
  size_t count = contour->point_count;
  if (count == 1 || !is_same(points[0], points[count - 1]))
    CS_TRY(cs_outline_line(context, outline, cs_hpoint_of(points[0])));
  return cs_outline_closed_add(context, closed, outline->contour_count - 1);
}

static celspan_status add_contour(celspan_context *context, cs_outline *outline,
                                  cs_outline_closed *closed, const celspan_contour *contour) {
  bool is_joined = closed && contour->closed;
  if (contour->point_count == 1 && !is_joined)
    return CELSPAN_OK;
  CS_TRY(closed ? cs_outline_begin(context, outline, cs_hpoint_of(contour->points[0]))
                : cs_outline_move(context, outline, cs_hpoint_of(contour->points[0])));
  for (size_t i = 0; i + 1 < contour->point_count; i += 3)
    CS_TRY(add_piece(context, outline, &contour->points[i]));
  return is_joined ? close_line(context, outline, closed, contour) : CELSPAN_OK;
}

celspan_status cs_outline_contours(celspan_context *context, cs_outline *outline,
                                   cs_outline_closed *closed, const celspan_contour *contours,
                                   size_t count) {
  for (size_t i = 0; i < count; i++)
    CS_TRY(add_contour(context, outline, closed, &contours[i]));
  return closed ? CELSPAN_OK : cs_outline_close(context, outline);
}

/* ---------------------------------------------------------------- drawing */

/* Invariant: unless memory ran out, the points are those of all contours, one after another. The
 * items get their places among the points when they are asked for. */
struct celspan_contours {
  celspan_context *context;
  CS_ARRAY(celspan_point, points);
  CS_ARRAY(celspan_contour, items);
  size_t point_count, count;
  celspan_point begin; /* where the last contour begins */
  bool is_drawing;     /* the last contour is not closed */
  bool has_failed;     /* memory ran out */
};

celspan_status celspan_contours_create(celspan_context *context, celspan_contours **out) {
  celspan_contours *contours;
  CS_TRY(CS_MAKE(context, contours, 1));
  *contours = (celspan_contours){.context = context};
  celspan_status status = CS_ARRAY_RESERVE(context, contours->items, 1);
  return CS_GIVE(status, contours, celspan_contours_destroy, out);
}

static void add_point(celspan_contours *c, double x, double y) {
  if (c->has_failed)
    return;
  c->has_failed =
      CS_ARRAY_APPEND(c->context, c->points, c->point_count, (celspan_point){x, y}) != CELSPAN_OK;
  c->items[c->count - 1].point_count++;
}

void celspan_contours_move_to(celspan_contours *c, double x, double y) {
  if (!c->has_failed)
    c->has_failed = CS_ARRAY_APPEND(c->context, c->items, c->count,
                                    (celspan_contour){.closed = false}) != CELSPAN_OK;
  c->begin = (celspan_point){x, y};
  c->is_drawing = true;
  add_point(c, x, y);
}

/* Begins a contour, unless the last one is being drawn. x, y: where, if none was begun yet. */
static void continue_at(celspan_contours *c, double x, double y) {
  if (!c->is_drawing && c->count > 0)
    celspan_contours_move_to(c, c->begin.x, c->begin.y);
  else if (!c->is_drawing)
    celspan_contours_move_to(c, x, y);
}

void celspan_contours_line_to(celspan_contours *c, double x, double y) {
  continue_at(c, x, y);
  if (c->has_failed)
    return;
  const celspan_point from = c->points[c->point_count - 1];
  celspan_contours_cubic_to(c, from.x, from.y, x, y, x, y);
}

void celspan_contours_cubic_to(celspan_contours *c, double x1, double y1, double x2, double y2,
                               double x, double y) {
  continue_at(c, x1, y1);
  add_point(c, x1, y1);
  add_point(c, x2, y2);
  add_point(c, x, y);
}

void celspan_contours_close(celspan_contours *c) {
  if (c->is_drawing && !c->has_failed)
    c->items[c->count - 1].closed = true;
  c->is_drawing = false;
}

celspan_status celspan_contours_get(celspan_contours *c, const celspan_contour **out,
                                    size_t *count) {
  if (c->has_failed)
    return cs_fail_memory(c->context);
  size_t at = 0;
  for (size_t i = 0; i < c->count; i++) {
    c->items[i].points = c->points + at;
    at += c->items[i].point_count;
  }
  *out = c->items;
  *count = c->count;
  return CELSPAN_OK;
}

void celspan_contours_destroy(celspan_contours *c) {
  if (!c)
    return;
  cs_memory *memory = c->context->memory;
  CS_ARRAYS_FREE(memory, c, points, items);
  cs_mem_free(memory, c, sizeof *c);
}
