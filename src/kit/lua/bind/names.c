#include "lua/bind/names.h"

#include <lauxlib.h>

#include "lua/bind/caller.h"
#include "lua/bind/host.h"
#include "lua/bind/require.h"

/* Tables in the registry. */
#define FOUND "celspan.found"
#define FILES "celspan.files" /* by Lua's name of it: the text of a file, or false */

/* Pushes a function of the module. */
static void push_function(lua_State *L, const char *name) {
  cs_require_module(L, "celspan.names");
  lua_getfield(L, -1, name);
  lua_remove(L, -2);
}

void cs_names_note(lua_State *L, const char *source, const char *text) {
  int top = lua_gettop(L);
  luaL_checkstack(L, 8, "files");
  luaL_getsubtable(L, LUA_REGISTRYINDEX, FILES);
  if (text)
    lua_pushstring(L, text);
  else
    lua_pushboolean(L, false);
  lua_setfield(L, -2, source);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, FOUND);
  for (lua_pushnil(L); lua_next(L, -2);) {
    lua_pushvalue(L, -2);
    lua_pushnil(L);
    lua_rawset(L, -5);
    lua_pop(L, 1);
  }
  lua_settop(L, top);
}

const char *cs_names_push_hint(lua_State *L, const char *name) {
  if (!cs_require_is_loaded(L, "celspan.names"))
    return lua_pushliteral(L, "");
  push_function(L, "hint");
  lua_pushstring(L, name);
  lua_pushglobaltable(L);
  lua_call(L, 2, 1);
  return lua_tostring(L, -1);
}

/* ---------------------------------------------------------------- globals */

/* __index of the table of found names. upvalues: the names without a value, and the function for
 * them. */
static int find(lua_State *L) {
  lua_CFunction otherwise = lua_tocfunction(L, lua_upvalueindex(2));
  lua_Debug reader;
  lua_settop(L, 2);
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(1)) == LUA_TNIL && lua_type(L, 2) == LUA_TSTRING) {
    push_function(L, "find");
    lua_pushvalue(L, 1);
    if (!cs_host_confines(L)) { /* Lua's own require does not note its files */
      lua_pushnil(L);
      lua_replace(L, -2);
    }
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_pushvalue(L, 2);
    lua_pushstring(L, cs_caller_find(L, &reader) ? reader.source : "");
    luaL_getsubtable(L, LUA_REGISTRYINDEX, FILES);
    lua_call(L, 5, 1);
    if (!lua_isnil(L, -1))
      return 1;
  }
  lua_settop(L, 2);
  return otherwise ? otherwise(L) : 0;
}

void cs_names_push_found(lua_State *L, lua_CFunction otherwise) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, FOUND);
  lua_createtable(L, 0, 1);
  lua_newtable(L);
  if (otherwise)
    lua_pushcfunction(L, otherwise);
  else
    lua_pushnil(L);
  lua_pushcclosure(L, find, 2);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
}

void cs_names_open(lua_State *L) {
  int top = lua_gettop(L);
  lua_pushglobaltable(L);
  if (!lua_getmetatable(L, -1)) {
    lua_createtable(L, 0, 1);
    cs_names_push_found(L, NULL);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
  }
  lua_settop(L, top);
}
