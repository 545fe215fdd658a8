/* Where an area runs out: pixels are added from the widest to the narrowest, by their distance from
 * the ink, until those of both ends hang together. The last one is the place. */
#include <math.h>

#include "inside/sort.h"
#include "tools/areas/areas.h"
#include "tools/areas/nearest.h"

#define NEVER UINT32_MAX /* is not added yet */

typedef struct step {
  uint32_t squared, place;
} step;

static inline bool is_before(const step *a, const step *b) {
  return a->squared != b->squared ? a->squared > b->squared : a->place < b->place;
}
CS_SORT_DEFINE(sort_steps, step, is_before)

typedef struct search {
  const cs_ink_areas *areas;
  CS_ARRAY(uint32_t, squared); /* by place, as `parents` */
  CS_ARRAY(uint32_t, parents);
  CS_ARRAY(step, steps);
  uint32_t label;
} search;

static bool is_rim(const cs_ink_areas *a, uint32_t place) {
  const uint32_t width = (uint32_t)a->width, x = place % width, y = place / width;
  return x == 0 || y == 0 || x + 1 == width || y + 1 == (uint32_t)a->height;
}

static celspan_status measure(search *s) {
  const cs_ink_areas *a = s->areas;
  const size_t size = cs_ink_areas_size(a);
  CS_TRY(CS_ARRAY_MAKE(a->context, s->squared, size));
  CS_TRY(CS_ARRAY_MAKE(a->context, s->parents, size));
  CS_TRY(CS_ARRAY_MAKE(a->context, s->steps, size));
  celspan_status status =
      cs_nearest_find(a->context, a->walls, CS_WALL_INK, a->width, a->height, s->squared);
  for (uint32_t i = 0; status == CELSPAN_OK && i < size; i++) {
    const uint32_t near = s->squared[i], width = (uint32_t)a->width;
    if (near == CS_NEAREST_NONE || is_rim(a, i))
      continue;
    const int32_t x = (int32_t)(near % width) - (int32_t)(i % width);
    const int32_t y = (int32_t)(near / width) - (int32_t)(i / width);
    s->squared[i] = (uint32_t)(x * x + y * y);
  }
  for (uint32_t i = 0; i < size; i++)
    if (is_rim(a, i)) /* is joined first */
      s->squared[i] = UINT32_MAX;
  return status;
}

static bool is_inside(const search *s, size_t place) {
  return !s->areas->walls[place] && s->areas->labels[place] == s->label;
}

/* The place about a point that is farthest from the ink, in the empty circle around the point. */
static uint32_t farthest(const search *s, uint32_t from) {
  const int64_t width = s->areas->width, height = s->areas->height;
  const int64_t x = from % width, y = from / width, squared = s->squared[from];
  const int64_t far = (int64_t)sqrt((double)squared);
  uint32_t best = from;
  for (int64_t v = y > far ? y - far : 0; v <= y + far && v < height; v++)
    for (int64_t u = x > far ? x - far : 0; u <= x + far && u < width; u++) {
      const uint32_t at = (uint32_t)(v * width + u);
      if ((u - x) * (u - x) + (v - y) * (v - y) < squared && is_inside(s, at) &&
          s->squared[at] != UINT32_MAX && s->squared[at] > s->squared[best])
        best = at;
    }
  return best;
}

/* The middle of the wide place that a point lies in, so that its own distance does not count. */
static uint32_t climb(const search *s, uint32_t from) {
  uint32_t before = NEVER;
  while (before != from && s->squared[from] != UINT32_MAX) {
    before = from;
    from = farthest(s, from);
  }
  return from;
}

static uint32_t root_of(uint32_t *parents, uint32_t place) {
  while (parents[place] != place)
    place = parents[place] = parents[parents[place]];
  return place;
}

static void join(search *s, uint32_t place, uint32_t other) {
  if (s->parents[other] != NEVER)
    s->parents[root_of(s->parents, place)] = root_of(s->parents, other);
}

static void add(search *s, uint32_t place) {
  const uint32_t width = (uint32_t)s->areas->width, x = place % width;
  s->parents[place] = place;
  if (x > 0)
    join(s, place, place - 1);
  if (x + 1 < width)
    join(s, place, place + 1);
  if (place >= width)
    join(s, place, place - width);
  if (place + width < cs_ink_areas_size(s->areas))
    join(s, place, place + width);
}

static void run(search *s, uint32_t from, uint32_t to, cs_ink_leak *out) {
  const uint32_t size = (uint32_t)cs_ink_areas_size(s->areas), width = (uint32_t)s->areas->width;
  size_t count = 0;
  to = from == to ? 0 : climb(s, to);
  from = climb(s, from);
  for (uint32_t i = 0; i < size; i++) {
    s->parents[i] = NEVER;
    if (is_inside(s, i))
      s->steps[count++] = (step){s->squared[i], i};
  }
  sort_steps(s->steps, count);
  for (size_t i = 0; i < count; i++) {
    const uint32_t at = s->steps[i].place, squared = s->steps[i].squared;
    add(s, at);
    *out = (cs_ink_leak){(int32_t)(at % width), (int32_t)(at / width),
                         squared == UINT32_MAX ? HUGE_VAL : 2 * sqrt((double)squared) - 1};
    if (s->parents[from] != NEVER && s->parents[to] != NEVER &&
        root_of(s->parents, from) == root_of(s->parents, to))
      return;
  }
}

celspan_status cs_ink_areas_leak(const cs_ink_areas *areas, uint32_t from, uint32_t to,
                                 cs_ink_leak *out) {
  search s = {.areas = areas, .label = areas->labels[from]};
  celspan_status status = measure(&s);
  if (status == CELSPAN_OK)
    run(&s, from, to, out);
  CS_ARRAYS_FREE(areas->context->memory, &s, squared, steps);
  return status;
}
