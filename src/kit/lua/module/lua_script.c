#include "lua/module/lua_script.h"

#include <ctype.h>
#include <errno.h>
#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "celspan/lua.h"
#include "inside/files.h"
#include "lua/bind/caller.h"
#include "lua/bind/globals.h"
#include "lua/bind/host.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/userdata.h"
#include "lua/module/artwork.h"
#include "lua/module/parameters.h"
#include "lua/nouns/lua_film.h"

/* ---------------------------------------------------------------- what is a script */

enum { HEAD = 4096, ESCAPE = 27 };

/* Source texts contain no control codes other than white space and escape. */
static bool is_binary(const char *head, size_t size) {
  for (size_t i = 0; i < size; i++) {
    unsigned char c = (unsigned char)head[i];
    if (c == 127 || (c < 32 && c != ESCAPE && !(c >= '\t' && c <= '\r')))
      return true;
  }
  return false;
}

/* "P6 640 360 ...", with white space or a comment before the width: a PNM file. "P1 = 3" is not
 * one. */
static bool is_pnm(const char *head) {
  if (head[0] != 'P' || !head[1] || !strchr("123456fF", head[1]) ||
      !isspace((unsigned char)head[2]))
    return false;
  const char *next = head + 2 + strspn(head + 2, " \t\r\n");
  return isdigit((unsigned char)*next) || *next == '#';
}

static bool is_text_picture(const char *head) {
  return is_pnm(head) || strncmp(head, "#?RADIANCE", 10) == 0 || strncmp(head, "#?RGBE", 6) == 0;
}

bool cs_lua_script_accepts(const char *path) {
  char head[HEAD + 1];
  struct stat status;
  int descriptor = cs_open_to_read(path);
  bool is_file = descriptor >= 0 && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  ssize_t size = is_file ? read(descriptor, head, HEAD) : 0;
  if (descriptor >= 0)
    close(descriptor);
  if (size <= 0 || head[0] == ESCAPE)
    return true;
  head[size] = '\0';
  return !is_binary(head, (size_t)size) && !is_text_picture(head);
}

/* ---------------------------------------------------------------- where require looks */

/* Puts `before` in front of package[field] and removes the current directory from it. */
static void set_path(lua_State *L, const char *field, const char *before, const char *const *here) {
  if (lua_getglobal(L, "package") != LUA_TTABLE)
    luaL_error(L, "the Lua state has no library 'package', with which scripts find celspan: call "
                  "luaL_openlibs or celspan_lua_sandbox before celspan_lua_run");
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

/* require searches the script's own folder, then $CELSPAN_PATH, then the folders in which Lua is
 * installed; the current directory is only searched if the script is there. */
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
  const char *text; /* NULL: the text of the file */
  size_t size;
  int argument_count;
  const char *const *arguments;
  bool is_missing;
} call;

static int refuse_result(lua_State *L, const char *path) {
  bool is_function = lua_isfunction(L, -1);
  return luaL_error(L, "%s must return a film or a rostrum, got %s%s", path,
                    cs_userdata_type(L, -1),
                    is_function ? ": return celspan.film { frame = ... }" : "");
}

/* The message of all verbs that take films for a file that is not a film. */
static int refuse_file(lua_State *L, const char *path) {
  return luaL_error(L,
                    "%s: is not a Lua script, a drawing, a painting or a movie, but a picture or "
                    "other binary data, which is no film ('celspan info %s' describes it, 'celspan "
                    "convert' makes pictures of it)",
                    path, path);
}

/* Pushes the script as a function, or a message. Returns the outcome of luaL_loadfilex. */
static int load(lua_State *L, call *c) {
  size_t skipped = c->text ? cs_globals_skipped(c->text, c->size) : 0;
  if (c->text)
    return luaL_loadbufferx(L, c->text + skipped, c->size - skipped,
                            lua_pushfstring(L, "@%s", c->path), "t");
  if (!cs_lua_script_accepts(c->path))
    return refuse_file(L, c->path);
  int outcome = luaL_loadfilex(L, c->path, "t");
  if (outcome == LUA_ERRFILE && strstr(lua_tostring(L, -1), strerror(ENOMEM)))
    lua_pushliteral(L, "not enough memory"); /* for the file's buffer */
  else
    c->is_missing = outcome == LUA_ERRFILE;
  return outcome;
}

/* Pushes the film of a file that is no script; false: it is one, or no film. */
static bool push_artwork(lua_State *L, const char *path) {
  cs_artwork artwork = cs_artwork_of(path);
  if (artwork == CS_ARTWORK_FOLDER || (artwork == CS_ARTWORK_NONE && cs_lua_script_accepts(path)))
    return false;
  cs_artwork_push_film(L, path, artwork == CS_ARTWORK_NONE ? CS_ARTWORK_MOVIE : artwork);
  return !lua_isnil(L, -1);
}

/* light userdata -> film. Runs protected. */
static int run(lua_State *L) {
  call *c = lua_touserdata(L, 1);
  cs_parameters_begin(L);
  const char *folder = cs_caller_push_folder_of(L, c->path);
  cs_host_set_folder(L, folder);
  cs_host_allow(L, folder);
  if (!cs_host_confines(L))
    set_search_path(L, folder); /* a sandbox has its own `require` */
  if (!c->text && push_artwork(L, c->path))
    return 1;
  cs_globals_open(L);
  int outcome = load(L, c);
  if (outcome == LUA_ERRSYNTAX && cs_lua_error_position(lua_tostring(L, -1)) == 0)
    return luaL_error(L, "%s: %s", c->path, lua_tostring(L, -1)); /* a compiled chunk */
  if (outcome != LUA_OK)
    return lua_error(L);
  lua_pushfstring(L, "@%s", c->path);
  cs_globals_note(L, lua_tostring(L, -1), c->text, c->size);
  lua_pop(L, 1);
  luaL_checkstack(L, c->argument_count + 4, "too many arguments");
  for (int i = 0; i < c->argument_count; i++)
    lua_pushstring(L, c->arguments[i]);
  lua_call(L, c->argument_count, 1);
  return cs_lua_film_push(L, -1) ? 1 : refuse_result(L, c->path);
}

/* Calls within the limits. Returns OK, or the outcome of lua_pcall with the message on top of the
 * stack. */
static int call_limited(lua_State *L, int argument_count, int result_count) {
  cs_host_get(L)->failure = CELSPAN_OK;
  cs_host_begin(L, CS_HOST_LOAD, 0);
  int outcome = cs_lua_error_call(L, argument_count, result_count);
  outcome = cs_lua_error_settle(L, outcome, result_count);
  cs_host_end(L);
  return outcome;
}

static celspan_status run_call(lua_State *L, call *c) {
  if (!lua_checkstack(L, 8) || !cs_host_find(L) || !c->path)
    return CELSPAN_BAD_ARGUMENT;
  lua_pushcfunction(L, run);
  lua_pushlightuserdata(L, c);
  int outcome = call_limited(L, 1, 1);
  celspan_status given = cs_parameters_end(L, outcome == LUA_OK);
  if (given != CELSPAN_OK)
    lua_pop(L, 1);
  if (given != CELSPAN_OK || outcome == LUA_OK)
    return given;
  return c->is_missing ? cs_lua_error_report_as(L, CELSPAN_INPUT) : cs_lua_error_report(L, outcome);
}

celspan_status celspan_lua_run(lua_State *L, const char *path, int argument_count,
                               const char *const *arguments) {
  return run_call(L,
                  &(call){.path = path, .argument_count = argument_count, .arguments = arguments});
}

celspan_status celspan_lua_run_text(lua_State *L, const char *name, const char *text, size_t size,
                                    int argument_count, const char *const *arguments) {
  return run_call(L, &(call){.path = text ? name : NULL,
                             .text = text,
                             .size = size,
                             .argument_count = argument_count,
                             .arguments = arguments});
}

celspan_status celspan_lua_call(lua_State *L, int argument_count, int result_count) {
  if (argument_count < 0 || result_count < 0 || argument_count >= lua_gettop(L) ||
      !lua_checkstack(L, result_count + 8) || !cs_host_find(L))
    return CELSPAN_BAD_ARGUMENT;
  int outcome = call_limited(L, argument_count, result_count);
  return outcome == LUA_OK ? CELSPAN_OK : cs_lua_error_report(L, outcome);
}
