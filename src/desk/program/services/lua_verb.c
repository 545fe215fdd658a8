#include "program/services/lua_verb.h"

#include <limits.h>
#include <lualib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "celspan/lua.h"
#include "inside/context.h"
#include "inside/module.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/put.h"
#include "lua/bind/require.h"
#include "program/film/movies.h"
#include "program/film/script.h"
#include "program/film/service.h"
#include "program/options/verbs.h"
#include "program/outputs/outputs.h"
#include "program/report/verb_text.h"

enum { FOLDER_SIZE = 4096 };

/* ---------------------------------------------------------------- the request */

/* The option "--job-name" becomes the field job_name, and "-o" becomes output. */
static void push_field_name(lua_State *L, const char *option) {
  if (strcmp(option, "-o") == 0)
    lua_pushliteral(L, "output");
  else
    luaL_gsub(L, option + 2, "-", "_");
}

/* request, given: adds an option to both. Values are the given texts, which their readers have
 * accepted; for a flag, true. */
static void set_option(void *user, const char *name, const char *value) {
  lua_State *L = user;
  push_field_name(L, name);
  if (value)
    lua_pushstring(L, value);
  else
    lua_pushboolean(L, true);
  lua_rawset(L, -4);
  lua_createtable(L, 0, 2);
  cs_put_text(L, "name", name);
  cs_put_text(L, "value", value);
  lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1);
}

static void push_texts(lua_State *L, const char *const *texts, size_t count) {
  lua_createtable(L, (int)count, 8);
  for (size_t i = 0; i < count; i++) {
    lua_pushstring(L, texts[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

/* request[1], ...: the operands; request.job_name: an option; request.arguments: for the script;
 * request.verb: the name of the verb; request.script: the text of the script "-"; request.given:
 * the options in order, { name = "--job-name", value = "walk" }. */
static void push_request(lua_State *L, const cs_request *request) {
  push_texts(L, request->operands, request->operand_count);
  push_texts(L, (const char *const *)request->script_arguments, request->script_argument_count);
  lua_setfield(L, -2, "arguments");
  cs_put_text(L, "verb", request->verb->name);
  if (request->script) {
    lua_pushlstring(L, request->script, request->script_size);
    lua_setfield(L, -2, "script");
  }
  lua_newtable(L);
  cs_request_each(request, set_option, L);
  lua_setfield(L, -2, "given");
}

/* ---------------------------------------------------------------- the verbs */

static void push_options(lua_State *L, const cs_verb *verb) {
  lua_Integer count = 0;
  lua_newtable(L);
  for (const char *at = verb->options; *at;) {
    const cs_option *option = cs_verb_option(verb, &at);
    lua_createtable(L, 0, 3);
    cs_put_text(L, "name", option->name);
    cs_put_text(L, "value", option->value);
    cs_put_text(L, "allowed", option->kind ? option->kind->allowed : NULL);
    cs_put_text(L, "help", option->help);
    if (option->kind == &cs_argument_format)
      cs_put_flag(L, "is_format", true);
    lua_rawseti(L, -2, ++count);
  }
}

/* verbs() -> a description of each verb: { name =, operands =, summary =, notes =, has_script =,
 * options = { { name =, value =, allowed =, help =, is_format = }, ... } }; is_format: its values
 * are the names of outputs() */
static int push_verbs(lua_State *L) {
  lua_newtable(L);
  for (const cs_verb *verb = cs_verbs; verb->name; verb++) {
    if (verb->is_hidden)
      continue;
    lua_createtable(L, 0, 6);
    cs_put_text(L, "name", verb->name);
    cs_put_text(L, "operands", verb->operands);
    cs_put_text(L, "summary", verb->summary);
    cs_put_text(L, "notes", verb->notes);
    cs_put_flag(L, "has_script", verb->has_script);
    push_options(L, verb);
    lua_setfield(L, -2, "options");
    lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1);
  }
  return 1;
}

/* Pushes the words of a text, between spaces or commas. */
static void push_words(lua_State *L, const char *text) {
  lua_newtable(L);
  for (lua_Integer i = 1; *(text += strspn(text, " ,")); i++) {
    size_t size = strcspn(text, " ,");
    lua_pushlstring(L, text, size);
    lua_rawseti(L, -2, i);
    text += size;
  }
}

/* outputs() -> the rows of outputs.c: { kind =, names = { "png", ... }, makers = { verb, ... },
 * takes = { option, ... }, offers = }; makers nil: all verbs that write pictures */
static int push_outputs(lua_State *L) {
  char names[CS_OUTPUT_NAMES];
  lua_newtable(L);
  for (const cs_output *output = cs_outputs; output->kind; output++) {
    cs_output_names(output, names);
    lua_createtable(L, 0, 5);
    cs_put_text(L, "kind", output->kind);
    cs_put_text(L, "offers", output->offers);
    push_words(L, names);
    lua_setfield(L, -2, "names");
    push_words(L, output->takes);
    lua_setfield(L, -2, "takes");
    if (output->makers)
      push_words(L, output->makers);
    else
      lua_pushnil(L);
    lua_setfield(L, -2, "makers");
    lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1);
  }
  return 1;
}

/* ---------------------------------------------------------------- the state */

/* __index of globals: a library is opened when it, or its `require`, is first named. */
static int open_library(lua_State *L) {
  static const luaL_Reg libraries[] = {{LUA_IOLIBNAME, luaopen_io},
                                       {LUA_OSLIBNAME, luaopen_os},
                                       {LUA_MATHLIBNAME, luaopen_math},
                                       {LUA_TABLIBNAME, luaopen_table},
                                       {LUA_UTF8LIBNAME, luaopen_utf8},
                                       {LUA_COLIBNAME, luaopen_coroutine},
                                       {LUA_DBLIBNAME, luaopen_debug},
                                       {LUA_LOADLIBNAME, luaopen_package},
                                       {NULL, NULL}};
  const luaL_Reg *one = libraries;
  const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
  const char *library = strcmp(name, "require") == 0 ? LUA_LOADLIBNAME : name;
  while (one->name && strcmp(one->name, library) != 0)
    one++;
  if (!one->name)
    return 0;
  luaL_requiref(L, library, one->func, 1);
  lua_pushglobaltable(L);
  lua_pushvalue(L, 2);
  lua_rawget(L, -2);
  lua_pushvalue(L, -1);
  lua_setfield(L, 1, name);
  return 1;
}

/* A verb that runs chunks of others gives them all libraries. The other modules of celspan come
 * with the module of this name. */
static void open_libraries(lua_State *L, celspan_context *context, bool has_others) {
  static const luaL_Reg modules[] = {{"celspan", luaopen_celspan}, {NULL, NULL}};
  static const luaL_Reg opening[] = {{"__index", open_library}, {NULL, NULL}};
  if (has_others) {
    luaL_openlibs(L);
  } else {
    luaL_requiref(L, LUA_GNAME, luaopen_base, 1);
    luaL_requiref(L, LUA_STRLIBNAME, luaopen_string, 1);
    cs_require_push_globals(L);
    luaL_newlib(L, opening);
    lua_pushvalue(L, -1);
    lua_setmetatable(L, -3); /* for these globals, and for those of the state */
    lua_setmetatable(L, 1);
    lua_settop(L, 0);
  }
  cs_host_open(L, context);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
  luaL_setfuncs(L, modules, 0);
  lua_pop(L, 1);
  cs_movies_give(L);
}

/* Whether the annotations are in this folder. */
static bool holds_annotations(const char *folder) {
  char path[FOLDER_SIZE + 32];
  snprintf(path, sizeof path, "%s/celspan.d.lua", folder);
  return access(path, R_OK) == 0;
}

/* annotations() -> their folder: where they were installed; otherwise beside the program, in a
 * build folder or in an installation that was moved. */
static int push_annotations(lua_State *L) {
  static const char *const beside[] = {"../share/celspan/annotations", "lua"};
  char own[FOLDER_SIZE / 2], folder[FOLDER_SIZE], found[PATH_MAX];
  bool is_known = cs_program_folder(own, sizeof own);
  bool is_there = holds_annotations(CS_ANNOTATIONS);
  lua_pushstring(L, CS_ANNOTATIONS);
  for (size_t i = 0; is_known && !is_there && i < sizeof beside / sizeof *beside; i++) {
    snprintf(folder, sizeof folder, "%s/%s", own, beside[i]);
    is_there = holds_annotations(folder) && realpath(folder, found);
    if (is_there)
      lua_pushstring(L, found);
  }
  return 1;
}

static const luaL_Reg own_services[] = {{"verbs", push_verbs},
                                        {"outputs", push_outputs},
                                        {"annotations", push_annotations},
                                        {NULL, NULL}};

/* program.NAME, for the first time: services are looked for when a verb needs them. */
static int find_service(lua_State *L) {
  static const luaL_Reg *const lists[] = {own_services,
                                          cs_services_compare,
                                          cs_services_reports,
                                          cs_services_script,
                                          cs_services_files,
                                          cs_services_pictures,
                                          cs_services_processes,
                                          cs_services_renderers,
                                          cs_services_shown,
                                          cs_services_stage,
                                          cs_services_watchers,
                                          cs_services_web,
                                          NULL};
  cs_session *session = cs_service_session(L);
  if (cs_service_find(L, lists))
    return 1;
  if (session->has_shared)
    return 0;
  cs_built_in_load(L, cs_verb_texts, "", "program.lua");
  lua_pushvalue(L, 1);
  lua_call(L, 1, 0);
  session->has_shared = true;
  lua_pushvalue(L, 2);
  lua_rawget(L, 1);
  return 1;
}

/* Pushes the table of services. */
static void push_program(lua_State *L) {
  static const luaL_Reg finding[] = {{"__index", find_service}, {NULL, NULL}};
  lua_newtable(L);
  cs_put_text(L, "version", celspan_version());
  cs_put_text(L, "maker", cs_context_maker(cs_service_session(L)->context));
  lua_createtable(L, 0, 1);
  cs_service_add(L, finding);
  lua_setmetatable(L, -2);
}

/* Pushes the name of the file of the verb. */
static void push_file(lua_State *L, const cs_request *request) {
  if (!request->verb->plans_rows && cs_request_has(request, "--table"))
    lua_pushliteral(L, "table.lua");
  else if (request->output && request->output->part)
    lua_pushstring(L, request->output->part);
  else
    lua_pushfstring(L, "%s.lua", request->verb->name);
}

/* Upvalue: the session. Returns the verb's exit code, or nothing. Runs protected. Nothing of what
 * is made before the verb runs could be collected. */
static int run(lua_State *L) {
  const cs_session *session = cs_service_session(L);
  lua_gc(L, LUA_GCSTOP);
  open_libraries(L, session->context, session->request->verb->runs_others);
  push_file(L, session->request);
  cs_built_in_load(L, cs_verb_texts, "", lua_tostring(L, -1));
  push_program(L);
  push_request(L, session->request);
  lua_gc(L, LUA_GCRESTART);
  lua_call(L, 2, 1);
  return 1;
}

/* session, light userdata. Making a closure needs memory, so this is done where errors are
 * caught. */
static int begin(lua_State *L) {
  lua_pushcclosure(L, run, 1);
  lua_call(L, 0, 1);
  return 1;
}

static cs_exit outcome_of(lua_State *L, const cs_session *session, int raised) {
  if (raised == LUA_OK)
    return (cs_exit)lua_tointeger(L, -1);
  if (session->outcome != CS_EXIT_OK)
    return session->outcome;
  if (!cs_host_find(L))
    return cs_script_report_start(L);
  return cs_report_failure(session->context, cs_lua_error_report(L, raised), NULL);
}

cs_exit cs_lua_verb_run(celspan_context *context, const cs_request *request) {
  cs_session session = {.context = context, .request = request};
  lua_State *L = luaL_newstate();
  if (!L)
    return cs_script_report_start(NULL);
  lua_pushcfunction(L, begin);
  lua_pushlightuserdata(L, &session);
  cs_script_watch(L);
  cs_exit outcome = outcome_of(L, &session, cs_lua_error_call(L, 1, 1));
  if (session.progress.noun)
    cs_progress_end(&session.progress, (cs_progress_failures){NULL, 0}, (int)outcome);
  cs_script_watch(NULL);
  lua_close(L);
  return outcome;
}
