/* Objects, cels and rostrums: values with a place.
 *
 * A shape is a part of a cel or of a boolean object: an object, or a rostrum with a size. A rostrum
 * stays a rostrum until it is transformed, faded, or made an item of a cel or of a boolean object;
 * the object that it becomes then has the same fields.
 *
 * The methods each return a new value. Angles are degrees; multiples of 90 give exact matrices.
 */
#pragma once

#include "lua/bind/form.h"
#include "lua/bind/userdata.h"

/* The object at index. A rostrum there is replaced by its object; an error is raised if it has no
 * size. NULL for other values. */
cs_userdata *cs_placed_at(lua_State *L, int index);
/* The objects of the array part: scratch memory. Their values stay in the list, or in a table; both
 * are left on the stack. */
celspan_object **cs_placed_items(const cs_form *form, int count);

/* object, mode -> the object with it, shown within its backdrop alone. Raises for other modes. */
int cs_placed_blend_within(lua_State *L);

/* Degrees to radians, without whole turns. */
double cs_placed_radians(double degrees);
