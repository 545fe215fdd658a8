#include "lua/bind/bare.h"

const cs_field cs_bare_fields[] = {{0}};

void cs_bare_refuse(const cs_form *form, cs_userdata *value) {
  (void)value;
  cs_form_fail(form, "it was not made of fields, and has no fields to change");
}

cs_userdata *cs_bare_push(lua_State *L, const cs_noun *noun) {
  cs_userdata *value = cs_userdata_push(L, noun);
  lua_newtable(L);
  lua_setiuservalue(L, -2, 1);
  return value;
}
