#include "lua/bind/named.h"

#include <string.h>

#include "lua/bind/caller.h"
#include "lua/bind/host.h"

/* ---------------------------------------------------------------- lines */

void cs_named_begin(lua_State *L, celspan_context *context) {
  lua_Debug at;
  if (cs_caller_find(L, &at))
    celspan_context_set_origin(context, at.short_src, at.currentline);
  else
    cs_named_end(context);
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
