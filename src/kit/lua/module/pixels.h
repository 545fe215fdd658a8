/* The image that celspan.pixels gives: linear, premultiplied floats, which can be read, coded and
 * written. */
#pragma once

#include <lua.h>
#include <stdbool.h>
#include <stdint.h>

/* Pushes an image and returns its pixels for the caller to fill: RGBA, rows from top to bottom.
 * x, y: the place of its first pixel in the whole frame; is_opaque: every alpha is certain to be 1.
 * NULL, and nothing pushed, if it is too large. */
float *cs_pixels_push(lua_State *L, int32_t width, int32_t height, int32_t x, int32_t y,
                      bool is_opaque);
