#include "model/scene/shift.h"

#include <math.h>

#include "base/elementary.h"
#include "base/number.h"
#include "model/scene/value.h"

/* ---------------------------------------------------------------- values */

cs_hash cs_shift_hash(const cs_shift *shift) {
  cs_hash hash = cs_hash_begin(CS_VALUE_SHIFT);
  cs_hash_word(&hash, shift->kind);
  cs_value_hash_point(&hash, shift->at);
  cs_hash_number(&hash, shift->extent);
  cs_hash_word(&hash, shift->is_cut);
  if (shift->by) {
    cs_hash_hash(&hash, shift->by->hash);
    cs_hash_word(&hash, shift->channels[0]);
    cs_hash_word(&hash, shift->channels[1]);
    cs_hash_number(&hash, shift->scale);
    cs_hash_word(&hash, shift->space);
    cs_hash_word(&hash, shift->moves_clear);
  }
  return cs_hash_end(hash);
}

static void destroy(cs_shift *shift) {
  cs_memory *memory = shift->memory;
  celspan_cel_unref(shift->by);
  cs_counted_free(memory, shift, sizeof *shift);
}

CS_COUNTED(cs_shift)

/* ---------------------------------------------------------------- boxes */

static celspan_box grown(const celspan_box *box, double x, double y) {
  return (celspan_box){box->x - x, box->y - y, box->width + 2 * x, box->height + 2 * y};
}

/* The box of the sides [low, high]. */
static celspan_box between(celspan_point low, celspan_point high) {
  return (celspan_box){low.x, low.y, high.x - low.x, high.y - low.y};
}

/* A side of a box that is scaled about c by either of two factors. */
static void scale_side(double low, double high, double c, const double by[2], double *from,
                       double *to) {
  *from = c + fmin((low - c) * by[0], (low - c) * by[1]);
  *to = c + fmax((high - c) * by[0], (high - c) * by[1]);
}

/* The box around a box that is scaled about a point by either of two factors. */
static celspan_box scaled(const celspan_box *box, celspan_point centre, double low, double high) {
  const double by[2] = {low, high};
  celspan_point from, to;
  scale_side(box->x, box->x + box->width, centre.x, by, &from.x, &to.x);
  scale_side(box->y, box->y + box->height, centre.y, by, &from.y, &to.y);
  return between(from, to);
}

/* How far an arc about the origin, by `extent` to either side of a point, goes in a direction. */
static double arc_extent(celspan_point p, celspan_point direction, double extent) {
  double sine, cosine, length = cs_number_length(p.x, p.y);
  double along = p.x * direction.x + p.y * direction.y;
  double across = fabs(p.x * direction.y - p.y * direction.x);
  cs_elementary_sincos(extent, &sine, &cosine);
  return along >= length * cosine ? length : along * cosine + across * sine;
}

/* The box around a box that is turned about a point: its corners reach farthest. */
static celspan_box turned(const celspan_box *box, celspan_point centre, double extent) {
  double far[4] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
  static const celspan_point directions[4] = {{-1, 0}, {0, -1}, {1, 0}, {0, 1}};
  for (int corner = 0; corner < 4; corner++) {
    const celspan_point p = {box->x + (corner & 1 ? box->width : 0) - centre.x,
                             box->y + (corner & 2 ? box->height : 0) - centre.y};
    for (int k = 0; k < 4; k++)
      far[k] = fmax(far[k], arc_extent(p, directions[k], extent));
  }
  return between((celspan_point){centre.x - far[0], centre.y - far[1]},
                 (celspan_point){centre.x + far[2], centre.y + far[3]});
}

/* Along lines and arcs, points are read from where they are seen, and seen from where they are
 * read; a zoom is not so even. */
static celspan_box reached(const cs_shift *shift, const celspan_box *box, bool is_shown) {
  const double half = fabs(shift->scale) / 2, e = shift->extent;
  switch (shift->kind) {
  case CS_SHIFT_DISPLACED:
    return grown(box, half, half);
  case CS_SHIFT_LINE:
    return grown(box, fabs(shift->at.x), fabs(shift->at.y));
  case CS_SHIFT_ZOOM:
    return is_shown ? scaled(box, shift->at, 1 - e, 1 + e)
                    : scaled(box, shift->at, 1 / (1 + e), 1 / (1 - e));
  case CS_SHIFT_SPIN:
    break;
  }
  return turned(box, shift->at, e);
}

celspan_box cs_shift_reads(const cs_shift *shift, const celspan_box *shown) {
  return reached(shift, shown, true);
}

celspan_box cs_shift_shows(const cs_shift *shift, const celspan_box *read) {
  return reached(shift, read, false);
}
