#include "model/stroke/outliner.h"

#include <math.h>

#include "model/stroke/dashes.h"
#include "model/stroke/side.h"

#define DEPTH 32  /* halvings of a piece that is larger than the frame */
#define FEW 16    /* parts that are looked at one by one */
#define MANY 4096 /* parts whose outlines are held at a time to find their bounds */

/* A stretch of the line between two parameters of a piece. */
typedef struct stretch {
  size_t piece;
  double begin, end;
  cs_spoke first, last;
  bool is_swallowed; /* every disc lies inside the next one */
  bool is_cut;       /* the part of the line before this stretch cannot be seen */
} stretch;

typedef struct outliner {
  const cs_stroke *stroke;
  const cs_stroke_view *view;
  cs_parts parts;
  cs_side side;
  stretch *stretches; /* the stretches of one part */
  size_t count, capacity;
  double extent;
  bool is_all_visible; /* the whole stroke is visible in the frame, if this is asked for */
  bool is_cut;         /* a hidden part lies before the next stretch */
} outliner;

/* ---------------------------------------------------------------- stretches */

static celspan_status append_stretch(outliner *o, stretch s) {
  CS_TRY(CS_RESERVE(o->side.context, o->stretches, o->capacity, o->count + 1));
  s.is_cut = o->is_cut;
  o->is_cut = false;
  o->stretches[o->count++] = s;
  return CELSPAN_OK;
}

/* The spoke at a parameter. At a change the slope is exactly 1 or -1, so the tips of both sides are
 * one point. With a rounded slope, its root would put the tips millionths apart, and light would
 * leak between them. */
static cs_spoke spoke_at(const cs_curve *curve, double t, bool is_change) {
  cs_spoke spoke = cs_spoke_at(curve, t);
  return is_change
             ? cs_spoke_make(spoke.centre, spoke.radius, spoke.tangent, spoke.slope > 0 ? 1 : -1)
             : spoke;
}

/* base: the stretch that the whole curve covers; from, to: parameters of the curve. */
static celspan_status add_between(outliner *o, const stretch *base, const cs_curve *curve,
                                  double from, double to) {
  stretch s = *base;
  double length = base->end - base->begin;
  s.begin = from > 0 ? base->begin + from * length : base->begin;
  s.end = to < 1 ? base->begin + to * length : base->end;
  s.first = spoke_at(curve, from, from > 0);
  s.last = spoke_at(curve, to, to < 1);
  s.is_swallowed = curve->radius_degree > 0 && cs_curve_is_swallowed(curve, 0.5 * (from + to));
  return append_stretch(o, s);
}

/* Divides a stretch where discs begin or cease to be inside their neighbours. */
static celspan_status add_visible(outliner *o, const stretch *base, const cs_curve *curve) {
  double changes[CS_CURVE_SWALLOW_CHANGES], from = 0;
  int count = cs_curve_swallow_changes(curve, changes);
  for (int i = 0; i < count; i++) {
    double to = i + 1 < count ? changes[i + 1] : 1;
    if (cs_curve_is_swallowed(curve, 0.5 * (from + changes[i])) ==
        cs_curve_is_swallowed(curve, 0.5 * (changes[i] + to)))
      continue; /* the change is only rounding */
    CS_TRY(add_between(o, base, curve, from, changes[i]));
    from = changes[i];
  }
  return add_between(o, base, curve, from, 1);
}

/* Whether it is worthwhile to look at the halves of a curve. If a curve is shorter than its stroke
 * is wide, each half fills nearly the same place as the whole. */
static bool is_long(const outliner *o, const cs_curve *curve, const celspan_box *box) {
  celspan_box line = cs_curve_box(curve, 0);
  return line.width + line.height > box->width - line.width &&
         cs_stroke_view_is_exceeded(o->view, &line);
}

/* Adds the visible part of a curve between two parameters of a piece. */
static celspan_status add_curve(outliner *o, const stretch *base, const cs_curve *curve,
                                int depth) {
  if (!o->is_all_visible) {
    celspan_box box = cs_curve_box(curve, o->extent);
    if (cs_stroke_view_hides(o->view, &box)) {
      o->is_cut = true;
      return CELSPAN_OK;
    }
    if (depth < DEPTH && !cs_curve_is_straight(&curve->line) && is_long(o, curve, &box)) {
      double middle = 0.5 * (base->begin + base->end);
      stretch half = {.piece = base->piece, .begin = base->begin, .end = middle};
      cs_curve low, high;
      cs_curve_split(curve, 0.5, &low, &high);
      CS_TRY(add_curve(o, &half, &low, depth + 1));
      half = (stretch){.piece = base->piece, .begin = middle, .end = base->end};
      return add_curve(o, &half, &high, depth + 1);
    }
  }
  return add_visible(o, base, curve);
}

static celspan_status add_stretches(outliner *o, const cs_stroke_part *part) {
  o->count = 0;
  o->is_cut = false;
  for (size_t i = 0; i < part->count; i++) {
    const stretch base = {.piece = cs_stroke_piece(o->stroke, part, i),
                          .begin = i == 0 ? part->begin : 0,
                          .end = i + 1 == part->count ? part->end : 1};
    if (!(base.begin < base.end))
      continue;
    cs_curve curve;
    cs_curve_load(o->stroke, base.piece, base.begin, base.end, &curve);
    CS_TRY(add_curve(o, &base, &curve, 0));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- sides */

static celspan_status follow(outliner *o, const stretch *s) {
  cs_side *side = &o->side;
  if (s->is_swallowed) { /* both sides go along its chord, so that it has no area */
    CS_TRY(cs_side_go(side, side->is_turned ? s->last.centre : s->first.centre));
    return cs_side_go(side, side->is_turned ? s->first.centre : s->last.centre);
  }
  cs_curve curve;
  cs_curve_load(o->stroke, s->piece, s->begin, s->end, &curve);
  if (!side->is_turned)
    return cs_follow_curve(side, &curve, &s->first, &s->last);
  cs_spoke first = cs_spoke_turned(&s->last), last = cs_spoke_turned(&s->first);
  cs_curve_reverse(&curve);
  return cs_follow_curve(side, &curve, &first, &last);
}

static celspan_status turn(outliner *o, const stretch *a, const stretch *b) {
  cs_spoke in = o->side.is_turned ? cs_spoke_turned(&b->first) : a->last;
  cs_spoke out = o->side.is_turned ? cs_spoke_turned(&a->last) : b->first;
  return cs_corner_turn(&o->side, o->stroke, &in, &out);
}

/* Adds the right side of stretches [begin, end), in the direction of the line or back. */
static celspan_status add_side(outliner *o, size_t begin, size_t end, bool is_turned) {
  o->side.is_turned = is_turned;
  for (size_t i = begin; i < end; i++) {
    size_t at = is_turned ? end - 1 - (i - begin) : i;
    if (i > begin)
      CS_TRY(is_turned ? turn(o, &o->stretches[at], &o->stretches[at + 1])
                       : turn(o, &o->stretches[at - 1], &o->stretches[at]));
    CS_TRY(follow(o, &o->stretches[at]));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- runs */

static celspan_status add_ring(outliner *o) {
  for (int back = 0; back < 2; back++) {
    CS_TRY(add_side(o, 0, o->count, back == 1));
    CS_TRY(turn(o, &o->stretches[o->count - 1], &o->stretches[0]));
    CS_TRY(cs_side_close(&o->side));
  }
  return cs_corner_turn_more(&o->side, o->stroke, &o->stretches[o->count - 1].last,
                             &o->stretches[0].first);
}

static celspan_status add_end(outliner *o, const cs_spoke *end, bool is_cut) {
  return is_cut ? cs_corner_cut(&o->side, end) : cs_corner_cap(&o->side, o->stroke, end);
}

/* Adds stretches [begin, end), each of which begins where the one before ends. */
static celspan_status add_run(outliner *o, size_t begin, size_t end, bool is_cut_before,
                              bool is_cut_after) {
  const cs_spoke *last = &o->stretches[end - 1].last;
  cs_spoke first = cs_spoke_turned(&o->stretches[begin].first);
  CS_TRY(add_side(o, begin, end, false));
  CS_TRY(add_end(o, last, is_cut_after));
  CS_TRY(add_side(o, begin, end, true));
  CS_TRY(add_end(o, &first, is_cut_before));
  CS_TRY(cs_side_close(&o->side));
  if (!is_cut_after)
    CS_TRY(cs_corner_cap_more(&o->side, o->stroke, last));
  return is_cut_before ? CELSPAN_OK : cs_corner_cap_more(&o->side, o->stroke, &first);
}

static celspan_status add_turns(outliner *o, size_t begin, size_t end) {
  for (size_t i = begin + 1; i < end; i++)
    CS_TRY(cs_corner_turn_more(&o->side, o->stroke, &o->stretches[i - 1].last,
                               &o->stretches[i].first));
  return CELSPAN_OK;
}

static void reverse(stretch *stretches, size_t count) {
  for (size_t i = 0, j = count; i + 1 < j; i++) {
    stretch swapped = stretches[i];
    stretches[i] = stretches[--j];
    stretches[j] = swapped;
  }
}

/* Rotates a closed part, so that it begins after something that is hidden. */
static void begin_at_cut(outliner *o) {
  size_t first = 0;
  o->stretches[0].is_cut |= o->is_cut;
  while (first < o->count && !o->stretches[first].is_cut)
    first++;
  if (first == 0 || first == o->count)
    return;
  reverse(o->stretches, first);
  reverse(o->stretches + first, o->count - first);
  reverse(o->stretches, o->count);
}

static celspan_status add_part_runs(outliner *o, const cs_stroke_part *part) {
  if (part->is_closed) {
    begin_at_cut(o);
    if (!o->stretches[0].is_cut) {
      CS_TRY(add_turns(o, 0, o->count));
      return add_ring(o);
    }
  }
  for (size_t begin = 0, end; begin < o->count; begin = end) {
    end = begin + 1;
    while (end < o->count && !o->stretches[end].is_cut)
      end++;
    CS_TRY(add_turns(o, begin, end));
    CS_TRY(add_run(o, begin, end, o->stretches[begin].is_cut,
                   end < o->count || o->is_cut || part->is_closed));
  }
  return CELSPAN_OK;
}

static celspan_status add_dot(outliner *o, const cs_stroke_part *part) {
  cs_curve curve;
  cs_curve_load(o->stroke, part->first, 0, 1, &curve);
  cs_spoke place = cs_spoke_at(&curve, part->begin);
  place = cs_spoke_make(place.centre, place.radius, place.tangent, 0);
  return cs_corner_dot(&o->side, o->stroke, &place);
}

static celspan_status add_part(outliner *o, const cs_stroke_part *part) {
  if (part->count == 1 && part->begin == part->end)
    return add_dot(o, part);
  CS_TRY(add_stretches(o, part));
  return o->count > 0 ? add_part_runs(o, part) : CELSPAN_OK;
}

/* The line from the beginning of part `begin` to the end of part `end` - 1. Returns false where it
 * is not a stretch of one piece. */
static bool find_line(cs_parts *parts, size_t begin, size_t end, cs_curve *line) {
  const cs_stroke_part first = cs_parts_get(parts, begin), last = cs_parts_get(parts, end - 1);
  if (first.first != last.first || first.count != 1 || last.count != 1 || !(first.begin < last.end))
    return false;
  cs_curve_load(parts->stroke, first.first, first.begin, last.end, line);
  return true;
}

/* The box around parts that lie on a stretch of one piece: they have no joins. */
static celspan_box box_around(const cs_stroke *stroke, const cs_curve *line) {
  if (stroke->cap != CELSPAN_STROKE_CAP_BUTT || line->radius_degree > 0 ||
      !cs_curve_is_straight(&line->line))
    return cs_curve_box(line, cs_stroke_extent_of_caps(stroke));
  celspan_box box = cs_curve_box(line, 0); /* the parts end where the line ends */
  celspan_point along = cs_curve_departure(&line->line);
  double beside = fabs(along.y) * line->radius[0], above = fabs(along.x) * line->radius[0];
  return (celspan_box){box.x - beside, box.y - above, box.width + 2 * beside,
                       box.height + 2 * above};
}

static bool is_line_hidden(const cs_stroke_view *view, const cs_stroke *stroke,
                           const cs_curve *line) {
  celspan_box box = box_around(stroke, line);
  return cs_stroke_view_hides(view, &box);
}

static bool are_hidden(outliner *o, size_t begin, size_t end) {
  cs_curve line;
  return find_line(&o->parts, begin, end, &line) && is_line_hidden(o->view, o->stroke, &line);
}

/* Adds parts [begin, end). If there are very many dashes, perhaps few of them are in the frame.
 * These are found by halving. */
static celspan_status add_parts(outliner *o, size_t begin, size_t end) {
  if (end - begin > FEW) {
    size_t middle = begin + (end - begin) / 2;
    if (!o->is_all_visible && are_hidden(o, begin, end))
      return CELSPAN_OK;
    CS_TRY(add_parts(o, begin, middle));
    return add_parts(o, middle, end);
  }
  for (size_t i = begin; i < end; i++) {
    cs_stroke_part part = cs_parts_get(&o->parts, i);
    if (o->is_all_visible || !are_hidden(o, i, i + 1))
      CS_TRY(add_part(o, &part));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- outlines */

/* Appends the outline of parts [begin, end). */
static celspan_status outline_parts(celspan_context *context, const cs_stroke *stroke,
                                    const cs_stroke_view *view, size_t begin, size_t end,
                                    cs_outline *outline) {
  outliner o = {.stroke = stroke, .view = view, .extent = cs_stroke_extent(stroke)};
  o.is_all_visible = cs_stroke_view_holds(view, &stroke->around);
  if (cs_stroke_view_hides(view, &stroke->around))
    return CELSPAN_OK;
  cs_parts_init(&o.parts, stroke);
  cs_side_init(&o.side, context, view, outline);
  o.side.may_hide = !o.is_all_visible;
  celspan_status status = add_parts(&o, begin, end);
  if (status == CELSPAN_OK)
    status = cs_side_add_folds(&o.side);
  cs_mem_free(context->memory, o.stretches, o.capacity * sizeof *o.stretches);
  cs_side_finish(&o.side);
  return status;
}

celspan_status cs_stroke_outline(celspan_context *context, const cs_stroke *stroke,
                                 const cs_stroke_view *view, cs_outline *outline) {
  return outline_parts(context, stroke, view, 0, stroke->part_count, outline);
}

/* ---------------------------------------------------------------- without a frame */

/* A view in which an outline is right within 2^-27 of the stroke's size, wherever it is seen. Far
 * from the origin the curves themselves are rounded to more than that: asking for less than their
 * rounding would divide them for ever. */
static cs_stroke_view fine_view(const celspan_box *box) {
  double far_x = fmax(fabs(box->x), fabs(box->x + box->width));
  double far_y = fmax(fabs(box->y), fabs(box->y + box->height));
  double size = fmax(box->width, box->height);
  return (cs_stroke_view){.matrix = celspan_matrix_identity(),
                          .frame = {box->x, box->x + box->width, box->y, box->y + box->height},
                          .tolerance = fmax(0x1p-27 * size, 0x1p-41 * fmax(far_x, far_y)),
                          .top = box->y,
                          .bottom = box->y + box->height,
                          .left = box->x,
                          .right = box->x + box->width};
}

celspan_status cs_stroke_outline_finely(celspan_context *context, const cs_stroke *stroke,
                                        cs_outline *outline) {
  const cs_stroke_view view = fine_view(&stroke->around);
  if (stroke->dashes.place_count > 0 && stroke->part_count > CS_STROKE_SHAPED)
    return cs_fail(context, CELSPAN_LIMIT,
                   "a line with %zu dashes cannot be offset, bent, morphed, given an outline or "
                   "grown as a matte; at most %d are possible there: make the dashes longer, or "
                   "the line shorter",
                   stroke->part_count, CS_STROKE_SHAPED);
  return cs_stroke_outline(context, stroke, &view, outline);
}

celspan_status cs_stroke_bounds(celspan_context *context, const cs_stroke *stroke,
                                const celspan_matrix *matrix, celspan_box *out, bool *is_seen) {
  const cs_stroke_view view = fine_view(&stroke->around);
  celspan_status status = CELSPAN_OK;
  *is_seen = false;
  for (size_t begin = 0, end; status == CELSPAN_OK && begin < stroke->part_count; begin = end) {
    celspan_box box;
    cs_outline outline;
    cs_outline_init(&outline);
    end = stroke->part_count - begin > MANY ? begin + MANY : stroke->part_count;
    status = outline_parts(context, stroke, &view, begin, end, &outline);
    if (status == CELSPAN_OK && cs_outline_bounds(&outline, matrix, &box)) {
      *out = *is_seen ? cs_outline_box_around(*out, box) : box;
      *is_seen = true;
    }
    cs_outline_finish(&outline, context->memory);
  }
  return status;
}

/* ---------------------------------------------------------------- counting */

typedef struct counter {
  cs_parts parts;
  const cs_stroke_view *view;
  size_t count, most;
} counter;

/* Whether nothing can be seen of a part that contains joints. */
static bool is_bent_hidden(counter *c, size_t part_index) {
  const cs_stroke *stroke = c->parts.stroke;
  const cs_stroke_part part = cs_parts_get(&c->parts, part_index);
  for (size_t i = 0; i < part.count; i++) {
    cs_curve curve;
    cs_curve_load(stroke, cs_stroke_piece(stroke, &part, i), i == 0 ? part.begin : 0,
                  i + 1 == part.count ? part.end : 1, &curve);
    celspan_box box = cs_curve_box(&curve, cs_stroke_extent(stroke));
    if (!cs_stroke_view_hides(c->view, &box))
      return false;
  }
  return true;
}

static void count_parts(counter *c, size_t begin, size_t end) {
  cs_curve line;
  if (c->count > c->most)
    return;
  bool is_one = find_line(&c->parts, begin, end, &line);
  if (is_one && is_line_hidden(c->view, c->parts.stroke, &line))
    return;
  celspan_box box = is_one ? cs_curve_box(&line, 0) : (celspan_box){0};
  if (end - begin == 1 || (is_one && cs_stroke_view_holds(c->view, &box))) {
    c->count += is_one || !is_bent_hidden(c, begin) ? end - begin : 0;
    return;
  }
  size_t middle = begin + (end - begin) / 2;
  count_parts(c, begin, middle);
  count_parts(c, middle, end);
}

size_t cs_stroke_count_visible(const cs_stroke *stroke, const cs_stroke_view *view, size_t most) {
  counter c = {.view = view, .most = most};
  if (stroke->dashes.place_count == 0 || stroke->part_count == 0 ||
      cs_stroke_view_hides(view, &stroke->around))
    return 0;
  if (cs_stroke_view_holds(view, &stroke->around))
    return stroke->part_count;
  cs_parts_init(&c.parts, stroke);
  count_parts(&c, 0, stroke->part_count);
  return c.count;
}
