#include "lua/nouns/shape.h"

#include "lua/bind/host.h"

cs_userdata *cs_shape_at(lua_State *L, int index) {
  cs_userdata *value = cs_userdata_test(L, index, &cs_kind_object);
  if (value)
    return value;
  const cs_userdata *rostrum = cs_userdata_test(L, index, &cs_kind_rostrum);
  if (!rostrum)
    return NULL;
  int place = lua_absindex(L, index);
  celspan_object *object = NULL;
  value = cs_userdata_push(L, &cs_noun_rostrum_object);
  cs_host_try(L, "rostrum",
              celspan_object_create_rostrum(cs_host_context(L), rostrum->handle, &object));
  value->handle = object;
  lua_getiuservalue(L, place, 1); /* it is never changed, so it can be shared */
  lua_setiuservalue(L, -2, 1);
  lua_replace(L, place);
  return value;
}

/* Whether the value on top of the stack is a table with an object, as a drawing is. */
static bool has_object(lua_State *L) {
  if (!lua_istable(L, -1))
    return false;
  lua_pushliteral(L, "object");
  lua_rawget(L, -2);
  bool has = luaL_testudata(L, -1, cs_kind_object.name) != NULL;
  lua_pop(L, 1);
  return has;
}

celspan_object **cs_shape_items(const cs_form *form, int count) {
  lua_State *L = form->L;
  celspan_object **objects = cs_form_scratch(L, (size_t)count, sizeof *objects);
  /* keeps the items alive: a finaliser may remove them from the list */
  lua_createtable(L, count, 0);
  int kept = lua_gettop(L);
  for (int i = 0; i < count; i++) {
    lua_rawgeti(L, form->table, i + 1);
    const cs_userdata *value = cs_shape_at(L, -1);
    if (!value && lua_istable(L, -1) && lua_rawlen(L, -1) > 0)
      cs_form_fail(form,
                   "item %d must be an object, got a list; table.unpack(list) gives its objects",
                   i + 1);
    if (!value)
      cs_form_fail(form, "item %d must be an object, got %s%s", i + 1, cs_userdata_type(L, -1),
                   has_object(L) ? "; its field `object` is one: write .object after it" : "");
    objects[i] = value->handle;
    lua_rawseti(L, kept, i + 1);
  }
  return objects;
}
