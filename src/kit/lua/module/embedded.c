/* The Lua modules that are built in: those of lua/celspan that meson.build lists. CS_PUBLIC: also
 * for scripts; CS_PRIVATE: only for celspan. */
#include <lauxlib.h>
#include <string.h>

#include "celspan/lua.h"
#include "lua/bind/caller.h"
#include "lua/bind/require.h"
#include "lua/module/native.h"
#include "lua/module/texts.h"

/* ---------------------------------------------------------------- opening */

static int run(lua_State *L, const char *folder, const char *file) {
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  lua_pop(L, 1);
  cs_texts_load(L, folder, file);
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

/* Functions with names, so that a single celspan.so is also loaded for `require "celspan.ease"`. */
#define OPEN(name, folder)                                                                         \
  CELSPAN_API int luaopen_celspan_##name(lua_State *L);                                            \
  int luaopen_celspan_##name(lua_State *L) { return run(L, #folder "/", #name ".lua"); }
CS_PUBLIC(OPEN)

#define REFUSE(name, folder)                                                                       \
  CELSPAN_API int luaopen_celspan_##name(lua_State *L);                                            \
  int luaopen_celspan_##name(lua_State *L) { return refuse(L, #name); }
CS_PRIVATE(REFUSE)
REFUSE(native, module)

#define OPEN_PRIVATE(name, folder)                                                                 \
  static int open_##name(lua_State *L) { return run(L, #folder "/", #name ".lua"); }
CS_PRIVATE(OPEN_PRIVATE)

/* celspan.color, another spelling of celspan.colour */
CELSPAN_API int luaopen_celspan_color(lua_State *L);
int luaopen_celspan_color(lua_State *L) {
  cs_require_public(L, "celspan.colour");
  return 1;
}

void cs_embedded_open(lua_State *L) {
#define ROW(name, folder) {"celspan." #name, luaopen_celspan_##name},
#define PRIVATE_ROW(name, folder) {"celspan." #name, open_##name},
  static const luaL_Reg modules[] = {CS_PUBLIC(ROW) CS_PRIVATE(ROW) ROW(native, module)
                                         ROW(color, draw){NULL, NULL}};
  static const luaL_Reg own[] = {CS_PRIVATE(PRIVATE_ROW){NULL, NULL}};
  cs_require_offer(L, modules, own);
}

/* ---------------------------------------------------------------- names */

bool cs_embedded_has(const char *name) {
#define NAME(name, folder) #name,
  static const char *const names[] = {CS_PUBLIC(NAME)};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(names[i], name) == 0)
      return true;
  return false;
}

int cs_embedded_source(lua_State *L) {
  const char *name = luaL_checkstring(L, 1);
  const cs_built_in *file = cs_built_in_find(cs_module_texts, lua_pushfstring(L, "%s.lua", name));
  if (!file)
    return luaL_error(L, "there is no module celspan.%s", name);
  lua_pushlstring(L, file->bytes, file->size);
  return 1;
}
