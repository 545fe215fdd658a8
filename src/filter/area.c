/* Antialias "area": the exact mean over each pixel, by local events (one walk a row).
 *
 *   alone   a visible boundary that nothing happens to gives its fragments: one, or one a piece
 *   block   boundaries that swap, begin or end inside the row are replayed (cluster.c)
 *
 * A replay costs events times members, so a row in which very much begins and ends is cut into
 * slices of its height, each walked by itself into one window that is summed when all are done.
 */
#include "base/number.h"
#include "filter/blocks.h"
#include "filter/carry.h"
#include "filter/strips.h"

#include <math.h>
#include <stdlib.h>

static void *take(cs_blocks *b, size_t count, size_t size) {
  return cs_arena_take(b->scan->context, &b->scan->arena, count * size);
}

/* ---------------------------------------------------------------- alone */

/* The walk over the visible boundaries of a row, from left to right. */
typedef struct walk {
  cs_scan *scan;
  const cs_cell *cells;
  size_t v; /* the next visible boundary */
} walk;

/* The first visible boundary from v on that is not left of boundary `end`. */
static size_t find_visible(const cs_scan *scan, size_t v, size_t end) {
  const cs_cells *cells = &scan->cells;
  if (end == scan->active.count)
    return cells->visible_count;
  while (v < cells->visible_count && cells->visible[v] < end)
    v++;
  return v;
}

/* Writes the visible boundaries up to boundary `end`, to which nothing happens but bends; what
 * comes then lies at or right of column `next`. */
static celspan_status walk_alone(walk *w, size_t end, int32_t next) {
  cs_scan *scan = w->scan;
  size_t first = w->v;
  w->v = find_visible(scan, first, end);
  return cs_window_edges(&scan->window, &scan->active, &scan->edges, w->cells,
                         scan->cells.visible + first, w->v - first, next);
}

/* The same in a slice of a row. */
static celspan_status walk_slice(walk *w, size_t end) {
  cs_scan *scan = w->scan;
  for (; w->v < scan->cells.visible_count && scan->cells.visible[w->v] < end; w->v++) {
    size_t i = scan->cells.visible[w->v];
    CS_TRY(cs_window_slice(&scan->window, &scan->active, &scan->edges, i, &w->cells[i]));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- blocks */

/* The polyline of active boundary i through the row. */
static celspan_status active_points(cs_blocks *b, size_t i, const celspan_point **points,
                                    uint32_t *count) {
  const cs_active *active = &b->scan->active;
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
static celspan_status pick_begins(cs_blocks *b, const cs_block *block, cs_member **begins,
                                  size_t *count) {
  size_t first = b->picked;
  while (b->picked < b->begin_count && b->begin_places[b->picked].low <= block->last_low)
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
static celspan_status make_room(cs_scan *scan, cs_cluster *cluster) {
  size_t most = cluster->count + cluster->begin_count;
  CS_TRY(cs_mem_reserve(scan->context, (void **)&scan->members, &scan->member_capacity, most,
                        sizeof *scan->members));
  CS_TRY(cs_mem_reserve(scan->context, (void **)&scan->member_lists, &scan->list_capacity,
                        3 * most, sizeof *scan->member_lists));
  cluster->members = (cs_member **)scan->member_lists;
  cluster->spare = cluster->members + most;
  cluster->seen = (const cs_cell **)(scan->member_lists + 2 * most);
  for (size_t j = 0; j < cluster->count; j++)
    cluster->members[j] = &scan->members[j];
  return CELSPAN_OK;
}

/* Replays a block. */
static celspan_status walk_block(cs_blocks *b, const cs_block *block) {
  cs_scan *scan = b->scan;
  const cs_active *active = &scan->active;
  size_t low = block->low, high = block->high, begin_count;
  cs_member *begins;
  CS_TRY(pick_begins(b, block, &begins, &begin_count));
  cs_cluster cluster = {.scan = scan,
                        .y0 = b->y0,
                        .y1 = b->y1,
                        .left = &b->cells[low],
                        .count = high - low,
                        .begins = begins,
                        .begin_count = begin_count};
  CS_TRY(make_room(scan, &cluster));
  for (size_t i = low; i < high; i++) {
    const celspan_point *points;
    uint32_t count;
    CS_TRY(active_points(b, i, &points, &count));
    cs_member *member = cluster.members[i - low];
    cs_blocks_member(member, active, active->walks[active->slot[i]].chain, points, count);
    member->place = (uint32_t)i;
    member->right = &b->cells[i + 1];
  }
  if (begin_count > 1)
    qsort(begins, begin_count, sizeof *begins, compare_begins);
  double least = least_x(scan->members, cluster.count, scan->shot->width);
  least = least_x(begins, begin_count, least);
  cs_cells_stand(&scan->cells, &scan->composer, low, least);
  cluster.toggle = scan->cells.toggle;
  cluster.toggle_end = scan->cells.toggle_end;
  CS_TRY(cs_window_reach(&scan->window, least));
  CS_TRY(cs_cluster_replay(&cluster));
  CS_TRY(cs_carry_cluster(&cluster, low, high));
  cs_window_pass(&scan->window, &b->cells[high]);
  return CELSPAN_OK;
}

/* Whether a block is two straight boundaries that cross: the bends of both, if any, keep to their
 * chords. */
static bool is_pair(const cs_blocks *b, const cs_block *block) {
  const cs_active *active = &b->scan->active;
  size_t i = block->low;
  return block->high - i == 2 && block->low_x > block->high_x && !b->scan->edges.is_bent[i] &&
         !b->scan->edges.is_bent[i + 1] && active->x_next[i] > active->x_next[i + 1];
}

static celspan_status walk_pair(cs_blocks *b, const cs_block *block) {
  cs_scan *scan = b->scan;
  cs_cells_stand(&scan->cells, &scan->composer, block->low, block->reach_low);
  CS_TRY(cs_window_reach(&scan->window, block->reach_low));
  const cs_cell *between;
  CS_TRY(cs_cluster_pair(scan, &b->cells[block->low], block->low, &between));
  CS_TRY(cs_carry_pair(scan, block->low, between));
  cs_window_pass(&scan->window, &b->cells[block->high]);
  return CELSPAN_OK;
}

static celspan_status walk_to(walk *w, size_t end, int32_t next) {
  return w->scan->window.is_held ? walk_slice(w, end) : walk_alone(w, end, next);
}

static celspan_status walk_row(cs_blocks *b) {
  cs_scan *scan = b->scan;
  walk w = {.scan = scan, .cells = b->cells};
  for (size_t k = 0; k < b->count; k++) {
    const cs_block *block = &b->blocks[k];
    CS_TRY(walk_to(&w, block->low, cs_edges_floor(block->reach_low, scan->shot->width)));
    w.v = find_visible(scan, w.v, block->high);
    CS_TRY(is_pair(b, block) ? walk_pair(b, block) : walk_block(b, block));
  }
  return walk_to(&w, scan->active.count, scan->shot->width);
}

/* ---------------------------------------------------------------- strips */

/* The edges of one of a row's heights, as members that live for its share of the row. */
static celspan_status append_edges(cs_blocks *b, const cs_strip_edges *edges, double y0,
                                   double y1) {
  cs_member *strips = take(b, b->strip_count + edges->count, sizeof *strips);
  celspan_point *points = take(b, 2 * edges->count, sizeof *points);
  if (!strips || !points)
    return CELSPAN_NO_MEMORY;
  if (b->strip_count > 0)
    memcpy(strips, b->strips, b->strip_count * sizeof *strips);
  for (size_t k = 0; k < edges->count; k++, points += 2) {
    const cs_strip_edge *e = &edges->edges[k];
    points[0] = (celspan_point){e->x, y0};
    points[1] = (celspan_point){e->x, y1};
    strips[b->strip_count + k] =
        (cs_member){.points = points, .point_count = 2, .at = 1, .leaf = e->leaf,
                    .strip = e->strip, .order = 2 * e->strip + (e->direction < 0),
                    .place = UINT32_MAX,
                    .direction = e->direction, .x = e->x, .y = y0, .foot = e->x};
    b->strips_low = e->x < b->strips_low ? e->x : b->strips_low;
    b->strips_high = e->x > b->strips_high ? e->x : b->strips_high;
  }
  b->strips = strips;
  b->strip_count += edges->count;
  return CELSPAN_OK;
}

/* Asks every procedure for its spans on all heights of the row. */
static celspan_status find_strips(cs_blocks *b) {
  b->strips_low = b->scan->shot->width;
  for (int j = 0; j < CS_STRIPS_ROWS; j++) {
    cs_strip_edges edges = {0};
    double top = b->y0 + (double)j / CS_STRIPS_ROWS, foot = b->y0 + (j + 1.0) / CS_STRIPS_ROWS;
    CS_TRY(cs_strips_collect(b->scan, 0.5 * (top + foot), &edges));
    CS_TRY(append_edges(b, &edges, top, foot));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- slices */

#define ROW_EVENTS 2048  /* what may begin and end in a row that is not cut */
#define SLICE_EVENTS 128 /* and in a slice of one that is */
#define SLICES_MOST 256

/* Slices of a row: a power of two, so that their heights are exact. */
static int count_slices(const cs_scan *scan, int32_t y) {
  const cs_active *active = &scan->active;
  size_t events = cs_blocks_count_begins(active, y + 1.0);
  int slices = 1;
  if (events + active->count <= ROW_EVENTS || scan->window.trace || cs_strips_meet(scan, y))
    return 1;
  for (size_t i = 0; i < active->count; i++)
    events += cs_active_chain(active, i)->y1 < y + 1.0;
  while (slices < SLICES_MOST && events > ROW_EVENTS && (size_t)slices * SLICE_EVENTS < events)
    slices *= 2;
  return slices;
}

/* The cells in room that lasts as long as the row: fragments point to them. */
static celspan_status keep_cells(cs_scan *scan, const cs_cell **out) {
  size_t size = scan->cells.known * sizeof **out;
  cs_cell *kept = cs_arena_take(scan->context, &scan->arena, size);
  if (!kept)
    return CELSPAN_NO_MEMORY;
  *out = memcpy(kept, scan->cells.cells, size);
  return CELSPAN_OK;
}

/* Moves the boundaries down to the slice that begins where the last one ended. */
static celspan_status next_slice(cs_scan *scan) {
  cs_change change;
  CS_TRY(cs_active_settle(scan->context, &scan->active, &change));
  if (!cs_change_is_none(change))
    CS_TRY(cs_cells_update(&scan->cells, &scan->composer, &scan->active, change));
  return scan->composer.failure;
}

/* The row between two heights; the boundaries stand at the upper. */
static celspan_status walk_heights(cs_scan *scan, const cs_cell *cells, double y0, double y1) {
  cs_cells_list(&scan->cells);
  cs_blocks blocks = {.scan = scan, .cells = cells, .y0 = y0, .y1 = y1};
  scan->carried = NULL;
  CS_TRY(cs_active_reach(scan->context, &scan->active, y1));
  if (!scan->window.is_held && cs_strips_meet(scan, (int32_t)y0))
    CS_TRY(find_strips(&blocks));
  CS_TRY(cs_edges_measure(scan->context, &scan->edges, &scan->active, scan->shot->width));
  CS_TRY(cs_blocks_find(&blocks));
  return walk_row(&blocks);
}

static celspan_status walk_slices(cs_scan *scan, int32_t y, int slices, cs_row *out) {
  const cs_cell *cells;
  for (int k = 0; k < slices; k++) {
    if (k > 0)
      CS_TRY(next_slice(scan));
    CS_TRY(keep_cells(scan, &cells));
    if (k == 0) {
      cs_window_begin(&scan->window, &scan->composer, &scan->arena, scan->shot->width, y, cells,
                      out);
      cs_window_hold(&scan->window);
    }
    cs_window_pass(&scan->window, &cells[0]);
    CS_TRY(walk_heights(scan, cells, y + (double)k / slices, y + (k + 1.0) / slices));
    CS_TRY(cs_carry_out(scan));
  }
  return cs_window_finish(&scan->window);
}

celspan_status cs_area_row(cs_scan *scan, int32_t y, cs_row *out) {
  int slices = count_slices(scan, y);
  if (slices > 1)
    return walk_slices(scan, y, slices, out);
  cs_window_begin(&scan->window, &scan->composer, &scan->arena, scan->shot->width, y,
                  scan->cells.cells, out);
  CS_TRY(walk_heights(scan, scan->cells.cells, y, y + 1.0));
  CS_TRY(cs_window_finish(&scan->window));
  return cs_carry_out(scan);
}
