#include "stroke/corner.h"

#define PI 3.14159265358979323846
#define SMOOTH 1e-9 /* sine: lines that turn less go on */
#define EQUAL 1e-12 /* relative: radii */

static celspan_point rim(const cs_spoke *spoke, celspan_point direction) {
  return cs_spoke_add(spoke->centre, spoke->radius, direction);
}

static bool is_smooth(const cs_spoke *in, const cs_spoke *out) {
  return cs_spoke_dot(in->tangent, out->tangent) > 0 &&
         fabs(cs_spoke_cross(in->tangent, out->tangent)) <= SMOOTH;
}

/* ---------------------------------------------------------------- round */

/* The angle between two spokes by way of their lines; above 0 the disc shows between them. */
static double opening(const cs_spoke *in, const cs_spoke *out, double turn) {
  return turn + cs_spoke_lean(in) - cs_spoke_lean(out);
}

static celspan_status turn_round(cs_side *side, const cs_spoke *in, const cs_spoke *out,
                                 double turn) {
  double angle = opening(in, out, turn);
  if (angle > SMOOTH)
    return cs_side_arc(side, in, in->direction, out->direction, angle);
  if (angle < -SMOOTH)
    CS_TRY(cs_side_go(side, in->centre));
  return cs_side_go(side, out->tip);
}

/* Two radii at one place: the larger disc. */
static celspan_status turn_jump(cs_side *side, const cs_spoke *in, const cs_spoke *out) {
  if (out->radius > in->radius) {
    CS_TRY(cs_side_go(side, in->centre));
    return cs_side_arc(side, out, cs_spoke_back(out->tangent), out->direction,
                       PI - cs_spoke_lean(out));
  }
  CS_TRY(cs_side_arc(side, in, in->direction, in->tangent, cs_spoke_lean(in)));
  CS_TRY(cs_side_go(side, in->centre));
  return cs_side_go(side, out->tip);
}

/* ---------------------------------------------------------------- straight shapes */

/* Comes in as to a butt end: up to the normal, or to the centre where the end is straight. */
static celspan_status come_in(cs_side *side, const cs_spoke *in) {
  if (in->slope < 0)
    return cs_side_go(side, in->centre);
  celspan_point normal = cs_spoke_right(in->tangent);
  return in->slope > 0 ? cs_side_arc(side, in, in->direction, normal, cs_spoke_lean(in) - 0.5 * PI)
                       : CELSPAN_OK;
}

static celspan_status go_out(cs_side *side, const cs_spoke *out) {
  if (out->slope > 0)
    CS_TRY(cs_side_go(side, out->centre));
  if (out->slope < 0)
    return cs_side_arc(side, out, cs_spoke_right(out->tangent), out->direction,
                       0.5 * PI - cs_spoke_lean(out));
  return cs_side_go(side, out->tip);
}

/* From normal to normal, on the outside of a corner. */
static celspan_status go_outside(cs_side *side, const cs_stroke *stroke, const cs_spoke *in,
                                 const cs_spoke *out) {
  celspan_point a = cs_spoke_right(in->tangent), b = cs_spoke_right(out->tangent);
  double cosine = cs_spoke_dot(a, b), limit = stroke->miter;
  CS_TRY(cs_side_go(side, rim(in, a)));
  if (stroke->join == CELSPAN_JOIN_MITER && 2 <= limit * limit * (1 + cosine))
    CS_TRY(cs_side_go(side, cs_spoke_add(in->centre, in->radius / (1 + cosine),
                                         (celspan_point){a.x + b.x, a.y + b.y})));
  return cs_side_go(side, rim(out, b));
}

celspan_status cs_corner_turn(cs_side *side, const cs_stroke *stroke, const cs_spoke *in,
                              const cs_spoke *out) {
  if (fabs(in->radius - out->radius) > EQUAL * (in->radius + out->radius))
    return turn_jump(side, in, out);
  if (is_smooth(in, out))
    return turn_round(side, in, out, 0);
  double turn = cs_spoke_angle(in->tangent, out->tangent);
  /* Of a half turn one side is the outside, whichever way the line is followed. */
  if (fabs(turn) > PI - 1e-9)
    turn = side->is_turned ? -fabs(turn) : fabs(turn);
  if (stroke->join == CELSPAN_JOIN_ROUND)
    return turn_round(side, in, out, turn);
  CS_TRY(come_in(side, in));
  if (turn > 0)
    CS_TRY(go_outside(side, stroke, in, out));
  else
    CS_TRY(cs_side_go(side, in->centre));
  return go_out(side, out);
}

/* The triangle in front of a line that gets narrower up to its end. */
static celspan_status add_straight_end(cs_side *side, const cs_spoke *end) {
  if (!(end->slope < 0))
    return CELSPAN_OK;
  cs_spoke turned = cs_spoke_turned(end);
  CS_TRY(cs_side_go(side, end->centre));
  CS_TRY(cs_side_go(side, end->tip));
  CS_TRY(cs_side_go(side, turned.tip));
  return cs_side_close(side);
}

celspan_status cs_corner_turn_more(cs_side *side, const cs_stroke *stroke, const cs_spoke *in,
                                   const cs_spoke *out) {
  bool is_round = stroke->join == CELSPAN_JOIN_ROUND || is_smooth(in, out) ||
                  fabs(in->radius - out->radius) > EQUAL * (in->radius + out->radius);
  if (is_round)
    return CELSPAN_OK;
  cs_spoke back = cs_spoke_turned(out);
  CS_TRY(add_straight_end(side, in));
  return add_straight_end(side, &back);
}

/* ---------------------------------------------------------------- caps */

/* The two corners of a square cap, from the right to the left. */
static celspan_status go_square(cs_side *side, const cs_spoke *end) {
  celspan_point right = rim(end, cs_spoke_right(end->tangent));
  celspan_point left = rim(end, cs_spoke_left(end->tangent));
  CS_TRY(cs_side_go(side, right));
  CS_TRY(cs_side_go(side, cs_spoke_add(right, end->radius, end->tangent)));
  CS_TRY(cs_side_go(side, cs_spoke_add(left, end->radius, end->tangent)));
  return cs_side_go(side, left);
}

celspan_status cs_corner_cap(cs_side *side, const cs_stroke *stroke, const cs_spoke *end) {
  cs_spoke turned = cs_spoke_turned(end);
  double lean = cs_spoke_lean(end);
  celspan_point left = cs_spoke_left(end->tangent);
  if (stroke->cap == CELSPAN_CAP_ROUND)
    return cs_side_arc(side, end, end->direction, turned.direction, 2 * lean);
  bool is_square = stroke->cap == CELSPAN_CAP_SQUARE;
  if (end->slope < 0 || (end->slope == 0 && !is_square))
    return cs_side_go(side, turned.tip);
  CS_TRY(come_in(side, end));
  CS_TRY(is_square ? go_square(side, end) : cs_side_go(side, rim(end, left)));
  return end->slope > 0 ? cs_side_arc(side, end, left, turned.direction, lean - 0.5 * PI)
                        : CELSPAN_OK;
}

celspan_status cs_corner_cap_more(cs_side *side, const cs_stroke *stroke, const cs_spoke *end) {
  if (stroke->cap != CELSPAN_CAP_SQUARE || !(end->slope < 0) || !(end->radius > 0))
    return CELSPAN_OK;
  CS_TRY(go_square(side, end));
  return cs_side_close(side);
}

celspan_status cs_corner_cut(cs_side *side, const cs_spoke *end) {
  cs_spoke turned = cs_spoke_turned(end);
  CS_TRY(cs_side_go(side, end->centre));
  return cs_side_go(side, turned.tip);
}

celspan_status cs_corner_dot(cs_side *side, const cs_stroke *stroke, const cs_spoke *place) {
  if (stroke->cap == CELSPAN_CAP_BUTT || !(place->radius > 0))
    return CELSPAN_OK;
  if (stroke->cap == CELSPAN_CAP_ROUND)
    CS_TRY(cs_side_arc(side, place, place->tangent, place->tangent, 2 * PI));
  else {
    const cs_spoke back =
        cs_spoke_make(place->centre, place->radius, cs_spoke_back(place->tangent), 0);
    CS_TRY(go_square(side, place));
    CS_TRY(go_square(side, &back));
  }
  return cs_side_close(side);
}
