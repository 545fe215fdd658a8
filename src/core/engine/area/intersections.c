#include "engine/area/intersections.h"

#include "base/vector.h"

#include <math.h>

#define FOUR 4   /* shares that are compared at a time */
#define BATCH 16 /* places that have a common least share */

/* Bytes of one edge over all arrays. */
#define ITEM_SIZE (sizeof(cs_active_edge) + 4 * sizeof(double) + 3 * sizeof(uint32_t))

void cs_intersections_finish(cs_intersections *intersections, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, intersections, storage, intersections);
  *intersections = (cs_intersections){0};
}

/* The wider items come first, so that each array is aligned. */
celspan_status cs_intersections_reserve(cs_intersections *intersections, celspan_context *context,
                                        size_t edges) {
  if (edges <= intersections->edge_capacity)
    return CELSPAN_OK;
  size_t wanted = (2 * edges + BATCH - 1) / BATCH * BATCH;
  intersections->edge_capacity = 0;
  CS_TRY(CS_ARRAY_MAKE(context, intersections->storage, wanted * ITEM_SIZE));
  intersections->edges = (cs_active_edge *)intersections->storage;
  intersections->top = (double *)(intersections->edges + wanted);
  intersections->foot = intersections->top + wanted;
  intersections->shares = intersections->foot + wanted;
  intersections->least = intersections->shares + wanted;
  intersections->order = (uint32_t *)(intersections->least + wanted);
  intersections->first = intersections->order + wanted;
  intersections->last = intersections->first + wanted;
  intersections->edge_capacity = wanted;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- shares of a step */

/* The share of the step at which the boundary at a place crosses its right neighbour. The processor
 * can hardly predict whether it does, so the division is always made. */
static inline double find_share(const cs_intersections *m, size_t place) {
  double foot = m->foot[place] - m->foot[place + 1], gap = m->top[place + 1] - m->top[place];
  double top = gap > 0 ? gap : 0, share = top / (top + foot);
  return foot > 0 ? share : INFINITY;
}

static inline size_t batch_count(size_t count) { return (count + BATCH - 1) / BATCH; }

/* The least of some shares, in both lanes. count: a multiple of four. */
static inline cs_v2d least_of(const double *shares, size_t count) {
  cs_v2d low = cs_v2d_load(shares), high = cs_v2d_load(shares + 2);
  for (size_t i = FOUR; i < count; i += FOUR) {
    low = cs_v2d_min(cs_v2d_load(shares + i), low);
    high = cs_v2d_min(cs_v2d_load(shares + i + 2), high);
  }
  low = cs_v2d_min(low, high);
  return cs_v2d_min(low, (cs_v2d){low[1], low[0]});
}

static void find_batch_least(cs_intersections *m, size_t batch) {
  m->least[batch] = least_of(m->shares + batch * BATCH, BATCH)[0];
}

/* Whether there are enough places to keep the least share of every batch. */
static inline bool has_batches(size_t count) { return count > BATCH + 1; }

/* Finds the shares of all places, and fills up the last four. Returns whether any two boundaries
 * cross. */
static bool find_shares(cs_intersections *m, size_t count) {
  int64_t crossings = 0;
  for (size_t place = 0; place + 1 < count; place++) {
    m->shares[place] = find_share(m, place);
    crossings += m->foot[place] > m->foot[place + 1];
  }
  if (crossings == 0)
    return false;
  size_t unit = has_batches(count) ? BATCH : FOUR;
  for (size_t place = count - 1; place % unit > 0; place++)
    m->shares[place] = INFINITY;
  for (size_t batch = 0; has_batches(count) && batch < batch_count(count - 1); batch++)
    find_batch_least(m, batch);
  return true;
}

/* The first place with the least of at most BATCH shares, a multiple of four. The processor can
 * hardly predict where it is, so nothing here is a branch. */
static inline size_t find_least(const double *shares, size_t count) {
  cs_v2d least = least_of(shares, count);
  unsigned places = 0;
  for (size_t i = 0; i < count; i += 2)
    places |= cs_v2d_equal(cs_v2d_load(shares + i), least) << i;
  return (size_t)__builtin_ctz(places);
}

static inline size_t find_least_batch(const cs_intersections *m, size_t count) {
  double least = m->least[0];
  size_t batch = 0;
  for (size_t i = 1; i < count; i++)
    least = m->least[i] < least ? m->least[i] : least;
  for (size_t i = count; i-- > 0;)
    batch = m->least[i] == least ? i : batch;
  return batch;
}

/* The place of the next intersection; false: there is none left. */
static bool find_next(const cs_intersections *m, size_t count, size_t *place) {
  if (!has_batches(count)) {
    *place = find_least(m->shares, (count - 1 + FOUR - 1) / FOUR * FOUR);
  } else {
    size_t batch = find_least_batch(m, batch_count(count - 1));
    *place = batch * BATCH + find_least(m->shares + batch * BATCH, BATCH);
  }
  return m->shares[*place] < INFINITY;
}

/* ---------------------------------------------------------------- swaps */

static inline void exchange(double *a, double *b) {
  double kept = *a;
  *a = *b;
  *b = kept;
}

static inline void move_to(cs_active_edge *edge, double x, double y) {
  edge->last_at = edge->at;
  edge->last_x = x;
  edge->last_y = y;
}

/* Lets the boundaries at `place` and `place` + 1, which cross, change places. share: the part of
 * the step above the intersection; y: the height of the intersection. */
static celspan_status swap_places(cs_intersections *m, celspan_context *context, size_t place,
                                  double share, double y) {
  CS_TRY(CS_ARRAY_RESERVE(context, m->intersections, m->count + 1));
  uint32_t index = (uint32_t)m->count++, left = m->order[place], right = m->order[place + 1];
  double left_x = m->top[place] + (m->foot[place] - m->top[place]) * share;
  double right_x = m->top[place + 1] + (m->foot[place + 1] - m->top[place + 1]) * share;
  cs_active_edge *from = &m->edges[left], *to = &m->edges[right];
  bool is_first = m->first[place] == CS_INTERSECTIONS_NONE;
  uint32_t previous = is_first ? CS_INTERSECTIONS_NONE : m->last[place];
  m->intersections[index] = (cs_intersection){
      y, left_x, right_x, from->at, to->at, left, right, CS_INTERSECTIONS_NONE, previous, NULL};
  move_to(from, left_x, y);
  move_to(to, right_x, y);
  *(is_first ? &m->first[place] : &m->intersections[previous].next) = index;
  m->last[place] = index;
  m->order[place] = right;
  m->order[place + 1] = left;
  exchange(&m->top[place], &m->top[place + 1]);
  exchange(&m->foot[place], &m->foot[place + 1]);
  return CELSPAN_OK;
}

/* Finds the intersections of a step. */
static celspan_status find_in_step(cs_intersections *m, celspan_context *context, size_t count,
                                   double y0, double y1) {
  double share = 0; /* the share of the step that is done */
  if (!find_shares(m, count))
    return CELSPAN_OK;
  for (size_t place; find_next(m, count, &place);) {
    share = m->shares[place] > share ? m->shares[place] : share;
    CS_TRY(swap_places(m, context, place, share, y0 + (y1 - y0) * share));
    size_t first = place > 0 ? place - 1 : 0, last = place + 2 < count ? place + 1 : place;
    for (size_t i = first; i <= last; i++)
      m->shares[i] = find_share(m, i);
    if (has_batches(count))
      find_batch_least(m, first / BATCH);
    if (last / BATCH != first / BATCH)
      find_batch_least(m, last / BATCH);
  }
  return CELSPAN_OK;
}

/* x, at a height, of the segment that ends at a point. At the end point it is exactly the point's
 * x. The processor can hardly predict whether this is the height of the end point, so the division
 * is always made. */
static inline double segment_x(const celspan_point *end, double y) {
  const celspan_point *from = end - 1;
  double x = from->x + (end->x - from->x) * ((y - from->y) / (end->y - from->y));
  return y >= end->y ? end->x : x;
}

/* ---------------------------------------------------------------- steps */

/* Moves on to the segments that continue below y, where a step has ended. Returns the height at
 * which the first of these segments ends, or y1. */
static double begin_step(cs_intersections *m, size_t count, double y, double y1) {
  double end = y1;
  for (size_t i = 0; i < count; i++) {
    cs_active_edge *edge = &m->edges[i];
    edge->at += edge->points[edge->at].y <= y;
    double next = edge->points[edge->at].y;
    end = next < end ? next : end;
  }
  return end;
}

celspan_status cs_intersections_find(cs_intersections *m, celspan_context *context, size_t count,
                                     double y0, double y1) {
  m->count = 0;
  for (size_t i = 0; i < count; i++) {
    cs_active_edge *edge = &m->edges[i];
    while (edge->points[edge->at].y < y0)
      edge->at++;
    m->order[i] = (uint32_t)i;
    m->first[i] = CS_INTERSECTIONS_NONE;
  }
  for (double y = y0, end; y < y1; y = end) {
    end = begin_step(m, count, y, y1);
    for (size_t place = 0; place < count; place++) {
      const cs_active_edge *edge = &m->edges[m->order[place]];
      m->top[place] = m->foot[place]; /* the last step ended at this height and this x */
      m->foot[place] = segment_x(edge->points + edge->at, end);
    }
    CS_TRY(find_in_step(m, context, count, y, end));
  }
  return CELSPAN_OK;
}
