/* Objects, cels and rostrums: values with a place. Their methods each return a new value. Angles
 * are degrees; multiples of 90 give exact matrices.
 */
#pragma once

#include <lauxlib.h>

/* object, mode -> the object with it, shown within its backdrop alone. Raises for other modes. */
int cs_placed_blend_within(lua_State *L);

/* Degrees to radians, without whole turns. */
double cs_placed_radians(double degrees);
