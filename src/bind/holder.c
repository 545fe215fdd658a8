#include "bind/holder.h"

#include <string.h>

void cs_holder_keep_metatable(lua_State *L, const char *kind) {
  lua_pushstring(L, kind);
  lua_setfield(L, -2, "__name");
  lua_pushstring(L, kind); /* all that getmetatable tells: no script can call __gc */
  lua_setfield(L, -2, "__metatable");
  lua_setfield(L, LUA_REGISTRYINDEX, kind);
}

static void push_metatable(lua_State *L, const char *kind, lua_CFunction release) {
  if (luaL_getmetatable(L, kind) == LUA_TTABLE)
    return;
  lua_pop(L, 1);
  lua_createtable(L, 0, 3);
  lua_pushcfunction(L, release);
  lua_setfield(L, -2, "__gc");
  cs_holder_keep_metatable(L, kind);
  luaL_getmetatable(L, kind);
}

void *cs_holder_push(lua_State *L, const char *kind, size_t size, lua_CFunction release) {
  void *held = lua_newuserdatauv(L, size, 1);
  memset(held, 0, size);
  push_metatable(L, kind, release);
  lua_setmetatable(L, -2);
  return held;
}
