/* The Lua modules that are built in: those of lua/celspan that meson.build lists in CS_EMBEDDED. */
#include <lauxlib.h>
#include <string.h>

#include "celspan/lua.h"
#include "lua/module/core.h"

/* The caller finder knows them by this beginning of their names: see lua/bind/caller.c. */
#define CHUNK "@celspan/"

#define DECLARE(name)                                                                              \
  extern const unsigned char cs_lua_##name[];                                                      \
  CELSPAN_API int luaopen_celspan_##name(lua_State *L);
CS_EMBEDDED(DECLARE)

static int run(lua_State *L, const char *name, const unsigned char *text) {
  const char *source = (const char *)text;
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  lua_pop(L, 1);
  if (luaL_loadbufferx(L, source, strlen(source), name, "t") != LUA_OK)
    return lua_error(L);
  lua_call(L, 0, 1);
  return 1;
}

/* Functions with names, so that one celspan.so serves `require "celspan.ease"` too. */
#define OPEN(name)                                                                                 \
  int luaopen_celspan_##name(lua_State *L) { return run(L, CHUNK #name ".lua", cs_lua_##name); }
CS_EMBEDDED(OPEN)

void cs_embedded_open(lua_State *L) {
#define ROW(name) {"celspan." #name, luaopen_celspan_##name},
  static const luaL_Reg modules[] = {CS_EMBEDDED(ROW){"celspan.core", luaopen_celspan_core},
                                     {NULL, NULL}};
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
  luaL_setfuncs(L, modules, 0);
  lua_pop(L, 1);
}

int cs_embedded_source(lua_State *L) {
#define TEXT(name) {#name, cs_lua_##name},
  static const struct {
    const char *name;
    const unsigned char *text;
  } texts[] = {CS_EMBEDDED(TEXT)};
  const char *name = luaL_checkstring(L, 1);
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
    if (strcmp(texts[i].name, name) == 0) {
      lua_pushstring(L, (const char *)texts[i].text);
      return 1;
    }
  return luaL_error(L, "there is no module celspan.%s", name);
}
