/* table: lengths depend on the table's content alone, the same in every process, and ranges are
 * checked before the work begins. */
#include <lauxlib.h>

#include "lua/bind/list.h"
#include "lua/sandbox/guard.h"
#include "lua/sandbox/library.h"

#define ITEMS_MOST 10000000
#define EXACT 16 /* insert and remove examine this many items, so that they remain fast */

static lua_Integer check_count(lua_State *L, const char *name, lua_Integer first,
                               lua_Integer last) {
  if (last < first)
    return 0;
  lua_Unsigned count = (lua_Unsigned)last - (lua_Unsigned)first;
  if (count >= ITEMS_MOST)
    luaL_error(L, "%s: more than %d items", name, ITEMS_MOST);
  cs_guard_charge(L, count + 1);
  return (lua_Integer)count + 1;
}

/* The length of the table at index, found by cs_list_border. Lengths by a metamethod are
 * refused. */
static lua_Integer check_length(lua_State *L, int index, const char *name, lua_Integer exact) {
  luaL_checktype(L, index, LUA_TTABLE);
  if (luaL_getmetafield(L, index, "__len") != LUA_TNIL)
    luaL_error(L,
               "%s: the table has a length function (__len), which the sandbox does not accept "
               "here",
               name);
  return cs_list_border(L, index, exact);
}

/* As Lua's insert, which would use a different length. */
static int insert(lua_State *L) {
  lua_Integer end = check_length(L, 1, "insert", EXACT) + 1, at = end;
  int count = lua_gettop(L);
  if (count != 2 && count != 3)
    return luaL_error(L, "wrong number of arguments to 'insert'");
  if (count == 3)
    at = luaL_checkinteger(L, 2);
  luaL_argcheck(L, at >= 1 && at <= end, 2, "position out of bounds");
  check_count(L, "insert", at, end);
  for (lua_Integer i = end; i > at; i--) {
    lua_geti(L, 1, i - 1);
    lua_seti(L, 1, i);
  }
  lua_seti(L, 1, at);
  return 0;
}

static int remove_item(lua_State *L) {
  lua_Integer length = check_length(L, 1, "remove", EXACT);
  lua_Integer at = luaL_optinteger(L, 2, length);
  bool is_inside = (at >= 1 && at <= length + 1) || at == length;
  luaL_argcheck(L, is_inside, 1, "position out of bounds"); /* Lua counts it as the first */
  check_count(L, "remove", at, length);
  lua_geti(L, 1, at);
  for (; at < length; at++) {
    lua_geti(L, 1, at + 1);
    lua_seti(L, 1, at);
  }
  lua_pushnil(L);
  lua_seti(L, 1, at);
  return 1;
}

static int move(lua_State *L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  check_count(L, "move", luaL_checkinteger(L, 2), luaL_checkinteger(L, 3));
  return cs_library_call(L);
}

/* Calls Lua's function with the end of the range as argument `last`. */
static int call_to(lua_State *L, int last, lua_Integer end) {
  if (lua_gettop(L) < last)
    lua_settop(L, last);
  lua_pushinteger(L, end);
  lua_replace(L, last);
  return cs_library_call(L);
}

static int concat(lua_State *L) {
  lua_Integer length = check_length(L, 1, "concat", ITEMS_MOST);
  lua_Integer first = luaL_optinteger(L, 3, 1), last = luaL_optinteger(L, 4, length);
  check_count(L, "concat", first, last);
  return call_to(L, 4, last);
}

/* Works also for celspan's values, which define their length. */
static int unpack(lua_State *L) {
  lua_Integer length =
      lua_type(L, 1) == LUA_TUSERDATA ? luaL_len(L, 1) : check_length(L, 1, "unpack", ITEMS_MOST);
  lua_Integer first = luaL_optinteger(L, 2, 1), last = luaL_optinteger(L, 3, length);
  check_count(L, "unpack", first, last);
  return call_to(L, 3, last);
}

/* ---------------------------------------------------------------- sorting */

/* Whether the item at index a comes before the item at b. */
static bool comes_before(lua_State *L, int a, int b) {
  if (lua_isnil(L, 2))
    return lua_compare(L, a, b, LUA_OPLT);
  lua_pushvalue(L, 2);
  lua_pushvalue(L, a - 1);
  lua_pushvalue(L, b - 2);
  lua_call(L, 2, 1);
  bool is_so = lua_toboolean(L, -1);
  lua_pop(L, 1);
  return is_so;
}

/* Merges [low, middle) and [middle, high) of the table at `from` into the table at `to`. */
static void merge(lua_State *L, const lua_Integer range[3], int from, int to) {
  lua_Integer a = range[0], b = range[1], out = range[0];
  while (a < range[1] && b < range[2]) {
    lua_rawgeti(L, from, a);
    lua_rawgeti(L, from, b);
    bool is_second = comes_before(L, -1, -2);
    if (!is_second)
      lua_pop(L, 1);
    lua_rawseti(L, to, out++);
    lua_settop(L, 4);
    a += !is_second;
    b += is_second;
  }
  for (; a < range[1]; a++, out++) {
    lua_rawgeti(L, from, a);
    lua_rawseti(L, to, out);
  }
  for (; b < range[2]; b++, out++) {
    lua_rawgeti(L, from, b);
    lua_rawseti(L, to, out);
  }
}

static lua_Integer least(lua_Integer a, lua_Integer b) { return a < b ? a : b; }

/* Merges runs of doubling length, alternating between two tables. The sort is stable; Lua's own
 * sort is not, and its choice of pivots depends on the clock. */
static int sort(lua_State *L) {
  lua_Integer length = check_length(L, 1, "sort", ITEMS_MOST);
  lua_settop(L, 2);
  if (!lua_isnil(L, 2))
    luaL_checktype(L, 2, LUA_TFUNCTION);
  lua_createtable(L, (int)least(length, ITEMS_MOST), 0);
  lua_pushvalue(L, 1);
  int from = 4, to = 3; /* 4 is a copy of the reference to the table, so that both can be swapped */
  for (lua_Integer run = 1; run < length; run *= 2) {
    check_count(L, "sort", 1, length);
    for (lua_Integer low = 1; low <= length; low += 2 * run) {
      lua_Integer range[] = {low, least(low + run, length + 1), least(low + 2 * run, length + 1)};
      merge(L, range, from, to);
    }
    from = 7 - from;
    to = 7 - to;
  }
  for (lua_Integer i = 1; from == 3 && i <= length; i++) {
    lua_rawgeti(L, 3, i);
    lua_rawseti(L, 1, i);
  }
  return 0;
}

void cs_library_push_table(lua_State *L) {
  static const luaL_Reg own[] = {{"insert", insert}, {"remove", remove_item}, {"move", move},
                                 {"concat", concat}, {"unpack", unpack},      {NULL, NULL}};
  lua_getglobal(L, "table");
  lua_newtable(L);
  for (const luaL_Reg *one = own; one->name; one++) {
    lua_getfield(L, -2, one->name);
    lua_pushcclosure(L, one->func, 1);
    lua_setfield(L, -2, one->name);
  }
  lua_getfield(L, -2, "pack");
  lua_setfield(L, -2, "pack");
  lua_pushcfunction(L, sort);
  lua_setfield(L, -2, "sort");
  lua_remove(L, -2);
}
