#include "engine/map/adding.h"

/* ---------------------------------------------------------------- places */

/* Functions that return such vectors are inlined, so how they would be returned does not matter. */
#pragma GCC diagnostic ignored "-Wpsabi"
typedef double doubles __attribute__((vector_size(32)));
typedef int32_t integers __attribute__((vector_size(16)));

static inline doubles load(const double *from) {
  doubles v;
  memcpy(&v, from, sizeof v);
  return v;
}

#define FARTHEST (32767.0 * CS_MAP_UNIT)

/* No farther than an integer can be. What is drawn is at most 16384 pixels long, so that nothing
 * but borders that are left of the frame as a whole are bent by that. */
static inline doubles bounded(doubles v) {
#ifdef __AVX2__
  return _mm256_max_pd(_mm256_set1_pd(-FARTHEST), _mm256_min_pd(_mm256_set1_pd(FARTHEST), v));
#else
  for (int i = 0; i < 4; i++)
    v[i] = v[i] < -FARTHEST ? -FARTHEST : v[i] > FARTHEST ? FARTHEST : v[i];
  return v;
#endif
}

/* Rounded, except that numbers below 0 may be one greater: nothing left of the frame can be seen. */
static inline integers place_two(const cs_map_placing *p, integers points) {
  doubles whole = load(p->origin) + __builtin_convertvector(points, doubles);
  return __builtin_convertvector(bounded(whole * load(p->scale) + load(p->shift)), integers);
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

/* The pixel that a border is in, and what it has added there so far. */
typedef struct place {
  uint32_t row, column; /* row: of the swath */
  int64_t area;         /* times 2 UNIT */
  int32_t height;       /* 0: it is in none */
} place;

/* Adds an area to that of the cell on the right, and takes it from that on the left, of those that
 * vary. */
static celspan_status add_parts(const cs_map_adding *a, uint32_t *head, int32_t area,
                                int32_t height) {
  cs_map_sums *all = a->sums;
  for (int side = 0; side < 2; side++) {
    int32_t sign = side == 0 ? -1 : 1;
    const cs_map_part part = {sign * area, sign * height, side == 0 ? a->left : a->right, *head};
    if (a->map->cells[part.cell].length == 0)
      continue;
    CS_TRY(CS_APPEND(a->context, all->parts, all->part_count, all->part_capacity, part));
    *head = (uint32_t)all->part_count;
  }
  return CELSPAN_OK;
}

/* What a border needs of the sums: copies, which stay in registers. */
typedef struct target {
  const cs_map_adding *adding;
  cs_map_sum *sums;
  cs_map_keys *keys;
  uint64_t *bits;
  uint32_t stride, width, words;
  uint64_t key;
  doubles step;
  bool varies, is_inside; /* constants of each caller */
} target;

/* Adds what a border has in its pixel. */
static inline void leave(const target *t, const place *p) {
  const size_t index = (size_t)p->row * t->stride + p->column;
  const uint32_t area = (uint32_t)((uint64_t)(p->area + CS_MAP_UNIT) / (2 * CS_MAP_UNIT));
  double *sum = t->sums[index].area;
  doubles here = load(sum) + (double)(int32_t)area * t->step;
  doubles next = load(sum + 4) + (double)p->height * t->step;
  memcpy(sum, &here, sizeof here);
  memcpy(sum + 4, &next, sizeof next);
  t->keys[index].area += area * t->key;
  t->keys[index].height += (uint32_t)p->height * t->key;
  t->bits[p->row * t->words + p->column / 64] |= UINT64_C(1) << p->column % 64;
  if (t->varies && add_parts(t->adding, &t->adding->sums->heads[index], (int32_t)area, p->height))
    *t->adding->status = CELSPAN_NO_MEMORY;
}

/* A line in one pixel. across: the width on its right, at its top and its foot together. */
static inline void add(const target *t, place *p, uint32_t row, uint32_t column, int32_t height,
                       int32_t across) {
  if (p->column != column || p->row != row) {
    if (p->height > 0)
      leave(t, p);
    *p = (place){row, column, 0, 0};
  }
  p->area += (int64_t)height * across;
  p->height += height;
}

/* ---------------------------------------------------------------- a row */

/* A line over several columns, from its left end: from < to. */
static inline void add_columns(const target *t, place *p, uint32_t row, int32_t from, int32_t to,
                               int32_t height) {
  const double slope = (double)height / ((double)to - from);
  int32_t x = from, done = 0;
  if (!t->is_inside && from < 0) {
    x = 0;
    done = (int32_t)(-(double)from * slope + 0.5);
    add(t, p, row, 0, done, 2 * CS_MAP_UNIT);
  }
  uint32_t column = (uint32_t)x / CS_MAP_UNIT, last = (uint32_t)to / CS_MAP_UNIT;
  last = !t->is_inside && last > t->width ? t->width : last;
  for (; column < last; column++) {
    int32_t end = (int32_t)(column + 1) * CS_MAP_UNIT;
    int32_t all = (int32_t)((double)(end - from) * slope + 0.5);
    add(t, p, row, column, all - done, end - x);
    done = all;
    x = end;
  }
  if (t->is_inside || column < t->width)
    add(t, p, row, column, height - done, 2 * (int32_t)(column + 1) * CS_MAP_UNIT - x - to);
}

static inline void add_line(const target *t, place *p, uint32_t row, int32_t xa, int32_t xb,
                            int32_t height) {
  int32_t column = xa >> 16, from = xa < xb ? xa : xb, to = xa < xb ? xb : xa;
  if (column == xb >> 16 && (t->is_inside || (uint32_t)column < t->width))
    add(t, p, row, (uint32_t)column, height, 2 * (column + 1) * CS_MAP_UNIT - xa - xb);
  else if (!t->is_inside && to < 0)
    add(t, p, row, 0, height, 2 * CS_MAP_UNIT);
  else if (t->is_inside || from >> 16 < (int32_t)t->width)
    add_columns(t, p, row, from, to, height);
}

/* ---------------------------------------------------------------- a border */

/* The part of a line that is in the swath, of which it crosses several rows. top: of the swath. */
static inline void add_rows(const target *t, place *p, cs_map_point above, cs_map_point below,
                            int32_t top) {
  const double slope = ((double)below.x - above.x) / ((double)below.y - above.y);
  const int32_t foot = top + CS_MAP_ROWS * CS_MAP_UNIT, end = below.y < foot ? below.y : foot;
  int32_t x = above.x, y = above.y;
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
    add_line(t, p, row, x, next_x, next_y - y);
    x = next_x;
    y = next_y;
  }
}

static inline uint32_t add_border(const cs_map_adding *a, bool varies, bool is_inside) {
  const cs_map_sums *s = a->sums;
  const target t = {
      a,      s->sums,       s->keys, s->bits,  s->stride, (uint32_t)s->width, (uint32_t)s->words,
      a->key, load(a->step), varies,  is_inside};
  const int32_t top = a->row * CS_MAP_UNIT, foot = top + CS_MAP_ROWS * CS_MAP_UNIT;
  place p = {0};
  uint32_t at = a->at;
  cs_map_point above = a->places[at], below;
  for (; at + 1 < a->end && above.y < foot; above = below, at++) {
    below = a->places[at + 1];
    uint32_t row = (uint32_t)(above.y - top) / CS_MAP_UNIT;
    if (above.y >= top && (uint32_t)(below.y - 1 - top) / CS_MAP_UNIT == row && below.y > above.y)
      add_line(&t, &p, row, above.x, below.x, below.y - above.y);
    else if (below.y > top && below.y > above.y)
      add_rows(&t, &p, above, below, top);
    if (below.y > foot)
      break;
  }
  if (p.height > 0)
    leave(&t, &p);
  return at;
}

uint32_t CS_WIDE(cs_map_add)(const cs_map_adding *adding) {
  if (adding->varies)
    return add_border(adding, true, false);
  return adding->is_inside ? add_border(adding, false, true) : add_border(adding, false, false);
}
