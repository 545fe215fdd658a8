#include "tools/trace/edge.h"

#include <math.h>

#include "inside/number.h"
#include "tools/trace/colours.h"

/* Shares that count as 0, and as 1. */
#define NONE 0.03f
#define ALL 0.97f
/* By how much noise may raise a share with growing distance from an edge. */
#define NOISE 0.04f
/* The number of sides before and after a side that determine the direction of the border. */
#define ABOUT 3
/* The least distance between points along their border. */
#define LEAST_STEP 0.3
/* In an antialiased picture, at least one side in this many has mixed pixels near it. */
#define WHOLE_SHARE 8

/* ---------------------------------------------------------------- points */

celspan_status cs_points_copy(celspan_context *context, cs_points *points,
                              const cs_edge_point *point) {
  return CS_APPEND(context, points->items, points->count, points->capacity, *point);
}

celspan_status cs_points_add(celspan_context *context, cs_points *points, celspan_point point) {
  return cs_points_copy(context, points, &(cs_edge_point){.at = point});
}

double cs_edge_room(const cs_edge_point *point, celspan_point along) {
  double room = fabs(point->aside.x * along.y - point->aside.y * along.x);
  return room > CS_EDGE_TIGHTEST ? room : CS_EDGE_TIGHTEST;
}

void cs_points_finish(celspan_context *context, cs_points *points) {
  cs_mem_free(context->memory, points->items, points->capacity * sizeof *points->items);
  *points = (cs_points){.items = NULL};
}

/* ---------------------------------------------------------------- one side */

/* The pixels across a side: a at -1, -2, .., b at 0, 1, .. */
typedef struct across {
  const cs_material *material;
  int32_t x, y;   /* the pixel at 0 */
  int32_t dx, dy; /* from one pixel to the next */
  unsigned char a, b;
} across;

static unsigned char label_at(const across *line, int i) {
  int32_t x = line->x + i * line->dx, y = line->y + i * line->dy;
  const cs_labels *labels = line->material->labels;
  bool is_in = x >= 0 && y >= 0 && x < labels->width && y < labels->height;
  return is_in ? *cs_labels_at(labels, x, y) : CS_LABEL_OUTSIDE;
}

static float share_at(const across *line, int i) {
  const cs_flat_colour *list = line->material->colours->list;
  cs_light4 light =
      cs_scan_light(line->material->scan, line->x + i * line->dx, line->y + i * line->dy);
  return cs_labels_share(&light, &list[line->a].light, &list[line->b].light);
}

/* The share of the other side's colour on one side of the edge. */
typedef struct flank {
  float sum;
  int own;      /* the number of pixels of its own colour, up to the extent */
  bool is_thin; /* it ends before a plain pixel, because the other colour follows again */
} flank;

/* step: 1: the side of b; -1: the side of a. */
static flank measure(const across *line, int step) {
  flank f = {0, 0, true};
  float before = 1;
  unsigned char label = step > 0 ? line->b : line->a, other = step > 0 ? line->a : line->b;
  for (int i = step > 0 ? 0 : -1; f.own < CS_EDGE_EXTENT; i += step) {
    unsigned char here = label_at(line, i);
    if (here != label) {
      f.is_thin = f.is_thin && here == other;
      return f;
    }
    float share = share_at(line, i);
    float strange = step > 0 ? 1 - share : share;
    if (strange > before + NOISE) {
      f.is_thin = false;
      return f;
    }
    f.sum += strange;
    f.own++;
    before = strange;
    f.is_thin = f.is_thin && strange > NONE;
    if (strange <= NONE)
      return f;
  }
  f.is_thin = false;
  return f;
}

/* The distance of a line without plain pixels from its side: the distance of its middle minus half
 * of its width. f: the line's own side; on the other side of the line, shares decrease again. */
static float begin_of_thin(const across *line, int step, const flank *f, float near) {
  float width = near, moment = 0, before = 1;
  /* The moment of the line's shares, by their distance from the side; shares before the side count
   * as if they were around it. */
  moment -= near * 0.5f;
  for (int i = 0; i < f->own + CS_EDGE_EXTENT; i++) {
    int place = step > 0 ? i : -1 - i;
    if (label_at(line, place) == CS_LABEL_OUTSIDE)
      break;
    float share = share_at(line, place), own = step > 0 ? share : 1 - share;
    if (i >= f->own && (own <= NONE || own > before + NOISE || own > 0.5f))
      break;
    width += own;
    moment += own * ((float)i + 0.5f);
    before = own;
  }
  return moment / width - 0.5f * width;
}

/* The position of the edge, from the side towards b. */
static double locate(const across *line) {
  flank a = measure(line, -1), b = measure(line, 1);
  double offset = (double)(b.sum - a.sum);
  if (b.is_thin && !a.is_thin)
    offset = (double)begin_of_thin(line, 1, &b, a.sum);
  else if (a.is_thin && !b.is_thin)
    offset = -(double)begin_of_thin(line, -1, &a, b.sum);
  return offset < -CS_EDGE_FAR ? -CS_EDGE_FAR : offset > CS_EDGE_FAR ? CS_EDGE_FAR : offset;
}

/* The pixels across the side that leaves (x, y) in a direction. */
static across across_side(const cs_material *material, int32_t x, int32_t y, int direction) {
  bool is_upright = direction % 2 == 1;
  across line = {.material = material,
                 .x = x - (direction == 2),
                 .y = y - (direction == 3),
                 .dx = is_upright,
                 .dy = !is_upright};
  line.a = label_at(&line, -1);
  line.b = label_at(&line, 0);
  return line;
}

static celspan_point point_of(const across *line) {
  double offset = locate(line);
  return line->dx ? (celspan_point){line->x + offset, line->y + 0.5}
                  : (celspan_point){line->x + 0.5, line->y + offset};
}

/* ---------------------------------------------------------------- chains */

typedef struct course {
  const unsigned char *directions;
  size_t count;
  bool is_closed;
} course;

static int direction_at(const course *c, ptrdiff_t i) {
  ptrdiff_t count = (ptrdiff_t)c->count;
  if (c->is_closed)
    return c->directions[((i % count) + count) % count];
  return i < 0 || i >= count ? -1 : c->directions[i];
}

/* The direction of the border around side i. Both ends of the examined range count by half, so that
 * all sides of a diagonal have the same direction. */
static celspan_point way_about(const course *c, size_t i) {
  celspan_point way = {0, 0};
  for (ptrdiff_t k = (ptrdiff_t)i - ABOUT; k <= (ptrdiff_t)i + ABOUT; k++) {
    int direction = direction_at(c, k);
    if (direction < 0)
      continue;
    int weight = k == (ptrdiff_t)i - ABOUT || k == (ptrdiff_t)i + ABOUT ? 1 : 2;
    way.x += weight * cs_border_x(direction);
    way.y += weight * cs_border_y(direction);
  }
  return way;
}

/* Whether a side is used for this direction of the border: for a diagonal, only the upright sides
 * are. */
static bool is_asked(celspan_point way, int direction) {
  return direction % 2 == 1 ? fabs(way.y) >= fabs(way.x) : fabs(way.x) > fabs(way.y);
}

/* Whether a point is farther along the way than the last one by a large part of a pixel: otherwise
 * points of upright and of horizontal sides would alternate where a border turns. */
static bool goes_on(const cs_points *points, celspan_point point, celspan_point way) {
  if (points->count == 0)
    return true;
  celspan_point last = points->items[points->count - 1].at;
  double length = cs_number_length(way.x, way.y);
  return (point.x - last.x) * way.x + (point.y - last.y) * way.y >= LEAST_STEP * length;
}

static course course_of(const cs_borders *borders, const cs_chain *chain) {
  return (course){borders->directions + chain->first, chain->count, chain->from == CS_NODE_NONE};
}

/* The middle of a side of whole pixels. For direction 0, the left side is above. */
static celspan_status add_middle(celspan_context *context, celspan_point from, int direction,
                                 cs_points *out) {
  double x = 0.5 * cs_border_x(direction), y = 0.5 * cs_border_y(direction);
  return cs_points_copy(context, out, &(cs_edge_point){{from.x + x, from.y + y}, {y, -x}});
}

/* Adds the point of side i, which begins at (x, y), if it has one. */
static celspan_status add_point_of(celspan_context *context, const cs_material *material,
                                   const course *c, size_t i, celspan_point from, cs_points *out) {
  int direction = c->directions[i];
  if (material->is_whole)
    return add_middle(context, from, direction, out);
  celspan_point way = way_about(c, i);
  if (!is_asked(way, direction))
    return CELSPAN_OK;
  across line = across_side(material, (int32_t)from.x, (int32_t)from.y, direction);
  celspan_point point = point_of(&line);
  return goes_on(out, point, way) ? cs_points_add(context, out, point) : CELSPAN_OK;
}

celspan_status cs_edge_points(celspan_context *context, const cs_material *material,
                              const cs_borders *borders, const cs_chain *chain, cs_sides sides,
                              cs_points *out) {
  course c = course_of(borders, chain);
  celspan_point at = {chain->x, chain->y};
  for (size_t i = 0; i < sides.to; i++) {
    if (i >= sides.from)
      CS_TRY(add_point_of(context, material, &c, i, at, out));
    at.x += cs_border_x(c.directions[i]);
    at.y += cs_border_y(c.directions[i]);
  }
  return CELSPAN_OK;
}

celspan_status cs_edge_turns(celspan_context *context, const cs_borders *borders,
                             const cs_chain *chain, cs_points *out) {
  course c = course_of(borders, chain);
  int32_t x = chain->x, y = chain->y;
  for (size_t i = 0; i <= c.count; i++) {
    bool is_end = i == 0 || i == c.count;
    bool turns = is_end ? !c.is_closed || direction_at(&c, -1) != c.directions[0]
                        : c.directions[i] != c.directions[i - 1];
    if (turns)
      CS_TRY(cs_points_add(context, out, (celspan_point){x, y}));
    if (i < c.count) {
      x += cs_border_x(c.directions[i]);
      y += cs_border_y(c.directions[i]);
    }
  }
  if (!c.is_closed || out->count == 0)
    return CELSPAN_OK;
  celspan_point first = out->items[0].at, last = out->items[out->count - 1].at;
  bool is_open = first.x != last.x || first.y != last.y;
  return is_open ? cs_points_add(context, out, first) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- whole pixels */

static bool is_mixed(const across *line) {
  float a = share_at(line, -1), b = share_at(line, 0);
  return (a > NONE && a < ALL) || (b > NONE && b < ALL);
}

bool cs_edge_is_whole(const cs_material *material, const cs_regions *regions) {
  size_t sides = regions->rows[regions->height] - (size_t)regions->height, mixed = 0;
  for (int32_t y = 0; y < regions->height; y++)
    for (size_t i = regions->rows[y] + 1; i < regions->rows[y + 1]; i++) {
      across line = across_side(material, regions->runs[i].x0, y, 1);
      mixed += is_mixed(&line);
      if (mixed > sides / WHOLE_SHARE)
        return false;
    }
  return true;
}
