/* The animator's desk: verbs that are better said in Lua, as texts in the program.
 *
 *   a verb in C  -->  cs_desk_call(L, ..., the text, values)  -->  src/cli/desk/NAME.lua
 *
 * INVARIANT: a text is run in the state of the film it works on, under a chunk name that begins with
 * "@celspan/", so that faults are told at the lines of the script.
 */
#ifndef CS_CLI_DESK_H
#define CS_CLI_DESK_H

#include <lua.h>

/* Texts, each ended by a zero. */
extern const unsigned char cs_desk_test[];
extern const unsigned char cs_desk_contact[];
extern const unsigned char cs_desk_onion[];
extern const unsigned char cs_farm_text[];

/* Runs a text with the `count` values on top of the stack as its arguments, which are popped, and
 * leaves `results` values. name: what tracebacks call it, "@celspan/desk/test.lua". Runs unprotected. */
void cs_desk_call(lua_State *L, const unsigned char *text, const char *name, int count,
                  int results);

#endif
