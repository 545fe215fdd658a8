#include "engine/map/adding.h"
#include "engine/map/doubles.h"

/* ---------------------------------------------------------------- places */

typedef int32_t integers __attribute__((vector_size(16)));

#define FARTHEST (32767.0 * CS_MAP_UNIT)

/* No farther than an integer can be. What is drawn is at most 16384 pixels long, so that nothing
 * but borders that are left of the frame as a whole are bent by that. */
static inline cs_doubles bounded(cs_doubles v) {
#ifdef __AVX2__
  return _mm256_max_pd(_mm256_set1_pd(-FARTHEST), _mm256_min_pd(_mm256_set1_pd(FARTHEST), v));
#else
  for (int i = 0; i < 4; i++)
    v[i] = v[i] < -FARTHEST ? -FARTHEST : v[i] > FARTHEST ? FARTHEST : v[i];
  return v;
#endif
}

/* Rounded, except that numbers below 0 may be one greater: those are beyond the frame. */
static inline integers place_two(const cs_map_placing *p, integers points) {
  cs_doubles whole = cs_doubles_load(p->origin) + __builtin_convertvector(points, cs_doubles);
  return __builtin_convertvector(
      bounded(whole * cs_doubles_load(p->scale) + cs_doubles_load(p->shift)), integers);
}

void CS_WIDE(cs_map_put_places)(const cs_map_placing *placing, const cs_map_point *points,
                                size_t count, cs_map_point *out) {
  const cs_map_placing p = *placing;
  integers two = {0};
  for (; count > 1; count -= 2, points += 2, out += 2) {
    memcpy(&two, points, sizeof two);
    two = place_two(&p, two);
    memcpy(out, &two, sizeof two);
  }
  if (count > 0) {
    memcpy(&two, points, sizeof *points);
    two = place_two(&p, two);
    memcpy(out, &two, sizeof two);
  }
}

/* ---------------------------------------------------------------- a pixel */

/* What borders are added to: copies, which stay in registers. */
typedef struct target {
  cs_map_sum *sums;
  cs_map_keys *keys;
  uint64_t *bits;
  uint32_t words, width;
  int32_t top;    /* of the swath */
  bool is_inside; /* a constant of each caller: no place is left or right of the frame */
  bool varies;    /* another one: the areas of cells that vary are listed */
  cs_doubles step;
  uint64_t key;
  const cs_map_live *live;
} target;

/* Adds an area to that of the cell on the right, and takes it from that on the left, of those that
 * vary. */
static celspan_status add_parts(const cs_map_adding *a, const cs_map_live *live, uint32_t *head,
                                int32_t area, int32_t height) {
  const cs_map_drawing *drawing = a->rows->drawing;
  const cs_map_border *f = &drawing->lines->borders[live->border];
  cs_map_sums *all = a->sums;
  for (int side = 0; side < 2; side++) {
    int32_t sign = side == 0 ? -1 : 1;
    const cs_map_part part = {sign * area, sign * height, side == 0 ? f->left : f->right, *head};
    if (drawing->map->cells[part.cell].length == 0)
      continue;
    CS_TRY(CS_APPEND(a->context, all->parts, all->part_count, all->part_capacity, part));
    *head = (uint32_t)all->part_count;
  }
  return CELSPAN_OK;
}

/* Adds a line in one pixel. across: the width on its right, at its top and its foot together. */
static inline void add(const cs_map_adding *a, const target *t, uint32_t row, uint32_t column,
                       int32_t height, int32_t across) {
  const size_t index = CS_MAP_ROWS * (size_t)column + row;
  const uint64_t twice = (uint64_t)(uint32_t)height * (uint32_t)across;
  const int32_t area = (int32_t)((twice + CS_MAP_UNIT) / (2 * CS_MAP_UNIT));
  double *sum = t->sums[index].area;
  cs_doubles here = cs_doubles_load(sum) + (double)area * t->step;
  cs_doubles next = cs_doubles_load(sum + 4) + (double)height * t->step;
  memcpy(sum, &here, sizeof here);
  memcpy(sum + 4, &next, sizeof next);
  t->keys[index].area += (uint64_t)area * t->key;
  t->keys[index].height += (uint64_t)height * t->key;
  t->bits[row * t->words + column / 64] |= UINT64_C(1) << column % 64;
  if (t->varies && add_parts(a, t->live, &a->sums->heads[index], area, height))
    *a->status = CELSPAN_NO_MEMORY;
}

/* ---------------------------------------------------------------- a row */

/* A line over several columns, from its left end: from < to. Not inlined: the loop over lines needs
 * the registers. */
static __attribute__((noinline)) void add_columns(const cs_map_adding *a, const target *t,
                                                  uint32_t row, int32_t from, int32_t to,
                                                  int32_t height) {
  const double slope = (double)height / ((double)to - from);
  int32_t x = from, done = 0;
  if (!t->is_inside && from < 0) {
    x = 0;
    done = (int32_t)(-(double)from * slope + 0.5);
    add(a, t, row, 0, done, 2 * CS_MAP_UNIT);
  }
  uint32_t column = (uint32_t)x / CS_MAP_UNIT, end = (uint32_t)to / CS_MAP_UNIT;
  end = !t->is_inside && end > t->width ? t->width : end;
  for (; column < end; column++) {
    int32_t right = (int32_t)(column + 1) * CS_MAP_UNIT;
    int32_t all = (int32_t)((double)(right - from) * slope + 0.5);
    add(a, t, row, column, all - done, right - x);
    done = all;
    x = right;
  }
  if (t->is_inside || column < t->width)
    add(a, t, row, column, height - done, 2 * (int32_t)(column + 1) * CS_MAP_UNIT - x - to);
}

static inline void add_line(const cs_map_adding *a, const target *t, uint32_t row, int32_t xa,
                            int32_t xb, int32_t height) {
  int32_t column = xa >> 16;
  if (column == xb >> 16 && (t->is_inside || (uint32_t)column < t->width)) {
    add(a, t, row, (uint32_t)column, height, 2 * (column + 1) * CS_MAP_UNIT - xa - xb);
    return;
  }
  int32_t from = xa < xb ? xa : xb, to = xa < xb ? xb : xa;
  if (!t->is_inside && to < 0)
    add(a, t, row, 0, height, 2 * CS_MAP_UNIT);
  else if (t->is_inside || from >> 16 < (int32_t)t->width)
    add_columns(a, t, row, from, to, height);
}

/* ---------------------------------------------------------------- a border */

/* The part of a line that is in the swath, row by row. */
static inline void add_rows(const cs_map_adding *a, const target *t, cs_map_point above,
                            cs_map_point below) {
  const int32_t top = t->top, foot = top + CS_MAP_ROWS * CS_MAP_UNIT;
  const int32_t end = below.y < foot ? below.y : foot;
  int32_t x = above.x, y = above.y;
  double slope = 0;
  if (y < top || (y - top) >> 16 != (below.y - 1 - top) >> 16)
    slope = ((double)below.x - above.x) / ((double)below.y - above.y);
  if (y < top) {
    y = top;
    x = above.x + (int32_t)((double)(y - above.y) * slope);
  }
  while (y < end) {
    uint32_t row = (uint32_t)(y - top) / CS_MAP_UNIT;
    int32_t next_y = top + (int32_t)(row + 1) * CS_MAP_UNIT, next_x = below.x;
    if (next_y < below.y)
      next_x = above.x + (int32_t)((double)(next_y - above.y) * slope);
    else
      next_y = below.y;
    add_line(a, t, row, x, next_x, next_y - y);
    x = next_x;
    y = next_y;
  }
}

static inline void add_border(const cs_map_adding *a, cs_map_live *live, bool varies,
                              bool is_inside) {
  const cs_map_sums *s = a->sums;
  const cs_map_point *places = a->rows->places;
  const target t = {s->sums,
                    s->keys,
                    s->bits,
                    (uint32_t)s->words,
                    (uint32_t)s->width,
                    a->row * CS_MAP_UNIT,
                    is_inside,
                    varies,
                    cs_doubles_load(live->step),
                    live->key,
                    live};
  const int32_t top = t.top, foot = top + CS_MAP_ROWS * CS_MAP_UNIT;
  const uint32_t end = live->end;
  uint32_t at = live->at;
  cs_map_point above = places[at], below;
  for (; at + 1 < end && above.y < foot; above = below, at++) {
    below = places[at + 1];
    if (below.y > above.y && below.y > top)
      add_rows(a, &t, above, below);
    if (below.y > foot)
      break;
  }
  live->next = at;
}

void CS_WIDE(cs_map_add)(const cs_map_adding *adding) {
  cs_map_rows *rows = adding->rows;
  const int32_t end = adding->sums->width * CS_MAP_UNIT;
  for (size_t i = 0; i < rows->live_count; i++) {
    cs_map_live *live = &rows->lives[i];
    if (live->varies)
      add_border(adding, live, true, false);
    else if (live->low >= 0 && live->high < end)
      add_border(adding, live, false, true);
    else
      add_border(adding, live, false, false);
  }
}
