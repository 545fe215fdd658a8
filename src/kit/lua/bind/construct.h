/* Making values from tables: the constructors, and :with, which makes a value again with changes.
 *
 * INVARIANT: a value keeps a copy of the fields that it was made from, completed by the presets of
 * its noun, so that reading a field gives the value that was used, and :with can start from it.
 */
#pragma once

#include "lua/bind/noun.h"

/* Checks, makes and pushes a value from the table at `fields`. */
void cs_construct_value(lua_State *L, const cs_noun *noun, int fields);
/* The same, with the name and the line of another value. */
void cs_construct_like(lua_State *L, const cs_noun *noun, int fields,
                       const struct cs_userdata *like);
/* Pushes the fields that a value of the noun would keep if it were made from the table at
 * `fields`. */
void cs_construct_push_fields(lua_State *L, const cs_noun *noun, int fields);
/* Pushes the constructor of a noun. */
void cs_construct_push(lua_State *L, const cs_noun *noun);
/* The method :with of every kind that has one. */
int cs_construct_with(lua_State *L);
