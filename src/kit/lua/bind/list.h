/* Where lists end.
 *
 * Lua's own length of a table with holes depends on where its keys lie in memory, and so on the
 * process. These lengths depend only on what the table contains; without holes all are the same.
 */
#pragma once

#include <lua.h>
#include <stdbool.h>

/* The greatest positive whole-number key of the table at index, at most INT32_MAX; metamethods are
 * not used. 0: there is none. */
lua_Integer cs_list_length(lua_State *L, int index);
/* The first empty place from 1 to `length`: its value is nil, or with takes_false perhaps false. 0:
 * no place is empty. */
lua_Integer cs_list_find_gap(lua_State *L, int index, lua_Integer length, bool takes_false);
/* The greatest n for which all places from 1 to n have values. It is exact up to `exact` places; in
 * a longer list, doubling and halving find some n for which place n + 1 is empty. */
lua_Integer cs_list_border(lua_State *L, int index, lua_Integer exact);
