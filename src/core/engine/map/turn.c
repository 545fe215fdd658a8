#include "engine/map/turn.h"

#include <math.h>

#include "model/geometry/matrix.h"

typedef struct turner {
  celspan_context *context;
  celspan_matrix matrix; /* from units of the map to units of the frame's lines */
  bool is_mirrored;
  int32_t end[2]; /* the end of the frame */
  cs_map_lines *out;
} turner;

/* A line of the map: a border or a flat boundary. `left` is on the left of somebody who looks back
 * from its last point to the first. */
typedef struct course {
  uint32_t left, right;
  const cs_map_point *points;
  uint32_t count;
} course;

static cs_map_point place(const turner *t, cs_map_point point) {
  cs_hpoint at = cs_matrix_apply(&t->matrix, (cs_hpoint){point.x, point.y, 1});
  return (cs_map_point){(int32_t)floor(at.x / at.w + 0.5), (int32_t)floor(at.y / at.w + 0.5)};
}

/* ---------------------------------------------------------------- parts */

static celspan_status add_point(turner *t, cs_map_point point) {
  cs_map_lines *out = t->out;
  return CS_ARRAY_APPEND(t->context, out->points, out->point_count, point);
}

/* Ends a part that goes up or down, with the points from `first` on; a part beyond the frame is
 * dropped. */
static celspan_status end_part(turner *t, const course *c, bool goes_up, size_t first) {
  cs_map_lines *out = t->out;
  cs_map_point *points = out->points + first;
  size_t count = out->point_count - first;
  for (size_t k = 0; goes_up && k < count / 2; k++) {
    cs_map_point point = points[k];
    points[k] = points[count - 1 - k];
    points[count - 1 - k] = point;
  }
  bool is_same = goes_up == t->is_mirrored;
  const cs_map_border part =
      cs_map_lines_border(out, first, is_same ? c->left : c->right, is_same ? c->right : c->left);
  if (part.foot <= 0 || points[0].y >= t->end[1] || part.low >= t->end[0]) {
    out->point_count = first;
    return CELSPAN_OK;
  }
  return CS_ARRAY_APPEND(t->context, out->borders, out->border_count, part);
}

static celspan_status add_course(turner *t, const course *c) {
  size_t first = 0;  /* point of the part */
  int direction = 0; /* the direction of the part; 0: none has begun */
  cs_map_point last = place(t, c->points[0]);
  for (uint32_t k = 1; k < c->count; k++) {
    cs_map_point next = place(t, c->points[k]);
    int way = (next.y > last.y) - (next.y < last.y);
    if (way != 0 && way != direction) {
      if (direction != 0)
        CS_TRY(end_part(t, c, direction < 0, first));
      first = t->out->point_count;
      CS_TRY(add_point(t, last));
      direction = way;
    }
    if (direction != 0)
      CS_TRY(add_point(t, next));
    last = next;
  }
  return direction != 0 ? end_part(t, c, direction < 0, first) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- all lines */

static celspan_status add_all(turner *t, const cs_map *map) {
  const cs_map_lines *lines = &map->lines;
  for (size_t i = 0; i < lines->border_count; i++) {
    const cs_map_border *f = &lines->borders[i];
    CS_TRY(add_course(t, &(course){f->left, f->right, lines->points + f->first, f->count}));
  }
  for (size_t i = 0; i < map->flat_count; i++) {
    const cs_map_flat *f = &map->flats[i];
    const cs_map_point points[] = {{f->from, f->y}, {f->to, f->y}};
    CS_TRY(add_course(t, &(course){f->below, f->above, points, 2}));
  }
  return cs_map_lines_sort(t->context, t->out);
}

static bool has_place(const celspan_matrix *matrix, double x, double y) {
  cs_hpoint at = cs_matrix_apply(matrix, (cs_hpoint){x, y, 1});
  return at.w > 0 && fabs(at.x) <= CS_MAP_FARTHEST * at.w && fabs(at.y) <= CS_MAP_FARTHEST * at.w;
}

/* Whether every point has a place: it is enough that the corners of the box around the points have
 * places. */
static bool have_places(const cs_map_lines *lines, const celspan_matrix *matrix) {
  int32_t left = INT32_MAX, right = INT32_MIN, top = INT32_MAX, bottom = INT32_MIN;
  const double unit = 1.0 / CS_MAP_UNIT;
  if (lines->border_count == 0)
    return true;
  for (size_t i = 0; i < lines->border_count; i++) {
    const cs_map_border *f = &lines->borders[i];
    int32_t first = lines->points[f->first].y;
    left = f->low < left ? f->low : left;
    right = f->high > right ? f->high : right;
    top = first < top ? first : top;
    bottom = f->foot > bottom ? f->foot : bottom;
  }
  return has_place(matrix, unit * left, unit * top) &&
         has_place(matrix, unit * right, unit * top) &&
         has_place(matrix, unit * left, unit * bottom) &&
         has_place(matrix, unit * right, unit * bottom);
}

celspan_status cs_map_turn(celspan_context *context, const cs_map *map,
                           const celspan_matrix *matrix, const int32_t size[2], bool *fits,
                           cs_map_lines *out) {
  turner t = {.context = context,
              .matrix = *matrix,
              .is_mirrored = cs_matrix_mirrors(matrix),
              .end = {size[0] * CS_MAP_UNIT, size[1] * CS_MAP_UNIT},
              .out = out};
  t.matrix.m[2] *= CS_MAP_UNIT;
  t.matrix.m[5] *= CS_MAP_UNIT;
  t.matrix.m[6] /= CS_MAP_UNIT;
  t.matrix.m[7] /= CS_MAP_UNIT;
  *fits = have_places(&map->lines, matrix);
  return *fits ? add_all(&t, map) : CELSPAN_OK;
}
