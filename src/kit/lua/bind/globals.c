#include "lua/bind/globals.h"

#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>

#include "lua/bind/caller.h"
#include "lua/bind/files.h"
#include "lua/bind/host.h"
#include "lua/bind/names.h"
#include "lua/bind/require.h"
#include "lua/bind/userdata.h"

/* Tables in the registry. A file has Lua's name of it. */
#define FILES "celspan.files"       /* by new file: its text, or false */
#define ASSIGNED "celspan.assigned" /* by file that was read: the lines by names that it assigns */
#define SHARED "celspan.shared"     /* names that some file assigns, as keys */

#define TEXT_MOST ((lua_Integer)256 << 20)
#define BYTES_A_STEP 16

/* ---------------------------------------------------------------- what a text assigns */

size_t cs_globals_skipped(const char *text, size_t size) {
  static const char mark[] = "\xEF\xBB\xBF";
  size_t at = size >= 3 && memcmp(text, mark, 3) == 0 ? 3 : 0;
  const char *line = at < size && text[at] == '#' ? memchr(text + at, '\n', size - at) : text + at;
  return line ? (size_t)(line - text) : size;
}

static bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
}

/* Adds a word to the table below the module on top of the stack, if it is a name of celspan. */
static void add_candidate(lua_State *L, const char *word, size_t length) {
  int module = lua_gettop(L);
  const char *name = lua_pushlstring(L, word, length);
  if (cs_names_has(L, module, name)) {
    lua_pushboolean(L, true);
    lua_rawset(L, module - 1);
  }
  lua_settop(L, module);
}

/* Adds the names that a text may assign to the table on top of the stack: they are before a comma,
 * a sign "=" or a comment, or after "function". */
static void add_candidates(lua_State *L, const char *at, const char *end) {
  bool is_named = false;
  cs_require_public(L, "celspan");
  while (at < end) {
    size_t length = 0;
    while (is_word(at[length])) /* a zero follows the text */
      length++;
    const char *next = at + length + strspn(at + length, " \t\r\n");
    if (length > 0 && (is_named || *next == ',' || *next == '=' || *next == '-'))
      add_candidate(L, at, length);
    is_named = length == 8 && memcmp(at, "function", length) == 0;
    at = length > 0 ? next : at + 1;
  }
  lua_pop(L, 1);
}

/* Compiles a text in which the names of a table are constants. Returns why Lua refuses it, which is
 * pushed, or NULL. */
static const char *push_refusal(lua_State *L, int names, const char *text, size_t size) {
  int first = lua_gettop(L) + 1;
  for (lua_pushnil(L); lua_next(L, names); lua_pop(L, 1)) {
    luaL_checkstack(L, 8, "names");
    lua_pushfstring(L, "local %s <const> = nil ", lua_tostring(L, -2));
    lua_insert(L, first);
  }
  if (lua_gettop(L) < first)
    return NULL;
  lua_pushliteral(L, "return function(...) ");
  lua_pushlstring(L, text, size);
  lua_pushliteral(L, "\nend");
  lua_concat(L, lua_gettop(L) - first + 1);
  const char *whole = lua_tolstring(L, -1, &size);
  return luaL_loadbufferx(L, whole, size, "=", "t") == LUA_OK ? NULL : lua_tostring(L, -1);
}

/* Finds one of the names that the text assigns, moves it from `names` to `found`, with its line.
 * Lua itself knows what is a local: it refuses to assign a constant. */
static bool find_assigned(lua_State *L, int names, int found, const char *text, size_t size) {
  static const char what[] = ": attempt to assign to const variable '";
  int top = lua_gettop(L);
  const char *message = push_refusal(L, names, text, size);
  const char *at = message ? strstr(message, what) : NULL;
  if (at) {
    at += sizeof what - 1;
    lua_pushlstring(L, at, strcspn(at, "'"));
    lua_pushvalue(L, -1);
    if (lua_rawget(L, names) == LUA_TNIL)
      at = NULL; /* a constant of the text's own */
    lua_pop(L, 1);
  }
  if (at) {
    const char *name = lua_tostring(L, -1);
    lua_pushinteger(L, strtol(message + 1, NULL, 10));
    lua_setfield(L, found, name);
    lua_pushnil(L);
    lua_setfield(L, names, name);
  }
  lua_settop(L, top);
  return at != NULL;
}

/* Adds the names that the text at index assigns to the table at `found`. */
static void add_assigned(lua_State *L, int index, int found) {
  size_t size;
  const char *text = lua_tolstring(L, index, &size);
  size_t skipped = cs_globals_skipped(text, size);
  lua_newtable(L);
  int names = lua_gettop(L);
  cs_host_charge(L, size / BYTES_A_STEP);
  add_candidates(L, text, text + size);
  while (find_assigned(L, names, found, text + skipped, size - skipped))
    cs_host_charge(L, size / BYTES_A_STEP);
  lua_pop(L, 1);
}

int cs_globals_assigned(lua_State *L) {
  luaL_checkstring(L, 1);
  lua_newtable(L);
  add_assigned(L, 1, lua_gettop(L));
  return 1;
}

/* ---------------------------------------------------------------- files */

void cs_globals_note(lua_State *L, const char *source, const char *text, size_t size) {
  int top = lua_gettop(L);
  luaL_checkstack(L, 8, "files");
  luaL_getsubtable(L, LUA_REGISTRYINDEX, FILES);
  if (text)
    lua_pushlstring(L, text, size);
  else
    lua_pushboolean(L, false);
  lua_setfield(L, -2, source);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, CS_NAMES_FOUND);
  for (lua_pushnil(L); lua_next(L, -2);) {
    lua_pushvalue(L, -2);
    lua_pushnil(L);
    lua_rawset(L, -5);
    lua_pop(L, 1);
  }
  lua_settop(L, top);
}

/* Pushes the text of a file by Lua's name of it, which for a text is the text itself; or a message,
 * if it cannot be read. */
static bool push_text(lua_State *L, const char *source) {
  if (source[0] != '@') {
    lua_pushstring(L, source[0] == '=' ? "" : source);
    return true;
  }
  lua_pushcfunction(L, cs_file_text);
  lua_pushstring(L, source + 1);
  lua_pushinteger(L, TEXT_MOST);
  lua_call(L, 2, 2);
  bool is_read = lua_isnil(L, -1);
  lua_remove(L, is_read ? -1 : -2);
  return is_read;
}

/* Reads what the text on top of the stack assigns, for a file. */
static void read_text(lua_State *L, int assigned, const char *source) {
  int text = lua_gettop(L), own = text + 1, shared = text + 2;
  luaL_getsubtable(L, assigned, source);
  add_assigned(L, text, own);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, SHARED);
  for (lua_pushnil(L); lua_next(L, own);) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, shared);
  }
}

/* Reads the files that were loaded since the last call, and forgets them. */
static void read_new(lua_State *L, int assigned) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, FILES);
  int files = lua_gettop(L), source = files + 1;
  for (lua_pushnil(L); lua_next(L, files);) {
    if (!lua_toboolean(L, -1) && !push_text(L, lua_tostring(L, source)))
      lua_error(L);
    read_text(L, assigned, lua_tostring(L, source));
    lua_settop(L, source);
    lua_pushvalue(L, source);
    lua_pushnil(L);
    lua_rawset(L, files);
  }
  lua_pop(L, 1);
}

/* Pushes the table of what a file assigns. */
static void push_assigned(lua_State *L, const char *source) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, ASSIGNED);
  int assigned = lua_gettop(L);
  read_new(L, assigned);
  if (lua_getfield(L, assigned, source) == LUA_TNIL) {
    if (!push_text(L, source))
      lua_pushliteral(L, "");
    read_text(L, assigned, source);
    lua_getfield(L, assigned, source);
  }
  lua_replace(L, assigned);
  lua_settop(L, assigned);
}

/* ---------------------------------------------------------------- globals */

/* Pushes what a global without a value is in the file that reads it. If it is the same in all
 * files, it is kept in the table at 1, or a name that nobody has in upvalue 1. Without a sandbox
 * Lua's own require does not note its files. */
static bool push_value(lua_State *L, const char *name) {
  lua_Debug reader;
  push_assigned(L, cs_caller_find(L, &reader) ? reader.source : "");
  if (lua_getfield(L, -1, name) != LUA_TNIL)
    return false;
  bool is_there = cs_names_push(L, name);
  if (!is_there) {
    lua_pushboolean(L, true);
    lua_setfield(L, lua_upvalueindex(1), name);
  } else if (cs_host_confines(L)) {
    luaL_getsubtable(L, LUA_REGISTRYINDEX, SHARED);
    lua_pushvalue(L, -2);
    if (lua_getfield(L, -2, name) == LUA_TNIL) {
      lua_pushvalue(L, -2);
      lua_setfield(L, 1, name);
    }
    lua_pop(L, 1);
  }
  return is_there;
}

/* __index of the table of found names. upvalues: the names without a value, and the function for
 * them. */
static int find(lua_State *L) {
  lua_CFunction otherwise = lua_tocfunction(L, lua_upvalueindex(2));
  lua_settop(L, 2);
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(1)) == LUA_TNIL && lua_type(L, 2) == LUA_TSTRING &&
      push_value(L, lua_tostring(L, 2)))
    return 1;
  lua_settop(L, 2);
  return otherwise ? otherwise(L) : 0;
}

void cs_globals_push_found(lua_State *L, lua_CFunction otherwise) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, CS_NAMES_FOUND);
  lua_createtable(L, 0, 1);
  lua_newtable(L);
  if (otherwise)
    lua_pushcfunction(L, otherwise);
  else
    lua_pushnil(L);
  lua_pushcclosure(L, find, 2);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
}

void cs_globals_open(lua_State *L) {
  int top = lua_gettop(L);
  lua_pushglobaltable(L);
  if (!lua_getmetatable(L, -1)) {
    lua_createtable(L, 0, 1);
    cs_globals_push_found(L, NULL);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
  }
  lua_settop(L, top);
}

/* __index of celspan.names(globals). upvalues: the globals, and what the file assigns. */
static int find_beside(lua_State *L) {
  lua_pushvalue(L, 2);
  if (lua_gettable(L, lua_upvalueindex(1)) != LUA_TNIL || lua_type(L, 2) != LUA_TSTRING)
    return 1;
  lua_pushvalue(L, 2);
  return lua_rawget(L, lua_upvalueindex(2)) == LUA_TNIL && cs_names_push(L, lua_tostring(L, 2));
}

int cs_globals_beside(lua_State *L) {
  lua_Debug caller;
  lua_settop(L, 1);
  if (!lua_istable(L, 1))
    return cs_caller_error(L, "names: takes the globals, celspan.names(_ENV), got %s",
                           cs_userdata_type(L, 1));
  lua_newtable(L);
  lua_createtable(L, 0, 2);
  lua_pushvalue(L, 1);
  lua_setfield(L, 3, "__newindex");
  lua_pushvalue(L, 1);
  lua_newtable(L);
  if (cs_caller_find(L, &caller) && push_text(L, caller.source))
    add_assigned(L, 6, 5);
  lua_settop(L, 5);
  lua_pushcclosure(L, find_beside, 2);
  lua_setfield(L, 3, "__index");
  lua_setmetatable(L, 2);
  return 1;
}
