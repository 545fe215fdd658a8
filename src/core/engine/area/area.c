/* Antialias "area": the exact mean over each pixel, by local events, in one walk along the row.
 *
 *              A               B   C          D         active boundaries at the top of the row,
 *      y    +--\----+-------+--\---/+-------+-|-----+   from left to right
 *           |   \   |       |   \ / |       | |     |
 *           |    \  |       |    x  |       | |     |   x: an intersection
 *           |     \ |       |   / \ |       | |     |
 *      y+1  +------\+-------+--/---\+-------+-|-----+
 *                  A           C   B          D         and at its foot
 *
 *            direct            window         direct    pixels that edges cross: by their area
 *                     span            span              the others: cells as they are
 *                             interval                  replayed by a local sweep; it composes
 *                                                       the one cell below x
 *
 *   alone     a visible boundary to which nothing happens in the row gives its borders: one,
 *             or one for each straight piece
 *   interval  neighbours that swap, begin or end inside the row are replayed (intervals.h says
 *             which, local_sweep.h how)
 *
 * A replay costs events times members. So a row in which very much begins and ends is cut into
 * slabs of its height, each walked by itself into one window, which is summed when all are done.
 */
#include "engine/area/area.h"

#include <math.h>

#include "base/self_check.h"
#include "engine/area/intervals.h"
#include "engine/area/window.h"
#include "engine/compose/procedures.h"
#include "engine/sweep/pieces.h"

/* ---------------------------------------------------------------- the row */

void cs_area_init(cs_area *area, const cs_row_tools *tools) {
  *area = (cs_area){.tools = *tools};
  cs_window_init(&area->target.window, tools->painter, tools->arena, tools->width);
  cs_local_sweep_init(&area->sweep, tools->composer, tools->arena, &area->target);
  cs_crowd_init(&area->crowd);
}

void cs_area_finish(cs_area *area, cs_memory *memory) {
  cs_edges_finish(&area->edges, memory);
  cs_window_finish(&area->target.window, memory);
  cs_local_sweep_finish(&area->sweep, memory);
  cs_dense_finish(&area->dense, memory);
  cs_crowd_finish(&area->crowd, memory);
  *area = (cs_area){0};
}

/* The walk along a row, or along a slab of it, from left to right. */
typedef struct row_walk {
  cs_area *area;
  const cs_cell *cells;    /* the array of cs_cells; it does not change until the walk is done */
  cs_intervals *intervals; /* the intervals of the boundaries between the two heights */
  size_t visible;          /* the next visible boundary */
  bool is_slab; /* the walk covers a part of a row; the remaining heights are walked separately */
} row_walk;

/* ---------------------------------------------------------------- alone */

/* The first visible boundary from v on that is not left of boundary `end`. */
static size_t find_visible(const cs_area *area, size_t v, size_t end) {
  const cs_cells *cells = area->tools.cells;
  if (end == area->tools.active->count)
    return cells->visible_count;
  while (v < cells->visible_count && cells->visible[v] < end)
    v++;
  return v;
}

/* Gives the target the borders of visible boundaries, one by one. */
static celspan_status add_boundaries(row_walk *w, const uint32_t *boundaries, size_t count) {
  cs_area *area = w->area;
  for (size_t k = 0; k < count; k++) {
    size_t i = boundaries[k];
    const cs_cell *left = &w->cells[i];
    const cs_bend *bend = area->edges.is_bent[i] ? cs_active_bend(area->tools.active, i) : NULL;
    cs_window_end_item(&area->target.window, left + 1);
    for (cs_pieces p = cs_pieces_of(area->tools.active, i, bend); cs_pieces_next(&p);) {
      const cs_border border = {{p.above.x, p.above.y, p.below.x, p.below.y}, left, left + 1};
      CS_TRY(cs_target_add(&area->target, &border));
    }
  }
  return CELSPAN_OK;
}

/* Draws the visible boundaries up to boundary `end`, which do not cross but may bend in the row.
 * Everything that is drawn later lies at or right of x = next. */
static celspan_status walk_alone(row_walk *w, size_t end, double next) {
  cs_area *area = w->area;
  size_t first = w->visible;
  const uint32_t *boundaries = area->tools.cells->visible + first;
  w->visible = find_visible(area, first, end);
  if (w->is_slab || area->target.retained)
    return add_boundaries(w, boundaries, w->visible - first);
  cs_direct_edges edges = {area->tools.active, &area->edges,
                           w->cells,           boundaries,
                           w->visible - first, cs_edges_floor(next, area->tools.width)};
  return cs_window_edges(&area->target.window, &edges);
}

/* ---------------------------------------------------------------- intervals */

/* Brings the composer to the left of an interval, and the target to its least x. */
static celspan_status begin_item(cs_area *area, const cs_cell *left, size_t low, double least) {
  cs_local_sweep *sweep = &area->sweep;
  cs_cells_walk_to(area->tools.cells, area->tools.composer, low, least);
  sweep->left = left;
  sweep->deferred = area->tools.cells->deferred;
  sweep->deferred.first = sweep->deferred.next;
  return cs_target_begin_item(&area->target, least);
}

/* Whether an interval must be drawn as a crowd. Retained edges must be exact, and slabs of a row
 * are not pixels, so neither may be drawn so. In a crowd, culled boundaries take effect up to a
 * column late, so no tile may be narrower than that. */
static bool is_crowd(const row_walk *w, const cs_interval *interval) {
  const cs_row_tools *tools = &w->area->tools;
  const cs_deferred *end, *deferred = cs_active_deferred(tools->active, &end);
  if (w->is_slab || w->area->target.retained || (tools->width < CS_CULL_COLUMNS && deferred < end))
    return false;
  return cs_crowd_suits(w->intervals, interval, tools->composer, tools->width);
}

/* The least x of everything that is drawn after an interval. */
static double next_after(const row_walk *w, const cs_interval *interval) {
  const cs_intervals *intervals = w->intervals;
  double next = interval->high < intervals->active->count ? intervals->edges->low[interval->high]
                                                          : w->area->tools.width;
  return interval + 1 < intervals->intervals + intervals->count ? fmin(next, interval[1].extent.low)
                                                                : next;
}

/* Gives the sweep the members of an interval. */
static celspan_status list_members(row_walk *w, const cs_interval *interval) {
  cs_local_sweep *sweep = &w->area->sweep;
  size_t low = interval->low, high = interval->high;
  CS_TRY(cs_intervals_pick_begins(w->intervals, interval, &sweep->begins, &sweep->begin_count));
  sweep->y0 = w->intervals->y0;
  sweep->y1 = w->intervals->y1;
  CS_TRY(cs_local_sweep_begin(sweep, high - low));
  for (size_t i = low; i < high; i++) {
    cs_member *member = sweep->members[i - low];
    CS_TRY(cs_intervals_member(w->intervals, i, member));
    member->right = &w->cells[i + 1];
  }
  return CELSPAN_OK;
}

/* Draws an interval in one of three ways. */
static celspan_status walk_interval(row_walk *w, const cs_interval *interval) {
  cs_area *area = w->area;
  cs_local_sweep *sweep = &area->sweep;
  size_t low = interval->low, high = interval->high;
  const cs_cell *right = &w->cells[high];
  CS_TRY(list_members(w, interval));
  const cs_extent extent = cs_local_sweep_extent(sweep);
  CS_TRY(begin_item(area, &w->cells[low], low, fmin(extent.low, area->tools.width)));
  if (interval->is_crowd) {
    CS_TRY(cs_crowd_draw(&area->crowd, sweep, extent, next_after(w, interval), right));
  } else if (cs_dense_suits(sweep->count, cs_extent_shown(extent, area->tools.width))) {
    CS_TRY(cs_dense_draw(&area->dense, sweep, extent, right));
  } else {
    CS_TRY(cs_local_sweep_replay(sweep));
  }
  cs_window_end_item(&area->target.window, right);
  return CELSPAN_OK;
}

static celspan_status walk_row(row_walk *w) {
  const cs_area *area = w->area;
  for (size_t k = 0; k < w->intervals->count; k++) {
    const cs_interval *interval = &w->intervals->intervals[k];
    CS_TRY(walk_alone(w, interval->low, interval->extent.low));
    w->visible = find_visible(area, w->visible, interval->high);
    CS_TRY(walk_interval(w, interval));
  }
  return walk_alone(w, area->tools.active->count, area->tools.width);
}

/* ---------------------------------------------------------------- procedures */

/* An edge of a procedure's span as a member between y0 and y1. points: room for two. */
static cs_member edge_member(const cs_procedure_edge *edge, double y0, double y1,
                             celspan_point *points) {
  points[0] = (celspan_point){edge->x, y0};
  points[1] = (celspan_point){edge->x, y1};
  return (cs_member){.points = points,
                     .point_count = 2,
                     .at = 1,
                     .layer = edge->layer,
                     .span = edge->span,
                     .order = 2 * edge->span + (edge->direction < 0),
                     .direction = edge->direction,
                     .x = edge->x,
                     .y = y0,
                     .foot = edge->x};
}

/* Adds the edges at one height of a row, for its share of the row. */
static celspan_status append_edges(cs_intervals *b, const cs_procedure_edges *edges, double y0,
                                   double y1) {
  size_t known = b->procedure_edge_count, count = known + edges->count;
  cs_member *members = cs_arena_take(b->context, b->arena, count * sizeof *members);
  celspan_point *points = cs_arena_take(b->context, b->arena, 2 * edges->count * sizeof *points);
  if (!members || !points)
    return CELSPAN_NO_MEMORY;
  if (known > 0)
    memcpy(members, b->procedure_edges, known * sizeof *members);
  for (size_t k = 0; k < edges->count; k++) {
    members[known + k] = edge_member(&edges->edges[k], y0, y1, points + 2 * k);
    cs_extent_add(&b->procedures, edges->edges[k].x);
  }
  b->procedure_edges = members;
  b->procedure_edge_count = count;
  return CELSPAN_OK;
}

/* Calls every procedure at all heights of the row and adds its edges. */
static celspan_status find_procedures(cs_area *area, cs_intervals *b) {
  b->procedures = (cs_extent){area->tools.width, 0};
  for (int j = 0; j < CS_PROCEDURES_ROWS; j++) {
    cs_procedure_edges edges = {0};
    double top = b->y0 + (double)j / CS_PROCEDURES_ROWS;
    double foot = b->y0 + (j + 1.0) / CS_PROCEDURES_ROWS;
    CS_TRY(cs_procedures_collect(area->tools.procedures, 0.5 * (top + foot), &edges));
    CS_TRY(append_edges(b, &edges, top, foot));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows and slabs */

#define ROW_EVENTS 2048 /* the most begins and ends in a row that is not cut into slabs */
#define SLAB_EVENTS 128 /* about how many begins and ends a slab has */
#define SLABS_MOST 256
#define SLAB_EDGES ((size_t)4 << 20) /* about the most edges in all slabs of a row */

/* Whether the boundaries at the current height are dense. Only the middle half of them is examined,
 * so that a few others far away do not matter. They count as if they were spread over twice the
 * width, because boundaries that end or bend in the row divide them into several intervals. */
static bool is_dense(const cs_area *area) {
  const cs_active *active = area->tools.active;
  size_t first = active->count / 4, last = first + active->count / 2;
  if (active->count == 0)
    return false;
  double low = fmax(active->x[first], 0), high = fmin(active->x[last], area->tools.width);
  return cs_dense_suits(active->count, 4 * fmax(high - low, 0));
}

/* The most boundaries at any height of a row that is cut into slabs. If there would be more, no
 * further slab is cut, because the row is dense. */
static size_t count_edges(const cs_area *area, size_t begins) {
  size_t edges = area->tools.active->count + begins;
  size_t most = 2 * CS_DENSE_A_PIXEL * ((size_t)area->tools.width + 1);
  return edges < most ? edges : most;
}

/* The number of slabs of a row: a power of two, so that their heights are exact. */
static int count_slabs(const cs_area *area, int32_t y) {
  const cs_active *active = area->tools.active;
  size_t begins = cs_intervals_count_begins(active, y + 1.0), events = begins;
  size_t edges = count_edges(area, begins);
  int slabs = 1;
  if (begins + active->count <= ROW_EVENTS || is_dense(area) ||
      cs_procedures_meet(area->tools.procedures, y))
    return 1;
  for (size_t i = 0; i < active->count; i++)
    events += cs_active_chain(active, i)->y1 < y + 1.0;
  while (slabs < SLABS_MOST && events > ROW_EVENTS && (size_t)slabs * SLAB_EVENTS < events &&
         (size_t)slabs * edges < SLAB_EDGES)
    slabs *= 2;
  return slabs;
}

static celspan_status update_cells(cs_area *area, cs_change change, const cs_cells_gap *gaps,
                                   size_t gap_count) {
  const cs_row_tools *tools = &area->tools;
  CS_TRY(cs_cells_update(tools->cells, tools->composer, tools->active, change, gaps, gap_count));
  CS_TRY(tools->composer->failure);
  CS_SELF_CHECK(cs_cells_are_true(tools->cells, tools->composer, tools->active));
  return CELSPAN_OK;
}

/* Copies the cells to memory that lasts as long as the row, because borders point to them. */
static celspan_status keep_cells(cs_area *area, const cs_cell **out) {
  size_t size = area->tools.cells->known * sizeof **out;
  cs_cell *kept = cs_arena_take(area->tools.composer->context, area->tools.arena, size);
  if (!kept)
    return CELSPAN_NO_MEMORY;
  *out = memcpy(kept, area->tools.cells->cells, size);
  return CELSPAN_OK;
}

/* Moves the boundaries down to the next slab, which begins where the last one has ended. */
static celspan_status next_slab(cs_area *area) {
  cs_change change;
  cs_composer *composer = area->tools.composer;
  CS_TRY(cs_active_settle(composer->context, area->tools.active, &change));
  return update_cells(area, change, NULL, 0);
}

/* Moves the boundaries down from one height to another, and finds what happens between the two. The
 * order remains the order at the upper height. */
static celspan_status find_intervals(row_walk *w, double y0, double y1, cs_intervals *intervals) {
  cs_area *area = w->area;
  celspan_context *context = area->tools.composer->context;
  *intervals = (cs_intervals){.context = context,
                              .arena = area->tools.arena,
                              .active = area->tools.active,
                              .edges = &area->edges,
                              .y0 = y0,
                              .y1 = y1};
  w->intervals = intervals;
  CS_TRY(cs_active_advance(context, area->tools.active, y1));
  if (!w->is_slab && cs_procedures_meet(area->tools.procedures, (int32_t)y0))
    CS_TRY(find_procedures(area, intervals));
  CS_TRY(cs_edges_measure(context, &area->edges, area->tools.active, area->tools.width));
  CS_TRY(cs_intervals_find(intervals));
  for (size_t k = 0; k < intervals->count; k++)
    intervals->intervals[k].is_crowd = is_crowd(w, &intervals->intervals[k]);
  return CELSPAN_OK;
}

/* Makes the cells of a row that is walked as a whole, except those inside crowds. */
static celspan_status make_cells(row_walk *w, cs_change change) {
  cs_area *area = w->area;
  const cs_intervals *intervals = w->intervals;
  size_t count = 0;
  cs_cells_gap *gaps = cs_arena_take(area->tools.composer->context, area->tools.arena,
                                     (intervals->count + 1) * sizeof *gaps);
  if (!gaps)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < intervals->count; k++) {
    const cs_interval *interval = &intervals->intervals[k];
    gaps[count] = (cs_cells_gap){interval->low, interval->high};
    count += interval->is_crowd;
  }
  CS_TRY(update_cells(area, change, gaps, count));
  w->cells = area->tools.cells->cells;
  return CELSPAN_OK;
}

/* Walks along the intervals that were found. */
static celspan_status walk_heights(row_walk *w) {
  cs_cells_list(w->area->tools.cells);
  return walk_row(w);
}

/* A row that becomes dense while it is cut is not cut any further: dense intervals cost less than
 * exact slabs of that many boundaries, and need no memory for their intersections. */
static celspan_status walk_slabs(cs_area *area, int32_t y, int slabs, cs_row *out) {
  cs_window *window = &area->target.window;
  cs_intervals intervals;
  for (int k = 0, end; k < slabs; k = end) {
    row_walk w = {.area = area, .is_slab = true};
    if (k > 0)
      CS_TRY(next_slab(area));
    CS_TRY(keep_cells(area, &w.cells));
    if (k == 0) {
      cs_window_begin_row(window, y, w.cells, out);
      cs_window_open_row(window);
    }
    cs_window_end_item(window, &w.cells[0]);
    end = is_dense(area) ? slabs : k + 1;
    CS_TRY(find_intervals(&w, y + (double)k / slabs, y + (double)end / slabs, &intervals));
    CS_TRY(walk_heights(&w));
  }
  return cs_window_end_row(window);
}

celspan_status cs_area_row(cs_area *area, int32_t y, cs_change change, cs_row *out) {
  row_walk w = {.area = area};
  cs_intervals intervals;
  int slabs = count_slabs(area, y);
  area->target.retained = NULL;
  if (slabs > 1) {
    CS_TRY(update_cells(area, change, NULL, 0));
    return walk_slabs(area, y, slabs, out);
  }
  CS_TRY(find_intervals(&w, y, y + 1.0, &intervals));
  CS_TRY(make_cells(&w, change));
  cs_window_begin_row(&area->target.window, y, w.cells, out);
  CS_TRY(walk_heights(&w));
  return cs_window_end_row(&area->target.window);
}

celspan_status cs_area_retain(cs_area *area, int32_t y, cs_change change,
                              cs_retained_row *retained) {
  row_walk w = {.area = area};
  cs_intervals intervals;
  area->target.retained = retained;
  CS_TRY(find_intervals(&w, y, y + 1.0, &intervals));
  CS_TRY(make_cells(&w, change));
  cs_retained_begin(retained, y, w.cells[0].colour);
  CS_TRY(walk_heights(&w));
  return cs_retained_seal(retained, area->tools.composer);
}
