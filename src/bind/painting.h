/* What celspan.layers (lua/celspan/layers.lua) needs of the core: paintings, and folders.
 *
 *   core.painting(path) -> { width =, height =, layers = {...}, notes = {...} } | nil, message
 *       layers[i]: name, blend, parent (its place, or nil), group, visible, opacity, x, y, width,
 *                  height, and pixels: what celspan.image takes as `pixels`
 *       notes[i]:  layer (its place), what
 *   core.folder(path) -> { names of its files, sorted } | nil, message: it is no folder
 *   core.within(folder, name) -> path | nil: the file does not exist, or lies outside the folder
 */
#ifndef CS_BIND_PAINTING_H
#define CS_BIND_PAINTING_H

#include <lua.h>

int cs_painting_read(lua_State *L);
int cs_painting_folder(lua_State *L);
int cs_painting_within(lua_State *L);

#endif
