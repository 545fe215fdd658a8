/* For names that a noun does not have: the name that was probably meant.
 *
 *   circle: unknown field 'raduis'; did you mean 'radius'?
 *   rect: write rect{ 1, 2, 3, 4 }, not rect{ x = 1, y = 2, w = 3, h = 4 }
 *   circle: unknown field 'x'; write centre = {10, 20}, not x = 10, y = 20
 */
#pragma once

#include <lua.h>

#include "lua/bind/noun.h"

/* Raises the message about a field of the table at `table` that the noun does not have. */
_Noreturn void cs_unknown_fail(lua_State *L, const cs_noun *noun, int table, const char *name);
/* Raises the message that a noun has no such name. It suggests the nearest of the `count` names
 * that exist, or lists all of them. */
_Noreturn void cs_unknown_fail_name(lua_State *L, const char *noun, const char *name,
                                    const char *const *names, size_t count);

/* places: "{x, y}". If the table at index names one of these values, pushes "write {10, 20}, not {x
 * = 10, y = 20}"; otherwise returns false and pushes nothing. */
bool cs_unknown_push_places(lua_State *L, int index, const char *places);
/* The field of which the word is a choice; NULL: it is a word of none. */
const char *cs_unknown_field_of(const cs_noun *noun, const char *word);
