#include "bind/lua_script.h"

#include <errno.h>
#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>

#include "bind/caller.h"
#include "bind/host.h"
#include "bind/lua_error.h"
#include "bind/lua_film.h"
#include "bind/lua_text.h"
#include "bind/userdata.h"

/* ---------------------------------------------------------------- where require looks */

/* Puts `before` in front of package[field] and removes the current directory from it. */
static void set_path(lua_State *L, const char *field, const char *before, const char *const *here) {
  lua_getglobal(L, "package");
  int package = lua_gettop(L);
  lua_getfield(L, package, field);
  lua_pushfstring(L, ";%s", luaL_optstring(L, -1, ""));
  for (; *here; here++)
    luaL_gsub(L, lua_tostring(L, -1), *here, "");
  const char *rest = lua_tostring(L, -1);
  lua_pushfstring(L, "%s%s", before, before[0] ? rest : rest + (rest[0] == ';'));
  lua_setfield(L, package, field);
  lua_settop(L, package - 1);
}

/* require searches the script's own folder, then $CELSPAN_PATH, then where Lua is installed; the
 * current directory only when the script is there. */
static void set_search_path(lua_State *L, const char *folder) {
  static const char *const here[] = {";./?.lua", ";./?/init.lua", NULL};
  static const char *const here_c[] = {";./?.so", NULL};
  const char *at = folder[0] ? folder : ".", *more = getenv("CELSPAN_PATH");
  const char *before = lua_pushfstring(L, "%s/?.lua;%s/?/init.lua%s%s", at, at,
                                       more && more[0] ? ";" : "", more ? more : "");
  set_path(L, "path", before, here);
  set_path(L, "cpath", "", here_c);
  lua_pop(L, 1);
}

/* ---------------------------------------------------------------- running */

typedef struct call {
  const char *path;
  int argument_count;
  const char *const *arguments;
  bool is_missing;
} call;

/* light userdata -> film. Runs protected. */
static int run(lua_State *L) {
  call *c = lua_touserdata(L, 1);
  const char *folder = cs_caller_push_folder_of(L, c->path);
  cs_host_set_folder(L, folder);
  bool is_sandboxed = cs_host_push_globals(L);
  if (!is_sandboxed)
    set_search_path(L, folder); /* a sandbox has its own `require` */
  if (!cs_lua_text_accepts(c->path))
    return luaL_error(L,
                      "%s: is not a Lua script, but a picture or other binary data ('celspan info "
                      "%s' tells of pictures)",
                      c->path, c->path);
  int outcome = luaL_loadfilex(L, c->path, "t");
  if (outcome == LUA_ERRFILE && strstr(lua_tostring(L, -1), strerror(ENOMEM)))
    lua_pushliteral(L, "not enough memory"); /* for the file's buffer */
  else
    c->is_missing = outcome == LUA_ERRFILE;
  if (outcome == LUA_ERRSYNTAX && cs_lua_error_position(lua_tostring(L, -1)) == 0)
    return luaL_error(L, "%s: %s", c->path, lua_tostring(L, -1)); /* a compiled chunk */
  if (outcome != LUA_OK)
    return lua_error(L);
  if (is_sandboxed) {
    lua_pushvalue(L, -2);
    lua_setupvalue(L, -2, 1);
  }
  luaL_checkstack(L, c->argument_count + 4, "too many arguments");
  for (int i = 0; i < c->argument_count; i++)
    lua_pushstring(L, c->arguments[i]);
  lua_call(L, c->argument_count, 1);
  if (!cs_lua_film_push(L, -1))
    luaL_error(L, "%s must return a film or a rostrum, got %s", c->path, cs_userdata_type(L, -1));
  return 1;
}

celspan_status cs_lua_script_run(lua_State *L, const char *path, int argument_count,
                                 const char *const *arguments) {
  call c = {path, argument_count, arguments, false};
  cs_host_get(L)->failure = CELSPAN_OK;
  lua_pushcfunction(L, run);
  lua_pushlightuserdata(L, &c);
  cs_host_begin(L, CS_HOST_LOAD, 0);
  int outcome = cs_lua_error_call(L, 1, 1);
  cs_host_end(L);
  if (outcome == LUA_OK)
    return CELSPAN_OK;
  return c.is_missing ? cs_lua_error_report_as(L, CELSPAN_INPUT) : cs_lua_error_report(L, outcome);
}
