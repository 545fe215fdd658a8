/* Light taken off pictures: what the Lua module celspan.relight is made of. All answer what they
 * make, or nil and a sentence.
 *
 *   a light field in Lua: {r, g, b}, and `terms`, three lists of nine numbers, where it is uneven
 */
#ifndef CS_BIND_RELIGHT_H
#define CS_BIND_RELIGHT_H

#include <lua.h>

/* (texture) -> its width and height in pixels */
int cs_relight_size(lua_State *L);
/* (texture, clue, {r, g, b}, {x, y, w, h} | nil, is_uneven, blank | nil) -> field */
int cs_relight_estimate(lua_State *L);
/* (texture, field) -> texture */
int cs_relight_picture(lua_State *L);
/* (front, field, back, field) -> texture */
int cs_relight_exposures(lua_State *L);
/* (picture, ground, picture, ground, field) -> texture; a ground is a texture or {r, g, b} */
int cs_relight_grounds(lua_State *L);
/* (field, width, height) -> texture */
int cs_relight_shape(lua_State *L);
/* (texture, path) -> true */
int cs_relight_write(lua_State *L);
/* (path) -> texture, looked for as pictures are */
int cs_relight_read(lua_State *L);

#endif
