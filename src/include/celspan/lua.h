/* celspan for Lua 5.4: the entry points of the loadable module, for hosts that embed Lua.
 *
 *   luaL_requiref(L, "celspan", luaopen_celspan, 0);
 *   lua_pop(L, 1);
 *
 * luaopen_celspan returns the complete module table and puts the animation library (celspan.ease,
 * celspan.keys, ...) into package.preload, so that no search path is needed. Each Lua state has a
 * context of its own, destroyed with the state.
 */
#ifndef CELSPAN_LUA_H
#define CELSPAN_LUA_H

#include <lua.h>

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

CELSPAN_API int luaopen_celspan(lua_State *L);
/* What the library's own Lua modules need from C: file names, nearest names. */
CELSPAN_API int luaopen_celspan_core(lua_State *L);

#ifdef __cplusplus
}
#endif
#endif
