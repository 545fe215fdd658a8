/* The modules of celspan that are written in Lua, for C that calls them. */
#pragma once

#include <lua.h>

/* Pushes a module, which is loaded when it is first asked for. Raises. */
void cs_require_module(lua_State *L, const char *name);

/* A method that is written in Lua, and ended by one without a name. Errors are raised at the line
 * that calls the method. */
typedef struct cs_written {
  const char *method, *module, *function;
} cs_written;

/* Puts such methods into the table on top of the stack. */
void cs_require_methods(lua_State *L, const cs_written *methods);
/* What they are; upvalue: which one, as light userdata. */
int cs_require_call(lua_State *L);
