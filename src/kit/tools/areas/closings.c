/* Openings closed by the shortest segments between two ends of lines, or from an end to what lies
 * ahead of it.
 *
 *      ----o . . o----         o: ends of the thinned lines     .: closings
 *
 *      ----o . . |             ahead: within 60 degrees of the line's direction at its end
 *                |
 *
 * The shortest come first. An end takes part as often as it is the nearest of others, but only
 * those that nothing closes yet begin a closing, and none goes through ink or through another. What
 * the first round leaves may still meet a closing of it in the second.
 */
#include <math.h>

#include "inside/sort.h"
#include "tools/areas/areas.h"
#include "tools/trace/thinning.h"

#define STEP 0.25 /* pixels along a segment */
#define SLACK 0.5 /* pixels by which an opening may be narrower than it seems */
#define BACK 2    /* the direction of an end is that over that many times its depth, and 4 pixels */
#define THIRDS 3.0
#define NOTCH 1.0 /* pixels: between pixels of the tip itself */
#define NO_END SIZE_MAX
enum { ROUNDS = 2, RAYS = 25, THIN = 6 /* thirds */ };

typedef struct line_end {
  celspan_point at, along; /* along: of length 1, out of the line */
  double depth;            /* pixels from its middle to its edge */
  bool is_closed;
} line_end;

typedef struct closing {
  double length; /* of its part outside of the ink */
  double rank;   /* the least comes first: where both are about as long, one between two ends */
  celspan_point from, to;
  size_t one, other; /* ends; other may be NO_END */
} closing;

typedef struct closer {
  cs_ink_areas *areas;
  double gap;
  CS_ARRAY(line_end, ends);
  CS_ARRAY(closing, list);
  size_t end_count, count;
} closer;

static inline bool is_shorter(const closing *a, const closing *b) {
  if (a->rank != b->rank)
    return a->rank < b->rank;
  return a->one != b->one ? a->one < b->one : a->other < b->other;
}
CS_SORT_DEFINE(sort_closings, closing, is_shorter)

static inline bool is_left(const line_end *a, const line_end *b) {
  return a->at.x != b->at.x ? a->at.x < b->at.x : a->at.y < b->at.y;
}
CS_SORT_DEFINE(sort_ends, line_end, is_left)

/* ---------------------------------------------------------------- ends */

static celspan_point middle_of(const cs_thin *thin, size_t place) {
  return (celspan_point){(double)(place % thin->stride) - 0.5,
                         (double)(place / thin->stride) - 0.5};
}

static bool is_end(const cs_thin *thin, size_t place) {
  ptrdiff_t around[8];
  int count = 0;
  cs_thin_offsets(thin, around);
  for (int i = 0; i < 8; i++)
    count += thin->plane[place + (size_t)around[i]] != 0;
  return count == 1;
}

static celspan_status add_end(closer *c, const cs_thin *thin, const uint32_t *places, size_t count,
                              bool is_last) {
  const size_t place = places[is_last ? count - 1 : 0];
  const double depth = thin->depths[place] / THIRDS;
  if (count < 2 || !is_end(thin, place))
    return CELSPAN_OK;
  size_t back = (size_t)(BACK * depth) + 4;
  back = back < count ? back : count - 1;
  const celspan_point at = middle_of(thin, place);
  const celspan_point from = middle_of(thin, places[is_last ? count - 1 - back : back]);
  const double x = at.x - from.x, y = at.y - from.y, length = sqrt(x * x + y * y);
  if (!(length > 0))
    return CELSPAN_OK;
  const line_end end = {at, {x / length, y / length}, depth, false};
  return CS_ARRAY_APPEND(c->areas->context, c->ends, c->end_count, end);
}

/* The share of the pixels of thinned lines that are thin. */
static double share_of_thin(const cs_thin *thin) {
  size_t all = 0, few = 0;
  for (size_t i = 0; i < thin->stride * ((size_t)thin->height + 2); i++) {
    all += thin->plane[i] != 0;
    few += thin->plane[i] && thin->depths[i] < THIN;
  }
  return all ? (double)few / (double)all : 1;
}

static celspan_status list_ends(closer *c, cs_thin *thin) {
  cs_branches branches;
  celspan_status status = cs_branches_find(c->areas->context, thin, &branches);
  for (size_t i = 0; status == CELSPAN_OK && i < branches.count; i++) {
    const cs_branch *branch = &branches.list[i];
    const uint32_t *places = branches.places + branch->first;
    if (branch->is_closed)
      continue;
    status = add_end(c, thin, places, branch->count, false);
    if (status == CELSPAN_OK)
      status = add_end(c, thin, places, branch->count, true);
  }
  cs_branches_finish(&branches, c->areas->context);
  sort_ends(c->ends, c->end_count);
  c->areas->thin = share_of_thin(thin);
  return status;
}

/* The ink as the tracer's labels: 0 is drawn, 1 is the ground. */
static void copy_walls(const cs_ink_areas *a, cs_labels *labels) {
  for (size_t i = 0; i < labels->stride * ((size_t)a->height + 2); i++)
    labels->plane[i] = CS_LABEL_OUTSIDE;
  for (int32_t y = 0; y < a->height; y++)
    for (int32_t x = 0; x < a->width; x++)
      *cs_labels_at(labels, x, y) = !a->walls[(size_t)y * (size_t)a->width + (size_t)x];
}

static celspan_status find_ends(closer *c) {
  celspan_context *context = c->areas->context;
  cs_labels labels = {c->areas->width, c->areas->height, (size_t)c->areas->width + 2, NULL};
  const size_t size = labels.stride * ((size_t)labels.height + 2);
  const cs_colours colours = {.count = 1};
  const cs_material material = {NULL, &colours, &labels, false};
  cs_thin thin;
  CS_TRY(CS_MAKE(context, labels.plane, size));
  copy_walls(c->areas, &labels);
  celspan_status status = cs_thin_make(context, &material, 1, &thin);
  if (status == CELSPAN_OK) {
    status = list_ends(c, &thin);
    cs_thin_finish(&thin, context);
  }
  cs_mem_free(context->memory, labels.plane, size);
  return status;
}

/* ---------------------------------------------------------------- segments */

static size_t place_at(const cs_ink_areas *a, double x, double y) {
  return (size_t)y * (size_t)a->width + (size_t)x;
}

static bool is_wall_at(const cs_ink_areas *a, double x, double y) {
  return x >= 0 && y >= 0 && x < a->width && y < a->height && a->walls[place_at(a, x, y)];
}

/* Goes from an end out of its ink and on until a wall. Says whether one is met within the gap; then
 * out->to lies on it. */
static bool go(const closer *c, const line_end *end, celspan_point along, closing *out) {
  const double leave = 2 * end->depth + 2, most = c->gap + SLACK;
  celspan_point at = end->at;
  double length = 0;
  for (double way = 0;; way += STEP) {
    at = (celspan_point){end->at.x + along.x * way, end->at.y + along.y * way};
    const bool is_wall = is_wall_at(c->areas, at.x, at.y);
    if (is_wall && length > NOTCH)
      break;
    length = is_wall ? 0 : length + STEP;
    if (length > most || (is_wall && way > leave))
      return false;
  }
  *out = (closing){length, length + end->depth + 1, end->at, at, (size_t)(end - c->ends), NO_END};
  return true;
}

static celspan_status add(closer *c, const closing *one) {
  return CS_ARRAY_APPEND(c->areas->context, c->list, c->count, *one);
}

/* The shortest way ahead, of rays 5 degrees apart: of ways as short, the straightest. */
static celspan_status add_ahead(closer *c, const line_end *end) {
  const double cosine = 0.99619469809174555, sine = 0.08715574274765817;
  double x = 1, y = 0;
  closing best = {.length = INFINITY}, one;
  for (int i = 0; i < RAYS; i++) {
    const celspan_point along = {end->along.x * x - end->along.y * y,
                                 end->along.x * y + end->along.y * x};
    if (go(c, end, along, &one) && one.length < best.length)
      best = one;
    y = -y;
    if (i % 2 == 0) { /* both sides are done: 5 degrees more */
      const double turned = x * cosine - y * sine;
      y = x * sine + y * cosine;
      x = turned;
    }
  }
  return best.length < INFINITY ? add(c, &best) : CELSPAN_OK;
}

static celspan_status add_between(closer *c, const line_end *a, const line_end *b) {
  const double x = b->at.x - a->at.x, y = b->at.y - a->at.y, length = sqrt(x * x + y * y);
  closing one;
  if (!(length > 0) || !go(c, a, (celspan_point){x / length, y / length}, &one))
    return CELSPAN_OK;
  const double left_x = b->at.x - one.to.x, left_y = b->at.y - one.to.y;
  if (sqrt(left_x * left_x + left_y * left_y) > 2 * b->depth + 2)
    return CELSPAN_OK; /* there is other ink between them */
  one.to = b->at;
  one.rank = one.length;
  one.other = (size_t)(b - c->ends);
  return add(c, &one);
}

static celspan_status list_closings(closer *c) {
  c->count = 0;
  for (size_t i = 0; i < c->end_count; i++) {
    const line_end *a = &c->ends[i];
    if (!a->is_closed)
      CS_TRY(add_ahead(c, a));
    for (size_t k = i + 1; k < c->end_count; k++) {
      const line_end *b = &c->ends[k];
      if (b->at.x - a->at.x > c->gap + 2 * (a->depth + b->depth) + 4)
        break;
      if (!a->is_closed || !b->is_closed)
        CS_TRY(add_between(c, a, b));
    }
  }
  sort_closings(c->list, c->count);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- walls */

static void set_wall(cs_ink_areas *a, double x, double y) {
  unsigned char *wall = &a->walls[place_at(a, x, y)];
  if (!*wall)
    *wall = CS_WALL_CLOSING;
}

/* Sets the pixels of a segment, which hang together by their sides. */
static void draw(cs_ink_areas *a, const closing *one) {
  const double x = one->to.x - one->from.x, y = one->to.y - one->from.y;
  const double length = sqrt(x * x + y * y);
  double before = one->from.y;
  for (double way = 0; way < length + STEP; way += STEP) {
    const double t = way < length ? way / length : 1;
    const double u = one->from.x + t * x, v = one->from.y + t * y;
    set_wall(a, u, before);
    set_wall(a, u, v);
    before = v;
  }
}

/* Whether nothing that was closed before closes it or lies on its way; a way that became shorter
 * takes its new end. */
static bool is_open(const closer *c, closing *one) {
  const line_end *end = &c->ends[one->one];
  const double x = one->to.x - one->from.x, y = one->to.y - one->from.y;
  const double length = sqrt(x * x + y * y), planned = one->length;
  const size_t other = one->other;
  closing now;
  if (end->is_closed && (other == NO_END || c->ends[other].is_closed))
    return false;
  if (!(length > 0) || !go(c, end, (celspan_point){x / length, y / length}, &now))
    return false;
  if (other == NO_END)
    *one = now;
  return other == NO_END || now.length >= planned;
}

static celspan_status close_round(closer *c) {
  CS_TRY(list_closings(c));
  for (size_t i = 0; i < c->count; i++) {
    closing *one = &c->list[i];
    if (!is_open(c, one))
      continue;
    draw(c->areas, one);
    c->ends[one->one].is_closed = true;
    if (one->other != NO_END)
      c->ends[one->other].is_closed = true;
  }
  return CELSPAN_OK;
}

celspan_status cs_ink_areas_close(cs_ink_areas *areas, double gap) {
  const double most = areas->width + areas->height;
  closer c = {.areas = areas, .gap = gap < most ? gap : most};
  celspan_status status = find_ends(&c);
  for (int i = 0; status == CELSPAN_OK && gap > 0 && i < ROUNDS; i++)
    status = close_round(&c);
  CS_ARRAYS_FREE(areas->context->memory, &c, ends, list);
  return status;
}
