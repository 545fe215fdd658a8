/* Fields of the table at an index, without its metatable. */
#pragma once

#include <lua.h>

/* The text of a field, which the table keeps alive; NULL: none. */
const char *cs_take_text(lua_State *L, int table, const char *name);
/* The number of a field; 1 or 0 for a boolean; `none` for any other value. */
double cs_take_number(lua_State *L, int table, const char *name, double none);
