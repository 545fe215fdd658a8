#include "lua/bind/construct.h"

#include <lauxlib.h>

#include "lua/bind/anchor.h"
#include "lua/bind/caller.h"
#include "lua/bind/form.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/named.h"
#include "lua/bind/userdata.h"

/* The room for presets in the kept fields; further presets are added more slowly. */
#define PRESETS 3

/* ---------------------------------------------------------------- making */

void cs_construct_push_fields(lua_State *L, const cs_noun *noun, int fields) {
  cs_userdata_push_copy(L, fields, PRESETS);
  cs_packed_set_presets(L, noun, lua_gettop(L));
  if (noun->complete)
    noun->complete(L, lua_gettop(L));
}

/* Gives the value on top of the stack a copy of the table at `fields`, with the presets. */
static void freeze(lua_State *L, const cs_noun *noun, int fields) {
  cs_construct_push_fields(L, noun, fields);
  lua_setiuservalue(L, -2, 1);
}

static void copy_into(lua_State *L, int from, int to) {
  for (lua_pushnil(L); lua_next(L, from); lua_pop(L, 1)) {
    lua_pushvalue(L, -2);
    lua_pushvalue(L, -2);
    lua_rawset(L, to);
  }
}

/* Replaces the table at `fields` by a copy without the items of its list that are nil or false, if
 * it has some and the noun leaves them out. */
static void close_gaps(lua_State *L, const cs_noun *noun, int fields) {
  if (!noun->has_gaps || !lua_istable(L, fields))
    return;
  lua_Integer length = cs_list_length(L, fields), kept = 0;
  if (length > CS_FORM_ITEMS_MOST || !cs_list_find_gap(L, fields, length, true))
    return;
  lua_newtable(L);
  copy_into(L, fields, lua_gettop(L));
  for (lua_Integer i = 1; i <= length; i++) {
    lua_rawgeti(L, fields, i);
    lua_pushnil(L);
    lua_rawseti(L, -3, i);
    if (lua_toboolean(L, -1))
      lua_rawseti(L, -2, ++kept);
    else
      lua_pop(L, 1);
  }
  lua_replace(L, fields);
}

/* like: the value from which the new one gets its line and name; NULL: it gets the line of the
 * caller. */
static void make(lua_State *L, const cs_noun *noun, int fields, const cs_userdata *like) {
  fields = lua_absindex(L, fields);
  close_gaps(L, noun, fields);
  cs_form form = cs_form_open(L, noun, fields);
  celspan_context *context = cs_host_context(L);
  if (like)
    cs_named_begin_as(context, like);
  else
    cs_named_begin(L, context);
  cs_packed packed;
  cs_packed_push_other(L, noun, form.table, &packed);
  cs_userdata *value = cs_userdata_push_packed(L, noun, like && like->is_placed, &packed);
  int place = lua_gettop(L);
  noun->create(&form, value);
  cs_named_end(context);
  if (like)
    cs_named_copy(L, like, value);
  lua_settop(L, place);
  lua_insert(L, place - 1);
  if (packed.has_other && packed.size > 0)
    lua_setiuservalue(L, -2, 1);
  else
    lua_pop(L, 1);
  if (packed.size == 0)
    freeze(L, noun, form.table);
}

void cs_construct_value(lua_State *L, const cs_noun *noun, int fields) {
  make(L, noun, fields, NULL);
}

void cs_construct_like(lua_State *L, const cs_noun *noun, int fields, const cs_userdata *like) {
  make(L, noun, fields, like);
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

static void clear_list(lua_State *L, int table) {
  for (lua_Integer i = cs_list_length(L, table); i >= 1; i--) {
    lua_pushnil(L);
    lua_rawseti(L, table, i);
  }
}

static bool has(lua_State *L, int table, const char *name) {
  lua_pushstring(L, name);
  bool found = lua_rawget(L, table) != LUA_TNIL;
  lua_pop(L, 1);
  return found;
}

static void drop(lua_State *L, int table, const char *name) {
  lua_pushstring(L, name);
  lua_pushnil(L);
  lua_rawset(L, table);
}

/* Of two fields that exclude each other, removes the field that the changes do not name. The kept
 * fields of a value can contain both, because the noun completes them: if the changes name neither,
 * the second is removed. */
static void drop_other(lua_State *L, const cs_noun *noun, int changes, int fields) {
  const char *first = noun->either[0], *second = noun->either[1];
  if (!first)
    return;
  if (has(L, changes, second)) {
    drop(L, fields, first);
  } else if (has(L, changes, first) || (has(L, fields, first) && has(L, fields, second))) {
    drop(L, fields, second);
    for (const char *const *name = noun->second; name && *name; name++)
      drop(L, fields, *name);
  }
}

/* Gives the value the mode that a method gave to `from`. */
static void reblend(lua_State *L, const cs_userdata *from, cs_userdata *value) {
  const cs_kind *kind = value->noun->kind;
  void *changed = NULL;
  if (!kind->blend || cs_userdata_has_field(value->noun, "blend"))
    return;
  cs_host_try(L, "with",
              kind->blend(cs_host_context(L), value->handle, kind->mode(from->handle), &changed));
  kind->unref(value->handle);
  value->handle = changed;
}

/* Applies to the value the transforms and fades that `from` got after its constructor. */
static void place_like(lua_State *L, const cs_userdata *from, cs_userdata *value) {
  const cs_kind *kind = value->noun->kind;
  celspan_context *context = cs_host_context(L);
  const cs_placement placement = cs_userdata_placement(from);
  void *changed = NULL;
  if (!from->is_placed)
    return;
  reblend(L, from, value);
  cs_host_try(L, "with", kind->transform(context, value->handle, &placement.matrix, &changed));
  kind->unref(value->handle);
  value->handle = changed;
  cs_host_try(L, "with", kind->fade(context, value->handle, placement.fade, &changed));
  kind->unref(value->handle);
  value->handle = changed;
  cs_userdata_place(value, &placement);
  cs_anchor_move(value, &placement.matrix);
}

/* Pushes the value at 1 with the changes at 2. */
static void push_changed(lua_State *L, const cs_userdata *self) {
  const cs_noun *noun = self->noun;
  cs_userdata_push_fields(L, 1);
  const int fields = lua_gettop(L);
  drop_other(L, noun, 2, fields);
  if (noun->list == CS_LIST_ITEMS && lua_rawgeti(L, 2, 1) != LUA_TNIL)
    clear_list(L, fields);
  copy_into(L, 2, fields);
  make(L, noun, fields, self);
  place_like(L, self, lua_touserdata(L, -1));
  if (noun->kind->transform)
    cs_anchor_keep_pivot(self, lua_touserdata(L, -1));
}

/* Pushes the pivot of the changes at 2, and replaces them by changes without it; if the pivot is
 * not among them, pushes nil. */
static void take_pivot(lua_State *L) {
  lua_pushliteral(L, "pivot");
  if (lua_rawget(L, 2) == LUA_TNIL)
    return;
  lua_newtable(L);
  copy_into(L, 2, lua_gettop(L));
  drop(L, lua_gettop(L), "pivot");
  lua_replace(L, 2);
}

static bool is_empty(lua_State *L, int table) {
  lua_pushnil(L);
  bool has_more = lua_next(L, table);
  lua_pop(L, has_more ? 2 : 0);
  return !has_more;
}

int cs_construct_with(lua_State *L) {
  const cs_userdata *self = cs_userdata_any(L, 1);
  if (!self)
    return cs_caller_error(L, "with: call it as a method, value:with{...}");
  const cs_noun *noun = self->noun;
  if (lua_type(L, 2) != LUA_TTABLE)
    return cs_caller_error(L, "%s: with takes a table of changes, got %s", noun->name,
                           cs_userdata_type(L, 2));
  lua_settop(L, 2);
  if (noun->kind->transform)
    take_pivot(L);
  cs_form_settle(L, noun, 2);
  const bool has_pivot = lua_gettop(L) == 3 && !lua_isnil(L, 3);
  if (has_pivot && is_empty(L, 2))
    lua_pushvalue(L, 1);
  else
    push_changed(L, self);
  if (has_pivot)
    cs_anchor_set_pivot(L, 3);
  return 1;
}
