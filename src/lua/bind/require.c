#include "lua/bind/require.h"

#include <lauxlib.h>

void cs_require_module(lua_State *L, const char *name) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  if (lua_getfield(L, -1, name) == LUA_TNIL) {
    lua_pop(L, 1);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
    if (lua_getfield(L, -1, name) == LUA_TNIL)
      luaL_error(L, "module '%s' not found", name);
    lua_remove(L, -2);
    lua_pushstring(L, name);
    lua_call(L, 1, 1);
    lua_pushvalue(L, -1);
    lua_setfield(L, -3, name);
  }
  lua_remove(L, -2);
}

int cs_require_call(lua_State *L) {
  const cs_written *written = lua_touserdata(L, lua_upvalueindex(1));
  cs_require_module(L, written->module);
  lua_getfield(L, -1, written->function);
  lua_remove(L, -2);
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

void cs_require_methods(lua_State *L, const cs_written *methods) {
  for (; methods && methods->method; methods++) {
    lua_pushlightuserdata(L, (void *)methods);
    lua_pushcclosure(L, cs_require_call, 1);
    lua_setfield(L, -2, methods->method);
  }
}
