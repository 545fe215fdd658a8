#include "tools/trace/stretches.h"

#include <math.h>

#include "inside/number.h"
#include "tools/trace/street.h"

/* ---------------------------------------------------------------- preimage */

/* All lines that pass through a row of gates, and the one in their middle.
 *
 *    u0                        u1        a line is where it is beside both ends of the row, u0 and
 *  L ----___ L   L   L   L     |         u1; each middle of a pixel keeps (u0, u1) on one side of a
 *  |R   R  -----___ R   R    R |         line of its own, and all of them in a convex polygon: the
 *          R   R  ------____---          preimage of the row, as digital straight lines are called
 *
 * The one in the middle is halfway between the least and the greatest u0, and between those of u1:
 * so that at neither end it is farther from any line than need be.
 */

/* Pixels: the distance of a line from an end of its row. */
#define FAR 2.0

/* Each half-plane that cuts a convex polygon adds at most one corner; further corners by rounding
 * would be too small to see. */
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

/* The direction from the first gate to the last one. */
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

/* The lines that have a point on their left (side 1) or on their right (-1): those that are beside
 * it, towards the left, by less than it is, or by more. */
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

/* The distance from the line grows towards the left. False: no line passes. */
static bool cs_preimage_middle(const cs_gate_row *row, cs_arc *line) {
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

/* ---------------------------------------------------------------- stretches */

/* The costs of a line, of an arc, of a point that is left out, and of such a point if it has a
 * gate. */
#define LINE 5.0
#define ARC 8.0
#define LEFT_OUT 2.2
#define GATE_LEFT_OUT 6.0
/* By how much each pixel of its street's width reduces the cost of a stretch. */
#define WIDE 1.5
/* If the cost of an arc exceeds the best one by this much for each of its points, the arc is not
 * chosen. */
#define HOPELESS 24.0

/* The cheapest way through the first points, for a number of them: its cost and its last piece. */
typedef struct way {
  double cost;
  ptrdiff_t count; /* the number of points of its last stretch; 0: the last point is left out */
  bool is_line;
} way;

typedef struct finder {
  const cs_points *points;
  ptrdiff_t from, count;
  bool is_exact; /* through gates */
  double scale;  /* otherwise: the factor from the sum of squares to the cost */
  /* the greatest width of streets of arcs, and of lines, from each point on; with each gate they
   * become narrower */
  CS_ARRAY(double[2], widths);
  CS_ARRAY(way, ways); /* count + 1 */
} finder;

static void try(const finder *f, ptrdiff_t end, ptrdiff_t count, double own, bool is_line) {
  double cost = f->ways[end - count].cost + own;
  if (cost < f->ways[end].cost)
    f->ways[end] = (way){cost, count, is_line};
}

static void find_way(const finder *f, ptrdiff_t end) {
  f->ways[end] = (way){f->ways[end - 1].cost + LEFT_OUT, 0, false};
  cs_arc_sums sums = cs_arc_begin(cs_points_at(f->points, f->from + end - 1));
  for (ptrdiff_t count = 1; count <= end && count <= CS_STRETCH_MOST; count++) {
    cs_arc_add(&sums, cs_points_at(f->points, f->from + end - count));
    if (count < CS_STRETCH_FEWEST)
      continue;
    double off = (double)count * f->scale * cs_arc_line_error(&sums);
    try(f, end, count, LINE + off, true);
    if (off <= ARC - LINE || count == CS_STRETCH_FEWEST)
      continue;
    off = (double)count * f->scale * cs_arc_error(&sums);
    try(f, end, count, ARC + off, false);
    if (off > HOPELESS + (double)count)
      return;
  }
}

/* ---------------------------------------------------------------- through gates */

void cs_stretches_row(const cs_points *points, ptrdiff_t from, ptrdiff_t to, cs_gate_row *row) {
  ptrdiff_t count = (ptrdiff_t)points->count;
  row->count = 0;
  for (ptrdiff_t i = from; i < to && row->count < CS_GATES_MOST; i++)
    row->list[row->count++] = cs_edge_gate(&points->items[((i % count) + count) % count]);
}

static void row_between(const finder *f, ptrdiff_t start, ptrdiff_t end, cs_gate_row *row) {
  cs_stretches_row(f->points, f->from + start, f->from + end, row);
}

/* The longest stretch that ends at a point. */
typedef struct longest {
  bool is_line, is_known; /* known: whether a line or arc passes its gates is known */
  ptrdiff_t start;
  cs_street street;
} longest;

/* Moves to the next end. The new stretch does not begin before the one for the previous end; it
 * begins at the same point if that one passes one more gate. */
static void go_on(const finder *f, ptrdiff_t end, longest *l) {
  cs_gate_row row;
  bool is_full = end - l->start > CS_STRETCH_MOST;
  row_between(f, end - 1, end, &row);
  if (l->is_known && cs_street_passes(&l->street, &row.list[0])) {
    l->start += is_full;
    return;
  }
  l->is_known = false;
  for (l->start += is_full; end - l->start >= CS_STRETCH_FEWEST && !l->is_known; l->start++) {
    row_between(f, l->start, end, &row);
    l->is_known = cs_street_find_any(&row, l->is_line, &l->street);
  }
  l->start -= l->is_known;
}

/* A stretch with a wider street costs less. */
static void try_street(const finder *f, ptrdiff_t start, ptrdiff_t end, bool is_line) {
  double cost = is_line ? LINE : ARC, *width = &f->widths[start][is_line];
  cs_gate_row row;
  cs_street street;
  if (f->ways[start].cost + cost - WIDE * *width >= f->ways[end].cost)
    return;
  row_between(f, start, end, &row);
  if (!cs_street_find(&row, is_line, &street))
    return;
  *width = street.width;
  try(f, end, end - start, cost - WIDE * street.width, is_line);
}

/* If a line passes, no arc is needed. */
static void find_ways_through(const finder *f) {
  longest line = {.is_line = true}, arc = {.is_line = false};
  for (ptrdiff_t end = 1; end <= f->count; end++) {
    f->ways[end] = (way){f->ways[end - 1].cost + GATE_LEFT_OUT, 0, false};
    f->widths[end - 1][0] = f->widths[end - 1][1] = 1;
    go_on(f, end, &line);
    go_on(f, end, &arc);
    for (ptrdiff_t start = arc.start; start + CS_STRETCH_FEWEST <= end; start++)
      try_street(f, start, end, start >= line.start);
  }
}

/* ---------------------------------------------------------------- the cheapest way */

/* The arc or line that is nearest to the points. */
static cs_arc arc_of(const finder *f, const cs_stretch *stretch, bool is_line) {
  cs_arc_sums sums = cs_arc_begin(cs_points_at(f->points, stretch->from));
  for (ptrdiff_t i = stretch->from; i < stretch->to; i++)
    cs_arc_add(&sums, cs_points_at(f->points, i));
  return cs_arc_of(&sums, is_line);
}

/* The line or arc that passes through the gates; false: there is none. */
static bool pass_gates(const finder *f, const cs_stretch *stretch, bool is_line, cs_arc *out) {
  cs_gate_row row;
  cs_street street;
  cs_stretches_row(f->points, stretch->from, stretch->to, &row);
  if (!cs_street_find(&row, is_line, &street))
    return false;
  if (!is_line || !cs_preimage_middle(&row, out))
    *out = street.middle;
  return true;
}

static cs_stretch stretch_of(const finder *f, ptrdiff_t end) {
  const way *last = &f->ways[end];
  cs_stretch out = {.from = f->from + end - last->count, .to = f->from + end};
  if (!f->is_exact || !pass_gates(f, &out, last->is_line, &out.arc))
    out.arc = arc_of(f, &out, last->is_line);
  return out;
}

static celspan_status add(celspan_context *context, cs_stretches *out, const cs_stretch *stretch) {
  return CS_APPEND(context, out->items, out->count, out->capacity, *stretch);
}

/* Follows the ways back from the last point, and reverses the result. */
static celspan_status list(celspan_context *context, const finder *f, cs_stretches *out) {
  out->count = 0;
  for (ptrdiff_t end = f->count; end > 0;) {
    ptrdiff_t count = f->ways[end].count;
    if (count > 0) {
      cs_stretch stretch = stretch_of(f, end);
      CS_TRY(add(context, out, &stretch));
    }
    end -= count > 0 ? count : 1;
  }
  for (size_t i = 0, k = out->count; i + 1 < k; i++) {
    cs_stretch kept = out->items[i];
    out->items[i] = out->items[--k];
    out->items[k] = kept;
  }
  return CELSPAN_OK;
}

static void find_ways(const finder *f) {
  for (ptrdiff_t end = 1; end <= f->count; end++)
    find_way(f, end);
}

static celspan_status run(celspan_context *context, finder *f, cs_stretches *out) {
  size_t size = (size_t)f->count + 1;
  CS_TRY(CS_ARRAY_MAKE(context, f->ways, size));
  CS_TRY(CS_ARRAY_MAKE(context, f->widths, f->is_exact ? size : 0));
  f->ways[0] = (way){.cost = 0};
  if (f->is_exact)
    find_ways_through(f);
  else
    find_ways(f);
  return list(context, f, out);
}

celspan_status cs_stretches_find(celspan_context *context, const cs_points *points, ptrdiff_t from,
                                 ptrdiff_t to, double noise, cs_stretches *out) {
  finder f = {.points = points, .from = from, .count = to - from, .scale = 0.5 / (noise * noise)};
  celspan_status status = run(context, &f, out);
  CS_ARRAYS_FREE(context->memory, &f, widths, ways);
  return status;
}

celspan_status cs_stretches_thread(celspan_context *context, const cs_points *points,
                                   ptrdiff_t from, ptrdiff_t to, cs_stretches *out) {
  finder f = {.points = points, .from = from, .count = to - from, .is_exact = true};
  celspan_status status = run(context, &f, out);
  CS_ARRAYS_FREE(context->memory, &f, widths, ways);
  return status;
}

void cs_stretches_finish(celspan_context *context, cs_stretches *stretches) {
  cs_mem_free(context->memory, stretches->items, stretches->capacity * sizeof *stretches->items);
  *stretches = (cs_stretches){.items = NULL};
}
