/* The caller: the innermost Lua function on the stack that is not part of celspan's own modules.
 *
 *   shot.lua:40       frame = function(f)         called the caller
 *   hand.lua:12         finger(f)                 the caller: errors name this line, and files are
 *   celspan/keys.lua      keys{ ... }             celspan's own      looked for beside this file
 *   [C]                     celspan.mix(p, q, u)  the C function that uses this header
 *
 * INVARIANT: these functions change the stack only by pushing values.
 */
#pragma once

#include <lua.h>
#include <stdbool.h>

/* Finds the nearest function that has lines and does not belong to celspan, with its source and
 * line; false if there is none. */
bool cs_caller_find(lua_State *L, lua_Debug *out);
/* Calls its upvalue, a function of one of celspan's own modules. Lua forgets a function that ends
 * with `return multiplane { ... }`, except if it ends with the call of a C function. So this C
 * function keeps the caller's line known. */
int cs_caller_enter(lua_State *L);
/* Raises a message with the formats of lua_pushfstring at the caller's line; without a line where C
 * called. Does not return; the type is luaL_error's. */
int cs_caller_error(lua_State *L, const char *format, ...);

/* Pushes "hand.lua:12: " for the nearest function below `last` that has lines and is not celspan's
 * own. When there is none, the same for the line where the first argument of `last` begins, if that
 * is a function; else "". */
void cs_caller_push_position(lua_State *L, lua_CFunction last);
/* Pushes the same for the line where the function at index begins, for errors in its result, which
 * has no line of its own. */
void cs_caller_push_function(lua_State *L, int index);
/* Pushes the folder of the nearest file that does not belong to celspan, "" for the current one. If
 * there is none, returns false and pushes nothing. */
bool cs_caller_push_folder(lua_State *L);
/* Pushes the folder of a path; "" when it has none. */
const char *cs_caller_push_folder_of(lua_State *L, const char *path);

/* Pushes "in walk, from shot.lua:88, shot.lua:90" for the caller: the function that it is, if that
 * has a name, and its own callers, the nearest first; "" where neither is known. */
void cs_caller_push_callers(lua_State *L);
/* Pushes " (called from shot.lua:40, shot.lua:55)": the callers of the function at `position`, up
 * to the C function `last`; "" when there are none. For message handlers, while the stack of the
 * failed call still exists. */
void cs_caller_push_chain(lua_State *L, const char *position, lua_CFunction last);
