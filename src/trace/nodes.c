#include "trace/nodes.h"

#include <math.h>

#include "base/number.h"

/* Points between these distances from the corner are fitted; the sides of that way. */
#define NEAREST 1.2
#define FARTHEST 6.0
enum { SIDES = 8 };
/* The weight of the corner itself. */
#define CORNER 0.05

/* The normal equations of the place, about the corner: m place = v. */
typedef struct sums {
  double xx, xy, yy, x, y;
} sums;

/* Adds the square of the distance from the line through the points. */
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
  /* The direction across the points: that of the lesser eigenvalue. */
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

/* The least sum, at most so far from the corner, and on the rim along it alone. */
static celspan_point least(const sums *s, const cs_node *node, const cs_labels *labels) {
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
  *out = least(&s, node, material->labels);
  return CELSPAN_OK;
}

celspan_status cs_nodes_place(celspan_context *context, const cs_material *material,
                              const cs_borders *borders, celspan_point *places) {
  for (size_t i = 0; i < borders->node_count; i++)
    CS_TRY(place(context, material, borders, &borders->nodes[i], &places[i]));
  return CELSPAN_OK;
}
