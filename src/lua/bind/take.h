/* Fields of the table at an index, whose metatable says nothing about them. */
#pragma once

#include <lua.h>

/* The text of a field, which the table keeps alive; NULL: none. */
const char *cs_take_text(lua_State *L, int table, const char *name);
/* The number of a field; of a boolean 1 or 0; `none` where it is neither. */
double cs_take_number(lua_State *L, int table, const char *name, double none);
