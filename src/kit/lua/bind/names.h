/* celspan's names without a prefix, which lua/celspan/base/names.lua finds: a global without a
 * value is looked up in celspan and its modules, except in a file that assigns it.
 *
 *   globals --__index--> names that were found --__index--> celspan.names
 *
 * INVARIANT: the globals do not change. A name that some file assigns is not kept as found, because
 * it depends on the file that reads it.
 */
#pragma once

#include <lua.h>

/* Gives the globals of the state these names, unless they have a metatable already. Raises. */
void cs_names_open(lua_State *L);
/* Pushes the table of found names, for the __index of globals. otherwise: the __index of a name
 * without a value, which uses argument 2 alone; NULL: none. */
void cs_names_push_found(lua_State *L, lua_CFunction otherwise);
/* Notes that a file was loaded. source: Lua's name of it. text: NULL: that of the file. What it
 * assigns is found when it is needed. */
void cs_names_note(lua_State *L, const char *source, const char *text);
/* Pushes the end of a message about a global without a value: "; did you mean 'circle'?", or "". */
const char *cs_names_push_hint(lua_State *L, const char *name);
