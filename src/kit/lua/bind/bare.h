/* Values without fields, made by a method or from a file or a picture. `with` cannot change them.
 *
 *   static const cs_noun warped = {.name = "warped", .kind = ..., CS_BARE};
 *   cs_bare_push(L, &warped)->handle = object;
 */
#pragma once

#include "lua/bind/form.h"
#include "lua/bind/userdata.h"

extern const cs_field cs_bare_fields[];

/* The fields of a noun without fields. */
#define CS_BARE .fields = cs_bare_fields, .create = cs_bare_refuse

/* For the `create` of a noun: raises an error. */
void cs_bare_refuse(const cs_form *form, cs_userdata *value);
/* Pushes a closed value, with its table of fields, which is empty. */
cs_userdata *cs_bare_push(lua_State *L, const cs_noun *noun);
