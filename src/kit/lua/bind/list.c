#include "lua/bind/list.h"

#include <stdint.h>

lua_Integer cs_list_length(lua_State *L, int index) {
  lua_Integer greatest = 0;
  index = lua_absindex(L, index);
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1))
    if (lua_isinteger(L, -2) && lua_tointeger(L, -2) > greatest)
      greatest = lua_tointeger(L, -2);
  return greatest < INT32_MAX ? greatest : INT32_MAX;
}

static bool has(lua_State *L, int index, lua_Integer place, bool takes_false) {
  lua_rawgeti(L, index, place);
  bool is_there = takes_false ? lua_toboolean(L, -1) : !lua_isnil(L, -1);
  lua_pop(L, 1);
  return is_there;
}

lua_Integer cs_list_find_gap(lua_State *L, int index, lua_Integer length, bool takes_false) {
  for (lua_Integer place = 1; place <= length; place++)
    if (!has(L, index, place, takes_false))
      return place;
  return 0;
}

lua_Integer cs_list_border(lua_State *L, int index, lua_Integer exact) {
  lua_Integer gap = cs_list_find_gap(L, index, exact, false), low = exact;
  if (gap > 0)
    return gap - 1;
  while (low < LUA_MAXINTEGER / 2 && has(L, index, 2 * low, false))
    low *= 2;
  for (lua_Integer high = 2 * low; high - low > 1;) {
    lua_Integer middle = low + (high - low) / 2;
    if (has(L, index, middle, false))
      low = middle;
    else
      high = middle;
  }
  return low;
}
