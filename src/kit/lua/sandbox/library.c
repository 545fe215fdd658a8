#include "lua/sandbox/library.h"

void cs_library_copy_fields(lua_State *L, int from, const char *const *names) {
  from = lua_absindex(L, from);
  for (; *names; names++) {
    lua_getfield(L, from, *names);
    lua_setfield(L, -2, *names);
  }
}

int cs_library_call(lua_State *L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

void cs_library_push_part(lua_State *L, const char *name, const char *const *same,
                          const luaL_Reg *own) {
  lua_getglobal(L, name);
  lua_newtable(L);
  cs_library_copy_fields(L, -2, same);
  luaL_setfuncs(L, own, 0);
  lua_remove(L, -2);
}
