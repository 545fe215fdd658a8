#include "stroke/side.h"

#include "base/elementary.h"

#define PI 3.14159265358979323846
#define DEPTH 48      /* halvings of a curve: more would not change a double */
#define CONE 0.82     /* cosine of 35 degrees: how far a curve may turn from its chord */
#define TURN 0.5      /* cosine of 60 degrees: how far spokes of a fitted curve may turn */
#define FORWARDS 0.05 /* of radius times angle: a fitted way goes forwards at least so fast */
#define SMALL 0.1     /* of what is allowed: a curve within it is a point */
#define ARC_DEPTH 20
#define ARC_WORST 0.2113 /* parameter at which a cubic is farthest from its arc */
#define MOST_STEPS 4096  /* in one turn of a fold */

void cs_side_init(cs_side *side, celspan_context *context, const cs_stroke_view *view,
                  cs_outline *outline) {
  *side = (cs_side){.context = context, .view = view, .outline = outline};
  cs_outline_init(&side->folds);
}

void cs_side_finish(cs_side *side) {
  cs_memory *memory = side->context->memory;
  cs_mem_free(memory, side->tips, side->tip_capacity * sizeof *side->tips);
  cs_mem_free(memory, side->intersections,
              side->intersection_capacity * sizeof *side->intersections);
  cs_outline_finish(&side->folds, memory);
}

static cs_hpoint plain(celspan_point p) { return (cs_hpoint){p.x, p.y, 1}; }

static bool are_same(celspan_point a, celspan_point b) { return a.x == b.x && a.y == b.y; }

/* ---------------------------------------------------------------- lines and folds */

static celspan_status draw_line(cs_side *side, celspan_point to) {
  if (side->is_begun && are_same(side->at, to))
    return CELSPAN_OK;
  CS_TRY(side->is_begun ? cs_outline_line(side->context, side->outline, plain(to))
                        : cs_outline_move(side->context, side->outline, plain(to)));
  side->is_begun = true;
  side->at = to;
  return CELSPAN_OK;
}

/* The tips backwards, then the intersections forwards. */
static celspan_status end_fold(cs_side *side) {
  if (side->tip_count == 0)
    return CELSPAN_OK;
  CS_TRY(draw_line(side, side->tips[side->tip_count - 1]));
  CS_TRY(cs_outline_move(side->context, &side->folds, plain(side->tips[side->tip_count - 1])));
  for (size_t i = side->tip_count - 1; i-- > 0;)
    CS_TRY(cs_outline_line(side->context, &side->folds, plain(side->tips[i])));
  for (size_t i = 0; i < side->intersection_count; i++)
    CS_TRY(cs_outline_line(side->context, &side->folds, plain(side->intersections[i])));
  side->tip_count = side->intersection_count = 0;
  return CELSPAN_OK;
}

static celspan_status push_tip(cs_side *side, celspan_point tip) {
  CS_TRY(cs_mem_reserve(side->context, (void **)&side->tips, &side->tip_capacity,
                        side->tip_count + 1, sizeof *side->tips));
  side->tips[side->tip_count++] = tip;
  return CELSPAN_OK;
}

/* A step of a fold: the side goes to the intersection of two spokes. */
static celspan_status fold_step(cs_side *side, celspan_point from, celspan_point intersection,
                                celspan_point to) {
  if (side->tip_count > 0 && !are_same(side->tips[side->tip_count - 1], from))
    CS_TRY(end_fold(side));
  if (side->tip_count == 0) {
    CS_TRY(draw_line(side, from));
    CS_TRY(push_tip(side, from));
  }
  CS_TRY(cs_mem_reserve(side->context, (void **)&side->intersections, &side->intersection_capacity,
                        side->intersection_count + 1, sizeof *side->intersections));
  side->intersections[side->intersection_count++] = intersection;
  CS_TRY(push_tip(side, to));
  return draw_line(side, intersection);
}

celspan_status cs_side_go(cs_side *side, celspan_point to) {
  CS_TRY(end_fold(side));
  return draw_line(side, to);
}

celspan_status cs_side_close(cs_side *side) {
  CS_TRY(end_fold(side));
  side->is_begun = false;
  return cs_outline_close(side->context, side->outline);
}

celspan_status cs_side_add_folds(cs_side *side) {
  const cs_outline *folds = &side->folds;
  CS_TRY(cs_outline_close(side->context, &side->folds));
  for (size_t i = 0; i < folds->contour_count; i++) {
    size_t begin, end;
    cs_stroke_contour(folds, i, &begin, &end);
    CS_TRY(cs_outline_move(side->context, side->outline, folds->points[folds->starts[begin]]));
    for (size_t piece = begin; piece < end; piece++)
      CS_TRY(
          cs_outline_line(side->context, side->outline, folds->points[folds->starts[piece] + 1]));
  }
  CS_TRY(cs_outline_close(side->context, side->outline));
  side->folds.contour_count = side->folds.piece_count = side->folds.point_count = 0;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- arcs */

static celspan_status draw_curve(cs_side *side, celspan_point a, celspan_point b,
                                 celspan_point to) {
  const cs_hpoint points[3] = {plain(a), plain(b), plain(to)};
  CS_TRY(end_fold(side));
  side->at = to;
  return cs_outline_piece(side->context, side->outline, 3, points);
}

static celspan_point on_cubic(const celspan_point p[4], double t) {
  double s = 1 - t, a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
  return (celspan_point){a * p[0].x + b * p[1].x + c * p[2].x + d * p[3].x,
                         a * p[0].y + b * p[1].y + c * p[2].y + d * p[3].y};
}

static double arc_error(const cs_side *side, const cs_spoke *about, const celspan_point p[4]) {
  celspan_point at = on_cubic(p, ARC_WORST), away = cs_spoke_away(about->centre, at);
  double length = sqrt(cs_spoke_dot(away, away));
  celspan_point ought = cs_spoke_add(about->centre, about->radius / length, away);
  return length > 0 ? cs_stroke_view_error(side->view, at, ought) : 0;
}

/* The box of some points, larger by a share of its size on every side. */
static celspan_box box_of(const celspan_point *points, int count, double share) {
  celspan_point least = points[0], most = points[0];
  for (int i = 1; i < count; i++) {
    least = (celspan_point){fmin(least.x, points[i].x), fmin(least.y, points[i].y)};
    most = (celspan_point){fmax(most.x, points[i].x), fmax(most.y, points[i].y)};
  }
  double margin = share * fmax(most.x - least.x, most.y - least.y);
  return (celspan_box){least.x - margin, least.y - margin, most.x - least.x + 2 * margin,
                       most.y - least.y + 2 * margin};
}

static double allowance(const cs_side *side, const celspan_point *points, int count, double share) {
  celspan_box box = box_of(points, count, share);
  return cs_stroke_view_allowance(side->view, &box);
}

/* At most a quarter turn. */
static celspan_status draw_arc(cs_side *side, const cs_spoke *about, celspan_point from,
                               celspan_point to, int depth) {
  double cosine = cs_spoke_dot(from, to), half = sqrt(fmax(0, 0.5 * (1 + cosine)));
  double handle = 4.0 / 3 * sqrt(fmax(0, 0.5 * (1 - cosine))) / (1 + half) * about->radius;
  celspan_point end = cs_spoke_add(about->centre, about->radius, to);
  const celspan_point p[4] = {side->at, cs_spoke_add(side->at, handle, cs_spoke_left(from)),
                              cs_spoke_add(end, -handle, cs_spoke_left(to)), end};
  if (depth == ARC_DEPTH || !(arc_error(side, about, p) > allowance(side, p, 4, 0)))
    return draw_curve(side, p[1], p[2], end);
  celspan_point middle = {(from.x + to.x) / (2 * half), (from.y + to.y) / (2 * half)};
  CS_TRY(draw_arc(side, about, from, middle, depth + 1));
  return draw_arc(side, about, middle, to, depth + 1);
}

celspan_status cs_side_arc(cs_side *side, const cs_spoke *about, celspan_point from,
                           celspan_point to, double angle) {
  CS_TRY(cs_side_go(side, cs_spoke_add(about->centre, about->radius, from)));
  if (!(about->radius > 0))
    return CELSPAN_OK;
  for (; angle > 0.5 * PI + 1e-9; angle -= 0.5 * PI) {
    CS_TRY(draw_arc(side, about, from, cs_spoke_left(from), 0));
    from = cs_spoke_left(from);
  }
  return draw_arc(side, about, from, to, 0);
}

/* ---------------------------------------------------------------- steps */

/* Where two spokes cross; false when they do not. */
static bool find_intersection(const cs_spoke *a, const cs_spoke *b, celspan_point *out) {
  celspan_point way = cs_spoke_away(a->centre, b->centre);
  double turn = cs_spoke_cross(a->direction, b->direction);
  double first = cs_spoke_cross(way, b->direction) / turn;
  double second = cs_spoke_cross(way, a->direction) / turn;
  *out = cs_spoke_add(a->centre, first, a->direction);
  return turn != 0 && first > 0 && first < a->radius && second > 0 && second < b->radius;
}

/* From tip to tip, by the intersection of the spokes where there is one. */
static celspan_status step(cs_side *side, const cs_spoke *a, const cs_spoke *b) {
  celspan_point intersection;
  return find_intersection(a, b, &intersection) ? fold_step(side, a->tip, intersection, b->tip)
                                                : cs_side_go(side, b->tip);
}

/* Whether the line turns to the left at a place where it stands still. A half turn counts as one to
 * the left of the line's own way. */
static bool opens(const cs_side *side, const cs_spoke *a, const cs_spoke *b) {
  celspan_point from = side->is_turned ? cs_spoke_back(b->tangent) : a->tangent;
  celspan_point to = side->is_turned ? cs_spoke_back(a->tangent) : b->tangent;
  return (cs_spoke_cross(from, to) >= 0) != side->is_turned;
}

/* A curve that is as good as a point, about which the spoke turns. */
static celspan_status turn(cs_side *side, const cs_spoke *a, const cs_spoke *b) {
  double angle = cs_spoke_angle(a->direction, b->direction);
  if (fabs(angle) > 3)
    angle = opens(side, a, b) ? fabs(angle) : -fabs(angle);
  if (angle >= 0)
    return cs_side_arc(side, b, a->direction, b->direction, angle);
  double size = cs_stroke_view_error(side->view, b->centre, b->tip) / side->view->tolerance;
  int count = (int)fmin(MOST_STEPS, ceil(-angle * sqrt(size / 8) + 1));
  celspan_point from = a->tip, v = a->direction;
  double sine, cosine;
  cs_elementary_sincos(angle / count, &sine, &cosine);
  for (int i = 1; i <= count; i++) {
    v = i == count ? b->direction
                   : (celspan_point){cosine * v.x - sine * v.y, sine * v.x + cosine * v.y};
    celspan_point to = cs_spoke_add(b->centre, b->radius, v);
    CS_TRY(fold_step(side, from, b->centre, i == count ? b->tip : to));
    from = to;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- fitted curves */

static celspan_point project(cs_hpoint p) { return (celspan_point){p.x / p.w, p.y / p.w}; }

/* Whether all sides of the polygon go roughly along its chord: then so does the line. */
static bool goes_along(const cs_bezier *line) {
  celspan_point from = project(line->points[0]), chord;
  chord = cs_spoke_away(from, project(line->points[line->degree]));
  double length = sqrt(cs_spoke_dot(chord, chord));
  for (int i = 1; i <= line->degree; i++) {
    celspan_point to = project(line->points[i]), way = cs_spoke_away(from, to);
    if (cs_spoke_dot(way, chord) < CONE * length * sqrt(cs_spoke_dot(way, way)))
      return false;
    from = to;
  }
  return true;
}

/* Whether the tips go forwards from spoke to spoke, clearly. */
static bool goes_forwards(const cs_spoke s[5]) {
  for (int i = 0; i < 4; i++) {
    celspan_point way = cs_spoke_away(s[i].tip, s[i + 1].tip);
    celspan_point along = {s[i].direction.x + s[i + 1].direction.x,
                           s[i].direction.y + s[i + 1].direction.y};
    double turn = fabs(cs_spoke_cross(s[i].direction, s[i + 1].direction));
    if (0.5 * cs_spoke_dot(way, cs_spoke_left(along)) < FORWARDS * s[i].radius * turn)
      return false;
  }
  return true;
}

/* The cubic that leaves and arrives along the side and meets the middle tip; false when there is
 * none that is any good. */
static bool fit(const cs_spoke s[5], celspan_point p[4]) {
  celspan_point from = cs_spoke_left(s[0].direction), to = cs_spoke_left(s[4].direction);
  celspan_point chord = cs_spoke_away(s[0].tip, s[4].tip);
  double length = sqrt(cs_spoke_dot(chord, chord)), turn = cs_spoke_cross(from, to);
  double first = length / 3, second = length / 3;
  if (fabs(turn) > 1e-4) {
    celspan_point bulge = {s[2].tip.x - 0.5 * (s[0].tip.x + s[4].tip.x),
                           s[2].tip.y - 0.5 * (s[0].tip.y + s[4].tip.y)};
    first = 8.0 / 3 * cs_spoke_cross(bulge, to) / turn;
    second = 8.0 / 3 * cs_spoke_cross(bulge, from) / turn;
  }
  p[0] = s[0].tip;
  p[1] = cs_spoke_add(s[0].tip, first, from);
  p[2] = cs_spoke_add(s[4].tip, -second, to);
  p[3] = s[4].tip;
  return first > 0 && second > 0 && first + second < 1.2 * length;
}

/* The error of a cubic near a parameter: at the place of it that is nearest to the tip. */
static double fit_error(const cs_side *side, const celspan_point p[4], double t,
                        const cs_spoke *spoke) {
  celspan_point at = on_cubic(p, t);
  celspan_point along = cs_spoke_left(spoke->direction);
  for (int i = 0; i < 2; i++) {
    const double h = 1e-4;
    celspan_point ahead = on_cubic(p, t + h);
    double pace = cs_spoke_dot(cs_spoke_away(at, ahead), along) / h;
    t += pace > 0 ? cs_spoke_dot(cs_spoke_away(at, spoke->tip), along) / pace : 0;
    at = on_cubic(p, t);
  }
  return cs_stroke_view_error(side->view, at, spoke->tip);
}

static bool fits(const cs_side *side, const cs_spoke s[5], celspan_point p[4]) {
  if (!goes_forwards(s) || !fit(s, p))
    return false;
  double allowed = allowance(side, p, 4, 0);
  for (int i = 1; i < 4; i++)
    if (fit_error(side, p, 0.25 * i, &s[i]) > allowed)
      return false;
  return true;
}

/* Whether all tips are on the chord. */
static bool is_flat(const cs_side *side, const cs_spoke s[5]) {
  celspan_point chord = cs_spoke_away(s[0].tip, s[4].tip);
  const celspan_point tips[5] = {s[0].tip, s[1].tip, s[2].tip, s[3].tip, s[4].tip};
  double square = cs_spoke_dot(chord, chord), allowed = allowance(side, tips, 5, 0.25);
  for (int i = 1; i < 4; i++) {
    double along = cs_spoke_dot(cs_spoke_away(s[0].tip, s[i].tip), chord);
    double share = square > 0 ? fmin(1, fmax(0, along / square)) : 0;
    if (cs_stroke_view_error(side->view, cs_spoke_add(s[0].tip, share, chord), s[i].tip) > allowed)
      return false;
  }
  return true;
}

/* Whether the spokes between go through the intersection of the first and the last, if they cross. */
static bool is_pointed(const cs_side *side, const cs_spoke s[5]) {
  celspan_point intersection;
  if (!find_intersection(&s[0], &s[4], &intersection))
    return true;
  double allowed = allowance(side, &intersection, 1, 0);
  for (int i = 1; i < 4; i++) {
    celspan_point away = cs_spoke_away(s[i].centre, intersection);
    double along = cs_spoke_dot(away, s[i].direction);
    celspan_point ought = cs_spoke_add(s[i].centre, along, s[i].direction);
    if (cs_stroke_view_error(side->view, ought, intersection) > allowed)
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
    if (cs_stroke_view_error(side->view, project(curve->line.points[i]), a->centre) > allowed)
      return false;
  return true;
}

/* Whether nothing that spokes of a curve sweep over can be seen: then any way from tip to tip is as
 * good as theirs that is in the same box. */
static bool is_hidden(const cs_side *side, const cs_curve *curve) {
  celspan_box box = cs_curve_box(curve, 1);
  return cs_stroke_view_hides(side->view, &box);
}

static celspan_status follow(cs_side *side, const cs_curve *curve, const cs_spoke *a,
                             const cs_spoke *b, int depth) {
  if (side->may_hide && is_hidden(side, curve))
    return cs_side_go(side, b->tip);
  bool is_smooth = goes_along(&curve->line) && cs_spoke_dot(a->direction, b->direction) > TURN;
  cs_spoke s[5] = {*a, *a, cs_spoke_at(curve, 0.5), *b, *b};
  celspan_point p[4];
  if (is_smooth) {
    s[1] = cs_spoke_at(curve, 0.25);
    s[3] = cs_spoke_at(curve, 0.75);
    if (fits(side, s, p))
      return draw_curve(side, p[1], p[2], p[3]);
    if (is_flat(side, s) && is_pointed(side, s))
      return step(side, a, b);
  }
  if (depth == DEPTH || is_point(side, curve, a, b))
    return turn(side, a, b);
  cs_curve low, high;
  cs_curve_halve(curve, &low, &high);
  CS_TRY(follow(side, &low, a, &s[2], depth + 1));
  return follow(side, &high, &s[2], b, depth + 1);
}

celspan_status cs_side_follow(cs_side *side, const cs_curve *curve, const cs_spoke *first,
                              const cs_spoke *last) {
  CS_TRY(cs_side_go(side, first->tip));
  if (cs_curve_is_straight(&curve->line) && curve->radius_degree <= 1)
    return cs_side_go(side, last->tip);
  return follow(side, curve, first, last, 0);
}
