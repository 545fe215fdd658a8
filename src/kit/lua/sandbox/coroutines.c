/* coroutine: without close, and with versions of resume and wrap that propagate limits. Lua 5.4.4
 * overflows the C stack when nested coroutines are closed, so none is closed here: the collector
 * frees the values that a failed coroutine would have closed. */
#include <lauxlib.h>

#include "lua/sandbox/guard.h"
#include "lua/sandbox/library.h"

#define STEPS_A_COROUTINE 1000 /* steps that a coroutine may take before its own hook is called */

/* Resumes with the `count` values on top of L. Returns the number of results, which are on top of
 * L; -1: it failed, and the message is on top. */
static int resume(lua_State *L, lua_State *co, int count) {
  int results;
  if (!lua_checkstack(co, count)) {
    lua_pushliteral(L, "too many arguments to resume");
    return -1;
  }
  lua_xmove(L, co, count);
  int outcome = lua_resume(co, L, count, &results);
  if (outcome != LUA_OK && outcome != LUA_YIELD) {
    lua_xmove(co, L, 1);
    cs_guard_pass(L, outcome);
    return -1;
  }
  if (!lua_checkstack(L, results + 1)) {
    lua_pop(co, results);
    lua_pushliteral(L, "too many results to resume");
    return -1;
  }
  lua_xmove(co, L, results);
  return results;
}

static int resume_thread(lua_State *L) {
  lua_State *co = lua_tothread(L, 1);
  luaL_argexpected(L, co, 1, "thread");
  int results = resume(L, co, lua_gettop(L) - 1);
  lua_pushboolean(L, results >= 0);
  lua_insert(L, -(results < 0 ? 1 : results) - 1);
  return results < 0 ? 2 : results + 1;
}

static void push_thread(lua_State *L) {
  luaL_checktype(L, 1, LUA_TFUNCTION);
  cs_guard_charge(L, STEPS_A_COROUTINE);
  lua_State *co = lua_newthread(L);
  lua_pushvalue(L, 1);
  lua_xmove(L, co, 1);
}

static int create(lua_State *L) {
  push_thread(L);
  return 1;
}

/* upvalue 1: the thread */
static int call_wrapped(lua_State *L) {
  int results = resume(L, lua_tothread(L, lua_upvalueindex(1)), lua_gettop(L));
  if (results >= 0)
    return results;
  if (lua_type(L, -1) == LUA_TSTRING) {
    luaL_where(L, 1);
    lua_insert(L, -2);
    lua_concat(L, 2);
  }
  return lua_error(L);
}

static int wrap(lua_State *L) {
  push_thread(L);
  lua_pushcclosure(L, call_wrapped, 1);
  return 1;
}

void cs_library_push_coroutine(lua_State *L) {
  static const luaL_Reg own[] = {
      {"create", create}, {"resume", resume_thread}, {"wrap", wrap}, {NULL, NULL}};
  static const char *const same[] = {"isyieldable", "running", "status", "yield", NULL};
  cs_library_push_part(L, "coroutine", same, own);
}
