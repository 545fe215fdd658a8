/* The names of celspan that scripts may write without a prefix, and its functions in Lua.
 *
 *   circle    celspan.circle
 *   star      celspan.star, which is written in Lua and loaded when it is read
 *   ease      the module celspan.ease
 */
#pragma once

#include <lua.h>
#include <stdbool.h>
#include <stddef.h>

#define CS_NAMES_MOST 512
/* In the registry, if globals have celspan's names (globals.h): those that were found. */
#define CS_NAMES_FOUND "celspan.found"

/* Pushes a function of celspan that is written in Lua, and adds it to the module. module: an
 * absolute index. Returns false, and pushes nothing, if celspan has no such function. */
bool cs_names_push_written(lua_State *L, int module, const char *name);
/* Pushes what a name stands for. Returns false, and pushes nothing, if celspan does not have it. */
bool cs_names_push(lua_State *L, const char *name);
/* Whether cs_names_push knows the name. module: the absolute index of the module celspan. */
bool cs_names_has(lua_State *L, int module, const char *name);
/* The names in the module at an absolute index, sorted; the module keeps them alive. out: has room
 * for CS_NAMES_MOST. */
size_t cs_names_list(lua_State *L, int module, const char **out);
/* native.names(): all names, sorted, and for those of modules the names by which `require` finds
 * them. */
int cs_names_all(lua_State *L);
/* Pushes the end of a message about a global without a value, such as "; did you mean 'circle'?",
 * and returns it; "" if globals do not have celspan's names. It lives as long as what was pushed.
 */
const char *cs_names_push_hint(lua_State *L, const char *name);
