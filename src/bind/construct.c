#include "bind/construct.h"

#include <lauxlib.h>

#include "bind/form.h"
#include "bind/host.h"
#include "bind/userdata.h"

/* ---------------------------------------------------------------- making */

static void set_presets(lua_State *L, const cs_noun *noun, int table) {
  for (const cs_field *field = noun->fields; field->name; field++) {
    if (!field->preset)
      continue;
    lua_pushstring(L, field->name);
    if (lua_rawget(L, table) == LUA_TNIL) {
      lua_pushstring(L, field->name);
      if (!lua_stringtonumber(L, field->preset))
        lua_pushstring(L, field->preset);
      lua_rawset(L, table);
    }
    lua_pop(L, 1);
  }
}

/* Gives the value on top of the stack a copy of the table at `fields`, with the presets. */
static void freeze(lua_State *L, const cs_noun *noun, int fields) {
  cs_userdata_push_copy(L, fields);
  set_presets(L, noun, lua_gettop(L));
  if (noun->complete)
    noun->complete(L, lua_gettop(L));
  lua_setiuservalue(L, -2, 1);
}

void cs_construct_value(lua_State *L, const cs_noun *noun, int fields) {
  cs_form form = cs_form_open(L, noun, fields);
  cs_userdata *value = cs_userdata_push(L, noun);
  int place = lua_gettop(L);
  noun->create(&form, value);
  lua_settop(L, place);
  freeze(L, noun, form.table);
}

static int constructor(lua_State *L) {
  cs_construct_value(L, lua_touserdata(L, lua_upvalueindex(1)), 1);
  return 1;
}

void cs_construct_push(lua_State *L, const cs_noun *noun) {
  lua_pushlightuserdata(L, (void *)noun);
  lua_pushcclosure(L, constructor, 1);
}

/* ---------------------------------------------------------------- with */

static void copy_into(lua_State *L, int from, int to) {
  for (lua_pushnil(L); lua_next(L, from); lua_pop(L, 1)) {
    lua_pushvalue(L, -2);
    lua_pushvalue(L, -2);
    lua_rawset(L, to);
  }
}

static void clear_list(lua_State *L, int table) {
  for (lua_Integer i = (lua_Integer)lua_rawlen(L, table); i >= 1; i--) {
    lua_pushnil(L);
    lua_rawseti(L, table, i);
  }
}

/* The kept fields of a value can have both of two fields that exclude each other, because the noun
 * completes them. The one that the changes do not name is removed; the second if they name none. */
static void drop_other(lua_State *L, const cs_noun *noun, int changes, int fields) {
  if (!noun->either[0])
    return;
  lua_pushstring(L, noun->either[1]);
  bool names_second = lua_rawget(L, changes) != LUA_TNIL;
  lua_pushstring(L, noun->either[names_second ? 0 : 1]);
  lua_pushnil(L);
  lua_rawset(L, fields);
  lua_pop(L, 1);
}

/* Transforms and fades the value as `from` was after its constructor. */
static void reapply(lua_State *L, const cs_userdata *from, cs_userdata *value) {
  const cs_kind *kind = value->noun->kind;
  celspan_context *context = cs_host_context(L);
  void *changed = NULL;
  if (kind->transform) {
    cs_host_try(L, "with", kind->transform(context, value->handle, &from->matrix, &changed));
    kind->unref(value->handle);
    value->handle = changed;
    value->matrix = from->matrix;
  }
  if (kind->fade) {
    cs_host_try(L, "with", kind->fade(context, value->handle, from->fade, &changed));
    kind->unref(value->handle);
    value->handle = changed;
    value->fade = from->fade;
  }
}

int cs_construct_with(lua_State *L) {
  const cs_userdata *self = lua_touserdata(L, 1);
  if (!self || !lua_getmetatable(L, 1) || lua_getfield(L, -1, "__celspan") != LUA_TBOOLEAN)
    return luaL_error(L, "with: call it as a method, value:with{...}");
  const cs_noun *noun = self->noun;
  if (lua_type(L, 2) != LUA_TTABLE)
    return luaL_error(L, "%s: with takes a table of changes, got %s", noun->name,
                      cs_userdata_type(L, 2));
  lua_settop(L, 2);
  lua_getiuservalue(L, 1, 1);
  cs_userdata_push_copy(L, 3);
  drop_other(L, noun, 2, 4);
  if (noun->list == CS_LIST_ITEMS && lua_rawgeti(L, 2, 1) != LUA_TNIL)
    clear_list(L, 4);
  copy_into(L, 2, 4);
  cs_construct_value(L, noun, 4);
  reapply(L, self, lua_touserdata(L, -1));
  return 1;
}
