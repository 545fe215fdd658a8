#include "lua/bind/warnings.h"

#include <lauxlib.h>

#include "lua/bind/caller.h"

enum { MOST = 100 }; /* the most for a frame: more would not be useful */

static const char list_key = 0; /* its address is a key of the registry */

static bool push_list(lua_State *L) {
  return lua_rawgetp(L, LUA_REGISTRYINDEX, &list_key) == LUA_TTABLE;
}

void cs_warnings_keep(lua_State *L) {
  lua_newtable(L);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &list_key);
}

void cs_warnings_push(lua_State *L) {
  if (push_list(L)) {
    cs_warnings_keep(L);
    return;
  }
  lua_pop(L, 1);
  lua_newtable(L);
}

int cs_warnings_kept(lua_State *L) {
  lua_pushboolean(L, push_list(L));
  return 1;
}

int cs_warnings_add(lua_State *L) {
  lua_Debug caller;
  const char *text = luaL_checkstring(L, 1);
  if (!push_list(L) || lua_rawlen(L, -1) >= MOST)
    return 0;
  if (cs_caller_find(L, &caller))
    lua_pushfstring(L, "%s:%d: %s", caller.short_src, caller.currentline, text);
  else
    lua_pushstring(L, text);
  lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1);
  return 0;
}
