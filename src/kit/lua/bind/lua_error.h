/* Lua errors as sentences of the context:
 *
 *   hand.lua:12: frame 37: circle: radius is -3; ... (called from shot.lua:40)
 *
 * A message handler puts the position and a label before the message, and its callers after it,
 * while the stack of the failed call still exists; afterwards the message becomes the sentence of
 * the context, with a status.
 */
#pragma once

#include <lua.h>

#include "celspan/celspan.h"

/* Pushes a message handler for lua_pcall that puts the label, "frame 37: " or "", after the
 * position of the message. last: the function that is called in protected mode; the list of callers
 * ends there. */
void cs_lua_error_push_handler(lua_State *L, const char *label, lua_CFunction last);
/* lua_pcall(L, arguments, results, ...) of the function below the arguments, with such a handler.
 * The handler is made in protected mode, too: if memory runs out there, LUA_ERRMEM is returned. */
int cs_lua_error_call(lua_State *L, int arguments, int results);
/* The length of the position "script.lua:12: " at the beginning of a message; 0: there is none. */
size_t cs_lua_error_position(const char *message);

/* Whether the message on top of the stack, left by lua_pcall with this outcome, says that there was
 * no memory. Lua's own message keeps this meaning even when it is raised again. */
bool cs_lua_error_is_memory(lua_State *L, int outcome);
/* LIMIT if a limit of the sandbox ended the call, NO_MEMORY if a lack of memory in it ended the
 * call, with the text that says so; otherwise OK. The message is on top of the stack; the text is
 * valid while the message is there. */
celspan_status cs_lua_error_limit(lua_State *L, int outcome, const char **text);
/* The outcome of a call into the script that has `results` results. If it ended well, but a limit
 * was exceeded without an error, returns an error, and replaces the results by nil, as its
 * message. */
int cs_lua_error_settle(lua_State *L, int outcome, int results);

/* Turns the message on top of the stack, left by lua_pcall with this outcome, into the context's
 * sentence, and pops it. Returns the core's own status if its refusal was raised; otherwise
 * NO_MEMORY or CALLBACK. */
celspan_status cs_lua_error_report(lua_State *L, int outcome);
/* The same with a status that the caller knows. */
celspan_status cs_lua_error_report_as(lua_State *L, celspan_status status);
