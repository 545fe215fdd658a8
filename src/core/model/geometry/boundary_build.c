/* cs_boundary_add: contours to stretches.
 *
 * Every step works on a piece in its canonical order, so that a curve and its reversed copy give
 * the same bits, and makes stretches from top to bottom. The stretches of a piece are then put into
 * the order of the contour.
 */
#include "model/geometry/boundary_build.h"

#include <math.h>

#include "base/number.h"
#include "model/geometry/matrix.h"
#include "model/geometry/polyline.h"

#define WEIGHT_RATIO 2 /* the greatest ratio of the weights in a piece that is fitted as a whole */
#define WEIGHT_DEPTH 40
/* How many pixels any piece may extend beyond the top or the bottom without being cut there. */
#define LEAST_OUTSIDE 1024
/* A piece counts as inside if it is this many pixels away from the place where it would be cut,
 * because its parts are rounded. */
#define CLEARANCE 1

typedef cs_boundary_builder builder;

/* ---------------------------------------------------------------- stretches */

static celspan_status reserve_stretches(builder *b, size_t more) {
  cs_boundary_stretches *stretches = &b->stretches;
  return CS_RESERVE(b->context, stretches->items, stretches->capacity, stretches->count + more);
}

/* Appends a straight stretch, for which there is room. */
static inline cs_boundary_piece *append_stretch(builder *b, celspan_point from, celspan_point to) {
  cs_boundary_stretch *added = &b->stretches.items[b->stretches.count++];
  *added = b->straight;
  added->piece.x0 = from.x;
  added->piece.y0 = from.y;
  added->piece.x1 = to.x;
  added->piece.y1 = to.y;
  return &added->piece;
}

/* curve: NULL for a straight stretch. Horizontal stretches vanish. */
static celspan_status add_stretch(builder *b, const cs_bezier *curve, celspan_point from,
                                  celspan_point to) {
  if (!(from.y < to.y))
    return CELSPAN_OK;
  CS_TRY(reserve_stretches(b, 1));
  cs_boundary_piece *piece = append_stretch(b, from, to);
  return curve ? cs_polyline_fit(b->context, b->set, curve, piece) : CELSPAN_OK;
}

static celspan_status add_vertical(builder *b, double x, double y0, double y1) {
  return add_stretch(b, NULL, (celspan_point){x, y0}, (celspan_point){x, y1});
}

/* ---------------------------------------------------------------- the frame */

/* The height at which a line crosses x, computed from the nearer end: the other end may be close to
 * the horizon, where few digits are exact. */
static double edge_height(celspan_point top, celspan_point bottom, double x) {
  double rise = (bottom.y - top.y) / (bottom.x - top.x);
  bool is_top_near = fabs(x - top.x) <= fabs(x - bottom.x);
  double y = is_top_near ? top.y + (x - top.x) * rise : bottom.y + (x - bottom.x) * rise;
  return cs_number_clamp(y, top.y, bottom.y);
}

static celspan_status add_line(builder *b, celspan_point top, celspan_point bottom) {
  double left = b->frame.left, right = b->frame.right;
  double first = top.x < bottom.x ? left : right, second = top.x < bottom.x ? right : left;
  celspan_point at = {cs_number_clamp(top.x, left, right), top.y};
  celspan_point end = {cs_number_clamp(bottom.x, left, right), bottom.y};
  if (at.x == top.x && end.x == bottom.x)
    return add_stretch(b, NULL, at, end);
  if (at.x == end.x)
    return add_vertical(b, at.x, at.y, end.y);
  if (at.x != top.x) {
    double y = edge_height(top, bottom, first);
    CS_TRY(add_vertical(b, at.x, at.y, y));
    at.y = y;
  }
  if (end.x == bottom.x)
    return add_stretch(b, NULL, at, end);
  celspan_point out = {second, fmax(at.y, edge_height(top, bottom, second))};
  CS_TRY(add_stretch(b, NULL, at, out));
  return add_vertical(b, second, out.y, end.y);
}

static double weight_ratio(const cs_bezier *curve) {
  double least = curve->points[0].w, largest = least;
  for (int i = 1; i <= curve->degree; i++) {
    least = cs_number_least(curve->points[i].w, least);
    largest = cs_number_most(curve->points[i].w, largest);
  }
  return largest / least;
}

/* The end of a stretch, moved into the frame, and not above the previous stretch. */
static celspan_point joint(const builder *b, const cs_bezier *curve, celspan_point from,
                           celspan_point to) {
  celspan_point end = cs_hpoint_place(curve->points[curve->degree]);
  return (celspan_point){cs_number_clamp(end.x, b->frame.left, b->frame.right),
                         cs_number_clamp(end.y, from.y, to.y)};
}

/* A curve inside the frame; it is halved until its weights are similar, at most WEIGHT_DEPTH
 * times. */
static celspan_status add_curve(builder *b, const cs_bezier *curve, celspan_point from,
                                celspan_point to, int depth) {
  if (depth == WEIGHT_DEPTH || weight_ratio(curve) <= WEIGHT_RATIO)
    return add_stretch(b, curve, from, to);
  cs_bezier upper, lower;
  cs_bezier_split(curve, 0.5, &upper, &lower);
  celspan_point middle = joint(b, &upper, from, to);
  CS_TRY(add_curve(b, &upper, from, middle, depth + 1));
  return add_curve(b, &lower, middle, to, depth + 1);
}

static double middle_x(const cs_bezier *curve, cs_bezier *upper, cs_bezier *lower) {
  cs_bezier_split(curve, 0.5, upper, lower);
  return cs_hpoint_place(lower->points[0]).x;
}

/* The mean of three points of a curve. */
static double mean_x(const cs_bezier *curve) {
  cs_bezier upper, lower, first, second;
  double middle = middle_x(curve, &upper, &lower);
  return (middle + middle_x(&upper, &first, &second) + middle_x(&lower, &first, &second)) / 3;
}

/* A curve that does not cross a side of the frame is inside or outside. The mean of its points
 * decides, because a single point may lie on a side. */
static celspan_status add_one_side(builder *b, const cs_bezier *curve, celspan_point from,
                                   celspan_point to) {
  double x = mean_x(curve);
  if (x <= b->frame.left)
    return add_vertical(b, b->frame.left, from.y, to.y);
  if (x >= b->frame.right)
    return add_vertical(b, b->frame.right, from.y, to.y);
  return add_curve(b, curve, from, to, 0);
}

typedef struct side_cuts {
  int count;
  double at[2 * CS_BEZIER_ROOTS];
  double x[2 * CS_BEZIER_ROOTS];
} side_cuts;

static void find_side_cuts(const cs_bezier *curve, const cs_boundary_frame *frame,
                           side_cuts *cuts) {
  double left[CS_BEZIER_ROOTS], right[CS_BEZIER_ROOTS];
  int lefts = cs_bezier_crossings(curve, (cs_bezier_form){.x = 1, .w = -frame->left}, left);
  int rights = cs_bezier_crossings(curve, (cs_bezier_form){.x = 1, .w = -frame->right}, right);
  cuts->count = 0;
  for (int i = 0, j = 0; i < lefts || j < rights; cuts->count++) {
    bool is_left = j == rights || (i < lefts && left[i] <= right[j]);
    cuts->at[cuts->count] = is_left ? left[i++] : right[j++];
    cuts->x[cuts->count] = is_left ? frame->left : frame->right;
  }
}

static celspan_status add_cut_curve(builder *b, const cs_bezier *curve, celspan_point from,
                                    celspan_point to) {
  side_cuts cuts;
  find_side_cuts(curve, &b->frame, &cuts);
  cs_bezier rest, upper;
  cs_bezier_copy(curve, &rest);
  double position = 0;
  for (int i = 0; i < cuts.count; i++) {
    cs_bezier_cut_front(&rest, &position, cuts.at[i], &upper);
    celspan_point cut = joint(b, &upper, from, to);
    cut.x = cuts.x[i];
    CS_TRY(add_one_side(b, &upper, from, cut));
    from = cut;
  }
  return add_one_side(b, &rest, from, to);
}

/* y0, y1: the heights of the curve's ends. */
static celspan_status add_across(builder *b, const cs_bezier *curve, double y0, double y1) {
  double left = b->frame.left, right = b->frame.right;
  double least = HUGE_VAL, largest = -HUGE_VAL;
  for (int i = 0; i <= curve->degree; i++) {
    double x = cs_bezier_coordinate(curve->points[i], CS_BEZIER_X);
    least = cs_number_least(x, least);
    largest = cs_number_most(x, largest);
  }
  if (largest <= left)
    return add_vertical(b, left, y0, y1);
  if (least >= right)
    return add_vertical(b, right, y0, y1);
  celspan_point from = {cs_number_clamp(cs_hpoint_place(curve->points[0]).x, left, right), y0};
  celspan_point to = {cs_number_clamp(cs_hpoint_place(curve->points[curve->degree]).x, left, right),
                      y1};
  return least >= left && largest <= right ? add_curve(b, curve, from, to, 0)
                                           : add_cut_curve(b, curve, from, to);
}

/* curve: goes down from its first point to its last one. It may extend a little beyond the top and
 * the bottom: this costs little, and the vertices are the same as in a larger frame. */
static celspan_status add_falling(builder *b, cs_bezier *curve) {
  const cs_boundary_frame *frame = &b->frame;
  celspan_point from = cs_hpoint_place(curve->points[0]),
                to = cs_hpoint_place(curve->points[curve->degree]);
  if (to.y <= frame->top || from.y >= frame->bottom)
    return CELSPAN_OK;
  if (curve->degree == 1)
    return add_line(b, from, to);
  double roots[CS_BEZIER_ROOTS], outside = fmax(LEAST_OUTSIDE, frame->bottom - frame->top);
  cs_bezier cut_off;
  if (from.y < frame->top - outside &&
      cs_bezier_crossings(curve, (cs_bezier_form){.y = 1, .w = -frame->top}, roots) > 0) {
    cs_bezier_split(curve, roots[0], &cut_off, curve);
    from.y = frame->top;
  }
  if (to.y > frame->bottom + outside &&
      cs_bezier_crossings(curve, (cs_bezier_form){.y = 1, .w = -frame->bottom}, roots) > 0) {
    cs_bezier_split(curve, roots[0], curve, &cut_off);
    to.y = frame->bottom;
  }
  return add_across(b, curve, from.y, to.y);
}

/* ---------------------------------------------------------------- monotone pieces */

static celspan_status add_monotone(builder *b, cs_bezier *curve) {
  double y0 = cs_bezier_coordinate(curve->points[0], CS_BEZIER_Y);
  double y1 = cs_bezier_coordinate(curve->points[curve->degree], CS_BEZIER_Y);
  size_t begin = b->stretches.count;
  if (y0 == y1)
    return CELSPAN_OK;
  b->straight.direction = y0 > y1 ? -1 : 1;
  if (y0 > y1)
    cs_bezier_reverse(curve);
  CS_TRY(add_falling(b, curve));
  if (y0 > y1)
    cs_stretches_reverse(&b->stretches, begin, false);
  return CELSPAN_OK;
}

/* With positive weights a line crosses a curve at most as often as the curve's control polygon. */
static bool has_monotone_polygon(const cs_bezier *curve) {
  bool rises = false, falls = false;
  double last = cs_bezier_coordinate(curve->points[0], CS_BEZIER_Y);
  for (int i = 1; i <= curve->degree; i++) {
    double y = cs_bezier_coordinate(curve->points[i], CS_BEZIER_Y);
    rises = rises || y < last;
    falls = falls || y > last;
    last = y;
  }
  return !(rises && falls);
}

/* curve: canonical and in front of the horizon; it is changed. is_turned: the contour has the
 * opposite direction. */
static celspan_status add_canonical(builder *b, cs_bezier *curve, bool is_turned) {
  double roots[CS_BEZIER_ROOTS], position = 0;
  int count = has_monotone_polygon(curve) ? 0 : cs_bezier_extrema(curve, CS_BEZIER_Y, roots);
  size_t begin = b->stretches.count;
  cs_bezier monotone;
  for (int i = 0; i < count; i++) {
    cs_bezier_cut_front(curve, &position, roots[i], &monotone);
    CS_TRY(add_monotone(b, &monotone));
  }
  CS_TRY(add_monotone(b, curve));
  if (is_turned)
    cs_stretches_reverse(&b->stretches, begin, true);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- contours */

static bool are_same(cs_hpoint a, cs_hpoint b) { return a.x == b.x && a.y == b.y && a.w == b.w; }

/* Closes the gap that the horizon has cut into the contour. */
static celspan_status add_gap(builder *b, cs_hpoint to) {
  if (!b->has_pen || are_same(b->pen, to))
    return CELSPAN_OK;
  cs_bezier line = cs_bezier_line(b->pen, to);
  bool is_turned = cs_bezier_canonise(&line);
  return add_canonical(b, &line, is_turned);
}

static celspan_status add_front(builder *b, cs_bezier *curve, bool is_turned) {
  cs_hpoint from = curve->points[is_turned ? curve->degree : 0];
  CS_TRY(add_gap(b, from));
  if (!b->has_pen)
    b->first = from;
  b->has_pen = true;
  b->pen = curve->points[is_turned ? 0 : curve->degree];
  return add_canonical(b, curve, is_turned);
}

static celspan_status keep_front(void *user, const cs_bezier *curve) {
  builder *b = user;
  CS_TRY(CS_RESERVE(b->context, b->fronts, b->front_capacity, b->front_count + 1));
  cs_bezier_copy(curve, &b->fronts[b->front_count++]);
  return CELSPAN_OK;
}

static celspan_status add_piece(builder *b, cs_bezier *curve, double least) {
  bool is_turned = cs_bezier_canonise(curve);
  b->front_count = 0;
  CS_TRY(cs_bezier_clip(curve, least, keep_front, b));
  for (size_t i = 0; i < b->front_count; i++)
    CS_TRY(add_front(b, &b->fronts[is_turned ? b->front_count - 1 - i : i], is_turned));
  return CELSPAN_OK;
}

static celspan_status add_contour(builder *b, const cs_outline *outline, size_t begin, size_t end,
                                  const celspan_matrix *matrix, double least) {
  b->has_pen = false;
  for (size_t piece = begin; piece < end; piece++) {
    cs_bezier curve;
    cs_bezier_load(outline, piece, matrix, &curve);
    CS_TRY(add_piece(b, &curve, least));
  }
  return add_gap(b, b->first);
}

/* ---------------------------------------------------------------- plain contours */

/* The parts of a curve that is inside the frame are inside, too. */
static inline bool is_inside(const builder *b, const cs_plain *curve) {
  const cs_boundary_frame *inside = &b->inside;
  cs_plain_hull hull = cs_plain_hull_of(curve);
  return hull.least[0] >= inside->left && hull.most[0] <= inside->right &&
         hull.least[1] >= inside->top && hull.most[1] <= inside->bottom;
}

/* A monotone curve that is inside the frame is at most one stretch. */
static void add_inside(builder *b, cs_plain *curve) {
  const cs_pair *p = curve->points;
  double y0 = p[0][1], y1 = p[CS_PLAIN_DEGREE][1];
  double top = b->frame.top, bottom = b->frame.bottom;
  if (y0 == y1 || (y0 <= top && y1 <= top) || (y0 >= bottom && y1 >= bottom))
    return;
  b->straight.direction = y0 > y1 ? -1 : 1;
  if (y0 > y1)
    cs_plain_reverse(curve);
  cs_boundary_piece *piece =
      append_stretch(b, cs_pair_point(p[0]), cs_pair_point(p[CS_PLAIN_DEGREE]));
  if (curve->degree > 1)
    cs_polyline_fit_plain(b->set, curve, piece);
}

/* add_canonical for a curve that is inside the frame. */
static void add_cut_inside(builder *b, cs_plain *curve) {
  double roots[CS_PLAIN_DEGREE], position = 0;
  bool is_turned = cs_plain_canonise(curve);
  int count = cs_plain_extrema(curve, CS_BEZIER_Y, roots);
  size_t begin = b->stretches.count;
  cs_plain monotone;
  for (int i = 0; i < count; i++) {
    cs_plain_cut_front(curve, &position, roots[i], &monotone);
    add_inside(b, &monotone);
  }
  add_inside(b, curve);
  if (is_turned)
    cs_stretches_reverse(&b->stretches, begin, true);
}

/* A curve that may have to be cut at the frame. */
static celspan_status add_beside(builder *b, const cs_plain *curve) {
  cs_bezier weighted;
  cs_plain_weigh(curve, &weighted);
  bool is_turned = cs_bezier_canonise(&weighted);
  return add_canonical(b, &weighted, is_turned);
}

static celspan_status add_plain_piece(builder *b, cs_plain *curve) {
  if (!is_inside(b, curve))
    return add_beside(b, curve);
  CS_TRY(reserve_stretches(b, CS_PLAIN_PARTS)); /* nothing below can fail */
  CS_TRY(cs_polyline_reserve(b->context, b->set, CS_PLAIN_PARTS * (CS_PLAIN_DEGREE + 1)));
  if (cs_plain_has_monotone_polygon(curve))
    add_inside(b, curve);
  else
    add_cut_inside(b, curve);
  return CELSPAN_OK;
}

/* The whole contour is in front of the horizon, so it has no gaps. */
static celspan_status add_plain_contour(builder *b, const cs_outline *outline, size_t begin,
                                        size_t end, const cs_plain_map *map) {
  const cs_hpoint *points = outline->points + outline->starts[begin];
  cs_pair joint = cs_plain_place(map, points++);
  for (size_t piece = begin; piece < end; piece++) {
    cs_plain curve;
    cs_plain_load(&curve, joint, points, outline->degrees[piece], map);
    points += curve.degree;
    joint = curve.points[CS_PLAIN_DEGREE];
    CS_TRY(add_plain_piece(b, &curve));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- outlines */

celspan_status cs_boundary_add(cs_boundary_builder *b, const cs_outline *outline,
                               const celspan_matrix *matrix, uint32_t layer) {
  double least;
  celspan_matrix facing = cs_matrix_facing(matrix);
  if (!cs_bezier_horizon(outline, &facing, &least))
    return CELSPAN_OK;
  bool is_plain = cs_plain_applies(outline, &facing);
  const cs_plain_map map = cs_plain_map_of(&facing);
  for (size_t i = 0; i < outline->contour_count; i++) {
    size_t begin = outline->contours[i];
    size_t end = i + 1 < outline->contour_count ? outline->contours[i + 1] : outline->piece_count;
    b->stretches.count = 0;
    CS_TRY(is_plain ? add_plain_contour(b, outline, begin, end, &map)
                    : add_contour(b, outline, begin, end, &facing, least));
    CS_TRY(cs_stretches_join(b->context, &b->stretches, layer, b->set));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the builder */

void cs_boundary_builder_init(cs_boundary_builder *b, celspan_context *context,
                              cs_boundary_set *set, const cs_boundary_frame *frame) {
  const double outside = LEAST_OUTSIDE - CLEARANCE;
  const cs_boundary_piece straight = {.left = frame->left,
                                      .right = frame->right,
                                      .chords = 1,
                                      .group = 1,
                                      .half = 1,
                                      .leap = 1,
                                      .degree = 1};
  *b = (cs_boundary_builder){.context = context,
                             .set = set,
                             .frame = *frame,
                             .inside = {frame->left + CLEARANCE, frame->right - CLEARANCE,
                                        frame->top - outside, frame->bottom + outside},
                             .straight = {.piece = straight}};
}

void cs_boundary_builder_finish(cs_boundary_builder *b) {
  cs_memory *memory = b->context->memory;
  cs_mem_free(memory, b->stretches.items, b->stretches.capacity * sizeof *b->stretches.items);
  cs_mem_free(memory, b->fronts, b->front_capacity * sizeof *b->fronts);
}
