#include "trace/stretches.h"

#include <math.h>

#include "trace/preimage.h"

/* What a line costs, an arc, a point that is left out, and one that is although it has a gate. */
#define LINE 5.0
#define ARC 8.0
#define LEFT_OUT 2.2
#define GATE_LEFT_OUT 6.0
/* How much less a stretch costs by each pixel of the width of its street. */
#define WIDE 1.5
/* With so much more than one for each of its points, an arc is longer than one that is taken. */
#define HOPELESS 24.0

/* The cheapest way to the first so many points: what it costs and what it ends with. */
typedef struct way {
  double cost;
  ptrdiff_t count; /* points of its last stretch; 0: the last point is left out */
  bool is_line;
} way;

typedef struct finder {
  const cs_points *points;
  ptrdiff_t from, count;
  bool is_exact;       /* through gates */
  double scale;        /* otherwise: from the sum of squares to what it costs */
  double (*widths)[2]; /* how wide streets of arcs and of lines from each point on are at most, for
                        * with each gate they narrow */
  way *ways;           /* count + 1 */
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
  bool is_line, is_known; /* known: what passes its gates */
  ptrdiff_t start;
  cs_street street;
} longest;

/* To the next end. It does not begin before the one that ended a point before, and begins with it where
 * that passes one more gate. */
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

/* A stretch costs less by how wide its street is. */
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

/* Where a line passes no arc is needed. */
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

/* The one that passes through the gates; false: none does. */
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
  CS_TRY(cs_mem_reserve(context, (void **)&out->items, &out->capacity, out->count + 1,
                        sizeof *out->items));
  out->items[out->count++] = *stretch;
  return CELSPAN_OK;
}

/* Goes the ways back from the last point, and turns round what it finds. */
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
  size_t size = (size_t)f.count + 1;
  f.ways = cs_mem_array(context->memory, size, sizeof *f.ways);
  celspan_status status = f.ways ? run(context, &f, out) : cs_fail_memory(context);
  cs_mem_free(context->memory, f.ways, size * sizeof *f.ways);
  return status;
}

celspan_status cs_stretches_thread(celspan_context *context, const cs_points *points,
                                   ptrdiff_t from, ptrdiff_t to, cs_stretches *out) {
  finder f = {.points = points, .from = from, .count = to - from, .is_exact = true};
  size_t size = (size_t)f.count + 1;
  f.ways = cs_mem_array(context->memory, size, sizeof *f.ways);
  f.widths = cs_mem_array(context->memory, size, sizeof *f.widths);
  celspan_status status = f.ways && f.widths ? run(context, &f, out) : cs_fail_memory(context);
  cs_mem_free(context->memory, f.ways, size * sizeof *f.ways);
  cs_mem_free(context->memory, f.widths, size * sizeof *f.widths);
  return status;
}

void cs_stretches_finish(celspan_context *context, cs_stretches *stretches) {
  cs_mem_free(context->memory, stretches->items, stretches->capacity * sizeof *stretches->items);
  *stretches = (cs_stretches){.items = NULL};
}
