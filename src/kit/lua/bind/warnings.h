/* Sentences about a scene that can be rendered but is probably not what its author wants.
 *
 *   native.warn(text)  -->  the list in the state  -->  cs_warnings_push  -->  celspan check
 *
 * INVARIANT: in a state that nobody asks for warnings, nothing is kept and nothing need be checked.
 */
#pragma once

#include <lua.h>
#include <stdbool.h>

/* From now on warnings are kept in this state. */
void cs_warnings_keep(lua_State *L);
/* Pushes a list of the warnings since the last call; an empty list if none are kept. */
void cs_warnings_push(lua_State *L);

/* native.warns() -> whether warnings are kept */
int cs_warnings_kept(lua_State *L);
/* native.warn(text): keeps the text with the caller's line in front */
int cs_warnings_add(lua_State *L);
