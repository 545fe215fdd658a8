#include "lua/bind/named.h"

#include <lauxlib.h>
#include <string.h>

#include "lua/bind/caller.h"
#include "lua/bind/host.h"

/* ---------------------------------------------------------------- lines */

/* The address of this variable is a key of the registry. Its value is a list of texts, which also
 * has the number of each text under the text itself. Item 0 is true while callers are kept. */
static const char callers_key = 0;

void cs_named_keep_callers(lua_State *L, bool is_kept) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &callers_key) != LUA_TTABLE) {
    lua_newtable(L);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &callers_key);
    lua_remove(L, -2);
  }
  lua_pushboolean(L, is_kept);
  lua_rawseti(L, -2, 0);
  lua_pop(L, 1);
}

void cs_named_push_callers(lua_State *L, uint32_t number) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &callers_key) == LUA_TTABLE && number > 0)
    lua_rawgeti(L, -1, number);
  else
    lua_pushliteral(L, "");
  lua_remove(L, -2);
}

/* The number of the callers' text in the list on top of the stack. */
static uint32_t number_of_callers(lua_State *L) {
  cs_caller_push_callers(L);
  lua_pushvalue(L, -1);
  if (lua_rawget(L, -3) != LUA_TNUMBER) {
    lua_Integer number = (lua_Integer)lua_rawlen(L, -3) + 1;
    lua_pushvalue(L, -2);
    lua_rawseti(L, -4, number);
    lua_pushvalue(L, -2);
    lua_pushinteger(L, number);
    lua_rawset(L, -5);
    lua_pop(L, 1);
    lua_pushinteger(L, number);
  }
  uint32_t number = (uint32_t)lua_tointeger(L, -1);
  lua_pop(L, 2);
  return number;
}

/* The number of the current callers; 0: callers are not kept. */
static uint32_t find_callers(lua_State *L) {
  uint32_t number = 0;
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &callers_key) == LUA_TTABLE) {
    lua_rawgeti(L, -1, 0);
    bool is_kept = lua_toboolean(L, -1);
    lua_pop(L, 1);
    number = is_kept ? number_of_callers(L) : 0;
  }
  lua_pop(L, 1);
  return number;
}

void cs_named_begin(lua_State *L, celspan_context *context) {
  lua_Debug at;
  luaL_checkstack(L, 6, "too many callers");
  if (!cs_caller_find(L, &at)) {
    cs_named_end(context);
    return;
  }
  celspan_context_set_origin(context, at.short_src, at.currentline);
  context->origin.callers = find_callers(L);
}

void cs_named_begin_as(celspan_context *context, const cs_userdata *value) {
  const cs_kind *kind = value->noun->kind;
  if (!kind->origin_of)
    return;
  celspan_origin at = kind->origin_of(value->handle);
  celspan_context_set_origin(context, at.source, at.line);
}

void cs_named_end(celspan_context *context) { celspan_context_set_origin(context, NULL, 0); }

/* ---------------------------------------------------------------- names */

void cs_named_copy(lua_State *L, const cs_userdata *from, cs_userdata *value) {
  const cs_kind *kind = from->noun->kind;
  const char *name = kind->name_of ? kind->name_of(from->handle) : "";
  void *made = NULL;
  if (!name[0])
    return;
  cs_host_try(L, "named", kind->named(cs_host_context(L), value->handle, name, &made));
  kind->unref(value->handle);
  value->handle = made;
}

int cs_named_method(lua_State *L) {
  const cs_userdata *value = cs_userdata_any(L, 1);
  if (!value || !value->noun->kind->named)
    return cs_caller_error(L, "named: call it as a method, value:named(\"hand\"), got %s",
                           cs_userdata_type(L, 1));
  if (lua_type(L, 2) != LUA_TSTRING)
    return cs_caller_error(L, "named: the name must be a string, got %s", cs_userdata_type(L, 2));
  const char *name = lua_tostring(L, 2);
  if (strlen(name) != lua_rawlen(L, 2))
    return cs_caller_error(L, "named: the name must not hold a zero byte");
  cs_userdata *copy = cs_userdata_push_like(L, 1, false);
  cs_host_try(L, "named",
              value->noun->kind->named(cs_host_context(L), value->handle, name, &copy->handle));
  return 1;
}
