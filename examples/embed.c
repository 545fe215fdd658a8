/* A host with its own Lua state: opens celspan in it and runs a script that draws.
 *
 *   cc embed.c $(pkg-config --cflags --libs celspan-lua) -o embed
 *   ./embed script.lua arguments...      (without arguments: a built-in script)
 *
 * The script is an ordinary Lua program; `require "celspan"` finds the module without a path.
 */
#include <celspan/lua.h>
#include <lauxlib.h>
#include <lualib.h>
#include <stdio.h>

static const char built_in[] =
    "local celspan = require 'celspan'\n"
    "local dot = celspan.circle{ centre = {12, 6}, radius = 5, texture = '#ff8800' }\n"
    "local rostrum = celspan.rostrum{ celspan.cel{ dot } }\n"
    "local image = assert(celspan.pixels(rostrum, { size = {24, 12} }))\n"
    "for y = 0, image.height - 1 do\n"
    "  local line = {}\n"
    "  for x = 0, image.width - 1 do\n"
    "    local r, g, b, a = image:get(x, y)\n"
    "    line[#line + 1] = a == 0 and ' ' or a == 1 and '#' or '+'\n"
    "  end\n"
    "  print(table.concat(line))\n"
    "end\n";

/* Runs in protected mode, so that any error is returned as a message. */
static int run(lua_State *L) {
  int count = (int)lua_tointeger(L, 1);
  char **arguments = lua_touserdata(L, 2);
  luaL_openlibs(L);
  luaL_requiref(L, "celspan", luaopen_celspan, 0);
  lua_settop(L, 0);
  int status = count > 1 ? luaL_loadfile(L, arguments[1])
                         : luaL_loadbuffer(L, built_in, sizeof built_in - 1, "=built-in");
  if (status != LUA_OK)
    return lua_error(L);
  for (int i = 2; i < count; i++)
    lua_pushstring(L, arguments[i]);
  lua_call(L, count > 2 ? count - 2 : 0, 0);
  return 0;
}

int main(int count, char **arguments) {
  lua_State *L = luaL_newstate();
  if (!L) {
    fprintf(stderr, "embed: not enough memory for a Lua state\n");
    return 1;
  }
  lua_pushcfunction(L, run);
  lua_pushinteger(L, count);
  lua_pushlightuserdata(L, arguments);
  int status = lua_pcall(L, 2, 0, 0);
  if (status != LUA_OK)
    fprintf(stderr, "embed: %s\n", lua_isstring(L, -1) ? lua_tostring(L, -1) : "no message");
  lua_close(L); /* also frees its scenes and its context */
  return status != LUA_OK;
}
