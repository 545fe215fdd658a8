/* Metatables that are copies, texts without addresses, and tables in a fixed order.
 *
 *   setmetatable(t, own):   t --metatable--> hidden copy of the metamethods --OWN--> own
 *                                                 ^-------------HIDDEN---------------/
 */
#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>

#include "lua/sandbox/guard.h"
#include "lua/sandbox/library.h"

static const char own_key = 0,
                  hidden_key = 0; /* the addresses of these are keys that scripts cannot create */

static const char *const COPIED[] = {
    "__index", "__newindex", "__call",   "__tostring", "__name", "__len", "__eq",
    "__lt",    "__le",       "__concat", "__unm",      "__add",  "__sub", "__mul",
    "__div",   "__idiv",     "__mod",    "__pow",      "__band", "__bor", "__bxor",
    "__bnot",  "__shl",      "__shr",    "__close",    "__pairs"};

/* ---------------------------------------------------------------- metatables */

/* Raises an error for metamethods that break Lua or cannot be stopped. own: the script's table. */
static void check_metatable(lua_State *L, int own) {
  static const char *const refused[] = {"__gc", "__mode"};
  for (int i = 0; i < 2; i++) {
    lua_pushstring(L, refused[i]);
    if (lua_rawget(L, own) != LUA_TNIL)
      luaL_error(L, "setmetatable: %s is not in the sandbox%s", refused[i],
                 cs_guard_hint(cs_guard_of(L), " (--trust gives all of Lua)"));
    lua_pop(L, 1);
  }
  lua_pushliteral(L, "__call");
  int type = lua_rawget(L, own);
  if (type != LUA_TNIL && type != LUA_TFUNCTION)
    luaL_error(L, "setmetatable: __call must be a function, got a %s", luaL_typename(L, -1));
  lua_pop(L, 1);
}

/* Pushes the hidden copy of the script's metatable at `own`, which is created or updated. */
static void push_hidden(lua_State *L, int own) {
  if (lua_rawgetp(L, own, &hidden_key) != LUA_TTABLE) {
    lua_pop(L, 1);
    lua_createtable(L, 0, 4);
    lua_pushvalue(L, own);
    lua_rawsetp(L, -2, &own_key);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, own, &hidden_key);
  }
  for (size_t i = 0; i < sizeof COPIED / sizeof *COPIED; i++) {
    lua_pushstring(L, COPIED[i]);
    lua_pushvalue(L, -1);
    lua_rawget(L, own);
    lua_rawset(L, -3);
  }
}

/* Pushes the metatable that the script set for the value at index. Returns false and pushes nothing
 * if there is none. */
static bool push_own(lua_State *L, int index) {
  if (!lua_getmetatable(L, index))
    return false;
  if (lua_rawgetp(L, -1, &own_key) != LUA_TTABLE) {
    lua_pop(L, 2);
    return false;
  }
  lua_remove(L, -2);
  return true;
}

static int set_metatable(lua_State *L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  luaL_argexpected(L, lua_isnil(L, 2) || lua_istable(L, 2), 2, "nil or table");
  if (lua_getmetatable(L, 1)) {
    bool is_own = push_own(L, 1);
    if (is_own)
      lua_pushliteral(L, "__metatable");
    if (!is_own || lua_rawget(L, -2) != LUA_TNIL)
      return luaL_error(L, "cannot change a protected metatable");
  }
  lua_settop(L, 2);
  if (!lua_isnil(L, 2)) {
    check_metatable(L, 2);
    push_hidden(L, 2);
  }
  lua_setmetatable(L, 1);
  lua_settop(L, 1);
  return 1;
}

/* For metatables of celspan and of strings, returns only that they exist. */
static int get_metatable(lua_State *L) {
  luaL_checkany(L, 1);
  if (push_own(L, 1)) {
    lua_pushliteral(L, "__metatable");
    if (lua_rawget(L, -2) == LUA_TNIL)
      lua_pop(L, 1);
  } else if (luaL_getmetafield(L, 1, "__metatable") == LUA_TNIL) {
    if (lua_getmetatable(L, 1))
      lua_pushliteral(L, "celspan");
    else
      lua_pushnil(L);
  }
  return 1;
}

/* ---------------------------------------------------------------- texts */

const char *cs_library_push_text(lua_State *L, int index) {
  index = lua_absindex(L, index);
  int type = lua_type(L, index);
  if (type == LUA_TNIL || type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING)
    return luaL_tolstring(L, index, NULL);
  if (luaL_callmeta(L, index, "__tostring")) {
    if (!lua_isstring(L, -1))
      luaL_error(L, "'__tostring' must return a string");
    return lua_tostring(L, -1);
  }
  int name = luaL_getmetafield(L, index, "__name");
  if (name == LUA_TSTRING)
    return lua_tostring(L, -1);
  if (name != LUA_TNIL)
    lua_pop(L, 1);
  return lua_pushstring(L, luaL_typename(L, index));
}

static int to_string(lua_State *L) {
  luaL_checkany(L, 1);
  cs_library_push_text(L, 1);
  return 1;
}

/* ---------------------------------------------------------------- order */

/* Numbers come first, then strings by their bytes, then booleans; -1: the key has no order. */
static int rank_of(lua_State *L, int index) {
  switch (lua_type(L, index)) {
  case LUA_TNUMBER:
    return 0;
  case LUA_TSTRING:
    return 1;
  case LUA_TBOOLEAN:
    return 2;
  default:
    return -1;
  }
}

static int check_rank(lua_State *L, int index, const char *name) {
  int rank = rank_of(L, index);
  if (rank < 0)
    luaL_error(L,
               "%s: a key is a %s: the order of such keys differs in each run; use a list "
               "instead",
               name, luaL_typename(L, index));
  return rank;
}

/* Whether the key at index a comes before the key at b. */
static bool is_before(lua_State *L, int a, int b, const char *name) {
  int one = check_rank(L, a, name), other = check_rank(L, b, name);
  if (one != other)
    return one < other;
  if (one == 0)
    return lua_compare(L, a, b, LUA_OPLT);
  if (one == 2)
    return lua_toboolean(L, a) < lua_toboolean(L, b);
  size_t size, other_size;
  const char *text = lua_tolstring(L, a, &size), *than = lua_tolstring(L, b, &other_size);
  int order = memcmp(text, than, size < other_size ? size : other_size);
  return order ? order < 0 : size < other_size;
}

/* Whether the field is the hidden copy of a metatable, which scripts cannot see. */
static bool is_hidden(lua_State *L, int index) {
  return lua_type(L, index) == LUA_TLIGHTUSERDATA && lua_touserdata(L, index) == &hidden_key;
}

/* next(t, key): the least key that is greater. It compares every key, so pairs is faster in
 * loops. */
static int next_field(lua_State *L) {
  uint64_t steps = 0;
  luaL_checktype(L, 1, LUA_TTABLE);
  lua_settop(L, 2);
  lua_pushnil(L); /* 3: the least key so far */
  bool has_least = false;
  for (lua_pushnil(L); lua_next(L, 1); steps++) {
    lua_pop(L, 1);
    if (is_hidden(L, -1))
      continue;
    bool is_after = lua_isnil(L, 2) || is_before(L, 2, -1, "next");
    check_rank(L, -1, "next");
    if (is_after && (!has_least || is_before(L, -1, 3, "next"))) {
      lua_copy(L, -1, 3);
      has_least = true;
    }
  }
  cs_guard_charge(L, steps);
  if (!has_least)
    return 1; /* nil */
  lua_pushvalue(L, 3);
  lua_rawget(L, 1);
  return 2;
}

/* upvalues: the sorted keys, the index of the last one */
static int next_pair(lua_State *L) {
  lua_Integer i = lua_tointeger(L, lua_upvalueindex(2));
  lua_settop(L, 1);
  for (;;) {
    if (lua_rawgeti(L, lua_upvalueindex(1), ++i) == LUA_TNIL)
      return 1;
    lua_pushvalue(L, 2);
    if (lua_rawget(L, 1) != LUA_TNIL)
      break;
    lua_settop(L, 1); /* the key was removed in the meantime */
  }
  lua_pushinteger(L, i);
  lua_replace(L, lua_upvalueindex(2));
  return 2;
}

/* ---------------------------------------------------------------- sorting keys */

typedef struct key {
  double number; /* the nearest double of a large integer */
  lua_Integer whole;
  const char *text; /* NULL: none; the table keeps it alive */
  size_t size;
  int rank;
  bool is_whole;
} key;

static int compare_numbers(const key *a, const key *b) {
  if (a->is_whole && b->is_whole)
    return (a->whole > b->whole) - (a->whole < b->whole);
  if (a->number != b->number)
    return a->number < b->number ? -1 : 1;
  /* for 2^63, and for integers that are rounded to it */
  return (int)b->is_whole - (int)a->is_whole;
}

static int compare_keys(const void *x, const void *y) {
  const key *a = x, *b = y;
  if (a->rank != b->rank)
    return a->rank - b->rank;
  if (a->rank != 1)
    return compare_numbers(a, b);
  int order = memcmp(a->text, b->text, a->size < b->size ? a->size : b->size);
  return order ? order : (a->size > b->size) - (a->size < b->size);
}

static key key_at(lua_State *L, int index) {
  key made = {.rank = check_rank(L, index, "pairs")};
  if (made.rank == 1)
    made.text = lua_tolstring(L, index, &made.size);
  else if (made.rank == 2)
    made.number = lua_toboolean(L, index);
  else
    made.number = lua_tonumber(L, index);
  made.is_whole = lua_isinteger(L, index);
  made.whole = made.is_whole ? lua_tointeger(L, index) : 0;
  return made;
}

static void push_key(lua_State *L, const key *from) {
  if (from->rank == 1)
    lua_pushlstring(L, from->text, from->size);
  else if (from->rank == 2)
    lua_pushboolean(L, from->number != 0);
  else if (from->is_whole)
    lua_pushinteger(L, from->whole);
  else
    lua_pushnumber(L, from->number);
}

static size_t count_fields(lua_State *L) {
  size_t count = 0;
  for (lua_pushnil(L); lua_next(L, 1); lua_pop(L, 1))
    count++;
  return count;
}

/* Pushes the keys of the table at 1, in order. */
static void push_keys(lua_State *L) {
  size_t most = count_fields(L), count = 0;
  cs_guard_charge(L, 4 * (uint64_t)most);
  key *keys = lua_newuserdatauv(L, (most + 1) * sizeof *keys, 0);
  for (lua_pushnil(L); lua_next(L, 1); lua_pop(L, 1))
    if (!is_hidden(L, -2))
      keys[count++] = key_at(L, -2);
  qsort(keys, count, sizeof *keys, compare_keys);
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; i < count; i++) {
    push_key(L, &keys[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_remove(L, -2);
}

static int pairs(lua_State *L) {
  luaL_checkany(L, 1);
  if (luaL_getmetafield(L, 1, "__pairs") != LUA_TNIL) {
    lua_pushvalue(L, 1);
    lua_call(L, 1, 3);
    return 3;
  }
  luaL_checktype(L, 1, LUA_TTABLE);
  lua_settop(L, 1);
  push_keys(L);
  lua_pushinteger(L, 0);
  lua_pushcclosure(L, next_pair, 2);
  lua_pushvalue(L, 1);
  return 2;
}

void cs_library_add_values(lua_State *L) {
  static const luaL_Reg own[] = {{"setmetatable", set_metatable},
                                 {"getmetatable", get_metatable},
                                 {"tostring", to_string},
                                 {"next", next_field},
                                 {"pairs", pairs},
                                 {NULL, NULL}};
  luaL_setfuncs(L, own, 0);
}
