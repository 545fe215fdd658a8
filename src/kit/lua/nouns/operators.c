/* The functions behind celspan.trim and the other path operators. Their Lua
 * (lua/celspan/draw/operators.lua) has checked the types of the arguments. */
#include "celspan/operators.h"

#include "inside/context.h"
#include "lua/bind/bare.h"
#include "lua/bind/caller.h"
#include "lua/bind/host.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/shape.h"

#define RADIANS 0.017453292519943295 /* in a degree */

static const cs_noun noun_changed = {.name = "changed", .kind = &cs_kind_object, CS_BARE};

/* The object at index 1, and the value that gets the changed one, on top of the stack. */
typedef struct pair {
  celspan_context *context;
  celspan_object *object, *made;
  cs_userdata *value;
} pair;

static pair begin(lua_State *L, const char *noun) {
  const cs_userdata *object = cs_shape_at(L, 1);
  if (!object)
    (void)cs_caller_error(L, "%s: the first argument must be an object, got %s", noun,
                          cs_userdata_type(L, 1));
  return (pair){cs_host_context(L), object->handle, NULL, cs_bare_push(L, &noun_changed)};
}

static int finish(lua_State *L, const char *noun, const pair *p, celspan_status status) {
  cs_host_try(L, noun, status);
  p->value->handle = p->made;
  return 1;
}

int cs_operators_trim(lua_State *L) {
  pair p = begin(L, "trim");
  return finish(L, "trim", &p,
                celspan_object_trim(p.context, p.object, luaL_checknumber(L, 2),
                                    luaL_checknumber(L, 3), luaL_checknumber(L, 4),
                                    lua_toboolean(L, 5), &p.made));
}

int cs_operators_round_corners(lua_State *L) {
  pair p = begin(L, "round_corners");
  return finish(L, "round_corners", &p,
                celspan_object_round_corners(p.context, p.object, luaL_checknumber(L, 2), &p.made));
}

int cs_operators_zigzag(lua_State *L) {
  pair p = begin(L, "zigzag");
  return finish(L, "zigzag", &p,
                celspan_object_zigzag(p.context, p.object, luaL_checknumber(L, 2),
                                      (size_t)luaL_checkinteger(L, 3), lua_toboolean(L, 4),
                                      &p.made));
}

int cs_operators_pucker(lua_State *L) {
  pair p = begin(L, "pucker");
  return finish(L, "pucker", &p,
                celspan_object_pucker(p.context, p.object, luaL_checknumber(L, 2), &p.made));
}

/* object, distance, join, limit */
int cs_operators_offset(lua_State *L) {
  lua_settop(L, 4);
  pair p = begin(L, "offset");
  int join = luaL_checkoption(L, 3, NULL, cs_nouns_joins);
  return finish(L, "offset", &p,
                celspan_object_offset(p.context, p.object, luaL_checknumber(L, 2),
                                      (celspan_stroke_join)join, luaL_checknumber(L, 4), &p.made));
}

int cs_operators_twist(lua_State *L) {
  lua_settop(L, 4);
  pair p = begin(L, "twist");
  const celspan_point centre = {luaL_optnumber(L, 3, 0), luaL_optnumber(L, 4, 0)};
  return finish(L, "twist", &p,
                celspan_object_twist(p.context, p.object, RADIANS * luaL_checknumber(L, 2),
                                     lua_isnoneornil(L, 3) ? NULL : &centre, &p.made));
}
