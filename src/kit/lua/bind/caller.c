#include "lua/bind/caller.h"

#include <lauxlib.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "lua/bind/require.h"

#define MOST_CALLERS 6 /* named in a message: the first ones of a chain and the last one */
#define MOST_CALLS 500 /* more are not searched: for each, Lua walks from the innermost */

/* Whether the function belongs to a built-in module; their names begin like this:
 * built_in.c. */
static bool is_own(const lua_Debug *info) {
  static const char own[] = "@celspan/";
  return strncmp(info->source, own, sizeof own - 1) == 0;
}

static bool get(lua_State *L, int level, lua_Debug *info) {
  return lua_getstack(L, level, info) && lua_getinfo(L, "Sl", info);
}

static bool is_function(lua_State *L, lua_Debug *info, lua_CFunction function) {
  lua_getinfo(L, "f", info);
  bool is_same = lua_tocfunction(L, -1) == function;
  lua_pop(L, 1);
  return is_same;
}

/* ---------------------------------------------------------------- positions */

static void push_position(lua_State *L, const lua_Debug *info) {
  if (info->currentline > 0)
    lua_pushfstring(L, "%s:%d: ", info->short_src, info->currentline);
  else
    lua_pushliteral(L, "");
}

bool cs_caller_find(lua_State *L, lua_Debug *out) {
  for (int level = 1; get(L, level, out); level++)
    if (out->currentline > 0 && !is_own(out))
      return true;
  return false;
}

static int leave(lua_State *L, int status, lua_KContext context) {
  (void)status;
  (void)context;
  return lua_gettop(L);
}

int cs_caller_enter(lua_State *L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_callk(L, lua_gettop(L) - 1, LUA_MULTRET, 0, leave);
  return leave(L, LUA_OK, 0);
}

/* Whether the level is a C function through which a script calls one of celspan's own functions. */
static bool is_passage(lua_State *L, lua_Debug *info) {
  return is_function(L, info, cs_caller_enter) || is_function(L, info, cs_require_call);
}

/* Whether the level is a C function that one of celspan's own modules called, such as the function
 * of a warp: its callbacks have the script's line too. A module that calls pcall writes its own
 * message, with the line, about an error that it catches. */
static bool is_called_by_own(lua_State *L, int level, lua_Debug *info) {
  lua_Debug caller;
  if (strcmp(info->short_src, "[C]") != 0 || !get(L, level + 1, &caller) || !is_own(&caller))
    return false;
  lua_getinfo(L, "n", info);
  return !info->name || strcmp(info->name, "pcall") != 0;
}

int cs_caller_error(lua_State *L, const char *format, ...) {
  lua_Debug info = {.source = "", .currentline = -1};
  int level = 1;
  while (get(L, level, &info) &&
         (is_own(&info) || is_passage(L, &info) || is_called_by_own(L, level, &info)))
    level++;
  push_position(L, &info);
  va_list arguments;
  va_start(arguments, format);
  lua_pushvfstring(L, format, arguments);
  va_end(arguments);
  lua_concat(L, 2);
  return lua_error(L);
}

void cs_caller_push_position(lua_State *L, lua_CFunction last) {
  lua_Debug info;
  int level = 1;
  for (; get(L, level, &info) && !is_function(L, &info, last); level++)
    if (info.currentline > 0 && !is_own(&info)) {
      push_position(L, &info);
      return;
    }
  bool is_last = get(L, level, &info) && lua_getlocal(L, &info, 1);
  if (is_last && lua_isfunction(L, -1))
    cs_caller_push_function(L, -1);
  else
    lua_pushliteral(L, "");
  if (is_last)
    lua_remove(L, -2);
}

/* ---------------------------------------------------------------- files */

static bool is_file(const lua_Debug *info) {
  return info->currentline > 0 && info->source[0] == '@' && !is_own(info);
}

const char *cs_caller_push_folder_of(lua_State *L, const char *path) {
  const char *slash = strrchr(path, '/');
  if (!slash)
    return lua_pushliteral(L, "");
  return lua_pushlstring(L, path, slash == path ? 1 : (size_t)(slash - path));
}

bool cs_caller_push_folder(lua_State *L) {
  lua_Debug info;
  for (int level = 1; get(L, level, &info); level++)
    if (is_file(&info)) {
      cs_caller_push_folder_of(L, info.source + 1);
      return true;
    }
  return false;
}

/* ---------------------------------------------------------------- the chain */

typedef struct place {
  char text[LUA_IDSIZE + 16]; /* "shot.lua:40" */
} place;

static place place_of(const lua_Debug *info) {
  place p;
  snprintf(p.text, sizeof p.text, "%s:%d", info->short_src, info->currentline);
  return p;
}

/* Whether a message begins with this place. */
static bool is_at(const char *position, const place *p) {
  size_t size = strlen(p->text);
  return strncmp(position, p->text, size) == 0 && position[size] == ':';
}

/* The level of the function of the next file, from `level` on, below `last`; 0: there is none. */
static int next_file(lua_State *L, int level, lua_CFunction last, lua_Debug *info) {
  for (; level <= MOST_CALLS && get(L, level, info) && !is_function(L, info, last); level++)
    if (is_file(info))
      return level;
  return 0;
}

/* The level after the level at `position`; after the innermost level if there is none at
 * `position`. */
static int first_caller(lua_State *L, const char *position, lua_CFunction last) {
  lua_Debug info;
  int innermost = next_file(L, 1, last, &info);
  for (int level = innermost; level; level = next_file(L, level + 1, last, &info)) {
    place p = place_of(&info);
    if (is_at(position, &p))
      return level + 1;
  }
  return position[0] ? 1 : innermost + 1;
}

/* Appends to a list of places. It is made for each value of a script, and joining a text for each
 * place would take several times as long. */
static void append(luaL_Buffer *list, const char *before, const char *text) {
  luaL_addstring(list, before);
  luaL_addstring(list, text);
}

void cs_caller_push_chain(lua_State *L, const char *position, lua_CFunction last) {
  lua_Debug info;
  place before = {""};
  int count = 0;
  luaL_Buffer list;
  luaL_checkstack(L, 6, "too many callers");
  luaL_buffinit(L, &list);
  for (int level = next_file(L, first_caller(L, position, last), last, &info); level;
       level = next_file(L, level + 1, last, &info)) {
    place p = place_of(&info);
    if (strcmp(p.text, before.text) == 0) /* a function that calls itself */
      continue;
    before = p;
    if (++count < MOST_CALLERS)
      append(&list, count == 1 ? " (called from " : ", ", p.text);
  }
  if (count >= MOST_CALLERS)
    append(&list, count > MOST_CALLERS ? ", ..., " : ", ", before.text);
  if (count)
    luaL_addstring(&list, ")");
  luaL_pushresult(&list);
}

void cs_caller_push_callers(lua_State *L) {
  lua_Debug info;
  int level = 1, count = 0;
  while (get(L, level, &info) && (info.currentline <= 0 || is_own(&info)))
    level++;
  luaL_Buffer list;
  luaL_checkstack(L, 6, "too many callers");
  luaL_buffinit(L, &list);
  bool is_called = lua_getstack(L, level, &info) && lua_getinfo(L, "nSl", &info);
  place before = is_called ? place_of(&info) : (place){""};
  if (is_called && info.name)
    append(&list, "in ", info.name);
  while (is_called && ++level <= MOST_CALLS && count < MOST_CALLERS && get(L, level, &info)) {
    if (!is_file(&info))
      continue;
    place p = place_of(&info);
    if (strcmp(p.text, before.text) == 0)
      continue;
    before = p;
    append(&list, ++count > 1 ? ", " : luaL_bufflen(&list) > 0 ? ", from " : "from ", p.text);
  }
  luaL_pushresult(&list);
}

/* ---------------------------------------------------------------- functions */

void cs_caller_push_function(lua_State *L, int index) {
  lua_Debug info;
  lua_pushvalue(L, index);
  lua_getinfo(L, ">S", &info);
  if (info.linedefined > 0)
    lua_pushfstring(L, "%s:%d: ", info.short_src, info.linedefined);
  else
    lua_pushliteral(L, "");
}
