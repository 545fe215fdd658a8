#include "lua/module/subtitles.h"

#include "celspan/lua.h"
#include "lua/bind/require.h"

/* film, form, first, seconds -> the text. Runs protected, within the limits of scripts. */
static int write(lua_State *L) {
  cs_require_module(L, "celspan.subtitles");
  lua_getfield(L, -1, "text");
  lua_insert(L, 1);
  lua_settop(L, 5);
  lua_call(L, 4, 1);
  return 1;
}

celspan_status cs_subtitles_push(lua_State *L, int index, const char *form, double first,
                                 double seconds) {
  index = lua_absindex(L, index);
  lua_pushcfunction(L, write);
  lua_pushvalue(L, index);
  lua_pushstring(L, form);
  lua_pushnumber(L, first);
  lua_pushnumber(L, seconds);
  return celspan_lua_call(L, 4, 1);
}
