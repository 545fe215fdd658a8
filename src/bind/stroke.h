/* The method :stroke of objects. */
#ifndef CS_BIND_STROKE_H
#define CS_BIND_STROKE_H

#include <lua.h>

/* primitive:stroke{ ... }: celspan.stroke{ outline = primitive, ... } where the primitive is, and faded
 * as it is. */
int cs_stroke_method(lua_State *L);

#endif
