/* Pictures whose pixels are a Lua string, or a surface of the core instead of a string. */
#pragma once

#include "lua/bind/fields.h"

#define CS_PIXEL_STRING_SIDE 1048576

extern const char *const cs_pixel_string_formats[], *const cs_pixel_string_alphas[];

/* The fields that belong to `pixels`, while they are read. */
typedef struct cs_pixel_string {
  bool has_size, has_alpha;
  int32_t size[2];
  int format, alpha; /* indices of words */
} cs_pixel_string;

/* The surface of the field `pixels`: all pictures with the same string share one. Borrowed; it
 * lives as long as the value at index `holder`. */
celspan_surface *cs_pixel_string_surface(const cs_form *form, const cs_pixel_string *given,
                                         int holder);
/* Pushes a value that the field `pixels` accepts instead of a string. It has the size, format and
 * alpha of the surface. */
void cs_pixel_string_push_surface(lua_State *L, celspan_surface *surface);
/* Adds the format if it is left out. */
void cs_pixel_string_complete(lua_State *L, int fields);
