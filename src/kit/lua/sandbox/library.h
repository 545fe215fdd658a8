/* The globals of a script in the sandbox, and of celspan's own modules.
 *
 *   script, its modules --> globals: a list of allowed functions, some of them replaced
 *   celspan's modules   --> Lua's own, without io, os, debug and package; files through roots
 *
 * INVARIANT: no function of the list gives access to files, other programs, addresses, the clock or
 * the list of celspan's modules, and the guard counts all their time and memory. The methods of
 * strings are in a table that scripts cannot change. Lua uses copies of a script's metatables,
 * never the originals: setting a field of a metatable in use, and weak tables, break Lua 5.4.4 when
 * memory runs out.
 */
#pragma once

#include <lauxlib.h>
#include <lua.h>
#include <stdbool.h>
#include <stdint.h>

/* Copies fields of the table at `from` into the table on top; names: ended by NULL. */
void cs_library_copy_fields(lua_State *L, int from, const char *const *names);
/* Pushes a table with two groups of functions: those of Lua's library `name` that are listed in
 * `same`, and those in `own`. */
void cs_library_push_part(lua_State *L, const char *name, const char *const *same,
                          const luaL_Reg *own);

/* Calls Lua's function, which is upvalue 1, with the arguments, and returns all its results. */
int cs_library_call(lua_State *L);

/* This function and the next ones push a table of functions each. */
void cs_library_push_string(lua_State *L);
void cs_library_push_table(lua_State *L);
void cs_library_push_coroutine(lua_State *L);
void cs_library_push_math(lua_State *L);

/* Adds to the table on top: setmetatable, getmetatable, tostring, next, pairs. */
void cs_library_add_values(lua_State *L);
/* Adds to the table on top: load, print, pcall, xpcall. */
void cs_library_add_running(lua_State *L);

/* Pushes the script's require, for modules of the script in source form and celspan's modules for
 * scripts. Libraries of the table at `globals` are modules too. search: templates that are searched
 * after the script's folder, or NULL. */
void cs_library_push_require(lua_State *L, int globals, const char *search);

/* Pushes the value at index as a text without addresses. May call the script's __tostring. */
const char *cs_library_push_text(lua_State *L, int index);
/* Restarts math.random with a seed. */
void cs_library_seed(lua_State *L, uint64_t seed);
