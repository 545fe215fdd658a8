#include "model/stroke/spoke.h"

#include "base/elementary.h"
#include "base/number.h"

/* of the polygon: a place with a lower speed gets its direction from its neighbours */
#define SLOW 1e-9
#define NEAR 1e-5 /* parameter: the distance of such a neighbour */
/* of the two terms whose difference is the pace: a smaller difference is rounding */
#define REST 1e-11
#define ROUNDING 1e-15 /* a share of the coordinates */

cs_spoke cs_spoke_make(celspan_point centre, double radius, celspan_point tangent, double slope) {
  double k = cs_number_clamp(slope, -1, 1), across = sqrt(1 - k * k);
  celspan_point right = cs_spoke_right(tangent);
  celspan_point v = {across * right.x - k * tangent.x, across * right.y - k * tangent.y};
  return (cs_spoke){centre, tangent, v, cs_spoke_add(centre, radius, v), radius, k};
}

cs_spoke cs_spoke_turned(const cs_spoke *spoke) {
  return cs_spoke_make(spoke->centre, spoke->radius, cs_spoke_back(spoke->tangent), -spoke->slope);
}

/* Where the line does not move: takes direction and slope from a neighbouring place. */
static cs_spoke at_rest(const cs_curve *curve, double t, const cs_curve_place *place) {
  cs_curve_place near = cs_curve_at(curve, t < 0.5 ? t + NEAR : t - NEAR);
  celspan_point away = cs_spoke_away(place->point, near.point), tangent = near.velocity;
  double length = sqrt(cs_spoke_dot(away, away)), side = t < 0.5 ? 1 : -1;
  double speed = sqrt(cs_spoke_dot(tangent, tangent)), growth = near.radius - place->radius;
  double slope = length > 0 ? growth / length : growth > 0 ? 1 : growth < 0 ? -1 : 0;
  if (t <= 0 || !(speed > 0))
    tangent = cs_curve_departure(&curve->line);
  else if (t >= 1) {
    cs_curve turned = *curve;
    cs_curve_reverse(&turned);
    tangent = cs_spoke_back(cs_curve_departure(&turned.line));
  } else
    tangent = (celspan_point){tangent.x / speed, tangent.y / speed};
  return cs_spoke_make(place->point, place->radius, tangent, side * slope);
}

/* Whether the line moves so slowly at a place that its direction is only rounding. */
static bool is_at_rest(const cs_curve *curve, const cs_curve_place *place) {
  double speed = sqrt(cs_spoke_dot(place->velocity, place->velocity));
  return !(speed > SLOW * cs_curve_extent(&curve->line));
}

cs_spoke cs_spoke_at(const cs_curve *curve, double t) {
  cs_curve_place place = cs_curve_at(curve, t);
  if (is_at_rest(curve, &place))
    return at_rest(curve, t, &place);
  double speed = sqrt(cs_spoke_dot(place.velocity, place.velocity));
  celspan_point tangent = {place.velocity.x / speed, place.velocity.y / speed};
  return cs_spoke_make(place.point, place.radius, tangent, place.growth / speed);
}

/* With v the speed, k the slope, q = sqrt(1 - k^2), o the angle by which the line turns: the spoke
 * turns by o - k' / q, and its foot goes v q across it. Both are multiplied by q, which may be 0.
 * Points are rounded, so the second derivative, and with it the turn, is no more exact than the
 * points. */
cs_spoke_motion cs_spoke_move(const cs_curve *curve, double t, const cs_spoke *spoke) {
  cs_curve_place place = cs_curve_at(curve, t);
  bool rests = is_at_rest(curve, &place);
  if (rests)
    place = cs_curve_at(curve, t < 0.5 ? t + NEAR : t - NEAR);
  double speed = sqrt(cs_spoke_dot(place.velocity, place.velocity));
  if (!(speed > 0))
    return (cs_spoke_motion){0};
  double k = spoke->slope, q = sqrt(1 - k * k), degree = curve->line.degree;
  double hurry = cs_spoke_dot(place.velocity, place.acceleration) / speed;
  double bend = (place.growth_change - k * hurry) / speed -
                q * cs_spoke_cross(place.velocity, place.acceleration) / (speed * speed);
  double across = rests ? 0 : speed * q * q, back = spoke->radius * bend;
  double hurries = sqrt(cs_spoke_dot(place.acceleration, place.acceleration)) / speed;
  double rounding =
      ROUNDING * degree * (fabs(place.point.x) + fabs(place.point.y)) * (degree + hurries) / speed;
  double drift = rests ? 0 : -k * speed;
  if (fabs(across - back) <= REST * (across + fabs(back)) + spoke->radius * rounding)
    return (cs_spoke_motion){0, spoke->radius, drift};
  return across > back ? (cs_spoke_motion){1, 0, 0} : (cs_spoke_motion){-1, across / bend, drift};
}

double cs_spoke_lean(const cs_spoke *spoke) {
  double k = spoke->slope;
  return cs_elementary_atan2(sqrt(1 - k * k), -k);
}

double cs_spoke_angle(celspan_point from, celspan_point to) {
  return cs_elementary_atan2(cs_spoke_cross(from, to), cs_spoke_dot(from, to));
}
