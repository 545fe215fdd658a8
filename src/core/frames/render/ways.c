#include "frames/render/ways.h"

#include <math.h>

#include "frames/render/parts.h"
#include "model/geometry/boundary.h"
#include "model/geometry/matrix.h"
#include "model/scene/texture.h"

/* ---------------------------------------------------------------- what suits */

static bool has_procedure(const celspan_cel *cel) {
  bool has = false;
  for (size_t i = 0; i < cel->object_count; i++)
    has |= cel->objects[i]->data->has_procedure;
  return has;
}

bool cs_ways_is_uneven(const celspan_cel *cel) {
  bool is_uneven = false;
  for (size_t i = 0; i < cel->object_count; i++)
    is_uneven |= cel->objects[i]->data->has_uneven;
  return is_uneven;
}

/* How many pieces a cel adds to a sweep: a defocused cel adds only its box. */
static size_t count_pieces(const celspan_cel *cel) {
  return cel->defocus_radius > 0 ? CS_SHAPE_PIECES
                                 : cs_parts_pieces(cel->objects, cel->object_count);
}

static bool is_mapped(const cs_ways *ways, size_t cel) {
  return ways->suits[cel] &&
         (ways->is_artwork[cel] || ways->is_small[cel] || ways->forced == CS_WAYS_MAPPED);
}

/* Whether a colour and an alpha for each place are not enough to put a cel over the cels behind it.
 * Nothing else is known about a swept cel. */
static bool needs_backdrop(const celspan_cel *cel, bool has_map, celspan_space space) {
  return cs_cel_blends(cel, space) || (cs_ways_is_uneven(cel) && !has_map) || cel->back.texture;
}

/* At least `count` cels at the rear are swept with the light behind them. */
static void sweep_rear(cs_ways *ways, size_t count) {
  ways->rear = count > ways->rear ? count : ways->rear;
  for (size_t i = 0; i < ways->rear; i++)
    ways->suits[i] = false;
}

void cs_ways_sweep(const celspan_rostrum *rostrum, cs_ways *ways, size_t cel) {
  ways->suits[cel] = false;
  if (cs_ways_is_uneven(rostrum->cels[cel]))
    sweep_rear(ways, cel + 1);
}

static bool is_white(celspan_light light) { return light.r == 1 && light.g == 1 && light.b == 1; }

/* Modes act on lit colours, so the map of a cel contains the modes inside it only under white
 * light. */
static bool may_have_map(const celspan_rostrum *rostrum, const celspan_cel *cel,
                         celspan_space space) {
  const cs_light front = cs_scene_front(rostrum, cel);
  return cel->defocus_radius == 0 && !front.texture &&
         (!cel->has_modes || is_white(cs_light_in(&front, space)));
}

bool cs_ways_exist(const celspan_rostrum *rostrum, const cs_view *view,
                   const cs_antialias *antialias) {
  bool suits = antialias->mode == CELSPAN_ANTIALIAS_AREA && !rostrum->grade &&
               cs_space_inside(rostrum->space, view->space) == view->space &&
               view->width <= CS_WAYS_SIDE && view->height <= CS_WAYS_SIDE &&
               rostrum->cel_count <= CS_MAP_DRAWINGS;
  size_t most = 0;
  for (size_t i = 0; suits && i < rostrum->cel_count; i++) {
    size_t pieces = count_pieces(rostrum->cels[i]);
    most = pieces > most ? pieces : most;
    suits = !has_procedure(rostrum->cels[i]);
  }
  return suits && most >= CS_WAYS_PIECES;
}

void cs_ways_find(const celspan_rostrum *rostrum, const cs_view *view, cs_ways *ways) {
  ways->rear = rostrum->back.texture ? 1 : 0;
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    ways->suits[i] = may_have_map(rostrum, rostrum->cels[i], view->space);
    if (needs_backdrop(rostrum->cels[i], is_mapped(ways, i), view->space))
      ways->rear = i + 1;
  }
  sweep_rear(ways, ways->rear);
}

/* ---------------------------------------------------------------- what pays */

void cs_ways_judge(cs_ways *ways, size_t cel, size_t pieces, const cs_census *census,
                   bool occurs_again) {
  bool is_rich = pieces >= CS_WAYS_PIECES && census->shapes >= CS_WAYS_SHAPES;
  bool is_flat = census->varied <= census->flat;
  double most = CS_WAYS_ROWS * (occurs_again ? 1.5 : 1);
  ways->is_small[cel] = !is_rich && is_flat;
  ways->is_artwork[cel] = is_rich && is_flat && 2 * census->hiding >= census->shapes &&
                          4 * census->inside >= census->shapes &&
                          census->heights <= most * (double)census->inside;
}

bool cs_ways_choose(const celspan_rostrum *rostrum, cs_ways *ways) {
  size_t artwork = 0, others = 0, maps = 0;
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    bool is_artwork = ways->suits[i] && ways->is_artwork[i];
    *(is_artwork ? &artwork : &others) += count_pieces(rostrum->cels[i]);
    ways->mapped[i] = is_mapped(ways, i);
    maps += ways->mapped[i];
  }
  return maps > 0 && (ways->forced == CS_WAYS_MAPPED || (artwork > 0 && artwork >= others));
}

/* ---------------------------------------------------------------- sheets */

static bool has_light_behind(const celspan_cel *cel) {
  const celspan_light *light = &cel->back.flat;
  return cel->back.texture || light->r != 0 || light->g != 0 || light->b != 0 || light->a != 0;
}

size_t cs_ways_end(const celspan_rostrum *rostrum, const cs_ways *ways, size_t first) {
  size_t end = first + 1;
  while (!ways->mapped[first] && end < rostrum->cel_count && !ways->mapped[end] &&
         (end < ways->rear || !has_light_behind(rostrum->cels[end])))
    end++;
  return end;
}

/* ---------------------------------------------------------------- counting */

typedef struct counting {
  cs_census census;
  double width, height; /* the width and height of the frame */
} counting;

/* How much of [low, high] lies in [0, end]. */
static double length_inside(double low, double high, double end) {
  return fmax(fmin(high, end) - fmax(low, 0), 0);
}

static bool varies(const cs_primitive_data *data) {
  return !data->texture || data->texture->kind != CS_TEXTURE_FLAT;
}

/* may_hide: nothing around the shape fades it or cuts it away. */
static void count_shape(counting *c, const cs_primitive_data *data, const celspan_matrix *matrix,
                        bool may_hide) {
  const celspan_matrix facing = cs_matrix_facing(matrix);
  cs_boundary_frame box;
  (void)cs_boundary_around_box(&data->bounds, &facing, &box);
  double across = length_inside(box.left, box.right, c->width);
  double down = length_inside(box.top, box.bottom, c->height);
  c->census.shapes++;
  if (!data->is_box && data->outline) {
    c->census.pieces += data->outline->piece_count;
    c->census.points += data->outline->point_count;
  }
  c->census.may_have_dashes |=
      data->stroke ? data->stroke->dashes.place_count > 0 : data->kind != CS_PRIMITIVE_DATA_OUTLINE;
  c->census.hiding += may_hide && data->mixing == CS_MIXING_OPAQUE;
  if (!(across > 0 && down > 0))
    return;
  c->census.inside++;
  c->census.heights += down;
  *(varies(data) ? &c->census.varied : &c->census.flat) += across * down;
}

static void count_object(counting *c, const celspan_object *object, const celspan_matrix *around,
                         bool may_hide) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix matrix = celspan_matrix_then(*object->matrix, *around);
  may_hide = may_hide && object->fade == 1;
  c->census.may_have_dashes |= c->census.shapes >= CS_CENSUS_MOST;
  if (data->is_empty || c->census.shapes >= CS_CENSUS_MOST)
    return;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN) {
    count_shape(c, data, &matrix, may_hide);
    return;
  }
  const cs_boolean *boolean = data->boolean;
  bool cuts = boolean->op == CELSPAN_OPERATOR_DIFFERENCE;
  for (size_t i = 0; i < boolean->operand_count; i++)
    count_object(c, boolean->operands[i], &matrix, may_hide && !(cuts && i > 0));
}

cs_census cs_census_take(celspan_object *const *objects, size_t count, const celspan_matrix *matrix,
                         int32_t width, int32_t height) {
  counting c = {.width = width, .height = height};
  for (size_t i = 0; i < count; i++)
    count_object(&c, objects[i], matrix, true);
  return c.census;
}
