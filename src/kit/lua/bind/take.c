#include "lua/bind/take.h"

const char *cs_take_text(lua_State *L, int table, const char *name) {
  lua_getfield(L, table, name);
  const char *text = lua_tostring(L, -1);
  lua_pop(L, 1);
  return text;
}

double cs_take_number(lua_State *L, int table, const char *name, double none) {
  int type = lua_getfield(L, table, name);
  double number = type == LUA_TNUMBER ? lua_tonumber(L, -1) : none;
  if (type == LUA_TBOOLEAN)
    number = lua_toboolean(L, -1);
  lua_pop(L, 1);
  return number;
}
