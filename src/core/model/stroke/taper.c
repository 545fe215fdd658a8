/* Tapers: the radius grows with the way from the beginning of a part, and falls with the way to its
 * end.
 *
 *   factor  1 |     ________________           The way along a piece is no polynomial of its
 *             |   .'                '.         parameter. It is replaced by one of degree 5, the
 *           0 | .'                    '.       integral of a polynomial through the speed at five
 *             +-|---|---------------|---|->    places, and the piece is halved until that is right
 *               0  taper[0]   taper[1]         within WAY_ERROR of the taper.
 */
#include <math.h>
#include <string.h>

#include "model/stroke/parts.h"

#define WAY_DEGREE 5
#define WAY_ERROR 1e-9
#define WAY_DEPTH 24

typedef struct tapering {
  celspan_context *context;
  cs_stroke *out;
  double length;   /* the length of the part */
  double taper[2]; /* scaled down, if the part is shorter */
  bool is_round;   /* the factor is u (2 - u), where u is the factor of a straight taper */
  double way;      /* the length from the beginning of the part to the current place */
  bool is_first;   /* nothing of the part is appended yet */
} tapering;

/* ---------------------------------------------------------------- ways as polynomials */

/* The length from the beginning of a line, as Bernstein coefficients. */
static void find_way(const cs_bezier *line, double way[WAY_DEGREE + 1]) {
  double d[WAY_DEGREE], powers[WAY_DEGREE + 1] = {0};
  for (int i = 0; i < WAY_DEGREE; i++) {
    celspan_point point, velocity;
    cs_curve_line_at(line, 0.25 * i, &point, &velocity);
    d[i] = sqrt(velocity.x * velocity.x + velocity.y * velocity.y);
  }
  for (int level = 1; level < WAY_DEGREE; level++) /* Newton's forward differences */
    for (int i = WAY_DEGREE - 1; i >= level; i--)
      d[i] -= d[i - 1];
  powers[1] = d[0];
  powers[2] = 4 * (d[1] - d[2] / 2 + d[3] / 3 - d[4] / 4) / 2;
  powers[3] = 16 * (d[2] / 2 - d[3] / 2 + 11 * d[4] / 24) / 3;
  powers[4] = 64 * (d[3] / 6 - d[4] / 4) / 4;
  powers[5] = 256 * (d[4] / 24) / 5;
  static const double binomials[WAY_DEGREE + 1][WAY_DEGREE + 1] = {
      {1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {1, 5, 10, 10, 5, 1}};
  for (int k = 0; k <= WAY_DEGREE; k++) {
    way[k] = 0;
    for (int j = 0; j <= k; j++)
      way[k] += binomials[k][j] / binomials[WAY_DEGREE][j] * powers[j];
  }
}

/* ---------------------------------------------------------------- pieces */

/* The curve with its radius multiplied by the factor. way: the length so far, as shares of the
 * taper's length. */
static void narrow(const tapering *t, const cs_curve *curve, const double way[WAY_DEGREE + 1],
                   cs_curve *out) {
  double rest[WAY_DEGREE + 1], once[CS_STROKE_RADIUS_DEGREE + 1];
  *out = *curve;
  out->radius_degree += WAY_DEGREE;
  cs_curve_multiply(curve->radius, curve->radius_degree, way, WAY_DEGREE, out->radius);
  if (!t->is_round)
    return;
  for (int i = 0; i <= WAY_DEGREE; i++)
    rest[i] = 2 - way[i];
  memcpy(once, out->radius, sizeof once);
  cs_curve_multiply(once, out->radius_degree, rest, WAY_DEGREE, out->radius);
  out->radius_degree += WAY_DEGREE;
}

/* Appends a curve that lies in one of the three stretches of its part. length: of its line. */
static celspan_status append(tapering *t, const cs_curve *curve, double length, int depth) {
  double way[WAY_DEGREE + 1], error = WAY_ERROR * t->length;
  double middle = t->way + 0.5 * length;
  int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;
  cs_curve low, high;
  if (side >= 0) {
    bool is_straight = cs_curve_is_straight(&curve->line);
    find_way(&curve->line, way);
    cs_curve_split(curve, 0.5, &low, &high);
    double half = is_straight ? 0.5 * length : cs_curve_length(&low.line, 0, 1);
    double half_way[WAY_DEGREE + 1];
    memcpy(half_way, way, sizeof half_way);
    cs_curve_cut_polynomial(half_way, WAY_DEGREE, 0, 0.5);
    bool is_right =
        fabs(way[WAY_DEGREE] - length) <= error && fabs(half_way[WAY_DEGREE] - half) <= error;
    if (!is_straight && !is_right && depth < WAY_DEPTH) {
      CS_TRY(append(t, &low, half, depth + 1));
      return append(t, &high, length - half, depth + 1);
    }
    for (int i = 0; i <= WAY_DEGREE; i++) {
      double at = t->way + way[i];
      way[i] = fmin(1, fmax(0, side == 0 ? at : t->length - at) / t->taper[side]);
    }
    narrow(t, curve, way, &low);
    curve = &low;
  }
  t->way += length;
  bool is_first = t->is_first;
  t->is_first = false;
  return cs_stroke_append(t->context, t->out, curve, is_first);
}

/* Cuts a curve where a taper begins or ends. */
static celspan_status append_cut(tapering *t, const cs_curve *curve) {
  const double knots[2] = {t->taper[0], t->length - t->taper[1]};
  double length = cs_curve_length(&curve->line, 0, 1), start = t->way, from = 0, done = 0;
  for (int i = 0; i < 2; i++) {
    double at = knots[i] - start;
    if (!(at > done + 1e-12 * length) || !(at < length * (1 - 1e-12)))
      continue;
    double to = cs_curve_parameter(&curve->line, length, at);
    cs_curve part = *curve;
    cs_bezier rest;
    cs_bezier_split(&curve->line, to, &part.line, &rest);
    if (from > 0)
      cs_bezier_split(&part.line, from / to, &rest, &part.line);
    cs_curve_cut_polynomial(part.radius, part.radius_degree, from, to);
    CS_TRY(append(t, &part, at - done, 0));
    from = to;
    done = at;
  }
  cs_curve part = *curve;
  cs_bezier front;
  if (from > 0)
    cs_bezier_split(&curve->line, from, &front, &part.line);
  cs_curve_cut_polynomial(part.radius, part.radius_degree, from, 1);
  return append(t, &part, length - done, 0);
}

/* ---------------------------------------------------------------- parts */

static void load(const cs_stroke *stroke, const cs_stroke_part *part, size_t i, cs_curve *out) {
  cs_curve_load(stroke, cs_stroke_piece(stroke, part, i), i == 0 ? part->begin : 0,
                i + 1 == part->count ? part->end : 1, out);
}

static celspan_status taper_part(tapering *t, const cs_stroke *stroke, cs_stroke_part *part,
                                 const double taper[2]) {
  cs_curve curve;
  t->length = t->way = 0;
  t->is_first = true;
  for (size_t i = 0; i < part->count; i++) {
    load(stroke, part, i, &curve);
    t->length += cs_curve_is_point(&curve.line) ? 0 : cs_curve_length(&curve.line, 0, 1);
  }
  double scale = fmin(1, t->length / (taper[0] + taper[1]));
  t->taper[0] = scale * taper[0];
  t->taper[1] = scale * taper[1];
  size_t first = t->out->line.piece_count;
  for (size_t i = 0; i < part->count; i++) {
    load(stroke, part, i, &curve);
    if (!cs_curve_is_point(&curve.line))
      CS_TRY(append_cut(t, &curve));
  }
  *part = (cs_stroke_part){.contour = (uint32_t)(t->out->line.contour_count - 1),
                           .first = (uint32_t)first,
                           .count = (uint32_t)(t->out->line.piece_count - first),
                           .end = 1};
  return CELSPAN_OK;
}

/* A part of no length has no width anywhere, and is left out. */
static celspan_status taper_parts(tapering *t, cs_stroke *stroke, const double taper[2]) {
  size_t kept = 0;
  for (size_t i = 0; i < stroke->part_count; i++) {
    cs_stroke_part part = stroke->parts[i];
    CS_TRY(taper_part(t, stroke, &part, taper));
    if (part.count > 0)
      stroke->parts[kept++] = part;
  }
  stroke->part_count = kept;
  return CELSPAN_OK;
}

celspan_status cs_stroke_taper(celspan_context *context, cs_stroke *stroke,
                               const celspan_stroke_desc *desc) {
  cs_stroke made = {.cap = stroke->cap, .join = stroke->join, .miter = stroke->miter};
  cs_outline_init(&made.line);
  tapering t = {
      .context = context, .out = &made, .is_round = desc->profile == CELSPAN_STROKE_PROFILE_ROUND};
  celspan_status status = taper_parts(&t, stroke, desc->taper);
  if (status == CELSPAN_OK) {
    made.parts = stroke->parts;
    made.part_count = stroke->part_count;
    made.parts_room = stroke->parts_room;
    stroke->parts = NULL;
    stroke->parts_room = (cs_room){0};
    cs_stroke swapped = *stroke;
    *stroke = made;
    made = swapped;
  }
  cs_stroke_finish(&made, context->memory);
  return status;
}
