#include "stroke/side.h"

#include "base/elementary.h"

#define PI 3.14159265358979323846
#define ARC_DEPTH 20
#define ARC_WORST 0.2113 /* parameter at which a cubic is farthest from its arc */
#define SAME 1e-3        /* of what is allowed: pivots that are no farther apart are one */

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

static celspan_status draw_curve(cs_side *side, const celspan_point p[4]) {
  const cs_hpoint points[3] = {plain(p[1]), plain(p[2]), plain(p[3])};
  side->at = p[3];
  return cs_outline_piece(side->context, side->outline, 3, points);
}

/* Appends pieces [begin, end) of an outline, backwards if asked, to one that ends where they begin. */
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

/* Where the tips of the fold have come to. */
static celspan_point last_tip(const cs_side *side) {
  cs_hpoint p = side->tips.points[side->tips.point_count - 1];
  return (celspan_point){p.x, p.y};
}

/* The side goes out to the last tip. The fold is the way of the tips back from there, then what the
 * side has gone since the first tip: pivots, with a spoke before and after them. */
static celspan_status end_fold(cs_side *side) {
  if (!has_fold(side))
    return CELSPAN_OK;
  CS_TRY(draw_line(side, last_tip(side)));
  CS_TRY(cs_outline_move(side->context, &side->folds, plain(last_tip(side))));
  CS_TRY(append_pieces(side->context, &side->folds, &side->tips, 0, side->tips.piece_count, true));
  CS_TRY(append_pieces(side->context, &side->folds, side->outline, side->fold_begin,
                       side->outline->piece_count, false));
  clear(&side->tips);
  return CELSPAN_OK;
}

static celspan_status begin_fold(cs_side *side, celspan_point tip) {
  CS_TRY(draw_line(side, tip));
  side->fold_begin = side->outline->piece_count;
  return cs_outline_begin(side->context, &side->tips, plain(tip));
}

celspan_status cs_side_fold(cs_side *side, const celspan_point tips[4],
                            const celspan_point pivots[4]) {
  const cs_hpoint back[3] = {plain(tips[1]), plain(tips[2]), plain(tips[3])};
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

/* An arc under way, from `at`. way: 1 in the order of a contour, -1 against it, as a fold about the
 * centre. */
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

/* At most a quarter turn, which ends at `end`. */
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
