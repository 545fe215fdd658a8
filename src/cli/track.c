/* celspan track PATTERN: following a region through frames.
 *
 * The work is that of the Lua module celspan.track, called with celspan's rules for scripts. */
#include <lauxlib.h>
#include <stdio.h>

#include "bind/lua_error.h"
#include "cli/document.h"
#include "cli/script.h"
#include "cli/verbs.h"

typedef struct job {
  const cs_request *request;
  cs_exit outcome;
} job;

static void push_options(lua_State *L, const cs_request *request) {
  lua_createtable(L, 0, 4);
  lua_pushinteger(L, request->from.value);
  lua_setfield(L, -2, "from");
  lua_createtable(L, 4, 0);
  for (int i = 0; i < 4; i++) {
    lua_pushinteger(L, request->at[i]);
    lua_rawseti(L, -2, i + 1);
  }
  lua_setfield(L, -2, "at");
  lua_pushstring(L, request->frames);
  lua_setfield(L, -2, "frames");
  lua_pushstring(L, request->model);
  lua_setfield(L, -2, "model");
}

/* Pushes the track. OK, or reported, and nothing is pushed. Raises. */
static cs_exit push_track(lua_State *L, const cs_request *request) {
  lua_getglobal(L, "require");
  lua_pushliteral(L, "celspan.track");
  lua_call(L, 1, 1);
  lua_getfield(L, -1, "follow");
  lua_pushstring(L, request->operands[0]);
  push_options(L, request);
  return cs_document_make(L, 2);
}

/* What was found of the track on top of the stack, on standard error. */
static void report(lua_State *L) {
  lua_getfield(L, -1, "frames");
  lua_getfield(L, -2, "lost");
  lua_Unsigned frames = lua_rawlen(L, -2), lost = lua_rawlen(L, -1);
  fprintf(stderr, "celspan: %llu frames followed, %llu lost", (unsigned long long)frames,
          (unsigned long long)lost);
  for (lua_Unsigned i = 1; i <= lost; i++) {
    lua_rawgeti(L, -1, (lua_Integer)i);
    fprintf(stderr, "%s %lld", i == 1 ? ":" : ",", (long long)lua_tointeger(L, -1));
    lua_pop(L, 1);
  }
  fputs("\n", stderr);
  lua_pop(L, 2);
}

/* Light userdata: the job. Runs protected. */
static int run(lua_State *L) {
  job *j = lua_touserdata(L, -1);
  j->outcome = push_track(L, j->request);
  if (j->outcome != CS_EXIT_OK)
    return 0;
  report(L);
  j->outcome = cs_document_put(L, j->request->output, j->request->operands[0]);
  return 0;
}

static cs_exit call(cs_script *script, job *j) {
  lua_State *L = script->L;
  lua_pushcfunction(L, run);
  lua_pushlightuserdata(L, j);
  int outcome = cs_lua_error_call(L, 1, 0);
  if (outcome == LUA_OK)
    return j->outcome;
  return cs_report_failure(script->context, cs_lua_error_report(L, outcome), NULL);
}

cs_exit cs_verb_track(celspan_context *context, const cs_request *request) {
  if (!request->from.is_given || !request->at[2])
    return cs_report_usage(
        "track needs --from N and --at X,Y,W,H: the frame in which the region is "
        "given, and the region there");
  job j = {.request = request};
  cs_script script;
  cs_exit outcome = cs_script_start(context, &script);
  if (outcome == CS_EXIT_OK)
    outcome = call(&script, &j);
  cs_script_close(&script);
  return outcome;
}
