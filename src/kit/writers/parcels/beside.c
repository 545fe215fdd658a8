/* A sweep from the top to the foot, with a row of the arcs at its height. */
#include <math.h>
#include <string.h>

#include "inside/sort.h"
#include "writers/parcels/making.h"

typedef enum event_kind { EVENT_END, EVENT_BEGIN, EVENT_VISIT } event_kind;

typedef struct event {
  double height; /* units */
  event_kind kind;
  uint32_t arc;
} event;

static inline bool is_earlier(const event *a, const event *b) {
  if (a->height != b->height)
    return a->height < b->height;
  return a->kind != b->kind ? a->kind < b->kind : a->arc < b->arc;
}
CS_SORT_DEFINE(sort_events, event, is_earlier)

static double x_at(const cs_parcels *parcels, uint32_t arc, double height) {
  return cs_arc_x(parcels, arc, height / PLANEFILE_SIDE * parcels->height);
}

/* The place in the row for an arc that is at x. */
static size_t find_place(const cs_beside *row, double x) {
  size_t low = 0, high = row->count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (x_at(row->parcels, row->arcs[middle], row->height) < x)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* Where an arc is in the row: near its place, because those that lie on each other may have changed
 * theirs. The end of the row: it is not there. */
static size_t find_arc(const cs_beside *row, uint32_t arc) {
  size_t place = find_place(row, x_at(row->parcels, arc, row->height));
  for (size_t by = 0; by <= row->count; by++) {
    if (place + by < row->count && row->arcs[place + by] == arc)
      return place + by;
    if (by <= place && place - by < row->count && row->arcs[place - by] == arc)
      return place - by;
  }
  return row->count;
}

/* Arcs do not cross: they are compared in the middle of the heights that they have in common, where
 * they are apart, also if both begin at one place. */
static bool is_left_of(const cs_parcels *parcels, uint32_t one, uint32_t arc) {
  const int32_t top = parcels->arcs[arc].top, a = parcels->arcs[one].foot;
  const int32_t b = parcels->arcs[arc].foot;
  const double middle = ((double)top + (a < b ? a : b)) / 2;
  return x_at(parcels, one, middle) < x_at(parcels, arc, middle);
}

static void begin_arc(cs_beside *row, uint32_t arc) {
  size_t place = 0, high = row->count;
  while (place < high) {
    size_t middle = (place + high) / 2;
    if (is_left_of(row->parcels, row->arcs[middle], arc))
      place = middle + 1;
    else
      high = middle;
  }
  memmove(row->arcs + place + 1, row->arcs + place, (row->count - place) * sizeof *row->arcs);
  row->arcs[place] = arc;
  row->count++;
}

static void end_arc(cs_beside *row, uint32_t arc) {
  size_t place = find_arc(row, arc);
  if (place == row->count)
    return;
  row->count--;
  memmove(row->arcs + place, row->arcs + place + 1, (row->count - place) * sizeof *row->arcs);
}

static size_t list_events(const cs_parcels *parcels, int visits, event *out) {
  size_t count = 0;
  for (uint32_t i = 0; i < parcels->arc_count; i++) {
    const double top = parcels->arcs[i].top, foot = parcels->arcs[i].foot;
    if (top >= foot) /* it would end before it begins */
      continue;
    out[count++] = (event){top, EVENT_BEGIN, i};
    out[count++] = (event){foot, EVENT_END, i};
    for (int k = 0; k < visits; k++)
      out[count++] = (event){top + (foot - top) * (k + 0.5) / visits, EVENT_VISIT, i};
  }
  sort_events(out, count);
  return count;
}

celspan_status cs_beside_walk(celspan_context *context, const cs_parcels *parcels, int visits,
                              cs_beside_visit *visit, void *user) {
  const size_t most = (2 + (size_t)visits) * parcels->arc_count;
  cs_beside row = {.context = context, .parcels = parcels};
  event *events = NULL;
  if (most == 0)
    return CELSPAN_OK;
  celspan_status status = CS_MAKE(context, row.arcs, parcels->arc_count);
  if (status == CELSPAN_OK)
    status = CS_MAKE(context, events, most);
  const size_t count = status == CELSPAN_OK ? list_events(parcels, visits, events) : 0;
  for (size_t i = 0; i < count && status == CELSPAN_OK; i++) {
    const event *e = &events[i];
    row.height = e->height;
    if (e->kind == EVENT_BEGIN)
      begin_arc(&row, e->arc);
    else if (e->kind == EVENT_END)
      end_arc(&row, e->arc);
    else
      status = visit(&row, find_arc(&row, e->arc), user);
  }
  cs_mem_free(context->memory, events, most * sizeof *events);
  cs_mem_free(context->memory, row.arcs, parcels->arc_count * sizeof *row.arcs);
  return status;
}

double cs_beside_gap(const cs_beside *row, size_t place, size_t other) {
  const uint32_t arc = row->arcs[place];
  const double x = x_at(row->parcels, arc, row->height);
  const double gap = fabs(x_at(row->parcels, row->arcs[other], row->height) - x);
  const cs_parcel_curve *first = &row->parcels->curves[row->parcels->arcs[arc].curve];
  const cs_parcel_curve *last = first + row->parcels->arcs[arc].curve_count - 1;
  const celspan_point top = first->points[0], foot = last->points[3];
  const double across = foot.x - top.x, down = foot.y - top.y;
  const double length = sqrt(across * across + down * down);
  return length > 0 ? gap * down / length : gap;
}
