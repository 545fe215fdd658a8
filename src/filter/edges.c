#include "filter/edges.h"

#include <string.h>

/* Bytes of one boundary over all arrays. */
#define ITEM_SIZE (4 * sizeof(double) + 2 * sizeof(int32_t) + sizeof(bool))

void cs_edges_finish(cs_edges *edges, cs_memory *memory) {
  cs_mem_free(memory, edges->block, edges->capacity * ITEM_SIZE);
  *edges = (cs_edges){0};
}

/* The wider items first, so that each is aligned. */
static celspan_status make_room(celspan_context *context, cs_edges *edges, size_t count) {
  if (count <= edges->capacity)
    return CELSPAN_OK;
  size_t wanted = 2 * count;
  double *block = cs_mem_array(context->memory, wanted, ITEM_SIZE);
  if (!block)
    return cs_fail_memory(context);
  cs_mem_free(context->memory, edges->block, edges->capacity * ITEM_SIZE);
  *edges = (cs_edges){.way = edges->way, .low = block, .high = block + wanted, .area = block + 2 * wanted,
                      .rest = block + 3 * wanted, .first = (int32_t *)(block + 4 * wanted),
                      .block = block, .capacity = wanted};
  edges->end = edges->first + wanted;
  edges->is_bent = (bool *)(edges->end + wanted);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- straight
 *
 * Plain loops for the compiler to make vectors of: each step is one operation on every boundary. */

static inline __attribute__((always_inline)) void
measure_straight(cs_edges *edges, const double *restrict top, const double *restrict foot,
                 size_t count, int32_t width) {
  double *restrict low = edges->low, *restrict high = edges->high;
  double *restrict area = edges->area, *restrict rest = edges->rest;
  int32_t *restrict first = edges->first, *restrict end = edges->end;
  const double right = width, whole = 0x1p52; /* above it doubles are whole numbers */
#pragma omp simd
  for (size_t i = 0; i < count; i++) {
    double a = top[i] < foot[i] ? top[i] : foot[i], b = top[i] < foot[i] ? foot[i] : top[i];
    double held = a > 0 ? a : 0, held_high = b > 0 ? b : 0;
    held = held < right ? held : right;
    held_high = held_high < right ? held_high : right;
    double near = (held + whole) - whole, near_high = (held_high + whole) - whole;
    double column = near - (near > held ? 1.0 : 0.0);
    double last = near_high + (near_high < held_high ? 1.0 : 0.0);
    double split = column + 1, by_twice = 0.5 / (b - a);
    double one = split - 0.5 * (a + b);
    double two = (split - a) * (split - a) * by_twice;
    double two_rest = 1 - (b - split) * (b - split) * by_twice;
    double leaves = (a < 0 ? held_high : 0) + (b > right ? right - held : 0);
    double least = leaves > 0 ? column + 3 : last;
    low[i] = a;
    high[i] = b;
    area[i] = cs_edges_round(b > split ? two : one);
    rest[i] = cs_edges_round(b > split ? two_rest : 1);
    first[i] = (int32_t)column;
    end[i] = (int32_t)(last < least ? least : last);
  }
}

static void measure_anywhere(cs_edges *edges, const double *top, const double *foot, size_t count,
                             int32_t width) {
  measure_straight(edges, top, foot, count, width);
}

#ifdef __x86_64__

__attribute__((target("avx2"))) static void measure_avx2(cs_edges *edges, const double *top,
                                                         const double *foot, size_t count,
                                                         int32_t width) {
  measure_straight(edges, top, foot, count, width);
}

__attribute__((target("avx512f,avx512vl,avx512dq"))) static void
measure_avx512(cs_edges *edges, const double *top, const double *foot, size_t count,
               int32_t width) {
  measure_straight(edges, top, foot, count, width);
}

int cs_edges_ways(cs_edges_way ways[3]) {
  int count = 0;
  ways[count++] = measure_anywhere;
  if (__builtin_cpu_supports("avx2"))
    ways[count++] = measure_avx2;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq"))
    ways[count++] = measure_avx512;
  return count;
}

#else

int cs_edges_ways(cs_edges_way ways[3]) {
  ways[0] = measure_anywhere;
  return 1;
}

#endif

/* ---------------------------------------------------------------- bent */

/* Adds to two pixels, of which the first begins at `column`, the area right of a straight piece that
 * crosses no others. */
static inline void add_areas(celspan_point above, celspan_point below, int32_t column,
                             double areas[2]) {
  double split = column + 1.0, height = below.y - above.y;
  double low = above.x < below.x ? above.x : below.x, high = above.x < below.x ? below.x : above.x;
  if (high <= split) {
    areas[0] += height * (split - 0.5 * (low + high));
    areas[1] += height;
  } else if (low >= split) {
    areas[1] += height * (split + 1 - 0.5 * (low + high));
  } else {
    double share = height / (2 * (high - low));
    areas[0] += (split - low) * (split - low) * share;
    areas[1] += height - (high - split) * (high - split) * share;
  }
}

/* As measure_straight for a boundary with vertices in the row. */
static void measure_bent(cs_edges *edges, const cs_active *active, const cs_bend *bend,
                         int32_t width) {
  size_t i = bend->boundary;
  edges->low[i] = bend->low;
  edges->high[i] = bend->high;
  edges->is_bent[i] = true;
  edges->first[i] = cs_edges_floor(bend->low, width);
  edges->end[i] = cs_edges_ceil(bend->high, width);
  bool leaves = (bend->low < 0 && bend->high > 0) || (bend->high > width && bend->low < width);
  if (leaves && edges->end[i] < edges->first[i] + 3)
    edges->end[i] = edges->first[i] + 3;
  if (edges->end[i] > edges->first[i] + 2)
    return;
  celspan_point above = {active->x[i], active->y}, foot = {active->x_next[i], active->y_next};
  double areas[2] = {0, 0};
  for (uint32_t k = 0; k < bend->vertex_count; k++) {
    celspan_point below = active->vertices[bend->vertex + k];
    add_areas(above, below, edges->first[i], areas);
    above = below;
  }
  add_areas(above, foot, edges->first[i], areas);
  edges->area[i] = cs_edges_round(areas[0]);
  edges->rest[i] = cs_edges_round(areas[1]);
}

celspan_status cs_edges_measure(celspan_context *context, cs_edges *edges, const cs_active *active,
                                int32_t width) {
  if (!edges->way) {
    cs_edges_way ways[3];
    edges->way = ways[cs_edges_ways(ways) - 1];
  }
  CS_TRY(make_room(context, edges, active->count));
  edges->way(edges, active->x, active->x_next, active->count, width);
  memset(edges->is_bent, 0, active->count * sizeof *edges->is_bent);
  for (size_t k = 0; k < active->bend_count; k++)
    if (active->bends[k].vertex_count > 0)
      measure_bent(edges, active, &active->bends[k], width);
  return CELSPAN_OK;
}
