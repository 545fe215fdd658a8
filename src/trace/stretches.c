#include "trace/stretches.h"

#include <math.h>

/* What a line costs, an arc, and a point that is left out. */
#define LINE 5.0
#define ARC 8.0
#define LEFT_OUT 2.2
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
  double scale; /* from the sum of squares to what it costs */
  way *ways;    /* count + 1 */
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

static cs_stretch stretch_of(const finder *f, ptrdiff_t end) {
  const way *last = &f->ways[end];
  cs_stretch out = {.from = f->from + end - last->count, .to = f->from + end};
  cs_arc_sums sums = cs_arc_begin(cs_points_at(f->points, out.from));
  for (ptrdiff_t i = out.from; i < out.to; i++)
    cs_arc_add(&sums, cs_points_at(f->points, i));
  out.arc = cs_arc_of(&sums, last->is_line);
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

celspan_status cs_stretches_find(celspan_context *context, const cs_points *points, ptrdiff_t from,
                                 ptrdiff_t to, double noise, cs_stretches *out) {
  size_t size = (size_t)(to - from) + 1;
  finder f = {points, from, to - from, 0.5 / (noise * noise),
              cs_mem_array(context->memory, size, sizeof *f.ways)};
  if (!f.ways)
    return cs_fail_memory(context);
  f.ways[0] = (way){.cost = 0};
  for (ptrdiff_t end = 1; end <= f.count; end++)
    find_way(&f, end);
  celspan_status status = list(context, &f, out);
  cs_mem_free(context->memory, f.ways, size * sizeof *f.ways);
  return status;
}

void cs_stretches_finish(celspan_context *context, cs_stretches *stretches) {
  cs_mem_free(context->memory, stretches->items, stretches->capacity * sizeof *stretches->items);
  *stretches = (cs_stretches){.items = NULL};
}
