#include "stroke/spoke.h"

#include "base/elementary.h"
#include "base/number.h"

#define SLOW 1e-9 /* of the polygon: a slower place has its direction from its neighbours */
#define NEAR 1e-5 /* parameter: such a neighbour */

cs_spoke cs_spoke_make(celspan_point centre, double radius, celspan_point tangent, double slope) {
  double k = cs_number_clamp(slope, -1, 1), across = sqrt(1 - k * k);
  celspan_point right = cs_spoke_right(tangent);
  celspan_point v = {across * right.x - k * tangent.x, across * right.y - k * tangent.y};
  return (cs_spoke){centre, tangent, v, cs_spoke_add(centre, radius, v), radius, k};
}

cs_spoke cs_spoke_turned(const cs_spoke *spoke) {
  return cs_spoke_make(spoke->centre, spoke->radius, cs_spoke_back(spoke->tangent), -spoke->slope);
}

/* Where the line stands still: direction and slope of what comes next to it. */
static cs_spoke at_rest(const cs_curve *curve, double t, const cs_curve_place *place) {
  double beside = t < 0.5 ? t + NEAR : t - NEAR;
  cs_curve_place near = cs_curve_at(curve, beside);
  celspan_point away = cs_spoke_away(place->point, near.point), tangent;
  double length = sqrt(cs_spoke_dot(away, away)), side = t < 0.5 ? 1 : -1;
  if (t > 0.5) {
    cs_curve turned = *curve;
    cs_curve_reverse(&turned);
    tangent = cs_spoke_back(cs_curve_departure(&turned.line));
  } else
    tangent = cs_curve_departure(&curve->line);
  double growth = near.radius - place->radius;
  double slope = length > 0 ? growth / length : growth > 0 ? 1 : growth < 0 ? -1 : 0;
  if (t > 0 && t < 1 && length > 0)
    tangent = (celspan_point){side * away.x / length, side * away.y / length};
  return cs_spoke_make(place->point, place->radius, tangent, side * slope);
}

cs_spoke cs_spoke_at(const cs_curve *curve, double t) {
  cs_curve_place place = cs_curve_at(curve, t);
  const cs_hpoint *first = &curve->line.points[0], *last = &curve->line.points[curve->line.degree];
  double chord =
      fabs(last->x / last->w - first->x / first->w) + fabs(last->y / last->w - first->y / first->w);
  double speed = sqrt(cs_spoke_dot(place.velocity, place.velocity));
  if (!(speed > SLOW * chord))
    return at_rest(curve, t, &place);
  celspan_point tangent = {place.velocity.x / speed, place.velocity.y / speed};
  return cs_spoke_make(place.point, place.radius, tangent, place.growth / speed);
}

double cs_spoke_lean(const cs_spoke *spoke) {
  double k = spoke->slope;
  return cs_elementary_atan2(sqrt(1 - k * k), -k);
}

double cs_spoke_angle(celspan_point from, celspan_point to) {
  return cs_elementary_atan2(cs_spoke_cross(from, to), cs_spoke_dot(from, to));
}
