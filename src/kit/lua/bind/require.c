#include "lua/bind/require.h"

#include <lualib.h>
#include <stdint.h>
#include <string.h>

/* Tables in the registry. */
#define OPENERS "celspan.openers" /* names functions that open private modules */
#define LOADED "celspan.loaded"   /* the modules that were loaded */
#define GLOBALS "celspan.own"     /* names the globals of celspan's own chunks */

void cs_require_give(lua_State *L, const luaL_Reg *modules) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, OPENERS);
  luaL_setfuncs(L, modules, 0);
  lua_pop(L, 1);
}

/* __index; upvalue: a list of modules. Most of them are never asked for. */
static int find_opener(lua_State *L) {
  const luaL_Reg *module = lua_touserdata(L, lua_upvalueindex(1));
  const char *name = lua_tostring(L, 2);
  while (module->name && (!name || strcmp(module->name, name) != 0))
    module++;
  if (!module->name)
    return 0;
  lua_pushcfunction(L, module->func);
  return 1;
}

/* Lets the table of that name in the registry have these modules. */
static void offer(lua_State *L, const char *table, const luaL_Reg *modules) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, table);
  lua_createtable(L, 0, 1);
  lua_pushlightuserdata(L, (void *)(uintptr_t)modules);
  lua_pushcclosure(L, find_opener, 1);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
  lua_pop(L, 1);
}

void cs_require_offer(lua_State *L, const luaL_Reg *modules, const luaL_Reg *own) {
  offer(L, OPENERS, own);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  bool has_package = lua_getfield(L, -1, LUA_LOADLIBNAME) != LUA_TNIL;
  lua_pop(L, 2);
  if (!has_package) {
    offer(L, LUA_PRELOAD_TABLE, modules);
    return;
  }
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
  luaL_setfuncs(L, modules, 0);
  lua_pop(L, 1);
}

static bool is_celspan(const char *name) {
  return strcmp(name, "celspan") == 0 || strncmp(name, "celspan.", 8) == 0;
}

void cs_require_forget(lua_State *L) {
  lua_pushnil(L);
  lua_setfield(L, LUA_REGISTRYINDEX, LOADED);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_pushnil(L);
  while (lua_next(L, -2)) {
    lua_pop(L, 1);
    if (lua_type(L, -1) == LUA_TSTRING && is_celspan(lua_tostring(L, -1))) {
      lua_pushvalue(L, -1);
      lua_pushnil(L);
      lua_rawset(L, -4);
    }
  }
  lua_pop(L, 1);
}

/* ---------------------------------------------------------------- finding */

/* Pushes the module of that name, from tables of the registry; if there is none, returns false and
 * pushes nothing. */
static bool push_module(lua_State *L, const char *loaded, const char *openers, const char *name) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, loaded);
  if (lua_getfield(L, -1, name) == LUA_TNIL) {
    lua_pop(L, 1);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, openers);
    if (lua_getfield(L, -1, name) == LUA_TNIL) {
      lua_pop(L, 3);
      return false;
    }
    lua_remove(L, -2);
    lua_pushstring(L, name);
    lua_call(L, 1, 1);
    lua_pushvalue(L, -1);
    lua_setfield(L, -3, name);
  }
  lua_remove(L, -2);
  return true;
}

void cs_require_public(lua_State *L, const char *name) {
  if (!push_module(L, LUA_LOADED_TABLE, LUA_PRELOAD_TABLE, name))
    luaL_error(L, "module '%s' not found", name);
}

static bool push_any(lua_State *L, const char *name) {
  return push_module(L, LOADED, OPENERS, name) ||
         push_module(L, LUA_LOADED_TABLE, LUA_PRELOAD_TABLE, name);
}

/* A state of the program has nothing at first but the module celspan, which gives it the others. */
void cs_require_module(lua_State *L, const char *name) {
  if (push_any(L, name))
    return;
  cs_require_public(L, "celspan");
  lua_pop(L, 1);
  if (!push_any(L, name))
    luaL_error(L, "module '%s' not found", name);
}

bool cs_require_is_loaded(lua_State *L, const char *name) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LOADED);
  bool is_loaded = lua_getfield(L, -1, name) != LUA_TNIL;
  lua_pop(L, 2);
  return is_loaded;
}

/* ---------------------------------------------------------------- celspan's own chunks */

/* require of celspan's own chunks; other modules, such as luassert, are the host's. */
static int require(lua_State *L) {
  const char *name = luaL_checkstring(L, 1);
  if (is_celspan(name)) {
    cs_require_module(L, name);
    return 1;
  }
  lua_getglobal(L, "require");
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

/* The table is registered when it is complete: memory may be short at any step. */
void cs_require_push_globals(lua_State *L) {
  if (lua_getfield(L, LUA_REGISTRYINDEX, GLOBALS) == LUA_TTABLE)
    return;
  lua_pop(L, 1);
  lua_newtable(L);
  lua_pushglobaltable(L);
  lua_pushnil(L);
  while (lua_next(L, -2)) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, -5);
  }
  lua_pop(L, 1);
  lua_pushcfunction(L, require);
  lua_setfield(L, -2, "require");
  lua_pushvalue(L, -1);
  lua_setfield(L, LUA_REGISTRYINDEX, GLOBALS);
}

/* ---------------------------------------------------------------- methods */

int cs_require_call(lua_State *L) {
  const cs_written *written = lua_touserdata(L, lua_upvalueindex(1));
  cs_require_module(L, written->module);
  lua_getfield(L, -1, written->function);
  lua_remove(L, -2);
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

void cs_require_methods(lua_State *L, const cs_written *methods) {
  for (; methods && methods->method; methods++) {
    lua_pushlightuserdata(L, (void *)methods);
    lua_pushcclosure(L, cs_require_call, 1);
    lua_setfield(L, -2, methods->method);
  }
}
