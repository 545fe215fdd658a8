/* core.difference(first, second, width, tolerance): two strings of RGBA codes, 8 bits, sRGB, alpha
 * straight, rows of `width` pixels -> count, largest, x, y, channel, picture.
 *
 * count: pixels of which a code differs by more than the tolerance, 0..1; largest: the largest
 * difference, at x, y; picture: the codes of output/difference.h. Equal strings give 0 alone. The
 * colour under an alpha of 0 does not count.
 */
#ifndef CS_BIND_DIFFERENCE_H
#define CS_BIND_DIFFERENCE_H

#include <lua.h>

int cs_difference_of(lua_State *L);

#endif
