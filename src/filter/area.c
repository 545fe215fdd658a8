/* Antialias "area": the exact mean over each pixel, by local events (one walk a row).
 *
 *   alone      a visible boundary that nothing happens to gives its one fragment
 *   bent       one that bends gives a fragment a piece
 *   clustered  boundaries that swap, begin or end inside the row are replayed (cluster.c)
 *
 * A cluster is the smallest block of neighbours that holds all of: the boundaries that the order at
 * the foot of the row permutes; a bent boundary and those whose x-range it meets; what begins and
 * ends at one height in one leaf (its windings balance only together) and all between.
 */
#include "base/number.h"
#include "filter/cluster.h"
#include "filter/strips.h"

#include <stdlib.h>

/* A block of neighbours [low, high) to be replayed together; low == high: between two of them. */
typedef struct block {
  size_t low, high;
  size_t last_low; /* the greatest `low` merged into it */
} block;

/* A begin or an end inside the row. */
typedef struct event {
  double x, y;
  uint32_t leaf;
  int32_t begin; /* index into begins, or -1: an end */
} event;

typedef struct area {
  cs_scan *scan;
  cs_window *window;
  double y0, y1;
  double *low, *high; /* x-range of every active boundary in the row */
  cs_member *begins;  /* chains that begin inside the row */
  size_t *begin_low;  /* for each: the low end of the block it belongs to */
  size_t begin_count;
  event *events;
  size_t event_count;
  block *blocks;
  size_t block_count, block_capacity;
  size_t bend; /* the next bend of the active list that the walk will meet */
} area;

static void *take(area *a, size_t count, size_t size) {
  return cs_arena_take(a->scan->context, &a->scan->arena, count * size);
}

/* ---------------------------------------------------------------- polylines */

/* The polyline of active boundary i through the row; bend: its bend, or NULL. */
static celspan_status active_points(area *a, size_t i, const cs_bend *bend,
                                    const celspan_point **points, uint32_t *count) {
  const cs_active *active = &a->scan->active;
  uint32_t inner = bend ? bend->vertex_count : 0;
  celspan_point *p = take(a, inner + 2, sizeof *p);
  if (!p)
    return CELSPAN_NO_MEMORY;
  *points = p;
  *p++ = (celspan_point){active->x[i], a->y0};
  for (uint32_t k = 0; k < inner; k++)
    *p++ = active->vertices[bend->vertex + k];
  if (!bend || !bend->ends || inner == 0)
    *p++ = (celspan_point){active->x_next[i], a->y1};
  *count = (uint32_t)(p - *points);
  return CELSPAN_OK;
}

/* The polyline of a chain that begins inside the row, down to its end or the foot of the row. */
static celspan_status chain_points(area *a, uint32_t chain, const celspan_point **points,
                                   uint32_t *count) {
  const cs_boundary_set *set = a->scan->active.set;
  cs_boundary_walk walk;
  size_t room = 3;
  cs_boundary_start(set, chain, set->chains[chain].y0, &walk);
  for (cs_boundary_walk ahead = walk; ahead.y1 < a->y1 && cs_boundary_next(set, &ahead);)
    room++;
  celspan_point *p = take(a, room, sizeof *p), *last = p;
  if (!p)
    return CELSPAN_NO_MEMORY;
  *points = p;
  *p++ = (celspan_point){cs_boundary_x(&walk, set->chains[chain].y0), set->chains[chain].y0};
  bool more = true;
  while (more && walk.y1 < a->y1) {
    if (walk.y1 > last->y) {
      last = p;
      *p++ = (celspan_point){walk.x1, walk.y1};
    }
    more = cs_boundary_next(set, &walk);
  }
  if (more)
    *p++ = (celspan_point){cs_boundary_x(&walk, a->y1), a->y1};
  *count = (uint32_t)(p - *points);
  return CELSPAN_OK;
}

static cs_member chain_member(const area *a, uint32_t chain, const celspan_point *points,
                              uint32_t count) {
  const cs_boundary_chain *c = &a->scan->active.set->chains[chain];
  return (cs_member){.points = points,
                     .point_count = count,
                     .at = 1,
                     .leaf = c->leaf,
                     .strip = UINT32_MAX,
                     .order = chain,
                     .direction = c->direction,
                     .x = points[0].x,
                     .y = points[0].y,
                     .foot = points[0].x};
}

/* ---------------------------------------------------------------- x-ranges */

static celspan_status measure_ranges(area *a) {
  const cs_active *active = &a->scan->active;
  a->low = take(a, active->count, sizeof *a->low);
  a->high = take(a, active->count, sizeof *a->high);
  if (!a->low || !a->high)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < active->count; i++) {
    bool rises = active->x[i] < active->x_next[i];
    a->low[i] = rises ? active->x[i] : active->x_next[i];
    a->high[i] = rises ? active->x_next[i] : active->x[i];
  }
  for (size_t b = 0; b < active->bend_count; b++) {
    const cs_bend *bend = &active->bends[b];
    for (uint32_t k = 0; k < bend->vertex_count; k++) {
      double x = active->vertices[bend->vertex + k].x;
      a->low[bend->boundary] = x < a->low[bend->boundary] ? x : a->low[bend->boundary];
      a->high[bend->boundary] = x > a->high[bend->boundary] ? x : a->high[bend->boundary];
    }
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- blocks */

static celspan_status add_block(area *a, size_t low, size_t high) {
  if (a->block_count == a->block_capacity) {
    size_t wanted = a->block_capacity ? 2 * a->block_capacity : 64;
    block *grown = take(a, wanted, sizeof *grown);
    if (!grown)
      return CELSPAN_NO_MEMORY;
    if (a->block_count > 0)
      memcpy(grown, a->blocks, a->block_count * sizeof *grown);
    a->blocks = grown;
    a->block_capacity = wanted;
  }
  a->blocks[a->block_count++] = (block){low, high, low};
  return CELSPAN_OK;
}

/* Blocks that the order at the foot permutes: back from each boundary that is overtaken, to the
 * first one at or left of which nothing ends up right of it. */
static celspan_status add_swaps(area *a) {
  const cs_active *active = &a->scan->active;
  const double *foot = active->x_next;
  double *greatest = take(a, active->count, sizeof *greatest);
  if (!greatest)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < active->count; i++) {
    greatest[i] = i > 0 && greatest[i - 1] > foot[i] ? greatest[i - 1] : foot[i];
    size_t low = i;
    while (low > 0 && greatest[low - 1] > foot[i])
      low--;
    if (low < i)
      CS_TRY(add_block(a, low, i + 1));
  }
  return CELSPAN_OK;
}

/* Blocks of bent boundaries with the neighbours that they may touch. */
static celspan_status add_bends(area *a) {
  const cs_active *active = &a->scan->active;
  for (size_t b = 0; b < active->bend_count; b++) {
    const cs_bend *bend = &active->bends[b];
    size_t i = bend->boundary, low = i, high = i + 1;
    if (bend->vertex_count == 0)
      continue;
    while (low > 0 && a->high[low - 1] > a->low[i])
      low--;
    while (high < active->count && a->low[high] < a->high[i])
      high++;
    if (high - low > 1)
      CS_TRY(add_block(a, low, high));
  }
  return CELSPAN_OK;
}

static int compare_events(const void *p, const void *q) {
  const event *a = p, *b = q;
  if (a->y != b->y)
    return a->y < b->y ? -1 : 1;
  if (a->leaf != b->leaf)
    return a->leaf < b->leaf ? -1 : 1;
  if (a->x != b->x)
    return a->x < b->x ? -1 : 1;
  return (a->begin > b->begin) - (a->begin < b->begin);
}

/* The block of the boundaries whose x-range meets [low, high], or the place between two. */
static celspan_status add_range(area *a, double low, double high, size_t *block_low) {
  const cs_active *active = &a->scan->active;
  size_t first = active->count, end = 0, place = 0;
  for (size_t i = 0; i < active->count; i++) {
    place += active->x[i] <= low;
    if (a->high[i] < low || a->low[i] > high)
      continue;
    first = i < first ? i : first;
    end = i + 1;
  }
  *block_low = first < end ? first : place;
  return add_block(a, *block_low, first < end ? end : place);
}

/* Blocks of begins and ends: one for all of a leaf at one height. */
static celspan_status add_events(area *a) {
  qsort(a->events, a->event_count, sizeof *a->events, compare_events);
  for (size_t first = 0, end; first < a->event_count; first = end) {
    const event *e = &a->events[first];
    for (end = first + 1; end < a->event_count && a->events[end].y == e->y &&
                          a->events[end].leaf == e->leaf;)
      end++;
    size_t block_low;
    CS_TRY(add_range(a, e->x, a->events[end - 1].x, &block_low));
    for (size_t i = first; i < end; i++)
      if (a->events[i].begin >= 0)
        a->begin_low[a->events[i].begin] = block_low;
  }
  return CELSPAN_OK;
}

static int compare_blocks(const void *p, const void *q) {
  const block *a = p, *b = q;
  if (a->low != b->low)
    return a->low < b->low ? -1 : 1;
  return (a->high > b->high) - (a->high < b->high);
}

/* Joins blocks that share a boundary, and places that touch a block. */
static void merge_blocks(area *a) {
  size_t kept = 0;
  qsort(a->blocks, a->block_count, sizeof *a->blocks, compare_blocks);
  for (size_t i = 0; i < a->block_count; i++) {
    block *next = &a->blocks[i], *last = kept > 0 ? &a->blocks[kept - 1] : NULL;
    bool touches = last && next->low == last->high &&
                   (next->low == next->high || last->last_low == last->high);
    if (last && (next->low < last->high || touches)) {
      last->high = next->high > last->high ? next->high : last->high;
      last->last_low = next->low;
    } else {
      a->blocks[kept++] = *next;
    }
  }
  a->block_count = kept;
}

/* ---------------------------------------------------------------- begins and ends */

static celspan_status find_begins(area *a) {
  const cs_active *active = &a->scan->active;
  const cs_boundary_chain *chains = active->set->chains;
  size_t end = active->next;
  while (end < active->set->chain_count && chains[end].y0 < a->y1)
    end++;
  a->begin_count = end - active->next;
  a->begins = take(a, a->begin_count, sizeof *a->begins);
  a->begin_low = take(a, a->begin_count, sizeof *a->begin_low);
  a->events = take(a, 2 * a->begin_count + active->bend_count, sizeof *a->events);
  if (!a->begins || !a->begin_low || !a->events)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < a->begin_count; k++) {
    uint32_t chain = (uint32_t)(active->next + k), count;
    const celspan_point *points;
    CS_TRY(chain_points(a, chain, &points, &count));
    a->begins[k] = chain_member(a, chain, points, count);
  }
  return CELSPAN_OK;
}

static void note_event(area *a, celspan_point at, uint32_t leaf, int32_t begin) {
  a->events[a->event_count++] = (event){at.x, at.y, leaf, begin};
}

static void find_events(area *a) {
  const cs_active *active = &a->scan->active;
  for (size_t k = 0; k < a->begin_count; k++) {
    const cs_member *member = &a->begins[k];
    celspan_point last = member->points[member->point_count - 1];
    note_event(a, member->points[0], member->leaf, (int32_t)k);
    if (last.y < a->y1)
      note_event(a, last, member->leaf, -1);
  }
  for (size_t b = 0; b < active->bend_count; b++) {
    const cs_bend *bend = &active->bends[b];
    if (bend->ends && bend->vertex_count > 0)
      note_event(a, active->vertices[bend->vertex + bend->vertex_count - 1],
                 cs_active_chain(active, bend->boundary)->leaf, -1);
  }
}

/* ---------------------------------------------------------------- the walk */

/* The bend of active boundary i, or NULL; i ascends from call to call. */
static const cs_bend *bend_of(area *a, size_t i) {
  const cs_active *active = &a->scan->active;
  while (a->bend < active->bend_count && active->bends[a->bend].boundary < i)
    a->bend++;
  if (a->bend < active->bend_count && active->bends[a->bend].boundary == i)
    return &active->bends[a->bend];
  return NULL;
}

/* The fragments of a visible boundary that nothing happens to. */
static celspan_status walk_alone(area *a, size_t i) {
  const cs_active *active = &a->scan->active;
  const cs_cell *left = &a->scan->cells.cells[i], *right = left + 1;
  const cs_bend *bend = active->bend_count > 0 ? bend_of(a, i) : NULL;
  celspan_point at = {active->x[i], a->y0};
  double least = at.x < active->x_next[i] ? at.x : active->x_next[i];
  for (uint32_t k = 0; bend && k < bend->vertex_count; k++)
    if (active->vertices[bend->vertex + k].x < least)
      least = active->vertices[bend->vertex + k].x;
  CS_TRY(cs_window_reach(a->window, least));
  for (uint32_t k = 0; bend && k < bend->vertex_count; k++) {
    celspan_point to = active->vertices[bend->vertex + k];
    CS_TRY(cs_window_add(a->window, at.x, to.x, to.y - at.y, left, right));
    at = to;
  }
  CS_TRY(cs_window_add(a->window, at.x, active->x_next[i], a->y1 - at.y, left, right));
  cs_window_pass(a->window, right);
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

/* Replays boundaries [low, high) and the given begins; the composer stands left of them. */
static celspan_status walk_block(area *a, size_t low, size_t high, cs_member *begins,
                                 size_t begin_count) {
  const cs_active *active = &a->scan->active;
  cs_cluster cluster = {.scan = a->scan,
                        .y0 = a->y0,
                        .y1 = a->y1,
                        .left = &a->scan->cells.cells[low],
                        .count = high - low,
                        .begins = begins,
                        .begin_count = begin_count};
  cluster.members = take(a, high - low + begin_count, sizeof *cluster.members);
  if (!cluster.members)
    return CELSPAN_NO_MEMORY;
  for (size_t i = low; i < high; i++) {
    const celspan_point *points;
    uint32_t count;
    CS_TRY(active_points(a, i, bend_of(a, i), &points, &count));
    cs_member *member = &cluster.members[i - low];
    *member = chain_member(a, active->walks[active->slot[i]].chain, points, count);
    member->right = &a->scan->cells.cells[i + 1];
  }
  qsort(begins, begin_count, sizeof *begins, compare_begins);
  double least = least_x(cluster.members, cluster.count, a->scan->shot->width);
  CS_TRY(cs_window_reach(a->window, least_x(begins, begin_count, least)));
  CS_TRY(cs_cluster_replay(&cluster));
  cs_window_pass(a->window, &a->scan->cells.cells[high]);
  return CELSPAN_OK;
}

/* The begins that belong to a block, in room of their own. */
static celspan_status pick_begins(area *a, const block *b, cs_member **begins, size_t *count) {
  *count = 0;
  *begins = take(a, a->begin_count, sizeof **begins);
  if (!*begins)
    return CELSPAN_NO_MEMORY;
  for (size_t k = 0; k < a->begin_count; k++)
    if (a->begin_low[k] >= b->low && a->begin_low[k] <= b->last_low)
      (*begins)[(*count)++] = a->begins[k];
  return CELSPAN_OK;
}

/* A row with events: every boundary is crossed, so that each block knows what is present. */
static celspan_status walk_events(area *a) {
  cs_scan *scan = a->scan;
  const cs_active *active = &scan->active;
  size_t visible = 0, next = 0;
  for (size_t i = 0; i <= active->count;) {
    if (next < a->block_count && a->blocks[next].low == i) {
      const block *b = &a->blocks[next++];
      cs_member *begins;
      size_t begin_count;
      CS_TRY(pick_begins(a, b, &begins, &begin_count));
      CS_TRY(walk_block(a, b->low, b->high, begins, begin_count));
      for (; i < b->high; i++) {
        const cs_boundary_chain *chain = cs_active_chain(active, i);
        cs_composer_cross(&scan->composer, chain->leaf, chain->direction);
      }
      if (b->low < b->high)
        continue;
    }
    if (i == active->count)
      break;
    while (visible < scan->cells.visible_count && scan->cells.visible[visible] < i)
      visible++;
    if (visible < scan->cells.visible_count && scan->cells.visible[visible] == i)
      CS_TRY(walk_alone(a, i));
    const cs_boundary_chain *chain = cs_active_chain(active, i);
    cs_composer_cross(&scan->composer, chain->leaf, chain->direction);
    i++;
  }
  return CELSPAN_OK;
}

static celspan_status walk_plain(area *a) {
  const cs_cells *cells = &a->scan->cells;
  for (size_t v = 0; v < cells->visible_count; v++)
    CS_TRY(walk_alone(a, cells->visible[v]));
  return CELSPAN_OK;
}

static bool is_sorted(const double *x, size_t count) {
  int falls = 0;
  for (size_t i = 1; i < count; i++)
    falls |= x[i - 1] > x[i];
  return !falls;
}

static celspan_status walk_row(area *a) {
  const cs_active *active = &a->scan->active;
  const cs_boundary_set *set = active->set;
  bool begins = active->next < set->chain_count && set->chains[active->next].y0 < a->y1;
  if (!begins && active->bend_count == 0 && is_sorted(active->x_next, active->count))
    return walk_plain(a);
  CS_TRY(measure_ranges(a));
  CS_TRY(find_begins(a));
  find_events(a);
  CS_TRY(add_swaps(a));
  CS_TRY(add_bends(a));
  CS_TRY(add_events(a));
  merge_blocks(a);
  return a->block_count > 0 ? walk_events(a) : walk_plain(a);
}

/* ---------------------------------------------------------------- rows with strips */

/* The edges of one of a row's heights, as members that live for its share of the row. */
static celspan_status append_edges(area *a, const cs_strip_edges *edges, double y0, double y1) {
  cs_member *begins = take(a, a->begin_count + edges->count, sizeof *begins);
  celspan_point *points = take(a, 2 * edges->count, sizeof *points);
  if (!begins || !points)
    return CELSPAN_NO_MEMORY;
  if (a->begin_count > 0)
    memcpy(begins, a->begins, a->begin_count * sizeof *begins);
  for (size_t k = 0; k < edges->count; k++, points += 2) {
    const cs_strip_edge *edge = &edges->edges[k];
    points[0] = (celspan_point){edge->x, y0};
    points[1] = (celspan_point){edge->x, y1};
    begins[a->begin_count + k] =
        (cs_member){.points = points, .point_count = 2, .at = 1, .leaf = edge->leaf,
                    .strip = edge->strip, .order = 2 * edge->strip + (edge->direction < 0),
                    .direction = edge->direction, .x = edge->x, .y = y0, .foot = edge->x};
  }
  a->begins = begins;
  a->begin_count += edges->count;
  return CELSPAN_OK;
}

/* A row with scan-line primitives is one block: all of it is replayed. */
static celspan_status walk_strips(area *a) {
  CS_TRY(find_begins(a));
  for (int j = 0; j < CS_STRIPS_ROWS; j++) {
    cs_strip_edges edges = {0};
    double top = a->y0 + (double)j / CS_STRIPS_ROWS, foot = a->y0 + (j + 1.0) / CS_STRIPS_ROWS;
    CS_TRY(cs_strips_collect(a->scan, 0.5 * (top + foot), &edges));
    CS_TRY(append_edges(a, &edges, top, foot));
  }
  return walk_block(a, 0, a->scan->active.count, a->begins, a->begin_count);
}

celspan_status cs_area_row(cs_scan *scan, int32_t y, cs_row *out) {
  area a = {.scan = scan, .window = &scan->window, .y0 = y, .y1 = y + 1.0};
  CS_TRY(cs_active_reach(scan->context, &scan->active, a.y1));
  cs_window_begin(a.window, &scan->composer, &scan->arena, scan->shot->width, y,
                  scan->cells.cells, out);
  if (cs_strips_meet(scan, y))
    CS_TRY(walk_strips(&a));
  else
    CS_TRY(walk_row(&a));
  return cs_window_finish(a.window);
}
