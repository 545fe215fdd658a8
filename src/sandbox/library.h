/* The globals of a script in the sandbox, and those of celspan's own modules beside it.
 *
 *   script, its modules --> globals: a list of what is allowed, some of it replaced
 *   celspan's modules   --> Lua's own, without io, os, debug and package; files through roots
 *
 * INVARIANT: no function of the list reaches a file, another program, an address, the clock or the
 * list of celspan's modules; none takes time or memory that is not counted by the guard. Texts have
 * the methods of a table that no script can change. A script's metatables are never the ones that
 * Lua uses, but copies of them: setting a field of a metatable in use, and weak tables, break
 * Lua 5.4.4 when memory runs out.
 */
#ifndef CS_SANDBOX_LIBRARY_H
#define CS_SANDBOX_LIBRARY_H

#include <lauxlib.h>
#include <lua.h>
#include <stdbool.h>
#include <stdint.h>

/* Copies fields of the table at `from` into the one on top; names: NULL after the last. */
void cs_library_copy_fields(lua_State *L, int from, const char *const *names);
/* Pushes a table with what Lua's own library `name` has under the names of `same`, and with `own`. */
void cs_library_push_part(lua_State *L, const char *name, const char *const *same,
                          const luaL_Reg *own);

/* Each pushes a table of functions. */
void cs_library_push_string(lua_State *L);
void cs_library_push_table(lua_State *L);
void cs_library_push_coroutine(lua_State *L);
void cs_library_push_math(lua_State *L);

/* Adds to the table on top: setmetatable, getmetatable, tostring, next, pairs. */
void cs_library_add_values(lua_State *L);
/* Adds to the table on top: load, print, pcall, xpcall. */
void cs_library_add_running(lua_State *L);

/* Pushes the text of the value at index, without addresses. May run the script's __tostring. */
const char *cs_library_push_text(lua_State *L, int index);
/* Begins math.random anew, with a seed. */
void cs_library_seed(lua_State *L, uint64_t seed);

#endif
