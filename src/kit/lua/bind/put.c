#include "lua/bind/put.h"

void cs_put_flag(lua_State *L, const char *name, bool flag) {
  lua_pushboolean(L, flag);
  lua_setfield(L, -2, name);
}

void cs_put_integer(lua_State *L, const char *name, lua_Integer number) {
  lua_pushinteger(L, number);
  lua_setfield(L, -2, name);
}

void cs_put_number(lua_State *L, const char *name, lua_Number number) {
  lua_pushnumber(L, number);
  lua_setfield(L, -2, name);
}

void cs_push_numbers(lua_State *L, const double *numbers, size_t count) {
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; i < count; i++) {
    lua_pushnumber(L, numbers[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

void cs_read_numbers(lua_State *L, int index, int count, double *out) {
  luaL_checktype(L, index, LUA_TTABLE);
  for (int i = 0; i < count; i++) {
    lua_rawgeti(L, index, i + 1);
    out[i] = luaL_checknumber(L, -1);
    lua_pop(L, 1);
  }
}

void cs_put_numbers(lua_State *L, const char *name, const double *numbers, size_t count) {
  cs_push_numbers(L, numbers, count);
  lua_setfield(L, -2, name);
}

void cs_put_pair(lua_State *L, const char *name, lua_Integer first, lua_Integer second) {
  lua_createtable(L, 2, 0);
  lua_pushinteger(L, first);
  lua_rawseti(L, -2, 1);
  lua_pushinteger(L, second);
  lua_rawseti(L, -2, 2);
  lua_setfield(L, -2, name);
}

void cs_put_text(lua_State *L, const char *name, const char *text) {
  lua_pushstring(L, text);
  lua_setfield(L, -2, name);
}
