/* A small Lua interpreter for sanitizer runs: a module built with -fsanitize=address does not load
 * into the stock interpreter. Built with the same flags, it accepts the arguments that busted
 * passes to an interpreter:
 *
 *   lua_host [-e CODE]... SCRIPT [ARGUMENT]...
 */
#include <lauxlib.h>
#include <lualib.h>
#include <stdio.h>
#include <string.h>

static int report(lua_State *L, int outcome) {
  if (outcome != LUA_OK)
    fprintf(stderr, "%s\n", luaL_tolstring(L, -1, NULL));
  return outcome;
}

static int run_code(lua_State *L, const char *code) {
  return report(L, luaL_loadbufferx(L, code, strlen(code), "=(command line)", "t") ||
                       lua_pcall(L, 0, 0, 0));
}

static int run_script(lua_State *L, int count, char **arguments) {
  lua_createtable(L, count, 0);
  for (int i = 0; i < count; i++) {
    lua_pushstring(L, arguments[i]);
    lua_rawseti(L, -2, i);
  }
  lua_setglobal(L, "arg");
  int outcome = luaL_loadfile(L, arguments[0]);
  for (int i = 1; i < count && outcome == LUA_OK; i++)
    lua_pushstring(L, arguments[i]);
  return report(L, outcome || lua_pcall(L, count - 1, 0, 0));
}

int main(int argument_count, char **arguments) {
  lua_State *L = luaL_newstate();
  if (!L)
    return 1;
  luaL_openlibs(L);
  int at = 1, outcome = LUA_OK;
  for (; at + 1 < argument_count && strcmp(arguments[at], "-e") == 0 && outcome == LUA_OK; at += 2)
    outcome = run_code(L, arguments[at + 1]);
  if (at < argument_count && outcome == LUA_OK)
    outcome = run_script(L, argument_count - at, arguments + at);
  lua_close(L);
  return outcome == LUA_OK ? 0 : 1;
}
