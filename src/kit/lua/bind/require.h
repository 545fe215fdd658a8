/* The modules of celspan that are written in Lua, for C that calls them, and for each other.
 *
 *   of scripts    package.preload, package.loaded      celspan.keys, celspan.svg, ...
 *   private       tables of their own                  celspan.fields, celspan.native, ...
 *
 * INVARIANT: only celspan's own code finds a private module. Its chunks have globals of their own:
 * the globals of the state as they were at first, with a `require` that finds both kinds of
 * modules.
 */
#pragma once

#include <lauxlib.h>
#include <lua.h>
#include <stdbool.h>

/* Gives the state private modules: functions that return them. Raises. */
void cs_require_give(lua_State *L, const luaL_Reg *modules);
/* Gives the state all modules: those of scripts, in package.preload, and celspan's own. Without the
 * library package, the lists are searched instead of copied. Raises. */
void cs_require_offer(lua_State *L, const luaL_Reg *modules, const luaL_Reg *own);
/* Pushes the globals of celspan's own chunks. Raises. */
void cs_require_push_globals(lua_State *L);

/* Forgets the modules that were loaded: each is loaded again at its next use. */
void cs_require_forget(lua_State *L);

/* Pushes a private or public module, which is loaded at its first use. Raises. */
void cs_require_module(lua_State *L, const char *name);
/* Whether that private module has been loaded. Raises. */
bool cs_require_is_loaded(lua_State *L, const char *name);
/* cs_require_module for a script, which has only public modules. */
void cs_require_public(lua_State *L, const char *name);

/* A method that is written in Lua; a list of them is ended by one without a name. Errors are raised
 * at the line that calls the method. */
typedef struct cs_written {
  const char *method, *module, *function;
} cs_written;

/* Puts such methods into the table on top of the stack. */
void cs_require_methods(lua_State *L, const cs_written *methods);
/* The C function behind these methods; upvalue: the method, as light userdata. */
int cs_require_call(lua_State *L);
