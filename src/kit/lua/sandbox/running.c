/* load, print, pcall, xpcall. */
#include <lauxlib.h>
#include <string.h>

#include "lua/bind/globals.h"
#include "lua/sandbox/guard.h"
#include "lua/sandbox/library.h"

#define BYTES_A_STEP 16

/* Calls the function at 1 until it returns nil or "", and pushes the joined pieces. */
static int join_pieces(lua_State *L) {
  luaL_Buffer all;
  luaL_buffinit(L, &all);
  for (;;) {
    lua_pushvalue(L, 1);
    lua_call(L, 0, 1);
    if (!lua_isnil(L, -1) && lua_type(L, -1) != LUA_TSTRING)
      luaL_error(L, "reader function must return a string");
    if (lua_isnil(L, -1) || lua_rawlen(L, -1) == 0)
      break;
    luaL_addvalue(&all);
  }
  lua_pop(L, 1);
  luaL_pushresult(&all);
  return 1;
}

/* Pushes the chunk for load, which is a string or a function that returns pieces; or a message. */
static bool push_source(lua_State *L) {
  if (lua_isstring(L, 1)) {
    lua_pushvalue(L, 1);
    return true;
  }
  lua_pushcfunction(L, join_pieces);
  lua_pushvalue(L, 1);
  int outcome = lua_pcall(L, 1, 1, 0);
  if (outcome != LUA_OK)
    cs_guard_pass(L, outcome);
  return outcome == LUA_OK;
}

/* Inserts nil below the message on top. */
static int push_failure(lua_State *L) {
  luaL_pushfail(L);
  lua_insert(L, -2);
  return 2;
}

/* load(chunk [, name [, mode [, globals]]]): source text only, with the script's globals. */
static int load(lua_State *L) {
  size_t size;
  bool has_globals = !lua_isnone(L, 4);
  const char *mode = luaL_optstring(L, 3, "bt");
  if (!lua_isstring(L, 1))
    luaL_checktype(L, 1, LUA_TFUNCTION);
  lua_settop(L, 4);
  if (!push_source(L))
    return push_failure(L);
  const char *text = lua_tolstring(L, 5, &size);
  const char *name = luaL_optstring(L, 2, lua_isstring(L, 1) ? text : "=(load)");
  cs_guard_charge(L, size / BYTES_A_STEP);
  if (!strchr(mode, 't') || luaL_loadbufferx(L, text, size, name, "t") != LUA_OK) {
    if (!strchr(mode, 't'))
      lua_pushfstring(L, "load: mode '%s': the sandbox loads only text ('t')", mode);
    return push_failure(L);
  }
  cs_globals_note(L, name, text, size);
  if (has_globals) {
    lua_pushvalue(L, 4);
    lua_setupvalue(L, -2, 1); /* a compiled text has one upvalue: _ENV */
  }
  return 1;
}

/* print passes a line to the host. */
static int print(lua_State *L) {
  size_t size;
  int count = lua_gettop(L);
  luaL_Buffer line;
  luaL_buffinit(L, &line);
  for (int i = 1; i <= count; i++) {
    cs_library_push_text(L, i);
    luaL_addvalue(&line);
    luaL_addchar(&line, i < count ? '\t' : '\n');
  }
  if (count == 0)
    luaL_addchar(&line, '\n');
  luaL_pushresult(&line);
  const char *text = lua_tolstring(L, -1, &size);
  cs_guard_print(L, text, size);
  return 0;
}

void cs_library_add_running(lua_State *L) {
  static const luaL_Reg own[] = {{"load", load},
                                 {"print", print},
                                 {"pcall", cs_guard_pcall},
                                 {"xpcall", cs_guard_xpcall},
                                 {NULL, NULL}};
  luaL_setfuncs(L, own, 0);
}
