/* The methods that objects and cels share: each returns a new value.
 *
 * Angles are degrees; multiples of 90 give exact matrices.
 */
#ifndef CS_BIND_PLACED_H
#define CS_BIND_PLACED_H

#include <lauxlib.h>

extern const luaL_Reg cs_placed_methods[];

/* Degrees to radians, without whole turns. */
double cs_placed_radians(double degrees);

#endif
