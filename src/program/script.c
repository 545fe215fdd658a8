#include "program/script.h"

#include <lauxlib.h>
#include <lualib.h>
#include <stdio.h>
#include <string.h>

#include "base/context.h"
#include "celspan/lua.h"
#include "frames/process/interrupt.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/named.h"
#include "lua/bind/warnings.h"
#include "program/confine.h"
#include "program/hear.h"
#include "program/settings.h"
#include "program/view.h"

/* The states that a signal interrupts: of the verb, and of the script that ran last; NULL: none. */
static lua_State *volatile states[2];

static void raise_interrupt(lua_State *L, lua_Debug *where) {
  (void)where;
  luaL_error(L, "interrupted");
}

/* Runs in the signal handler: lua_sethook is one of the few calls that are safe there. */
static void interrupt_states(void) {
  const int always = LUA_MASKCALL | LUA_MASKRET | LUA_MASKLINE | LUA_MASKCOUNT;
  for (int i = 0; i < 2; i++)
    if (states[i])
      lua_sethook(states[i], raise_interrupt, always, 1);
}

void cs_script_watch(lua_State *L) {
  states[0] = L;
  cs_interrupt_call(interrupt_states);
}

void cs_script_unwatch(void) { states[0] = NULL; }

static void watch_script(lua_State *L) {
  states[1] = L;
  cs_interrupt_call(interrupt_states);
}

/* Text printed by a script goes to standard error, because standard output is for results. A script
 * cannot end the program: otherwise a run that did nothing could seem to have done everything. */
static const char HOUSE_RULES[] =
    "local stderr, pack, concat, tostring = io.stderr, table.pack, table.concat, tostring\n"
    "io.output(stderr)\n"
    "function print(...)\n"
    "  local words = pack(...)\n"
    "  for i = 1, words.n do words[i] = tostring(words[i]) end\n"
    "  stderr:write(concat(words, '\\t'), '\\n')\n"
    "end\n"
    "function os.exit() error('os.exit: a script cannot end celspan; raise an error', 2) end\n";

/* The functions of a trusted script: pcall and xpcall pass on limits where there are any. */
static void open_trusted(lua_State *L, bool has_limits) {
  static const luaL_Reg catching[] = {
      {"pcall", cs_guard_pcall}, {"xpcall", cs_guard_xpcall}, {NULL, NULL}};
  if (luaL_dostring(L, HOUSE_RULES) != LUA_OK)
    lua_error(L);
  lua_pushglobaltable(L);
  luaL_setfuncs(L, has_limits ? catching : catching + 2, 0);
  lua_pop(L, 1);
}

static int print_nothing(lua_State *L) {
  (void)L;
  return 0;
}

/* light userdata: the script, and what confines it or nothing. Runs protected. */
static int prepare(lua_State *L) {
  cs_script *script = lua_touserdata(L, 1);
  const cs_confined *confined = lua_touserdata(L, 2);
  luaL_openlibs(L);
  if (script->is_trusted)
    open_trusted(L, confined);
  cs_host_open(L, script->context);
  if (script->asks_files) {
    cs_host_remember_asked(L);
    cs_named_keep_callers(L, true);
  }
  if (script->asks_warnings)
    cs_warnings_keep(L);
  if (confined) {
    script->sandbox = cs_sandbox_open(L, &confined->limits, confined->is_trusted);
    script->sandbox->guard.has_options = true;
  }
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  cs_hear_give(L);
  if (script->is_silent) {
    lua_pushcfunction(L, print_nothing);
    lua_setglobal(L, "print");
  }
  return 0;
}

/* Lua has no memory, or the core has none for the module and its first values: neither may have had
 * a context yet to say it to, but all say it. */
static bool lacks_memory(const char *message) { return !message || strstr(message, "memory"); }

cs_exit cs_script_report_start(lua_State *L) {
  if (!L) {
    cs_report_error("not enough memory for Lua");
    return CS_EXIT_MEMORY;
  }
  const char *message = lua_tostring(L, -1);
  cs_report_error("Lua could not be started: %s", message ? message : "not enough memory");
  return lacks_memory(message) ? CS_EXIT_MEMORY : CS_EXIT_INTERNAL;
}

static cs_exit open_state(cs_script *script, const cs_confined *confined) {
  script->L = luaL_newstate();
  if (!script->L)
    return cs_script_report_start(NULL);
  lua_pushcfunction(script->L, prepare);
  lua_pushlightuserdata(script->L, script);
  lua_pushlightuserdata(script->L, (void *)confined);
  return lua_pcall(script->L, 2, 0, 0) == LUA_OK ? CS_EXIT_OK : cs_script_report_start(script->L);
}

static cs_exit start(cs_script *out, const cs_confined *confined) {
  CS_TRY_EXIT(open_state(out, confined));
  watch_script(out->L);
  return CS_EXIT_OK;
}

/* Arguments: the film, and a light userdata where its facts are stored. Runs in protected mode. */
static int read_film(lua_State *L) {
  cs_lua_film_read(L, 1, lua_touserdata(L, 2));
  return 0;
}

/* Runs protected. */
static int give_settings(lua_State *L) {
  cs_settings_give(L, lua_touserdata(L, 1));
  return 0;
}

/* Reads the settings before the sandbox is entered, in which their file may not be read. */
static cs_exit start_script(cs_script *out, const cs_request *request, const char *path) {
  cs_settings settings;
  cs_confined confined;
  bool is_confined = cs_confine_is_needed(request);
  cs_exit outcome = cs_settings_open(out->context, request, &settings);
  if (outcome == CS_EXIT_OK && is_confined)
    outcome = cs_confine_open(request, path, &confined);
  if (outcome == CS_EXIT_OK)
    outcome = start(out, is_confined ? &confined : NULL);
  if (outcome == CS_EXIT_OK) {
    lua_pushcfunction(out->L, give_settings);
    lua_pushlightuserdata(out->L, &settings);
    if (lua_pcall(out->L, 1, 0, 0) != LUA_OK)
      outcome = cs_script_report_start(out->L);
  }
  out->given = cs_settings_hash(&settings);
  cs_settings_close(out->context, &settings);
  return outcome;
}

static cs_exit open_script(celspan_context *context, const cs_request *request, const char *path,
                           bool is_silent, cs_script *out) {
  *out = (cs_script){.context = context,
                     .is_trusted = cs_request_has(request, "--trust"),
                     .asks_files = request->verb->asks_files,
                     .asks_warnings = request->verb->asks_warnings && !is_silent,
                     .is_silent = is_silent};
  CS_TRY_EXIT(start_script(out, request, path));
  celspan_status status = celspan_lua_run(out->L, path, (int)request->script_argument_count,
                                          (const char *const *)request->script_arguments);
  CS_TRY_EXIT(cs_settings_outcome(out->L, status == CELSPAN_OK));
  if (status != CELSPAN_OK)
    return cs_report_failure(context, status, NULL);
  lua_pushcfunction(out->L, read_film);
  lua_pushvalue(out->L, CS_SCRIPT_FILM);
  lua_pushlightuserdata(out->L, &out->film);
  int raised = lua_pcall(out->L, 2, 0, 0);
  return raised == LUA_OK ? CS_EXIT_OK
                          : cs_report_failure(context, cs_lua_error_report(out->L, raised), NULL);
}

cs_exit cs_script_open(celspan_context *context, const cs_request *request, const char *path,
                       cs_script *out) {
  return open_script(context, request, path, false, out);
}

cs_exit cs_script_open_again(celspan_context *context, const cs_request *request, const char *path,
                             cs_script *out) {
  return open_script(context, request, path, true, out);
}

void cs_script_close(cs_script *script) {
  if (states[1] == script->L)
    states[1] = NULL;
  cs_film_frame_finish(&script->frame);
  if (script->L)
    lua_close(script->L);
  script->L = NULL;
  script->sandbox = NULL;
}

celspan_status cs_script_try(cs_script *script, int64_t number) {
  watch_script(script->L);
  cs_film_frame_finish(&script->frame);
  script->number = number;
  return cs_lua_film_build(script->L, CS_SCRIPT_FILM, number, &script->frame);
}

cs_exit cs_script_build(cs_script *script, int64_t number) {
  return cs_report_failure(script->context, cs_script_try(script, number), NULL);
}

cs_exit cs_script_frame(cs_script *script, const cs_request *request, celspan_frame_desc *out) {
  int64_t first = script->film.first, last = first + script->film.count - 1;
  int32_t number = (int32_t)first;
  cs_request_read(request, "--frame", &number);
  if (number < first || number > last)
    return cs_report_usage("--frame %d: the film has frames %lld to %lld", number, (long long)first,
                           (long long)last);
  cs_exit outcome = cs_view_frame(request, script->film.width, script->film.height, out);
  if (outcome == CS_EXIT_OK)
    outcome = cs_script_build(script, number);
  cs_film_expose(&script->film, &script->frame, out);
  return outcome;
}

cs_exit cs_script_failure(const cs_script *script, celspan_status status) {
  char where[32];
  snprintf(where, sizeof where, "frame %lld", (long long)script->number);
  return cs_report_failure(script->context, status, where);
}
