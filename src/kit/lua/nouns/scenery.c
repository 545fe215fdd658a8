/* The structure of a frame, for writers of vectors: its cels and their objects as tables.
 *
 *   scene   back = { r, g, b, a }, without one nil; why; and its cels as a list
 *   cel     name, line, matrix, fade, front = { r, g, b }, why, and its objects as a list
 *   placed  name, line, matrix, fade, why, data; a matrix is a, b, c, d, e, f as in celspan.affine
 *   data    kind "group" and what it holds as a list of placed objects; kind "outline", with rule,
 *           contours and a fill; kind "image", with contours and an object that shows it; or kind
 *           "other", with why
 *   fill    kind "flat", "linear" or "radial"; stops { at, r, g, b, alpha }; points; radius
 *
 * Equal data are one table in all frames, so that a table is known again by its identity:
 * `shared` keeps them under their hashes. `why` says what vectors of other programs cannot
 * express; it is nil where they can. Colours are pigments, before light falls on them.
 */
#include <math.h>

#include "inside/geometry.h"
#include "inside/scene.h"
#include "lua/bind/bare.h"
#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/nouns/nouns.h"

/* How far cubics may lie from curves, as a share of the diagonal of an outline: a fiftieth of a
 * pixel on a large screen. */
#define WITHIN 1e-5
/* Lua stack slots of one level of objects. */
#define SLOTS 16
/* How far the axes of a matrix may be from a turned square, as a share of their length. */
#define ROUND 1e-6

/* What is asked, and the index of the table `shared`. */
typedef struct asked {
  lua_State *L;
  double width, height; /* the width and height of the film */
  celspan_space space;
  int shared;
} asked;

/* ---------------------------------------------------------------- fills */

/* Whether light that the paint lets through keeps its colour. */
static bool is_neutral(const cs_paint *paint) {
  for (int c = 0; c < 3; c++)
    if (fabsf(paint->t[c] - (1 - paint->beta)) > 1e-5F)
      return false;
  return true;
}

static void add_stop(lua_State *L, lua_Integer i, double at, const cs_paint *paint) {
  const double beta = paint->beta, part = beta > 0 ? beta : 1;
  const double stop[] = {at, paint->s[0] / part, paint->s[1] / part, paint->s[2] / part, beta};
  cs_push_numbers(L, stop, 5);
  lua_rawseti(L, -2, i);
}

static celspan_point moved(const celspan_matrix *matrix, celspan_point point) {
  return cs_hpoint_place(cs_matrix_apply(matrix, cs_hpoint_of(point)));
}

/* Whether the matrix keeps circles round. */
static bool is_round(const double *m) {
  const double across = sqrt(m[0] * m[0] + m[3] * m[3]), down = sqrt(m[1] * m[1] + m[4] * m[4]);
  return fabs(across - down) <= ROUND * across &&
         fabs(m[0] * m[1] + m[3] * m[4]) <= ROUND * across * across;
}

static const char *refuse_gradient(const cs_texture_variation *v) {
  for (size_t i = 0; i < v->stop_count; i++)
    if (!is_neutral(&v->stops[i].paint))
      return "a gel";
  return v->has_matrix && !cs_matrix_is_affine(&v->matrix) ? "a gradient in perspective" : NULL;
}

static const char *refuse_fill(const celspan_texture *texture) {
  const cs_texture_variation *v = texture->variation;
  switch (texture->kind) {
  case CS_TEXTURE_FLAT:
    return is_neutral(&texture->flat) ? NULL : "a gel";
  case CS_TEXTURE_RADIAL:
    if (v->has_matrix && !is_round(v->matrix.m))
      return "a radial gradient that is not round";
    return refuse_gradient(v);
  case CS_TEXTURE_LINEAR:
    return refuse_gradient(v);
  case CS_TEXTURE_TRIANGLE:
    return "a gradient between three corners";
  case CS_TEXTURE_CONIC:
    return "a conic gradient";
  case CS_TEXTURE_NOISE:
    return "noise";
  case CS_TEXTURE_PICTURE:
    return v->use != CELSPAN_PICTURE_PAINT || v->medium ? "a gel" : NULL;
  case CS_TEXTURE_PATTERN:
    break;
  }
  return "a pattern";
}

/* The line along which a linear gradient changes, after a matrix: the direction across it is a
 * direction of one colour. */
static celspan_point steepest(const celspan_matrix *matrix, celspan_point from, celspan_point to) {
  const celspan_point a = moved(matrix, from), b = moved(matrix, to);
  const celspan_point side = {from.x - (to.y - from.y), from.y + (to.x - from.x)};
  const celspan_point c = moved(matrix, side);
  const double ux = c.x - a.x, uy = c.y - a.y, square = ux * ux + uy * uy;
  const double along = square > 0 ? ((b.x - a.x) * ux + (b.y - a.y) * uy) / square : 0;
  return (celspan_point){b.x - along * ux, b.y - along * uy};
}

/* The second point of a gradient: the end of a linear one, or the focus of a radial one, of which
 * the texture has the offset from the centre. */
static celspan_point second_of(const celspan_texture *texture, const celspan_matrix *matrix) {
  const celspan_point *points = texture->variation->points;
  if (texture->kind == CS_TEXTURE_LINEAR)
    return steepest(matrix, points[0], points[1]);
  return moved(matrix, (celspan_point){points[0].x + points[1].x, points[0].y + points[1].y});
}

static void put_fill(lua_State *L, const celspan_texture *texture) {
  const cs_texture_variation *v = texture->variation;
  const bool is_flat = texture->kind == CS_TEXTURE_FLAT;
  const bool is_linear = texture->kind == CS_TEXTURE_LINEAR;
  lua_createtable(L, 0, 4);
  cs_put_text(L, "kind", is_flat ? "flat" : is_linear ? "linear" : "radial");
  lua_createtable(L, is_flat ? 1 : (int)v->stop_count, 0);
  if (is_flat)
    add_stop(L, 1, 0, &texture->flat);
  for (size_t i = 0; !is_flat && i < v->stop_count; i++)
    add_stop(L, (lua_Integer)i + 1, v->stops[i].at, &v->stops[i].paint);
  lua_setfield(L, -2, "stops");
  if (!is_flat) {
    const celspan_matrix matrix = v->has_matrix ? v->matrix : celspan_matrix_identity();
    const celspan_point a = moved(&matrix, v->points[0]);
    const celspan_point b = second_of(texture, &matrix);
    cs_put_numbers(L, "points", (const double[]){a.x, a.y, b.x, b.y}, 4);
    cs_put_number(L, "radius",
                  v->radius * sqrt(matrix.m[0] * matrix.m[0] + matrix.m[3] * matrix.m[3]));
  }
  lua_setfield(L, -2, "fill");
}

/* ---------------------------------------------------------------- objects */

static const char *refuse_boolean(const asked *of, const cs_boolean *boolean) {
  if (boolean->blend != CELSPAN_BLEND_NORMAL)
    return "a blend mode";
  if (boolean->grade)
    return "a grade";
  if (cs_boolean_develops(boolean, of->space))
    return "another working space";
  if (boolean->op == CELSPAN_OPERATOR_UNION)
    return NULL;
  return boolean->is_filled ? "a pattern"
         : boolean->op == CS_OPERATOR_MATTE || boolean->op == CELSPAN_OPERATOR_CLIP
             ? "a clip or a matte"
             : "a shape that others cut";
}

/* NULL: layers with keys can show the data. */
static const char *refuse_data(const asked *of, const cs_primitive_data *data) {
  switch (data->kind) {
  case CS_PRIMITIVE_DATA_OUTLINE:
    return refuse_fill(data->texture);
  case CS_PRIMITIVE_DATA_BOOLEAN:
    return refuse_boolean(of, data->boolean);
  case CS_PRIMITIVE_DATA_SCANLINE:
    return "a scan-line procedure";
  case CS_PRIMITIVE_DATA_ROSTRUM:
    break;
  }
  return "an effect, or a composition";
}

static void push_placed(const asked *of, const celspan_object *object);

/* Puts the contours of the data into the table on top; false: they have too many curves. */
static bool has_contours(lua_State *L, const cs_primitive_data *data) {
  const celspan_status status = cs_anatomy_put_filled(L, data, WITHIN);
  if (status != CELSPAN_LIMIT)
    cs_host_try(L, "render", status);
  return status == CELSPAN_OK;
}

/* Puts an object of the data, where they are. */
static void put_image(lua_State *L, const cs_primitive_data *data) {
  celspan_object *object = NULL;
  cs_userdata *made = cs_bare_push(L, &cs_noun_image);
  cs_host_try(L, "render",
              cs_primitive_data_object(cs_host_context(L), (cs_primitive_data *)data, &object));
  made->handle = object;
  lua_setfield(L, -2, "object");
}

static void put_data(const asked *of, const cs_primitive_data *data) {
  lua_State *L = of->L;
  const bool is_outline = data->kind == CS_PRIMITIVE_DATA_OUTLINE;
  const bool is_image = is_outline && data->texture->kind == CS_TEXTURE_PICTURE;
  const char *why = refuse_data(of, data);
  if (!why && is_outline && !has_contours(L, data))
    why = "an outline of too many curves";
  cs_put_text(L, "why", why);
  cs_put_text(L, "kind", why ? "other" : is_image ? "image" : is_outline ? "outline" : "group");
  if (why)
    return;
  if (is_image)
    put_image(L, data);
  else if (is_outline)
    put_fill(L, data->texture);
  if (is_outline)
    return;
  for (size_t i = 0; i < data->boolean->operand_count; i++) {
    push_placed(of, data->boolean->operands[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

/* Pushes the table of the data, which is made where it is new. */
static void push_data(const asked *of, const cs_primitive_data *data) {
  lua_State *L = of->L;
  lua_pushlstring(L, (const char *)&data->hash, sizeof data->hash);
  lua_pushvalue(L, -1);
  if (lua_rawget(L, of->shared) == LUA_TTABLE) {
    lua_remove(L, -2);
    return;
  }
  lua_pop(L, 1);
  lua_createtable(L, 0, 6);
  put_data(of, data);
  lua_pushvalue(L, -1);
  lua_insert(L, -3); /* data, hash, data */
  lua_rawset(L, of->shared);
}

static void put_mark(lua_State *L, cs_mark mark) {
  const char *name = cs_mark_name(mark);
  cs_put_text(L, "name", name[0] ? name : NULL);
  cs_put_integer(L, "line", cs_mark_origin(mark).line);
}

/* The matrix of an affine map, without its last row. */
static void put_matrix(lua_State *L, const celspan_matrix *matrix) {
  double numbers[6];
  for (int i = 0; i < 6; i++)
    numbers[i] = matrix->m[i] / matrix->m[8];
  cs_put_numbers(L, "matrix", numbers, 6);
}

/* Recursion ends: nesting is at most CS_SCENE_DEPTH. */
static void push_placed(const asked *of, const celspan_object *object) {
  lua_State *L = of->L;
  luaL_checkstack(L, SLOTS, "scenery");
  lua_createtable(L, 0, 5);
  put_mark(L, object->mark);
  cs_put_number(L, "fade", object->fade);
  put_matrix(L, object->matrix);
  if (!cs_matrix_is_affine(object->matrix))
    cs_put_text(L, "why", "a perspective");
  push_data(of, object->data);
  lua_setfield(L, -2, "data");
}

/* ---------------------------------------------------------------- cels */

static bool is_dark(const cs_light *light) {
  return !light->texture && light->flat.r == 0 && light->flat.g == 0 && light->flat.b == 0;
}

static const char *refuse_cel(const celspan_rostrum *rostrum, const celspan_cel *cel,
                              const celspan_matrix *matrix) {
  const cs_light front = cs_scene_front(rostrum, cel);
  return !cs_matrix_is_affine(matrix)         ? "a perspective"
         : cel->blend != CELSPAN_BLEND_NORMAL ? "a blend mode"
         : cel->grade                         ? "a grade"
         : cel->shift || cel->nearby          ? "a filter"
         : cel->defocus_radius > 0            ? "a blur"
         : front.texture                      ? "a light with a shape"
         : !is_dark(&cel->back)               ? "light from behind"
                                              : NULL;
}

static void push_cel(const asked *of, const celspan_rostrum *rostrum, size_t index) {
  lua_State *L = of->L;
  const celspan_cel *cel = rostrum->cels[index];
  celspan_matrix matrix;
  cs_host_try(
      L, "render",
      cs_scene_cel_matrix(cs_host_context(L), rostrum, index, of->width, of->height, &matrix));
  const cs_light light = cs_scene_front(rostrum, cel);
  const celspan_light front = cs_light_in(&light, of->space);
  lua_createtable(L, (int)cel->object_count, 7);
  put_mark(L, cel->mark);
  cs_put_number(L, "fade", cel->opacity);
  cs_put_text(L, "why", refuse_cel(rostrum, cel, &matrix));
  put_matrix(L, &matrix);
  cs_put_numbers(L, "front", (const double[]){front.r, front.g, front.b}, 3);
  for (size_t i = 0; i < cel->object_count; i++) {
    push_placed(of, cel->objects[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

static void put_back(const asked *of, const celspan_rostrum *rostrum) {
  const cs_light light = cs_scene_back(rostrum, &rostrum->back);
  const celspan_light back = cs_light_in(&light, of->space);
  const double numbers[] = {back.r, back.g, back.b, back.a};
  if (light.texture)
    cs_put_text(of->L, "why", "a light with a shape");
  else if (back.r > 0 || back.g > 0 || back.b > 0 || back.a > 0)
    cs_put_numbers(of->L, "back", numbers, 4);
}

/* (rostrum, width, height, space, shared) -> the scene. space: "linear" or "srgb", of the film. */
int cs_scenery_of(lua_State *L) {
  static const char *const spaces[] = {"linear", "srgb", NULL};
  const cs_userdata *value = cs_userdata_test(L, 1, &cs_kind_rostrum);
  luaL_argcheck(L, value, 1, "a rostrum is needed");
  luaL_checktype(L, 5, LUA_TTABLE);
  const celspan_rostrum *rostrum = value->handle;
  const celspan_space space =
      (celspan_space)(CELSPAN_SPACE_LINEAR + luaL_checkoption(L, 4, NULL, spaces));
  const asked of = {L, luaL_checknumber(L, 2), luaL_checknumber(L, 3), space, 5};
  lua_createtable(L, (int)rostrum->cel_count, 2);
  cs_put_text(L, "why", rostrum->grade ? "a grade" : rostrum->grain ? "grain" : NULL);
  put_back(&of, rostrum);
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    push_cel(&of, rostrum, i);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  return 1;
}

/* (rostrum) -> 16 bytes, equal for rostrums that show the same; nil if a procedure draws. */
int cs_scenery_key(lua_State *L) {
  const cs_userdata *value = cs_userdata_test(L, 1, &cs_kind_rostrum);
  luaL_argcheck(L, value, 1, "a rostrum is needed");
  const celspan_exposure exposure = {value->handle, 1};
  if (cs_scene_has_procedure(&exposure, 1))
    return 0;
  const cs_hash hash = cs_scene_hash(&exposure, 1);
  lua_pushlstring(L, (const char *)&hash, sizeof hash);
  return 1;
}

/* (rostrum, count) -> the rostrum with that many of its cels, the rearmost. */
int cs_scenery_rear(lua_State *L) {
  const cs_userdata *value = cs_userdata_test(L, 1, &cs_kind_rostrum);
  luaL_argcheck(L, value, 1, "a rostrum is needed");
  const celspan_rostrum *whole = value->handle;
  const lua_Integer count = luaL_checkinteger(L, 2);
  luaL_argcheck(L, count >= 0 && (size_t)count <= whole->cel_count, 2,
                "must be at most the number of cels");
  celspan_rostrum *rear = NULL;
  cs_userdata *made = cs_bare_push(L, &cs_noun_rostrum);
  cs_host_try(L, "render",
              cs_rostrum_with(cs_host_context(L), whole, whole->cels, (size_t)count, &rear));
  cs_rostrum_rehash(rear);
  made->handle = rear;
  return 1;
}
