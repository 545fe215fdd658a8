#include "cli/desk/onion.h"

#include <lauxlib.h>

#include "bind/host.h"
#include "bind/lua_error.h"
#include "bind/userdata.h"
#include "cli/desk/desk.h"
#include "scene/scene.h"

typedef struct onion {
  const int32_t *counts; /* before, after */
  const celspan_frame_desc *frame;
} onion;

/* same(cel, cel): whether they show the same. */
static int is_same(lua_State *L) {
  const cs_userdata *a = cs_userdata_test(L, 1, &cs_kind_cel);
  const cs_userdata *b = cs_userdata_test(L, 2, &cs_kind_cel);
  if (!a || !b)
    return luaL_error(L, "same: two cels are needed");
  const celspan_cel *one = a->handle, *other = b->handle;
  lua_pushboolean(L, one->hash.a == other->hash.a && one->hash.b == other->hash.b);
  return 1;
}

/* film, light userdata: an onion -> film. Runs protected. */
static int lay(lua_State *L) {
  const onion *o = lua_touserdata(L, 2);
  lua_settop(L, 1);
  lua_pushinteger(L, o->counts[0]);
  lua_pushinteger(L, o->counts[1]);
  lua_pushinteger(L, o->frame->width);
  lua_pushinteger(L, o->frame->height);
  lua_pushcfunction(L, is_same);
  cs_desk_call(L, cs_desk_onion, "@celspan/desk/onion.lua", 6, 1);
  return 1;
}

cs_exit cs_onion_lay(cs_script *script, const cs_request *request,
                     const celspan_frame_desc *frame) {
  if (request->onion[0] + request->onion[1] == 0)
    return CS_EXIT_OK;
  if (request->cel)
    return cs_report_usage("--onion lays whole frames over one another: leave --cel out");
  onion o = {request->onion, frame};
  lua_State *L = script->L;
  lua_pushcfunction(L, lay);
  lua_pushvalue(L, CS_SCRIPT_FILM);
  lua_pushlightuserdata(L, &o);
  cs_host_begin(L, CS_HOST_VERB, 0);
  int outcome = lua_pcall(L, 2, 1, 0);
  cs_host_end(L);
  if (outcome != LUA_OK)
    return cs_report_failure(script->context, cs_lua_error_report(L, outcome), NULL);
  lua_replace(L, CS_SCRIPT_FILM);
  return CS_EXIT_OK;
}
