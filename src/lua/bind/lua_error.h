/* Lua errors as sentences of the context:
 *
 *   hand.lua:12: frame 37: circle: radius is -3; ... (called from shot.lua:40)
 *
 * A message handler puts the position and a label before the message, and its callers after it,
 * while the stack of the failed call still exists; afterwards the message becomes the sentence of
 * the context, with a status.
 */
#ifndef CS_BIND_LUA_ERROR_H
#define CS_BIND_LUA_ERROR_H

#include <lua.h>

#include "celspan/celspan.h"

/* Pushes a message handler for lua_pcall that puts the label, "frame 37: " or "", after the
 * position of the message. last: the function whose call is protected, with which the callers
 * end. */
void cs_lua_error_push_handler(lua_State *L, const char *label, lua_CFunction last);
/* lua_pcall(L, arguments, results, ...) of `function`, which is below its arguments, with such a
 * handler. The handler is made protected, too: where there is no memory for it, that is the outcome.
 */
int cs_lua_error_call(lua_State *L, int arguments, int results);
/* The length of the position "script.lua:12: " that a message begins with; 0: it begins with none.
 */
size_t cs_lua_error_position(const char *message);

/* Whether the message on top of the stack, left by lua_pcall with this outcome, says that there was
 * no memory: Lua's own message keeps its meaning where it was raised again. */
bool cs_lua_error_is_memory(lua_State *L, int outcome);
/* Whether the call ended by a limit of the sandbox. The message on top of the stack is then a
 * sentence that says which: one of Lua that has no memory left does not. */
bool cs_lua_error_is_limit(lua_State *L, int outcome);

/* The outcome of a call into the script, which had `results` results and has ended well by this
 * outcome: if a limit was exceeded and nothing has raised that, its sentence replaces the results,
 * and the outcome is an error. */
int cs_lua_error_settle(lua_State *L, int outcome, int results);

/* Turns the message on top of the stack, left by lua_pcall with this outcome, into the context's
 * sentence, and pops it. The status: the core's own where its refusal was raised, NO_MEMORY or
 * CALLBACK. */
celspan_status cs_lua_error_report(lua_State *L, int outcome);
/* The same with a status that the caller knows. */
celspan_status cs_lua_error_report_as(lua_State *L, celspan_status status);

#endif
