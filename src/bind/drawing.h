/* Drawings read from SVG, for lua/celspan/svg.lua. */
#ifndef CS_BIND_DRAWING_H
#define CS_BIND_DRAWING_H

#include <lua.h>

/* Adds read_svg to the table on top of the stack. */
void cs_drawing_open(lua_State *L);

#endif
