#include "program/service.h"

#include <lualib.h>
#include <string.h>

#include "celspan/lua.h"
#include "frames/process/interrupt.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/module/core.h"
#include "program/confine.h"
#include "program/script.h"
#include "program/verbs.h"

/* ---------------------------------------------------------------- texts */

const cs_text *cs_service_text(const char *name) {
  const cs_text *text = cs_verb_texts;
  while (strcmp(text->name, name) != 0)
    text++;
  return text;
}

void cs_service_load(lua_State *L, const char *name) {
  const cs_text *text = cs_service_text(name);
  lua_pushfstring(L, "@celspan/%s", name);
  if (luaL_loadbufferx(L, text->bytes, text->size, lua_tostring(L, -1), "t") != LUA_OK)
    lua_error(L);
  lua_remove(L, -2);
}

/* ---------------------------------------------------------------- ends */

cs_program *cs_service_program(lua_State *L) { return lua_touserdata(L, lua_upvalueindex(1)); }

int cs_service_end(lua_State *L, cs_exit outcome) {
  cs_service_program(L)->outcome = outcome;
  return luaL_error(L, "the verb has ended");
}

void cs_service_require(lua_State *L, cs_exit outcome) {
  if (outcome != CS_EXIT_OK)
    cs_service_end(L, outcome);
}

void cs_service_try(lua_State *L, celspan_status status) {
  cs_service_require(L, cs_report_failure(cs_service_program(L)->context, status, NULL));
}

/* ---------------------------------------------------------------- reports */

static int note(lua_State *L) {
  cs_report_note("%s", luaL_checkstring(L, 1));
  return 0;
}

static int report_error(lua_State *L) {
  cs_report_error("%s", luaL_checkstring(L, 1));
  return 0;
}

/* fail(kind, message): reports it and ends the verb. */
static int fail(lua_State *L) {
  static const char *const kinds[] = {"usage", "script", "input", "output", "limit", NULL};
  static const cs_exit codes[] = {CS_EXIT_USAGE, CS_EXIT_SCRIPT, CS_EXIT_INPUT, CS_EXIT_OUTPUT,
                                  CS_EXIT_LIMIT};
  int kind = luaL_checkoption(L, 1, NULL, kinds);
  cs_report_error("%s", luaL_checkstring(L, 2));
  return cs_service_end(L, codes[kind]);
}

/* The exit code of a message that a function of celspan's returned. plain: of one that the core did
 * not set. A library may have caught Lua's own sentence about memory. */
static cs_exit code_of(lua_State *L, const char *message, cs_exit plain) {
  celspan_status status = cs_host_blame(L, message);
  if (status == CELSPAN_NO_MEMORY || strstr(message, "not enough memory"))
    return CS_EXIT_MEMORY;
  return status == CELSPAN_CALLBACK ? plain : cs_report_exit(status);
}

/* Like assert, of a value or nil and a message: reports the message and ends the verb. */
static int check(lua_State *L) {
  if (lua_toboolean(L, 1))
    return lua_gettop(L);
  if (cs_interrupt_signal())
    return cs_service_end(L, CS_EXIT_SIGNAL);
  const char *message = luaL_checkstring(L, 2);
  cs_report_error("%s", message);
  return cs_service_end(L, code_of(L, message, CS_EXIT_SCRIPT));
}

/* The same of a value that was read: what is wrong with it is a fault of the input. With a third
 * argument that is answered instead, unless memory was missing. */
static int check_input(lua_State *L) {
  if (lua_toboolean(L, 1))
    return lua_gettop(L);
  if (cs_interrupt_signal())
    return cs_service_end(L, CS_EXIT_SIGNAL);
  const char *message = luaL_checkstring(L, 2);
  bool is_starved = code_of(L, message, CS_EXIT_INPUT) == CS_EXIT_MEMORY;
  if (lua_isstring(L, 3) && !is_starved)
    return 1;
  cs_report_error("%s", message);
  return cs_service_end(L, is_starved ? CS_EXIT_MEMORY : CS_EXIT_INPUT);
}

/* outcome() -> the exit code of a service that failed where the verb caught that */
static int outcome(lua_State *L) {
  lua_pushinteger(L, cs_service_program(L)->outcome);
  return 1;
}

/* is_stopped() -> whether a signal asked to stop. A verb that asks ends by itself: from then on its
 * Lua is not interrupted. */
static int is_stopped(lua_State *L) {
  cs_script_unwatch();
  lua_pushboolean(L, cs_interrupt_signal() != 0);
  return 1;
}

/* refuse(option): reports that the verb does not take the value that was given. */
static int refuse(lua_State *L) {
  const cs_request *request = cs_service_program(L)->request;
  return cs_service_end(L, cs_request_refuse(request, luaL_checkstring(L, 1)));
}

/* ---------------------------------------------------------------- the request */

/* Refuses the options of scripts, of which this run has none. */
static int refuse_rights(lua_State *L) {
  cs_service_require(L, cs_confine_refuse(cs_service_program(L)->request));
  return 0;
}

/* "--job-name" is the field job_name, "-o" output. */
static void push_field_name(lua_State *L, const char *option) {
  if (strcmp(option, "-o") == 0)
    lua_pushliteral(L, "output");
  else
    luaL_gsub(L, option + 2, "-", "_");
}

/* request, given: adds an option to both. Values are the texts that were given, which their readers
 * have accepted; of a flag, true. */
static void set_option(void *user, const char *name, const char *value) {
  lua_State *L = user;
  push_field_name(L, name);
  if (value)
    lua_pushstring(L, value);
  else
    lua_pushboolean(L, true);
  lua_rawset(L, -4);
  lua_createtable(L, 0, 2);
  lua_pushstring(L, name);
  lua_setfield(L, -2, "name");
  lua_pushstring(L, value);
  lua_setfield(L, -2, "value");
  lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1);
}

static void push_texts(lua_State *L, const char *const *texts, size_t count) {
  lua_createtable(L, (int)count, 8);
  for (size_t i = 0; i < count; i++) {
    lua_pushstring(L, texts[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

/* request[1], ...: its operands; request.job_name: an option; request.arguments: of the script;
 * request.given: the options in their order, { name = "--job-name", value = "walk" }. */
static void push_request(lua_State *L, const cs_request *request) {
  push_texts(L, request->operands, request->operand_count);
  push_texts(L, (const char *const *)request->script_arguments, request->script_argument_count);
  lua_setfield(L, -2, "arguments");
  lua_newtable(L);
  cs_request_each(request, set_option, L);
  lua_setfield(L, -2, "given");
}

/* text(name) -> a text of verbs/ */
static int push_text(lua_State *L) {
  const cs_text *text = cs_service_text(luaL_checkstring(L, 1));
  lua_pushlstring(L, text->bytes, text->size);
  return 1;
}

/* ---------------------------------------------------------------- the verbs */

static void set_text(lua_State *L, const char *name, const char *text) {
  lua_pushstring(L, text);
  lua_setfield(L, -2, name);
}

static void push_options(lua_State *L, const cs_option *options) {
  lua_newtable(L);
  for (lua_Integer i = 1; options->name; i++, options++) {
    lua_createtable(L, 0, 3);
    set_text(L, "name", options->name);
    set_text(L, "value", options->value);
    set_text(L, "help", options->help);
    lua_rawseti(L, -2, i);
  }
}

/* verbs() -> what each verb is and takes: { name =, operands =, summary =, notes =, has_script =,
 * options = { { name =, value =, help = }, ... } } */
static int push_verbs(lua_State *L) {
  lua_newtable(L);
  for (const cs_verb *verb = cs_verbs; verb->name; verb++) {
    if (verb->is_hidden)
      continue;
    lua_createtable(L, 0, 6);
    set_text(L, "name", verb->name);
    set_text(L, "operands", verb->operands);
    set_text(L, "summary", verb->summary);
    set_text(L, "notes", verb->notes);
    lua_pushboolean(L, verb->has_script);
    lua_setfield(L, -2, "has_script");
    push_options(L, verb->options);
    lua_setfield(L, -2, "options");
    lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1);
  }
  return 1;
}

/* ---------------------------------------------------------------- the state */

void cs_service_add(lua_State *L, const luaL_Reg *functions) {
  lua_pushlightuserdata(L, cs_service_program(L));
  luaL_setfuncs(L, functions, 1);
}

static void open_libraries(lua_State *L, celspan_context *context) {
  static const luaL_Reg modules[] = {{"celspan", luaopen_celspan}, {NULL, NULL}};
  luaL_openlibs(L);
  cs_host_open(L, context);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
  luaL_setfuncs(L, modules, 0);
  lua_pop(L, 1);
  cs_embedded_open(L);
}

/* Pushes the table of services. */
static void push_program(lua_State *L) {
  static const luaL_Reg services[] = {{"note", note},
                                      {"error", report_error},
                                      {"fail", fail},
                                      {"check", check},
                                      {"input", check_input},
                                      {"refuse", refuse},
                                      {"refuse_rights", refuse_rights},
                                      {"verbs", push_verbs},
                                      {"outcome", outcome},
                                      {"is_stopped", is_stopped},
                                      {"text", push_text},
                                      {NULL, NULL}};
  lua_newtable(L);
  cs_service_add(L, services);
  set_text(L, "version", celspan_version());
  set_text(L, "annotations", CS_ANNOTATIONS); /* the folder, as it is installed */
  cs_service_add_film(L);
  cs_service_add_files(L);
  cs_service_add_pictures(L);
  cs_service_add_processes(L);
}

/* Upvalue: the program. Returns the verb's exit code, or nothing. Runs protected. */
static int run(lua_State *L) {
  const cs_program *program = cs_service_program(L);
  open_libraries(L, program->context);
  push_program(L);
  push_request(L, program->request);
  cs_service_load(L, "program.lua");
  lua_pushvalue(L, 1);
  lua_call(L, 1, 0);
  lua_pushfstring(L, "%s.lua", program->request->verb->name);
  cs_service_load(L, lua_tostring(L, -1));
  lua_insert(L, 1);
  lua_settop(L, 3);
  lua_call(L, 2, 1);
  return 1;
}

/* program, light userdata. A closure takes memory: so it is made where failing is caught. */
static int begin(lua_State *L) {
  lua_pushcclosure(L, run, 1);
  lua_call(L, 0, 1);
  return 1;
}

static cs_exit outcome_of(lua_State *L, const cs_program *program, int raised) {
  if (raised == LUA_OK)
    return (cs_exit)lua_tointeger(L, -1);
  if (program->outcome != CS_EXIT_OK)
    return program->outcome;
  if (!cs_host_find(L))
    return cs_script_report_start(L);
  return cs_report_failure(program->context, cs_lua_error_report(L, raised), NULL);
}

cs_exit cs_service_run(celspan_context *context, const cs_request *request) {
  cs_program program = {.context = context, .request = request};
  lua_State *L = luaL_newstate();
  if (!L)
    return cs_script_report_start(NULL);
  lua_pushcfunction(L, begin);
  lua_pushlightuserdata(L, &program);
  cs_script_watch(L);
  cs_exit outcome = outcome_of(L, &program, cs_lua_error_call(L, 1, 1));
  cs_script_watch(NULL);
  lua_close(L);
  return outcome;
}
