#include "trace/contour.h"

#include <math.h>

#include "base/elementary.h"
#include "base/number.h"
#include "trace/spline.h"

#define PI 3.14159265358979323846
/* Pixels between points, and angles between those around an end. */
#define STEP 0.4
enum { CAP_POINTS = 12, MOST_POINTS = 1000000 };

static const cs_fit_rules rules = {.tolerance = 0.05,
                                   .mean = 0.05,
                                   .straight = 0.0375,
                                   .about = 3,
                                   .turn = 0.5,
                                   .near = 4,
                                   .rounding = 0.2,
                                   .noise = 0.02};

typedef struct drawer {
  celspan_context *context;
  const cs_shape *shape;
  cs_points *points;
} drawer;

static cs_station station_at(const drawer *d, double parameter) {
  const cs_shape *shape = d->shape;
  return cs_spline_at(shape->points, shape->widths, shape->point_count, shape->is_closed,
                      parameter);
}

/* The place, and the direction from a little before it to a little after. */
static cs_station along_at(const drawer *d, double parameter, celspan_point *along) {
  double before = parameter - 1e-4, after = parameter + 1e-4;
  if (!d->shape->is_closed) {
    before = before < 0 ? 0 : before;
    after = after > 1 ? 1 : after;
  }
  cs_station a = station_at(d, before), b = station_at(d, after);
  double dx = b.v[0] - a.v[0], dy = b.v[1] - a.v[1], length = cs_number_length(dx, dy);
  *along = length > 0 ? (celspan_point){dx / length, dy / length} : (celspan_point){1, 0};
  return station_at(d, parameter);
}

/* A point of the outline, turned from the direction: a quarter to the right, 0 ahead. */
static celspan_status add_at(const drawer *d, const cs_station *place, celspan_point along,
                             double angle) {
  double sine, cosine, radius = 0.5 * place->v[2];
  cs_elementary_sincos(angle, &sine, &cosine);
  return cs_points_add(d->context, d->points,
                       (celspan_point){
                           place->v[0] + radius * (cosine * along.x - sine * along.y),
                           place->v[1] + radius * (sine * along.x + cosine * along.y),
                       });
}

static size_t step_count(const drawer *d) {
  double length = 0;
  size_t count = d->shape->point_count;
  for (size_t i = 0; i + !d->shape->is_closed < count; i++) {
    celspan_point a = d->shape->points[i], b = d->shape->points[(i + 1) % count];
    length += cs_number_length(a.x - b.x, a.y - b.y);
  }
  double steps = length / STEP + 4;
  return steps < MOST_POINTS ? (size_t)steps : MOST_POINTS;
}

/* One side, forwards or backwards: left of who goes that way. */
static celspan_status add_side(const drawer *d, bool is_back) {
  size_t steps = step_count(d);
  for (size_t i = 0; i < steps + !d->shape->is_closed; i++) {
    celspan_point along;
    double parameter = (double)i / (double)steps;
    cs_station place = along_at(d, is_back ? 1 - parameter : parameter, &along);
    CS_TRY(add_at(d, &place, along, is_back ? 0.5 * PI : -0.5 * PI));
  }
  return CELSPAN_OK;
}

/* Half a turn about an end, from the left side to the right one. */
static celspan_status add_cap(const drawer *d, bool is_back) {
  celspan_point along;
  cs_station place = along_at(d, is_back ? 0 : 1, &along);
  for (int i = 1; i < CAP_POINTS; i++)
    CS_TRY(add_at(d, &place, along, (is_back ? 0.5 : -0.5) * PI + PI * i / CAP_POINTS));
  return CELSPAN_OK;
}

static celspan_status add_contour(const drawer *d, cs_contours *out) {
  size_t at = out->count++;
  return cs_fit_closed(d->context, d->points, &rules, &out->start[at], &out->pieces[at]);
}

static celspan_status draw(const drawer *d, cs_contours *out) {
  CS_TRY(add_side(d, false));
  if (d->shape->is_closed) {
    CS_TRY(add_contour(d, out));
    d->points->count = 0;
    CS_TRY(add_side(d, true));
    return add_contour(d, out);
  }
  CS_TRY(add_cap(d, false));
  CS_TRY(add_side(d, true));
  CS_TRY(add_cap(d, true));
  return add_contour(d, out);
}

celspan_status cs_contours_make(celspan_context *context, const cs_shape *shape, cs_contours *out) {
  cs_points points = {.items = NULL};
  const drawer d = {context, shape, &points};
  *out = (cs_contours){.count = 0};
  celspan_status status = draw(&d, out);
  cs_points_finish(context, &points);
  return status;
}

void cs_contours_finish(celspan_context *context, cs_contours *contours) {
  for (size_t i = 0; i < contours->count; i++)
    cs_pieces_finish(context, &contours->pieces[i]);
}
