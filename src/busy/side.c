#include "busy/side.h"

#include "area/edges.h"

#include <string.h>

/* Units that cross by less than this, in pixels, are taken as if they only touched: it is far less
 * than any colour shows, and far more than the errors of rounding. */
#define TOUCHING 0x1p-20

/* ---------------------------------------------------------------- places on units */

/* x at a height of the piece that begins at a point. */
static inline double x_at(const celspan_point *above, double y) {
  const celspan_point *below = above + 1;
  if (y == above->y)
    return above->x;
  if (y == below->y)
    return below->x;
  return above->x + (y - above->y) * ((below->x - above->x) / (below->y - above->y));
}

/* The piece of a unit that goes on below a height. */
static inline const celspan_point *piece_below(const celspan_point *piece, double y) {
  while (piece[1].y <= y)
    piece++;
  return piece;
}

double cs_side_area(int32_t column, const cs_side *side, const cs_slab *in) {
  if (!side->points)
    return in->foot - in->top;
  if (side->y0 == in->top && side->y1 == in->foot)
    return side->area;
  double area = 0;
  const celspan_point *piece = side->points;
  for (double y = in->top, end; y < in->foot; y = end) {
    piece = piece_below(piece, y);
    end = piece[1].y < in->foot ? piece[1].y : in->foot;
    area += cs_edges_cover(x_at(piece, y), x_at(piece, end), end - y, column);
  }
  return area;
}

bool cs_side_is_left(const cs_present *a, const cs_present *b, const cs_slab *in) {
  if (a->right >= in->foot - in->top || b->right <= 0 || a->side->high <= b->side->low)
    return true;
  const celspan_point *pa = a->side->points, *pb = b->side->points;
  for (double y = in->top, end; y < in->foot; y = end) {
    pa = piece_below(pa, y);
    pb = piece_below(pb, y);
    end = pa[1].y < pb[1].y ? pa[1].y : pb[1].y;
    end = end < in->foot ? end : in->foot;
    double before = x_at(pa, y) - x_at(pb, y), after = x_at(pa, end) - x_at(pb, end);
    if (before > TOUCHING || after > TOUCHING)
      return false;
  }
  return true;
}

double cs_side_intersection(const cs_present *a, const cs_present *b, const cs_slab *in) {
  const celspan_point *pa = a->side->points, *pb = b->side->points;
  double last = 0; /* how far they were apart when they were last apart */
  for (double y = in->top, end; y < in->foot; y = end) {
    pa = piece_below(pa, y);
    pb = piece_below(pb, y);
    end = pa[1].y < pb[1].y ? pa[1].y : pb[1].y;
    end = end < in->foot ? end : in->foot;
    double before = x_at(pa, y) - x_at(pb, y), after = x_at(pa, end) - x_at(pb, end);
    last = before != 0 ? before : last;
    if (last * after < 0) {
      double at = before == 0 ? y : y + (end - y) * (before / (before - after));
      at = cs_edges_round(at);
      return at > in->top ? at : in->foot;
    }
  }
  return in->foot;
}

bool cs_side_is_before(const cs_present *a, const cs_present *b) {
  if (a->right != b->right || !a->side->points || !b->side->points)
    return a->right > b->right;
  uint32_t count = a->side->count < b->side->count ? a->side->count : b->side->count;
  int order = memcmp(a->side->points, b->side->points, count * sizeof *a->side->points);
  return order != 0 ? order < 0 : a->side->count < b->side->count;
}

/* ---------------------------------------------------------------- tangles */

/* Straight lines between two heights. */
typedef struct lines {
  double x0[CS_SIDE_TANGLE], x1[CS_SIDE_TANGLE];
  int count;
} lines;

static inline double x_between(const lines *l, int i, double part) {
  return part >= 1 ? l->x1[i] : l->x0[i] + part * (l->x1[i] - l->x0[i]);
}

/* The share of the height, after `part`, at which another line overtakes the rightmost one; 1 when
 * none does. *by: which. */
static double find_overtaking(const lines *l, int rightmost, double part, int *by) {
  double earliest = 1;
  for (int i = 0; i < l->count; i++) {
    double before = l->x0[rightmost] - l->x0[i], after = l->x1[rightmost] - l->x1[i];
    if (after >= 0 || before <= after)
      continue;
    double share = before / (before - after);
    share = share > part ? share : part;
    if (share < earliest) {
      earliest = share;
      *by = i;
    }
  }
  return earliest;
}

/* The area right of all lines: right of the rightmost one at each height. */
static double area_right_of(const lines *l, double height, int32_t column) {
  int rightmost = 0;
  for (int i = 1; i < l->count; i++)
    if (l->x0[i] > l->x0[rightmost] ||
        (l->x0[i] == l->x0[rightmost] && l->x1[i] > l->x1[rightmost]))
      rightmost = i;
  double area = 0;
  for (double part = 0; part < 1;) {
    int by = rightmost;
    double end = find_overtaking(l, rightmost, part, &by);
    area += cs_edges_cover(x_between(l, rightmost, part), x_between(l, rightmost, end),
                           height * (end - part), column);
    rightmost = by;
    part = end;
  }
  return area;
}

double cs_side_area_right(int32_t column, const cs_present *tangle, unsigned set,
                          const cs_slab *in) {
  const celspan_point *pieces[CS_SIDE_TANGLE];
  int count = 0;
  for (int i = 0; set >> i; i++)
    if (set >> i & 1)
      pieces[count++] = tangle[i].side->points;
  double area = 0;
  for (double y = in->top; y < in->foot;) {
    lines l = {.count = count};
    double end = in->foot;
    for (int i = 0; i < count; i++) {
      pieces[i] = piece_below(pieces[i], y);
      end = pieces[i][1].y < end ? pieces[i][1].y : end;
    }
    for (int i = 0; i < count; i++) {
      l.x0[i] = x_at(pieces[i], y);
      l.x1[i] = x_at(pieces[i], end);
    }
    area += area_right_of(&l, end - y, column);
    y = end;
  }
  return area;
}
