#include "lua/nouns/placed.h"

#include <math.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/geometry.h"
#include "inside/scene.h"
#include "lua/bind/anchor.h"
#include "lua/bind/caller.h"
#include "lua/bind/construct.h"
#include "lua/bind/fields.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/named.h"
#include "lua/bind/numbers.h"
#include "lua/bind/suggest.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/shape.h"

#define PI 3.14159265358979323846

/* ---------------------------------------------------------------- methods */

double cs_placed_radians(double degrees) { return fmod(degrees, 360) * (PI / 180); }

static cs_userdata *self(lua_State *L, const char *method) {
  cs_userdata *value = cs_shape_at(L, 1);
  return value ? value : cs_userdata_self(L, &cs_kind_cel, method);
}

static int push_transformed(lua_State *L, const char *method, const cs_userdata *value,
                            celspan_matrix matrix) {
  cs_userdata *copy = cs_userdata_push_like(L, 1, true);
  cs_placement placement = cs_userdata_placement(value);
  cs_host_try(
      L, method,
      value->noun->kind->transform(cs_host_context(L), value->handle, &matrix, &copy->handle));
  placement.matrix = celspan_matrix_then(placement.matrix, matrix);
  cs_userdata_place(copy, &placement);
  cs_anchor_move(copy, &matrix);
  return 1;
}

/* The value as it is, where a place is a word and the value has nothing to paint. */
static int push_self(lua_State *L) {
  lua_pushvalue(L, 1);
  return 1;
}

static int translate(lua_State *L) {
  const cs_userdata *value = self(L, "translate");
  double dx = cs_form_argument(L, 2, "translate", "dx"),
         dy = cs_form_argument(L, 3, "translate", "dy");
  return push_transformed(L, "translate", value, celspan_matrix_translation(dx, dy));
}

static int scale(lua_State *L) {
  const cs_userdata *value = self(L, "scale");
  double sx = cs_form_argument(L, 2, "scale", "sx");
  const bool is_even = lua_isnoneornil(L, 3) || cs_anchor_is_whole(L, 3);
  double sy = is_even ? sx : cs_form_argument(L, 3, "scale", "sy");
  celspan_point centre;
  if (!cs_anchor_read(L, cs_anchor_is_whole(L, 3) ? 3 : 4, "scale", value, &centre))
    return push_self(L);
  return push_transformed(L, "scale", value, celspan_matrix_scaling_about(sx, sy, centre));
}

static int rotate(lua_State *L) {
  const cs_userdata *value = self(L, "rotate");
  double degrees = cs_form_argument(L, 2, "rotate", "the angle in degrees");
  celspan_point centre;
  if (!cs_anchor_read(L, 3, "rotate", value, &centre))
    return push_self(L);
  return push_transformed(L, "rotate", value, cs_matrix_turn(degrees, centre));
}

static int skew(lua_State *L) {
  const cs_userdata *value = self(L, "skew");
  double x = cs_form_argument(L, 2, "skew", "the first angle in degrees");
  double y = cs_form_argument(L, 3, "skew", "the second angle in degrees");
  celspan_point centre;
  if (!cs_anchor_read(L, 4, "skew", value, &centre))
    return push_self(L);
  celspan_matrix matrix =
      celspan_matrix_skewing_about(cs_placed_radians(x), cs_placed_radians(y), centre);
  return push_transformed(L, "skew", value, matrix);
}

static int move_to(lua_State *L) {
  const cs_userdata *value = self(L, "move_to");
  double x = cs_form_argument(L, 2, "move_to", "x"), y = cs_form_argument(L, 3, "move_to", "y");
  lua_settop(L, 4);
  if (lua_isnil(L, 4)) {
    lua_pushliteral(L, "centre");
    lua_replace(L, 4);
  }
  celspan_point from;
  if (!cs_anchor_read(L, 4, "move_to", value, &from))
    return push_self(L);
  return push_transformed(L, "move_to", value, celspan_matrix_translation(x - from.x, y - from.y));
}

static int transform(lua_State *L) {
  static const cs_numbers_name name = {.noun = "transform",
                                       .whole = "the matrix",
                                       .item = "value %d of the matrix",
                                       .shape = "{a,b,c, d,e,f, g,h,i}"};
  const cs_userdata *value = self(L, "transform");
  celspan_matrix matrix;
  cs_numbers_read(L, 2, &name, 9, 9, matrix.m);
  return push_transformed(L, "transform", value, matrix);
}

static void read_corners(lua_State *L, int index, const char *which, celspan_point corners[4]) {
  cs_numbers_name name = {.noun = "quad",
                          .whole = lua_pushfstring(L, "point %%d of %s", which),
                          .item = lua_pushfstring(L, "point %%d of %s: its value %%d", which),
                          .shape = "{x, y}"};
  bool is_table = lua_istable(L, index);
  if (!is_table || cs_list_length(L, index) != 4)
    cs_caller_error(L, "quad: %s must be four points {{x, y}, {x, y}, {x, y}, {x, y}}, got %s",
                    which,
                    is_table ? lua_pushfstring(L, "%d of them", (int)cs_list_length(L, index))
                             : cs_userdata_type(L, index));
  for (int i = 0; i < 4; i++) {
    double pair[2];
    name.number = i + 1;
    lua_rawgeti(L, index, i + 1);
    cs_numbers_read(L, -1, &name, 2, 2, pair);
    corners[i] = (celspan_point){pair[0], pair[1]};
    lua_pop(L, 1);
  }
}

static int quad(lua_State *L) {
  const cs_userdata *value = self(L, "quad");
  lua_settop(L, 3);
  celspan_point from[4], to[4];
  read_corners(L, 2, "the first four", from);
  read_corners(L, 3, "the other four", to);
  celspan_matrix matrix;
  if (!celspan_matrix_quad(from, to, &matrix))
    return cs_caller_error(L, "quad: no perspective takes the first four points to the second; "
                              "no three of them may lie on one line");
  return push_transformed(L, "quad", value, matrix);
}

static int fade(lua_State *L) {
  const cs_userdata *value = self(L, "fade");
  double k = cs_form_argument(L, 2, "fade", "k");
  cs_userdata *copy = cs_userdata_push_like(L, 1, true);
  cs_placement placement = cs_userdata_placement(value);
  cs_host_try(L, "fade",
              value->noun->kind->fade(cs_host_context(L), value->handle, k, &copy->handle));
  placement.fade *= fmin(fmax(k, 0), 1);
  cs_userdata_place(copy, &placement);
  return 1;
}

/* The method of values that have their mode as a field. */
static int blend_field(lua_State *L) {
  lua_settop(L, 2);
  lua_createtable(L, 0, 1);
  lua_insert(L, 2);
  lua_setfield(L, 2, "blend");
  return cs_construct_with(L);
}

/* The mode named by the word at index; a number beyond all modes for any other value. */
static celspan_blend mode_at(lua_State *L, int index) {
  const char *word = lua_type(L, index) == LUA_TSTRING ? lua_tostring(L, index) : "";
  int mode = 0;
  while (cs_blend_words[mode] && strcmp(cs_blend_words[mode], word) != 0)
    mode++;
  return (celspan_blend)mode;
}

int cs_placed_blend_within(lua_State *L) {
  const cs_userdata *value = self(L, "blend_within");
  const celspan_blend mode = mode_at(L, 2);
  celspan_object *made;
  cs_userdata *copy = cs_userdata_push_like(L, 1, true);
  cs_host_try(L, "blend_within",
              cs_object_blend_within(cs_host_context(L), value->handle, mode, &made));
  copy->handle = made;
  return 1;
}

/* Raises: argument 2 is not a mode. */
static int refuse_mode(lua_State *L) {
  const char *word = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
  const char *nearest = cs_suggest_name(word, cs_blend_words, (size_t)mode_at(L, 2));
  const char *hint = nearest ? lua_pushfstring(L, "; did you mean \"%s\"?", nearest) : "";
  if (strcmp(word, "dissolve") == 0)
    hint = "; write celspan.dissolve(object), of an object that is faded already";
  return cs_caller_error(L, "blend: the mode must be one of %s, got %s%s",
                         cs_fields_push_words(L, cs_blend_words), cs_userdata_shown(L, 2), hint);
}

static int blend(lua_State *L) {
  const cs_userdata *value = self(L, "blend");
  const celspan_blend mode = mode_at(L, 2);
  if (!cs_blend_words[mode])
    return refuse_mode(L);
  if (cs_userdata_has_field(value->noun, "blend"))
    return blend_field(L);
  cs_userdata *copy = cs_userdata_push_like(L, 1, true);
  cs_host_try(L, "blend",
              value->noun->kind->blend(cs_host_context(L), value->handle, mode, &copy->handle));
  return 1;
}

static int bounds(lua_State *L) {
  const cs_userdata *value = self(L, "bounds");
  celspan_box box;
  bool is_there = false;
  cs_host_try(L, "bounds",
              value->noun->kind->bounds(cs_host_context(L), value->handle, &is_there, &box));
  if (!is_there)
    return 0;
  lua_pushnumber(L, box.x);
  lua_pushnumber(L, box.y);
  lua_pushnumber(L, box.width);
  lua_pushnumber(L, box.height);
  return 4;
}

static int contains(lua_State *L) {
  const cs_userdata *value = self(L, "contains");
  celspan_point point = {cs_form_argument(L, 2, "contains", "x"),
                         cs_form_argument(L, 3, "contains", "y")};
  lua_pushboolean(L, value->noun->kind->contains(value->handle, point));
  return 1;
}

#define METHODS                                                                                    \
  {"translate", translate}, {"scale", scale}, {"rotate", rotate}, {"skew", skew},                  \
      {"move_to", move_to}, {"transform", transform}, {"quad", quad}, {"fade", fade},              \
      {"blend", blend}, {"shadow", cs_nouns_shadow}, {"glow", cs_nouns_glow},                      \
      {"outline", cs_nouns_outline}, {"bounds", bounds}, {"contains", contains},                   \
      {"named", cs_named_method}, {"with", cs_construct_with}, {                                   \
    NULL, NULL                                                                                     \
  }
const luaL_Reg cs_placed_methods[] = {METHODS};
const luaL_Reg cs_placed_object_methods[] = {{"blur", cs_nouns_blur},
                                             {"displace", cs_nouns_displace},
                                             {"sharpen", cs_nouns_sharpen},
                                             {"stroke", cs_stroke_method},
                                             {"paint", cs_derived_paint},
                                             {"metrics", cs_text_metrics},
                                             METHODS};
