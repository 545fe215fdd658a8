#include "engine/area/dense.h"

#include "base/number.h"
#include "engine/paint/colours.h"

#define SUB_ROWS 64   /* sub-rows of a whole row */
#define TOGETHER 8    /* sub-rows for which the members are visited together */
#define PARTS 256     /* parts into which the width of a pixel is divided */
#define LEAST 2048    /* the least number of boundaries of a dense interval */
#define DIGIT_BITS 11 /* in sorting */
#define DIGIT (1 << DIGIT_BITS)

void cs_dense_finish(cs_dense *dense, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, dense, places, sums);
  *dense = (cs_dense){0};
}

bool cs_dense_suits(size_t members, double extent) {
  return members >= LEAST && (double)members > CS_DENSE_A_PIXEL * (extent + 1);
}

/* The pixels of an interval, and the number of its members. */
typedef struct drawing {
  cs_dense *dense;
  cs_local_sweep *sweep;
  celspan_context *context;
  int32_t first, count; /* pixels */
  size_t members;
  double centre; /* the centre of the row */
} drawing;

/* ---------------------------------------------------------------- places */

/* x of a member at a height that the member goes through. Heights may only increase from call to
 * call. */
static double x_at(cs_member *member, double y) {
  while (member->points[member->at].y < y)
    member->at++;
  const celspan_point *above = &member->points[member->at - 1], *below = above + 1;
  return above->x + (y - above->y) * ((below->x - above->x) / (below->y - above->y));
}

static inline bool is_there(const cs_member *member, double y) {
  return member->points[0].y < y && member->points[member->point_count - 1].y >= y;
}

/* Consecutive sub-rows: their heights, and the number of places in each. Sub-row k has the k-th
 * part of the places, with room for all members. */
typedef struct sub_rows {
  int count; /* TOGETHER at most */
  double y[TOGETHER];
  size_t places[TOGETHER];
} sub_rows;

static void add_place(const drawing *d, sub_rows *rows, int k, size_t i, double x) {
  cs_dense_place *places = d->dense->places + (size_t)k * d->members;
  double from = cs_number_clamp(x - d->first, 0, d->count);
  places[rows->places[k]++] = (cs_dense_place){(uint32_t)(from * PARTS + 0.5), (uint32_t)i};
}

/* Finds the places of the members in sub-rows. Members are many and far apart in memory, so each
 * member is fetched only once for all of these sub-rows. */
static void find_places(const drawing *d, sub_rows *rows) {
  for (size_t i = 0; i < d->members; i++) {
    cs_member *member = cs_local_sweep_member(d->sweep, i);
    for (int k = 0; k < rows->count; k++)
      if (is_there(member, rows->y[k]))
        add_place(d, rows, k, i, x_at(member, rows->y[k]));
  }
}

/* Sorts by one digit of x. Members with the same digit keep their order. */
static void sort_digit(const cs_dense_place *from, cs_dense_place *to, size_t count, int shift) {
  uint32_t ends[DIGIT] = {0};
  for (size_t i = 0; i < count; i++)
    ends[from[i].x >> shift & (DIGIT - 1)]++;
  for (uint32_t value = 0, end = 0; value < DIGIT; value++)
    end = ends[value] += end;
  for (size_t i = count; i-- > 0;)
    to[--ends[from[i].x >> shift & (DIGIT - 1)]] = from[i];
}

/* Sorts places by x, from the lowest digit on. Returns the array in which the sorted places are. */
static const cs_dense_place *sort_places(const drawing *d, cs_dense_place *places, size_t count) {
  cs_dense_place *spare = d->dense->spare;
  for (int shift = 0; (uint64_t)d->count * PARTS >> shift != 0; shift += DIGIT_BITS) {
    sort_digit(places, spare, count, shift);
    cs_dense_place *kept = places;
    places = spare;
    spare = kept;
  }
  return places;
}

/* ---------------------------------------------------------------- sub-rows */

static inline void cross(const drawing *d, const cs_dense_place *place, int32_t sign) {
  cs_member_cross(cs_local_sweep_member(d->sweep, place->member), d->sweep->composer, sign);
}

static celspan_status colour_of(const drawing *d, const cs_cell *cell, int32_t pixel,
                                cs_sum4 *colour) {
  float rgba[1][4];
  const cs_run run = {d->first + pixel, d->first + pixel + 1, d->centre};
  *colour = CS_SUM4(cell->colour);
  if (cell->length == 0)
    return CELSPAN_OK;
  CS_TRY(cs_painter_colours(d->sweep->target->window.painter, cell, run, rgba));
  *colour = CS_SUM4(cs_v4_load(rgba[0]));
  return CELSPAN_OK;
}

/* Adds the cell at the composer's place to the pixels from one part to another. */
static celspan_status add_cell(const drawing *d, uint32_t from, uint32_t to) {
  cs_cell cell;
  if (from == to)
    return CELSPAN_OK;
  cs_composer_cell(d->sweep->composer, &cell);
  for (uint32_t end; from < to; from = end) {
    int32_t pixel = (int32_t)(from / PARTS);
    cs_sum4 colour;
    end = (uint32_t)(pixel + 1) * PARTS < to ? (uint32_t)(pixel + 1) * PARTS : to;
    CS_TRY(colour_of(d, &cell, pixel, &colour));
    d->dense->sums[pixel] += colour * (double)(end - from);
  }
  return CELSPAN_OK;
}

/* Adds the cells at a height, between `count` places, to all pixels. */
static celspan_status add_sub_row(const drawing *d, cs_dense_place *unsorted, size_t count) {
  cs_local_sweep *sweep = d->sweep;
  const cs_dense_place *places = sort_places(d, unsorted, count);
  celspan_status status = CELSPAN_OK;
  uint32_t from = 0;
  size_t i = 0;
  for (; i < count && status == CELSPAN_OK; i++) {
    status = add_cell(d, from, places[i].x);
    from = places[i].x;
    cross(d, &places[i], 1);
    cs_deferred_forward(&sweep->deferred, sweep->composer, d->first + (double)from / PARTS);
  }
  if (status == CELSPAN_OK)
    status = add_cell(d, from, (uint32_t)d->count * PARTS);
  while (i-- > 0)
    cross(d, &places[i], -1);
  cs_deferred_to(&sweep->deferred, sweep->composer, -INFINITY);
  return status == CELSPAN_OK ? sweep->composer->failure : status;
}

/* Adds the cells of sub-rows first .. end - 1 of `all`. */
static celspan_status add_sub_rows(const drawing *d, int first, int end, int all) {
  double height = d->sweep->y1 - d->sweep->y0;
  sub_rows rows = {.count = end - first};
  for (int k = 0; k < rows.count; k++)
    rows.y[k] = d->sweep->y0 + height * (first + k + 0.5) / all;
  find_places(d, &rows);
  for (int k = 0; k < rows.count; k++)
    CS_TRY(add_sub_row(d, d->dense->places + (size_t)k * d->members, rows.places[k]));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- cells */

static celspan_status add_border(const drawing *d, int32_t column, const cs_cell *left,
                                 const cs_cell *right) {
  const cs_border border = {{column, d->sweep->y0, column, d->sweep->y1}, left, right};
  if (cs_composer_same(d->sweep->composer, left, right))
    return CELSPAN_OK;
  return cs_target_add(d->sweep->target, &border);
}

/* Draws every pixel as a cell of its mean colour. */
static celspan_status draw_means(const drawing *d, int all, const cs_cell *right) {
  const cs_cell *left = d->sweep->left;
  cs_cell *cells = cs_arena_take(d->context, d->sweep->arena, (size_t)d->count * sizeof *cells);
  if (!cells)
    return CELSPAN_NO_MEMORY;
  for (int32_t i = 0; i < d->count; i++) {
    cs_sum4 mean = d->dense->sums[i] * (1.0 / (PARTS * all));
    cells[i] = (cs_cell){.colour = cs_v4_settled(__builtin_convertvector(mean, cs_v4))};
    CS_TRY(add_border(d, d->first + i, left, &cells[i]));
    left = &cells[i];
  }
  return add_border(d, d->first + d->count, left, right);
}

static celspan_status reserve(const drawing *d) {
  cs_dense *dense = d->dense;
  CS_TRY(CS_ARRAY_RESERVE(d->context, dense->places, TOGETHER * d->members));
  CS_TRY(CS_ARRAY_RESERVE(d->context, dense->spare, d->members));
  return CS_ARRAY_RESERVE(d->context, dense->sums, (size_t)d->count);
}

celspan_status cs_dense_draw(cs_dense *dense, cs_local_sweep *sweep, cs_extent extent,
                             const cs_cell *right) {
  const int32_t width = sweep->target->window.width;
  drawing d = {.dense = dense,
               .sweep = sweep,
               .context = sweep->composer->context,
               .first = cs_edges_floor(extent.low, width),
               .members = sweep->count + sweep->begin_count,
               .centre = floor(sweep->y0) + 0.5};
  double height = sweep->y1 - sweep->y0;
  int all = height * SUB_ROWS > 1 ? (int)(height * SUB_ROWS) : 1; /* sub-rows */
  d.count = cs_edges_ceil(extent.high, width) - d.first;
  CS_TRY(reserve(&d));
  if (d.count > 0) /* otherwise no member is in the frame, and the room may not exist yet */
    memset(dense->sums, 0, (size_t)d.count * sizeof *dense->sums);
  for (int first = 0, end; first < all; first = end) {
    end = first + TOGETHER < all ? first + TOGETHER : all;
    CS_TRY(add_sub_rows(&d, first, end, all));
  }
  return draw_means(&d, all, right);
}
