/* Objects, cels and rostrums: values with a place. Their methods each return a new value. Angles
 * are degrees; multiples of 90 give exact matrices.
 */
#pragma once

#include <lauxlib.h>

/* object, mode -> the object with this mode, shown only within its backdrop. Raises an error for
 * other modes. */
int cs_placed_blend_within(lua_State *L);

/* Degrees to radians; whole turns are removed first. */
double cs_placed_radians(double degrees);
