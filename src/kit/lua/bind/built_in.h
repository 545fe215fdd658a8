/* Files that are part of the binary: modules and verbs in Lua, and texts that these use.
 *
 *   json.lua, json.luac   a file in Lua, and the same as bytecode, which is loaded in less time
 *
 * INVARIANT: bytecode does what its text does. It is loaded only into the release of Lua that made
 * it, and otherwise the text is. A build for another machine has no bytecode.
 */
#pragma once

#include <lauxlib.h>
#include <stddef.h>

/* A file, whose bytes end with a zero that is not counted. */
typedef struct cs_built_in {
  const char *name; /* without folders */
  const char *bytes;
  size_t size;
} cs_built_in;

/* The file of that name in a list, whose last row has no name; NULL: there is none. */
const cs_built_in *cs_built_in_find(const cs_built_in *files, const char *name);
/* Pushes a file of a list, which must exist, as a function with the globals of celspan's own
 * chunks. folder: "", or "base/", where the file was, for messages. Raises. */
void cs_built_in_load(lua_State *L, const cs_built_in *files, const char *folder, const char *name);
