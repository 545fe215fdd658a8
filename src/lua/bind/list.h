/* Where lists end.
 *
 * Lua's own length of a table with holes depends on where its keys lie in memory, and so on the
 * process. These lengths depend only on what the table contains; without holes all are the same.
 */
#pragma once

#include <lua.h>
#include <stdbool.h>

/* The greatest whole-number key above 0 of the table at index, without metamethods and at most
 * INT32_MAX. 0: there is none. */
lua_Integer cs_list_length(lua_State *L, int index);
/* The first empty place from 1 to `length`: one with nil, or with takes_false also one with false.
 * 0: no place is empty. */
lua_Integer cs_list_find_gap(lua_State *L, int index, lua_Integer length, bool takes_false);
/* The greatest n for which there is something at all places from 1 to n, exactly up to `exact`
 * places; in a longer list, found by doubling and halving, some n with nothing at n + 1. */
lua_Integer cs_list_border(lua_State *L, int index, lua_Integer exact);
