#include "lua/nouns/shown.h"

#include <lauxlib.h>
#include <string.h>

#include "inside/scene.h"
#include "lua/bind/caller.h"
#include "lua/bind/construct.h"
#include "lua/bind/form.h"
#include "lua/bind/list.h"
#include "lua/bind/numbers.h"
#include "lua/nouns/nouns.h"

#define MOST 100000
#define DEEPEST 16

/* ---------------------------------------------------------------- messages */

/* Where a value is: "the frame function's result", or in another place "item 2". */
typedef struct place {
  const struct place *outer;
  const char *text;
  lua_Integer number;
} place;

static const char *push_place(lua_State *L, const place *at) {
  if (!at->outer)
    return lua_pushstring(L, at->text);
  return lua_pushfstring(L, "%s: %s %I", push_place(L, at->outer), at->text,
                         (LUAI_UACINT)at->number);
}

static void refuse(lua_State *L, const place *at, const char *got) {
  cs_caller_error(L, "%s must be a rostrum, an object, a cel or a list of them, got %s",
                  push_place(L, at), got);
}

/* Raises an error if a list has named fields; it names the first of them. */
static void refuse_fields(lua_State *L, int list, const place *at) {
  const char *first = NULL;
  for (lua_pushnil(L); lua_next(L, list); lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING && (!first || strcmp(lua_tostring(L, -2), first) < 0))
      first = lua_tostring(L, -2); /* the list keeps it alive */
  if (first)
    cs_caller_error(L,
                    "%s has the field '%s'; lights, a camera and other fields belong to the whole "
                    "list, { a, b, %s = ... }",
                    push_place(L, at), first, first);
}

/* ---------------------------------------------------------------- cels */

static lua_Integer length_of(lua_State *L, int list, const place *at) {
  lua_Integer length = cs_list_length(L, list);
  if (length > MOST)
    refuse(L, at, "a list that is too long");
  return length;
}

static void append(lua_State *L, int list) {
  lua_rawseti(L, list, (lua_Integer)lua_rawlen(L, list) + 1);
}

static void add(lua_State *L, int cels, const place *at, int depth);

static void add_items(lua_State *L, int cels, const place *at, int depth) {
  int list = lua_gettop(L);
  lua_Integer last = length_of(L, list, at);
  if (depth > DEEPEST)
    refuse(L, at, "lists in lists that are too deep");
  if (depth > 0)
    refuse_fields(L, list, at);
  for (place item = {at, "item", 1}; item.number <= last; item.number++) {
    lua_rawgeti(L, list, item.number);
    if (lua_toboolean(L, -1))
      add(L, cels, &item, depth + 1);
    else
      lua_pop(L, 1);
  }
  lua_pop(L, 1);
}

/* Adds the cels of the value on top of the stack, and pops it. */
static void add(lua_State *L, int cels, const place *at, int depth) {
  luaL_checkstack(L, 8, "too many lists");
  if (cs_userdata_test(L, -1, &cs_kind_cel)) {
    append(L, cels);
  } else if (cs_userdata_test(L, -1, &cs_kind_object) ||
             cs_userdata_test(L, -1, &cs_kind_rostrum)) {
    lua_pushcfunction(L, cs_nouns_cel_of);
    lua_insert(L, -2);
    lua_call(L, 1, 1);
    append(L, cels);
  } else if (!lua_istable(L, -1)) {
    refuse(L, at, cs_userdata_type(L, -1));
  } else if (lua_getmetatable(L, -1)) {
    refuse(L, at, "a table with methods: a drawing has its 'object'");
  } else {
    add_items(L, cels, at, depth);
  }
}

/* ---------------------------------------------------------------- rostrums */

/* Replaces the value on top of the stack by a rostrum. */
static void make_rostrum(lua_State *L, const place *at) {
  if (cs_userdata_test(L, -1, &cs_kind_rostrum))
    return;
  int value = lua_gettop(L), cels = value + 1;
  lua_newtable(L);
  lua_pushvalue(L, value);
  add(L, cels, at, 0);
  if (lua_istable(L, value))
    for (lua_pushnil(L); lua_next(L, value); lua_pop(L, 1))
      if (lua_type(L, -2) == LUA_TSTRING) {
        lua_pushvalue(L, -2);
        lua_pushvalue(L, -2);
        lua_rawset(L, cels);
      }
  cs_construct_value(L, &cs_noun_rostrum, cels);
  lua_replace(L, value);
  lua_settop(L, value);
}

/* Whether an item of the list is { rostrum [, weight] } or { what is shown, weight }. */
static bool is_exposure(lua_State *L, int list, lua_Integer number) {
  int top = lua_gettop(L), second = LUA_TNIL;
  bool is_table = lua_rawgeti(L, list, number) == LUA_TTABLE, is_one = false;
  if (is_table) {
    second = lua_rawgeti(L, -1, 2);
    lua_rawgeti(L, -2, 1);
    bool is_shown = second == LUA_TUSERDATA || second == LUA_TTABLE || second == LUA_TBOOLEAN;
    is_one = second == LUA_TNUMBER || (!is_shown && cs_userdata_test(L, -1, &cs_kind_rostrum));
  }
  lua_settop(L, top);
  return is_one;
}

/* The number of exposures, if the value at index is a list of them; otherwise 0. */
static lua_Integer count_exposures(lua_State *L, int index, const place *at) {
  if (!lua_istable(L, index) || lua_getmetatable(L, index))
    return 0;
  lua_Integer count = length_of(L, index, at), i = 1;
  while (i <= count && is_exposure(L, index, i))
    i++;
  return i > count ? count : 0;
}

static void push_exposures(lua_State *L, int list, lua_Integer count, const place *at) {
  lua_createtable(L, (int)count, 0);
  for (place item = {at, "exposure", 1}; item.number <= count; item.number++) {
    lua_createtable(L, 2, 0);
    if (lua_rawgeti(L, list, item.number) != LUA_TTABLE) /* a script may change it meanwhile */
      refuse(L, &item, cs_userdata_type(L, -1));
    lua_rawgeti(L, -1, 1);
    make_rostrum(L, &item);
    lua_rawseti(L, -3, 1);
    lua_rawgeti(L, -1, 2);
    lua_rawseti(L, -3, 2);
    lua_pop(L, 1);
    lua_rawseti(L, -2, item.number);
  }
}

/* Replaces the value at an absolute index by a rostrum or a new list of exposures. */
static void settle(lua_State *L, int index, const char *name) {
  const place at = {.text = name};
  int top = lua_gettop(L);
  lua_Integer count = count_exposures(L, index, &at);
  if (count > 0) {
    push_exposures(L, index, count, &at);
  } else {
    lua_pushvalue(L, index);
    make_rostrum(L, &at);
  }
  lua_replace(L, index);
  lua_settop(L, top);
}

/* ---------------------------------------------------------------- exposures */

/* Exposure i of the list at index. */
static celspan_exposure read_exposure(lua_State *L, int list, int i, const char *name) {
  double weight = 1;
  const char *subject = lua_pushfstring(L, "exposure %d: its weight", i);
  lua_rawgeti(L, list, i);
  if (lua_rawgeti(L, -1, 2) != LUA_TNIL)
    weight = cs_numbers_check(L, -1, name, subject);
  lua_rawgeti(L, -2, 1);
  const cs_userdata *rostrum = lua_touserdata(L, -1);
  lua_pop(L, 4);
  return (celspan_exposure){rostrum->handle, weight};
}

void cs_shown_read(lua_State *L, int index, const char *name, celspan_frame_desc *desc) {
  index = lua_absindex(L, index);
  settle(L, index, name);
  const cs_userdata *rostrum = cs_userdata_test(L, index, &cs_kind_rostrum);
  size_t count = rostrum ? 1 : (size_t)cs_list_length(L, index);
  celspan_exposure *exposures = cs_form_scratch(L, count, sizeof *exposures);
  if (rostrum)
    exposures[0] = (celspan_exposure){rostrum->handle, 1};
  if (rostrum)
    desc->space = exposures[0].rostrum->space;
  else
    for (size_t i = 0; i < count; i++)
      exposures[i] = read_exposure(L, index, (int)i + 1, name);
  desc->exposures = exposures;
  desc->exposure_count = count;
}

/* ---------------------------------------------------------------- for modules */

/* Replaces the rostrum at index by a list of one exposure. */
static void make_list(lua_State *L, int index) {
  lua_createtable(L, 1, 0);
  lua_createtable(L, 2, 0);
  lua_pushvalue(L, index);
  lua_rawseti(L, -2, 1);
  lua_rawseti(L, -2, 1);
  lua_replace(L, index);
}

int cs_shown_exposures(lua_State *L) {
  lua_settop(L, 2);
  settle(L, 2, luaL_checkstring(L, 1));
  if (!lua_istable(L, 2))
    make_list(L, 2);
  for (lua_Integer i = 1; lua_rawgeti(L, 2, i) != LUA_TNIL; i++) {
    lua_pushinteger(L, 1);
    if (lua_rawgeti(L, 3, 2) == LUA_TNIL)
      lua_pop(L, 1);
    lua_rawseti(L, 3, 2);
    lua_settop(L, 2);
  }
  lua_settop(L, 2);
  return 1;
}

int cs_shown_cels(lua_State *L) {
  const place at = {.text = luaL_checkstring(L, 1)};
  lua_settop(L, 2);
  lua_newtable(L);
  lua_insert(L, 2);
  if (lua_toboolean(L, 3))
    add(L, 2, &at, 0);
  lua_settop(L, 2);
  return 1;
}
