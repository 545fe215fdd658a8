/* Shapes: the parts of a cel or of a boolean object, which are objects and rostrums with a size.
 *
 * A rostrum remains a rostrum until it is transformed, faded, or made an item of a cel or of a
 * boolean object. It then becomes an object with the same fields.
 */
#pragma once

#include "lua/bind/form.h"
#include "lua/bind/userdata.h"

/* The object at index. If there is a rostrum, it is replaced by its object, and an error is raised
 * if it has no size. NULL for other values. */
cs_userdata *cs_shape_at(lua_State *L, int index);
/* The objects of the array part: scratch memory. Their values stay in the list, or in a table; both
 * are left on the stack. */
celspan_object **cs_shape_items(const cs_form *form, int count);
