#include "tools/trace/curves.h"

#include <math.h>

#include "inside/elementary.h"
#include "inside/number.h"
#include "tools/trace/corners.h"

/* Closed chains with fewer sides or fewer points are not changed. */
enum { FEW_SIDES = 8, FEW_POINTS = 5 };

typedef struct maker {
  celspan_context *context;
  const cs_material *material;
  const cs_borders *borders;
  celspan_point *places; /* the places of nodes */
  cs_fit_rules rules;
  bool is_exact; /* the borders of the pixels themselves */
  cs_curves *out;
} maker;

static double least(double a, double b) { return a < b ? a : b; }

static double most(double a, double b) { return a > b ? a : b; }

static cs_fit_rules rules_of_mixed(double smooth) {
  return (cs_fit_rules){.tolerance = 0.15 * smooth,
                        .mean = 0.15 * smooth,
                        .straight = 0.1125 * smooth,
                        .about = (int)least(3 + 2 * smooth, 12),
                        .near = 4,
                        .rounding = 0.45,
                        .noise = 0.065 * most(smooth, 1)};
}

/* In a picture of whole pixels, the position of an edge is only known to half a pixel from a side:
 * this is noise of the square root of 1/12. A curve that is smoothed more need not pass between the
 * pixels. */
static cs_fit_rules rules_of_whole(double smooth) {
  return (cs_fit_rules){.tolerance = 0.3 + 0.25 * smooth,
                        .mean = 0.1 + 0.15 * smooth,
                        .straight = 0.3 + 0.3 * smooth,
                        .about = 8,
                        .near = 8,
                        .rounding = 0.7,
                        .noise = 0.28 * most(smooth, 1),
                        .is_exact = smooth <= 1};
}

static cs_fit_rules rules_for(double smooth, bool is_whole) {
  const double degree = 0.017453292519943295;
  double sine;
  cs_fit_rules rules = is_whole ? rules_of_whole(smooth) : rules_of_mixed(smooth);
  cs_elementary_sincos(degree * least(is_whole ? 38 + 10 * smooth : 28 + 10 * smooth, 80), &sine,
                       &rules.turn);
  return rules;
}

/* ---------------------------------------------------------------- one chain */

/* Follows the sides of the pixels from node to node; the nodes have been moved. */
static celspan_status follow_pixels(const maker *m, const cs_chain *chain, cs_points *points,
                                    celspan_point *start) {
  CS_TRY(cs_edge_turns(m->context, m->borders, chain, points));
  if (chain->from != CS_NODE_NONE) {
    points->items[0].at = m->places[chain->from];
    points->items[points->count - 1].at = m->places[chain->to];
  }
  *start = cs_fit_snap(points->items[0].at);
  return cs_fit_lines(m->context, points, &m->out->pieces);
}

static celspan_status follow_edge(const maker *m, const cs_chain *chain, cs_points *points,
                                  celspan_point *start) {
  bool is_open = chain->from != CS_NODE_NONE;
  const cs_sides all = {0, chain->count};
  if (is_open)
    CS_TRY(cs_points_add(m->context, points, m->places[chain->from]));
  CS_TRY(cs_edge_points(m->context, m->material, m->borders, chain, all, points));
  if (!is_open && points->count < FEW_POINTS) {
    points->count = 0;
    return follow_pixels(m, chain, points, start);
  }
  if (!is_open)
    return cs_fit_closed(m->context, points, &m->rules, start, &m->out->pieces);
  CS_TRY(cs_points_add(m->context, points, m->places[chain->to]));
  *start = cs_fit_snap(points->items[0].at);
  return cs_fit_open(m->context, points, &m->rules, &m->out->pieces);
}

static celspan_status make_curve(const maker *m, const cs_chain *chain, cs_trace_curve *curve) {
  cs_points points = {.items = NULL};
  bool is_few = chain->from == CS_NODE_NONE && chain->count < FEW_SIDES;
  curve->first = m->out->pieces.count;
  celspan_status status = m->is_exact || is_few || cs_chain_is_rim(chain)
                              ? follow_pixels(m, chain, &points, &curve->start)
                              : follow_edge(m, chain, &points, &curve->start);
  curve->count = m->out->pieces.count - curve->first;
  cs_points_finish(m->context, &points);
  return status;
}

/* ---------------------------------------------------------------- all */

static celspan_status place_nodes(const maker *m) {
  for (size_t i = 0; i < m->borders->node_count && m->is_exact; i++)
    m->places[i] = (celspan_point){m->borders->nodes[i].x, m->borders->nodes[i].y};
  return m->is_exact ? CELSPAN_OK : cs_nodes_place(m->context, m->material, m->borders, m->places);
}

static celspan_status make_all(const maker *m) {
  CS_TRY(place_nodes(m));
  for (size_t i = 0; i < m->borders->chain_count; i++)
    CS_TRY(make_curve(m, &m->borders->chains[i], &m->out->list[i]));
  return CELSPAN_OK;
}

celspan_status cs_curves_make(celspan_context *context, const cs_material *material,
                              const cs_borders *borders, double smooth, cs_curves *out) {
  cs_memory *memory = context->memory;
  size_t nodes = borders->node_count + 1; /* at least one, so that the array exists */
  maker m = {.context = context, .material = material, .borders = borders, .out = out};
  *out = (cs_curves){.count = borders->chain_count};
  out->list = cs_mem_array(memory, out->count, sizeof *out->list);
  m.places = cs_mem_array(memory, nodes, sizeof *m.places);
  m.rules = rules_for(smooth, material->is_whole);
  m.is_exact = !(smooth > 0);
  celspan_status status = out->list && m.places ? make_all(&m) : cs_fail_memory(context);
  cs_mem_free(memory, m.places, nodes * sizeof *m.places);
  return status;
}

void cs_curves_finish(cs_curves *curves, celspan_context *context) {
  cs_mem_free(context->memory, curves->list, curves->count * sizeof *curves->list);
  cs_pieces_finish(context, &curves->pieces);
  *curves = (cs_curves){.list = NULL};
}

/* ---------------------------------------------------------------- nodes */

/* The distances from the corner between which points are fitted, and the number of sides
 * examined. */
#define NEAREST 1.2
#define FARTHEST 6.0
enum { SIDES = 8 };
/* The weight of the corner itself. */
#define CORNER 0.05

/* The normal equations of the place, about the corner: m place = v. */
typedef struct sums {
  double xx, xy, yy, x, y;
} sums;

/* Adds the squared distance from the line through the points. */
static void add_line(sums *s, const cs_points *points, const cs_node *node) {
  double n = 0, mx = 0, my = 0, xx = 0, xy = 0, yy = 0;
  for (size_t i = 0; i < points->count; i++) {
    double x = points->items[i].at.x - node->x, y = points->items[i].at.y - node->y;
    double far = cs_number_length(x, y);
    if (far < NEAREST || far > FARTHEST)
      continue;
    n++, mx += x, my += y, xx += x * x, xy += x * y, yy += y * y;
  }
  if (n < 2)
    return;
  mx /= n, my /= n;
  xx = xx / n - mx * mx, xy = xy / n - mx * my, yy = yy / n - my * my;
  /* The direction across the points: the smaller eigenvalue has it. */
  double half = 0.5 * (xx - yy), root = sqrt(half * half + xy * xy);
  double nx = half > 0 ? -xy : root - half, ny = half > 0 ? root + half : -xy;
  double length = cs_number_length(nx, ny);
  if (length < 1e-9)
    return;
  nx /= length, ny /= length;
  double offset = nx * mx + ny * my;
  s->xx += nx * nx, s->xy += nx * ny, s->yy += ny * ny;
  s->x += nx * offset, s->y += ny * offset;
}

static celspan_status add_way(celspan_context *context, const cs_material *material,
                              const cs_borders *borders, const cs_node *node, cs_way way, sums *s) {
  const cs_chain *chain = &borders->chains[way / 2];
  size_t count = chain->count, from = way % 2 == 0 || count < SIDES ? 0 : count - SIDES;
  const cs_sides sides = {from, from + SIDES < count ? from + SIDES : count};
  cs_points points = {.items = NULL};
  celspan_status status = cs_edge_points(context, material, borders, chain, sides, &points);
  if (status == CELSPAN_OK)
    add_line(s, &points, node);
  cs_points_finish(context, &points);
  return status;
}

/* The point with the least sum. If it is farther from the corner than the limit, the point with the
 * least sum at that distance. */
static celspan_point least_sum_point(const sums *s, const cs_node *node, const cs_labels *labels) {
  double area = s->xx * s->yy - s->xy * s->xy;
  double x = (s->x * s->yy - s->y * s->xy) / area, y = (s->y * s->xx - s->x * s->xy) / area;
  if (node->x == 0 || node->x == labels->width) {
    x = 0;
    y = s->y / s->yy;
  }
  if (node->y == 0 || node->y == labels->height) {
    y = 0;
    x = node->x == 0 || node->x == labels->width ? 0 : s->x / s->xx;
  }
  double far = cs_number_length(x, y), held = far > CS_NODE_FAR ? CS_NODE_FAR / far : 1;
  return (celspan_point){node->x + held * x, node->y + held * y};
}

static celspan_status place(celspan_context *context, const cs_material *material,
                            const cs_borders *borders, const cs_node *node, celspan_point *out) {
  sums s = {CORNER, 0, CORNER, 0, 0};
  for (int direction = 0; direction < 4; direction++) {
    cs_way way = node->out[direction];
    if (way != CS_WAY_NONE && !cs_chain_is_rim(&borders->chains[way / 2]))
      CS_TRY(add_way(context, material, borders, node, way, &s));
  }
  *out = least_sum_point(&s, node, material->labels);
  return CELSPAN_OK;
}

celspan_status cs_nodes_place(celspan_context *context, const cs_material *material,
                              const cs_borders *borders, celspan_point *places) {
  for (size_t i = 0; i < borders->node_count; i++)
    CS_TRY(place(context, material, borders, &borders->nodes[i], &places[i]));
  return CELSPAN_OK;
}
