/* luaopen_celspan: the module table, filled by the file of each noun. */
#include "bind/openers.h"

#include <lauxlib.h>

#include "bind/host.h"
#include "bind/suggest.h"
#include "celspan/lua.h"

#define MOST_NAMES 128

/* core.resolve(path): a file name relative to the script's folder. */
static int resolve(lua_State *L) {
  cs_host_resolve(L, luaL_checkstring(L, 1));
  return 1;
}

/* core.nearest(word, names): the name that was probably meant, or nil. */
static int nearest(lua_State *L) {
  const char *word = luaL_checkstring(L, 1);
  luaL_checktype(L, 2, LUA_TTABLE);
  const char *names[MOST_NAMES] = {0};
  size_t count = lua_rawlen(L, 2) < MOST_NAMES ? lua_rawlen(L, 2) : MOST_NAMES;
  for (size_t i = 0; i < count; i++) {
    if (lua_rawgeti(L, 2, (lua_Integer)i + 1) != LUA_TSTRING)
      return luaL_error(L, "nearest: name %d is not a string", (int)i + 1);
    names[i] = lua_tostring(L, -1); /* the table keeps it alive */
    lua_pop(L, 1);
  }
  lua_pushstring(L, cs_suggest_name(word, names, count));
  return 1;
}

int luaopen_celspan_core(lua_State *L) {
  static const luaL_Reg functions[] = {{"resolve", resolve}, {"nearest", nearest}, {NULL, NULL}};
  cs_host_open(L, NULL);
  luaL_newlib(L, functions);
  return 1;
}

int luaopen_celspan(lua_State *L) {
  static void (*const openers[])(lua_State *) = {
      cs_open_paint,    cs_open_texture, cs_open_object, cs_open_primitive,
      cs_open_scanline, cs_open_boolean, cs_open_cel,    cs_open_rostrum,
      cs_open_film,     cs_open_render,  cs_open_pixels, cs_open_spans};
  luaL_checkversion(L);
  cs_host_open(L, NULL);
  lua_createtable(L, 0, 32);
  lua_pushfstring(L, "celspan %s", celspan_version());
  lua_setfield(L, -2, "_VERSION");
  for (size_t i = 0; i < sizeof openers / sizeof *openers; i++)
    openers[i](L);
  cs_open_embedded(L);
  return 1;
}
