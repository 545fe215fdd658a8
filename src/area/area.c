/* Antialias "area": the exact mean over each pixel, by local events (one walk a row).
 *
 *   alone   a visible boundary that nothing happens to gives its fragments: one, or one a piece
 *   block   boundaries that swap, begin or end inside the row are replayed (cluster.c)
 *
 * A replay costs events times members, so a row in which very much begins and ends is cut into
 * slices of its height, each walked by itself into one window that is summed when all are done.
 */
#include "area/commit.h"
#include "area/intervals.h"
#include "base/number.h"
#include "row/procedures.h"

#include <math.h>
#include <stdlib.h>

static void *take(cs_intervals *b, size_t count, size_t size) {
  return cs_arena_take(b->maker->context, &b->maker->arena, count * size);
}

/* ---------------------------------------------------------------- alone */

/* The walk over the visible boundaries of a row, from left to right. */
typedef struct walk {
  cs_row_maker *maker;
  const cs_cell *cells;
  size_t v; /* the next visible boundary */
} walk;

/* The first visible boundary from v on that is not left of boundary `end`. */
static size_t find_visible(const cs_row_maker *maker, size_t v, size_t end) {
  const cs_cells *cells = &maker->cells;
  if (end == maker->active.count)
    return cells->visible_count;
  while (v < cells->visible_count && cells->visible[v] < end)
    v++;
  return v;
}

/* Writes the visible boundaries up to boundary `end`, to which nothing happens but bends; what
 * comes then lies at or right of column `next`. */
static celspan_status walk_alone(walk *w, size_t end, int32_t next) {
  cs_row_maker *maker = w->maker;
  size_t first = w->v;
  w->v = find_visible(maker, first, end);
  return cs_window_edges(&maker->window, &maker->active, &maker->edges, w->cells,
                         maker->cells.visible + first, w->v - first, next);
}

/* The same in a slice of a row. */
static celspan_status walk_slice(walk *w, size_t end) {
  cs_row_maker *maker = w->maker;
  for (; w->v < maker->cells.visible_count && maker->cells.visible[w->v] < end; w->v++) {
    size_t i = maker->cells.visible[w->v];
    CS_TRY(cs_window_slice(&maker->window, &maker->active, &maker->edges, i, &w->cells[i]));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- blocks */

/* The polyline of active boundary i through the row. */
static celspan_status active_points(cs_intervals *b, size_t i, const celspan_point **points,
                                    uint32_t *count) {
  const cs_active *active = &b->maker->active;
  const cs_bend *bend = cs_active_bend(active, i);
  uint32_t inner = bend ? bend->vertex_count : 0;
  celspan_point *p = take(b, inner + 2, sizeof *p);
  if (!p)
    return CELSPAN_NO_MEMORY;
  *points = p;
  *p++ = (celspan_point){active->x[i], b->y0};
  for (uint32_t k = 0; k < inner; k++)
    *p++ = active->vertices[bend->vertex + k];
  if (!bend || !bend->ends_above)
    *p++ = (celspan_point){active->x_next[i], b->y1};
  *count = (uint32_t)(p - *points);
  return CELSPAN_OK;
}

static int compare_begins(const void *p, const void *q) {
  const cs_member *a = p, *b = q;
  if (a->points[0].y != b->points[0].y)
    return a->points[0].y < b->points[0].y ? -1 : 1;
  if (a->points[0].x != b->points[0].x)
    return a->points[0].x < b->points[0].x ? -1 : 1;
  return (a->order > b->order) - (a->order < b->order);
}

static double least_x(const cs_member *members, size_t count, double least) {
  for (size_t j = 0; j < count; j++)
    for (uint32_t k = 0; k < members[j].point_count; k++)
      if (members[j].points[k].x < least)
        least = members[j].points[k].x;
  return least;
}

/* The begins that belong to a block, in room of their own. Blocks are asked from left to right. */
static celspan_status pick_begins(cs_intervals *b, const cs_interval *interval, cs_member **begins,
                                  size_t *count) {
  size_t first = b->picked;
  while (b->picked < b->begin_count && b->begin_places[b->picked].low <= interval->last_low)
    b->picked++;
  *count = b->picked - first;
  *begins = NULL;
  if (*count == 0)
    return CELSPAN_OK;
  *begins = take(b, *count, sizeof **begins);
  if (!*begins)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < *count; k++)
    (*begins)[k] = b->begins[b->begin_places[first + k].begin];
  return CELSPAN_OK;
}

/* Room for the members of a cluster, which is kept from one to the next. */
static celspan_status make_room(cs_row_maker *maker, cs_local_sweep *sweep) {
  size_t most = sweep->count + sweep->begin_count;
  CS_TRY(cs_mem_reserve(maker->context, (void **)&maker->members, &maker->member_capacity, most,
                        sizeof *maker->members));
  CS_TRY(cs_mem_reserve(maker->context, (void **)&maker->member_lists, &maker->list_capacity,
                        3 * most, sizeof *maker->member_lists));
  sweep->members = (cs_member **)maker->member_lists;
  sweep->spare = sweep->members + most;
  sweep->seen = (const cs_cell **)(maker->member_lists + 2 * most);
  for (size_t j = 0; j < sweep->count; j++)
    sweep->members[j] = &maker->members[j];
  return CELSPAN_OK;
}

/* Replays a block. */
static celspan_status walk_interval(cs_intervals *b, const cs_interval *interval) {
  cs_row_maker *maker = b->maker;
  const cs_active *active = &maker->active;
  size_t low = interval->low, high = interval->high, begin_count;
  cs_member *begins;
  CS_TRY(pick_begins(b, interval, &begins, &begin_count));
  cs_local_sweep sweep = {.maker = maker,
                          .y0 = b->y0,
                          .y1 = b->y1,
                          .left = &b->cells[low],
                          .count = high - low,
                          .begins = begins,
                          .begin_count = begin_count};
  CS_TRY(make_room(maker, &sweep));
  for (size_t i = low; i < high; i++) {
    const celspan_point *points;
    uint32_t count;
    CS_TRY(active_points(b, i, &points, &count));
    cs_member *member = sweep.members[i - low];
    cs_intervals_member(member, active, active->walks[active->slot[i]].chain, points, count);
    member->place = (uint32_t)i;
    member->right = &b->cells[i + 1];
  }
  if (begin_count > 1)
    qsort(begins, begin_count, sizeof *begins, compare_begins);
  double least = least_x(maker->members, sweep.count, maker->plan->width);
  least = least_x(begins, begin_count, least);
  cs_cells_stand(&maker->cells, &maker->composer, low, least);
  sweep.deferred = maker->cells.deferred;
  sweep.deferred_end = maker->cells.deferred_end;
  CS_TRY(cs_window_reach(&maker->window, least));
  CS_TRY(cs_local_sweep_replay(&sweep));
  CS_TRY(cs_commit_cluster(&sweep, low, high));
  cs_window_pass(&maker->window, &b->cells[high]);
  return CELSPAN_OK;
}

/* Whether a block is two straight boundaries that cross: the bends of both, if any, keep to their
 * chords. */
static bool is_pair(const cs_intervals *b, const cs_interval *interval) {
  const cs_active *active = &b->maker->active;
  size_t i = interval->low;
  return interval->high - i == 2 && interval->low_x > interval->high_x &&
         !b->maker->edges.is_bent[i] && !b->maker->edges.is_bent[i + 1] &&
         active->x_next[i] > active->x_next[i + 1];
}

static celspan_status walk_pair(cs_intervals *b, const cs_interval *interval) {
  cs_row_maker *maker = b->maker;
  cs_cells_stand(&maker->cells, &maker->composer, interval->low, interval->reach_low);
  CS_TRY(cs_window_reach(&maker->window, interval->reach_low));
  const cs_cell *between;
  CS_TRY(cs_local_sweep_pair(maker, &b->cells[interval->low], interval->low, &between));
  CS_TRY(cs_commit_pair(maker, interval->low, between));
  cs_window_pass(&maker->window, &b->cells[interval->high]);
  return CELSPAN_OK;
}

static celspan_status walk_to(walk *w, size_t end, int32_t next) {
  return w->maker->window.is_held ? walk_slice(w, end) : walk_alone(w, end, next);
}

static celspan_status walk_row(cs_intervals *b) {
  cs_row_maker *maker = b->maker;
  walk w = {.maker = maker, .cells = b->cells};
  for (size_t k = 0; k < b->count; k++) {
    const cs_interval *interval = &b->intervals[k];
    CS_TRY(walk_to(&w, interval->low, cs_edges_floor(interval->reach_low, maker->plan->width)));
    w.v = find_visible(maker, w.v, interval->high);
    CS_TRY(is_pair(b, interval) ? walk_pair(b, interval) : walk_interval(b, interval));
  }
  return walk_to(&w, maker->active.count, maker->plan->width);
}

/* ---------------------------------------------------------------- strips */

/* The edges of one of a row's heights, as members that live for its share of the row. */
static celspan_status append_edges(cs_intervals *b, const cs_procedure_edges *edges, double y0,
                                   double y1) {
  cs_member *procedure_edges =
      take(b, b->procedure_edge_count + edges->count, sizeof *procedure_edges);
  celspan_point *points = take(b, 2 * edges->count, sizeof *points);
  if (!procedure_edges || !points)
    return CELSPAN_NO_MEMORY;
  if (b->procedure_edge_count > 0)
    memcpy(procedure_edges, b->procedure_edges, b->procedure_edge_count * sizeof *procedure_edges);
  for (size_t k = 0; k < edges->count; k++, points += 2) {
    const cs_procedure_edge *e = &edges->edges[k];
    points[0] = (celspan_point){e->x, y0};
    points[1] = (celspan_point){e->x, y1};
    procedure_edges[b->procedure_edge_count + k] =
        (cs_member){.points = points,
                    .point_count = 2,
                    .at = 1,
                    .layer = e->layer,
                    .span = e->span,
                    .order = 2 * e->span + (e->direction < 0),
                    .place = UINT32_MAX,
                    .direction = e->direction,
                    .x = e->x,
                    .y = y0,
                    .foot = e->x};
    b->procedures_low = e->x < b->procedures_low ? e->x : b->procedures_low;
    b->procedures_high = e->x > b->procedures_high ? e->x : b->procedures_high;
  }
  b->procedure_edges = procedure_edges;
  b->procedure_edge_count += edges->count;
  return CELSPAN_OK;
}

/* Asks every procedure for its spans on all heights of the row. */
static celspan_status find_procedures(cs_intervals *b) {
  b->procedures_low = b->maker->plan->width;
  for (int j = 0; j < CS_PROCEDURES_ROWS; j++) {
    cs_procedure_edges edges = {0};
    double top = b->y0 + (double)j / CS_PROCEDURES_ROWS,
           foot = b->y0 + (j + 1.0) / CS_PROCEDURES_ROWS;
    CS_TRY(cs_procedures_collect(b->maker, 0.5 * (top + foot), &edges));
    CS_TRY(append_edges(b, &edges, top, foot));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- slices */

#define ROW_EVENTS 2048  /* what may begin and end in a row that is not cut */
#define SLICE_EVENTS 128 /* and in a slice of one that is */
#define SLICES_MOST 256

/* Slices of a row: a power of two, so that their heights are exact. */
static int count_slices(const cs_row_maker *maker, int32_t y) {
  const cs_active *active = &maker->active;
  size_t events = cs_intervals_count_begins(active, y + 1.0);
  int slices = 1;
  if (events + active->count <= ROW_EVENTS || maker->window.retained ||
      cs_procedures_meet(maker, y))
    return 1;
  for (size_t i = 0; i < active->count; i++)
    events += cs_active_chain(active, i)->y1 < y + 1.0;
  while (slices < SLICES_MOST && events > ROW_EVENTS && (size_t)slices * SLICE_EVENTS < events)
    slices *= 2;
  return slices;
}

/* The cells in room that lasts as long as the row: fragments point to them. */
static celspan_status keep_cells(cs_row_maker *maker, const cs_cell **out) {
  size_t size = maker->cells.known * sizeof **out;
  cs_cell *kept = cs_arena_take(maker->context, &maker->arena, size);
  if (!kept)
    return CELSPAN_NO_MEMORY;
  *out = memcpy(kept, maker->cells.cells, size);
  return CELSPAN_OK;
}

/* Moves the boundaries down to the slice that begins where the last one ended. */
static celspan_status next_slice(cs_row_maker *maker) {
  cs_change change;
  CS_TRY(cs_active_settle(maker->context, &maker->active, &change));
  if (!cs_change_is_none(change))
    CS_TRY(cs_cells_update(&maker->cells, &maker->composer, &maker->active, change));
  return maker->composer.failure;
}

/* The row between two heights; the boundaries stand at the upper. */
static celspan_status walk_heights(cs_row_maker *maker, const cs_cell *cells, double y0,
                                   double y1) {
  cs_cells_list(&maker->cells);
  cs_intervals intervals = {.maker = maker, .cells = cells, .y0 = y0, .y1 = y1};
  maker->committed = NULL;
  CS_TRY(cs_active_reach(maker->context, &maker->active, y1));
  if (!maker->window.is_held && cs_procedures_meet(maker, (int32_t)y0))
    CS_TRY(find_procedures(&intervals));
  CS_TRY(cs_edges_measure(maker->context, &maker->edges, &maker->active, maker->plan->width));
  CS_TRY(cs_intervals_find(&intervals));
  return walk_row(&intervals);
}

static celspan_status walk_slices(cs_row_maker *maker, int32_t y, int slices, cs_row *out) {
  const cs_cell *cells;
  for (int k = 0; k < slices; k++) {
    if (k > 0)
      CS_TRY(next_slice(maker));
    CS_TRY(keep_cells(maker, &cells));
    if (k == 0) {
      cs_window_begin(&maker->window, &maker->painter, &maker->arena, maker->plan->width, y, cells,
                      out);
      cs_window_hold(&maker->window);
    }
    cs_window_pass(&maker->window, &cells[0]);
    CS_TRY(walk_heights(maker, cells, y + (double)k / slices, y + (k + 1.0) / slices));
    CS_TRY(cs_commit_out(maker));
  }
  return cs_window_finish(&maker->window);
}

celspan_status cs_area_row(cs_row_maker *maker, int32_t y, cs_row *out) {
  int slices = count_slices(maker, y);
  if (slices > 1)
    return walk_slices(maker, y, slices, out);
  cs_window_begin(&maker->window, &maker->painter, &maker->arena, maker->plan->width, y,
                  maker->cells.cells, out);
  CS_TRY(walk_heights(maker, maker->cells.cells, y, y + 1.0));
  CS_TRY(cs_window_finish(&maker->window));
  return cs_commit_out(maker);
}
