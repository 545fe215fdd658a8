/* Where `require` finds the modules of a film in a host, which has a `require` of its own:
 *
 *   /films/demo.lua           require "demo.hand"      /films/demo/hand.lua
 *   /films/demo/hand.lua      require "demo.brush"     /films/demo/brush.lua
 *
 * INVARIANT: package.path stays as the host has it, and comes first. A module that is not there is
 * looked for in the folder of the file that requires it; a module that was found so requires others
 * from the same folder.
 */
#include <lauxlib.h>
#include <lualib.h>

#include "lua/bind/caller.h"
#include "lua/module/native.h"

#define SEARCHER "celspan.beside" /* in the registry, when package.searchers has it */
/* a key of the registry: in which folders a file that was found in this way searches further */
#define FOLDERS "celspan.folders"

/* Pushes the folder for the file that calls require; false, and nothing pushed: no file calls. */
static bool push_folder(lua_State *L) {
  lua_Debug info;
  if (!cs_caller_find(L, &info) || info.source[0] != '@')
    return false;
  luaL_getsubtable(L, LUA_REGISTRYINDEX, FOLDERS);
  if (lua_getfield(L, -1, info.source + 1) != LUA_TSTRING) {
    lua_pop(L, 1);
    cs_caller_push_folder_of(L, info.source + 1);
  }
  lua_remove(L, -2);
  return true;
}

/* name, folder, path -> the module's function */
static void load_module(lua_State *L) {
  const char *name = lua_tostring(L, 1), *path = lua_tostring(L, 3);
  if (luaL_loadfilex(L, path, NULL) != LUA_OK)
    luaL_error(L, "error loading module '%s' from file '%s':\n\t%s", name, path,
               lua_tostring(L, -1));
  luaL_getsubtable(L, LUA_REGISTRYINDEX, FOLDERS);
  lua_pushvalue(L, 2);
  lua_setfield(L, -2, path);
  lua_pop(L, 1);
}

/* name -> function, path | the places that were searched. upvalue: package.searchpath */
static int search(lua_State *L) {
  luaL_checkstring(L, 1);
  lua_settop(L, 1);
  if (!push_folder(L))
    return 0;
  const char *at = lua_tostring(L, 2)[0] ? lua_tostring(L, 2) : ".";
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_pushvalue(L, 1);
  lua_pushfstring(L, "%s/?.lua;%s/?/init.lua", at, at);
  lua_call(L, 2, 2);
  if (lua_isnil(L, 3))
    return 1;
  lua_settop(L, 3);
  load_module(L);
  lua_pushvalue(L, 3);
  return 2;
}

void cs_beside_open(lua_State *L) {
  int top = lua_gettop(L);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  bool has_package = lua_getfield(L, -1, LUA_LOADLIBNAME) == LUA_TTABLE;
  if (has_package && lua_getfield(L, LUA_REGISTRYINDEX, SEARCHER) == LUA_TNIL &&
      lua_getfield(L, top + 2, "searchers") == LUA_TTABLE &&
      lua_getfield(L, top + 2, "searchpath") == LUA_TFUNCTION) {
    lua_pushcclosure(L, search, 1);
    lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1);
    lua_pushboolean(L, 1);
    lua_setfield(L, LUA_REGISTRYINDEX, SEARCHER);
  }
  lua_settop(L, top);
}
