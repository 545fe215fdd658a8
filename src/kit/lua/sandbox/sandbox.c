#include "lua/sandbox/sandbox.h"

#include <errno.h>
#include <lauxlib.h>
#include <lualib.h>
#include <string.h>

#include "inside/context.h"
#include "inside/description.h"
#include "inside/scene.h"
#include "lua/bind/caller.h"
#include "lua/bind/files.h"
#include "lua/bind/globals.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/require.h"
#include "lua/sandbox/library.h"

/* ---------------------------------------------------------------- roots */

/* The folder of a template ends with the last slash before its '?'. */
static bool add_template_root(cs_roots *roots, const char *text, size_t length) {
  char folder[4096];
  size_t end = 0, mark = strcspn(text, "?;");
  for (size_t i = 0; i < mark && i < length; i++)
    if (text[i] == '/')
      end = i ? i : 1;
  if (end >= sizeof folder) {
    errno = ENAMETOOLONG;
    return false;
  }
  memcpy(folder, text, end);
  folder[end] = '\0';
  return cs_roots_add(roots, folder);
}

bool cs_sandbox_add_roots(const celspan_lua_limits *limits, cs_roots *roots) {
  const char *search = limits->search ? limits->search : "";
  bool is_good = true;
  for (size_t i = 0; i < limits->folder_count && is_good; i++)
    is_good = cs_roots_add(roots, limits->folders[i]);
  for (size_t length; *search && is_good; search += length + (search[length] == ';')) {
    length = strcspn(search, ";");
    is_good = !length || add_template_root(roots, search, length);
  }
  return is_good;
}

/* Pushes the places in which require searches after the script's folder. */
static const char *push_search(lua_State *L, const celspan_lua_limits *limits) {
  lua_pushliteral(L, "");
  for (size_t i = 0; i < limits->folder_count; i++) {
    const char *folder = limits->folders[i];
    lua_pushfstring(L, "%s/?.lua;%s/?/init.lua;", folder, folder);
    lua_concat(L, 2);
  }
  lua_pushstring(L, limits->search ? limits->search : "");
  lua_concat(L, 2);
  return lua_tostring(L, -1);
}

/* ---------------------------------------------------------------- rules */

static void begin(void *user, lua_State *L, cs_host_call call, int64_t number) {
  cs_sandbox *sandbox = user;
  bool is_begun = cs_guard_begin(&sandbox->guard, L, call);
  if (is_begun && call == CS_HOST_FRAME && sandbox->rules.admit)
    cs_library_seed(L, (uint64_t)number);
}

static void end(void *user) { cs_guard_end(&((cs_sandbox *)user)->guard); }

static bool admits(void *user, const char *path) {
  return cs_roots_hold(&((const cs_sandbox *)user)->roots, path);
}

static bool allow(void *user, const char *folder) {
  cs_roots *roots = &((cs_sandbox *)user)->roots;
  return cs_roots_hold(roots, folder[0] ? folder : ".") || cs_roots_add(roots, folder);
}

static void admit(void *user, lua_State *L, const char *path) {
  const cs_sandbox *sandbox = user;
  errno = 0;
  if (admits(user, path))
    return;
  if (errno == ENOMEM)
    cs_host_try(L, path, cs_fail_memory(cs_host_context(L)));
  else
    cs_caller_error(
        L, "%s: scripts in the sandbox can read only files in %s%s%s", path,
        sandbox->roots.count ? sandbox->roots.paths[sandbox->roots.count - 1] : "their folder",
        cs_guard_hint(&sandbox->guard, " (--allow DIR adds a folder"),
        cs_guard_hint(&sandbox->guard,
                      cs_files_is_font(path) ? ", --allow-system-fonts those of fonts)" : ")"));
}

static bool may_write(void *user, lua_State *L, const char *path) {
  const cs_sandbox *sandbox = user;
  return celspan_context_fail(cs_host_context(L), CELSPAN_OUTPUT,
                              "%.500s: scripts in the sandbox cannot write files%s", path,
                              cs_guard_hint(&sandbox->guard, " (--trust gives all of Lua)")) ==
         CELSPAN_OK;
}

static const char *limit(void *user, int outcome, const char *message) {
  return cs_guard_limit(&((cs_sandbox *)user)->guard, outcome, message);
}

static void charge(void *user, lua_State *L, uint64_t steps) {
  (void)user;
  cs_guard_charge(L, steps);
}

static void starve(void *user, lua_State *L, const char *sentence) {
  (void)user;
  cs_guard_starve(L, sentence);
}

static void close(void *user) { cs_guard_detach(&((cs_sandbox *)user)->guard); }

static void attach(cs_sandbox *sandbox, lua_State *L, bool is_trusted) {
  sandbox->rules = (cs_host_rules){.user = sandbox,
                                   .begin = begin,
                                   .end = end,
                                   .admits = is_trusted ? NULL : admits,
                                   .admit = is_trusted ? NULL : admit,
                                   .allow = is_trusted ? NULL : allow,
                                   .may_write = is_trusted ? NULL : may_write,
                                   .limit = limit,
                                   .charge = charge,
                                   .starve = starve,
                                   .close = close};
  cs_host_get(L)->rules = &sandbox->rules;
  cs_guard_attach(&sandbox->guard, L, cs_host_context(L));
}

/* ---------------------------------------------------------------- celspan's own modules */

/* io.open for celspan's modules. upvalue 1: Lua's io.open. */
static int open_file(lua_State *L) {
  const char *path = luaL_checkstring(L, 1), *mode = luaL_optstring(L, 2, "r");
  if (mode[0] != 'r' || strchr(mode, '+')) {
    if (!cs_host_may_write(L, path))
      return cs_host_fail(L, CELSPAN_CALLBACK);
  } else {
    cs_host_admit(L, path);
  }
  lua_settop(L, 2);
  return cs_library_call(L);
}

/* os.remove and os.rename for celspan's modules. upvalue 1: Lua's function. */
static int change_file(lua_State *L) {
  for (int i = 1; i <= lua_gettop(L); i++)
    if (!cs_host_may_write(L, luaL_checkstring(L, i)))
      return luaL_error(L, "%s", celspan_context_error(cs_host_context(L)));
  return cs_library_call(L);
}

/* Limits a library in the table on top to the named functions, each wrapped in `function`. */
static void wrap_library(lua_State *L, const char *name, lua_CFunction opener,
                         const char *const *names, lua_CFunction function) {
  luaL_requiref(L, name, opener, 0);
  lua_newtable(L);
  for (; *names; names++) {
    lua_getfield(L, -2, *names);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, *names);
  }
  lua_setfield(L, -3, name);
  lua_pop(L, 1);
}

static int refuse_call(lua_State *L) {
  return luaL_error(L, "the text \"%s\" is no function; the curve of that name is ease(\"%s\")",
                    lua_tostring(L, 1), lua_tostring(L, 1));
}

static void seal_texts(lua_State *L) {
  lua_pushliteral(L, "");
  lua_getmetatable(L, -1);
  cs_library_push_string(L);
  lua_pushvalue(L, -1);
  lua_setfield(L, -3, "__index");
  lua_pushcfunction(L, refuse_call);
  lua_setfield(L, -3, "__call");
  lua_pushliteral(L, "string");
  lua_setfield(L, -3, "__metatable");
  lua_insert(L, -3);
  lua_pop(L, 2); /* the table of functions remains */
}

static void open_libraries(lua_State *L) {
  static const luaL_Reg libraries[] = {
      {LUA_GNAME, luaopen_base},       {LUA_STRLIBNAME, luaopen_string},
      {LUA_TABLIBNAME, luaopen_table}, {LUA_MATHLIBNAME, luaopen_math},
      {LUA_UTF8LIBNAME, luaopen_utf8}, {LUA_COLIBNAME, luaopen_coroutine}};
  for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
    luaL_requiref(L, libraries[i].name, libraries[i].func, 1);
    lua_pop(L, 1);
  }
}

/* Restricts the globals of celspan's own chunks: files only by the rules, and no function that
 * could evade them. */
static void close_own(lua_State *L) {
  static const char *const of_io[] = {"open", NULL}, *const of_os[] = {"remove", "rename", NULL};
  static const char *const gone[] = {"load", "loadfile", "dofile",  "collectgarbage",
                                     "warn", "debug",    "package", NULL};
  static const luaL_Reg own[] = {
      {"pcall", cs_guard_pcall}, {"xpcall", cs_guard_xpcall}, {NULL, NULL}};
  cs_require_push_globals(L);
  wrap_library(L, "io", luaopen_io, of_io, open_file);
  wrap_library(L, "os", luaopen_os, of_os, change_file);
  seal_texts(L);
  lua_setfield(L, -2, "string");
  for (int i = 0; gone[i]; i++) {
    lua_pushnil(L);
    lua_setfield(L, -2, gone[i]);
  }
  luaL_setfuncs(L, own, 0);
  lua_pop(L, 1);
}

/* ---------------------------------------------------------------- the script's globals */

/* For names of Lua that the sandbox does not have: reading one raises an error that says so. */
static int tell_absent(lua_State *L) {
  static const char *const absent[] = {"io",     "os",       "debug",          "package",
                                       "dofile", "loadfile", "collectgarbage", "warn"};
  const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
  for (size_t i = 0; i < sizeof absent / sizeof *absent; i++)
    if (strcmp(name, absent[i]) == 0)
      return cs_caller_error(L, "%s is not in the sandbox%s%s", name,
                             i == 0 ? "; csv.read and json.read read tables" : "",
                             cs_guard_hint(cs_guard_of(L), " (--trust gives scripts all of Lua)"));
  return 0;
}

static void push_utf8(lua_State *L) {
  static const char *const names[] = {"char", "charpattern", "codepoint", "codes",
                                      "len",  "offset",      NULL};
  lua_getglobal(L, "utf8");
  lua_newtable(L);
  cs_library_copy_fields(L, lua_gettop(L) - 1, names);
  lua_remove(L, -2);
}

static void add_libraries(lua_State *L) {
  cs_library_push_string(L);
  lua_setfield(L, -2, "string");
  cs_library_push_table(L);
  lua_setfield(L, -2, "table");
  cs_library_push_math(L);
  lua_setfield(L, -2, "math");
  cs_library_push_coroutine(L);
  lua_setfield(L, -2, "coroutine");
  push_utf8(L);
  lua_setfield(L, -2, "utf8");
}

/* Sets the metatable that finds celspan's names and reports missing ones, in the same way as a
 * script would. */
static void add_absent(lua_State *L) {
  lua_getfield(L, -1, "setmetatable");
  lua_pushvalue(L, -2);
  lua_createtable(L, 0, 1);
  cs_globals_push_found(L, tell_absent);
  lua_setfield(L, -2, "__index");
  lua_call(L, 2, 0);
}

/* Makes the script's globals the globals of the state. */
static void open_globals(lua_State *L, const char *search) {
  static const char *const same[] = {"assert",   "error",  "ipairs",   "rawequal",
                                     "rawget",   "rawlen", "rawset",   "select",
                                     "tonumber", "type",   "_VERSION", NULL};
  lua_newtable(L);
  int globals = lua_gettop(L);
  lua_pushglobaltable(L);
  lua_pushvalue(L, globals);
  cs_library_copy_fields(L, globals + 1, same);
  cs_library_add_values(L);
  cs_library_add_running(L);
  add_libraries(L);
  lua_pushvalue(L, globals);
  lua_setfield(L, globals, "_G");
  cs_library_push_require(L, globals, search);
  lua_setfield(L, globals, "require");
  add_absent(L);
  lua_settop(L, globals);
  lua_rawseti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
}

/* ---------------------------------------------------------------- the whole */

static void finish(cs_sandbox *sandbox) {
  cs_memory *memory = sandbox->memory;
  cs_guard_finish(&sandbox->guard);
  cs_roots_finish(&sandbox->roots);
  cs_mem_free(memory, sandbox, sizeof *sandbox);
  cs_memory_unref(memory);
}

static void state_ended(cs_guard *guard) { finish((cs_sandbox *)(void *)guard); }

/* Makes the sandbox, which the state does not own yet. Raises. */
static cs_sandbox *create(lua_State *L, const celspan_lua_limits *limits) {
  celspan_context *context = cs_host_context(L);
  cs_sandbox *sandbox = cs_mem_array(context->memory, 1, sizeof *sandbox);
  if (!sandbox)
    luaL_error(L, "not enough memory");
  *sandbox = (cs_sandbox){.memory = cs_memory_ref(context->memory)};
  cs_guard_init(&sandbox->guard, limits);
  sandbox->guard.ended = state_ended;
  bool is_good = cs_sandbox_add_roots(limits, &sandbox->roots), is_full = errno != ENOMEM;
  if (is_good)
    return sandbox;
  finish(sandbox);
  luaL_error(L, is_full ? "sandbox: scripts can read at most %d folders" : "not enough memory",
             CS_ROOTS_MOST);
  return NULL;
}

cs_sandbox *cs_sandbox_open(lua_State *L, const celspan_lua_limits *limits, bool is_trusted) {
  int top = lua_gettop(L);
  const char *search = push_search(L, limits);
  cs_sandbox *sandbox = create(L, limits);
  attach(sandbox, L, is_trusted);
  if (!is_trusted) {
    open_libraries(L);
    cs_require_forget(L);
    close_own(L);
    open_globals(L, search);
    luaL_requiref(L, "celspan", luaopen_celspan, 0);
  }
  lua_settop(L, top);
  return sandbox;
}

/* ---------------------------------------------------------------- hosts */

static const celspan_lua_limits usual = {.struct_size = sizeof usual,
                                         .memory = (size_t)512 << 20,
                                         .steps = UINT64_C(2000000000),
                                         .seconds = 60,
                                         .print = (size_t)1 << 20};

static const cs_description description = {.type = "celspan_lua_limits",
                                           .defaults = &usual,
                                           .size = sizeof usual,
                                           .needed = sizeof usual.struct_size};

void celspan_lua_limits_default(celspan_lua_limits *out, size_t struct_size) {
  cs_description_write(&description, &usual, out, struct_size);
}

/* light userdata: limits. Runs protected. */
static int open_sandbox(lua_State *L) {
  cs_sandbox_open(L, lua_touserdata(L, 1), false);
  return 0;
}

celspan_status celspan_lua_sandbox(lua_State *L, const celspan_lua_limits *limits) {
  celspan_lua_limits whole;
  const cs_host *host = lua_checkstack(L, 4) ? cs_host_find(L) : NULL;
  if (!host)
    return CELSPAN_BAD_ARGUMENT;
  CS_TRY(cs_description_read(host->context, "sandbox", &description, limits ? limits : &usual,
                             &whole));
  limits = &whole;
  if (host->rules)
    return cs_fail(host->context, CELSPAN_BAD_ARGUMENT, "sandbox: the Lua state has one already");
  if (!(limits->seconds >= 0) || (limits->folder_count && !limits->folders))
    return cs_fail(host->context, CELSPAN_BAD_ARGUMENT,
                   "sandbox: seconds must be 0 or more, and folders a list of folder_count");
  lua_pushcfunction(L, open_sandbox);
  lua_pushlightuserdata(L, (void *)limits);
  int outcome = lua_pcall(L, 1, 0, 0);
  if (outcome == LUA_OK)
    return CELSPAN_OK;
  return cs_lua_error_is_memory(L, outcome) ? cs_lua_error_report(L, outcome)
                                            : cs_lua_error_report_as(L, CELSPAN_BAD_ARGUMENT);
}
