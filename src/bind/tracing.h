/* What celspan.trace (lua/celspan/trace.lua) needs of the core: the shapes of a picture.
 *
 *   core.trace(path, { colours = n | { "#rrggbb", ... }, smooth =, speckle =, lines = })
 *     -> { width =, height =, shapes = {...} } | nil, message
 *       shapes[i]: colour ("#rrggbb"), x, y, area, and d, or points ({ x, y, width }) and closed
 */
#ifndef CS_BIND_TRACING_H
#define CS_BIND_TRACING_H

#include <lua.h>

int cs_tracing_make(lua_State *L);

#endif
