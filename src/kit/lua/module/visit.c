#include "lua/module/visit.h"

#include <lauxlib.h>

#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/userdata.h"
#include "lua/nouns/lua_film.h"

celspan_status cs_visit(lua_State *L, int index, lua_CFunction function, void *user, int results) {
  index = lua_absindex(L, index);
  const cs_host *host = lua_checkstack(L, 4) ? cs_host_find(L) : NULL;
  if (!host)
    return CELSPAN_BAD_ARGUMENT;
  lua_pushcfunction(L, function);
  lua_pushvalue(L, index);
  lua_pushlightuserdata(L, user);
  int outcome = lua_pcall(L, 2, results, 0);
  return outcome == LUA_OK       ? CELSPAN_OK
         : outcome == LUA_ERRMEM ? cs_lua_error_report(L, outcome)
                                 : cs_lua_error_report_as(L, CELSPAN_BAD_ARGUMENT);
}

/* value, light userdata: where the film's facts go -> film */
static int read_film(lua_State *L) {
  if (!cs_lua_film_push(L, 1))
    return luaL_error(L, "a film or a rostrum is needed, got %s", cs_userdata_type(L, 1));
  cs_lua_film_read(L, lua_gettop(L), lua_touserdata(L, 2));
  return 1;
}

celspan_status cs_visit_film(lua_State *L, int index, cs_film_info *out) {
  return cs_visit(L, index, read_film, out, 1);
}
