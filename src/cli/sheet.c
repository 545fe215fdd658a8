/* celspan sheet FILE|SCRIPT: an exposure sheet as text or converted, or the sheet of a film.
 *
 * The work is that of the Lua module celspan.sheet, called with celspan's rules for scripts. */
#include <lauxlib.h>
#include <string.h>
#include <strings.h>

#include "bind/host.h"
#include "bind/lua_error.h"
#include "cli/confine.h"
#include "cli/document.h"
#include "cli/script.h"
#include "cli/target.h"
#include "cli/verbs.h"

typedef struct job {
  const cs_request *request;
  bool is_script;
  cs_sequence frames; /* of a script's film; none: all */
  cs_exit outcome;
} job;

static bool ends_with(const char *path, const char *ending) {
  size_t length = strlen(path), tail = strlen(ending);
  return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

static void push_frames(lua_State *L, const cs_sequence *frames) {
  lua_createtable(L, 0, 1);
  lua_createtable(L, (int)frames->count, 0);
  for (size_t i = 0; i < frames->count; i++) {
    lua_pushinteger(L, frames->frames[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_setfield(L, -2, "frames");
}

/* Pushes the sheet. OK, or reported, and nothing is pushed. Raises. */
static cs_exit push_sheet(lua_State *L, const job *j) {
  lua_getglobal(L, "require");
  lua_pushliteral(L, "celspan.sheet");
  lua_call(L, 1, 1);
  lua_getfield(L, -1, j->is_script ? "of" : "read");
  if (j->is_script)
    lua_pushvalue(L, CS_SCRIPT_FILM);
  else
    lua_pushstring(L, j->request->operands[0]);
  bool has_frames = j->frames.count > 0;
  if (has_frames)
    push_frames(L, &j->frames);
  return cs_document_make(L, has_frames ? 2 : 1);
}

/* [film,] light userdata: the job. Runs protected. */
static int run(lua_State *L) {
  job *j = lua_touserdata(L, -1);
  j->outcome = push_sheet(L, j);
  if (j->outcome == CS_EXIT_OK)
    j->outcome = cs_document_put(L, j->request->output, j->request->operands[0]);
  return 0;
}

static cs_exit call(cs_script *script, job *j) {
  lua_State *L = script->L;
  lua_pushcfunction(L, run);
  if (j->is_script)
    lua_pushvalue(L, CS_SCRIPT_FILM);
  lua_pushlightuserdata(L, j);
  if (script->sandbox)
    script->sandbox->output = j->request->output; /* the verb writes there itself, in Lua */
  cs_host_begin(L, CS_HOST_VERB, 0);
  int outcome = cs_lua_error_call(L, j->is_script ? 2 : 1, 0);
  cs_host_end(L);
  if (outcome == LUA_OK)
    return j->outcome;
  return cs_report_failure(script->context, cs_lua_error_report(L, outcome), NULL);
}

static cs_exit list_frames(const cs_script *script, job *j) {
  cs_request listed = *j->request;
  listed.output = NULL; /* the name is that of the sheet, not of frames */
  return j->request->frames ? cs_target_frames(script, &listed, &j->frames) : CS_EXIT_OK;
}

static cs_exit refuse(const cs_request *request, bool is_script) {
  const char *out = request->output;
  if (out && strcmp(out, "-") != 0 && !ends_with(out, ".xdts") && !ends_with(out, ".csv") &&
      !ends_with(out, ".txt"))
    return cs_report_usage("-o: '%s' must end in .xdts, .csv or .txt", out);
  if (request->frames && !is_script)
    return cs_report_usage("--frames goes with a script, and %s is a sheet", request->operands[0]);
  return CS_EXIT_OK;
}

cs_exit cs_verb_sheet(celspan_context *context, const cs_request *request) {
  job j = {.request = request, .is_script = ends_with(request->operands[0], ".lua")};
  cs_script script;
  cs_exit outcome = refuse(request, j.is_script);
  if (outcome == CS_EXIT_OK && !j.is_script)
    outcome = cs_confine_refuse(request);
  if (outcome != CS_EXIT_OK)
    return outcome;
  outcome =
      j.is_script ? cs_script_open(context, request, &script) : cs_script_start(context, &script);
  if (outcome == CS_EXIT_OK)
    outcome = list_frames(&script, &j);
  if (outcome == CS_EXIT_OK)
    outcome = call(&script, &j);
  cs_script_close(&script);
  cs_sequence_finish(&j.frames);
  return outcome;
}
