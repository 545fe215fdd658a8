/* luaopen_celspan: the module table, from each noun's file. */
#include "bind/module.h"

#include <lauxlib.h>

#include "bind/form.h"
#include "bind/host.h"
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
    names[i] = lua_tostring(L, -1); /* held by the table */
    lua_pop(L, 1);
  }
  lua_pushstring(L, cs_form_nearest(word, names, count));
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
      cs_paint_open,    cs_texture_open, cs_object_open, cs_primitive_open,
      cs_scanline_open, cs_boolean_open, cs_cel_open,    cs_rostrum_open,
      cs_film_open,     cs_render_open,  cs_pixels_open, cs_spans_open};
  luaL_checkversion(L);
  cs_host_open(L, NULL);
  lua_createtable(L, 0, 32);
  lua_pushfstring(L, "celspan %s", celspan_version());
  lua_setfield(L, -2, "_VERSION");
  for (size_t i = 0; i < sizeof openers / sizeof *openers; i++)
    openers[i](L);
  cs_embedded_open(L);
  return 1;
}
