#include "program/hear.h"

#include <lauxlib.h>

#include "lua/bind/host.h"
#include "lua/bind/userdata.h"
#include "lua/module/core.h"
#include "plugins/sound/loudness.h"

static int release(lua_State *L) {
  cs_loudness *loudness = lua_touserdata(L, 1);
  if (loudness->sums)
    cs_loudness_finish(loudness, cs_host_context(L));
  return 0;
}

/* (path, tried | nil) -> seconds, sums | nil, message */
static int hear(lua_State *L) {
  const char *path = luaL_checkstring(L, 1), *tried = luaL_optstring(L, 2, NULL);
  cs_loudness *loudness =
      cs_userdata_push_holder(L, "celspan.program.loudness", sizeof *loudness, release);
  celspan_status status = cs_loudness_measure(cs_host_context(L), path, tried, loudness);
  if (status != CELSPAN_OK)
    return cs_host_fail(L, status);
  lua_pushnumber(L, (double)loudness->moments / CS_LOUDNESS_RATE);
  lua_pushlstring(L, (const char *)loudness->sums, loudness->count * sizeof *loudness->sums);
  return 2;
}

void cs_hear_give(lua_State *L) {
  lua_pushcfunction(L, hear);
  lua_setfield(L, LUA_REGISTRYINDEX, CS_CORE_HEAR);
}
