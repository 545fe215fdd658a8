#include "program/film/script.h"

#include <errno.h>
#include <lauxlib.h>
#include <lua.h>
#include <lualib.h>
#include <stdio.h>
#include <string.h>

#include "celspan/lua.h"
#include "inside/context.h"
#include "inside/hash.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/named.h"
#include "lua/bind/userdata.h"
#include "lua/bind/warnings.h"
#include "lua/module/lua_script.h"
#include "lua/module/native.h"
#include "lua/module/parameters.h"
#include "plugins/sound/loudness.h"
#include "plugins/sound/sound.h"
#include "plugins/sound/spectrum.h"
#include "process/interrupt.h"
#include "program/film/confine.h"
#include "program/film/movies.h"
#include "program/film/output.h"
#include "program/film/view.h"
#include "program/options/request.h"
#include "program/report/text_file.h"

/* The states that a signal interrupts: the verb's, and the state of the script that ran last;
 * NULL: none. */
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

/* ---------------------------------------------------------------- settings */

/* The values that --set and --set-from give to the parameters of a script: read from the options
 * and the file, then given to its state (lua/module/parameters.h). */

typedef struct script_settings {
  const cs_request *request; /* borrowed */
  const char *path;          /* the path of --set-from; NULL: it was not given */
  cs_text_file json;         /* the text of that file */
} script_settings;

/* Reads the file of --set-from before the script's rules forbid this. OK, or reported; *out may be
 * closed in both cases. */
static cs_exit open_settings(celspan_context *context, const cs_request *request,
                             script_settings *out) {
  *out = (script_settings){.request = request, .path = cs_request_text(request, "--set-from")};
  if (!out->path)
    return CS_EXIT_OK;
  FILE *file = fopen(out->path, "rbe");
  if (!file) {
    cs_report_error("--set-from %s: %s", out->path, strerror(errno));
    return CS_EXIT_INPUT;
  }
  cs_exit outcome = cs_text_file_read(context, file, "--set-from ", out->path, &out->json);
  fclose(file);
  return outcome;
}

static void hash_one(void *user, const char *name, const char *value) {
  if (strcmp(name, "--set") == 0)
    cs_hash_text(user, value);
}

/* The hash of all inputs of the script: its arguments, and the values of its parameters. */
static cs_hash hash_settings(const script_settings *settings) {
  const cs_request *request = settings->request;
  cs_hash hash = cs_hash_begin(request->script_argument_count);
  for (size_t i = 0; i < request->script_argument_count; i++)
    cs_hash_text(&hash, request->script_arguments[i]);
  cs_hash_bytes(&hash, settings->json.bytes, settings->json.size);
  cs_request_each(request, hash_one, &hash);
  return cs_hash_end(hash);
}

static void give_one(void *user, const char *name, const char *value) {
  if (strcmp(name, "--set") != 0)
    return;
  size_t length = strcspn(value, "=");
  cs_parameters_give(user, "--set: ", value, length, value + length + 1);
}

/* light userdata: the settings. Runs protected. */
static int give_all(lua_State *L) {
  const script_settings *settings = lua_touserdata(L, 1);
  if (settings->path)
    cs_parameters_give_json(L, settings->path, settings->json.bytes, settings->json.size);
  cs_request_each(settings->request, give_one, L);
  return 0;
}

/* Gives the settings to a state that has celspan. */
static cs_exit give_settings(lua_State *L, script_settings *settings) {
  lua_pushcfunction(L, give_all);
  lua_pushlightuserdata(L, settings);
  return lua_pcall(L, 1, 0, 0) == LUA_OK ? CS_EXIT_OK : cs_script_report_start(L);
}

cs_exit cs_script_give_settings(celspan_context *context, const cs_request *request, lua_State *L) {
  script_settings settings;
  cs_exit outcome = open_settings(context, request, &settings);
  if (outcome == CS_EXIT_OK)
    outcome = give_settings(L, &settings);
  cs_text_file_close(context, &settings.json);
  return outcome;
}

/* ---------------------------------------------------------------- sounds */

/* What is measured of a sound; all zero: nothing. */
typedef struct heard {
  cs_loudness loudness;
  cs_spectrum spectrum;
} heard;

static int release(lua_State *L) {
  heard *held = lua_touserdata(L, 1);
  if (held->loudness.sums)
    cs_loudness_finish(&held->loudness, cs_host_context(L));
  if (held->spectrum.steps)
    cs_spectrum_finish(&held->spectrum, cs_host_context(L));
  return 0;
}

/* The paths at 1 and 2, and room that is released in any case, pushed. */
static heard *begin_hearing(lua_State *L, const char **path, const char **tried) {
  *path = luaL_checkstring(L, 1);
  *tried = luaL_optstring(L, 2, NULL);
  return cs_userdata_push_holder(L, "celspan.program.heard", sizeof(heard), release);
}

/* (path, tried | nil) -> seconds, sums | nil, message */
static int hear(lua_State *L) {
  const char *path, *tried;
  cs_loudness *loudness = &begin_hearing(L, &path, &tried)->loudness;
  CS_HOST_TRY(L, cs_loudness_measure(cs_host_context(L), path, tried, loudness));
  lua_pushnumber(L, (double)loudness->moments / CS_SOUND_HEARD_RATE);
  lua_pushlstring(L, (const char *)loudness->sums, loudness->count * sizeof *loudness->sums);
  return 2;
}

/* (path, tried | nil) -> levels | nil, message */
static int hear_spectrum(lua_State *L) {
  const char *path, *tried;
  cs_spectrum *spectrum = &begin_hearing(L, &path, &tried)->spectrum;
  CS_HOST_TRY(L, cs_spectrum_measure(cs_host_context(L), path, tried, spectrum));
  lua_pushlstring(L, (const char *)spectrum->steps, spectrum->count * sizeof *spectrum->steps);
  return 1;
}

/* Gives the scripts of a state, which has a context, the functions for the loudness and the
 * spectrum of files, for lua/celspan/read/sound.lua. Raises. */
static void give_sounds(lua_State *L) {
  lua_pushcfunction(L, hear);
  lua_setfield(L, LUA_REGISTRYINDEX, CS_NATIVE_HEAR);
  lua_pushcfunction(L, hear_spectrum);
  lua_setfield(L, LUA_REGISTRYINDEX, CS_NATIVE_SPECTRUM);
}

/* ---------------------------------------------------------------- the state */

/* Text that a script prints goes to standard error, because standard output is for results. A
 * script cannot end the program: otherwise a run that did nothing could look complete. */
static const char HOUSE_RULES[] =
    "local show, pack, concat, tostring = ..., table.pack, table.concat, tostring\n"
    "io.output(io.stderr)\n"
    "function print(...)\n"
    "  local words = pack(...)\n"
    "  for i = 1, words.n do words[i] = tostring(words[i]) end\n"
    "  show(concat(words, '\\t') .. '\\n')\n"
    "end\n"
    "function os.exit() error('os.exit: a script cannot end celspan; raise an error', 2) end\n";

int cs_script_show(lua_State *L) {
  size_t size;
  const char *text = luaL_checklstring(L, 1, &size);
  cs_report_printed(NULL, text, size);
  return 0;
}

/* Opens the functions of a trusted script. If the script has limits, its pcall and xpcall do not
 * catch an exceeded limit, but pass it on. */
static void open_trusted(lua_State *L, bool has_limits) {
  static const luaL_Reg catching[] = {
      {"pcall", cs_guard_pcall}, {"xpcall", cs_guard_xpcall}, {NULL, NULL}};
  if (luaL_loadstring(L, HOUSE_RULES) != LUA_OK)
    lua_error(L);
  lua_pushcfunction(L, cs_script_show);
  lua_call(L, 1, 0);
  lua_pushglobaltable(L);
  luaL_setfuncs(L, has_limits ? catching : catching + 2, 0);
  lua_pop(L, 1);
}

static int print_nothing(lua_State *L) {
  (void)L;
  return 0;
}

/* light userdata: the script, and its confinement or nothing. Runs protected. Nothing of what is
 * made here could be collected. */
static int prepare(lua_State *L) {
  cs_script *script = lua_touserdata(L, 1);
  const cs_confined *confined = lua_touserdata(L, 2);
  lua_gc(L, LUA_GCSTOP);
  if (script->is_trusted) { /* otherwise the sandbox opens what it gives to scripts */
    luaL_openlibs(L);
    open_trusted(L, confined);
  }
  cs_host_open(L, script->context);
  if (script->asks_files) {
    cs_host_remember_asked(L);
    cs_named_keep_callers(L, true);
  }
  if (script->asks_warnings) {
    cs_warnings_keep(L);
    cs_named_keep_words(L, true);
  }
  if (confined) {
    script->sandbox = cs_sandbox_open(L, &confined->limits, confined->is_trusted);
    script->sandbox->guard.has_options = true;
  }
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  give_sounds(L);
  cs_movies_give(L);
  if (script->is_silent) {
    lua_pushcfunction(L, print_nothing);
    lua_setglobal(L, "print");
  }
  lua_gc(L, LUA_GCRESTART);
  return 0;
}

/* Whether a message says that memory is missing, for Lua or for the first values of the module. At
 * this time there may be no context with a status yet, but all such messages contain this word. */
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

/* Reads the settings before the sandbox is entered, because the sandbox forbids reading their
 * file. */
static cs_exit start_script(cs_script *out, const cs_request *request, const char *path) {
  script_settings settings;
  cs_confined confined;
  bool is_confined = cs_confine_is_needed(request);
  cs_exit outcome = open_settings(out->context, request, &settings);
  if (outcome == CS_EXIT_OK && is_confined)
    outcome = cs_confine_open(request, path, &confined);
  if (outcome == CS_EXIT_OK)
    outcome = start(out, is_confined ? &confined : NULL);
  if (outcome == CS_EXIT_OK)
    outcome = give_settings(out->L, &settings);
  out->given = hash_settings(&settings);
  cs_text_file_close(out->context, &settings.json);
  return outcome;
}

cs_exit cs_script_open(celspan_context *context, const cs_request *request, const char *path,
                       bool is_silent, cs_script *out) {
  *out =
      (cs_script){.context = context,
                  .is_trusted = cs_request_has(request, "--trust"),
                  .asks_files = request->verb->asks_files || cs_request_has(request, "--files") ||
                                (request->output && request->output->asks_files),
                  .asks_warnings = request->verb->asks_warnings && !is_silent,
                  .is_silent = is_silent};
  CS_TRY_EXIT(start_script(out, request, path));
  const int count = (int)request->script_argument_count;
  const char *const *arguments = (const char *const *)request->script_arguments;
  celspan_status status = request->script
                              ? celspan_lua_run_text(out->L, "-", request->script,
                                                     request->script_size, count, arguments)
                              : celspan_lua_run(out->L, path, count, arguments);
  if (status == CELSPAN_BAD_ARGUMENT && cs_parameters_are_refused(out->L))
    return cs_report_usage("%s", celspan_context_error(context));
  if (status != CELSPAN_OK)
    return cs_report_failure(context, status, NULL);
  lua_pushcfunction(out->L, read_film);
  lua_pushvalue(out->L, CS_SCRIPT_FILM);
  lua_pushlightuserdata(out->L, &out->film);
  int raised = lua_pcall(out->L, 2, 0, 0);
  return raised == LUA_OK ? CS_EXIT_OK
                          : cs_report_failure(context, cs_lua_error_report(out->L, raised), NULL);
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
