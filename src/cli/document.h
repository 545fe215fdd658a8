/* What a Lua module of celspan's answers for a verb: a value with a text, which is printed or written
 * into a file by the value itself.
 */
#ifndef CS_CLI_DOCUMENT_H
#define CS_CLI_DOCUMENT_H

#include <lua.h>

#include "cli/report.h"

/* Calls the function on top of the stack that lies below its arguments, which answers a value, or nil
 * and a message. OK, and the value is pushed; else the message was reported, and nothing is. Raises.
 */
cs_exit cs_document_make(lua_State *L, int arguments);
/* Has the value on top of the stack write itself to `output`, whose folders are made; NULL or "-": its
 * text, to standard output. subject: what it was made of, for a message. OK, or reported; LIMIT for a
 * text that would be too long. Raises. */
cs_exit cs_document_put(lua_State *L, const char *output, const char *subject);

#endif
