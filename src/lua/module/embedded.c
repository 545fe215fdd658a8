/* The Lua modules that are built in: those of lua/celspan that meson.build lists. CS_PUBLIC: also
 * for scripts; CS_PRIVATE: only for celspan. */
#include <lauxlib.h>
#include <string.h>

#include "celspan/lua.h"
#include "lua/bind/caller.h"
#include "lua/bind/require.h"
#include "lua/module/core.h"

/* The names of the modules begin with this, so that the caller finder recognizes them: see
 * lua/bind/caller.c. */
#define CHUNK "@celspan/"

/* ---------------------------------------------------------------- opening */

/* Runs the text with the globals of celspan's own chunks. */
static int run(lua_State *L, const char *name, const unsigned char *text) {
  const char *source = (const char *)text;
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  lua_pop(L, 1);
  if (luaL_loadbufferx(L, source, strlen(source), name, "t") != LUA_OK)
    return lua_error(L);
  cs_require_push_globals(L);
  lua_setupvalue(L, -2, 1);
  lua_call(L, 0, 1);
  return 1;
}

static int refuse(lua_State *L, const char *name) {
  lua_Debug info;
  if (cs_caller_find(L, &info))
    lua_pushfstring(L, "%s:%d: ", info.short_src, info.currentline);
  else
    lua_pushliteral(L, "");
  return luaL_error(L,
                    "%smodule 'celspan.%s' is private: only celspan's own modules can "
                    "require it",
                    lua_tostring(L, -1), name);
}

#define DECLARE(name, folder) extern const unsigned char cs_lua_##name[];
CS_PUBLIC(DECLARE)
CS_PRIVATE(DECLARE)

/* Functions with names, so that a single celspan.so is also loaded for `require "celspan.ease"`. */
#define OPEN(name, folder)                                                                         \
  CELSPAN_API int luaopen_celspan_##name(lua_State *L);                                            \
  int luaopen_celspan_##name(lua_State *L) {                                                       \
    return run(L, CHUNK #folder "/" #name ".lua", cs_lua_##name);                                  \
  }
CS_PUBLIC(OPEN)

#define REFUSE(name, folder)                                                                       \
  CELSPAN_API int luaopen_celspan_##name(lua_State *L);                                            \
  int luaopen_celspan_##name(lua_State *L) { return refuse(L, #name); }
CS_PRIVATE(REFUSE)
REFUSE(core, module)

#define OPEN_PRIVATE(name, folder)                                                                 \
  static int open_##name(lua_State *L) {                                                           \
    return run(L, CHUNK #folder "/" #name ".lua", cs_lua_##name);                                  \
  }
CS_PRIVATE(OPEN_PRIVATE)

void cs_embedded_open(lua_State *L) {
#define ROW(name, folder) {"celspan." #name, luaopen_celspan_##name},
#define PRIVATE_ROW(name, folder) {"celspan." #name, open_##name},
  static const luaL_Reg modules[] = {CS_PUBLIC(ROW) CS_PRIVATE(ROW) ROW(core, module){NULL, NULL}};
  static const luaL_Reg own[] = {CS_PRIVATE(PRIVATE_ROW){NULL, NULL}};
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
  luaL_setfuncs(L, modules, 0);
  lua_pop(L, 1);
  cs_require_give(L, own);
}

/* ---------------------------------------------------------------- names */

static const struct {
  const char *name;
  const unsigned char *text;
} public_texts[] = {
#define TEXT(name, folder) {#name, cs_lua_##name},
    CS_PUBLIC(TEXT)};

static const unsigned char *find_text(const char *name) {
  for (size_t i = 0; i < sizeof public_texts / sizeof *public_texts; i++)
    if (strcmp(public_texts[i].name, name) == 0)
      return public_texts[i].text;
  return NULL;
}

bool cs_embedded_has(const char *name) { return find_text(name); }

int cs_embedded_source(lua_State *L) {
  const char *name = luaL_checkstring(L, 1);
  const unsigned char *text = find_text(name);
  if (!text)
    return luaL_error(L, "there is no module celspan.%s for scripts", name);
  lua_pushstring(L, (const char *)text);
  return 1;
}
