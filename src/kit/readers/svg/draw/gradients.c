/* Gradients: stops, spreads and places of an element, as the texture for one shape. */
#include "readers/svg/draw/painted.h"

#include <math.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/number.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/words/transforms.h"

/* The most templates that follow one another by href. */
#define TEMPLATES 32
/* How far from the centre a focus may lie, as a share of the radius. */
#define FOCUS_SHARE 0.999

/* The most stops that replace one stretch between two stops; 64 are enough from black to white. */
#define PIECES 64
/* The allowed difference between the picture here and in a browser, in coded values. */
#define TOLERANCE (0.5 / 255)

typedef struct coloured_stop {
  double at; /* 0..1, ascending */
  cs_svg_colour colour;
} coloured_stop;

/* All zero is an empty list. */
typedef struct gradient_stops {
  celspan_stop *items;
  size_t count, capacity;
} gradient_stops;

typedef enum spread_kind { SPREAD_PAD, SPREAD_REFLECT, SPREAD_REPEAT } spread_kind;

typedef struct gradient {
  cs_svg_reading *reading;
  const cs_svg_node *node;
  const cs_svg_painted *shape;
  bool is_radial;
  bool is_in_box;         /* units are shares of the shape's box */
  cs_svg_measure measure; /* the measure of its lengths */
  spread_kind spread;
  gradient_stops stops;
  celspan_matrix matrix;
  /* linear: from, to; radial: the last circle has the radius `outer` around `to`, and the circle at
   * 0 the radius `inner` around `from`; with inner = 0 and from = to, it is the usual gradient. */
  celspan_point from, to;
  double inner, outer;
} gradient;

/* ---------------------------------------------------------------- stops */

static cs_svg_colour mixed(const cs_svg_colour *a, const cs_svg_colour *b, double u) {
  cs_svg_colour mix = {.alpha = a->alpha + u * (b->alpha - a->alpha)};
  for (int c = 0; c < 3; c++)
    mix.rgb[c] = a->rgb[c] + u * (b->rgb[c] - a->rgb[c]);
  return mix;
}

/* Whether the stops will be mixed as codes, as the file demands. */
static bool mixes_codes(const cs_svg_reading *reading) {
  return reading->is_coded || reading->space == CELSPAN_SPACE_SRGB;
}

static double decode(const cs_svg_reading *reading, double coded) {
  return mixes_codes(reading) ? coded
                              : (double)cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)coded);
}

static double encode(const cs_svg_reading *reading, double light) {
  return mixes_codes(reading) ? light
                              : (double)cs_transfer_encode(CELSPAN_TRANSFER_SRGB, (float)light);
}

/* Whether the linear mix of two premultiplied stops is near enough to the mix of their codes, at
 * the share u of the way. */
static bool is_near(const cs_svg_reading *reading, const cs_svg_colour *a, const cs_svg_colour *b,
                    double u) {
  const cs_svg_colour exact = mixed(a, b, u);
  if (!(exact.alpha > 0))
    return true;
  for (int c = 0; c < 3; c++) {
    double light =
        (1 - u) * a->alpha * decode(reading, a->rgb[c]) + u * b->alpha * decode(reading, b->rgb[c]);
    double shown = encode(reading, light / exact.alpha);
    if (fabs(shown - exact.rgb[c]) * exact.alpha > TOLERANCE)
      return false;
  }
  return true;
}

/* The number of equal pieces into which a stretch is cut so that each piece is near enough. */
static int count_pieces(const cs_svg_reading *reading, const cs_svg_colour *a,
                        const cs_svg_colour *b) {
  int count = 1;
  for (bool is_enough = false; !is_enough && count < PIECES; count += !is_enough ? count : 0) {
    is_enough = true;
    for (int i = 0; i < count && is_enough; i++) {
      const cs_svg_colour from = mixed(a, b, (double)i / count);
      const cs_svg_colour to = mixed(a, b, (double)(i + 1) / count);
      is_enough = is_near(reading, &from, &to, 0.25) && is_near(reading, &from, &to, 0.5) &&
                  is_near(reading, &from, &to, 0.75);
    }
  }
  return count;
}

static celspan_status append(cs_svg_reading *reading, double at, const cs_svg_colour *colour,
                             double opacity, gradient_stops *out) {
  return CS_APPEND(reading->context, out->items, out->count, out->capacity,
                   (celspan_stop){at, cs_svg_paint_of(reading, colour, opacity)});
}

/* Appends the stops after `last`, up to and including `next`. */
static celspan_status append_stretch(cs_svg_reading *reading, const coloured_stop *last,
                                     const coloured_stop *next, double opacity,
                                     gradient_stops *out) {
  int pieces = next->at > last->at ? count_pieces(reading, &last->colour, &next->colour) : 1;
  for (int i = 1; i < pieces; i++) {
    double u = (double)i / pieces;
    const cs_svg_colour colour = mixed(&last->colour, &next->colour, u);
    CS_TRY(append(reading, last->at + u * (next->at - last->at), &colour, opacity, out));
  }
  return append(reading, next->at, &next->colour, opacity, out);
}

/* A number or a percentage, clamped to 0..1. */
static double offset_of(const cs_svg_node *stop) {
  const char *value = cs_svg_node_value(stop, CS_SVG_OFFSET);
  double offset;
  value = cs_svg_skip_space(value ? value : "");
  if (!cs_svg_take_number(&value, &offset))
    return 0;
  if (*value == '%') {
    offset /= 100;
    value++;
  }
  return *cs_svg_skip_space(value) ? 0 : cs_number_clamp(offset, 0, 1);
}

/* Appends the stops of a gradient's element, with more stops where they are needed. opacity
 * multiplies alpha. */
static celspan_status read_stops(cs_svg_reading *reading, const cs_svg_node *owner, double opacity,
                                 gradient_stops *out) {
  cs_svg_style above, style;
  coloured_stop last = {0};
  CS_TRY(cs_svg_style_in_file(reading, owner, &above));
  for (const cs_svg_node *node = owner->first; node; node = node->next) {
    if (node->element != CS_SVG_ELEMENT_STOP)
      continue;
    CS_TRY(cs_svg_style_resolve(reading->context, reading->document, node, &above, &reading->tests,
                                &style));
    const coloured_stop next = {fmax(last.at, offset_of(node)), style.stop_colour};
    CS_TRY(out->count > 0 ? append_stretch(reading, &last, &next, opacity, out)
                          : append(reading, next.at, &next.colour, opacity, out));
    last = next;
  }
  return CELSPAN_OK;
}

static void finish_stops(gradient_stops *stops, cs_memory *memory) {
  cs_mem_free(memory, stops->items, stops->capacity * sizeof *stops->items);
  *stops = (gradient_stops){0};
}

/* Extends the stops to a whole period: the first colour from 0 on, and the last one up to 1. */
static celspan_status hold_ends(cs_svg_reading *reading, gradient_stops *stops) {
  const celspan_stop first = {0, stops->items[0].paint};
  const celspan_stop last = {1, stops->items[stops->count - 1].paint};
  const size_t before = stops->items[0].at > 0, after = stops->items[stops->count - 1].at < 1;
  CS_TRY(CS_RESERVE(reading->context, stops->items, stops->capacity, stops->count + 2));
  memmove(stops->items + before, stops->items, stops->count * sizeof *stops->items);
  if (before)
    stops->items[0] = first;
  stops->count += before;
  if (after)
    stops->items[stops->count] = last;
  stops->count += after;
  return CELSPAN_OK;
}

/* Replaces the stops of one period by the stops of the periods [first, last), last > first. Places
 * then go from 0 at the start of the first period to 1 at the end of the last one. */
static celspan_status spread_stops(cs_svg_reading *reading, spread_kind spread, int first, int last,
                                   gradient_stops *stops) {
  gradient_stops whole = {0};
  whole.capacity = stops->count * (size_t)(last - first);
  CS_TRY(CS_MAKE(reading->context, whole.items, whole.capacity));
  for (int period = first; period < last; period++) {
    bool is_turned = spread == SPREAD_REFLECT && (period & 1) != 0;
    for (size_t i = 0; i < stops->count; i++) {
      const celspan_stop *stop = &stops->items[is_turned ? stops->count - 1 - i : i];
      double at = is_turned ? 1 - stop->at : stop->at;
      whole.items[whole.count++] = (celspan_stop){
          cs_number_clamp((period - first + at) / (last - first), 0, 1), stop->paint};
    }
  }
  finish_stops(stops, reading->context->memory);
  *stops = whole;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- elements */

/* The first of the element and its templates that has the attribute; NULL: none. Geometry is
 * inherited only from gradients of the same kind. */
static const cs_svg_node *owner_of(const gradient *g, cs_svg_name name, bool is_geometry) {
  const cs_svg_node *node = g->node;
  for (int i = 0; i < TEMPLATES && node && cs_svg_is_gradient(node); i++) {
    bool fits = !is_geometry || node->element == g->node->element;
    if (fits && cs_svg_node_value(node, name))
      return node;
    node = cs_svg_linked(g->reading, node);
  }
  return NULL;
}

static const cs_svg_node *owner_of_stops(const gradient *g) {
  const cs_svg_node *node = g->node;
  for (int i = 0; i < TEMPLATES && node && cs_svg_is_gradient(node); i++) {
    for (const cs_svg_node *child = node->first; child; child = child->next)
      if (child->element == CS_SVG_ELEMENT_STOP)
        return node;
    node = cs_svg_linked(g->reading, node);
  }
  return NULL;
}

static const char *text_of(const gradient *g, cs_svg_name name) {
  const cs_svg_node *owner = owner_of(g, name, false);
  return owner ? cs_svg_node_value(owner, name) : "";
}

/* per_cent: the default value of the attribute. */
static celspan_status read_length(const gradient *g, cs_svg_name name, cs_svg_axis axis,
                                  double per_cent, double *out) {
  const cs_svg_node *owner = owner_of(g, name, true);
  return cs_svg_length_of(g->reading->context, owner ? owner : g->node, name, axis, &g->measure,
                          (cs_svg_length){per_cent, CS_SVG_UNIT_PERCENT}, out);
}

static celspan_status read_linear(gradient *g) {
  CS_TRY(read_length(g, CS_SVG_X1, CS_SVG_AXIS_X, 0, &g->from.x));
  CS_TRY(read_length(g, CS_SVG_Y1, CS_SVG_AXIS_Y, 0, &g->from.y));
  CS_TRY(read_length(g, CS_SVG_X2, CS_SVG_AXIS_X, 100, &g->to.x));
  return read_length(g, CS_SVG_Y2, CS_SVG_AXIS_Y, 0, &g->to.y);
}

/* Moves the focus into the circle: at the edge, the gradient would have no end. */
static void hold_focus(gradient *g) {
  double dx = g->from.x - g->to.x, dy = g->from.y - g->to.y;
  double distance = cs_number_length(dx, dy), most = FOCUS_SHARE * g->outer;
  if (distance > most && most >= 0)
    g->from = (celspan_point){g->to.x + dx / distance * most, g->to.y + dy / distance * most};
}

static celspan_status read_radial(gradient *g) {
  CS_TRY(read_length(g, CS_SVG_CX, CS_SVG_AXIS_X, 50, &g->to.x));
  CS_TRY(read_length(g, CS_SVG_CY, CS_SVG_AXIS_Y, 50, &g->to.y));
  CS_TRY(read_length(g, CS_SVG_R, CS_SVG_AXIS_BOTH, 50, &g->outer));
  CS_TRY(read_length(g, CS_SVG_FR, CS_SVG_AXIS_BOTH, 0, &g->inner));
  g->from = g->to;
  if (owner_of(g, CS_SVG_FX, true))
    CS_TRY(read_length(g, CS_SVG_FX, CS_SVG_AXIS_X, 50, &g->from.x));
  if (owner_of(g, CS_SVG_FY, true))
    CS_TRY(read_length(g, CS_SVG_FY, CS_SVG_AXIS_Y, 50, &g->from.y));
  hold_focus(g);
  if (g->inner != 0 && (g->from.x != g->to.x || g->from.y != g->to.y)) {
    g->inner = 0;
    return cs_svg_skip(g->reading, g->node, "radius of the focus of radialGradient");
  }
  return CELSPAN_OK;
}

/* Reads the matrix from the gradient's units to the shape's. */
static void read_matrix(gradient *g) {
  celspan_matrix own;
  g->matrix = celspan_matrix_identity();
  if (cs_svg_parse_transform(text_of(g, CS_SVG_GRADIENT_TRANSFORM), &g->measure, &own))
    g->matrix = own;
  const char *origin = text_of(g, CS_SVG_TRANSFORM_ORIGIN);
  if (*origin)
    g->matrix = cs_svg_about_origin(g->matrix, origin, &g->measure);
  if (g->is_in_box)
    g->matrix = celspan_matrix_then(g->matrix, cs_svg_box_matrix(&g->shape->box));
}

/* ---------------------------------------------------------------- spreading */

/* The place of a point along a linear gradient or between the circles of a radial one: the greatest
 * place whose circle goes through the point. */
static double place_of(const gradient *g, double x, double y) {
  double dx = g->to.x - g->from.x, dy = g->to.y - g->from.y;
  double px = x - g->from.x, py = y - g->from.y, along = px * dx + py * dy;
  if (!g->is_radial)
    return along / (dx * dx + dy * dy);
  double step = g->outer - g->inner, rest = step * step - dx * dx - dy * dy;
  double half = along + g->inner * step;
  return (sqrt(half * half + rest * (px * px + py * py - g->inner * g->inner)) - half) / rest;
}

/* The least and the greatest place, in periods, at points of the shape. */
static bool find_places(const gradient *g, double *least, double *most) {
  celspan_matrix inverse;
  const celspan_box *box = &g->shape->painted;
  if (!celspan_matrix_inverse(g->matrix, &inverse))
    return false;
  *least = g->is_radial ? -g->inner / (g->outer - g->inner) : HUGE_VAL;
  *most = -HUGE_VAL;
  for (int i = 0; i < 4; i++) {
    double x = box->x + (i & 1) * box->width, y = box->y + (i >> 1) * box->height;
    double at = place_of(g, inverse.m[0] * x + inverse.m[1] * y + inverse.m[2],
                         inverse.m[3] * x + inverse.m[4] * y + inverse.m[5]);
    *least = fmin(*least, at);
    *most = fmax(*most, at);
  }
  return cs_number_is_sane(*least) && cs_number_is_sane(*most);
}

static celspan_status spread(gradient *g) {
  double least, most;
  if (g->spread == SPREAD_PAD || g->stops.count < 2 || !find_places(g, &least, &most))
    return CELSPAN_OK;
  if (g->spread == SPREAD_REPEAT)
    CS_TRY(hold_ends(g->reading, &g->stops));
  double first = floor(fmin(least, 0)), last = ceil(fmax(most, 1));
  if ((last - first) * (double)g->stops.count > CS_SVG_STOPS)
    return cs_svg_skip(g->reading, g->node, "spreadMethod, repeated too often");
  CS_TRY(spread_stops(g->reading, g->spread, (int)first, (int)last, &g->stops));
  const celspan_point from = g->from, to = g->to;
  const double inner = g->inner, step = g->outer - g->inner;
  g->inner = inner + first * step;
  g->outer = inner + last * step;
  g->from = (celspan_point){from.x + first * (to.x - from.x), from.y + first * (to.y - from.y)};
  g->to = (celspan_point){from.x + last * (to.x - from.x), from.y + last * (to.y - from.y)};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- textures */

static celspan_paint converted(celspan_space to, celspan_paint paint) {
  for (int c = 0; c < 3; c++)
    paint.pigment[c] = cs_space_channel(to, paint.pigment[c], 1);
  return paint;
}

/* Mixes two stops in the same way as the gradient will. */
static celspan_paint mix_stops(const cs_svg_reading *reading, const celspan_stop *a,
                               const celspan_stop *b, double u) {
  if (reading->is_coded || reading->space != CELSPAN_SPACE_SRGB)
    return celspan_paint_mix(a->paint, b->paint, (float)u);
  return converted(CELSPAN_SPACE_LINEAR,
                   celspan_paint_mix(converted(CELSPAN_SPACE_SRGB, a->paint),
                                     converted(CELSPAN_SPACE_SRGB, b->paint), (float)u));
}

/* Counts places from the centre instead of from the inner radius; stops before the centre are cut
 * off. */
static void begin_at_centre(gradient *g) {
  size_t kept = 0;
  for (size_t i = 0; i < g->stops.count; i++) {
    celspan_stop stop = g->stops.items[i];
    stop.at = (g->inner + stop.at * (g->outer - g->inner)) / g->outer;
    if (stop.at < 0 && i + 1 < g->stops.count) {
      const celspan_stop *next = &g->stops.items[i + 1];
      double at = (g->inner + next->at * (g->outer - g->inner)) / g->outer;
      if (at <= 0)
        continue;
      stop.paint = mix_stops(g->reading, &stop, next, -stop.at / (at - stop.at));
    }
    stop.at = cs_number_clamp(stop.at, 0, 1);
    g->stops.items[kept++] = stop;
  }
  g->stops.count = kept;
}

static celspan_status make_flat(gradient *g, cs_svg_server *out) {
  CS_TRY(celspan_texture_create_paint(g->reading->context,
                                      &g->stops.items[g->stops.count - 1].paint, &out->texture));
  out->kind = CS_SVG_SERVER_FLAT;
  return CELSPAN_OK;
}

static celspan_status make_texture(gradient *g, cs_svg_server *out) {
  celspan_matrix inverse;
  bool is_degenerate = g->is_radial ? g->outer == 0 : g->from.x == g->to.x && g->from.y == g->to.y;
  if (g->stops.count == 1 || is_degenerate)
    return make_flat(g, out);
  if (!celspan_matrix_inverse(g->matrix, &inverse) ||
      (g->is_radial && !(g->outer > g->inner && g->inner >= 0)))
    return CELSPAN_OK;
  CS_TRY(spread(g));
  if (g->is_radial && g->inner != 0)
    begin_at_centre(g);
  out->matrix = g->matrix;
  CS_TRY(g->is_radial
             ? celspan_texture_create_focal(g->reading->context, g->to, g->outer, g->from,
                                            g->stops.items, g->stops.count, &out->texture)
             : celspan_texture_create_linear(g->reading->context, g->from, g->to, g->stops.items,
                                             g->stops.count, &out->texture));
  out->kind = CS_SVG_SERVER_TEXTURE;
  return CELSPAN_OK;
}

static celspan_status make(gradient *g, cs_svg_server *out) {
  const cs_svg_node *owner = owner_of_stops(g);
  const char *spread_word = text_of(g, CS_SVG_SPREAD_METHOD);
  if (!owner)
    return CELSPAN_OK;
  CS_TRY(read_stops(g->reading, owner, g->shape->opacity, &g->stops));
  CS_TRY(g->is_radial ? read_radial(g) : read_linear(g));
  read_matrix(g);
  g->spread = cs_svg_is_word(spread_word, "reflect")  ? SPREAD_REFLECT
              : cs_svg_is_word(spread_word, "repeat") ? SPREAD_REPEAT
                                                      : SPREAD_PAD;
  return make_texture(g, out);
}

celspan_status cs_svg_gradient_make(cs_svg_reading *reading, const cs_svg_node *node,
                                    const cs_svg_painted *shape, bool *is_missing,
                                    cs_svg_server *out) {
  gradient g = {.reading = reading, .node = node, .shape = shape};
  *out = (cs_svg_server){.matrix = celspan_matrix_identity()};
  g.is_radial = node->element == CS_SVG_ELEMENT_RADIAL_GRADIENT;
  g.is_in_box = !cs_svg_is_word(text_of(&g, CS_SVG_GRADIENT_UNITS), "userSpaceOnUse");
  g.measure = *shape->measure;
  if (g.is_in_box)
    g.measure.width = g.measure.height = 1;
  *is_missing = g.is_in_box && !(shape->box.width > 0 && shape->box.height > 0);
  if (*is_missing)
    return CELSPAN_OK;
  celspan_status status = make(&g, out);
  finish_stops(&g.stops, reading->context->memory);
  return status;
}
