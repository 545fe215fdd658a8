/* cs_boundary_add: contours to chains.
 *
 *   horizon: a curve is cut       y extrema: a curve is cut      sides of the frame: beyond them
 *   off behind it                 into monotone stretches        vertical lines replace a curve
 *
 *        .---.                             .*.  extremum                  left
 *      .'     '.                         .'   '.                             |   .
 *   --o---------o--- horizon            /       \                            | .
 *     :         :                     one       another                      |'  the curve leaves
 *     (cut off)                       stretch   stretch                    . |   along the side
 *                                                                         .  |
 *
 * Every stage works on a piece in its canonical order, so that a curve and its reversed copy give
 * the same bits, and makes stretches from top to bottom. The stretches of a piece are then put into
 * the order of the contour, and consecutive stretches of one direction are joined to chains.
 */
#include <math.h>

#include "base/number.h"
#include "geometry/bezier.h"
#include "geometry/boundary.h"
#include "geometry/matrix.h"
#include "geometry/polyline.h"

#define WEIGHT_RATIO 2 /* of the weights in a piece that is fitted as a whole, at most */
#define WEIGHT_DEPTH 40
/* Pixels that a piece may always extend beyond top or bottom without being cut there. */
#define LEAST_OUTSIDE 1024

typedef struct stretch {
  cs_boundary_piece piece;
  int32_t direction; /* along the contour: +1 down, -1 up */
} stretch;

typedef struct builder {
  celspan_context *context;
  cs_boundary_set *set;
  const cs_boundary_frame *frame;
  uint32_t layer;
  stretch *stretches; /* of the current contour */
  size_t stretch_count, stretch_capacity;
  cs_bezier *fronts; /* the current piece, cut to what is in front of the horizon */
  size_t front_count, front_capacity;
  bool has_pen;
  cs_hpoint first, pen; /* the beginning of the contour, and its current point */
} builder;

/* ---------------------------------------------------------------- stretches */

/* curve: NULL for a straight stretch. Horizontal stretches vanish. */
static celspan_status add_stretch(builder *b, const cs_bezier *curve, celspan_point from,
                                  celspan_point to) {
  if (!(from.y < to.y))
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(b->context, (void **)&b->stretches, &b->stretch_capacity,
                        b->stretch_count + 1, sizeof *b->stretches));
  stretch *added = &b->stretches[b->stretch_count];
  *added = (stretch){.piece = {.x0 = from.x,
                               .y0 = from.y,
                               .x1 = to.x,
                               .y1 = to.y,
                               .left = b->frame->left,
                               .right = b->frame->right,
                               .chords = 1,
                               .group = 1,
                               .half = 1,
                               .leap = 1,
                               .degree = 1}};
  if (curve)
    CS_TRY(cs_polyline_fit(b->context, b->set, curve, &added->piece));
  b->stretch_count++;
  return CELSPAN_OK;
}

static celspan_status add_vertical(builder *b, double x, double y0, double y1) {
  return add_stretch(b, NULL, (celspan_point){x, y0}, (celspan_point){x, y1});
}

static void reverse_stretches(builder *b, size_t begin, bool turns_direction) {
  for (size_t i = begin; turns_direction && i < b->stretch_count; i++)
    b->stretches[i].direction = -b->stretches[i].direction;
  for (size_t i = begin, j = b->stretch_count; i + 1 < j; i++) {
    stretch swapped = b->stretches[i];
    b->stretches[i] = b->stretches[--j];
    b->stretches[j] = swapped;
  }
}

/* ---------------------------------------------------------------- the frame */

/* The height at which a line crosses x, computed from the nearer end: the other one may be close to
 * the horizon, with few exact digits. */
static double edge_height(celspan_point top, celspan_point bottom, double x) {
  double rise = (bottom.y - top.y) / (bottom.x - top.x);
  bool is_top_near = fabs(x - top.x) <= fabs(x - bottom.x);
  double y = is_top_near ? top.y + (x - top.x) * rise : bottom.y + (x - bottom.x) * rise;
  return cs_number_clamp(y, top.y, bottom.y);
}

static celspan_status add_line(builder *b, celspan_point top, celspan_point bottom) {
  double left = b->frame->left, right = b->frame->right;
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
    least = fmin(least, curve->points[i].w);
    largest = fmax(largest, curve->points[i].w);
  }
  return largest / least;
}

static celspan_point project(cs_hpoint point) {
  return (celspan_point){point.x / point.w, point.y / point.w};
}

/* The end of a stretch, clamped to the frame and to below the stretch before it. */
static celspan_point joint(const builder *b, const cs_bezier *curve, celspan_point from,
                           celspan_point to) {
  celspan_point end = project(curve->points[curve->degree]);
  return (celspan_point){cs_number_clamp(end.x, b->frame->left, b->frame->right),
                         cs_number_clamp(end.y, from.y, to.y)};
}

/* A curve inside the frame, halved until its weights are similar, WEIGHT_DEPTH times at most. */
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

/* A curve that crosses neither side of the frame: it is inside or outside as its middle is. */
static celspan_status add_one_side(builder *b, const cs_bezier *curve, celspan_point from,
                                   celspan_point to) {
  cs_bezier upper, lower;
  cs_bezier_split(curve, 0.5, &upper, &lower);
  double x = project(lower.points[0]).x;
  if (x <= b->frame->left)
    return add_vertical(b, b->frame->left, from.y, to.y);
  if (x >= b->frame->right)
    return add_vertical(b, b->frame->right, from.y, to.y);
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
  find_side_cuts(curve, b->frame, &cuts);
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

/* y0, y1: the heights of its ends. */
static celspan_status add_across(builder *b, const cs_bezier *curve, double y0, double y1) {
  double left = b->frame->left, right = b->frame->right;
  double least = HUGE_VAL, largest = -HUGE_VAL;
  for (int i = 0; i <= curve->degree; i++) {
    double x = cs_bezier_coordinate(curve->points[i], CS_BEZIER_X);
    least = fmin(least, x);
    largest = fmax(largest, x);
  }
  if (largest <= left)
    return add_vertical(b, left, y0, y1);
  if (least >= right)
    return add_vertical(b, right, y0, y1);
  celspan_point from = {cs_number_clamp(project(curve->points[0]).x, left, right), y0};
  celspan_point to = {cs_number_clamp(project(curve->points[curve->degree]).x, left, right), y1};
  return least >= left && largest <= right ? add_curve(b, curve, from, to, 0)
                                           : add_cut_curve(b, curve, from, to);
}

/* curve: goes down from its first point to its last. It may extend a little beyond top and bottom:
 * that costs little, and its vertices are then those of a larger frame. */
static celspan_status add_falling(builder *b, cs_bezier *curve) {
  const cs_boundary_frame *frame = b->frame;
  celspan_point from = project(curve->points[0]), to = project(curve->points[curve->degree]);
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
  size_t begin = b->stretch_count;
  if (y0 == y1)
    return CELSPAN_OK;
  if (y0 > y1)
    cs_bezier_reverse(curve);
  CS_TRY(add_falling(b, curve));
  for (size_t i = begin; i < b->stretch_count; i++)
    b->stretches[i].direction = y0 > y1 ? -1 : 1;
  if (y0 > y1)
    reverse_stretches(b, begin, false);
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

/* curve: canonical and in front of the horizon; is_turned: the contour has the other direction. */
static celspan_status add_canonical(builder *b, const cs_bezier *curve, bool is_turned) {
  double roots[CS_BEZIER_ROOTS], position = 0;
  int count = has_monotone_polygon(curve) ? 0 : cs_bezier_extrema(curve, CS_BEZIER_Y, roots);
  size_t begin = b->stretch_count;
  cs_bezier rest, monotone;
  cs_bezier_copy(curve, &rest);
  for (int i = 0; i < count; i++) {
    cs_bezier_cut_front(&rest, &position, roots[i], &monotone);
    CS_TRY(add_monotone(b, &monotone));
  }
  CS_TRY(add_monotone(b, &rest));
  if (is_turned)
    reverse_stretches(b, begin, true);
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

static celspan_status add_front(builder *b, const cs_bezier *curve, bool is_turned) {
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
  CS_TRY(cs_mem_reserve(b->context, (void **)&b->fronts, &b->front_capacity, b->front_count + 1,
                        sizeof *b->fronts));
  cs_bezier_copy(curve, &b->fronts[b->front_count++]);
  return CELSPAN_OK;
}

static celspan_status add_piece(builder *b, const cs_outline *outline, size_t piece,
                                const celspan_matrix *matrix, double least) {
  cs_bezier curve;
  cs_bezier_load(outline, piece, matrix, &curve);
  bool is_turned = cs_bezier_canonise(&curve);
  b->front_count = 0;
  CS_TRY(cs_bezier_clip(&curve, least, keep_front, b));
  for (size_t i = 0; i < b->front_count; i++)
    CS_TRY(add_front(b, &b->fronts[is_turned ? b->front_count - 1 - i : i], is_turned));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- chains */

/* Whether b continues a, along the contour. */
static bool joins(const stretch *a, const stretch *b) {
  if (a->direction != b->direction)
    return false;
  const cs_boundary_piece *upper = a->direction > 0 ? &a->piece : &b->piece;
  const cs_boundary_piece *lower = a->direction > 0 ? &b->piece : &a->piece;
  return upper->x1 == lower->x0 && upper->y1 == lower->y0;
}

static bool is_vertical(const cs_boundary_piece *piece) {
  return piece->chords == 1 && piece->x0 == piece->x1;
}

/* Appends a piece below the last of the chain; two vertical lines become one. */
static void append_piece(cs_boundary_set *set, cs_boundary_chain *chain,
                         const cs_boundary_piece *piece) {
  chain->y1 = piece->y1;
  cs_boundary_piece *last = chain->piece_count > 0 ? &set->pieces[set->piece_count - 1] : NULL;
  if (last && is_vertical(last) && is_vertical(piece)) {
    last->y1 = piece->y1;
    return;
  }
  set->pieces[set->piece_count++] = *piece;
  chain->piece_count++;
}

/* The chain of `count` stretches from `begin` on, counted around the contour. */
static void add_chain(builder *b, size_t begin, size_t count) {
  cs_boundary_set *set = b->set;
  int32_t direction = b->stretches[begin % b->stretch_count].direction;
  cs_boundary_chain chain = {
      .piece = (uint32_t)set->piece_count, .layer = b->layer, .direction = direction};
  for (size_t i = 0; i < count; i++) {
    size_t place = begin + (direction > 0 ? i : count - 1 - i);
    append_piece(set, &chain, &b->stretches[place % b->stretch_count].piece);
  }
  chain.x0 = set->pieces[chain.piece].x0;
  chain.y0 = set->pieces[chain.piece].y0;
  set->chains[set->chain_count++] = chain;
}

static bool continues(const builder *b, size_t place) {
  size_t count = b->stretch_count;
  return joins(&b->stretches[(place + count - 1) % count], &b->stretches[place % count]);
}

static celspan_status reserve_chains(builder *b) {
  cs_boundary_set *set = b->set;
  if (b->stretch_count > UINT32_MAX - set->piece_count)
    return cs_fail(b->context, CELSPAN_LIMIT, "the frame has more than 4294967295 curve pieces");
  CS_TRY(cs_mem_reserve(b->context, (void **)&set->pieces, &set->piece_capacity,
                        set->piece_count + b->stretch_count, sizeof *set->pieces));
  return cs_mem_reserve(b->context, (void **)&set->chains, &set->chain_capacity,
                        set->chain_count + b->stretch_count, sizeof *set->chains);
}

static celspan_status add_chains(builder *b) {
  CS_TRY(reserve_chains(b));
  size_t origin = 0;
  while (origin < b->stretch_count && continues(b, origin))
    origin++;
  for (size_t i = 0, next; i < b->stretch_count; i = next) {
    for (next = i + 1; next < b->stretch_count && continues(b, origin + next); next++) {
    }
    add_chain(b, origin + i, next - i);
  }
  return CELSPAN_OK;
}

static celspan_status add_contour(builder *b, const cs_outline *outline, size_t contour,
                                  const celspan_matrix *matrix, double least) {
  size_t end =
      contour + 1 < outline->contour_count ? outline->contours[contour + 1] : outline->piece_count;
  b->stretch_count = 0;
  b->has_pen = false;
  for (size_t piece = outline->contours[contour]; piece < end; piece++)
    CS_TRY(add_piece(b, outline, piece, matrix, least));
  CS_TRY(add_gap(b, b->first));
  return add_chains(b);
}

celspan_status cs_boundary_add(celspan_context *context, cs_boundary_set *set,
                               const cs_outline *outline, const celspan_matrix *matrix,
                               const cs_boundary_frame *frame, uint32_t layer) {
  double least;
  celspan_matrix facing = cs_matrix_facing(matrix);
  if (!cs_bezier_horizon(outline, &facing, &least))
    return CELSPAN_OK;
  builder b = {.context = context, .set = set, .frame = frame, .layer = layer};
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; i < outline->contour_count && status == CELSPAN_OK; i++)
    status = add_contour(&b, outline, i, &facing, least);
  cs_mem_free(context->memory, b.stretches, b.stretch_capacity * sizeof *b.stretches);
  cs_mem_free(context->memory, b.fronts, b.front_capacity * sizeof *b.fronts);
  return status;
}
