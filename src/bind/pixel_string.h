/* Pictures whose pixels are a Lua string, or a surface of the core in the place of one. */
#ifndef CS_BIND_PIXEL_STRING_H
#define CS_BIND_PIXEL_STRING_H

#include "bind/form.h"

/* The surface of the fields `pixels`, `size`, `format` and `alpha`: one for all pictures that show
 * the same string. Borrowed; it lives as long as the value at index `holder`. */
celspan_surface *cs_pixel_string_surface(const cs_form *form, int holder);
/* Pushes what the field `pixels` takes for a surface. Size, format and alpha are the surface's. */
void cs_pixel_string_push_surface(lua_State *L, celspan_surface *surface);
/* Fills in the format that is left out. */
void cs_pixel_string_complete(lua_State *L, int fields);

#endif
