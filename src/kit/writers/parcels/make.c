/* Arcs become parcels.
 *
 *     above   |  1  |2| 1 |      at a height where arcs end, the ends of arcs that have fill 1 on a
 *           --a-----b-c---d--    side, in order: each two neighbours, a b and c d, are joined by a
 *     below      2     1         line, which may have no length. So each end has a partner, and
 *                                loops close.
 */
#include "writers/parcels/parcels.h"

#include <math.h>

#include "inside/sort.h"
#include "writers/parcels/making.h"

/* ---------------------------------------------------------------- arcs of a plane */

typedef struct collecting {
  celspan_context *context;
  const celspan_plane *plane;
  cs_fill_table table;
  cs_frame_sides sides;
  uint32_t *fills; /* fills of a band's cells; before, whether all borders face them */
  size_t capacity;
} collecting;

/* Of each cell, whether all its borders face it. */
static void find_faced(const planefile_band *band, uint32_t *is_faced) {
  for (uint32_t i = 0; i < band->cell_count; i++)
    is_faced[i] = true;
  for (uint32_t i = 0; i < band->border_count; i++) {
    const planefile_border *border = &band->borders[i];
    is_faced[border->left] &= planefile_faces(band, border, border->left);
    is_faced[border->right] &= planefile_faces(band, border, border->right);
  }
}

static celspan_status collect_part(collecting *g, const planefile_band *band, cs_parcels *out) {
  CS_TRY(CS_RESERVE(g->context, g->fills, g->capacity, band->cell_count));
  find_faced(band, g->fills);
  for (uint32_t i = 0; i < band->cell_count; i++)
    CS_TRY(cs_fill_find(g->context, g->plane, band, i, &g->table, out, &g->fills[i]));
  for (uint32_t i = 0; i < band->border_count; i++) {
    const planefile_border *border = &band->borders[i];
    uint32_t left = g->fills[border->left], right = g->fills[border->right];
    if (left != right)
      CS_TRY(cs_arc_put(g->context, band, border, left, right, &g->sides, out));
  }
  return CELSPAN_OK;
}

/* The first fill is clear; that of cell 0 is left and right of all borders, within the frame. */
static celspan_status collect(collecting *g, cs_parcels *out) {
  const planefile_plane *plane = g->plane->plane;
  const planefile_info info = planefile_plane_info(plane);
  uint32_t around = 0;
  out->width = info.width;
  out->height = info.height;
  CS_TRY(CS_ARRAY_APPEND(g->context, out->fills, out->fill_count, (cs_fill){0}));
  for (uint32_t i = 0; i < info.band_count; i++)
    CS_TRY(collect_part(g, planefile_plane_band(plane, i), out));
  CS_TRY(cs_fill_find(g->context, g->plane, planefile_plane_band(plane, 0), 0, &g->table, out,
                      &around));
  CS_TRY(cs_sides_add(g->context, &g->sides, 0, 0, PLANEFILE_SIDE, 0, around));
  CS_TRY(cs_sides_add(g->context, &g->sides, 1, 0, PLANEFILE_SIDE, around, 0));
  return cs_sides_put(g->context, &g->sides, out);
}

/* ---------------------------------------------------------------- heights */

/* Where one arc ends and the next one begins, a plane may have rounded their heights differently.
 * Heights that are so near become one. */
enum { NEAR = 1, TOGETHER = 4 }; /* units: two heights; all of them */

typedef struct arc_height {
  int32_t height;
  uint32_t id; /* 2 times the arc, plus 1 for the foot */
} arc_height;

static inline bool is_above(const arc_height *a, const arc_height *b) {
  return a->height != b->height ? a->height < b->height : a->id < b->id;
}
CS_SORT_DEFINE(sort_heights, arc_height, is_above)

static void set_height(cs_parcels *parcels, uint32_t id, int32_t height) {
  cs_parcel_arc *arc = &parcels->arcs[id / 2];
  cs_parcel_curve *first = &parcels->curves[arc->curve], *last = first + arc->curve_count - 1;
  double y = (double)height / PLANEFILE_SIDE * parcels->height;
  if (id & 1) {
    arc->foot = height;
    last->points[3].y = y;
  } else {
    arc->top = height;
    first->points[0].y = y;
  }
}

static celspan_status join_heights(celspan_context *context, cs_parcels *parcels) {
  const size_t count = 2 * parcels->arc_count;
  arc_height *all;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, all, count));
  for (uint32_t i = 0; i < count; i++) {
    const cs_parcel_arc *arc = &parcels->arcs[i / 2];
    all[i] = (arc_height){i & 1 ? arc->foot : arc->top, i};
  }
  sort_heights(all, count);
  int32_t first = all[0].height;
  for (size_t i = 1; i < count; i++) {
    bool is_near = all[i].height - all[i - 1].height <= NEAR && all[i].height - first <= TOGETHER;
    first = is_near ? first : all[i].height;
    if (all[i].height != first)
      set_height(parcels, all[i].id, first);
  }
  cs_mem_free(context->memory, all, count * sizeof *all);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- ends */

/* An end of an arc, for the fill on one of its sides. */
typedef struct arc_end {
  double x;
  uint32_t set;
  int32_t height;
  uint32_t id; /* 4 times the arc, plus 2 for the right side, plus 1 for the foot */
} arc_end;

static inline bool is_before(const arc_end *a, const arc_end *b) {
  if (a->set != b->set)
    return a->set < b->set;
  if (a->height != b->height)
    return a->height < b->height;
  return a->x != b->x ? a->x < b->x : a->id < b->id;
}
CS_SORT_DEFINE(sort_ends, arc_end, is_before)

static celspan_point point_of(const cs_parcels *parcels, uint32_t arc, bool is_foot) {
  const cs_parcel_arc *a = &parcels->arcs[arc];
  return is_foot ? parcels->curves[a->curve + a->curve_count - 1].points[3]
                 : parcels->curves[a->curve].points[0];
}

celspan_point cs_parcel_begin(const cs_parcels *parcels, cs_parcel_walk walk) {
  return point_of(parcels, walk.arc, walk.is_up);
}

celspan_point cs_parcel_end(const cs_parcels *parcels, cs_parcel_walk walk) {
  return point_of(parcels, walk.arc, !walk.is_up);
}

void cs_parcel_draw_arc(const cs_parcels *parcels, cs_parcel_walk walk,
                        const cs_parcel_stylus *stylus) {
  const cs_parcel_arc *arc = &parcels->arcs[walk.arc];
  for (size_t i = 0; i < arc->curve_count; i++) {
    size_t at = walk.is_up ? arc->curve_count - 1 - i : i;
    const cs_parcel_curve *curve = &parcels->curves[arc->curve + at];
    const celspan_point *p = curve->points;
    if (curve->is_line)
      stylus->line(stylus->user, p[walk.is_up ? 0 : 3]);
    else
      stylus->curve(stylus->user, walk.is_up ? (celspan_point[3]){p[2], p[1], p[0]} : p + 1);
  }
}

void cs_parcel_draw_loop(const cs_parcels *parcels, const cs_parcel_loop *loop,
                         const cs_parcel_stylus *stylus) {
  const cs_parcel_walk *walks = &parcels->walks[loop->walk];
  stylus->move(stylus->user, cs_parcel_begin(parcels, walks[0]));
  for (size_t k = 0; k < loop->walk_count; k++) {
    stylus->line(stylus->user, cs_parcel_begin(parcels, walks[k]));
    cs_parcel_draw_arc(parcels, walks[k], stylus);
  }
  stylus->close_path(stylus->user);
}

/* Returns how many there are. */
static size_t list_ends(const cs_parcels *parcels, const uint32_t *sets, arc_end *out) {
  size_t count = 0;
  for (uint32_t i = 0; i < parcels->arc_count; i++) {
    const cs_parcel_arc *arc = &parcels->arcs[i];
    const uint32_t sides[2] = {sets[arc->left], sets[arc->right]};
    for (uint32_t side = 0; side < 2 && sides[0] != sides[1]; side++)
      for (uint32_t foot = 0; foot < 2 && sides[side] > 0; foot++)
        out[count++] = (arc_end){.x = point_of(parcels, i, foot).x,
                                 .set = sides[side],
                                 .height = foot ? arc->foot : arc->top,
                                 .id = 4 * i + 2 * side + foot};
  }
  return count;
}

/* ---------------------------------------------------------------- loops */

typedef struct tracing {
  celspan_context *context;
  cs_parcels *parcels;
  arc_end *ends;
  uint32_t *partners; /* by id; of an end that has been walked itself */
  size_t count;
  int32_t apart; /* heights that may become one */
} tracing;

/* The end of those at one height from an end on; at several heights, which become one, if their
 * number is odd. */
static size_t find_group(const tracing *t, size_t first) {
  size_t end = first;
  int32_t height = t->ends[first].height, last = height;
  do {
    last = t->ends[end].height;
    for (; end < t->count && t->ends[end].set == t->ends[first].set && t->ends[end].height == last;
         end++)
      t->ends[end].height = height;
  } while ((end - first) % 2 == 1 && end < t->count && t->ends[end].set == t->ends[first].set &&
           t->ends[end].height - height <= t->apart);
  if (last != height)
    sort_ends(t->ends + first, end - first);
  return end;
}

/* Whether a walk of the set goes away from an end: an arc with the set on its right is walked down,
 * another one up. */
static bool is_begin(uint32_t id) { return (id & 2) ? !(id & 1) : id & 1; }

/* At one place ends are in any order: puts one to which the first one leads, or comes from, after
 * it. */
static void pair_first(arc_end *ends, size_t count) {
  size_t other = 1;
  while (other < count && is_begin(ends[other].id) == is_begin(ends[0].id))
    other++;
  for (; other > 1 && other < count; other--) {
    arc_end moved = ends[other];
    ends[other] = ends[other - 1];
    ends[other - 1] = moved;
  }
}

/* Each two neighbours of a set at one height are partners. */
static celspan_status join_ends(const tracing *t) {
  for (size_t i = 0, end; i < t->count; i = end) {
    end = find_group(t, i);
    if ((end - i) % 2 == 1)
      return cs_fail(t->context, CELSPAN_BAD_ARGUMENT,
                     "the borders of an area do not meet, "
                     "so that it has no vectors: write a picture");
    for (; i < end; i += 2) {
      pair_first(t->ends + i, end - i);
      t->partners[t->ends[i].id] = t->ends[i + 1].id;
      t->partners[t->ends[i + 1].id] = t->ends[i].id;
    }
  }
  return CELSPAN_OK;
}

/* Walks from an end until it comes back to it. */
static celspan_status walk_loop(const tracing *t, uint32_t first) {
  cs_parcels *p = t->parcels;
  cs_parcel_loop loop = {p->walk_count, 0};
  for (uint32_t from = first;;) {
    uint32_t to = from ^ 1, next = t->partners[to];
    CS_TRY(
        CS_ARRAY_APPEND(t->context, p->walks, p->walk_count, (cs_parcel_walk){from / 4, from & 1}));
    t->partners[from] = from;
    t->partners[to] = to;
    if (next == first)
      break;
    from = next;
  }
  loop.walk_count = p->walk_count - loop.walk;
  return CS_ARRAY_APPEND(t->context, p->loops, p->loop_count, loop);
}

static celspan_status walk_all(const tracing *t, uint32_t set_count, size_t *first) {
  uint32_t set = 0;
  for (size_t i = 0; i < t->count; i++) {
    uint32_t id = t->ends[i].id;
    for (; set < t->ends[i].set; set++)
      first[set] = t->parcels->loop_count;
    if (is_begin(id) && t->partners[id] != id)
      CS_TRY(walk_loop(t, id));
  }
  for (; set <= set_count; set++)
    first[set] = t->parcels->loop_count;
  return CELSPAN_OK;
}

celspan_status cs_parcels_walk(celspan_context *context, cs_parcels *parcels, const uint32_t *sets,
                               uint32_t set_count, size_t *first) {
  const size_t most = 4 * parcels->arc_count + 1;
  tracing t = {context, parcels, NULL, NULL, 0, cs_parcels_apart(parcels)};
  celspan_status status = CS_MAKE(context, t.ends, most);
  if (status == CELSPAN_OK)
    status = CS_MAKE(context, t.partners, most);
  if (status == CELSPAN_OK) {
    t.count = list_ends(parcels, sets, t.ends);
    sort_ends(t.ends, t.count);
    status = join_ends(&t);
  }
  if (status == CELSPAN_OK)
    status = walk_all(&t, set_count, first);
  cs_mem_free(context->memory, t.ends, most * sizeof *t.ends);
  cs_mem_free(context->memory, t.partners, most * sizeof *t.partners);
  return status;
}

/* ---------------------------------------------------------------- parcels */

/* Each fill but the first one is a set. */
static celspan_status walk_fills(celspan_context *context, cs_parcels *p) {
  const size_t count = p->fill_count;
  uint32_t *sets;
  size_t *first;
  CS_TRY(CS_MAKE(context, sets, count));
  celspan_status status = CS_MAKE(context, first, count + 1);
  for (uint32_t i = 0; i < count; i++)
    sets[i] = i;
  if (status == CELSPAN_OK)
    status = cs_parcels_walk(context, p, sets, (uint32_t)count, first);
  for (size_t i = 1; i < count && status == CELSPAN_OK; i++) {
    p->fills[i].loop = first[i - 1];
    p->fills[i].loop_count = first[i] - first[i - 1];
  }
  cs_mem_free(context->memory, sets, count * sizeof *sets);
  cs_mem_free(context->memory, first, (count + 1) * sizeof *first);
  return status;
}

celspan_status cs_parcels_make(celspan_context *context, const celspan_plane *plane,
                               cs_parcels *out) {
  const planefile_info info = planefile_plane_info(plane->plane);
  collecting g = {.context = context, .plane = plane};
  *out = (cs_parcels){.columns = (int32_t)(PLANEFILE_SIDE / planefile_steps(info.grid.columns)),
                      .rows = (int32_t)(PLANEFILE_SIDE / planefile_steps(info.grid.rows))};
  celspan_status status = collect(&g, out);
  cs_sides_finish(&g.sides, context->memory);
  cs_hash_table_finish(&g.table.known, context);
  cs_mem_free(context->memory, g.fills, g.capacity * sizeof *g.fills);
  CS_TRY(status);
  CS_TRY(join_heights(context, out));
  if (!info.is_coded) /* sums are no codes */
    status = cs_parcels_refuse_sums(context, out);
  out->is_sum = status == CELSPAN_BAD_ARGUMENT;
  CS_TRY(status);
  CS_TRY(cs_parcels_join_slivers(context, out));
  CS_TRY(walk_fills(context, out));
  return cs_joints_make(context, out);
}

void cs_parcels_finish(cs_parcels *p, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, p, fills, loops);
  *p = (cs_parcels){0};
}
