#include "model/stroke/side.h"

#define PI 3.14159265358979323846
#define ARC_DEPTH 20
#define ARC_WORST 0.2113 /* parameter at which a cubic is farthest from its arc */
#define SAME 1e-3        /* share of the allowed error: pivots that are closer count as one */

void cs_side_init(cs_side *side, celspan_context *context, const cs_stroke_view *view,
                  cs_outline *outline) {
  *side = (cs_side){.context = context, .view = view, .outline = outline};
  cs_outline_init(&side->tips);
  cs_outline_init(&side->folds);
}

void cs_side_finish(cs_side *side) {
  cs_outline_finish(&side->tips, side->context->memory);
  cs_outline_finish(&side->folds, side->context->memory);
}

static bool are_same(celspan_point a, celspan_point b) { return a.x == b.x && a.y == b.y; }

/* ---------------------------------------------------------------- lines and folds */

static celspan_status draw_line(cs_side *side, celspan_point to) {
  if (side->is_begun && are_same(side->at, to))
    return CELSPAN_OK;
  CS_TRY(side->is_begun ? cs_outline_line(side->context, side->outline, cs_hpoint_of(to))
                        : cs_outline_move(side->context, side->outline, cs_hpoint_of(to)));
  side->is_begun = true;
  side->at = to;
  return CELSPAN_OK;
}

static celspan_status draw_curve(cs_side *side, const celspan_point p[4]) {
  const cs_hpoint points[3] = {cs_hpoint_of(p[1]), cs_hpoint_of(p[2]), cs_hpoint_of(p[3])};
  side->at = p[3];
  return cs_outline_piece(side->context, side->outline, 3, points);
}

/* Appends pieces [begin, end) of an outline, backwards if asked, to an outline that ends where they
 * begin. */
static celspan_status append_pieces(celspan_context *context, cs_outline *to,
                                    const cs_outline *from, size_t begin, size_t end,
                                    bool is_back) {
  for (size_t i = begin; i < end; i++) {
    cs_bezier piece;
    const celspan_matrix identity = celspan_matrix_identity();
    cs_bezier_load(from, is_back ? end - 1 - (i - begin) : i, &identity, &piece);
    if (is_back)
      cs_bezier_reverse(&piece);
    CS_TRY(cs_outline_piece(context, to, piece.degree, piece.points + 1));
  }
  return CELSPAN_OK;
}

static void clear(cs_outline *outline) {
  outline->contour_count = outline->piece_count = outline->point_count = 0;
}

static bool has_fold(const cs_side *side) { return side->tips.piece_count > 0; }

/* The last tip of the fold so far. */
static celspan_point last_tip(const cs_side *side) {
  cs_hpoint p = side->tips.points[side->tips.point_count - 1];
  return (celspan_point){p.x, p.y};
}

/* Moves the side to the last tip. The fold then goes back along the tips, and along the side from
 * the first tip on: the pivots, with a spoke before and after them. */
static celspan_status end_fold(cs_side *side) {
  if (!has_fold(side))
    return CELSPAN_OK;
  CS_TRY(draw_line(side, last_tip(side)));
  CS_TRY(cs_outline_move(side->context, &side->folds, cs_hpoint_of(last_tip(side))));
  CS_TRY(append_pieces(side->context, &side->folds, &side->tips, 0, side->tips.piece_count, true));
  CS_TRY(append_pieces(side->context, &side->folds, side->outline, side->fold_begin,
                       side->outline->piece_count, false));
  clear(&side->tips);
  return CELSPAN_OK;
}

static celspan_status begin_fold(cs_side *side, celspan_point tip) {
  CS_TRY(draw_line(side, tip));
  side->fold_begin = side->outline->piece_count;
  return cs_outline_begin(side->context, &side->tips, cs_hpoint_of(tip));
}

celspan_status cs_side_fold(cs_side *side, const celspan_point tips[4],
                            const celspan_point pivots[4]) {
  const cs_hpoint back[3] = {cs_hpoint_of(tips[1]), cs_hpoint_of(tips[2]), cs_hpoint_of(tips[3])};
  double allowed = SAME * cs_side_allowance(side, pivots, 4, 0);
  bool goes_on = has_fold(side) && are_same(last_tip(side), tips[0]);
  if (!goes_on) {
    CS_TRY(end_fold(side));
    CS_TRY(begin_fold(side, tips[0]));
  }
  CS_TRY(cs_outline_piece(side->context, &side->tips, 3, back));
  if (!goes_on || cs_stroke_view_error(side->view, side->at, pivots[0]) > allowed)
    CS_TRY(draw_line(side, pivots[0]));
  bool is_one = are_same(pivots[0], pivots[1]) && are_same(pivots[1], pivots[2]) &&
                are_same(pivots[2], pivots[3]);
  return is_one ? CELSPAN_OK : draw_curve(side, pivots);
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
    CS_TRY(append_pieces(side->context, side->outline, folds, begin, end, false));
  }
  clear(&side->folds);
  return cs_outline_close(side->context, side->outline);
}

/* ---------------------------------------------------------------- curves */

celspan_point cs_side_on_cubic(const celspan_point p[4], double t) {
  double s = 1 - t, a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
  return (celspan_point){a * p[0].x + b * p[1].x + c * p[2].x + d * p[3].x,
                         a * p[0].y + b * p[1].y + c * p[2].y + d * p[3].y};
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

double cs_side_allowance(const cs_side *side, const celspan_point *points, int count,
                         double share) {
  celspan_box box = box_of(points, count, share);
  return cs_stroke_view_allowance(side->view, &box);
}

celspan_status cs_side_curve(cs_side *side, const celspan_point p[4]) {
  CS_TRY(end_fold(side));
  return draw_curve(side, p);
}

/* ---------------------------------------------------------------- arcs */

static double arc_error(const cs_side *side, const cs_spoke *about, const celspan_point p[4]) {
  celspan_point at = cs_side_on_cubic(p, ARC_WORST), away = cs_spoke_away(about->centre, at);
  double length = sqrt(cs_spoke_dot(away, away));
  celspan_point ought = cs_spoke_add(about->centre, about->radius / length, away);
  return length > 0 ? cs_stroke_view_error(side->view, at, ought) : 0;
}

/* An arc that is being drawn, from `at` on. way: 1 in the order of a contour, -1 against it, for a
 * fold about the centre. */
typedef struct arc {
  cs_side *side;
  const cs_spoke *about;
  celspan_point at;
  int way;
} arc;

static celspan_status draw_cubic(arc *a, const celspan_point p[4]) {
  const celspan_point c = a->about->centre, pivots[4] = {c, c, c, c};
  a->at = p[3];
  return a->way > 0 ? draw_curve(a->side, p) : cs_side_fold(a->side, p, pivots);
}

/* Draws at most a quarter turn, which ends at `end`. */
static celspan_status draw_arc(arc *a, celspan_point from, celspan_point to, celspan_point end,
                               int depth) {
  double cosine = cs_spoke_dot(from, to), half = sqrt(fmax(0, 0.5 * (1 + cosine)));
  double handle = 4.0 / 3 * sqrt(fmax(0, 0.5 * (1 - cosine))) / (1 + half) * a->about->radius;
  handle *= a->way;
  const celspan_point p[4] = {a->at, cs_spoke_add(a->at, handle, cs_spoke_left(from)),
                              cs_spoke_add(end, -handle, cs_spoke_left(to)), end};
  if (depth == ARC_DEPTH ||
      !(arc_error(a->side, a->about, p) > cs_side_allowance(a->side, p, 4, 0)))
    return draw_cubic(a, p);
  celspan_point middle = {(from.x + to.x) / (2 * half), (from.y + to.y) / (2 * half)};
  celspan_point joint = cs_spoke_add(a->about->centre, a->about->radius, middle);
  CS_TRY(draw_arc(a, from, middle, joint, depth + 1));
  return draw_arc(a, middle, to, end, depth + 1);
}

static celspan_status draw_arcs(arc *a, celspan_point from, celspan_point to, double angle,
                                celspan_point end) {
  for (; angle > 0.5 * PI + 1e-9; angle -= 0.5 * PI) {
    celspan_point next = a->way > 0 ? cs_spoke_left(from) : cs_spoke_right(from);
    CS_TRY(draw_arc(a, from, next, cs_spoke_add(a->about->centre, a->about->radius, next), 0));
    from = next;
  }
  return draw_arc(a, from, to, end, 0);
}

celspan_status cs_side_arc(cs_side *side, const cs_spoke *about, celspan_point from,
                           celspan_point to, double angle) {
  arc a = {side, about, cs_spoke_add(about->centre, about->radius, from), 1};
  CS_TRY(cs_side_go(side, a.at));
  return about->radius > 0
             ? draw_arcs(&a, from, to, angle, cs_spoke_add(about->centre, about->radius, to))
             : CELSPAN_OK;
}

celspan_status cs_side_fold_arc(cs_side *side, const cs_spoke *from, const cs_spoke *to,
                                double angle) {
  arc a = {side, to, from->tip, -1};
  return draw_arcs(&a, from->direction, to->direction, angle, to->tip);
}

/* ---------------------------------------------------------------- corner */

#define PI 3.14159265358979323846
#define SMOOTH 1e-9 /* sine: lines that turn less count as straight on */
#define EQUAL 1e-12 /* relative: radii */

static celspan_point rim(const cs_spoke *spoke, celspan_point direction) {
  return cs_spoke_add(spoke->centre, spoke->radius, direction);
}

static bool is_smooth(const cs_spoke *in, const cs_spoke *out) {
  return cs_spoke_dot(in->tangent, out->tangent) > 0 &&
         fabs(cs_spoke_cross(in->tangent, out->tangent)) <= SMOOTH;
}

/* ---------------------------------------------------------------- round */

/* The angle between two spokes, measured across their lines; if it is above 0, the disc is visible
 * between them. */
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

/* Ends the side as at a butt end: at the normal, or at the centre if the end is straight. */
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

/* Goes from normal to normal, on the outside of a corner. */
static celspan_status go_outside(cs_side *side, const cs_stroke *stroke, const cs_spoke *in,
                                 const cs_spoke *out) {
  celspan_point a = cs_spoke_right(in->tangent), b = cs_spoke_right(out->tangent);
  double cosine = cs_spoke_dot(a, b), limit = stroke->miter;
  CS_TRY(cs_side_go(side, rim(in, a)));
  if (stroke->join == CELSPAN_STROKE_JOIN_MITER && 2 <= limit * limit * (1 + cosine))
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
  /* At a half turn, the same side is the outside in either direction of the line. */
  if (fabs(turn) > PI - 1e-9)
    turn = side->is_turned ? -fabs(turn) : fabs(turn);
  if (stroke->join == CELSPAN_STROKE_JOIN_ROUND)
    return turn_round(side, in, out, turn);
  CS_TRY(come_in(side, in));
  if (turn > 0)
    CS_TRY(go_outside(side, stroke, in, out));
  else
    CS_TRY(cs_side_go(side, in->centre));
  return go_out(side, out);
}

/* The triangle in front of a line whose width decreases up to its end. */
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
  bool is_round = stroke->join == CELSPAN_STROKE_JOIN_ROUND || is_smooth(in, out) ||
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
  if (stroke->cap == CELSPAN_STROKE_CAP_ROUND)
    return cs_side_arc(side, end, end->direction, turned.direction, 2 * lean);
  bool is_square = stroke->cap == CELSPAN_STROKE_CAP_SQUARE;
  if (end->slope < 0 || (end->slope == 0 && !is_square))
    return cs_side_go(side, turned.tip);
  CS_TRY(come_in(side, end));
  CS_TRY(is_square ? go_square(side, end) : cs_side_go(side, rim(end, left)));
  return end->slope > 0 ? cs_side_arc(side, end, left, turned.direction, lean - 0.5 * PI)
                        : CELSPAN_OK;
}

celspan_status cs_corner_cap_more(cs_side *side, const cs_stroke *stroke, const cs_spoke *end) {
  if (stroke->cap != CELSPAN_STROKE_CAP_SQUARE || !(end->slope < 0) || !(end->radius > 0))
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
  if (stroke->cap == CELSPAN_STROKE_CAP_BUTT || !(place->radius > 0))
    return CELSPAN_OK;
  if (stroke->cap == CELSPAN_STROKE_CAP_ROUND)
    CS_TRY(cs_side_arc(side, place, place->tangent, place->tangent, 2 * PI));
  else {
    const cs_spoke back =
        cs_spoke_make(place->centre, place->radius, cs_spoke_back(place->tangent), 0);
    CS_TRY(go_square(side, place));
    CS_TRY(go_square(side, &back));
  }
  return cs_side_close(side);
}
