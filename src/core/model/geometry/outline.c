#include "model/geometry/outline.h"

#include <math.h>

#include "base/number.h"

#define POINT_LIMIT ((size_t)1 << 31)

void cs_outline_init(cs_outline *outline) { *outline = (cs_outline){.is_plain = true}; }

void cs_outline_finish(cs_outline *outline, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, outline, points, contours);
  cs_outline_init(outline);
}

/* ---------------------------------------------------------------- building */

static celspan_status reserve_points(celspan_context *context, cs_outline *outline, size_t more) {
  if (more > POINT_LIMIT - outline->point_count)
    return cs_fail(context, CELSPAN_LIMIT,
                   "the outline has more than %zu points; split it into several objects",
                   POINT_LIMIT);
  return CS_ARRAY_RESERVE(context, outline->points, outline->point_count + more);
}

static void append_point(cs_outline *outline, cs_hpoint point) {
  outline->is_plain =
      outline->is_plain && point.w == 1 && cs_number_is_sane(point.x) && cs_number_is_sane(point.y);
  outline->points[outline->point_count++] = point;
}

/* Removes a contour without pieces. Returns whether there was one. */
static bool drop_empty(cs_outline *outline) {
  size_t count = outline->contour_count;
  if (count == 0 || outline->contours[count - 1] != outline->piece_count)
    return false;
  outline->contour_count--;
  outline->point_count--;
  return true;
}

celspan_status cs_outline_move(celspan_context *context, cs_outline *outline, cs_hpoint to) {
  CS_TRY(cs_outline_close(context, outline));
  return cs_outline_begin(context, outline, to);
}

celspan_status cs_outline_begin(celspan_context *context, cs_outline *outline, cs_hpoint to) {
  drop_empty(outline);
  CS_TRY(reserve_points(context, outline, 1));
  CS_TRY(CS_ARRAY_APPEND(context, outline->contours, outline->contour_count,
                         (uint32_t)outline->piece_count));
  append_point(outline, to);
  return CELSPAN_OK;
}

celspan_status cs_outline_piece(celspan_context *context, cs_outline *outline, int degree,
                                const cs_hpoint *points) {
  CS_TRY(reserve_points(context, outline, (size_t)degree));
  CS_TRY(CS_ARRAY_RESERVE(context, outline->starts, outline->piece_count + 1));
  CS_TRY(CS_ARRAY_RESERVE(context, outline->degrees, outline->piece_count + 1));
  outline->starts[outline->piece_count] = (uint32_t)(outline->point_count - 1);
  outline->degrees[outline->piece_count++] = (uint8_t)degree;
  outline->is_plain = outline->is_plain && degree <= CS_OUTLINE_PLAIN_DEGREE;
  for (int i = 0; i < degree; i++)
    append_point(outline, points[i]);
  return CELSPAN_OK;
}

celspan_status cs_outline_line(celspan_context *context, cs_outline *outline, cs_hpoint to) {
  return cs_outline_piece(context, outline, 1, &to);
}

celspan_status cs_outline_close(celspan_context *context, cs_outline *outline) {
  if (outline->contour_count == 0 || drop_empty(outline))
    return CELSPAN_OK;
  size_t first_piece = outline->contours[outline->contour_count - 1];
  cs_hpoint first = outline->points[outline->starts[first_piece]];
  cs_hpoint *last = &outline->points[outline->point_count - 1];
  if (last->x != first.x || last->y != first.y || last->w != first.w)
    return cs_outline_line(context, outline, first);
  *last = first; /* minus zero is equal to zero, but has different bits */
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- packed */

static size_t packed_size(const cs_outline *outline) {
  return sizeof *outline + outline->point_count * sizeof *outline->points +
         outline->piece_count * sizeof *outline->starts +
         outline->contour_count * sizeof *outline->contours +
         outline->piece_count * sizeof *outline->degrees;
}

/* The wider items come first, so that each is aligned. */
celspan_status cs_outline_pack(celspan_context *context, const cs_outline *outline,
                               cs_outline **out) {
  cs_outline *packed;
  CS_TRY(cs_mem_make(context, (void **)&packed, 1, packed_size(outline)));
  *packed = (cs_outline){.points = (cs_hpoint *)(packed + 1),
                         .point_count = outline->point_count,
                         .piece_count = outline->piece_count,
                         .contour_count = outline->contour_count,
                         .is_plain = outline->is_plain};
  packed->starts = (uint32_t *)(packed->points + packed->point_count);
  packed->contours = packed->starts + packed->piece_count;
  packed->degrees = (uint8_t *)(packed->contours + packed->contour_count);
  for (size_t i = 0; i < packed->point_count; i++)
    packed->points[i] = outline->points[i];
  for (size_t i = 0; i < packed->contour_count; i++)
    packed->contours[i] = outline->contours[i];
  for (size_t i = 0; i < packed->piece_count; i++) {
    packed->starts[i] = outline->starts[i];
    packed->degrees[i] = outline->degrees[i];
  }
  *out = packed;
  return CELSPAN_OK;
}

void cs_outline_free_packed(cs_outline *packed, cs_memory *memory) {
  if (packed)
    cs_mem_free(memory, packed, packed_size(packed));
}

/* ---------------------------------------------------------------- primitives */

static cs_hpoint at(double x, double y) { return (cs_hpoint){x, y, 1}; }

/* A quarter of an ellipse. corner: the point at which the tangents of its ends meet. */
static celspan_status quarter(celspan_context *context, cs_outline *outline, double corner_x,
                              double corner_y, double x, double y) {
  double weight = sqrt(0.5);
  const cs_hpoint points[2] = {{corner_x * weight, corner_y * weight, weight}, {x, y, 1}};
  return cs_outline_piece(context, outline, 2, points);
}

celspan_status cs_outline_rounded(celspan_context *context, cs_outline *outline,
                                  const celspan_box *box, double radius_x, double radius_y) {
  double x = box->x, y = box->y, right = x + box->width, bottom = y + box->height;
  CS_TRY(cs_outline_move(context, outline, at(x + radius_x, y)));
  CS_TRY(cs_outline_line(context, outline, at(right - radius_x, y)));
  CS_TRY(quarter(context, outline, right, y, right, y + radius_y));
  CS_TRY(cs_outline_line(context, outline, at(right, bottom - radius_y)));
  CS_TRY(quarter(context, outline, right, bottom, right - radius_x, bottom));
  CS_TRY(cs_outline_line(context, outline, at(x + radius_x, bottom)));
  CS_TRY(quarter(context, outline, x, bottom, x, bottom - radius_y));
  CS_TRY(cs_outline_line(context, outline, at(x, y + radius_y)));
  CS_TRY(quarter(context, outline, x, y, x + radius_x, y));
  return cs_outline_close(context, outline);
}

celspan_status cs_outline_cornered(celspan_context *context, cs_outline *outline,
                                   const celspan_box *box, const double radii[4]) {
  static const int ways[4][2] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}}; /* away from each corner */
  double x = box->x, y = box->y, right = x + box->width, bottom = y + box->height;
  const celspan_point corners[4] = {{right, y}, {right, bottom}, {x, bottom}, {x, y}};
  CS_TRY(cs_outline_move(context, outline, at(x + radii[0], y)));
  for (int i = 0; i < 4; i++) {
    double radius = radii[(i + 1) % 4];
    const int *way = ways[i], *before = ways[(i + 3) % 4];
    celspan_point corner = corners[i];
    CS_TRY(cs_outline_line(context, outline,
                           at(corner.x - radius * before[0], corner.y - radius * before[1])));
    if (radius > 0)
      CS_TRY(quarter(context, outline, corner.x, corner.y, corner.x + radius * way[0],
                     corner.y + radius * way[1]));
  }
  return cs_outline_close(context, outline);
}

celspan_status cs_outline_rect(celspan_context *context, cs_outline *outline, double x, double y,
                               double width, double height, double radius) {
  radius = fmin(radius, 0.5 * fmin(width, height));
  if (radius > 0)
    return cs_outline_rounded(context, outline, &(celspan_box){x, y, width, height}, radius,
                              radius);
  const celspan_point corners[4] = {
      {x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  return cs_outline_polygon(context, outline, corners, 4);
}

const cs_outline *cs_outline_of_box(const celspan_box *box, cs_outline_box *room) {
  double x = box->x, y = box->y, right = x + box->width, bottom = y + box->height;
  *room = (cs_outline_box){
      .points = {at(x, y), at(right, y), at(right, bottom), at(x, bottom), at(x, y)},
      .starts = {0, 1, 2, 3},
      .degrees = {1, 1, 1, 1}};
  bool is_plain = true;
  for (int i = 0; i < 4; i++)
    is_plain =
        is_plain && cs_number_is_sane(room->points[i].x) && cs_number_is_sane(room->points[i].y);
  room->outline = (cs_outline){.points = room->points,
                               .starts = room->starts,
                               .degrees = room->degrees,
                               .contours = &room->contour,
                               .point_count = 5,
                               .piece_count = 4,
                               .contour_count = 1,
                               .is_plain = is_plain};
  return &room->outline;
}

celspan_status cs_outline_ellipse(celspan_context *context, cs_outline *outline,
                                  celspan_point centre, double radius_x, double radius_y) {
  double left = centre.x - radius_x, right = centre.x + radius_x;
  double top = centre.y - radius_y, bottom = centre.y + radius_y;
  CS_TRY(cs_outline_move(context, outline, at(right, centre.y)));
  CS_TRY(quarter(context, outline, right, bottom, centre.x, bottom));
  CS_TRY(quarter(context, outline, left, bottom, left, centre.y));
  CS_TRY(quarter(context, outline, left, top, centre.x, top));
  CS_TRY(quarter(context, outline, right, top, right, centre.y));
  return cs_outline_close(context, outline);
}

celspan_status cs_outline_polygon(celspan_context *context, cs_outline *outline,
                                  const celspan_point *points, size_t count) {
  for (size_t i = 0; i < count; i++) {
    cs_hpoint point = at(points[i].x, points[i].y);
    CS_TRY(i == 0 ? cs_outline_move(context, outline, point)
                  : cs_outline_line(context, outline, point));
  }
  return cs_outline_close(context, outline);
}

void cs_outline_hash(cs_hash *hash, const cs_outline *outline) {
  cs_hash_word(hash, outline->contour_count);
  for (size_t i = 0; i < outline->contour_count; i++)
    cs_hash_word(hash, outline->contours[i]);
  cs_hash_word(hash, outline->piece_count);
  for (size_t i = 0; i < outline->piece_count; i++)
    cs_hash_word(hash, outline->degrees[i]);
  cs_hash_word(hash, outline->point_count);
  for (size_t i = 0; i < outline->point_count; i++) {
    cs_hash_number(hash, outline->points[i].x);
    cs_hash_number(hash, outline->points[i].y);
    cs_hash_number(hash, outline->points[i].w);
  }
}
