/* Following a curve: the way of the tips of its spokes, as cubics.
 *
 *    line       a ---------------------> b     A curve is halved until five of its spokes, evenly
 *                \      \    |    /     /      spaced by the parameter, turn by little and go one
 *    spokes       \      \   |   /     /       way: forwards, where one cubic is fitted to their
 *                  *------*--*--*-----*        tips, or backwards, where another is fitted to their
 *                s[0]   s[1] .. s[3] s[4]      pivots. Where the tips turn round it is cut.
 *
 * Invariants: the cubics are within the view's tolerance of the spokes, so their number grows with
 * the fourth root of the size, or less. Two sides of a curve are halved at the same places, so the
 * points that they share are the same to the bit.
 */
#include "model/stroke/side.h"

#define DEPTH 48  /* cuts of a curve: more would not change a double */
#define CONE 0.82 /* cosine of 35 degrees: how far a curve may turn from its chord */
#define TURN 0.5  /* cosine of 60 degrees: how far spokes of a fitted curve may turn */
#define SMALL 0.1 /* share of the tolerance: anything smaller is a point */
/* pixels: half the width up to which both errors of the sweep may be as large as the width */
#define THIN 0.04
/* pixels: sides that are closer than this are the same curve, wherever they are drawn */
#define HAIR 1e-4
#define RESTING 0.02   /* a share of the speed at the other end */
#define HALF_TURN 1e-9 /* sine: a turn nearer to a half turn counts as one */
#define ROOT_STEPS 100

/* Spokes of a part of a curve, evenly spaced by the parameter, and how they move. All are taken
 * from the whole curve: points of a short part are rounded too much to show how the part bends. */
#define SPOKES 5

typedef struct fan {
  double begin, end; /* parameters */
  cs_spoke spokes[SPOKES];
  cs_spoke_motion motions[SPOKES];
} fan;

/* A part of a curve that is followed. */
typedef struct stretch {
  const cs_curve *whole;
  cs_curve part;
  double begin, end; /* parameters of the whole */
  cs_spoke first, last;
  /* the stretch was cut there because the tips turn round: at that end they do not move */
  bool begins_turning, ends_turning;
} stretch;

static double parameter(const fan *f, int i) { return f->begin + 0.25 * i * (f->end - f->begin); }

static void rest(cs_spoke_motion *motion, const cs_spoke *spoke) {
  motion->pace = 0;
  motion->pivot = spoke->radius;
}

static fan spread(const stretch *s) {
  fan f = {.begin = s->begin, .end = s->end};
  for (int i = 0; i < SPOKES; i++) {
    double t = parameter(&f, i);
    f.spokes[i] = i == 0 ? s->first : i == 4 ? s->last : cs_spoke_at(s->whole, t);
    f.motions[i] = cs_spoke_move(s->whole, t, &f.spokes[i]);
  }
  if (s->begins_turning)
    rest(&f.motions[0], &s->first);
  if (s->ends_turning)
    rest(&f.motions[4], &s->last);
  return f;
}

/* 1: all tips go forwards or do not move; -1: all go backwards or do not move; 0: they differ. */
static int way_of(const fan *f) {
  bool goes_on = false, goes_back = false;
  for (int i = 0; i < SPOKES; i++) {
    goes_on |= f->motions[i].pace > 0;
    goes_back |= f->motions[i].pace < 0;
  }
  return !goes_back ? 1 : goes_on ? 0 : -1;
}

/* Whether all sides of the polygon go roughly along its chord; then the line does so, too. */
static bool goes_along(const cs_bezier *line) {
  celspan_point from = cs_hpoint_place(line->points[0]), chord;
  chord = cs_spoke_away(from, cs_hpoint_place(line->points[line->degree]));
  double length = sqrt(cs_spoke_dot(chord, chord));
  for (int i = 1; i <= line->degree; i++) {
    celspan_point to = cs_hpoint_place(line->points[i]), way = cs_spoke_away(from, to);
    if (cs_spoke_dot(way, chord) < CONE * length * sqrt(cs_spoke_dot(way, way)))
      return false;
    from = to;
  }
  return true;
}

/* ---------------------------------------------------------------- tips */

/* The cubic that leaves and arrives along the side, or against it, and meets the middle tip; false
 * if no such cubic is good enough. Where the tips turn round at an end, it has no handle there. */
static bool fit_tips(const cs_spoke s[SPOKES], int way, celspan_point p[4]) {
  celspan_point from = cs_spoke_left(s[0].direction), to = cs_spoke_left(s[4].direction);
  celspan_point chord = cs_spoke_away(s[0].tip, s[4].tip);
  double length = sqrt(cs_spoke_dot(chord, chord)), turn = cs_spoke_cross(from, to);
  double first = way * length / 3, second = way * length / 3;
  if (fabs(turn) > 1e-4) {
    celspan_point bulge = {s[2].tip.x - 0.5 * (s[0].tip.x + s[4].tip.x),
                           s[2].tip.y - 0.5 * (s[0].tip.y + s[4].tip.y)};
    first = 8.0 / 3 * cs_spoke_cross(bulge, to) / turn;
    second = 8.0 / 3 * cs_spoke_cross(bulge, from) / turn;
  }
  bool is_good = way * first > -0.1 * length && way * second > -0.1 * length;
  first = way * fmax(0, way * first);
  second = way * fmax(0, way * second);
  p[0] = s[0].tip;
  p[1] = cs_spoke_add(s[0].tip, first, from);
  p[2] = cs_spoke_add(s[4].tip, -second, to);
  p[3] = s[4].tip;
  return is_good && way * (first + second) < 1.2 * length;
}

/* The error of a cubic near a parameter, measured at the point of the cubic that is nearest to the
 * tip. */
static double tip_error(const cs_side *side, const celspan_point p[4], double t,
                        const cs_spoke *spoke) {
  celspan_point at = cs_side_on_cubic(p, t);
  celspan_point along = cs_spoke_left(spoke->direction);
  for (int i = 0; i < 2; i++) {
    const double h = 1e-4;
    celspan_point ahead = cs_side_on_cubic(p, t + h);
    double pace = cs_spoke_dot(cs_spoke_away(at, ahead), along) / h;
    t += pace != 0 ? cs_spoke_dot(cs_spoke_away(at, spoke->tip), along) / pace : 0;
    t = fmin(1, fmax(0, t));
    at = cs_side_on_cubic(p, t);
  }
  return cs_stroke_view_error(side->view, at, spoke->tip);
}

static bool fits_tips(const cs_side *side, const cs_spoke s[SPOKES], int way, celspan_point p[4]) {
  if (!fit_tips(s, way, p))
    return false;
  double allowed = cs_side_allowance(side, p, 4, 0);
  for (int i = 1; i < SPOKES - 1; i++)
    if (tip_error(side, p, 0.25 * i, &s[i]) > allowed)
      return false;
  return true;
}

/* Whether all tips are on the chord. */
static bool is_flat(const cs_side *side, const cs_spoke s[SPOKES]) {
  celspan_point chord = cs_spoke_away(s[0].tip, s[4].tip);
  const celspan_point tips[5] = {s[0].tip, s[1].tip, s[2].tip, s[3].tip, s[4].tip};
  double square = cs_spoke_dot(chord, chord), allowed = cs_side_allowance(side, tips, 5, 0.25);
  for (int i = 1; i < SPOKES - 1; i++) {
    double along = cs_spoke_dot(cs_spoke_away(s[0].tip, s[i].tip), chord);
    double share = square > 0 ? fmin(1, fmax(0, along / square)) : 0;
    if (cs_stroke_view_error(side->view, cs_spoke_add(s[0].tip, share, chord), s[i].tip) > allowed)
      return false;
  }
  return true;
}

/* How many of the spokes are shorter than some pixels. */
static int count_short(const cs_side *side, const cs_spoke s[SPOKES], double pixels) {
  int count = 0;
  for (int i = 0; i < SPOKES; i++)
    count += cs_stroke_view_error(side->view, s[i].centre, s[i].tip) < pixels;
  return count;
}

/* Whether places and radii grow evenly. The result is the same for both sides: both then have
 * straight lines between the same places, which never change. */
static bool is_even(const cs_side *side, const cs_spoke s[SPOKES]) {
  const celspan_point ends[2] = {s[0].centre, s[4].centre};
  celspan_point chord = cs_spoke_away(ends[0], ends[1]);
  double allowed = 0.5 * cs_side_allowance(side, ends, 2, 0.25);
  for (int i = 1; i < SPOKES - 1; i++) {
    double square = cs_spoke_dot(chord, chord);
    double share = cs_spoke_dot(cs_spoke_away(ends[0], s[i].centre), chord);
    share = square > 0 ? fmin(1, fmax(0, share / square)) : 0;
    celspan_point ought = cs_spoke_add(ends[0], share, chord);
    double growth = s[0].radius + share * (s[4].radius - s[0].radius) - s[i].radius;
    celspan_point wider = {ought.x + fabs(growth), ought.y};
    if (cs_stroke_view_error(side->view, s[i].centre, ought) > allowed ||
        cs_stroke_view_error(side->view, wider, ought) > allowed)
      return false;
  }
  return true;
}

/* Whether all tips are one point. */
static bool are_one(const cs_side *side, const cs_spoke s[SPOKES]) {
  double allowed = SMALL * cs_side_allowance(side, &s[0].tip, 1, 0);
  for (int i = 1; i < SPOKES; i++)
    if (cs_stroke_view_error(side->view, s[i].tip, s[0].tip) > allowed)
      return false;
  return true;
}

/* ---------------------------------------------------------------- pivots */

/* The speeds of pivots along the first and the last spoke while the fan is swept. A speed is the
 * growth of the distance, from the polynomial through the five pivots, plus the drift of the
 * place. */
static void find_speeds(const fan *f, double speeds[2]) {
  double d[SPOKES], length = f->end - f->begin;
  for (int i = 0; i < SPOKES; i++)
    d[i] = f->motions[i].pivot;
  speeds[0] = (-25 * d[0] + 48 * d[1] - 36 * d[2] + 16 * d[3] - 3 * d[4]) / 3;
  speeds[1] = (25 * d[4] - 48 * d[3] + 36 * d[2] - 16 * d[1] + 3 * d[0]) / 3;
  speeds[0] += length * f->motions[0].drift;
  speeds[1] += length * f->motions[4].drift;
}

static celspan_point pivot_of(const fan *f, int i) {
  return cs_spoke_add(f->spokes[i].centre, f->motions[i].pivot, f->spokes[i].direction);
}

/* Whether all pivots are one point, as in a circle: their motion is only rounding, and
 * following it would cut the curve into thousands of pieces between which light leaks. */
static bool is_round(const cs_side *side, const fan *f) {
  const celspan_point first = pivot_of(f, 0);
  double allowed = SMALL * cs_side_allowance(side, &first, 1, 0);
  for (int i = 1; i < SPOKES; i++)
    if (cs_stroke_view_error(side->view, pivot_of(f, i), first) > allowed)
      return false;
  return true;
}

/* Where pivots reverse, as at the sharpest point of a bend, their path has a cusp, at which it must
 * be cut: a cubic would go round it in the wrong order. If a cusp is so near to an end that it
 * makes no difference, pivots do not move there. */
static bool has_cusp(double speeds[2]) {
  int least = fabs(speeds[0]) < fabs(speeds[1]) ? 0 : 1;
  if (!(speeds[0] * speeds[1] < 0))
    return false;
  if (fabs(speeds[least]) > RESTING * fabs(speeds[1 - least]))
    return true;
  speeds[least] = 0;
  return false;
}

static bool fits_pivots(const cs_side *side, const fan *f, const double speeds[2],
                        celspan_point p[4]) {
  const cs_spoke *s = f->spokes;
  p[0] = pivot_of(f, 0);
  p[3] = pivot_of(f, 4);
  p[1] = cs_spoke_add(p[0], speeds[0] / 3, s[0].direction);
  p[2] = cs_spoke_add(p[3], -speeds[1] / 3, s[4].direction);
  double allowed = cs_side_allowance(side, p, 4, 0);
  for (int i = 1; i < SPOKES - 1; i++) {
    celspan_point ought = pivot_of(f, i);
    if (cs_stroke_view_error(side->view, cs_side_on_cubic(p, 0.25 * i), ought) > allowed)
      return false;
  }
  return true;
}

/* ---------------------------------------------------------------- curves */

static bool is_point(const cs_side *side, const cs_curve *curve, const cs_spoke *a,
                     const cs_spoke *b) {
  const celspan_point wider = {a->centre.x + (b->radius - a->radius), a->centre.y};
  const celspan_box disc = {a->centre.x - a->radius, a->centre.y - a->radius, 2 * a->radius,
                            2 * a->radius};
  double allowed = SMALL * cs_stroke_view_allowance(side->view, &disc);
  if (cs_stroke_view_error(side->view, wider, a->centre) > allowed)
    return false;
  for (int i = 1; i <= curve->line.degree; i++)
    if (cs_stroke_view_error(side->view, cs_hpoint_place(curve->line.points[i]), a->centre) >
        allowed)
      return false;
  return true;
}

/* Whether the line turns to the left at a place where it does not move. A half turn counts as a
 * turn to the left, seen in the direction of the line. */
static bool opens(const cs_side *side, const cs_spoke *a, const cs_spoke *b) {
  celspan_point from = side->is_turned ? cs_spoke_back(b->tangent) : a->tangent;
  celspan_point to = side->is_turned ? cs_spoke_back(a->tangent) : b->tangent;
  return (cs_spoke_cross(from, to) >= -HALF_TURN) != side->is_turned;
}

/* A curve that is as short as a point, about which the spoke turns. */
static celspan_status turn(cs_side *side, const cs_spoke *a, const cs_spoke *b) {
  double angle = cs_spoke_angle(a->direction, b->direction);
  if (fabs(angle) > 3)
    angle = opens(side, a, b) ? fabs(angle) : -fabs(angle);
  return angle >= 0 ? cs_side_arc(side, b, a->direction, b->direction, angle)
                    : cs_side_fold_arc(side, a, b, -angle);
}

/* Whether nothing can be seen of the area that the spokes of a curve sweep over: then every path
 * from tip to tip inside the same box is good enough. */
static bool is_hidden(const cs_side *side, const cs_curve *curve) {
  celspan_box box = cs_curve_box(curve, 1);
  return cs_stroke_view_hides(side->view, &box);
}

/* The tips go forwards. */
static celspan_status draw_forwards(cs_side *side, const fan *f, bool *is_done) {
  const cs_spoke *s = f->spokes;
  celspan_point tips[4];
  bool is_thin = count_short(side, s, THIN) > 0 && count_short(side, s, HAIR) < SPOKES;
  if (!is_thin && fits_tips(side, s, 1, tips))
    return cs_side_curve(side, tips);
  *is_done =
      is_thin ? count_short(side, s, 2 * THIN) == SPOKES && is_even(side, s) : is_flat(side, s);
  return *is_done ? cs_side_go(side, s[4].tip) : CELSPAN_OK;
}

/* The tips go backwards. */
static celspan_status draw_backwards(cs_side *side, const fan *f, double *at, bool *is_done) {
  double speeds[2];
  celspan_point tips[4], pivots[4];
  if (is_round(side, f))
    speeds[0] = speeds[1] = 0;
  else
    find_speeds(f, speeds);
  if (has_cusp(speeds))
    *at = f->begin + speeds[0] / (speeds[0] - speeds[1]) * (f->end - f->begin);
  else if (fits_tips(side, f->spokes, -1, tips) && fits_pivots(side, f, speeds, pivots))
    return cs_side_fold(side, tips, pivots);
  *is_done = false;
  return CELSPAN_OK;
}

/* Where the tips of a curve turn round: between the first two neighbouring spokes that move in
 * different directions. */
static double find_turn(const cs_curve *curve, const fan *f) {
  int before = -1, i = 0;
  for (; i < SPOKES; i++) {
    if (f->motions[i].pace == 0)
      continue;
    if (before >= 0 && (f->motions[i].pace > 0) != (f->motions[before].pace > 0))
      break;
    before = i;
  }
  double low = parameter(f, before), high = parameter(f, i);
  bool goes_on = f->motions[before].pace > 0;
  for (int step = 0; step < ROOT_STEPS && 0.5 * (low + high) > low; step++) {
    double t = 0.5 * (low + high);
    cs_spoke spoke = cs_spoke_at(curve, t);
    double pace = cs_spoke_move(curve, t, &spoke).pace;
    if (pace == 0)
      return t;
    if ((pace > 0) == goes_on)
      low = t;
    else
      high = t;
  }
  return high;
}

static void cut(const stretch *s, double t, bool is_turn, stretch *low, stretch *high) {
  double share = (t - s->begin) / (s->end - s->begin);
  *low = *high = *s;
  low->end = high->begin = t;
  low->last = high->first = cs_spoke_at(s->whole, t);
  low->ends_turning = high->begins_turning = is_turn;
  cs_curve_split(&s->part, share, &low->part, &high->part);
}

/* Draws a stretch if possible; otherwise sets `at` to the parameter at which it must be cut. */
static celspan_status draw(cs_side *side, const stretch *s, double *at, bool *is_turn,
                           bool *is_done) {
  if (!goes_along(&s->part.line) || cs_spoke_dot(s->first.direction, s->last.direction) <= TURN) {
    *is_done = false;
    return CELSPAN_OK;
  }
  const fan f = spread(s);
  int way = way_of(&f);
  *is_done = true;
  if (way > 0)
    return draw_forwards(side, &f, is_done);
  if (are_one(side, f.spokes))
    return cs_side_go(side, s->last.tip);
  if (way < 0)
    return draw_backwards(side, &f, at, is_done);
  *at = find_turn(s->whole, &f);
  *is_turn = true;
  *is_done = false;
  return CELSPAN_OK;
}

static celspan_status follow(cs_side *side, const stretch *s, int depth) {
  double at = 0.5 * (s->begin + s->end);
  bool is_turn = false, is_done;
  if (side->may_hide && is_hidden(side, &s->part))
    return cs_side_go(side, s->last.tip);
  CS_TRY(draw(side, s, &at, &is_turn, &is_done));
  if (is_done)
    return CELSPAN_OK;
  if (depth == DEPTH || is_point(side, &s->part, &s->first, &s->last))
    return turn(side, &s->first, &s->last);
  stretch low, high;
  cut(s, at, is_turn, &low, &high);
  CS_TRY(follow(side, &low, depth + 1));
  return follow(side, &high, depth + 1);
}

celspan_status cs_follow_curve(cs_side *side, const cs_curve *curve, const cs_spoke *first,
                               const cs_spoke *last) {
  CS_TRY(cs_side_go(side, first->tip));
  if (cs_curve_is_straight(&curve->line) && curve->radius_degree <= 1)
    return cs_side_go(side, last->tip);
  const stretch whole = {curve, *curve, 0, 1, *first, *last, false, false};
  return follow(side, &whole, 0);
}
