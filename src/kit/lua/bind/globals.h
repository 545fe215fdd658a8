/* celspan's names among the globals of scripts: a global without a value is looked up in celspan
 * and its modules, except in a file that assigns it.
 *
 *   globals --__index--> names that were found --__index--> names.h
 *
 * INVARIANT: the globals do not change. A name that some file assigns is not kept as found, because
 * it depends on the file that reads it.
 */
#pragma once

#include <lua.h>
#include <stddef.h>

/* Gives the globals of the state these names, unless they have a metatable already. Raises. */
void cs_globals_open(lua_State *L);
/* Pushes the table of found names, for the __index of globals. otherwise: the __index of a name
 * without a value, which uses argument 2 alone; NULL: none. */
void cs_globals_push_found(lua_State *L, lua_CFunction otherwise);
/* Notes that a file was loaded. source: Lua's name of it. text, size: NULL, 0: those of the file.
 * What it assigns is found when it is needed. */
void cs_globals_note(lua_State *L, const char *source, const char *text, size_t size);
/* celspan.names(globals): the globals with these names beside them, for the file that calls it. */
int cs_globals_beside(lua_State *L);
/* native.assigned(text): the names of celspan that a text assigns as globals, with their lines. */
int cs_globals_assigned(lua_State *L);
/* The number of bytes that Lua skips at the beginning of a file: a byte-order mark, and a first
 * line that begins with #. */
size_t cs_globals_skipped(const char *text, size_t size);
