/* The files of a pattern such as walk.####.png, for celspan's own Lua modules; no script sees these. */
#ifndef CS_BIND_FRAMES_H
#define CS_BIND_FRAMES_H

#include <lua.h>

/* frames(pattern [, list]) -> the numbers of the files that are there, or those of a list | nil,
 * message */
int cs_frames_list(lua_State *L);
/* frame_name(pattern, number) -> the name of a file | nil, message */
int cs_frames_name(lua_State *L);

#endif
