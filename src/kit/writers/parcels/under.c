#include "writers/parcels/under.h"

#include <math.h>

#include "inside/sort.h"
#include "writers/parcels/making.h"

enum { VISITS = 5 /* heights at which an arc is compared with those beside it */, GRADES = 8 };

/* ---------------------------------------------------------------- thickness */

static double distance(celspan_point a, celspan_point b) {
  return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

/* The integral of x over the height of a curve; the points of a line make one, too. */
static double area_of(const celspan_point p[4]) {
  return (p[0].x * (-10 * p[0].y + 6 * p[1].y + 3 * p[2].y + p[3].y) +
          p[1].x * (-6 * p[0].y + 3 * p[2].y + 3 * p[3].y) +
          p[2].x * (-3 * p[0].y - 3 * p[1].y + 6 * p[3].y) +
          p[3].x * (-p[0].y - 3 * p[1].y - 6 * p[2].y + 10 * p[3].y)) /
         20;
}

static double length_of(const celspan_point p[4]) {
  double around = distance(p[0], p[1]) + distance(p[1], p[2]) + distance(p[2], p[3]);
  return (distance(p[0], p[3]) + around) / 2;
}

/* The area and the perimeter of a loop; a hole has an area below 0. */
static void measure(const cs_parcels *parcels, const cs_parcel_loop *loop, double *area,
                    double *length) {
  const cs_parcel_walk *walks = &parcels->walks[loop->walk];
  celspan_point at = cs_parcel_end(parcels, walks[loop->walk_count - 1]);
  *area = *length = 0;
  for (size_t k = 0; k < loop->walk_count; k++) {
    const cs_parcel_arc *arc = &parcels->arcs[walks[k].arc];
    *length += distance(at, cs_parcel_begin(parcels, walks[k]));
    at = cs_parcel_end(parcels, walks[k]);
    for (size_t c = arc->curve; c < arc->curve + arc->curve_count; c++) {
      *area += (walks[k].is_up ? 1 : -1) * area_of(parcels->curves[c].points);
      *length += length_of(parcels->curves[c].points);
    }
  }
}

/* Of all of a fill, and of each of its loops, whose outline may be of a thinner part. */
static double measure_fill(const cs_parcels *parcels, const cs_fill *fill, double *loops,
                           double *area) {
  double length = 0;
  *area = 0;
  for (size_t i = fill->loop; i < fill->loop + fill->loop_count; i++) {
    double one[2];
    measure(parcels, &parcels->loops[i], &one[0], &one[1]);
    loops[i] = one[0] < 0 ? INFINITY : one[1] > 0 ? one[0] / one[1] : 0;
    *area += one[0];
    length += one[1];
  }
  double whole = fill->kind == CS_FILL_PICTURE ? -INFINITY /* it cannot be a stroke */
                 : !(length > 0)               ? -1
                                               : *area / length;
  for (size_t i = fill->loop; i < fill->loop + fill->loop_count; i++)
    loops[i] = fmin(loops[i], whole);
  return whole;
}

typedef struct ranked {
  double thickness;
  uint32_t fill;
} ranked;

static inline bool is_thinner(const ranked *a, const ranked *b) {
  return a->thickness != b->thickness ? a->thickness < b->thickness : a->fill < b->fill;
}
CS_SORT_DEFINE(sort_ranked, ranked, is_thinner)

/* A picture counts as the thinnest, because no stroke can show it. */
static celspan_status rank_fills(celspan_context *context, const cs_parcels *parcels,
                                 cs_under *out) {
  const size_t count = parcels->fill_count;
  ranked *all;
  CS_TRY(CS_MAKE(context, out->order, count));
  CS_TRY(CS_MAKE(context, out->ranks, count));
  CS_TRY(CS_MAKE(context, out->loops, out->loop_count));
  CS_TRY(CS_MAKE(context, all, count));
  for (uint32_t i = 0; i < count; i++) {
    const cs_fill *fill = &parcels->fills[i];
    double area;
    all[i] = (ranked){measure_fill(parcels, fill, out->loops, &area), i};
    out->opaque += cs_under_suits(fill) ? area : 0;
  }
  sort_ranked(all, count);
  for (uint32_t i = 0; i < count; i++) {
    out->order[i] = all[i].fill;
    out->ranks[all[i].fill] = i;
  }
  cs_mem_free(context->memory, all, count * sizeof *all);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- horizontal lines */

/* A horizontal part of a parcel's outline. */
typedef struct flat_line {
  double y, x0, x1;
  bool is_floor; /* the parcel is above it */
  uint32_t fill;
  double thickness; /* the thickness of its loop */
} flat_line;

static inline bool is_before(const flat_line *a, const flat_line *b) {
  if (a->y != b->y)
    return a->y < b->y;
  if (a->is_floor != b->is_floor)
    return a->is_floor;
  return a->x0 != b->x0 ? a->x0 < b->x0 : a->fill < b->fill;
}
CS_SORT_DEFINE(sort_flats, flat_line, is_before)

typedef struct flat_list {
  const double *thickness; /* the thickness of loops */
  flat_line *all;
  size_t count, capacity;
} flat_list;

/* The walker has the parcel on the left: above a line to the right, below a line to the left. */
static celspan_status list_flats(celspan_context *context, const cs_parcels *parcels,
                                 flat_list *out) {
  for (uint32_t f = 1; f < parcels->fill_count; f++) {
    const cs_fill *fill = &parcels->fills[f];
    for (size_t i = 0; i < fill->loop_count && cs_under_suits(fill); i++) {
      const cs_parcel_loop *loop = &parcels->loops[fill->loop + i];
      const cs_parcel_walk *walks = &parcels->walks[loop->walk];
      celspan_point at = cs_parcel_end(parcels, walks[loop->walk_count - 1]);
      for (size_t k = 0; k < loop->walk_count; k++) {
        celspan_point to = cs_parcel_begin(parcels, walks[k]);
        flat_line line = {to.y,
                          fmin(at.x, to.x),
                          fmax(at.x, to.x),
                          to.x > at.x,
                          f,
                          out->thickness[fill->loop + i]};
        if (line.x0 < line.x1)
          CS_TRY(CS_APPEND(context, out->all, out->count, out->capacity, line));
        at = cs_parcel_end(parcels, walks[k]);
      }
    }
  }
  sort_flats(out->all, out->count);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- lines */

/* The rank of the fill that is thicker at a border. */
static uint32_t rank_of(const cs_under *under, const uint32_t fills[2], const double thickness[2]) {
  uint32_t a = under->ranks[fills[0]], b = under->ranks[fills[1]];
  return thickness[0] > thickness[1] || (thickness[0] == thickness[1] && a > b) ? a : b;
}

/* Puts what floors and ceilings at one height have in common. */
static celspan_status pair_flats(celspan_context *context, const flat_line *floors, size_t count,
                                 const flat_line *ceilings, size_t ceiling_count, cs_under *out) {
  for (size_t i = 0, k = 0; i < count && k < ceiling_count;) {
    const flat_line *a = &floors[i], *b = &ceilings[k];
    double x0 = fmax(a->x0, b->x0), x1 = fmin(a->x1, b->x1);
    const uint32_t fills[2] = {a->fill, b->fill};
    const double thickness[2] = {a->thickness, b->thickness};
    const cs_under_line line = {.rank = rank_of(out, fills, thickness),
                                .is_flat = true,
                                .from = {x0, a->y},
                                .to = {x1, a->y}};
    if (x0 < x1 && a->fill != b->fill)
      CS_TRY(CS_APPEND(context, out->lines, out->line_count, out->line_capacity, line));
    if (a->x1 < b->x1)
      i++;
    else
      k++;
  }
  return CELSPAN_OK;
}

static celspan_status put_flats(celspan_context *context, const flat_list *flats, cs_under *out) {
  for (size_t i = 0; i < flats->count;) {
    size_t floors = i, end;
    while (floors < flats->count && flats->all[floors].y == flats->all[i].y &&
           flats->all[floors].is_floor)
      floors++;
    for (end = floors; end < flats->count && flats->all[end].y == flats->all[i].y; end++) {
    }
    CS_TRY(pair_flats(context, flats->all + i, floors - i, flats->all + floors, end - floors, out));
    i = end;
  }
  return CELSPAN_OK;
}

/* The thickness of the loops on both sides of all arcs, left and right. */
static void spread(const cs_parcels *parcels, const cs_under *under, double *out) {
  for (uint32_t f = 1; f < parcels->fill_count; f++) {
    const cs_fill *fill = &parcels->fills[f];
    for (size_t i = fill->loop; i < fill->loop + fill->loop_count; i++)
      for (size_t k = 0; k < parcels->loops[i].walk_count; k++) {
        uint32_t arc = parcels->walks[parcels->loops[i].walk + k].arc;
        out[2 * arc + (parcels->arcs[arc].right == f)] = under->loops[i];
      }
  }
}

/* How thick the areas on both sides of arcs are beside them: 0 is nothing, and GRADES as thick as
 * it must be, or thicker. 2 of each arc, left and right. */
typedef struct narrowing {
  double thin, *grades;
} narrowing;

static celspan_status narrow(const cs_beside *row, size_t place, void *user) {
  const narrowing *n = user;
  for (size_t side = 0; side < 2; side++) {
    const bool has_other = side == 0 ? place > 0 : place + 1 < row->count;
    const double gap = has_other ? cs_beside_gap(row, place, side == 0 ? place - 1 : place + 1) : 0;
    n->grades[2 * row->arcs[place] + side] += fmin(gap / n->thin, 1) * GRADES / VISITS;
  }
  return CELSPAN_OK;
}

/* What is as thick beside the arc is compared as a whole; so is a picture, which is no stroke. */
static uint32_t rank_beside(const cs_under *under, const uint32_t fills[2], const double loops[2],
                            const double grades[2]) {
  const double left = round(grades[0]), right = round(grades[1]);
  if (left == right || fmin(loops[0], loops[1]) == -INFINITY)
    return rank_of(under, fills, loops);
  return under->ranks[fills[left > right ? 0 : 1]];
}

static celspan_status put_arc(celspan_context *context, const cs_parcels *parcels, uint32_t arc,
                              const double *loops, const double *grades, cs_under *out) {
  const uint32_t fills[2] = {parcels->arcs[arc].left, parcels->arcs[arc].right};
  const uint32_t rank = rank_beside(out, fills, loops, grades);
  const double grade = grades[rank == out->ranks[fills[0]] ? 0 : 1];
  const cs_under_line line = {.rank = rank, .is_thin = round(grade) < GRADES, .arc = arc};
  if (!cs_under_suits(&parcels->fills[fills[0]]) || !cs_under_suits(&parcels->fills[fills[1]]))
    return CELSPAN_OK;
  return CS_APPEND(context, out->lines, out->line_count, out->line_capacity, line);
}

static celspan_status put_arcs(celspan_context *context, const cs_parcels *parcels, double thin,
                               cs_under *out) {
  const size_t count = 2 * parcels->arc_count;
  double *loops, *grades = NULL;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, loops, count));
  celspan_status status = CS_MAKE(context, grades, count);
  if (status == CELSPAN_OK) {
    spread(parcels, out, loops);
    status = cs_beside_walk(context, parcels, VISITS, narrow, &(narrowing){thin, grades});
  }
  for (uint32_t i = 0; i < parcels->arc_count && status == CELSPAN_OK; i++)
    status = put_arc(context, parcels, i, loops + 2 * (size_t)i, grades + 2 * (size_t)i, out);
  cs_mem_free(context->memory, loops, count * sizeof *loops);
  cs_mem_free(context->memory, grades, count * sizeof *grades);
  return status;
}

static inline bool is_under(const cs_under_line *a, const cs_under_line *b) {
  if (a->is_thin != b->is_thin)
    return a->is_thin;
  if (a->rank != b->rank)
    return a->rank < b->rank;
  if (a->is_flat != b->is_flat || !a->is_flat)
    return a->is_flat != b->is_flat ? b->is_flat : a->arc < b->arc;
  return a->from.y != b->from.y ? a->from.y < b->from.y : a->from.x < b->from.x;
}
CS_SORT_DEFINE(sort_lines, cs_under_line, is_under)

celspan_status cs_under_make(celspan_context *context, const cs_parcels *parcels, double thin,
                             cs_under *out) {
  flat_list flats = {0};
  *out = (cs_under){.fill_count = parcels->fill_count, .loop_count = parcels->loop_count + 1};
  CS_TRY(rank_fills(context, parcels, out));
  if (!(thin > 0))
    return CELSPAN_OK;
  CS_TRY(put_arcs(context, parcels, thin, out));
  flats.thickness = out->loops;
  celspan_status status = list_flats(context, parcels, &flats);
  if (status == CELSPAN_OK)
    status = put_flats(context, &flats, out);
  cs_mem_free(context->memory, flats.all, flats.capacity * sizeof *flats.all);
  sort_lines(out->lines, out->line_count);
  return status;
}

void cs_under_draw(const cs_parcels *parcels, const cs_under_line *line,
                   const cs_parcel_stylus *stylus) {
  const cs_parcel_walk walk = {line->arc, false};
  stylus->move(stylus->user, line->is_flat ? line->from : cs_parcel_begin(parcels, walk));
  if (line->is_flat)
    stylus->line(stylus->user, line->to);
  else
    cs_parcel_draw_arc(parcels, walk, stylus);
}

void cs_under_finish(cs_under *under, cs_memory *memory) {
  cs_mem_free(memory, under->order, under->fill_count * sizeof *under->order);
  cs_mem_free(memory, under->ranks, under->fill_count * sizeof *under->ranks);
  cs_mem_free(memory, under->loops, under->loop_count * sizeof *under->loops);
  cs_mem_free(memory, under->lines, under->line_capacity * sizeof *under->lines);
  *under = (cs_under){0};
}
