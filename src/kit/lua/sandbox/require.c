/* The require of scripts. */
#include "lua/bind/require.h"
#include "lua/sandbox/library.h"

#include <lauxlib.h>
#include <string.h>
#include <sys/stat.h>

#include "lua/bind/globals.h"
#include "lua/bind/host.h"
#include "lua/sandbox/guard.h"

#define SOURCE_MOST ((off_t)16 << 20)

/* ---------------------------------------------------------------- finding */

static bool is_celspan(const char *name) {
  return strcmp(name, "celspan") == 0 || strncmp(name, "celspan.", 8) == 0;
}

static bool is_regular(const char *path, off_t *size) {
  struct stat found;
  if (stat(path, &found) != 0 || !S_ISREG(found.st_mode))
    return false;
  *size = found.st_size;
  return true;
}

/* Pushes the path of the module, or all paths that were tried. Returns whether the module was
 * found. */
static bool push_file(lua_State *L, const char *name, const char *templates, off_t *size) {
  const char *words = luaL_gsub(L, name, ".", "/");
  lua_pushliteral(L, "");
  while (*templates) {
    size_t length = strcspn(templates, ";");
    lua_pushlstring(L, templates, length);
    const char *path = luaL_gsub(L, lua_tostring(L, -1), "?", words);
    lua_remove(L, -2);
    bool is_admitted = cs_host_admits(L, path);
    if (length && is_admitted && is_regular(path, size))
      return true;
    lua_pushfstring(L, "\n\tno file '%s'%s", path,
                    is_admitted ? "" : " that the sandbox lets scripts read");
    lua_remove(L, -2);
    lua_concat(L, 2);
    templates += length + (templates[length] == ';');
  }
  return false;
}

/* Pushes the search path of modules: the script's folder comes first. */
static const char *push_templates(lua_State *L, const char *search) {
  const char *folder = cs_host_push_folder(L) ? lua_tostring(L, -1) : "";
  const char *at = folder[0] ? folder : ".";
  return lua_pushfstring(L, "%s/?.lua;%s/?/init.lua;%s", at, at, search);
}

/* Pushes what to do about a module that was not found, or "". */
static const char *push_advice(lua_State *L, const char *name) {
  const char *own = lua_pushfstring(L, "celspan.%s", name);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
  if (lua_getfield(L, -1, own) != LUA_TNIL)
    return lua_pushfstring(L, "; celspan's own is require \"%s\"", own);
  return lua_pushstring(L, strncmp(name, "stage.", 6) == 0
                               ? "; copy the folder scripts/stage of celspan beside the script"
                               : "");
}

/* Pushes the module's function and its path. */
static void load_module(lua_State *L, const char *search, const char *name) {
  off_t size = 0;
  if (!push_file(L, name, push_templates(L, search), &size)) {
    const char *tried = lua_tostring(L, -1);
    luaL_error(L, "module '%s' not found%s:%s", name, push_advice(L, name), tried);
  }
  const char *path = lua_tostring(L, -1);
  if (size > SOURCE_MOST)
    luaL_error(L, "%s: the module has more than 16 MiB, which is the limit", path);
  cs_guard_charge(L, (uint64_t)size / 16);
  if (luaL_loadfilex(L, path, "t") != LUA_OK)
    luaL_error(L, "error loading module '%s' from file '%s':\n\t%s", name, path,
               lua_tostring(L, -1));
  cs_globals_note(L, lua_pushfstring(L, "@%s", path), NULL, 0);
  lua_pop(L, 1);
  lua_insert(L, -2);
}

/* upvalues: the search path, the loaded modules */
static int require(lua_State *L) {
  const char *search = lua_tostring(L, lua_upvalueindex(1));
  const char *name = luaL_checkstring(L, 1);
  lua_settop(L, 1);
  if (lua_getfield(L, lua_upvalueindex(2), name) != LUA_TNIL)
    return 1;
  if (is_celspan(name)) {
    if (strcmp(name, "celspan.spec") == 0) /* this module is for specs, which have all of Lua */
      return luaL_error(L, "module '%s' is not in the sandbox%s", name,
                        cs_guard_hint(cs_guard_of(L), " (--trust gives all of Lua)"));
    cs_require_public(L, name);
    return 1;
  }
  load_module(L, search, name);
  lua_pushvalue(L, 1);
  lua_insert(L, -2); /* function, name, path */
  lua_call(L, 2, 1);
  if (lua_isnil(L, -1)) {
    lua_pop(L, 1);
    lua_pushboolean(L, 1);
  }
  lua_pushvalue(L, -1);
  lua_setfield(L, lua_upvalueindex(2), name);
  return 1;
}

void cs_library_push_require(lua_State *L, int globals, const char *search) {
  static const char *const libraries[] = {"string",    "table", "math", "utf8",
                                          "coroutine", "_G",    NULL};
  globals = lua_absindex(L, globals);
  lua_pushstring(L, search ? search : "");
  lua_newtable(L);
  for (int i = 0; libraries[i]; i++) {
    lua_getfield(L, globals, libraries[i]);
    lua_setfield(L, -2, libraries[i]);
  }
  lua_pushcclosure(L, require, 2);
}
