#include "trace/preimage.h"

#include <math.h>

#include "base/number.h"

/* Pixels that a line may be beside an end of its row. */
#define FAR 2.0

/* Each half-plane that cuts a convex polygon adds one corner at most; what rounding would add to that
 * is nothing to see. */
enum { CORNERS_MOST = 4 + 2 * CS_GATES_MOST };

typedef struct polygon {
  celspan_point corners[CORNERS_MOST];
  int count;
} polygon;

static void add_corner(polygon *p, double x, double y) {
  if (p->count < CORNERS_MOST)
    p->corners[p->count++] = (celspan_point){x, y};
}

/* Points with x * across.x + y * across.y <= bound. */
typedef struct half_plane {
  celspan_point across;
  double bound;
} half_plane;

static double beyond(const half_plane *half, celspan_point p) {
  return half->across.x * p.x + half->across.y * p.y - half->bound;
}

static void cut(polygon *p, half_plane half) {
  polygon left = {.count = 0};
  for (int i = 0; i < p->count; i++) {
    celspan_point a = p->corners[i], b = p->corners[(i + 1) % p->count];
    double off_a = beyond(&half, a), off_b = beyond(&half, b);
    if (off_a <= 0)
      add_corner(&left, a.x, a.y);
    if (off_a * off_b < 0) {
      double share = off_a / (off_a - off_b);
      add_corner(&left, a.x + share * (b.x - a.x), a.y + share * (b.y - a.y));
    }
  }
  *p = left;
}

/* From the first gate to the last one. */
typedef struct axis {
  celspan_point from, along; /* along: of length 1 */
  double length;
} axis;

static axis axis_of(const cs_gate_row *row) {
  celspan_point from = cs_gate_middle(&row->list[0]);
  celspan_point to = cs_gate_middle(&row->list[row->count - 1]);
  double dx = to.x - from.x, dy = to.y - from.y, length = cs_number_length(dx, dy);
  return (axis){from, {dx / length, dy / length}, length};
}

/* The lines that have a point on their left (side 1) or on their right (-1): those that are beside it,
 * towards the left, by less than it is, or by more. */
static half_plane lines_beside(const axis *a, celspan_point point, double side) {
  double x = point.x - a->from.x, y = point.y - a->from.y;
  double way = (x * a->along.x + y * a->along.y) / a->length;
  double aside = x * a->along.y - y * a->along.x;
  return (half_plane){{side * (1 - way), side * way}, side * aside};
}

static celspan_point middle_of(const polygon *p) {
  celspan_point least = p->corners[0], most = least;
  for (int i = 1; i < p->count; i++) {
    celspan_point corner = p->corners[i];
    least = (celspan_point){fmin(least.x, corner.x), fmin(least.y, corner.y)};
    most = (celspan_point){fmax(most.x, corner.x), fmax(most.y, corner.y)};
  }
  return (celspan_point){0.5 * (least.x + most.x), 0.5 * (least.y + most.y)};
}

bool cs_preimage_middle(const cs_gate_row *row, cs_arc *line) {
  axis a = axis_of(row);
  polygon p = {{{-FAR, -FAR}, {FAR, -FAR}, {FAR, FAR}, {-FAR, FAR}}, 4};
  if (!(a.length > 0))
    return false;
  for (size_t i = 0; i < row->count && p.count > 0; i++) {
    cut(&p, lines_beside(&a, row->list[i].left, 1));
    cut(&p, lines_beside(&a, row->list[i].right, -1));
  }
  if (p.count == 0)
    return false;
  celspan_point beside = middle_of(&p);
  double slope = (beside.y - beside.x) / a.length, scale = 1 / sqrt(1 + slope * slope);
  *line = (cs_arc){
      .origin = {a.from.x + beside.x * a.along.y, a.from.y - beside.x * a.along.x},
      .across = {scale * (a.along.y - slope * a.along.x), scale * (-a.along.x - slope * a.along.y)},
  };
  return true;
}
