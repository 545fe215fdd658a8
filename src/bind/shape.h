/* Shapes: what a cel and a boolean object hold, that is objects, and rostrums with a size.
 *
 * A rostrum stays a rostrum until it is transformed, faded, or made an item of a cel or of a boolean
 * object; the object that it becomes then has the same fields.
 */
#ifndef CS_BIND_SHAPE_H
#define CS_BIND_SHAPE_H

#include "bind/form.h"
#include "bind/userdata.h"

/* The object at index. A rostrum there is replaced by the object that it is; it raises when it has
 * no size. NULL when it is neither. */
cs_userdata *cs_shape_at(lua_State *L, int index);
/* The objects of the array part: scratch memory. What they are borrowed from stays in the list, or
 * in a table; both are left on the stack. */
celspan_object **cs_shape_items(const cs_form *form, int count);

#endif
