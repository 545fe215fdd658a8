#include "cli/desk/desk.h"

#include <lauxlib.h>
#include <string.h>

void cs_desk_call(lua_State *L, const unsigned char *text, const char *name, int count,
                  int results) {
  const char *source = (const char *)text;
  if (luaL_loadbufferx(L, source, strlen(source), name, "t") != LUA_OK)
    lua_error(L);
  lua_insert(L, -count - 1);
  lua_call(L, count, results);
}
