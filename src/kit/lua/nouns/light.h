/* Lights of cels and rostrums, as scripts give them:
 *
 *   {r, g, b}, {r, g, b, a}, "#rrggbb"                   one colour
 *   a texture                                            a shape, on the frame
 *   { texture = t, gain = 1, on = "frame" | "cel" }      a shape
 */
#pragma once

#include "lua/bind/fields.h"

/* The field `name`: sets *flat or *shape. Returns false, and changes neither, if the field is
 * missing. *is_colour: whether it is a string. The texture is borrowed from a value that is left on
 * the stack. */
bool cs_light_read(const cs_form *form, const char *name, celspan_light *flat, bool *is_colour,
                   celspan_light_texture *shape);
