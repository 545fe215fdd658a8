#include "bind/named.h"

#include <string.h>

#include "bind/caller.h"
#include "bind/host.h"

/* ---------------------------------------------------------------- the four types of the core */

typedef struct type {
  const cs_kind *kinds[2];
  celspan_status (*named)(celspan_context *context, void *handle, const char *name, void **out);
  const char *(*name)(const void *handle);
  celspan_origin (*origin)(const void *handle);
} type;

#define TYPE(noun)                                                                                 \
  static celspan_status noun##_named(celspan_context *context, void *handle, const char *name,     \
                                     void **out) {                                                 \
    celspan_##noun *made = NULL;                                                                   \
    celspan_status status = celspan_##noun##_named(context, handle, name, &made);                  \
    if (status == CELSPAN_OK)                                                                      \
      *out = made;                                                                                 \
    return status;                                                                                 \
  }                                                                                                \
  static const char *noun##_name(const void *handle) { return celspan_##noun##_name(handle); }     \
  static celspan_origin noun##_origin(const void *handle) {                                        \
    return celspan_##noun##_origin(handle);                                                        \
  }
TYPE(texture)
TYPE(object)
TYPE(cel)
TYPE(rostrum)

static const type types[] = {
    {{&cs_kind_texture, &cs_kind_paint}, texture_named, texture_name, texture_origin},
    {{&cs_kind_object, NULL}, object_named, object_name, object_origin},
    {{&cs_kind_cel, NULL}, cel_named, cel_name, cel_origin},
    {{&cs_kind_rostrum, NULL}, rostrum_named, rostrum_name, rostrum_origin},
};

/* NULL: values of this kind have no names. */
static const type *type_of(const cs_userdata *value) {
  const cs_kind *kind = value->noun->kind;
  for (size_t i = 0; i < sizeof types / sizeof *types; i++)
    if (types[i].kinds[0] == kind || types[i].kinds[1] == kind)
      return &types[i];
  return NULL;
}

/* ---------------------------------------------------------------- lines */

void cs_named_begin(lua_State *L, celspan_context *context) {
  lua_Debug at;
  if (cs_caller_find(L, &at))
    celspan_context_set_origin(context, at.short_src, at.currentline);
  else
    cs_named_end(context);
}

void cs_named_begin_as(celspan_context *context, const cs_userdata *value) {
  const type *known = type_of(value);
  if (!known)
    return;
  celspan_origin at = known->origin(value->handle);
  celspan_context_set_origin(context, at.source, at.line);
}

void cs_named_end(celspan_context *context) { celspan_context_set_origin(context, NULL, 0); }

/* ---------------------------------------------------------------- names */

static void give(lua_State *L, const type *known, const char *name, cs_userdata *value) {
  void *made = NULL;
  cs_host_try(L, "named", known->named(cs_host_context(L), value->handle, name, &made));
  value->noun->kind->unref(value->handle);
  value->handle = made;
}

void cs_named_copy(lua_State *L, const cs_userdata *from, cs_userdata *value) {
  const type *known = type_of(from);
  const char *name = known ? known->name(from->handle) : "";
  if (name[0])
    give(L, known, name, value);
}

int cs_named_method(lua_State *L) {
  const cs_userdata *value = cs_userdata_any(L, 1);
  const type *known = value ? type_of(value) : NULL;
  if (!known)
    return cs_caller_error(L, "named: call it as a method, value:named(\"hand\"), got %s",
                           cs_userdata_type(L, 1));
  if (lua_type(L, 2) != LUA_TSTRING)
    return cs_caller_error(L, "named: the name must be a string, got %s", cs_userdata_type(L, 2));
  const char *name = lua_tostring(L, 2);
  if (strlen(name) != lua_rawlen(L, 2))
    return cs_caller_error(L, "named: the name must not hold a zero byte");
  cs_userdata *copy = cs_userdata_push_like(L, 1, false);
  cs_host_try(L, "named", known->named(cs_host_context(L), value->handle, name, &copy->handle));
  return 1;
}

bool cs_named_push_field(lua_State *L, const cs_userdata *value, const char *key) {
  bool is_name = strcmp(key, "name") == 0;
  const type *known = is_name || strcmp(key, "origin") == 0 ? type_of(value) : NULL;
  if (!known || !value->handle)
    return false;
  celspan_origin at = known->origin(value->handle);
  const char *name = known->name(value->handle);
  if (is_name && name[0])
    lua_pushstring(L, name);
  else if (!is_name && at.line > 0)
    lua_pushfstring(L, "%s:%d", at.source, (int)at.line);
  else
    lua_pushnil(L);
  return true;
}
