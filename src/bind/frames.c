#include "bind/frames.h"

#include <lauxlib.h>
#include <limits.h>

#include "bind/holder.h"
#include "bind/host.h"
#include "film/sequence.h"

static void push_numbers(lua_State *L, const cs_sequence *sequence) {
  lua_createtable(L, sequence->count < INT_MAX ? (int)sequence->count : 0, 0);
  for (size_t i = 0; i < sequence->count; i++) {
    lua_pushinteger(L, sequence->frames[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

static int release(lua_State *L) {
  cs_sequence_finish(lua_touserdata(L, 1));
  return 0;
}

/* A sequence that is released whatever happens. */
static cs_sequence *push_sequence(lua_State *L) {
  return cs_holder_push(L, "celspan.sequence", sizeof(cs_sequence), release);
}

int cs_frames_list(lua_State *L) {
  const char *pattern = luaL_checkstring(L, 1), *list = luaL_optstring(L, 2, NULL);
  celspan_context *context = cs_host_context(L);
  cs_sequence *sequence = push_sequence(L);
  celspan_status status = list ? cs_sequence_parse(context, list, sequence)
                               : cs_sequence_list(context, pattern, sequence);
  if (status != CELSPAN_OK)
    return cs_host_fail(L, status);
  push_numbers(L, sequence);
  return 1;
}

int cs_frames_name(lua_State *L) {
  char name[4096];
  celspan_context *context = cs_host_context(L);
  celspan_status status =
      cs_sequence_name(context, luaL_checkstring(L, 1), luaL_checkinteger(L, 2), name, sizeof name);
  if (status != CELSPAN_OK)
    return cs_host_fail(L, status);
  lua_pushstring(L, name);
  return 1;
}
