#include "lua/sandbox/sandbox.h"

#include <errno.h>
#include <lauxlib.h>
#include <lualib.h>
#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "lua/bind/caller.h"
#include "lua/sandbox/library.h"

/* ---------------------------------------------------------------- roots */

void cs_sandbox_init(cs_sandbox *sandbox, const cs_limits *limits) {
  *sandbox = (cs_sandbox){.search = NULL};
  cs_guard_init(&sandbox->guard, limits);
}

void cs_sandbox_finish(cs_sandbox *sandbox) {
  cs_guard_finish(&sandbox->guard);
  cs_roots_finish(&sandbox->roots);
  free(sandbox->search);
  sandbox->search = NULL;
}

static bool add_search(cs_sandbox *sandbox, const char *text, size_t length) {
  size_t before = sandbox->search ? strlen(sandbox->search) + 1 : 0;
  char *grown = realloc(sandbox->search, before + length + 1);
  if (!grown)
    return false;
  if (before)
    grown[before - 1] = ';';
  memcpy(grown + before, text, length);
  grown[before + length] = '\0';
  sandbox->search = grown;
  return true;
}

bool cs_sandbox_allow(cs_sandbox *sandbox, const char *folder) {
  static const char *const tails[] = {"/?.lua", "/?/init.lua"};
  char path[4096];
  if (!cs_roots_add(&sandbox->roots, folder))
    return false;
  for (int i = 0; i < 2; i++) {
    int length = snprintf(path, sizeof path, "%s%s", folder, tails[i]);
    if (length >= (int)sizeof path || !add_search(sandbox, path, (size_t)length))
      return false;
  }
  return true;
}

/* The folder of a template ends with the last slash before its '?'. */
static bool allow_template(cs_sandbox *sandbox, const char *text, size_t length) {
  char folder[4096];
  size_t end = 0, mark = strcspn(text, "?;");
  for (size_t i = 0; i < mark; i++)
    if (text[i] == '/')
      end = i ? i : 1;
  if (end >= sizeof folder)
    return false;
  memcpy(folder, text, end);
  folder[end] = '\0';
  return cs_roots_add(&sandbox->roots, folder) && add_search(sandbox, text, length);
}

bool cs_sandbox_allow_search(cs_sandbox *sandbox, const char *search) {
  for (size_t length; *search; search += length + (search[length] == ';')) {
    length = strcspn(search, ";");
    if (length && !allow_template(sandbox, search, length))
      return false;
  }
  return true;
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

static bool is_font(const char *path) {
  static const char *const endings[] = {".ttf", ".otf", ".ttc", ".otc"};
  const char *dot = strrchr(path, '.');
  bool found = false;
  for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
    found |= strcmp(dot, endings[i]) == 0;
  return found;
}

static void admit(void *user, lua_State *L, const char *path) {
  const cs_sandbox *sandbox = user;
  errno = 0;
  if (admits(user, path))
    return;
  if (errno == ENOMEM)
    cs_host_try(L, path, cs_fail_memory(cs_host_context(L)));
  else
    cs_caller_error(L,
                    "%s: scripts in the sandbox can read only files in %s (--allow DIR adds a "
                    "folder%s)",
                    path, sandbox->roots.count ? sandbox->roots.paths[0] : "their folder",
                    is_font(path) ? ", --allow-system-fonts those of fonts" : "");
}

static bool may_write(void *user, lua_State *L, const char *path) {
  const cs_sandbox *sandbox = user;
  if (sandbox->output && strncmp(path, sandbox->output, strlen(sandbox->output)) == 0)
    return true;
  return celspan_context_fail(
             cs_host_context(L), CELSPAN_OUTPUT,
             "%.500s: scripts in the sandbox cannot write files (--trust gives all of Lua)",
             path) == CELSPAN_OK;
}

static const char *limit(void *user, int outcome, const char *message) {
  return cs_guard_limit(&((cs_sandbox *)user)->guard, outcome, message);
}

static void starve(void *user, lua_State *L, const char *sentence) {
  (void)user;
  cs_guard_starve(L, sentence);
}

void cs_sandbox_attach(cs_sandbox *sandbox, lua_State *L, bool is_trusted) {
  sandbox->rules = (cs_host_rules){.user = sandbox,
                                   .begin = begin,
                                   .end = end,
                                   .admits = is_trusted ? NULL : admits,
                                   .admit = is_trusted ? NULL : admit,
                                   .may_write = is_trusted ? NULL : may_write,
                                   .limit = limit,
                                   .starve = starve};
  cs_host_get(L)->rules = &sandbox->rules;
  cs_guard_attach(&sandbox->guard, L, cs_host_context(L));
}

/* ---------------------------------------------------------------- celspan's own modules */

/* io.open for celspan's modules; upvalue 1: Lua's. */
static int open_file(lua_State *L) {
  const char *path = luaL_checkstring(L, 1), *mode = luaL_optstring(L, 2, "r");
  if (mode[0] != 'r' || strchr(mode, '+')) {
    if (!cs_host_may_write(L, path))
      return cs_host_fail(L, CELSPAN_CALLBACK);
  } else {
    cs_host_admit(L, path);
  }
  lua_settop(L, 2);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, 2, LUA_MULTRET);
  return lua_gettop(L);
}

/* os.remove and os.rename for celspan's modules; upvalue 1: Lua's. */
static int change_file(lua_State *L) {
  int count = lua_gettop(L);
  for (int i = 1; i <= count; i++)
    if (!cs_host_may_write(L, luaL_checkstring(L, i)))
      return luaL_error(L, "%s", celspan_context_error(cs_host_context(L)));
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, count, LUA_MULTRET);
  return lua_gettop(L);
}

/* Makes the named functions of a library global, each wrapped in `function`; the library itself is
 * not accessible. */
static void open_guarded(lua_State *L, const char *name, lua_CFunction opener,
                         const char *const *names, lua_CFunction function) {
  lua_pushcfunction(L, opener);
  lua_call(L, 0, 1);
  lua_newtable(L);
  for (; *names; names++) {
    lua_getfield(L, -2, *names);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, *names);
  }
  lua_setglobal(L, name);
  lua_pop(L, 1);
}

static void seal_texts(lua_State *L) {
  lua_pushliteral(L, "");
  lua_getmetatable(L, -1);
  cs_library_push_string(L);
  lua_pushvalue(L, -1);
  lua_setfield(L, -3, "__index");
  lua_pushliteral(L, "string");
  lua_setfield(L, -3, "__metatable");
  lua_insert(L, -3);
  lua_pop(L, 2); /* the table of functions stays */
}

void cs_sandbox_open_libraries(lua_State *L) {
  static const luaL_Reg libraries[] = {
      {LUA_GNAME, luaopen_base},       {LUA_STRLIBNAME, luaopen_string},
      {LUA_TABLIBNAME, luaopen_table}, {LUA_MATHLIBNAME, luaopen_math},
      {LUA_UTF8LIBNAME, luaopen_utf8}, {LUA_COLIBNAME, luaopen_coroutine}};
  static const char *const of_io[] = {"open", NULL}, *const of_os[] = {"remove", "rename", NULL};
  for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
    luaL_requiref(L, libraries[i].name, libraries[i].func, 1);
    lua_pop(L, 1);
  }
  open_guarded(L, "io", luaopen_io, of_io, open_file);
  open_guarded(L, "os", luaopen_os, of_os, change_file);
}

/* ---------------------------------------------------------------- the script's globals */

/* Names that Lua has and the sandbox does not: reading one raises an error that says so. */
static int tell_absent(lua_State *L) {
  static const char *const absent[] = {"io",     "os",       "debug",          "package",
                                       "dofile", "loadfile", "collectgarbage", "warn"};
  const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
  for (size_t i = 0; i < sizeof absent / sizeof *absent; i++)
    if (strcmp(name, absent[i]) == 0)
      return cs_caller_error(L, "%s is not in the sandbox (--trust gives scripts all of Lua)",
                             name);
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

/* Sets the metatable that reports missing names, in the same way as a script would. */
static void add_absent(lua_State *L) {
  lua_getfield(L, -1, "setmetatable");
  lua_pushvalue(L, -2);
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, tell_absent);
  lua_setfield(L, -2, "__index");
  lua_call(L, 2, 0);
}

static void close_own(lua_State *L) {
  static const char *const gone[] = {"load", "loadfile", "dofile", "collectgarbage", "warn", NULL};
  static const luaL_Reg own[] = {
      {"pcall", cs_guard_pcall}, {"xpcall", cs_guard_xpcall}, {NULL, NULL}};
  seal_texts(L);
  lua_setglobal(L, "string");
  lua_pushglobaltable(L);
  for (int i = 0; gone[i]; i++) {
    lua_pushnil(L);
    lua_setfield(L, -2, gone[i]);
  }
  luaL_setfuncs(L, own, 0);
  lua_pop(L, 1);
}

void cs_sandbox_open_globals(cs_sandbox *sandbox, lua_State *L) {
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
  cs_library_push_require(L, globals, sandbox->search);
  lua_setfield(L, globals, "require");
  add_absent(L);
  lua_settop(L, globals);
  cs_host_set_globals(L);
  close_own(L);
}
