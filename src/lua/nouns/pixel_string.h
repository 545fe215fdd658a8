/* Pictures whose pixels are a Lua string, or a surface of the core in the place of one. */
#pragma once

#include "lua/bind/fields.h"

#define CS_PIXEL_STRING_SIDE 1048576

extern const char *const cs_pixel_string_formats[], *const cs_pixel_string_alphas[];

/* The fields that go with `pixels`, while they are read. */
typedef struct cs_pixel_string {
  bool has_size, has_alpha;
  int32_t size[2];
  int format, alpha; /* places of words */
} cs_pixel_string;

/* The surface of the field `pixels`: one for all pictures that show the same string. Borrowed; it
 * lives as long as the value at index `holder`. */
celspan_surface *cs_pixel_string_surface(const cs_form *form, const cs_pixel_string *given,
                                         int holder);
/* Pushes a value that the field `pixels` accepts in place of a string. Size, format and alpha are
 * those of the surface. */
void cs_pixel_string_push_surface(lua_State *L, celspan_surface *surface);
/* Adds the format if it is left out. */
void cs_pixel_string_complete(lua_State *L, int fields);
