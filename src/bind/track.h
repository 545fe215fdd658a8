/* Following what moves, for lua/celspan/track.lua; no script sees these. */
#ifndef CS_BIND_TRACK_H
#define CS_BIND_TRACK_H

#include <lua.h>

/* tracker(bytes, width, height, model, {x, y, w, h} [, mask]) -> tracker | nil, message. bytes: RGBA
 * in 16-bit codes; mask: likewise, of what is followed by its alpha; model: from 0. */
int cs_track_tracker(lua_State *L);
/* follow(tracker, bytes, width, height) -> {matrix} | nil, message; nil alone: lost. Then corners,
 * agreeing, error. */
int cs_track_follow(lua_State *L);
/* rewind(tracker) */
int cs_track_rewind(lua_State *L);
/* frames(pattern [, list]) -> the numbers of the files that are there, or those of a list | nil,
 * message */
int cs_track_frames(lua_State *L);
/* frame_name(pattern, number) -> the name of a file */
int cs_track_frame_name(lua_State *L);

#endif
